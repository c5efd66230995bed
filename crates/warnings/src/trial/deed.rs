//! What a run does to the work piece, one thing after the other.

use base::{AXES, Alarm, AxisSet, Place, Point};
use dialect::{Control, Meaning};
use machine::{EventKind, StopCause};
use meaning::{CodeLine, Dwell, EndKind};
use station::{Library, LibraryError, Session, Step};

use crate::look::number;

/// Two places less than this apart, in mm or degrees, are one.
const SAME: f64 = 1e-6;

/// What happens.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum What {
    /// A cut, straight or on an arc about a centre on two axes.
    Cut {
        to: Point,
        center: Option<([u8; 2], [f64; 2])>,
        feed: f64,
    },
    /// A block that moves is done; the axes stood there before and stand here now.
    Stand {
        from: Point,
        at: Point,
    },
    Dwell(Dwell),
    Code(CodeLine, u32),
    Stop(StopCause),
    Alarm(Alarm),
    End(EndKind),
}

/// One thing that happens, and the axes whose places count in it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Deed {
    pub place: Place,
    pub order: u64,
    pub what: What,
    pub axes: AxisSet,
}

impl Deed {
    /// True if the other run does the same.
    pub fn is_same(&self, other: &Deed) -> bool {
        let axes = self.axes.or(other.axes);
        let same_place = |a: &Point, b: &Point| axes.iter().all(|axis| (a[axis] - b[axis]).abs() < SAME);
        if (self.place.source, self.place.block.start) != (other.place.source, other.place.block.start) {
            return false;
        }
        match (&self.what, &other.what) {
            (What::Cut { to, center, feed }, What::Cut { to: b, center: c, feed: f }) => {
                let centres = match (center, c) {
                    (Some((p, a)), Some((q, b))) => p == q && (a[0] - b[0]).abs() < SAME && (a[1] - b[1]).abs() < SAME,
                    (a, b) => a == b,
                };
                same_place(to, b) && centres && (feed - f).abs() < SAME
            }
            (What::Stand { at, .. }, What::Stand { at: b, .. }) => same_place(at, b),
            (What::Alarm(a), What::Alarm(b)) => a.condition == b.condition,
            (a, b) => a == b,
        }
    }

    /// It in words, with the places of the axes in which it differs from the other run, of those that it moves if there
    /// is nothing to compare it with.
    pub fn words(&self, other: Option<&Deed>, letters: &[u8], control: &Control) -> String {
        let letter = |axis: usize| letters.get(axis).map_or('?', |&letter| char::from(letter));
        let places = |point: &Point, beside: Option<&Point>| {
            let differs = |axis: &usize| beside.is_none_or(|there| (there[*axis] - point[*axis]).abs() >= SAME);
            let axes = (0..letters.len().min(AXES)).filter(differs);
            axes.map(|axis| format!("{}{}", letter(axis), number(point[axis]))).collect::<Vec<_>>().join(" ")
        };
        let there = match other.map(|other| &other.what) {
            Some(What::Cut { to, .. }) => Some(to),
            Some(What::Stand { at, .. }) => Some(at),
            _ => None,
        };
        match &self.what {
            What::Cut { to, center, feed } => {
                let mut text = "cuts".to_owned();
                match (places(to, there), center) {
                    (places, None) if !places.is_empty() => text += &format!(" to {places}"),
                    (_, Some(([a, b], [p, q]))) => {
                        let centre =
                            [(a, p), (b, q)].map(|(&axis, &at)| format!("{}{}", letter(usize::from(axis)), number(at)));
                        text += &format!(" an arc about {}", centre.join(" "));
                    }
                    _ => {}
                }
                format!("{text} at {} mm/min", number(*feed))
            }
            What::Stand { from, at } => match places(at, there.or(Some(from))) {
                places if !places.is_empty() => format!("goes to {places}"),
                _ if from == at => "does not move".to_owned(),
                _ => "goes there at rapid".to_owned(),
            },
            What::Dwell(Dwell::Seconds(seconds)) => format!("dwells {} s", number(*seconds)),
            What::Dwell(Dwell::Revolutions { turns, .. }) => format!("dwells {} turns", number(*turns)),
            What::Code(line, code) => format!("sends {line:?}{code:02}"),
            What::Stop(_) => "stops".to_owned(),
            What::Alarm(alarm) => format!("raises the alarm {}", control.alarm_name(alarm).name),
            What::End(_) => "ends".to_owned(),
        }
    }
}

/// The deeds of a session's run.
pub(crate) struct Deeds<'s, L> {
    session: &'s mut Session<L>,
    pieces: u64,
    started: bool,
    placed: AxisSet,
}

impl<'s, L: Library> Deeds<'s, L> {
    pub fn new(session: &'s mut Session<L>, pieces: u64, placed: AxisSet) -> Deeds<'s, L> {
        Deeds { session, pieces, started: false, placed }
    }

    /// The next deed, `None` when all pieces are made.
    pub fn next(&mut self) -> Result<Option<Deed>, LibraryError> {
        if !self.started {
            self.started = true;
            self.session.start_over();
        }
        loop {
            match self.session.next() {
                Step::Event(event) => {
                    let from_and_to = match &event.kind {
                        EventKind::Feed { from, to, .. } => Some((*from, *to)),
                        EventKind::Arc { arc, .. } => Some((arc.from, arc.to)),
                        _ => None,
                    };
                    if let Some(what) = self.what(&event.kind) {
                        let axes = self.counting(from_and_to);
                        let order = self.session.interpreter().done()[0].block;
                        return Ok(Some(Deed { place: event.place, order, what, axes }));
                    }
                }
                Step::Stopped => self.session.start(),
                Step::Idle if self.pieces > 1 && self.session.alarm().is_none() => {
                    self.pieces -= 1;
                    self.session.start_over();
                }
                Step::Idle => return Ok(None),
                Step::Failed(error) => return Err(error),
            }
        }
    }

    fn what(&mut self, kind: &EventKind) -> Option<What> {
        Some(match kind {
            EventKind::Feed { to, feed, .. } => What::Cut { to: *to, center: None, feed: *feed },
            EventKind::Arc { arc, feed, .. } => {
                What::Cut { to: arc.to, center: Some((arc.axes, arc.center)), feed: *feed }
            }
            EventKind::Dwell(dwell) => What::Dwell(*dwell),
            EventKind::Code(code) => What::Code(code.line, code.code),
            EventKind::Stop(cause) => What::Stop(*cause),
            EventKind::Alarm(alarm) => What::Alarm(*alarm),
            EventKind::End { kind, .. } => What::End(*kind),
            EventKind::BlockDone => {
                let interpreter = self.session.interpreter();
                let command = interpreter.done()[0];
                if !command.moves() {
                    return None;
                }
                let returns =
                    matches!(command.wording.one_shot, Some(Meaning::ReferenceReturn | Meaning::OtherReferenceReturn));
                let mut placed = command.absolute;
                if returns {
                    let axes = interpreter.facts().axes.iter().enumerate().take(AXES);
                    axes.filter(|(_, axis)| command.wording.has(axis.letter)).for_each(|(axis, _)| placed.add(axis));
                }
                self.placed = self.placed.or(placed);
                What::Stand { from: command.from.map(|counts| counts / 1e6), at: self.session.position() }
            }
            _ => return None,
        })
    }

    /// The axes that count: those placed so far, those that the block places, those that a cut moves.
    fn counting(&self, cut: Option<(Point, Point)>) -> AxisSet {
        let mut axes = self.placed;
        if let Some((from, to)) = cut {
            axes = axes.or(self.session.interpreter().done()[0].absolute);
            (0..AXES).filter(|&axis| from[axis] != to[axis]).for_each(|axis| axes.add(axis));
        }
        axes
    }
}
