//! Times in columns: the program, its tools, their operations.

use std::fmt::Write as _;

use super::Split;
use crate::paint::Paint;
use crate::summary::{Summary, ticks};

/// Characters of a column with a time.
const COLUMN: usize = 8;
/// Characters of a name.
const MOST_OF_A_NAME: usize = 48;
const HEADINGS: [&str; 6] = ["total", "cutting", "rapid", "dwell", "waiting", "lost"];

/// The cycle time of a program for people.
pub fn time_text(summary: &Summary, paint: Paint) -> String {
    let mut out = summary.head();
    let name_width = paint.width.saturating_sub(COLUMN * HEADINGS.len()).min(MOST_OF_A_NAME);
    let mut heading = format!("{:<name_width$}", "  minutes:seconds");
    for name in HEADINGS {
        let _ = write!(heading, "{name:>COLUMN$}");
    }
    let _ = writeln!(out, "\n{}", paint.heading(&heading));
    row(("  program", name_width), &summary.times, |line| paint.strong(line), &mut out);
    let operations = summary.operations();
    let mut tools: Vec<u32> = Vec::new();
    for operation in &operations {
        if !tools.contains(&operation.tool) {
            tools.push(operation.tool);
        }
    }
    for tool in tools {
        let own: Vec<_> = operations.iter().filter(|operation| operation.tool == tool).collect();
        let Some((_, time)) = summary.used_tools().into_iter().find(|(known, _)| *known == tool) else { continue };
        let name = format!("  {}", summary.tool_name(tool));
        row((&name, name_width), &time, str::to_owned, &mut out);
        for operation in own {
            let mut name = if operation.name.is_empty() { "moves".to_owned() } else { operation.name.clone() };
            if operation.times > 1 {
                let _ = write!(name, " (× {})", operation.times);
            }
            row((&format!("    {name}"), name_width), &operation.split, |line| paint.dim(line), &mut out);
        }
    }
    out.push_str("\n  lost: what of cutting and rapid is more than at F, or at the rapid rate, throughout\n");
    out.push_str(&summary.alarm_line());
    out
}

fn row((name, width): (&str, usize), time: &Split, paint: impl Fn(&str) -> String, out: &mut String) {
    // A long name keeps its beginning, and one blank before the first time.
    let room = width.saturating_sub(1);
    let shown: String = if name.chars().count() > room {
        name.chars().take(room.saturating_sub(1)).chain(['…']).collect()
    } else {
        name.to_owned()
    };
    let mut line = format!("{shown:<width$}");
    for seconds in [time.total(), time.cutting, time.rapid, time.dwell, time.waiting, time.lost()] {
        let shown = if seconds > 0.0 { ticks(seconds) } else { "-".to_owned() };
        let _ = write!(line, "{shown:>COLUMN$}");
    }
    let _ = writeln!(out, "{}", paint(&line));
}
