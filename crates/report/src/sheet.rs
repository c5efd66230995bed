//! The set-up sheet that a shop prints: what must be in the machine and in the control before CYCLE START.
//!
//! Comes in: a session whose program is run to its end. Goes out: a [`Sheet`], and its three faces. Must never know: the
//! date, or who stands at the machine; these are left blank for the hand.

mod html;
mod json;
mod shop_floor;
mod text;
mod tool;
mod watcher;

use base::{Alarm, SourceId};
use meaning::EndKind;
use station::{Library, LibraryError, Session, Step};

pub use html::sheet_html;
pub use json::sheet_json;
pub use text::sheet_text;
pub use tool::ToolSheet;

pub(crate) use shop_floor::TOOL_CHANGE;
use watcher::Watcher;

/// Seconds of a run.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Times {
    /// Cutting.
    pub cutting: f64,
    /// Positioning.
    pub rapid: f64,
    /// Dwells.
    pub dwell: f64,
    /// Waiting for the machine's answers.
    pub waiting: f64,
    /// All together.
    pub total: f64,
}

/// Where something stands.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Spot {
    /// The program's name.
    pub program: String,
    /// The line of its text.
    pub line: u64,
}

/// A work coordinate system that the program relies on.
#[derive(Clone, PartialEq, Debug)]
pub struct WorkSystem {
    /// Its code.
    pub name: String,
    /// Its origin as set up, by axis letter: mm or degrees, machine coordinates.
    pub origin: Vec<(char, f64)>,
    /// Where it is used first.
    pub first: Spot,
    /// It is the base system, which G92 or power-on sets.
    pub base: bool,
}

/// An offset that the program relies on.
#[derive(Clone, PartialEq, Debug)]
pub struct OffsetUse {
    /// `H` or `D`.
    pub letter: char,
    /// Its number.
    pub number: u32,
    /// Its value as set up, mm.
    pub value: f64,
    /// The tools that use it; `None` is the one in the spindle at the start.
    pub tools: Vec<Option<u32>>,
}

/// An M or B code.
#[derive(Clone, PartialEq, Debug)]
pub struct CodeUse {
    /// As written, `M06`.
    pub name: String,
    /// How often it is executed.
    pub count: u64,
    /// Where first.
    pub first: Spot,
    /// What the control does with it; `None` leaves it to the machine builder.
    pub text: Option<String>,
}

/// A stop at which somebody must do something.
#[derive(Clone, PartialEq, Debug)]
pub struct StopUse {
    /// `M00` or `M01`.
    pub name: &'static str,
    /// Where.
    pub spot: Spot,
    /// The remarks of its block.
    pub remark: String,
    /// How often.
    pub count: u64,
}

/// A place that G92 relies on.
#[derive(Clone, PartialEq, Debug)]
pub struct StartUse {
    /// Where the G92 stands.
    pub spot: Spot,
    /// Where the axes stood then, machine coordinates: letter, place, and whether only the operator can have put it
    /// there, for the program has not been to the reference point.
    pub axes: Vec<(char, f64, bool)>,
}

/// A subprogram.
#[derive(Clone, PartialEq, Debug)]
pub struct CalledProgram {
    /// Its name.
    pub name: String,
    /// The text in which it stands.
    pub source: SourceId,
    /// Where it is called first.
    pub first: Spot,
    /// How often it runs.
    pub runs: u64,
}

/// Everything that the run has brought to light.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Sheet {
    /// The program's name.
    pub program: String,
    /// The control.
    pub control: String,
    /// The machine.
    pub machine: String,
    /// The remarks at the program's head.
    pub header: Vec<String>,
    /// How it ended.
    pub end: Option<EndKind>,
    /// The alarm that stopped it.
    pub alarm: Option<Alarm>,
    /// The same in words, put in by whoever can say it.
    pub alarm_text: Option<String>,
    /// Cycle time.
    pub times: Times,
    /// The tools, in the order of their use.
    pub tools: Vec<ToolSheet>,
    /// Offsets.
    pub offsets: Vec<OffsetUse>,
    /// Work systems.
    pub systems: Vec<WorkSystem>,
    /// M and B codes.
    pub codes: Vec<CodeUse>,
    /// Options of the control that must be fitted: name and what it adds.
    pub options: Vec<(String, String)>,
    /// Stops.
    pub stops: Vec<StopUse>,
    /// Start positions.
    pub starts: Vec<StartUse>,
    /// Subprograms.
    pub called: Vec<CalledProgram>,
    /// What the program writes into the control's memory.
    pub writes: Vec<String>,
    /// The travel that is used: letter, lowest, highest, and the axis' limits.
    pub travel: Vec<(char, [f64; 2], [f64; 2])>,
}

impl Sheet {
    /// A place as the sheet says it: the program is named where it is not the sheet's own.
    pub(crate) fn place(&self, spot: &Spot) -> String {
        if spot.program == self.program || spot.program.is_empty() {
            format!("line {}", spot.line)
        } else {
            format!("{} line {}", spot.program, spot.line)
        }
    }

    /// Runs the session's program to its end, pressing CYCLE START after every stop. `text` gives characters of a text.
    ///
    /// # Errors
    /// A text cannot be read.
    pub fn run<L: Library>(
        session: &mut Session<L>,
        mut text: impl FnMut(&mut L, SourceId, u64, usize) -> Vec<u8>,
    ) -> Result<Sheet, LibraryError> {
        session.interpreter_mut().record_words(1);
        let mut watcher = Watcher::new(session);
        session.start();
        loop {
            if let Some(place) = session.block_begins() {
                watcher.begin(session, place, &mut text);
            }
            match session.next() {
                Step::Event(event) => watcher.see(session, &event),
                Step::Stopped => session.start(),
                Step::Idle => break,
                Step::Failed(error) => return Err(error),
            }
        }
        Ok(watcher.finish(session))
    }
}

/// A tool's name on the sheet.
pub(crate) fn tool_name(tool: Option<u32>) -> String {
    tool.map_or_else(|| "tool in spindle at the start".to_owned(), |number| format!("T{number:02}"))
}
