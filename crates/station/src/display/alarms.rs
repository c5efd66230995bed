//! The alarm that stands, and those that have been.

use base::Alarm;

use super::Value;
use crate::library::Library;
use crate::session::{PastAlarm, Session};

/// The alarm that stands, as a line of its page.
pub(super) fn standing<L: Library>(session: &mut Session<L>) -> Value {
    let alarm = session.alarm().copied();
    Value::List(alarm.iter().map(|alarm| alarm_line(session, alarm)).collect())
}

fn alarm_line<L: Library>(session: &mut Session<L>, alarm: &Alarm) -> Value {
    let diagnostic = session.diagnose(alarm);
    let name = diagnostic.alarm.as_ref();
    let line = if alarm.place.line > 0 { Value::Number(alarm.place.line as f64) } else { Value::Null };
    Value::object([
        ("name", Value::text_or_null(name.map(|name| name.name.as_str()))),
        ("number", Value::number_or_null(name.and_then(|name| name.number).map(f64::from))),
        ("text", Value::Text(diagnostic.message)),
        ("line", line),
    ])
}

/// The alarms that have been, the newest first; what an alarm does not have is left out.
pub(super) fn past<L: Library>(session: &Session<L>) -> Value {
    Value::List(session.past_alarms().rev().map(past_line).collect())
}

fn past_line(alarm: &PastAlarm) -> Value {
    let mut line = vec![("name", Value::text(&alarm.name))];
    line.extend(alarm.number.map(|number| ("number", Value::Number(f64::from(number)))));
    line.push(("text", Value::text(&alarm.text)));
    if let Some((program, block)) = &alarm.place {
        line.extend([("program", Value::text(program)), ("line", Value::Number(*block as f64))]);
    }
    line.extend(alarm.time.map(|time| ("time", Value::Number(time.0))));
    line.extend(alarm.date.as_deref().map(|date| ("date", Value::text(date))));
    Value::fields(line)
}
