//! The set-up sheet as a page for the printer: A4, black on white, nothing fetched from anywhere. What only the shop
//! knows (part, material, clamping, date, who) is left blank for the hand.

use std::fmt::Write as _;

use super::text::{ending, missing, mm, operation, span, unset};
use super::{Sheet, ToolSheet, tool_name};
use crate::explain::plain;
use crate::summary::clock;

const STYLE: &str = include_str!("sheet.css");

/// The sheet as one HTML page.
pub fn sheet_html(sheet: &Sheet) -> String {
    let mut out = String::new();
    let program = escape(&sheet.program);
    // The foot of each page names the program, so that loose sheets find one another.
    let foot = sheet.program.replace(['"', '\\', '<', '\n'], " ");
    let _ = write!(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Set-up sheet {program}</title>\n\
         <style>\n{STYLE}@page {{ @bottom-left {{ content: \"Set-up sheet {foot}\"; }} }}\n</style>\n</head>\n<body>\n"
    );
    title_block(sheet, &mut out);
    if let Some(text) = &sheet.alarm_text {
        let _ = writeln!(out, "<p class=\"alarm\">{}<br>{}</p>", escape(&ending(sheet)), escape(text));
    }
    if !sheet.header.is_empty() {
        let lines: Vec<_> = sheet.header.iter().map(|line| escape(line)).collect();
        let _ = writeln!(out, "<p class=\"header\">{}</p>", lines.join("<br>"));
    }
    tools(sheet, &mut out);
    offsets(sheet, &mut out);
    systems(sheet, &mut out);
    starts(sheet, &mut out);
    stops(sheet, &mut out);
    out.push_str("<div class=\"pair\">\n");
    travel(sheet, &mut out);
    called(sheet, &mut out);
    out.push_str("</div>\n");
    codes(sheet, &mut out);
    rest(sheet, &mut out);
    out.push_str("</body>\n</html>\n");
    out
}

/// A text as HTML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn title_block(sheet: &Sheet, out: &mut String) {
    let cell = |class: &str, label: &str, value: &str| {
        format!("<div class=\"{class}\"><span>{label}</span>{}</div>\n", escape(value))
    };
    let _ = writeln!(out, "<header>");
    out.push_str(&cell("wide program", "Set-up sheet for program", &sheet.program));
    out.push_str(&cell("", "Control", &sheet.control));
    out.push_str(&cell("", "Machine", &sheet.machine));
    for label in ["Part", "Drawing", "Material", "Clamping"] {
        out.push_str(&cell("blank", label, ""));
    }
    out.push_str(&cell("strong", "Cycle time", &clock(sheet.times.total)));
    let tools = sheet.tools.len().to_string();
    out.push_str(&cell("", "Tools", &tools));
    for label in ["Date", "Set up by"] {
        out.push_str(&cell("blank", label, ""));
    }
    let _ = writeln!(out, "</header>");
    let times = sheet.times;
    let _ = writeln!(
        out,
        "<p class=\"times\">cutting {} · rapid {} · dwell {} · waiting for the machine {}{}</p>",
        clock(times.cutting),
        clock(times.rapid),
        clock(times.dwell),
        clock(times.waiting),
        if sheet.alarm.is_some() { String::new() } else { format!(" · {}", escape(&ending(sheet))) }
    );
}

fn tools(sheet: &Sheet, out: &mut String) {
    let _ = writeln!(out, "<h2>Tools</h2>");
    for tool in &sheet.tools {
        tool_section(sheet, tool, out);
    }
}

fn tool_section(sheet: &Sheet, tool: &ToolSheet, out: &mut String) {
    let numbers = |numbers: &std::collections::BTreeSet<u32>, letter: char| {
        let list: Vec<_> = numbers.iter().map(|number| format!("{letter}{number:02}")).collect();
        list.join(" ")
    };
    let offsets = [numbers(&tool.h, 'H'), numbers(&tool.d, 'D')].join(" ");
    let name = if tool.tool.is_some() { tool_name(tool.tool) } else { "in spindle<br>at the start".to_owned() };
    let class = if tool.tool.is_some() { "" } else { " class=\"small\"" };
    let _ = writeln!(
        out,
        "<section class=\"tool\">\n<div class=\"name\"><b{class}>{name}</b>{offsets}</div>\n<div class=\"work\">"
    );
    let remarks: Vec<_> = tool.remarks.iter().map(|remark| escape(remark)).collect();
    if !remarks.is_empty() {
        let _ = writeln!(out, "<p class=\"remark\">{}</p>", remarks.join("<br>"));
    }
    if !tool.operations.is_empty() {
        let _ = writeln!(out, "<ul>");
        for work in &tool.operations {
            let text = escape(&operation(work));
            let _ = writeln!(out, "<li>{text} <i>{}</i></li>", escape(&sheet.place(&work.first)));
        }
        let _ = writeln!(out, "</ul>");
    }
    let mut systems: Vec<&str> = tool.extents.iter().map(|(system, ..)| system.as_str()).collect();
    systems.dedup();
    for system in systems {
        let parts = tool.extents.iter().filter(|(own, ..)| own == system);
        let parts: Vec<_> = parts
            .map(|(_, axis, range)| format!("{axis}&nbsp;{}&nbsp;…&nbsp;{}", mm(range.low), mm(range.high)))
            .collect();
        let _ = writeln!(out, "<p class=\"extent\">cuts in {system}: {}</p>", parts.join(", "));
    }
    let _ = writeln!(out, "</div>\n<div class=\"side\"><table class=\"figures\">");
    let mut row = |label: &str, value: String| {
        let _ = writeln!(out, "<tr><th>{label}</th><td>{value}</td></tr>");
    };
    if let Some(lowest) = &tool.lowest {
        row("lowest Z", format!("<b>{}</b> in {}", mm(lowest.program), lowest.system));
        row("tip, machine", mm(lowest.tip));
        row("spindle, machine", mm(lowest.machine));
    }
    row("S", tool.speeds.map_or_else(|| "–".to_owned(), |range| span(range, 0)));
    row("F mm/min", tool.feeds.map_or_else(|| "–".to_owned(), |range| span(range, 1)));
    row("cutting", clock(tool.cutting));
    row("in all", clock(tool.total));
    let _ = writeln!(out, "</table></div>\n</section>");
}

/// A table with a heading; nothing if it has no rows.
fn table(out: &mut String, title: &str, note: &str, heads: &[&str], rows: &[Vec<String>]) {
    if rows.is_empty() {
        return;
    }
    let note = if note.is_empty() { String::new() } else { format!(" <small>{note}</small>") };
    let heads: String = heads.iter().map(|head| format!("<th>{head}</th>")).collect();
    let _ = writeln!(
        out,
        "<div class=\"block\"><h2>{title}{note}</h2>\n<table class=\"list\">\n<thead><tr>{heads}</tr></thead>\n<tbody>"
    );
    for row in rows {
        let cells: String = row.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        let _ = writeln!(out, "<tr>{cells}</tr>");
    }
    let _ = writeln!(out, "</tbody>\n</table></div>");
}

fn offsets(sheet: &Sheet, out: &mut String) {
    let rows: Vec<_> = sheet
        .offsets
        .iter()
        .map(|offset| {
            let tools: Vec<_> = offset.tools.iter().map(|tool| tool_name(*tool)).collect();
            let note = if missing(offset) { "<em>zero: not set up?</em>" } else { "" };
            vec![
                format!("<b>{}{:02}</b>", offset.letter, offset.number),
                tools.join(", "),
                mm(offset.value),
                String::new(),
                note.to_owned(),
            ]
        })
        .collect();
    table(out, "Offsets", "mm", &["number", "tool", "as set up", "measured", ""], &rows);
}

fn systems(sheet: &Sheet, out: &mut String) {
    let rows: Vec<_> = sheet
        .systems
        .iter()
        .map(|system| {
            let origin: Vec<_> = system.origin.iter().map(|(axis, at)| format!("{axis}&nbsp;{}", mm(*at))).collect();
            let note = match (system.base, unset(system)) {
                (true, _) => "base system",
                (_, true) => "<em>all zero: not set up?</em>",
                _ => "",
            };
            vec![format!("<b>{}</b>", system.name), origin.join("&emsp;"), String::new(), note.to_owned()]
        })
        .collect();
    table(out, "Work systems", "origin, machine coordinates", &["system", "as set up", "measured", ""], &rows);
}

fn starts(sheet: &Sheet, out: &mut String) {
    let rows: Vec<_> = sheet
        .starts
        .iter()
        .map(|start| {
            let axes: Vec<_> = start.axes.iter().map(|(axis, at, _)| format!("{axis}&nbsp;{}", mm(*at))).collect();
            let hand: String = start.axes.iter().filter(|(.., hand)| *hand).map(|(axis, ..)| *axis).collect();
            let note = if hand.is_empty() {
                "after a return to the reference point".to_owned()
            } else {
                format!("<em>{hand}: put there by hand before CYCLE START</em>")
            };
            vec![escape(&sheet.place(&start.spot)), axes.join("&emsp;"), note]
        })
        .collect();
    table(out, "Start position", "where G92 names the place; machine coordinates", &["G92", "axes", ""], &rows);
}

fn stops(sheet: &Sheet, out: &mut String) {
    let rows: Vec<_> = sheet
        .stops
        .iter()
        .map(|stop| {
            let times = if stop.count > 1 { format!("{} times", stop.count) } else { String::new() };
            vec![format!("<b>{}</b>", stop.name), escape(&sheet.place(&stop.spot)), escape(&stop.remark), times]
        })
        .collect();
    table(out, "Stops", "", &["code", "where", "what is to be done", ""], &rows);
}

fn travel(sheet: &Sheet, out: &mut String) {
    let rows: Vec<_> = sheet
        .travel
        .iter()
        .map(|(axis, [low, high], [least, most])| {
            vec![
                format!("<b>{axis}</b>"),
                format!("{} … {}", mm(*low), mm(*high)),
                format!("{} … {}", plain(*least, 3), plain(*most, 3)),
            ]
        })
        .collect();
    table(out, "Travel", "machine coordinates", &["axis", "used", "limits"], &rows);
}

fn codes(sheet: &Sheet, out: &mut String) {
    let rows: Vec<_> = sheet
        .codes
        .iter()
        .map(|code| {
            let text = match &code.text {
                Some(text) => escape(text),
                None => "<span class=\"fill\">the machine builder's:</span>".to_owned(),
            };
            vec![format!("<b>{}</b>", code.name), format!("{}×", code.count), escape(&sheet.place(&code.first)), text]
        })
        .collect();
    table(out, "M and B codes", "", &["code", "", "first", "what it does"], &rows);
}

fn called(sheet: &Sheet, out: &mut String) {
    let rows: Vec<_> = sheet
        .called
        .iter()
        .map(|called| {
            let from = escape(&sheet.place(&called.first));
            vec![format!("<b>{}</b>", escape(&called.name)), format!("{}×", called.runs), from]
        })
        .collect();
    table(out, "Subprograms", "must be in memory", &["program", "runs", "called first in"], &rows);
}

fn rest(sheet: &Sheet, out: &mut String) {
    if !sheet.options.is_empty() {
        let names: Vec<_> = sheet.options.iter().map(|(name, _)| format!("<b>{}</b>", escape(name))).collect();
        let _ = writeln!(
            out,
            "<div class=\"block\"><h2>Options of the control <small>must be fitted</small></h2>\n<p class=\"options\">{}</p></div>",
            names.join(", ")
        );
    }
    let rows: Vec<_> = sheet.writes.iter().map(|line| vec![escape(line)]).collect();
    table(out, "The program writes", "into the control's memory", &["what"], &rows);
}
