//! What a builder's tables must not say: a code twice, a step that nobody comes to, a line that two things drive.

use data::Table;
use meaning::CodeLine;

use super::iron::{Actuator, Rotor};
use super::reading::{CodesOut, Placed};
use super::{LogicLine, LogicStep, Watched};

/// Every sequence is one of a code that goes out, and each of its steps is come to.
pub fn check_sequences(table: &Table, sequences: &[Placed], lines: &[LogicLine], rotors: &[Rotor], codes: CodesOut) {
    // One whose code cannot be read has been refused as that.
    let is_code = |placed: &&Placed| placed.sequence.line != CodeLine::M || placed.sequence.code.is_some();
    for (index, placed) in sequences.iter().enumerate().filter(|(_, placed)| is_code(placed)) {
        let row = &placed.sequence;
        let name = code_name(row.line, row.code);
        let same = |other: &&Placed| (other.sequence.line, other.sequence.code) == (row.line, row.code);
        if sequences.get(..index).is_some_and(|before| before.iter().any(|other| same(&other))) {
            table.error(placed.code.clone(), format!("{name} has two sequences; a code has one"));
        }
        let digits = codes.digits[row.line.index()];
        if row.code.is_some_and(|code| code >= 10u32.saturating_pow(u32::from(digits))) {
            let why = format!("{name} never goes out: its lines have {digits} digits");
            table.error(placed.code.clone(), why);
        } else if row.line == CodeLine::B && codes.b_axis {
            table.error(placed.code.clone(), format!("{name} never goes out: B is an axis of this machine"));
        }
        if row.steps.is_empty() {
            table.error(placed.code.clone(), format!("{name} has no steps"));
        }
        check_steps(table, placed, sequences, lines, rotors);
    }
}

fn code_name(line: CodeLine, code: Option<u32>) -> String {
    let letter = line.letter();
    code.map_or(letter.to_string(), |code| format!("{letter}{code:02}"))
}

fn check_steps(table: &Table, placed: &Placed, sequences: &[Placed], lines: &[LogicLine], rotors: &[Rotor]) {
    let mut answered = false;
    for (number, (step, place)) in placed.sequence.steps.iter().zip(&placed.steps).enumerate() {
        let number = number + 1;
        let say = |what: String| table.error(place.clone(), format!("step {number} {what}"));
        let name = |watched: &Watched| match watched {
            Watched::Line(index) => lines.get(usize::from(*index)).map_or("?", |line| &line.name).to_owned(),
            Watched::Spindle(says) => {
                super::SPINDLE.iter().find(|(_, own)| own == says).map_or("?", |(name, _)| name).to_owned()
            }
        };
        if let Some(line) = both(&step.only_if) {
            say(format!("is never done: `{}` would have to be on and off", name(&line)));
        }
        if let Some(line) = both(&step.waits) {
            say(format!("never ends: `{}` would have to be on and off; what follows is never reached", name(&line)));
        }
        let twice = step.switches.iter().find(|(line, on)| step.switches.contains(&(*line, !on)));
        if let Some((line, _)) = twice {
            say(format!("sets and clears `{}`", name(&Watched::Line(*line))));
        }
        if let Some((line, on)) = never(step, sequences, lines, rotors) {
            let (verb, state) = if on { ("sets", "on") } else { ("clears", "off") };
            let line = name(&line);
            say(format!(
                "never ends: it waits for the output `{line}` to be {state}, and no step {verb} it; what follows is never reached"
            ));
        }
        if step.answers && std::mem::replace(&mut answered, true) {
            say("gives FIN again; a code is answered once".to_owned());
        }
    }
}

/// A line that is listed as on and as off.
fn both(watched: &[(Watched, bool)]) -> Option<Watched> {
    watched.iter().find(|(line, on)| watched.contains(&(*line, !on))).map(|(line, _)| *line)
}

/// An output that the step waits for and that stands otherwise for ever.
fn never(step: &LogicStep, sequences: &[Placed], lines: &[LogicLine], rotors: &[Rotor]) -> Option<(Watched, bool)> {
    let turns = |step: &LogicStep, line: u8| {
        let rotor = step.turns.and_then(|(rotor, _)| rotors.get(rotor));
        rotor.is_some_and(|rotor| rotor.forward == line || rotor.backward == Some(line))
    };
    let switched = |wanted: (u8, bool)| {
        let mut steps = sequences.iter().flat_map(|placed| &placed.sequence.steps);
        steps.any(|step| step.switches.contains(&wanted) || turns(step, wanted.0))
    };
    step.waits.iter().copied().find(|&(watched, on)| {
        let Watched::Line(index) = watched else { return false };
        lines.get(usize::from(index)).is_some_and(|line| line.output && line.on != on) && !switched((index, on))
    })
}

/// An input is driven by one thing, and an output drives one.
pub fn check_lines(table: &Table, actuators: &[Actuator], rotors: &[Rotor], lines: &[LogicLine]) {
    let inputs = actuators.iter().flat_map(|row| row.inputs).flatten().chain(rotors.iter().map(|row| row.count));
    let outputs = actuators.iter().flat_map(|row| [Some(row.output), row.back]);
    let outputs = outputs.chain(rotors.iter().flat_map(|row| [Some(row.forward), row.backward])).flatten();
    for (what, list) in
        [("drives the input", inputs.collect::<Vec<_>>()), ("is moved by the output", outputs.collect())]
    {
        for (index, line) in list.iter().enumerate() {
            if list.get(..index).is_some_and(|before| before.contains(line)) {
                let name = lines.get(usize::from(*line)).map_or("?", |line| &line.name);
                table.error_here(format!("more than one thing {what} `{name}`"));
            }
        }
    }
}
