//! The state after power-on, RESET, emergency stop or a program's end that resets, as the control's table says.

use base::AXES;
use dialect::{Fate, Occasion, StateItem};

use crate::cycle::CycleData;
use crate::setting::Setting;
use crate::state::State;

/// The state after an occasion. `fresh` is the control at power-on, standing where it stands.
pub(crate) fn state_after(setting: &Setting, occasion: Occasion, before: &State, fresh: &State) -> State {
    let (control, fitting) = (setting.control.as_ref(), &setting.fitting);
    let mut state = if occasion == Occasion::PowerOn { *fresh } else { *before };
    // The box of G22 is stored: neither occasion touches it.
    state.stroke = before.stroke;
    state.groups = fitting.groups_after(control, occasion, state.groups);
    for &(_, item) in StateItem::TABLE {
        let from = if fitting.fate(control, item, occasion) == Fate::Initial { fresh } else { before };
        take(&mut state, item, from);
    }
    (state.block_control, state.feed_control) = (fresh.block_control, fresh.feed_control);
    let changed = |group: usize| state.groups.0[group] != before.groups.0[group];
    if changed(control.roles.cycle) {
        state.cycle = CycleData::default();
    }
    if changed(control.roles.length) {
        // Nothing moves: what was applied is forgotten, and the next absolute word goes to its place without it.
        (state.length, state.length_due) = (0.0, 0.0);
    }
    setting.end_transforms(&mut state);
    state
}

/// Takes one state over from another.
fn take(state: &mut State, item: StateItem, from: &State) {
    match item {
        StateItem::Feed => state.feed = from.feed,
        StateItem::Codes => (state.spindle, state.tool, state.index) = (from.spindle, from.tool, from.index),
        StateItem::OffsetNumbers => (state.h, state.d) = (from.h, from.d),
        StateItem::Mirror => {
            state.transform.mirror = from.transform.mirror;
            state.transform.mirrored = from.transform.mirrored;
            state.transform.by_switch = from.transform.by_switch;
        }
        StateItem::LocalSystem => {
            for axis in 0..AXES {
                state.common_shift[axis] += from.local[axis] - state.local[axis];
            }
            state.local = from.local;
        }
        StateItem::ReferencePoints => state.reference.established = from.reference.established,
        StateItem::Corner => state.corner = from.corner,
        StateItem::Interrupt => state.interrupt = from.interrupt,
        StateItem::Universal => state.universal_zero = from.universal_zero,
        StateItem::Buffering => state.buffering = from.buffering,
        // Not part of what a block leaves to the next.
        StateItem::VolatileVariables | StateItem::ProgramPointer | StateItem::LabelSkip => {}
    }
}
