//! An explanation for people at a terminal.

use std::fmt::Write as _;

use dialect::Control;
use machine::MachineAxis;

use super::beside::beside_lines;
use super::happening::{Happening, happening};
use super::words::WordLine;
use super::{Explanation, Value, plain};
use crate::face::{Format, render};
use crate::paint::{Paint, wrap};

/// Lines of what a block does that are shown before and after the gap in a long list.
const FIRST: usize = 16;
const LAST: usize = 6;

/// An explanation in lines of text.
pub fn explanation_text(explanation: &Explanation, control: &Control, axes: &[MachineAxis], paint: Paint) -> String {
    let mut out = String::new();
    head(explanation, paint, &mut out);
    words(&explanation.words, paint, &mut out);
    does(explanation, control, axes, paint, &mut out);
    if let Some((diagnostic, excerpt)) = &explanation.alarm {
        out.push('\n');
        out.push_str(&render(diagnostic, excerpt, Format::Text { colour: paint.colour }));
    }
    changes(explanation, paint, &mut out);
    policies(explanation, paint, &mut out);
    sources(&explanation.words, paint, &mut out);
    // A column that is empty in a line leaves no blanks behind.
    let lines: Vec<&str> = out.lines().map(str::trim_end).collect();
    lines.join("\n") + "\n"
}

fn head(explanation: &Explanation, paint: Paint, out: &mut String) {
    let place = format!("{}:{}", explanation.file, explanation.line);
    let runs = match explanation.pass {
        Some((1, 1)) if explanation.alarm.is_some() => "refused".to_owned(),
        Some((1, 1)) => "executed once".to_owned(),
        Some((pass, of)) => format!("execution {pass} of {of}"),
        None => "not reached".to_owned(),
    };
    let gap = paint.width.saturating_sub(place.len() + explanation.program.len() + runs.len() + 2);
    let _ = writeln!(
        out,
        "{}  {}{}{}",
        paint.strong(&place),
        explanation.program,
        " ".repeat(gap.max(2)),
        paint.dim(&runs)
    );
    let _ = writeln!(out, "{}\n{}\n{}", paint.rule(), paint.strong(explanation.text.trim_end()), paint.rule());
    if let Some(note) = &explanation.note {
        for line in wrap(note, paint.width) {
            let _ = writeln!(out, "{}", paint.idle(&line));
        }
    }
}

fn heading(paint: Paint, text: &str, remark: &str, out: &mut String) {
    let gap = paint.width.saturating_sub(text.chars().count() + remark.chars().count()).max(2);
    let _ = writeln!(out, "\n{}{}{}", paint.heading(text), " ".repeat(gap), paint.dim(remark));
}

fn words(words: &[WordLine], paint: Paint, out: &mut String) {
    if words.is_empty() {
        return;
    }
    heading(paint, "WORDS", "the letter says how sure, see SOURCES", out);
    let longest = |of: fn(&WordLine) -> usize, least: usize, most: usize| {
        words.iter().map(of).filter(|&len| len <= most).max().unwrap_or(0).max(least)
    };
    let word_width = longest(|line| line.word.chars().count(), 5, 14);
    let value_width = longest(|line| line.value.chars().count(), 0, 14);
    let indent = 2 + word_width + 2 + 3 + value_width + if value_width > 0 { 2 } else { 0 };
    for line in words {
        let mark = line.origin.as_ref().map_or(' ', |origin| origin.certainty.0);
        let word = format!("{:<word_width$}", line.word);
        let word = match (line.refused, line.acts) {
            (true, _) => paint.alarm(&word),
            (_, false) => paint.dim(&word),
            _ => paint.strong(&word),
        };
        let value = format!("{:>value_width$}", line.value);
        let value = if value_width > 0 { format!("{value}  ") } else { value };
        let _ = write!(out, "  {word}  {}  {value}", paint.dim(&mark.to_string()));
        // A word too long for its column leaves the rest of the line.
        let too_long = line.word.chars().count() > word_width || line.value.chars().count() > value_width;
        if too_long {
            let _ = write!(out, "\n{}", " ".repeat(indent));
        }
        for (index, text) in wrap(&line.says, paint.width.saturating_sub(indent).max(24)).iter().enumerate() {
            let text = if line.acts || line.refused { text.clone() } else { paint.idle(text) };
            let indent = if index == 0 { 0 } else { indent };
            let _ = writeln!(out, "{}{text}", " ".repeat(indent));
        }
    }
}

fn does(explanation: &Explanation, control: &Control, axes: &[MachineAxis], paint: Paint, out: &mut String) {
    let list: Vec<Happening> = (0..explanation.events.len())
        .filter_map(|index| {
            let mut line = happening(control, axes, explanation.events.get(index)?)?;
            for more in beside_lines(&explanation.events, &explanation.beside, index, axes) {
                line.details.push('\n');
                line.details.push_str(&more);
            }
            Some(line)
        })
        .collect();
    if let Some((wrote, goes_to)) = &explanation.statement {
        heading(paint, "WHAT IT DOES", "carried out as it is read, ahead of the motion", out);
        if let Some(wrote) = wrote {
            let _ = writeln!(out, "  {wrote}");
        }
        let _ = writeln!(out, "  the program goes on at line {goes_to}");
        return;
    }
    if list.is_empty() {
        if explanation.alarm.is_none() {
            heading(paint, "WHAT IT DOES", "", out);
            let _ = writeln!(out, "  nothing moves and nothing goes out to the machine");
        }
        return;
    }
    let timed = list.iter().any(|line| line.seconds.is_some());
    let remark = match (list.iter().any(|line| line.moves), timed) {
        (true, _) => "machine coordinates of the spindle, mm          s",
        (false, true) => "s",
        (false, false) => "",
    };
    heading(paint, "WHAT IT DOES", remark, out);
    let hidden =
        explanation.event_count.saturating_sub(explanation.events.len()) + list.len().saturating_sub(FIRST + LAST + 1);
    let mut hole = 0;
    for (index, line) in list.iter().enumerate() {
        hole += usize::from(line.goes_over);
        if hidden > 0 && index >= FIRST && index + LAST < list.len() {
            if index == FIRST {
                let _ = writeln!(out, "  {}", paint.dim(&format!("… {hidden} more …")));
            }
            continue;
        }
        let number = match explanation.in_cycle && line.goes_over {
            true => format!("{hole:>4}"),
            false => "    ".to_owned(),
        };
        let reset = line.resets.map_or(String::new(), |groups| reset_codes(explanation, control, &groups));
        let mut whole = format!("{}{reset}", line.details);
        let room = paint.width.saturating_sub(16);
        if whole.lines().any(|line| line.chars().count() > room) {
            whole = wrap(&whole, room).join("\n");
        }
        let mut details = whole.lines();
        let seconds = line.seconds.map_or(String::new(), |seconds| format!("{seconds:.2}"));
        let text = details.next().unwrap_or_default();
        let gap = paint.width.saturating_sub(16 + text.chars().count() + seconds.len()).max(1);
        let _ = writeln!(
            out,
            "{} {}{text}{}{}",
            paint.dim(&number),
            format_args!("{:<11}", line.what),
            " ".repeat(gap),
            paint.dim(&seconds)
        );
        for more in details {
            let _ = writeln!(out, "{:16}{}", "", paint.dim(more));
        }
    }
    let total: f64 = list.iter().filter_map(|line| line.seconds).sum();
    if list.len() > 1 && total > 0.0 && hidden == 0 {
        let total = format!("{} s", plain(total, 2));
        let gap = paint.width.saturating_sub(16 + total.len() + 9);
        let _ = writeln!(out, "{:16}{}{}", "", " ".repeat(gap), paint.dim(&format!("together {total}")));
    }
}

/// What a reset changes in the codes that the block left in force.
fn reset_codes(explanation: &Explanation, control: &Control, groups: &dialect::GroupCodes) -> String {
    let [_, left] = &explanation.in_force;
    let now = control.shown_groups().map(|(index, _)| control.g_name(groups.0[index]));
    let changed: Vec<_> = left.iter().zip(now).filter(|((_, was), now)| was != now).collect();
    let changed: Vec<_> = changed.into_iter().map(|((_, was), now)| format!("{was} → {now}")).collect();
    if changed.is_empty() { String::new() } else { format!(": {}", changed.join(", ")) }
}

fn changes(explanation: &Explanation, paint: Paint, out: &mut String) {
    if explanation.statement.is_some() {
        return;
    }
    if explanation.alarm.is_some() && explanation.changes.is_empty() {
        return;
    }
    heading(paint, "STATE", "before → after", out);
    if explanation.changes.is_empty() {
        let _ = writeln!(out, "  nothing changes");
    }
    let width = explanation.changes.iter().map(|value| value.name.chars().count()).max().unwrap_or(0).min(46);
    for Value { name, before, after } in &explanation.changes {
        let _ = writeln!(out, "  {name:<width$}  {} → {}", paint.dim(&format!("{before:>12}")), paint.changed(after));
    }
    let [before, after] = &explanation.in_force;
    let codes: Vec<String> = after
        .iter()
        .filter(|(_, code)| code != "-")
        .map(|code| if before.contains(code) { code.1.clone() } else { paint.changed(&code.1) })
        .collect();
    let _ = writeln!(out, "  {}  {}", paint.dim("in force"), codes.join(" "));
}

fn policies(explanation: &Explanation, paint: Paint, out: &mut String) {
    if explanation.policies.is_empty() {
        return;
    }
    heading(paint, "POLICIES", "where the maker's text is silent; --policy NAME=VALUE", out);
    for policy in &explanation.policies {
        let mark = policy.origin.certainty.0.to_string();
        let _ = writeln!(out, "  {} = {}  {}", policy.name, paint.strong(&policy.value), paint.dim(&mark));
        for line in wrap(&policy.text, paint.width.saturating_sub(4)) {
            let _ = writeln!(out, "    {}", paint.dim(&line));
        }
    }
}

/// Where it stands: words that rest on the same source share a line.
fn sources(words: &[WordLine], paint: Paint, out: &mut String) {
    let mut list: Vec<(char, &str, Vec<&str>)> = Vec::new();
    for line in words {
        let Some(origin) = &line.origin else { continue };
        let word = line.word.as_str();
        let word = word.trim_matches(['(', ')']);
        let letter = word.get(..1).unwrap_or(word);
        // Codes have rows of their own, other words that of their letter.
        let name = if matches!(letter, "G" | "M") { word } else { letter };
        match list.iter_mut().find(|(mark, source, _)| *mark == origin.certainty.0 && *source == origin.source) {
            Some((_, _, names)) if !names.contains(&name) => names.push(name),
            Some(_) => {}
            None => list.push((origin.certainty.0, &origin.source, vec![name])),
        }
    }
    if list.is_empty() {
        return;
    }
    heading(paint, "SOURCES", "", out);
    for (mark, source, names) in list {
        let names = names.join(" ");
        let lines = wrap(&format!("{names}: {source}"), paint.width.saturating_sub(5));
        for (index, line) in lines.iter().enumerate() {
            let mark = if index == 0 { mark } else { ' ' };
            let _ = writeln!(out, "  {mark}  {}", paint.dim(line));
        }
    }
}
