//! The blocks that lose most, for people and as JSON.

use std::fmt::Write as _;

use super::top::MOST;
use super::{Cause, Loss};
use crate::json::JsonLine;
use crate::paint::{Paint, wrap};
use crate::summary::period;

/// A cause of less than this part of all is not told by itself.
const TOLD: f64 = 0.005;

/// The blocks that lose most, for people.
pub fn why_text(worst: &[Loss], by_cause: &[(Cause, f64)], paint: Paint) -> String {
    let mut out = String::new();
    let all: f64 = by_cause.iter().map(|(_, seconds)| seconds).sum();
    if worst.is_empty() {
        return "\n  Nothing is lost: no block waits, dwells or runs slower than it asks for.\n".to_owned();
    }
    let _ = writeln!(out, "\n{}", paint.heading(&format!("  what costs {}", period(all))));
    let (told, rest): (Vec<_>, Vec<_>) = by_cause.iter().partition(|(_, seconds)| *seconds >= TOLD * all);
    let rest: f64 = rest.iter().map(|(_, seconds)| seconds).sum();
    for (seconds, words) in
        told.iter().map(|(cause, seconds)| (*seconds, cause.words())).chain([(rest, "anything else")])
    {
        if seconds > 0.0 {
            let _ = writeln!(out, "  {:>11}  {:>3.0} %  {words}", period(seconds), 100.0 * seconds / all);
        }
    }
    let _ = writeln!(out, "\n{}", paint.heading("  the blocks that lose most"));
    for loss in worst {
        let place = if loss.program.is_empty() {
            format!("line {}", loss.line)
        } else {
            format!("{} line {}", loss.program, loss.line)
        };
        let times = if loss.times == 1 { "once".to_owned() } else { format!("{} times", loss.times) };
        let least = if loss.maybe > 0.0 { "at least " } else { "" };
        let head = format!("  {least}{}  {place}, run {times}", period(loss.seconds));
        let _ = writeln!(out, "{}\n      {}", paint.strong(&head), loss.text);
        paragraph("held by: ", &loss.held, paint, &mut out);
        paragraph("helps:   ", &loss.help, paint, &mut out);
    }
    let unsure = worst.iter().map(|loss| loss.maybe).fold(0.0, f64::max);
    if unsure > 0.0 {
        let note = format!(
            "More than {MOST} blocks lose time: the sums by cause are exact, a block may have lost up to {} more than stands here.",
            period(unsure)
        );
        for line in wrap(&note, paint.width.saturating_sub(4)) {
            let _ = writeln!(out, "  {line}");
        }
    }
    out
}

fn paragraph(label: &str, text: &str, paint: Paint, out: &mut String) {
    let room = paint.width.saturating_sub(6 + label.len());
    for (index, line) in wrap(text, room).iter().enumerate() {
        let label = if index == 0 { label } else { "         " };
        let _ = writeln!(out, "      {}{line}", paint.dim(label));
    }
}

/// The fields `lost` and `why` of the summary's object.
pub(crate) fn why_json(worst: &[Loss], by_cause: &[(Cause, f64)], line: &mut JsonLine) {
    line.object("lost", |object| {
        for (cause, seconds) in by_cause {
            object.number(cause.name(), *seconds);
        }
    });
    line.list("why", worst, |loss, item| {
        item.object("", |object| {
            object.text("program", &loss.program).integer("line", loss.line).text("block", &loss.text);
            object.number("lost", loss.seconds).number("maybe", loss.maybe).integer("times", loss.times);
            object.object("causes", |causes| {
                for (cause, seconds) in &loss.causes {
                    causes.number(cause.name(), *seconds);
                }
            });
            object.text("held", &loss.held).text("help", &loss.help);
        });
    });
}
