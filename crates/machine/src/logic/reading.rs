//! `[logic]` of a machine file, read: lines, sequences and what the outputs move.

use std::ops::Range;

use data::{Table, nearest};
use meaning::CodeLine;

use super::check::{check_lines, check_sequences};
use super::iron::{Actuator, Rotor};
use super::{LogicFate, LogicLine, LogicStep, LogicTable, Place, SPINDLE, Sequence, Watched};
use crate::path_table::{not_negative, positive};

/// Which codes go out at all: the digits on their lines, M S T B, and whether there is a B function.
#[derive(Clone, Copy)]
pub struct CodesOut {
    /// The digits on the lines of M, S, T and B.
    pub digits: [u8; 4],
    /// B is an axis.
    pub b_axis: bool,
}

/// The longest wait of a step if the builder says nothing, s.
const TIME_OUT_S: f64 = 10.0;
/// The most lines, and the most steps of a code.
pub const MOST: usize = 250;

/// Names while a file is read.
struct Names {
    lines: Vec<LogicLine>,
    rotors: Vec<Rotor>,
    timeout: f64,
}

/// A sequence with the places of its keys, as far as checks name them.
pub struct Placed {
    /// The sequence.
    pub sequence: Sequence,
    /// Where its code stands.
    pub code: Range<usize>,
    /// Where its steps stand.
    pub steps: Vec<Range<usize>>,
}

/// Reads `[logic]`.
pub(crate) fn logic(table: &mut Table, codes: CodesOut) -> LogicTable {
    let place = table.range();
    let mut lines: Vec<LogicLine> = Vec::new();
    for (key, output) in [("outputs", true), ("inputs", false)] {
        let place = table.place_of(key).unwrap_or_default();
        for name in table.strings(key).unwrap_or_default() {
            check_name(table, &place, &name, &lines);
            lines.push(LogicLine { name, output, on: false });
        }
    }
    if lines.len() > MOST {
        table.error(place, format!("there are {MOST} lines at most"));
        lines.truncate(MOST);
    }
    let place = table.place_of("on").unwrap_or_default();
    for name in table.strings("on").unwrap_or_default() {
        let known: Vec<String> = lines.iter().map(|line| line.name.clone()).collect();
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.on = true,
            None => unknown(table, &place, "line", &name, known.iter().map(String::as_str)),
        }
    }
    let timeout = not_negative(table, "timeout", TIME_OUT_S);
    let fates = [("keep", LogicFate::Keep), ("initial", LogicFate::Initial), ("finish", LogicFate::Finish)];
    let reset = table.choice("reset", &fates).unwrap_or_default();
    let emergency_stop = table.choice("emergency_stop", &fates[..2]).unwrap_or_default();
    let mut names = Names { lines, rotors: Vec::new(), timeout };
    let actuators: Vec<Actuator> = table.tables("actuators", |t| actuator(t, &names)).into_iter().flatten().collect();
    names.rotors = table.tables("rotors", |t| rotor(t, &names)).into_iter().flatten().collect();
    let sequences = table.tables("sequences", |t| sequence(t, &names));
    check_sequences(table, &sequences, &names.lines, &names.rotors, codes);
    check_lines(table, &actuators, &names.rotors, &names.lines);
    let sequences = sequences.into_iter().map(|placed| placed.sequence).collect();
    LogicTable { lines: names.lines, sequences, actuators, rotors: names.rotors, reset, emergency_stop }
}

/// A name is a word of its own, and none of the control's.
fn check_name(table: &Table, place: &Range<usize>, name: &str, lines: &[LogicLine]) {
    const CONTROLS: [&str; 13] =
        ["FIN", "DEN", "EOP", "RWD", "skip", "interrupt", "SAR", "ZSP", "ORE", "MF", "SF", "TF", "BF"];
    let word = name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.chars().all(|other| other.is_ascii_alphanumeric() || matches!(other, '-' | '_'));
    if !word {
        table.error(place.clone(), format!("`{name}` is no name of a line: a letter, then letters, digits, - and _"));
    } else if CONTROLS.contains(&name) || name.starts_with("UI") || name.starts_with("OT") {
        table.error(place.clone(), format!("`{name}` is a line of the control's; give yours another name"));
    } else if lines.iter().any(|line| line.name == name) {
        table.error(place.clone(), format!("the line `{name}` is named twice"));
    }
}

fn unknown<'n>(table: &Table, place: &Range<usize>, what: &str, name: &str, known: impl Iterator<Item = &'n str>) {
    let hint = nearest(name, known).map(|near| format!(", perhaps `{near}` is meant")).unwrap_or_default();
    table.error(place.clone(), format!("there is no {what} `{name}` in [logic]{hint}"));
}

impl Names {
    fn index(&self, table: &Table, place: &Range<usize>, name: &str, output: bool) -> Option<u8> {
        let kind = if output { "output" } else { "input" };
        let found = self.lines.iter().position(|line| line.output == output && line.name == name);
        if found.is_none() {
            let of_kind = self.lines.iter().filter(|line| line.output == output).map(|line| line.name.as_str());
            unknown(table, place, kind, name, of_kind);
        }
        found.and_then(|index| u8::try_from(index).ok())
    }

    /// The lines that a key names, each to stand so.
    fn watched(&self, table: &mut Table, key: &'static str, on: bool, into: &mut Vec<(Watched, bool)>) {
        let place = table.place_of(key).unwrap_or_default();
        for name in table.strings(key).unwrap_or_default() {
            let line = self.lines.iter().position(|line| line.name == name);
            let spindle = || SPINDLE.iter().find(|(own, _)| *own == name).map(|(_, says)| Watched::Spindle(*says));
            match line.and_then(|index| u8::try_from(index).ok()).map(Watched::Line).or_else(spindle) {
                Some(watched) => into.push((watched, on)),
                None => {
                    let known = self.lines.iter().map(|line| line.name.as_str());
                    unknown(table, &place, "line", &name, known.chain(SPINDLE.map(|(name, _)| name)));
                }
            }
        }
    }
}

/// A line that a key names.
fn line(table: &mut Table, key: &'static str, output: bool, names: &Names) -> Option<u8> {
    let place = table.place_of(key).unwrap_or_default();
    let name = table.string(key)?;
    names.index(table, &place, &name, output)
}

fn actuator(table: &mut Table, names: &Names) -> Option<Actuator> {
    table.require("output");
    let output = line(table, "output", true, names);
    let back = line(table, "back", true, names);
    let inputs = [line(table, "at_end", false, names), line(table, "at_rest", false, names)];
    let time = positive(table, "time", 0.5);
    let times = [time, positive(table, "time_back", time)];
    Some(Actuator { output: output?, back, inputs, times })
}

fn rotor(table: &mut Table, names: &Names) -> Option<Rotor> {
    let name = table.required_string("name");
    let forward = line(table, "forward", true, names);
    table.require("forward");
    let backward = line(table, "backward", true, names);
    let count = line(table, "count", false, names);
    table.require("count");
    table.require("positions");
    let positions = whole(table, "positions", 2, 2..=9999);
    let first = whole(table, "first", 1, 0..=9999);
    let step = whole(table, "step", 1, 1..=9999);
    let time = positive(table, "time", 0.5);
    Some(Rotor { name, positions, first, step, forward: forward?, backward, count: count?, time })
}

fn whole(table: &mut Table, key: &'static str, missing: u32, range: std::ops::RangeInclusive<u32>) -> u32 {
    let place = table.place_of(key).unwrap_or_default();
    match table.integer(key).map(u32::try_from) {
        None => missing,
        Some(Ok(value)) if range.contains(&value) => value,
        Some(_) => {
            table.error(place, format!("{key} is a number from {} to {}", range.start(), range.end()));
            missing
        }
    }
}

fn sequence(table: &mut Table, names: &Names) -> Placed {
    table.require("code");
    let place = table.place_of("code").unwrap_or_else(|| table.range());
    let written = table.string("code").unwrap_or_default();
    let code = read_code(&written);
    if code.is_none() && !written.is_empty() {
        table.error(place.clone(), format!("`{written}` is no code; write M06 for one code, B for all of B"));
    }
    let (line, code) = code.unwrap_or((CodeLine::M, None));
    table.require("steps");
    let mut steps = Vec::new();
    let mut places = Vec::new();
    for step in table.tables("steps", |t| (t.range(), self::step(t, names))) {
        places.push(step.0);
        steps.push(step.1);
    }
    if steps.len() > MOST {
        table.error(place.clone(), format!("a code has {MOST} steps at most"));
        steps.truncate(MOST);
    }
    Placed { sequence: Sequence { line, code, steps }, code: place, steps: places }
}

/// `M06`, `B`.
fn read_code(written: &str) -> Option<(CodeLine, Option<u32>)> {
    let mut rest = written.chars();
    let line = match rest.next()? {
        'M' => CodeLine::M,
        'S' => CodeLine::S,
        'T' => CodeLine::T,
        'B' => CodeLine::B,
        _ => return None,
    };
    let digits = rest.as_str();
    if digits.is_empty() {
        // Any M code is not one thing that a machine does.
        return (line != CodeLine::M).then_some((line, None));
    }
    let is_number = digits.bytes().all(|digit| digit.is_ascii_digit());
    digits.parse().ok().filter(|_| is_number).map(|code| (line, Some(code)))
}

fn step(table: &mut Table, names: &Names) -> LogicStep {
    let name = table.string("name").unwrap_or_default();
    let mut only_if = Vec::new();
    names.watched(table, "if_on", true, &mut only_if);
    names.watched(table, "if_off", false, &mut only_if);
    let mut switches = Vec::new();
    for (key, on) in [("clear", false), ("set", true)] {
        let place = table.place_of(key).unwrap_or_default();
        for name in table.strings(key).unwrap_or_default() {
            switches.extend(names.index(table, &place, &name, true).map(|index| (index, on)));
        }
    }
    let mut waits = Vec::new();
    names.watched(table, "wait_on", true, &mut waits);
    names.watched(table, "wait_off", false, &mut waits);
    let turns = turns(table, names);
    LogicStep {
        name,
        only_if,
        switches,
        turns,
        waits,
        seconds: not_negative(table, "time", 0.0),
        timeout: not_negative(table, "timeout", names.timeout),
        answers: table.boolean("fin").unwrap_or(false),
    }
}

/// `turn = "magazine"`, and `to`.
fn turns(table: &mut Table, names: &Names) -> Option<(usize, Place)> {
    let (place, place_to) = (table.place_of("turn"), table.place_of("to"));
    let to = table.integer("to").map(u32::try_from);
    let Some(name) = table.string("turn") else {
        if let Some(place) = place_to {
            table.error(place, "`to` wants `turn`, which says what turns there");
        }
        return None;
    };
    let Some(index) = names.rotors.iter().position(|rotor| rotor.name == name) else {
        let known = names.rotors.iter().map(|rotor| rotor.name.as_str());
        unknown(table, &place.unwrap_or_default(), "rotor", &name, known);
        return None;
    };
    let rotor = names.rotors.get(index)?;
    let to = match to {
        None => Place::OfCode,
        Some(Ok(code)) if rotor.position_of(code).is_some() => Place::At(code),
        Some(_) => {
            table.error(place_to.unwrap_or_default(), format!("`to` is no position of `{name}`"));
            Place::OfCode
        }
    };
    Some((index, to))
}
