//! The alarms that have been: the newest ones, with the words in which they were told.

use base::{Alarm, Diagnostic, Seconds};

use super::{Session, TYPED};
use crate::library::Library;

/// So many alarms are remembered; the oldest go first.
const MOST_ALARMS: usize = 100;

/// An alarm that has been, in words.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PastAlarm {
    /// When it was raised, virtual time since power-on.
    pub time: Option<Seconds>,
    /// Date and time of day of one that a memory has kept.
    pub date: Option<String>,
    /// The control's name of it.
    pub name: String,
    /// The control's number of it.
    pub number: Option<u32>,
    /// What was wrong.
    pub text: String,
    /// The program and the line of its block, if it was about one.
    pub place: Option<(String, u64)>,
}

impl<L: Library> Session<L> {
    /// The alarms that have been, the oldest first.
    pub fn past_alarms(&self) -> impl DoubleEndedIterator<Item = &PastAlarm> {
        self.past_alarms.iter()
    }

    /// Remembers an alarm: one of an earlier session, whose number may be left out, or one that has just been told.
    pub fn remember_alarm(&mut self, mut alarm: PastAlarm) {
        if alarm.number.is_none() {
            let mut rows = self.configuration.control.alarms.iter();
            alarm.number = rows.find(|row| row.name == alarm.name).and_then(|row| row.number);
        }
        if self.past_alarms.len() >= MOST_ALARMS {
            self.past_alarms.pop_front();
        }
        self.past_alarms.push_back(alarm);
    }

    /// An alarm is told to whoever works the control: it is remembered in words, for its text may change.
    pub(super) fn note_alarm(&mut self, alarm: &Alarm, time: Seconds) {
        if !self.attended {
            return;
        }
        let diagnostic = self.diagnose(alarm);
        let (name, number) = diagnostic.alarm.map_or((String::new(), None), |alarm| (alarm.name, alarm.number));
        let program = self.interpreter().program_name(alarm.place.program);
        let place = (alarm.place.line > 0).then(|| (program.to_owned(), alarm.place.line));
        self.remember_alarm(PastAlarm { time: Some(time), date: None, name, number, text: diagnostic.message, place });
    }

    /// The alarm in words; the word that it is about is read from its text.
    pub(crate) fn diagnose(&mut self, alarm: &Alarm) -> Diagnostic {
        let (from, len) = (alarm.span.start, alarm.span.len as usize);
        let mut bytes = Vec::new();
        if alarm.place.source == TYPED {
            let text = self.typed_text();
            let from = usize::try_from(from).unwrap_or(usize::MAX).min(text.len());
            bytes.extend(text[from..].iter().take(len));
        } else if alarm.place.line > 0 {
            // A text that can no longer be read leaves the word out.
            let _ = self.library_mut().read(alarm.place.source, from, len, &mut bytes);
        }
        let configuration = self.configuration();
        let axis = alarm.axis.and_then(|axis| configuration.machine.axes.get(usize::from(axis)));
        let axis = axis.map(|axis| (char::from(axis.letter), axis.rotary));
        let word = configuration.machine.words_of(alarm);
        let word = word.unwrap_or_else(|| String::from_utf8_lossy(&bytes).into_owned());
        configuration.control.diagnose(alarm, &word, axis)
    }
}
