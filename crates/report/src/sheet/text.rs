//! The set-up sheet in lines of text.

use meaning::EndKind;
use std::fmt::Write as _;

use super::tool::{Operation, Range};
use super::{OffsetUse, Sheet, ToolSheet, WorkSystem, tool_name};
use crate::explain::plain;
use crate::paint::{Paint, wrap};
use crate::summary::clock;
use crate::trace::end_name;

/// The sheet for people at a terminal.
pub fn sheet_text(sheet: &Sheet, paint: Paint) -> String {
    let mut out = String::new();
    head(sheet, paint, &mut out);
    for tool in &sheet.tools {
        tool_lines(sheet, tool, paint, &mut out);
    }
    offsets(sheet, paint, &mut out);
    systems(sheet, paint, &mut out);
    starts(sheet, paint, &mut out);
    travel(sheet, paint, &mut out);
    codes(sheet, paint, &mut out);
    lists(sheet, paint, &mut out);
    let lines: Vec<&str> = out.lines().map(str::trim_end).collect();
    lines.join("\n") + "\n"
}

/// A coordinate or offset.
pub(super) fn mm(value: f64) -> String {
    let text = format!("{value:.3}");
    if text == "-0.000" { "0.000".to_owned() } else { text }
}

/// Lowest and highest value, or the one there is.
pub(super) fn span(range: Range, decimals: usize) -> String {
    if range.low == range.high {
        plain(range.low, decimals)
    } else {
        format!("{} – {}", plain(range.low, decimals), plain(range.high, decimals))
    }
}

/// What a piece of work is, in one line.
pub(super) fn operation(operation: &Operation) -> String {
    let mut text = match operation.code.is_empty() {
        true => format!("{}, {} mm", operation.text, plain(operation.length, 1)),
        false => {
            let holes = if operation.holes == 1 { "1 hole" } else { &format!("{} holes", operation.holes) };
            format!("{} {}, {holes}", operation.code, operation.text)
        }
    };
    if let Some(depth) = operation.depth {
        let _ = write!(text, ", down to Z {}", mm(depth));
    }
    text
}

/// How a program ended, in words.
pub(super) fn ending(sheet: &Sheet) -> String {
    match (sheet.end, &sheet.alarm) {
        (_, Some(_)) => "STOPPED BY AN ALARM: this sheet is not complete".to_owned(),
        (Some(EndKind::Text), None) => "runs to the end of the text, without M02 or M30".to_owned(),
        (Some(EndKind::Loop), None) => "never ends: it goes round for ever with nothing changed".to_owned(),
        (Some(end), None) => format!("runs to {}", end_name(end)),
        (None, None) => "does not end".to_owned(),
    }
}

fn heading(paint: Paint, text: &str, remark: &str, out: &mut String) {
    let gap = paint.width.saturating_sub(text.chars().count() + remark.chars().count()).max(2);
    let _ = writeln!(out, "\n{}{}{}", paint.heading(text), " ".repeat(gap), paint.dim(remark));
}

fn head(sheet: &Sheet, paint: Paint, out: &mut String) {
    let right = format!("{} · {}", sheet.control, sheet.machine);
    let title = format!("SET-UP SHEET  {}", sheet.program);
    let gap = paint.width.saturating_sub(title.chars().count() + right.chars().count()).max(2);
    let _ = writeln!(out, "{}{}{}", paint.strong(&title), " ".repeat(gap), paint.dim(&right));
    let _ = writeln!(out, "{}", paint.rule());
    for line in &sheet.header {
        let _ = writeln!(out, "{line}");
    }
    if !sheet.header.is_empty() {
        let _ = writeln!(out, "{}", paint.rule());
    }
    let end = ending(sheet);
    let end = if sheet.alarm.is_some() { paint.alarm(&end) } else { end };
    let _ = writeln!(out, "{end}");
    if let Some(text) = &sheet.alarm_text {
        for line in wrap(text, paint.width) {
            let _ = writeln!(out, "{}", paint.alarm(&line));
        }
    }
    let times = sheet.times;
    let _ = writeln!(
        out,
        "cycle time {}\n  cutting {} · rapid {} · dwell {} · waiting {}",
        paint.strong(&clock(times.total)),
        clock(times.cutting),
        clock(times.rapid),
        clock(times.dwell),
        clock(times.waiting)
    );
}

fn tool_lines(sheet: &Sheet, tool: &ToolSheet, paint: Paint, out: &mut String) {
    let place = if tool.first.line > 0 { sheet.place(&tool.first) } else { String::new() };
    heading(paint, &tool_name(tool.tool).to_uppercase(), &place, out);
    for remark in &tool.remarks {
        let _ = writeln!(out, "  {remark}");
    }
    let list = |numbers: &std::collections::BTreeSet<u32>, letter: char| {
        let list: Vec<_> = numbers.iter().map(|number| format!("{letter}{number:02}")).collect();
        if list.is_empty() { String::new() } else { format!("{}   ", list.join(" ")) }
    };
    let speeds = tool.speeds.map_or_else(|| "no S".to_owned(), |range| format!("S {}", span(range, 0)));
    let feeds = tool.feeds.map_or_else(|| "no feed".to_owned(), |range| format!("F {} mm/min", span(range, 1)));
    let _ = writeln!(out, "  {}{}{speeds}   {feeds}", list(&tool.h, 'H'), list(&tool.d, 'D'));
    let _ = writeln!(out, "  cutting {} of {}", clock(tool.cutting), clock(tool.total));
    if let Some(lowest) = &tool.lowest {
        let _ = writeln!(
            out,
            "  lowest Z  {} in {}, {}\n            machine coordinates: tip {}, spindle {}",
            paint.strong(&mm(lowest.program)),
            lowest.system,
            sheet.place(&lowest.spot),
            mm(lowest.tip),
            mm(lowest.machine)
        );
    }
    let mut systems: Vec<&str> = tool.extents.iter().map(|(system, ..)| system.as_str()).collect();
    systems.dedup();
    for system in systems {
        let parts = tool.extents.iter().filter(|(own, ..)| own == system);
        let parts: Vec<_> =
            parts.map(|(_, axis, range)| format!("{axis} {} … {}", mm(range.low), mm(range.high))).collect();
        let _ = writeln!(out, "  cuts in {system}  {}", parts.join("   "));
    }
    for work in &tool.operations {
        let place = sheet.place(&work.first);
        let text = format!("• {}", operation(work));
        let gap = paint.width.saturating_sub(2 + text.chars().count() + place.len()).max(2);
        let _ = writeln!(out, "  {text}{}{}", " ".repeat(gap), paint.dim(&place));
    }
}

/// What is missing of an offset, if its cell is empty.
pub(super) fn missing(offset: &OffsetUse) -> bool {
    offset.value == 0.0
}

/// True if a work system has not been set up: every coordinate of its origin is zero.
pub(super) fn unset(system: &WorkSystem) -> bool {
    !system.base && system.origin.iter().all(|(_, at)| *at == 0.0)
}

fn offsets(sheet: &Sheet, paint: Paint, out: &mut String) {
    if sheet.offsets.is_empty() {
        return;
    }
    heading(paint, "OFFSETS", "mm, as set up", out);
    for offset in &sheet.offsets {
        let tools: Vec<_> = offset.tools.iter().map(|tool| tool_name(*tool)).collect();
        let note = if missing(offset) { paint.idle("  zero: not set up?") } else { String::new() };
        let _ = writeln!(
            out,
            "  {}{:02}  {:>10}  {}{note}",
            offset.letter,
            offset.number,
            mm(offset.value),
            tools.join(", ")
        );
    }
}

fn systems(sheet: &Sheet, paint: Paint, out: &mut String) {
    if sheet.systems.is_empty() {
        return;
    }
    heading(paint, "WORK SYSTEMS", "origin as set up, machine coordinates", out);
    for system in &sheet.systems {
        let origin: Vec<_> = system.origin.iter().map(|(axis, at)| format!("{axis} {:>9}", mm(*at))).collect();
        let note = match (system.base, unset(system)) {
            (true, _) => paint.dim("  base system"),
            (_, true) => paint.idle("  all zero: not set up?"),
            _ => String::new(),
        };
        let _ = writeln!(out, "  {}  {}  {}{note}", system.name, origin.join("  "), sheet.place(&system.first));
    }
}

fn starts(sheet: &Sheet, paint: Paint, out: &mut String) {
    if sheet.starts.is_empty() {
        return;
    }
    heading(paint, "START POSITION", "where the axes stand when G92 names the place, machine", out);
    for start in &sheet.starts {
        let axes: Vec<_> = start.axes.iter().map(|(axis, at, _)| format!("{axis} {}", mm(*at))).collect();
        let _ = writeln!(out, "  {:<10} {}", sheet.place(&start.spot), axes.join("   "));
        let by_hand: String = start.axes.iter().filter(|(.., hand)| *hand).map(|(axis, ..)| *axis).collect();
        if !by_hand.is_empty() {
            let text = format!(
                "{by_hand}: rely on where they are put before CYCLE START, for the program does not return them to the reference point first"
            );
            for line in wrap(&text, paint.width.saturating_sub(13)) {
                let _ = writeln!(out, "{:13}{}", "", paint.idle(&line));
            }
        }
    }
}

fn travel(sheet: &Sheet, paint: Paint, out: &mut String) {
    heading(paint, "TRAVEL", "used, and the axis' limits; machine coordinates", out);
    for (axis, [low, high], [least, most]) in &sheet.travel {
        let _ = writeln!(
            out,
            "  {axis}  {:>10} … {:>9}   of {} … {}",
            mm(*low),
            mm(*high),
            plain(*least, 3),
            plain(*most, 3)
        );
    }
}

fn codes(sheet: &Sheet, paint: Paint, out: &mut String) {
    if sheet.codes.is_empty() {
        return;
    }
    heading(paint, "M AND B CODES", "how often, first line", out);
    let width = sheet.codes.iter().map(|code| sheet.place(&code.first).chars().count()).max().unwrap_or(0);
    let indent = 18 + width;
    for code in &sheet.codes {
        let text = code.text.as_deref().unwrap_or("the machine builder's");
        let count = format!("{}×", code.count);
        let first = sheet.place(&code.first);
        let lines = wrap(text, paint.width.saturating_sub(indent));
        for (index, line) in lines.iter().enumerate() {
            let line = if code.text.is_none() { paint.idle(line) } else { line.clone() };
            if index == 0 {
                let _ = writeln!(out, "  {:<5} {count:>6}  {first:<width$}  {line}", code.name);
            } else {
                let _ = writeln!(out, "{:indent$}{line}", "");
            }
        }
    }
}

fn lists(sheet: &Sheet, paint: Paint, out: &mut String) {
    if !sheet.stops.is_empty() {
        heading(paint, "STOPS", "", out);
        for stop in &sheet.stops {
            let times = if stop.count > 1 { format!("  {}×", stop.count) } else { String::new() };
            let _ = writeln!(
                out,
                "  {:<5} {:<10} {}{times}",
                stop.name,
                sheet.place(&stop.spot),
                paint.strong(&stop.remark)
            );
        }
    }
    if !sheet.called.is_empty() {
        heading(paint, "SUBPROGRAMS", "", out);
        for program in &sheet.called {
            let times = if program.runs == 1 { "runs once" } else { &format!("runs {} times", program.runs) };
            let _ = writeln!(out, "  {:<8} {times}, called first in {}", program.name, sheet.place(&program.first));
        }
    }
    if !sheet.options.is_empty() {
        heading(paint, "OPTIONS OF THE CONTROL", "must be fitted", out);
        for (name, text) in &sheet.options {
            for (index, line) in wrap(text, paint.width.saturating_sub(26)).iter().enumerate() {
                let name = if index == 0 { name.as_str() } else { "" };
                let _ = writeln!(out, "  {name:<22}  {}", paint.dim(line));
            }
        }
    }
    if !sheet.writes.is_empty() {
        heading(paint, "THE PROGRAM WRITES", "into the control's memory", out);
        for line in sheet.writes.iter().flat_map(|line| wrap(line, paint.width.saturating_sub(2))) {
            let _ = writeln!(out, "  {line}");
        }
    }
}
