//! The two runs compared, event by event, as far as somebody at the machine would see them.

use base::{Alarm, Diagnostic, SourceId, Span};
use machine::{Event, EventKind};
use station::{Configuration, Library, LibraryError, Session};

use super::alignment::{Alignment, Pair};
use super::likeness::{Likeness, Side, is_seen};
use super::next_event;
use crate::summary::Summary;
use crate::trace::Tracer;

/// Longest block that is shown whole, bytes.
const BLOCK: u32 = 200;

/// How closely two runs are compared.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limits {
    /// How far places may lie apart and still be one, mm and degrees.
    pub tolerance: f64,
    /// How many events are looked through for the place at which both agree again.
    pub window: usize,
    /// How many differences are kept to be shown.
    pub shown: usize,
    /// Times that each program is run.
    pub pieces: u64,
}

/// What one run does, with the block that it comes from.
#[derive(Clone, PartialEq, Debug)]
pub struct Seen {
    /// What happens.
    pub event: Event,
    /// The name of the program, where it is not the main one.
    pub program: Option<String>,
    /// The block as written.
    pub block: String,
    /// An alarm in words.
    pub diagnostic: Option<Diagnostic>,
}

/// A place at which the runs differ.
#[derive(Clone, PartialEq, Debug)]
pub struct Deviation {
    /// Events the same in both before it.
    pub after: u64,
    /// What either does there. Where one of them does nothing, it stands before this event of its own, if there is one.
    pub sides: [Option<Seen>; 2],
    /// Which of them has nothing there.
    pub missing: Option<usize>,
    /// In what they differ: name, what the first has, what the second has.
    pub parts: Vec<(String, String, String)>,
}

/// What a comparison has come to.
#[derive(Clone, PartialEq, Debug)]
pub struct Comparison {
    /// Events that both have.
    pub same: u64,
    /// Events that are another in the second run.
    pub changed: u64,
    /// Events that only one of them has.
    pub only: [u64; 2],
    /// The first differences.
    pub deviations: Vec<Deviation>,
    /// What either run came to.
    pub summaries: [Summary; 2],
}

impl Comparison {
    /// True if both do the same at the machine.
    pub fn is_same(&self) -> bool {
        self.changed == 0 && self.only == [0; 2]
    }
}

/// One of the two runs.
struct Run<'s, L> {
    session: &'s mut Session<L>,
    configuration: Configuration,
    /// Runs still to come.
    pieces: u64,
    summary: Summary,
    alarm: Option<Alarm>,
}

impl<'s, L: Library> Run<'s, L> {
    fn begin(session: &'s mut Session<L>, pieces: u64) -> Run<'s, L> {
        let configuration = session.configuration().clone();
        let (control, machine) = (&configuration.control, &configuration.machine);
        let summary = Summary::new(&control.name, &machine.name, machine.axes.iter().map(|axis| axis.letter));
        session.start();
        Run { session, configuration, pieces: pieces.saturating_sub(1), summary, alarm: None }
    }

    /// The next event that somebody at the machine would see.
    fn pull(&mut self) -> Result<Option<Event>, LibraryError> {
        loop {
            match next_event(self.session)? {
                Some(event) => {
                    self.summary.add(&event);
                    if let EventKind::Start(_) = event.kind {
                        let name = self.session.interpreter().program_name(event.place.program);
                        self.summary.set_program(name);
                    }
                    if let EventKind::Alarm(alarm) = event.kind {
                        self.alarm = Some(alarm);
                    }
                    if is_seen(&event) {
                        return Ok(Some(event));
                    }
                }
                None if self.pieces > 0 && self.session.alarm().is_none() => {
                    self.pieces -= 1;
                    self.session.start_over();
                }
                None => return Ok(None),
            }
        }
    }

    fn seen(&mut self, event: Event, text: &mut Texts<'_, L>) -> Seen {
        let place = event.place;
        let name = self.session.interpreter().program_name(place.program);
        let program = (name != self.summary.program()).then(|| name.to_owned());
        let mut excerpt = |span: Span| {
            let bytes = text(self.session.library_mut(), place.source, span.start, span.len.min(BLOCK) as usize);
            let shown: String = String::from_utf8_lossy(&bytes).chars().filter(|c| !c.is_control()).collect();
            shown.trim().to_owned()
        };
        let block = if place.line == 0 { String::new() } else { excerpt(place.block) };
        let diagnostic = match event.kind {
            EventKind::Alarm(alarm) => {
                let axis = alarm.axis.and_then(|axis| self.configuration.machine.axes.get(usize::from(axis)));
                let axis = axis.map(|axis| (char::from(axis.letter), axis.rotary));
                let word = self.configuration.machine.words_of(&alarm).unwrap_or_else(|| excerpt(alarm.span));
                Some(self.configuration.control.diagnose(&alarm, &word, axis))
            }
            _ => None,
        };
        Seen { event, program, block, diagnostic }
    }

    /// The summary, with the alarm that ended the run.
    fn finish(mut self, text: &mut Texts<'_, L>) -> Summary {
        if let Some(alarm) = self.alarm {
            let event = Event { time: base::Seconds(0.0), place: alarm.place, kind: EventKind::Alarm(alarm) };
            let seen = self.seen(event, text);
            let line = trace_line(&self.configuration, &seen);
            self.summary.add_alarm(line);
        }
        self.summary
    }
}

/// Characters of a text: the library, the text, where, how many.
type Texts<'t, L> = dyn FnMut(&mut L, SourceId, u64, usize) -> Vec<u8> + 't;

/// An event as the trace has it, on one line.
pub(super) fn trace_line(configuration: &Configuration, seen: &Seen) -> String {
    let (control, machine) = (&configuration.control, &configuration.machine);
    let mut tracer = Tracer::new(control, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    if seen.program.is_none() {
        tracer.set_main(seen.event.place.program);
    }
    let mut out = Vec::new();
    let program = seen.program.as_deref().unwrap_or_default();
    tracer.write(&seen.event, |_| program, seen.diagnostic.as_ref(), &mut out);
    String::from_utf8_lossy(&out).trim_end().to_owned()
}

/// Runs both sessions' programs to their ends and says where they differ. `text` gives characters of a text.
///
/// # Errors
/// A text cannot be read.
pub fn compare<L: Library>(
    first: &mut Session<L>,
    second: &mut Session<L>,
    limits: &Limits,
    mut text: impl FnMut(&mut L, SourceId, u64, usize) -> Vec<u8>,
) -> Result<Comparison, LibraryError> {
    let configurations = [first.configuration().clone(), second.configuration().clone()];
    let sides = [0, 1]
        .map(|side: usize| Side { control: &configurations[side].control, axes: &configurations[side].machine.axes });
    let likeness = Likeness::new(sides, limits.tolerance);
    let mut runs = [Run::begin(first, limits.pieces), Run::begin(second, limits.pieces)];
    let mut alignment = Alignment::new(limits.window);
    let (mut same, mut changed, mut only) = (0, 0, [0; 2]);
    let mut deviations = Vec::new();
    loop {
        let pair = alignment.next(|side| runs[side].pull(), |a, b| likeness.same(a, b))?;
        let (events, missing) = match pair {
            None => break,
            Some(Pair::Same(..)) => {
                same += 1;
                continue;
            }
            Some(Pair::Changed(a, b)) => {
                changed += 1;
                ([Some(a), Some(b)], None)
            }
            Some(Pair::First(a)) => {
                only[0] += 1;
                ([Some(a), alignment.head(1)], Some(1))
            }
            Some(Pair::Second(b)) => {
                only[1] += 1;
                ([alignment.head(0), Some(b)], Some(0))
            }
        };
        if deviations.len() < limits.shown {
            let parts = match (events, missing) {
                ([Some(a), Some(b)], None) => likeness.parts(&a, &b),
                _ => Vec::new(),
            };
            let [a, b] = &mut runs;
            let sides =
                [events[0].map(|event| a.seen(event, &mut text)), events[1].map(|event| b.seen(event, &mut text))];
            deviations.push(Deviation { after: same, sides, missing, parts });
        }
    }
    let [a, b] = runs;
    let summaries = [a.finish(&mut text), b.finish(&mut text)];
    Ok(Comparison { same, changed, only, deviations, summaries })
}
