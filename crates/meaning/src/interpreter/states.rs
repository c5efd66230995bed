//! What changes the interpreter's state beside the program: RESET and its kin, another program, the operator's pages.

use base::{AxisSet, Point};
use dialect::{Fate, Occasion, ResetPointer, StateItem};
use syntax::Cursor;

use super::{Interpreter, to_counts};
use crate::command::{Body, Command};
use crate::occasion::state_after;
use crate::operation::SetValue;
use crate::program::Pointer;
use crate::state::State;

impl Interpreter {
    /// RESET, emergency stop, power-on, a program's end that resets: the queue is dropped, the executing block's state
    /// restored, the control's table of states applied.
    ///
    /// `machine` is where the axes really stand (mm, degrees). The program goes on with the block after the executing
    /// one, with that block itself if it was `refused`, or from its head (the table and policy `reset-pointer`).
    pub fn reset(&mut self, occasion: Occasion, machine: &Point, refused: bool) {
        self.restore(machine, refused);
        let setting = &self.reader.setting;
        let (control, fitting) = (setting.control.as_ref(), &setting.fitting);
        let before = *self.reader.state;
        let mut fresh = State::power_on(before.groups, before.machine, self.base_origin);
        fresh.reference.established = AxisSet::NONE;
        *self.reader.state = state_after(setting, occasion, &before, &fresh);
        let initial = |item| fitting.fate(control, item, occasion) == Fate::Initial;
        let (blanks, rewinds) = (initial(StateItem::VolatileVariables), initial(StateItem::ProgramPointer));
        if blanks {
            self.reader.setting.memory.variables.reset();
        }
        if rewinds {
            self.reader.rewind();
        }
        self.start_state = *self.reader.state;
        if occasion == Occasion::PowerOn {
            self.stored = self.reader.state.groups;
        }
    }

    /// Axes whose reference point is not established: at power-on, or after the position was lost.
    pub fn lose_reference_points(&mut self, axes: AxisSet) {
        let established = &mut self.reader.state.reference.established;
        *established = established.without(axes);
        self.start_state = *self.reader.state;
    }

    /// The axes have been moved by hand while no program was in its middle: they stand at `machine` (mm, degrees), and
    /// those that were returned to their reference point by it have it now, and no position offset; where the
    /// control has local origins, no shift of G52 or G92 either.
    pub fn moved_by_hand(&mut self, machine: &Point, returned: AxisSet) {
        let mut state = self.state_so_far(true);
        let states = &self.reader.setting.control.station.states;
        let shifts = states.iter().any(|row| row.item == StateItem::LocalSystem);
        state.reference.established = state.reference.established.or(returned);
        for axis in returned.iter() {
            state.displacement[axis] = 0.0;
            if shifts {
                (state.local[axis], state.common_shift[axis]) = (0.0, 0.0);
            }
        }
        self.go_on_from(state, machine);
        self.started = false;
    }

    /// The origin of the base work system, now and at every later power-on (counts).
    pub fn set_base_origin(&mut self, axis: usize, counts: f64) {
        if let (Some(now), Some(later)) = (self.reader.state.base_origin.get_mut(axis), self.base_origin.get_mut(axis))
        {
            (*now, *later) = (counts, counts);
        }
        // RESET goes back to what was executed last, of a program that has ended too.
        for command in self.queue.kept_mut() {
            if let Some(origin) = command.after.base_origin.get_mut(axis) {
                *origin = counts;
            }
        }
        self.start_state = *self.reader.state;
    }

    /// The origin of the base work system at every later power-on (counts).
    pub fn lasting_base_origin(&self) -> &Point {
        &self.base_origin
    }

    /// The UNIVERSAL display shows zero at this machine coordinate of an axis (counts) from now on.
    ///
    /// It is a display's matter, so blocks read ahead begin with it too, up to one whose G92 presets that display itself.
    pub fn set_universal_zero(&mut self, axis: usize, counts: f64) {
        let presets = |command: &Command| matches!(&command.body, Body::Set(_, Some(SetValue::Universal { axes, .. })) if axes.has(axis));
        let write = |state: &mut State| {
            if let Some(zero) = state.universal_zero.get_mut(axis) {
                *zero = counts;
            }
        };
        // RESET goes back to what was executed last.
        self.queue.kept_mut().for_each(|command| write(&mut command.after));
        write(&mut self.start_state);
        for index in 1..self.queue.len() {
            match self.queue.behind_mut(index) {
                Some(command) if !presets(command) => write(&mut command.after),
                _ => return,
            }
        }
        write(&mut self.reader.state);
    }

    /// Settings that follow the codes last executed, such as the unit of input, are written.
    pub fn store_codes(&mut self) {
        let groups = self.executing_state().groups;
        let setting = &mut self.reader.setting;
        setting.fitting.store_codes(&setting.control, &self.stored, &groups);
        self.stored = groups;
    }

    /// The tape is read on behind the next end of block, as a control does that looks for the end of a label. A program
    /// that is no tape, or stands at its head, begins where it begins.
    pub fn skip_label(&mut self) {
        self.reader.passes_over = true;
    }

    /// Where the main program goes on, to come back to it after another.
    pub fn pointer(&self) -> Option<Pointer> {
        self.reader.calls.frames.first().copied().map(Pointer)
    }

    /// The main program is this one again, where it was left.
    pub fn go_back_to(&mut self, pointer: Pointer) {
        self.drop_queue();
        self.reader.go_back_to(pointer.0);
        self.started = false;
    }

    /// The main program goes on at this block of its text, everything else as it stands.
    pub fn go_to_block(&mut self, block: Cursor) {
        self.drop_queue();
        self.reader.go_to_block(block);
        self.started = false;
    }

    /// Drops what was read and not executed: the state is that of the executing block, the axes stand at `machine`.
    pub fn restore(&mut self, machine: &Point, refused: bool) {
        // Nothing of a refused block has happened: the state is that of the block before it.
        let state = self.state_so_far(!refused);
        let command = self.queue.front().filter(|command| command.place.line > 0).copied();
        self.drop_queue();
        *self.reader.state = state;
        self.reader.stand_at(to_counts(machine));
        let stays = self.reader.setting.fitting.policies.reset_pointer == ResetPointer::Stays;
        match command {
            Some(command) if stays => self.reader.go_to(&command, refused),
            // Nothing is being executed: a second RESET leaves the program where the first one did.
            None if stays => {}
            _ => self.reader.rewind(),
        }
        self.started = false;
        self.start_state = *self.reader.state;
    }

    /// The state after the executing block if it has `begun`, after the block before it if not.
    pub(crate) fn state_so_far(&self, begun: bool) -> State {
        match self.queue.previous() {
            _ if begun => *self.executing_state(),
            Some(previous) => previous.after,
            None => self.start_state,
        }
    }

    /// Drops the queue; reading goes on in this state, with the axes at `machine` (mm, degrees).
    pub(crate) fn go_on_from(&mut self, state: State, machine: &Point) {
        self.drop_queue();
        *self.reader.state = state;
        self.reader.stand_at(to_counts(machine));
        self.start_state = *self.reader.state;
    }

    /// CYCLE START after a program's end that did not rewind: reading goes on with the block after it.
    pub fn go_on_after_end(&mut self) {
        self.drop_queue();
        self.reader.go_on();
        self.started = false;
    }
}
