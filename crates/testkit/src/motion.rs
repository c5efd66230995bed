//! The motion in a trace, freed of the lines it comes from.

use serde_json::Value;

/// Events that are motion.
const MOTION: &[&str] = &["rapid", "feed", "arc", "dwell"];

/// Fields in which two programs that move alike agree.
const FIELDS: &[&str] = &["event", "to", "f", "plane", "center", "sweep", "seconds", "revolutions"];

/// The motion events of a trace, one a line, with the fields that say where and how the axes go.
///
/// # Errors
/// A line that is no JSON object.
pub(crate) fn motion_of(trace: &str) -> Result<String, String> {
    let mut lines = String::new();
    for line in trace.lines() {
        let event = read_event(line)?;
        if !MOTION.contains(&text(&event, "event")) {
            continue;
        }
        let kept: Vec<String> =
            FIELDS.iter().filter_map(|field| event.get(field).map(|value| format!("{field} {value}"))).collect();
        lines.push_str(&kept.join("  "));
        lines.push('\n');
    }
    Ok(lines)
}

/// The least input increment, mm or degrees, and what writing six decimals can add to it.
const INCREMENT: f64 = 0.001 + 0.000_001;

/// The second of two motions, with the first one's lines where they differ by no more than a least increment.
pub(crate) fn settled(first: &str, second: &str) -> String {
    let mut lines = String::new();
    let mut wanted = first.lines();
    for line in second.lines() {
        let other = wanted.next().unwrap_or_default();
        lines.push_str(if agree(other, line) { other } else { line });
        lines.push('\n');
    }
    lines
}

/// True if two lines say the same but for numbers that lie within a least increment.
fn agree(a: &str, b: &str) -> bool {
    let (a, b) = (parts(a), parts(b));
    let near = |(a, b): (&&str, &&str)| {
        let numbers = a.parse::<f64>().ok().zip(b.parse::<f64>().ok());
        a == b || numbers.is_some_and(|(a, b)| (a - b).abs() <= INCREMENT)
    };
    a.len() == b.len() && a.iter().zip(&b).all(near)
}

/// A line cut into its numbers and what stands between them.
fn parts(line: &str) -> Vec<&str> {
    line.split([' ', ',', ':', '{', '}']).collect()
}

/// A line of a trace.
///
/// # Errors
/// It is no JSON.
pub(crate) fn read_event(line: &str) -> Result<Value, String> {
    serde_json::from_str(line).map_err(|error| format!("`{line}` is no event: {error}"))
}

/// A text field of an event; empty if it has none.
pub(crate) fn text<'e>(event: &'e Value, field: &str) -> &'e str {
    event.get(field).and_then(Value::as_str).unwrap_or_default()
}
