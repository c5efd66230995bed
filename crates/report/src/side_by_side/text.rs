//! A comparison for people at a terminal.

use std::fmt::Write as _;

use station::Configuration;

use super::comparison::{Comparison, Deviation, Seen};
use crate::explain::happening;
use crate::paint::Paint;
use crate::summary::{Summary, clock, short};
use crate::trace::Tracer;

/// Where the columns of the table begin.
const COLUMNS: [usize; 3] = [20, 40, 60];

/// The comparison; programs are named as the user named them.
pub fn comparison_text(comparison: &Comparison, sides: [(&str, &Configuration); 2], paint: Paint) -> String {
    let mut out = String::new();
    for (letter, (file, configuration)) in ["A", "B"].into_iter().zip(sides) {
        let (control, machine) = (&configuration.control.name, &configuration.machine.name);
        let _ = writeln!(out, "{}  {file}  {}", paint.strong(letter), paint.dim(&format!("{control} on {machine}")));
    }
    out.push('\n');
    if comparison.is_same() {
        let _ = writeln!(out, "{}\n", paint.heading("the same at the machine"));
    }
    for (index, deviation) in comparison.deviations.iter().enumerate() {
        one(deviation, index == 0, sides, paint, &mut out);
    }
    events(comparison, &mut out);
    out.push('\n');
    table(&comparison.summaries, &mut out);
    let lines: Vec<&str> = out.lines().map(str::trim_end).collect();
    lines.join("\n") + "\n"
}

fn counted(count: u64, one: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {one}s") }
}

fn events(comparison: &Comparison, out: &mut String) {
    let [only_a, only_b] = comparison.only;
    let (same, changed) = (counted(comparison.same, "event"), comparison.changed);
    if comparison.is_same() {
        let _ = writeln!(out, "{same} the same");
    } else {
        let _ = writeln!(out, "{same} the same, {changed} changed, {only_a} only in A, {only_b} only in B");
    }
    let shown = comparison.deviations.len() as u64;
    let rest = (changed + only_a + only_b).saturating_sub(shown);
    if rest > 0 {
        let _ = writeln!(out, "{} more not shown: --show says how many are", counted(rest, "difference"));
    }
}

fn one(deviation: &Deviation, first: bool, sides: [(&str, &Configuration); 2], paint: Paint, out: &mut String) {
    let which = if first { "first difference" } else { "difference" };
    let after = counted(deviation.after, "event");
    let _ = writeln!(out, "{}", paint.heading(&format!("{which}, after {after} the same")));
    for (side, letter) in ["A", "B"].into_iter().enumerate() {
        let _ = write!(out, "  {}  ", paint.strong(letter));
        let Some(seen) = &deviation.sides[side] else {
            let _ = writeln!(out, "nothing more");
            continue;
        };
        let place = place(seen);
        if deviation.missing == Some(side) {
            let _ = writeln!(out, "nothing; it goes on with {place}  {}", paint.strong(&seen.block));
        } else {
            let _ = writeln!(out, "{place}  {}", paint.strong(&seen.block));
            for line in in_words(seen, sides[side].1) {
                let _ = writeln!(out, "       {line}");
            }
        }
    }
    for (name, a, b) in &deviation.parts {
        let _ = writeln!(out, "     {}", paint.changed(&format!("{name}: {a} in A, {b} in B")));
    }
    out.push('\n');
}

fn place(seen: &Seen) -> String {
    let line = seen.event.place.line;
    match &seen.program {
        Some(program) => format!("{program} line {line}"),
        None => format!("line {line}"),
    }
}

/// What happens, as an explanation says it.
fn in_words(seen: &Seen, configuration: &Configuration) -> Vec<String> {
    if let Some(diagnostic) = &seen.diagnostic {
        let name = diagnostic.alarm.as_ref().map_or("", |alarm| alarm.name.as_str());
        return vec![format!("alarm {name}: {}", diagnostic.message)];
    }
    match happening(&configuration.control, &configuration.machine.axes, &seen.event) {
        Some(found) => {
            let details = found.details.lines().map(str::to_owned);
            let mut lines: Vec<String> = details.collect();
            if let Some(line) = lines.first_mut() {
                *line = format!("{}  {line}", found.what);
            }
            lines
        }
        None => vec![Tracer::event_word(&seen.event.kind).to_owned()],
    }
}

fn row(name: &str, cells: [&str; 3], out: &mut String) {
    let mut line = format!("  {name}");
    for (cell, &at) in cells.iter().zip(&COLUMNS) {
        let gap = at.saturating_sub(line.chars().count()).max(2);
        line.push_str(&" ".repeat(if cell.is_empty() { 0 } else { gap }));
        line.push_str(cell);
    }
    out.push_str(&line);
    out.push('\n');
}

fn table(summaries: &[Summary; 2], out: &mut String) {
    let [a, b] = summaries;
    row("", ["A", "B", "B - A"], out);
    row("end", [a.end_word(), b.end_word(), ""], out);
    let count = |name: &str, pick: fn(&Summary) -> u64, out: &mut String| {
        let (one, two) = (pick(a), pick(b));
        let change = if one == two { String::new() } else { format!("{:+}", two as i128 - one as i128) };
        row(name, [&one.to_string(), &two.to_string(), &change], out);
    };
    count("moves", |summary| summary.moves, out);
    let length = |name: &str, pick: fn(&Summary) -> f64, out: &mut String| {
        let (one, two) = (pick(a), pick(b));
        let change = if short(two - one) == "0" { String::new() } else { signed(short(two - one)) };
        row(name, [&format!("{} mm", short(one)), &format!("{} mm", short(two)), &change], out);
    };
    length("cutting path", |summary| summary.cutting_mm, out);
    length("rapid path", |summary| summary.rapid_mm, out);
    let mut letters: Vec<char> = a.axes.clone();
    letters.extend(b.axes.iter().filter(|letter| !a.axes.contains(letter)));
    for letter in letters {
        let travel = [a, b].map(|summary| summary.extent(letter));
        let [one, two] = travel.map(|travel| travel.map_or_else(|| "-".to_owned(), range));
        let differs = match travel {
            [Some(_), Some(_)] => one != two,
            // An axis that one of the machines has not makes a difference when it moves.
            [a, b] => a.or(b).is_some_and(|[low, high]| low != high),
        };
        row(&format!("travel {letter}"), [&one, &two, if differs { "differs" } else { "" }], out);
    }
    let time = |name: &str, pick: fn(&Summary) -> f64, out: &mut String| {
        let (one, two) = (pick(a), pick(b));
        let change = if short(two - one) == "0" { String::new() } else { signed(short(two - one)) + " s" };
        row(name, [&seconds(one), &seconds(two), &change], out);
    };
    time("cutting", |summary| summary.times.cutting, out);
    time("rapid", |summary| summary.times.rapid, out);
    time("dwell", |summary| summary.times.dwell, out);
    time("waiting for FIN", |summary| summary.times.waiting, out);
    time("cycle time", Summary::total, out);
    count("alarms", |summary| summary.alarm_count, out);
}

fn range([low, high]: [f64; 2]) -> String {
    format!("{} … {}", short(low), short(high))
}

/// To the millisecond as long as that says something.
fn seconds(value: f64) -> String {
    if value < 60.0 { format!("{} s", short(value)) } else { clock(value) }
}

fn signed(number: String) -> String {
    if number.starts_with('-') { number } else { format!("+{number}") }
}
