//! Where the time of a run goes: by kind of move, by tool, by operation.
//!
//! Comes in: events, and the texts in which the operations are named. Goes out: a [`Summary`] with its operations.
//!
//! An operation is what a shop calls one: it begins with a tool change and with a remark on a line of its own, which names
//! it. Where no remark does, a subprogram called from there is one, and what is left is parted by the canned cycle in
//! force. Remarks in a subprogram name nothing while one of its caller does. What comes back to the same operation
//! (another piece, another hole pattern) is added to it.

mod ledger;
mod split;
mod table;

use base::{Place, SourceId};
use dialect::Control;
use machine::{Event, EventKind};
use meaning::CodeLine;
use station::{Library, Session};

use crate::remarks::{header, remarks, remarks_above};
use crate::sheet::TOOL_CHANGE;
use crate::summary::Summary;

use ledger::{BlockSeen, Here};
pub(crate) use ledger::{Ledgers, Operation};
pub use split::Split;
pub(crate) use split::{asked, lost};
pub use table::time_text;

/// Characters before a block that are looked at for remarks.
const BEFORE: u64 = 2000;
/// Characters between two blocks in which no remark can stand: an end of block on paper and one on tape.
const NO_REMARK: u64 = 4;

/// The blocks of a run, watched for the names of its operations.
#[derive(Debug, Default)]
pub struct Naming {
    last: Option<Place>,
    /// The remarks at the program's head: they name the part.
    head: Vec<String>,
}

impl Naming {
    /// Takes an event in, before the summary does.
    pub fn see<L: Library>(
        &mut self,
        session: &mut Session<L>,
        event: &Event,
        summary: &mut Summary,
        text: &mut impl FnMut(&mut L, SourceId, u64, usize) -> Vec<u8>,
    ) {
        let place = &event.place;
        let is_new = self.last.is_none_or(|last| last.block.start != place.block.start || last.source != place.source);
        if is_new && place.line > 0 && place.block.len > 0 {
            self.block(session, place, summary, text);
        }
        if let EventKind::Code(code) = &event.kind
            && (code.line == CodeLine::T || (code.line == CodeLine::M && code.code == TOOL_CHANGE))
        {
            let own = text(session.library_mut(), place.source, place.block.start, place.block.len as usize);
            let remark = named(&remarks(&own, &session.configuration().control.grammar));
            let program = session.interpreter().program_name(place.program).to_owned();
            summary.ledgers.note(Here { remark, program, line: place.line, own: place.program });
        }
    }

    fn block<L: Library>(
        &mut self,
        session: &mut Session<L>,
        place: &Place,
        summary: &mut Summary,
        text: &mut impl FnMut(&mut L, SourceId, u64, usize) -> Vec<u8>,
    ) {
        let control = session.configuration().control.clone();
        let start = place.block.start;
        let from = match &self.last {
            Some(last) if last.source == place.source && last.block.end() <= start => last.block.end(),
            Some(_) => start,
            None => {
                let head = text(session.library_mut(), place.source, 0, (place.block.end() + BEFORE) as usize);
                self.head = header(&head, &control.grammar);
                0
            }
        };
        let mut remark = None;
        if start - from > NO_REMARK && start - from <= BEFORE {
            let before = text(session.library_mut(), place.source, from, (start - from) as usize);
            let mut found = remarks_above(&before, &control.grammar);
            found.retain(|remark| !self.head.contains(remark));
            remark = named(&found);
        }
        self.last = Some(*place);
        let interpreter = session.interpreter();
        let cycle = cycle_in_force(&control, interpreter.executing_state());
        let program_name = interpreter.program_name(place.program);
        let seen = BlockSeen { program: place.program, program_name, line: place.line, remark, cycle };
        summary.ledgers.block(&seen, &control);
    }
}

/// The row of the canned cycle in force.
fn cycle_in_force(control: &Control, state: &meaning::State) -> Option<u8> {
    let group = control.roles.cycle;
    let cycle = control.in_force(&state.groups, group).filter(|code| code.is_cycle());
    cycle.map(|_| state.groups.0[group])
}

fn named(remarks: &[String]) -> Option<String> {
    (!remarks.is_empty()).then(|| remarks.join(" · "))
}
