//! A block explained: each word with what it does here and the row behind it, what the block as a whole does, and what
//! it changes.
//!
//! Comes in: a session whose program is run by the one interpreter up to the block. Goes out: an [`Explanation`], and
//! its two faces. Must never know: how a code works; it repeats what the interpreter did and what the tables say.

mod beside;
mod count;
mod face;
mod happening;
mod here;
mod json;
mod policies;
mod quantity;
mod role;
mod state;
mod watch;
mod words;

use base::Diagnostic;
use dialect::Control;
use machine::Event;
use meaning::State;
use station::{Library, Session};
use syntax::{Block, Cursor, read_block};

pub use beside::Beside;
pub use face::explanation_text;
pub(crate) use happening::{happening, set_text};
pub use json::explanation_json;
pub use policies::PolicyLine;
pub(crate) use quantity::plain;
pub use state::Value;
pub use watch::{Wanted, Watch, Watched};
pub use words::WordLine;

use crate::excerpt::Excerpt;
use here::Here;
use state::Moment;

/// A block explained.
#[derive(Clone, PartialEq, Debug)]
pub struct Explanation {
    /// The file as the user named it.
    pub file: String,
    /// 1-based line.
    pub line: u64,
    /// The byte of its text at which it begins.
    pub offset: u64,
    /// The name of its program.
    pub program: String,
    /// The block as written.
    pub text: String,
    /// Which execution of the block is explained, and of how many; `None` if the program never comes to it.
    pub pass: Option<(u64, u64)>,
    /// What the reader should know before he trusts it.
    pub note: Option<String>,
    /// Its words.
    pub words: Vec<WordLine>,
    /// What happened, in order; its moves with their ends.
    pub events: Vec<Event>,
    /// Which of its moves run beside their programmed path, and how.
    pub beside: Vec<Beside>,
    /// How many events there were; more than are kept if the block is a cycle of very many steps.
    pub event_count: usize,
    /// The alarm with its three sentences, if the block is refused.
    pub alarm: Option<(Diagnostic, Excerpt)>,
    /// The policies that decide in it.
    pub policies: Vec<PolicyLine>,
    /// The values that it changes.
    pub changes: Vec<Value>,
    /// The codes in force before and after it, by the numbers of their groups.
    pub in_force: [Vec<(u8, String)>; 2],
    /// What it did, if it is a macro statement: what it wrote, the line at which the program went on.
    pub statement: Option<(Option<String>, u64)>,
    /// True where a canned cycle or hole pattern works: its moves are counted by holes.
    pub in_cycle: bool,
}

/// Explains an execution of a block. `text` holds the block's own characters, `alarm` says in words why it was refused.
pub fn explain<L: Library>(
    session: &Session<L>,
    watched: &Watched,
    file: &str,
    text: &[u8],
    alarm: Option<(Diagnostic, Excerpt)>,
) -> Explanation {
    let place = &watched.place;
    let bytes = text;
    let configuration = session.configuration();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let block = lex(bytes, place, control);
    let here = Here {
        control,
        fitting: session.interpreter().fitting(),
        machine,
        watched,
        block: &block,
        text: bytes,
        block_delete: configuration.switches.block_delete,
    };
    let moment = |state, index: usize| Moment { state, at: &watched.at[index], program: &watched.program[index] };
    let in_force = |state: &State| state::codes_in_force(control, state);
    Explanation {
        file: file.to_owned(),
        line: place.line,
        offset: place.block.start,
        program: session.interpreter().program_name(place.program).to_owned(),
        text: printable(bytes),
        pass: None,
        note: None,
        words: words::word_lines(&here),
        events: watched.events.clone(),
        beside: watched.beside.clone(),
        event_count: watched.event_count,
        alarm,
        policies: policies::policy_lines(&here),
        changes: state::changes(control, &machine.axes, moment(&watched.before, 0), moment(&watched.after, 1)),
        in_force: [in_force(&watched.before), in_force(&watched.after)],
        statement: watched
            .statement
            .map(|read| (read.wrote.map(|value| happening::set_text(control, &machine.axes, value)), read.goes_to)),
        in_cycle: here.cycle().is_some(),
    }
}

/// The block's words once more, for their places.
fn lex(bytes: &[u8], place: &base::Place, control: &Control) -> Block {
    let mut block = Block::default();
    let cursor = Cursor { offset: place.block.start, line: place.line, line_start: place.line_start, ..Cursor::HEAD };
    read_block(bytes, true, cursor, &control.grammar, &mut block);
    block
}

/// Bytes as text that can be shown.
pub(crate) fn printable(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    text.chars().filter(|letter| *letter != '\0').map(|c| if c.is_control() { ' ' } else { c }).collect()
}
