//! A comparison as one JSON object.

use station::Configuration;

use super::comparison::{Comparison, Deviation, Seen, trace_line};
use crate::json::JsonLine;

/// The comparison; `files` are named as the user named them.
pub fn comparison_json(comparison: &Comparison, sides: [(&str, &Configuration); 2]) -> String {
    let mut out = Vec::new();
    let mut line = JsonLine::begin(&mut out);
    line.boolean("same", comparison.is_same());
    line.object("events", |events| {
        events.integer("same", comparison.same).integer("changed", comparison.changed);
        events.integer("only_a", comparison.only[0]).integer("only_b", comparison.only[1]);
    });
    line.list("differences", &comparison.deviations, |deviation, list| {
        list.object("", |object| one(deviation, sides, object));
    });
    for (name, side) in [("a", 0), ("b", 1)] {
        line.object(name, |object| {
            object.text("file", sides[side].0);
            object.field("summary").extend_from_slice(comparison.summaries[side].json().as_bytes());
        });
    }
    line.end();
    String::from_utf8_lossy(&out).into_owned()
}

fn one(deviation: &Deviation, sides: [(&str, &Configuration); 2], object: &mut JsonLine) {
    let kind = match deviation.missing {
        None => "changed",
        Some(0) => "only_b",
        Some(_) => "only_a",
    };
    object.text("kind", kind).integer("after", deviation.after);
    for (name, side) in [("a", 0), ("b", 1)] {
        match &deviation.sides[side] {
            Some(seen) => object.object(name, |object| event(seen, sides[side].1, object)),
            None => object.null(name),
        };
    }
    object.list("differs", &deviation.parts, |(name, a, b), list| {
        list.object("", |object| {
            object.text("what", name).text("a", a).text("b", b);
        });
    });
}

fn event(seen: &Seen, configuration: &Configuration, object: &mut JsonLine) {
    object.text("block", &seen.block);
    object.field("event").extend_from_slice(trace_line(configuration, seen).as_bytes());
}
