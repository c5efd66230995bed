//! What a block leaves to the next one, value by value, and what it changed.
//!
//! Fields of the state that this file does not know by name are shown as they are: none is left out.

use base::{AXES, AxisSet, Point};
use dialect::Control;
use machine::MachineAxis;
use meaning::State;

use super::quantity::{coordinate, plain};

/// Fields that have a line of their own below, or none because they say nothing of the block (its own number).
#[rustfmt::skip]
const KNOWN: &[&str] = &[
    "groups", "feed", "spindle", "tool", "index", "h", "d", "machine", "base_origin", "common_shift", "universal_zero",
    "length", "length_due", "displacement", "cycle", "unknown", "sequence", "miscellaneous", "block_control",
    "feed_control", "memory_mark",
];

/// Fields of the cycle's data that have a line of their own below.
const KNOWN_OF_CYCLE: &[&str] = &["initial", "r", "bottom", "peck", "dwell"];

/// One value of the state.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Value {
    /// What it is.
    pub name: String,
    /// What it was before the block.
    pub before: String,
    /// What it is after it.
    pub after: String,
}

/// A state with what stands beside it.
#[derive(Clone, Copy)]
pub struct Moment<'m> {
    pub state: &'m State,
    /// Where the axes are, mm and degrees, machine coordinates.
    pub at: &'m Point,
    /// The same in program coordinates.
    pub program: &'m Point,
}

/// Every value that differs between two moments.
pub fn changes(control: &Control, axes: &[MachineAxis], before: Moment, after: Moment) -> Vec<Value> {
    let (before, after) = (values(control, axes, before), values(control, axes, after));
    let mut changed: Vec<Value> = Vec::new();
    for (name, now) in &after {
        let was = before.iter().find(|(known, _)| known == name).map_or("-", |(_, value)| value.as_str());
        if was != now {
            changed.push(Value { name: name.clone(), before: was.to_owned(), after: now.clone() });
        }
    }
    changed
}

/// The codes in force, in the order of their groups.
pub fn codes_in_force(control: &Control, state: &State) -> Vec<(u8, String)> {
    control.shown_groups().map(|(index, group)| (group.number, control.g_name(state.groups.0[index]))).collect()
}

fn values(control: &Control, axes: &[MachineAxis], moment: Moment) -> Vec<(String, String)> {
    let Moment { state, at, program } = moment;
    let mut list = Vec::new();
    for (index, group) in control.shown_groups() {
        let unknown = state.unknown.group(index);
        let code = if unknown { "unknown".to_owned() } else { control.g_name(state.groups.0[index]) };
        list.push((format!("group {:02} {}", group.number, group.name), code));
    }
    let word = |letter: u8, value: String| if state.unknown.word(letter) { "unknown".to_owned() } else { value };
    list.push(("F".to_owned(), word(b'F', feed(state))));
    let numbers = [(b'S', state.spindle), (b'T', state.tool), (b'B', state.index), (b'H', state.h), (b'D', state.d)];
    for (letter, value) in numbers {
        list.push((char::from(letter).to_string(), word(letter, value.to_string())));
    }
    list.push(("length offset".to_owned(), coordinate(state.length / 1e6)));
    list.push(("length offset still to be moved".to_owned(), coordinate(state.length_due / 1e6)));
    let counts = |point: &Point| point.map(|value| value / 1e6);
    points(axes, "machine", at, state.unknown.axes, &mut list);
    points(axes, "program", program, state.unknown.axes, &mut list);
    points(axes, "base origin", &counts(&state.base_origin), state.unknown.origins, &mut list);
    points(axes, "shift of all systems", &counts(&state.common_shift), AxisSet::NONE, &mut list);
    points(axes, "zero of the UNIVERSAL display", &counts(&state.universal_zero), AxisSet::NONE, &mut list);
    points(axes, "displacement", &counts(&state.displacement), AxisSet::NONE, &mut list);
    let level = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |counts| coordinate(counts / 1e6));
    let cycle = &state.cycle;
    // Without a cycle there is no such level.
    let initial = (*cycle != Default::default()).then_some(cycle.initial);
    list.push(("cycle: initial level (machine, without length offset)".to_owned(), level(initial)));
    list.push(("cycle: R level".to_owned(), level(cycle.r)));
    list.push(("cycle: bottom".to_owned(), level(cycle.bottom)));
    list.push(("cycle: Q".to_owned(), coordinate(cycle.peck / 1e6)));
    list.push(("cycle: dwell".to_owned(), format!("{} s", plain(cycle.dwell, 3))));
    list.push(("M last commanded".to_owned(), state.miscellaneous.to_string()));
    list.push(("#3003".to_owned(), state.block_control.to_string()));
    list.push(("#3004".to_owned(), state.feed_control.to_string()));
    for (name, value) in fields(&format!("{cycle:?}")) {
        if !KNOWN_OF_CYCLE.contains(&name.as_str()) {
            other(axes, &format!("cycle: {}", name.replace('_', " ")), &value, &mut list);
        }
    }
    for (name, value) in fields(&format!("{state:?}")) {
        if !KNOWN.contains(&name.as_str()) {
            other(axes, &name.replace('_', " "), &value, &mut list);
        }
    }
    list
}

/// A value known by what the compiler prints of it: structures field by field, points axis by axis, sets by letters.
fn other(axes: &[MachineAxis], name: &str, value: &str, list: &mut Vec<(String, String)>) {
    let value = value.strip_prefix("Some(").and_then(|rest| rest.strip_suffix(')')).unwrap_or(value);
    if value == "None" {
        return list.push((name.to_owned(), "-".to_owned()));
    }
    let within = fields(value);
    if !within.is_empty() {
        // Where nothing is mirrored its line means nothing.
        let plain = within.iter().any(|(field, value)| field == "mirror" && value == "false");
        for (field, value) in within.iter().filter(|(field, _)| !(plain && field == "line")) {
            other(axes, &format!("{name}: {}", field.replace('_', " ")), value, list);
        }
        return;
    }
    let inside = |open: &str, close| value.strip_prefix(open).and_then(|rest: &str| rest.strip_suffix(close));
    if let Some(bits) = inside("AxisSet(", ')').and_then(|bits| bits.parse().ok()) {
        let set = AxisSet(bits);
        let letters: String = axes
            .iter()
            .enumerate()
            .filter(|(axis, _)| set.has(*axis))
            .map(|(_, axis)| char::from(axis.letter))
            .collect();
        list.push((name.to_owned(), if letters.is_empty() { "-".to_owned() } else { letters }));
        return;
    }
    let counts: Option<Vec<f64>> =
        inside("[", ']').map(|list| list.split(',').filter_map(|number| number.trim().parse().ok()).collect());
    // Of a list of three the axes are the first three.
    match counts.filter(|counts| matches!(counts.len(), 3 | AXES)) {
        // Lengths of the state are counts.
        Some(counts) => {
            for (axis, counts) in axes.iter().zip(counts) {
                list.push((format!("{name} {}", char::from(axis.letter)), coordinate(counts / 1e6)));
            }
        }
        None if !value.starts_with('[') => list.push((name.to_owned(), shortened(value))),
        None => {
            let parts = value.trim_matches(['[', ']']).split(',').filter_map(|part| part.trim().parse::<f64>().ok());
            let parts: Vec<_> = parts.map(|counts| coordinate(counts / 1e6)).collect();
            list.push((name.to_owned(), shortened(&parts.join(" "))));
        }
    }
}

/// A value that has no form of its own, short enough for its line.
fn shortened(value: &str) -> String {
    const MOST: usize = 24;
    match value.char_indices().nth(MOST) {
        Some((at, _)) => format!("{}…", value.get(..at).unwrap_or_default()),
        None => value.to_owned(),
    }
}

fn feed(state: &State) -> String {
    let unit = if state.feed.per_revolution { "mm/rev" } else { "mm/min" };
    match state.feed.nanometres {
        0.0 => "-".to_owned(),
        nanometres => format!("{} {unit}", plain(nanometres / 1e6, 4)),
    }
}

fn points(axes: &[MachineAxis], what: &str, point: &Point, unknown: AxisSet, list: &mut Vec<(String, String)>) {
    for (index, axis) in axes.iter().enumerate().take(AXES) {
        let value = if unknown.has(index) { "unknown".to_owned() } else { coordinate(point[index]) };
        list.push((format!("{what} {}", char::from(axis.letter)), value));
    }
}

/// The fields of a structure as the compiler prints it: `Name { field: value, field: value }`.
fn fields(printed: &str) -> Vec<(String, String)> {
    let inside = printed.split_once('{').map_or("", |(_, rest)| rest).trim_end().trim_end_matches('}');
    let (mut found, mut depth, mut from) = (Vec::new(), 0i32, 0);
    for (at, letter) in inside.char_indices().chain([(inside.len(), ',')]) {
        match letter {
            '{' | '[' | '(' => depth += 1,
            '}' | ']' | ')' => depth -= 1,
            ',' if depth == 0 => {
                if let Some((name, value)) = inside.get(from..at).and_then(|field| field.split_once(':')) {
                    found.push((name.trim().to_owned(), value.trim().to_owned()));
                }
                from = at + 1;
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fields_of_a_structure_are_found_whatever_they_hold() {
        let found = fields("S { a: [1, 2], b: T { c: (1, 2), d: None }, e: Some(3) }");
        let names: Vec<_> = found.iter().map(|(name, value)| format!("{name}={value}")).collect();
        assert_eq!(names, ["a=[1, 2]", "b=T { c: (1, 2), d: None }", "e=Some(3)"]);
        assert!(fields("Nothing").is_empty());
    }
}
