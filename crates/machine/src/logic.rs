//! The builder's logic: what a machine does with a code, as tables of steps that switch outputs and wait for inputs.
//!
//! The machine's file names the lines ([`LogicTable`]); [`Logic`] is the tables at work in virtual time, and what the
//! outputs move ([`iron`]) drives the inputs. It answers a code when its steps are done; where a step waits too long it
//! says for which line.

mod check;
mod iron;
mod reading;
mod run;

use meaning::{CodeLine, CodeOut};

pub(crate) use iron::{Actuator, Rotor};
pub(crate) use reading::{CodesOut, logic};
pub(crate) use run::spindle_says;
pub use run::{Logic, LogicTrouble, LogicWait};

/// A line that the builder has named.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LogicLine {
    /// Its name.
    pub name: String,
    /// The logic switches it; any other is an input.
    pub output: bool,
    /// It is on at power-on.
    pub on: bool,
}

/// What a step can wait for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Watched {
    /// A line of the builder's, by its index.
    Line(u8),
    /// What the spindle's drive says.
    Spindle(SpindleSays),
}

/// What the spindle's drive says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SpindleSays {
    /// It has reached its speed.
    Speed,
    /// It stands.
    Stands,
    /// It stands at its angle.
    Angle,
}

/// The names under which the builder's steps wait for the spindle.
pub(crate) const SPINDLE: [(&str, SpindleSays); 3] =
    [("SAR", SpindleSays::Speed), ("ZSP", SpindleSays::Stands), ("ORE", SpindleSays::Angle)];

/// Where something that turns shall stand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Place {
    /// At the position that the code names.
    OfCode,
    /// At this one.
    At(u32),
}

/// A step.
#[derive(Clone, PartialEq, Debug)]
pub struct LogicStep {
    /// What it does, in the builder's words.
    pub name: String,
    /// It is left out unless these lines stand so.
    pub only_if: Vec<(Watched, bool)>,
    /// Outputs that it switches as it begins.
    pub switches: Vec<(u8, bool)>,
    /// What turns to its place, and to which.
    pub turns: Option<(usize, Place)>,
    /// It lasts until these lines stand so,
    pub waits: Vec<(Watched, bool)>,
    /// and at least so long, s.
    pub seconds: f64,
    /// The longest wait, s; 0 is for ever.
    pub timeout: f64,
    /// The code is answered when it is done; what follows runs on beside the program.
    pub answers: bool,
}

impl LogicStep {
    /// True if it waits for anything but time.
    fn waits_for_lines(&self) -> bool {
        !self.waits.is_empty() || self.turns.is_some()
    }
}

/// What a code does.
#[derive(Clone, PartialEq, Debug)]
pub struct Sequence {
    /// Its lines.
    pub line: CodeLine,
    /// Its number; `None` for any on these lines that has no sequence of its own.
    pub code: Option<u32>,
    /// What is done, one after the other.
    pub steps: Vec<LogicStep>,
}

/// What becomes of steps and outputs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum LogicFate {
    /// Steps are dropped, what turns stops, any other output stays as it is.
    #[default]
    Keep,
    /// Steps are dropped, outputs return to what they are at power-on.
    Initial,
    /// Steps that have begun go on to their end.
    Finish,
    /// The power is off: every output is.
    Off,
}

/// The builder's logic as the machine's file has it.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct LogicTable {
    /// The lines, outputs first.
    pub lines: Vec<LogicLine>,
    /// What the codes do.
    pub sequences: Vec<Sequence>,
    pub(crate) actuators: Vec<Actuator>,
    pub(crate) rotors: Vec<Rotor>,
    /// At RESET.
    pub reset: LogicFate,
    /// At emergency stop.
    pub emergency_stop: LogicFate,
}

impl LogicTable {
    /// True if the builder has said nothing.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.sequences.is_empty()
    }

    /// What a code does: its own sequence, else that of its lines.
    pub fn sequence_of(&self, code: CodeOut) -> Option<usize> {
        self.sequence_on(code.line, code.code)
    }

    fn sequence_on(&self, line: CodeLine, code: u32) -> Option<usize> {
        let of = |number| self.sequences.iter().position(|row| row.line == line && row.code == number);
        of(Some(code)).or_else(|| of(None))
    }

    /// True if the steps of a code wait for the spindle's drive to say this.
    pub fn asks_spindle(&self, line: CodeLine, code: u32, says: SpindleSays) -> bool {
        let steps = self.sequence_on(line, code).and_then(|index| self.sequences.get(index)).map(|row| &row.steps);
        steps.is_some_and(|steps| steps.iter().any(|step| step.waits.contains(&(Watched::Spindle(says), true))))
    }

    /// The input of this name.
    pub fn input(&self, name: &str) -> Option<u8> {
        let found = self.lines.iter().position(|line| !line.output && line.name == name)?;
        u8::try_from(found).ok()
    }

    /// The name of what a step waits for.
    pub fn name_of(&self, watched: Watched) -> &str {
        match watched {
            Watched::Line(index) => self.lines.get(usize::from(index)).map_or("?", |line| &line.name),
            Watched::Spindle(says) => SPINDLE.iter().find(|(_, own)| *own == says).map_or("?", |(name, _)| name),
        }
    }

    /// What a step waits for, in words: `unclamped on, in step 2 (let go)`.
    pub fn wait_in_words(&self, wait: &LogicWait) -> String {
        let step = self.sequences.get(wait.sequence).and_then(|row| row.steps.get(wait.step));
        let named = step.filter(|step| !step.name.is_empty()).map(|step| format!(" ({})", step.name));
        let step = format!("step {}{}", wait.step + 1, named.unwrap_or_default());
        match wait.line {
            Some((line, on)) => format!("{} {}, in {step}", self.name_of(line), if on { "on" } else { "off" }),
            None => format!("the time of {step}"),
        }
    }

    /// What an alarm of the logic is about, in words; its last value says which wait it was.
    pub fn alarm_in_words(&self, packed: f64) -> Option<String> {
        let packed = packed as u64;
        let (sequence, step, line) = ((packed >> 24) as usize, (packed >> 12 & 0xfff) as usize, packed & 0xfff);
        let row = self.sequences.get(sequence)?.steps.get(step)?;
        let line = unpack(line)?;
        let wait = LogicWait { sequence, step, line: Some(line) };
        let time = if row.timeout > 0.0 { format!("{} s", row.timeout) } else { "ever".to_owned() };
        Some(format!("{} for {time}", self.wait_in_words(&wait)))
    }
}

/// A wait as a number that an alarm can carry.
pub(crate) fn pack(wait: &LogicWait) -> f64 {
    let line = wait.line.map_or(0xfff, |(line, on)| {
        let line = match line {
            Watched::Line(index) => u64::from(index),
            Watched::Spindle(says) => 0x200 + says as u64,
        };
        line << 1 | u64::from(on)
    });
    ((wait.sequence as u64) << 24 | (wait.step as u64) << 12 | line) as f64
}

fn unpack(line: u64) -> Option<(Watched, bool)> {
    let (line, on) = (line >> 1, line & 1 == 1);
    let watched = match line.checked_sub(0x200) {
        None => Watched::Line(u8::try_from(line).ok()?),
        Some(says) => Watched::Spindle(SPINDLE.get(says as usize)?.1),
    };
    Some((watched, on))
}
