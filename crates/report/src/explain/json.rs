//! An explanation as a JSON object, for editors and programs.

use dialect::{Control, Origin};
use machine::MachineAxis;
use path::{Corner, Part};

use super::beside::{Beside, side};
use super::words::WordLine;
use super::{Explanation, PolicyLine, Value};
use crate::face::{Format, render};
use crate::json::JsonLine;
use crate::trace::Tracer;

/// An explanation as one JSON object; its `does` holds events as the trace prints them.
pub fn explanation_json(explanation: &Explanation, control: &Control, axes: &[MachineAxis]) -> String {
    let mut out = Vec::new();
    let mut object = JsonLine::begin(&mut out);
    object
        .text("file", &explanation.file)
        .integer("line", explanation.line)
        .text("program", &explanation.program)
        .text("block", explanation.text.trim_end());
    match explanation.pass {
        Some((pass, of)) => object.integer("execution", pass).integer("executions", of),
        None => object.integer("executions", 0),
    };
    if let Some(note) = &explanation.note {
        object.text("note", note);
    }
    list(&mut object, "words", &explanation.words, word);
    let mut tracer = Tracer::new(control, "", axes.iter().map(|axis| axis.letter));
    let does = object.field("does");
    let (mut written, mut beside) = (0, Vec::new());
    does.push(b'[');
    for (index, event) in explanation.events.iter().enumerate() {
        if matches!(event.kind, machine::EventKind::Alarm(_)) {
            continue;
        }
        let before = does.len();
        if does.last() == Some(&b'}') {
            does.push(b',');
        }
        let separated = does.len();
        tracer.set_main(event.place.program);
        tracer.write(event, |_| "", None, does);
        // An event without a line of its own leaves nothing; a line ends with its line end.
        let keep = if does.len() == separated { before } else { does.len() - 1 };
        does.truncate(keep);
        if keep != before {
            let run = explanation.beside.iter().find(|(at, _)| *at == index);
            beside.extend(run.map(|(_, run)| (written, *run)));
            written += 1;
        }
    }
    does.push(b']');
    if !beside.is_empty() {
        list(&mut object, "beside", &beside, run_beside);
    }
    if let Some((wrote, goes_to)) = &explanation.statement {
        if let Some(wrote) = wrote {
            object.text("wrote", wrote);
        }
        object.integer("goes_to", *goes_to);
    }
    if let Some((diagnostic, excerpt)) = &explanation.alarm {
        object.field("alarm").extend_from_slice(render(diagnostic, excerpt, Format::Json).as_bytes());
    }
    list(&mut object, "changes", &explanation.changes, change);
    for (name, codes) in ["before", "after"].iter().zip(&explanation.in_force) {
        object.object(name, |modal| {
            for (group, code) in codes {
                modal.text(&format!("{group:02}"), code);
            }
        });
    }
    list(&mut object, "policies", &explanation.policies, policy);
    object.end();
    String::from_utf8_lossy(&out).into_owned()
}

fn list<T>(object: &mut JsonLine, name: &str, items: &[T], write: fn(&T, &mut JsonLine)) {
    let out = object.field(name);
    out.push(b'[');
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            out.push(b',');
        }
        let mut inner = JsonLine::begin(out);
        write(item, &mut inner);
        inner.end();
    }
    out.push(b']');
}

/// How a move follows from the programmed path; `of` is its place in `does`.
fn run_beside((of, run): &Beside, object: &mut JsonLine) {
    let part = match run.part {
        Part::Start => "start",
        Part::Along => "along",
        Part::Round => "round",
        Part::Cancel => "cancel",
    };
    object.integer("of", *of as u64).text("part", part);
    object.number("radius", run.radius.abs()).text("side", side(run));
    match run.corner {
        Corner::None => object,
        Corner::Inside => object.text("corner", "inside"),
        Corner::Outside => object.text("corner", "outside"),
    };
}

fn origin(origin: &Origin, object: &mut JsonLine) {
    object.text("certainty", &origin.certainty.0.to_string()).text("source", &origin.source);
}

fn word(line: &WordLine, object: &mut JsonLine) {
    object.text("word", &line.word);
    if let Some((value, unit)) = line.number {
        object.number("value", value);
        if !unit.is_empty() {
            object.text("unit", unit);
        }
    }
    object.text("says", &line.says).boolean("acts", line.acts);
    if let Some(row) = &line.origin {
        origin(row, object);
    }
}

fn change(value: &Value, object: &mut JsonLine) {
    object.text("name", &value.name).text("before", &value.before).text("after", &value.after);
}

fn policy(policy: &PolicyLine, object: &mut JsonLine) {
    object.text("name", &policy.name).text("value", &policy.value).text("text", &policy.text);
    origin(&policy.origin, object);
}
