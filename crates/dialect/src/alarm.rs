//! Alarms: which one a condition raises on this control, and the three sentences for people.

use base::{Alarm, AlarmName, Condition, Diagnostic, Severity};

use crate::control::Control;
use crate::fix::Fix;
use crate::row::Origin;

/// An alarm of the control.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct AlarmRow {
    /// Its reference name.
    pub name: String,
    /// The number the control shows, where it is known.
    pub number: Option<u32>,
    /// The control's short text.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// What is wrong, why the machine cares, what to do: with places for the word and the numbers.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Sentences {
    pub what: String,
    pub why: String,
    pub help: String,
    pub fix: Option<Fix>,
}

impl Control {
    /// The alarm that this control raises.
    pub fn alarm_name(&self, alarm: &Alarm) -> AlarmName {
        let address = self.address(alarm.letter);
        let by_address = match alarm.condition {
            Condition::AddressUnavailable => address.and_then(|address| address.absent.as_deref()),
            Condition::ValueOutOfRange | Condition::DigitsTooMany | Condition::CodeTooLargeForLines => {
                address.map(|address| address.alarm.as_str())
            }
            _ => None,
        };
        let row = by_address.and_then(|name| self.alarms.iter().find(|row| row.name == name)).or_else(|| {
            let index = *self.alarm_of_condition.get(alarm.condition as usize)?;
            self.alarms.get(index)
        });
        let number_of = |row: &AlarmRow| match alarm.condition {
            // The program gives the number itself.
            Condition::MacroUser => Some(alarm.values[0].round().clamp(0.0, f64::from(u32::MAX)) as u32),
            _ => row.number,
        };
        match row {
            Some(row) => AlarmName { name: row.name.clone(), number: number_of(row), text: row.text.clone() },
            None => AlarmName { name: alarm.condition.id().to_uppercase(), number: None, text: String::new() },
        }
    }

    /// How a block refused for this condition is written anew.
    pub(crate) fn fix_of(&self, condition: Condition) -> Option<Fix> {
        self.sentences.get(condition as usize)?.fix
    }

    /// The alarm for people. `word` is the offending text as written, `axis` the letter and whether it turns.
    pub fn diagnose(&self, alarm: &Alarm, word: &str, axis: Option<(char, bool)>) -> Diagnostic {
        let fallback = Sentences::default();
        let sentences = self.sentences.get(alarm.condition as usize).unwrap_or(&fallback);
        let fill = |text: &str| fill(text, alarm, word, axis);
        Diagnostic {
            code: alarm.condition.id(),
            severity: Severity::Error,
            message: fill(&sentences.what),
            why: fill(&sentences.why),
            help: fill(&sentences.help),
            alarm: Some(self.alarm_name(alarm)),
            place: alarm.place,
            span: alarm.span,
            label: String::new(),
            labels: Vec::new(),
            fix: None,
        }
    }
}

impl Control {
    /// What is wrong, why the machine cares and what to do for the condition or warning of this code, in general: what
    /// differs from case to case is an ellipsis.
    pub fn sentences_of(&self, code: &str) -> [String; 3] {
        let of_alarm = Condition::from_id(code).and_then(|condition| self.sentences.get(condition as usize));
        let of_warning = || self.warnings.iter().find(|row| row.name == code);
        let sentences = match of_alarm {
            Some(row) => [row.what.as_str(), &row.why, &row.help],
            None => of_warning().map_or([""; 3], |row| [&row.what, &row.why, &row.help]),
        };
        sentences.map(in_general)
    }
}

/// A sentence without its values.
fn in_general(text: &str) -> String {
    let mut parts = text.split('{');
    let head = parts.next().unwrap_or_default().to_owned();
    parts.fold(head, |text, part| text + "…" + part.split_once('}').map_or("", |(_, rest)| rest))
}

/// Puts the word and the numbers into a sentence.
fn fill(text: &str, alarm: &Alarm, word: &str, axis: Option<(char, bool)>) -> String {
    let mut out = String::with_capacity(text.len() + 16);
    let mut rest = text;
    while let Some(open) = rest.find('{') {
        out.push_str(&rest[..open]);
        let Some(close) = rest[open..].find('}') else { break };
        let name = &rest[open + 1..open + close];
        rest = &rest[open + close + 1..];
        let value =
            |digit: &str| digit.parse::<usize>().ok().and_then(|n| alarm.values.get(n.wrapping_sub(1)).copied());
        match name.split_once(':') {
            Some((digit, "mm")) => {
                let unit = if axis.is_some_and(|(_, turns)| turns) { "deg" } else { "mm" };
                out.push_str(&format!("{} {unit}", plain(value(digit).unwrap_or(0.0))));
            }
            // A limit in inches has four decimals.
            Some((digit, "limit")) => out.push_str(&rounded(value(digit).unwrap_or(0.0), 4)),
            Some((digit, "row")) => {
                let row = value(digit).unwrap_or(0.0) as u8;
                out.push_str(&format!("{row:02X} (channels {})", tape::holes(row)));
            }
            Some((digit, "code")) => {
                let letter = char::from(value(digit).unwrap_or(0.0) as u8);
                out.push_str(&format!("{letter}{:02}", alarm.values[1]));
            }
            Some((digit, "characters")) => out.push_str(&tape::Guesses::text(value(digit).unwrap_or(0.0))),
            _ => match name {
                "word" => out.push_str(word),
                // The message in parentheses, where the word has one.
                "comment" => {
                    let message = word.split_once('(').map(|(_, rest)| rest.trim_end().trim_end_matches(')').trim());
                    if let Some(message) = message.filter(|message| !message.is_empty()) {
                        out.push_str(": ");
                        out.push_str(message);
                    }
                }
                "axis" => out.push(axis.map_or('?', |(letter, _)| letter)),
                "g" => out.push_str(&format!("G{:02}", alarm.values[0])),
                digit => out.push_str(&plain(value(digit).unwrap_or(0.0))),
            },
        }
    }
    out.push_str(rest);
    out
}

/// A number for people: at most three decimals, no trailing zeros.
fn plain(value: f64) -> String {
    rounded(value, 3)
}

/// A number with at most so many decimals, no trailing zeros.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
