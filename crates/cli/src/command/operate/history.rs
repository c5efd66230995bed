//! The histories of the memory: alarms, and when which program ran.

use std::time::SystemTime;

use base::Diagnostic;
use machine::{EventKind, ResetCause};
use memory::{Change, List};
use station::{Interrupted, PastAlarm, Said, Session};

use crate::texts::Texts;

/// What waits to be written.
#[derive(Default)]
pub struct History {
    /// Entries, and other changes that go with them.
    pub changes: Vec<Change>,
}

impl History {
    fn write(&mut self, list: List, text: &str) {
        self.changes.push(Change::Note(list, format!("{} {text}", now())));
    }

    /// What has been said, if it belongs in a history.
    pub fn note(&mut self, said: &Said, session: &Session<Texts>, diagnostic: Option<&Diagnostic>) {
        let Said::Event(event) = said else { return };
        let (line, name) = (event.place.line, session.interpreter().program_name(event.place.program));
        let place = if line > 0 { format!("{name} line {line}") } else { NO_BLOCK.to_owned() };
        match &event.kind {
            EventKind::Start(_) => self.write(List::Runs, &format!("{name} begun")),
            EventKind::End { .. } => self.write(List::Runs, &format!("{name} ended at line {line}")),
            EventKind::Reset { cause, .. } if line > 0 && *cause != ResetCause::ProgramEnd => {
                self.write(List::Runs, &format!("{name} reset at line {line}"))
            }
            EventKind::Alarm(_) => {
                let Some(diagnostic) = diagnostic else { return };
                let alarm = diagnostic.alarm.as_ref().map_or("", |alarm| alarm.name.as_str());
                self.write(List::Alarms, &format!("{alarm}, {place}: {}", diagnostic.message));
                if line > 0 {
                    self.write(List::Runs, &format!("{name} stopped by the alarm {alarm} at line {line}"));
                }
            }
            _ => {}
        }
    }

    /// A program was interrupted when the power went.
    pub fn broken_off(&mut self, interrupted: &Interrupted) {
        let (name, line) = (&interrupted.program, interrupted.place.line);
        self.write(List::Runs, &format!("{name} was interrupted at line {line}: the power had gone"));
    }

    /// A program was given up when the power was switched off.
    pub fn switched_off(&mut self, name: &str, line: u64) {
        self.write(List::Runs, &format!("{name} given up at line {line}: the power was switched off"));
    }
}

/// Where an alarm stands that no block raised.
const NO_BLOCK: &str = "at no block";
/// How long the date before an entry is.
const DATE: usize = "2026-11-23 09:45:20 UTC".len();

/// An alarm of the history as [`History::note`] wrote it; one that is written otherwise is a text alone.
pub fn past_alarm(entry: &str) -> PastAlarm {
    let (date, said) = entry.split_at_checked(DATE).filter(|(date, _)| date.ends_with(" UTC")).unwrap_or(("", entry));
    let mut alarm = PastAlarm { date: (!date.is_empty()).then(|| date.to_owned()), ..PastAlarm::default() };
    let parts = said.trim_start().split_once(", ").and_then(|(name, rest)| Some((name, rest.split_once(": ")?)));
    let Some((name, (place, text))) = parts else {
        alarm.text = said.trim_start().to_owned();
        return alarm;
    };
    let block = place.rsplit_once(" line ").and_then(|(program, line)| Some((program.to_owned(), line.parse().ok()?)));
    if block.is_none() && place != NO_BLOCK {
        alarm.text = said.trim_start().to_owned();
        return alarm;
    }
    (alarm.name, alarm.text, alarm.place) = (name.to_owned(), text.to_owned(), block);
    alarm
}

/// Date and time of day, UTC.
fn now() -> String {
    let seconds = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |since| since.as_secs());
    date(seconds)
}

fn date(seconds: u64) -> String {
    let (days, of_day) = (seconds / 86_400, seconds % 86_400);
    // Years counted from March, so that the day of a leap year is the last one.
    let shifted = days + 719_468;
    let (era, of_era) = (shifted / 146_097, shifted % 146_097);
    let year = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    let year = year + era * 400 + u64::from(month <= 2);
    let (hour, minute, second) = (of_day / 3600, of_day / 60 % 60, of_day % 60);
    format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_alarm_is_read_back_as_it_was_noted() {
        let read = |text: &str| past_alarm(&format!("{} {text}", date(1_795_427_120)));
        let alarm = read("TRAVEL, O1 line 12: X, here: too far");
        assert_eq!((alarm.name.as_str(), alarm.text.as_str()), ("TRAVEL", "X, here: too far"));
        assert_eq!(
            (alarm.date.as_deref(), alarm.place),
            (Some("2026-11-23 09:45:20 UTC"), Some(("O1".to_owned(), 12)))
        );
        let alarm = read("EMERGENCY STOP, at no block: pressed");
        assert_eq!((alarm.name.as_str(), alarm.text.as_str(), alarm.place), ("EMERGENCY STOP", "pressed", None));
        let alarm = past_alarm("written by hand");
        assert_eq!((alarm.text.as_str(), alarm.date), ("written by hand", None));
    }

    #[test]
    fn dates_are_those_of_the_calendar() {
        assert_eq!(date(0), "1970-01-01 00:00:00 UTC");
        assert_eq!(date(951_782_399), "2000-02-28 23:59:59 UTC");
        assert_eq!(date(951_868_799), "2000-02-29 23:59:59 UTC");
        assert_eq!(date(1_795_427_120), "2026-11-23 09:45:20 UTC");
    }
}
