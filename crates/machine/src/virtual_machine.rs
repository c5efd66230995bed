//! The virtual machine: executes timed shapes in virtual time and says what happened.
//!
//! Codes that start with a block run beside its motion; the block is done when motion and machine are. Codes after
//! the motion go out when it has ended, one block's together, and are waited for before anything else moves.

mod codes;
mod lines;
mod logic;

pub use codes::Wait;
pub use logic::LogicAlarm;

use std::sync::Arc;

use base::{Alarm, AxisSet, Condition, Place, Point, Seconds};
use dialect::StrokeCheck;
use meaning::{SetValue, StrokeArea};
use motion::{Setpoint, Timed};
use path::Shape;

use crate::area::{Offence, offence};
use crate::drives::Drives;
use crate::event::{Event, EventKind};
use crate::file::{CodeTimes, MachineFile};
use crate::interface::DecodedLine;
use crate::logic::Logic;
use crate::signals::{Handshake, LimitSwitch, Magazine, Spindle};
use crate::travel::{Exit, Met, Travel, along, until};

/// What executes timed shapes: the virtual machine, or one with real axes.
///
/// The station calls [`Machine::execute`] with one shape after the other, in the order of the program, and never with
/// one that lies behind a refused one. An implementation must not move an axis for any other reason.
pub trait Machine {
    /// Whether a move may begin: it stays within the travel, or the machine stops it at the border.
    ///
    /// # Errors
    /// The move would leave the travel and is refused as a whole.
    fn check(&self, timed: &Timed<'_>) -> Result<(), Refusal>;

    /// Executes a shape to its end. What happened is added to `told` in order.
    ///
    /// # Errors
    /// The move would leave the travel: nothing of it has been executed (or the part up to the border, by policy).
    fn execute(&mut self, timed: &Timed<'_>, told: &mut Vec<Event>) -> Result<(), Refusal>;

    /// The block is done: waits for the machine's answers to its codes, unless the program does not want that.
    fn finish_block(&mut self, place: &Place, waits: bool, told: &mut Vec<Event>);

    /// Where the axes are, mm and degrees in machine coordinates.
    fn position(&self) -> &Point;

    /// Where the axes shall be at this time, and how fast, once each servo period while they move and once when they have
    /// come to stand. Positions are absolute: rounded to what a drive takes, nothing adds up.
    fn follow(&mut self, time: Seconds, setpoint: &Setpoint);

    /// Whether the last move that waits for the skip signal was ended by it.
    fn was_skipped(&self) -> bool;

    /// Time since the start.
    fn time(&self) -> Seconds;
}

/// A move that the machine does not make.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Refusal {
    /// Why.
    pub alarm: Alarm,
}

/// A machine without iron.
#[derive(Clone, PartialEq, Debug)]
pub struct VirtualMachine {
    position: Point,
    time: Seconds,
    travel: Travel,
    /// The second stored stroke area, once a program has written it.
    area: Option<StrokeArea>,
    /// The skip signal: held by hand, or given where an axis crosses one of these coordinates.
    skip: bool,
    contact: Vec<(usize, f64)>,
    was_skipped: bool,
    /// The signal has come while the move was under way, here.
    skipped_at: Option<Point>,
    rates: Option<Point>,
    stroke_check: StrokeCheck,
    times: CodeTimes,
    /// Codes that are out.
    handshake: Handshake,
    spindle: Spindle,
    magazine: Magazine,
    /// The builder's logic, if there is one.
    logic: Option<Logic>,
    /// M codes with a line of their own, and what that drives.
    decoded: Vec<DecodedLine>,
    /// Overtravel switches.
    switches: Vec<LimitSwitch>,
    /// Every edge of a line is told.
    tells_signals: bool,
    /// The motion of a block is done whose codes are out.
    den: bool,
    /// Until then everything on the lines has been told, s.
    signals_until: f64,
    /// Nothing moves while codes are out.
    holds_motion: bool,
    /// The drives, if their setpoints are wanted.
    drives: Option<Drives>,
    /// Axes whose place is unknown: leaving their travel is not reported.
    unknown: AxisSet,
}

impl VirtualMachine {
    /// A machine at its start position (mm, degrees).
    pub fn new(file: &MachineFile, start: Point, stroke_check: StrokeCheck) -> VirtualMachine {
        VirtualMachine {
            position: start,
            time: Seconds(0.0),
            travel: file.travel(),
            area: None,
            skip: false,
            contact: Vec::new(),
            was_skipped: false,
            skipped_at: None,
            rates: (!file.path.straight_rapid).then(|| file.rapid_rates()),
            stroke_check,
            times: file.times.clone(),
            handshake: Handshake::new(file.handshake),
            spindle: Spindle::new(file.spindle.clone()),
            magazine: Magazine::new(file.magazine.clone()),
            logic: (!file.logic.is_empty()).then(|| Logic::new(Arc::clone(&file.logic))),
            decoded: Vec::new(),
            switches: file.limit_switches(),
            tells_signals: false,
            den: false,
            signals_until: 0.0,
            holds_motion: false,
            drives: None,
            unknown: AxisSet::NONE,
        }
    }

    /// The second stored stroke area is that of another machine in virtual time.
    pub fn take_area(&mut self, other: &VirtualMachine) {
        self.area = other.area;
    }

    /// Checking on after an alarm: where these axes are is not known.
    pub fn set_unknown(&mut self, axes: AxisSet) {
        self.unknown = axes;
    }

    /// The skip signal, held by hand.
    pub fn set_skip(&mut self, on: bool) {
        self.skip = on;
    }

    /// The skip signal comes in the middle of the move under way, at this place.
    pub fn skip_at(&mut self, at: Option<Point>) {
        self.skipped_at = at.map(|at| at.map(|coordinate| (coordinate * 1e6).round() / 1e6));
    }

    /// True if nothing is known yet of when the skip signal comes.
    pub fn awaits_skip(&self) -> bool {
        !self.skip && self.contact.is_empty()
    }

    /// Where the skip signal comes: axes and machine coordinates, mm or degrees.
    pub fn set_contact(&mut self, contact: Vec<(usize, f64)>) {
        self.contact = contact;
    }

    /// The part of a line up to where the skip signal comes, if it comes: the fraction of it, and the end.
    ///
    /// An axis that begins on a face of the contact does not cross it: it may be moving away.
    fn until_signal(&self, from: &Point, to: &Point) -> Option<(f64, Point)> {
        if let Some(at) = self.skipped_at {
            return Some((1.0, at));
        }
        if self.skip {
            return Some((0.0, *from));
        }
        let crossing = |&(axis, face): &(usize, f64)| {
            let at = (face - from[axis]) / (to[axis] - from[axis]);
            (at > 0.0 && at <= 1.0).then_some((at, axis, face))
        };
        let first = self.contact.iter().filter_map(crossing).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut end = along(from, to, first.0);
        for axis in 0..end.len() {
            // The counters stand on whole nanometres, as programs' words do.
            end[axis] = if from[axis] == to[axis] { from[axis] } else { (end[axis] * 1e6).round() / 1e6 };
        }
        end[first.1] = (first.2 * 1e6).round() / 1e6;
        Some((first.0, end))
    }

    /// Setpoints are taken as drives take them: in steps of an increment, mm or degrees.
    pub fn drive_in(&mut self, increment: f64) {
        self.drives = Some(Drives::at(&self.position, increment));
    }

    /// What the drives have been sent, if setpoints are taken.
    pub fn drives(&self) -> Option<&Drives> {
        self.drives.as_ref()
    }

    /// True if a move is not made to its end: it would leave the travel. Refused or stopped at the border, the axes stand
    /// before it.
    pub fn cannot_end(&self, timed: &Timed<'_>) -> bool {
        self.refusal(timed).is_some()
    }

    /// The part of a move that stays within the travel and out of the stored stroke area, and why it is not all of it.
    pub fn free_part(&self, timed: &Timed<'_>) -> (Shape, Option<Refusal>) {
        match self.refusal(timed) {
            Some((refusal, met)) => (until(&timed.shaped.shape, &met, self.rates.as_ref()).0, Some(refusal)),
            None => (timed.shaped.shape, None),
        }
    }

    fn tell(&self, told: &mut Vec<Event>, place: &Place, kind: EventKind) {
        told.push(Event { time: self.time, place: *place, kind });
    }

    /// Why a move may not be made as a whole, and where on its way.
    fn refusal(&self, timed: &Timed<'_>) -> Option<(Refusal, Met)> {
        if !timed.shaped.certain {
            return None;
        }
        let (shape, rates) = (&timed.shaped.shape, self.rates.as_ref());
        let place = &timed.shaped.place;
        let alarm = |condition, values, axis: usize| Refusal {
            alarm: Alarm::new(condition, *place, place.block).with(values).on_axis(axis),
        };
        if self.area.is_none() && self.travel.exit(shape).is_none() {
            return None;
        }
        let out = self.travel.meets(shape, rates).filter(|(exit, _)| !self.unknown.has(exit.axis));
        let out = out.map(|(Exit { axis, reaches }, met)| {
            let values = [reaches, self.travel.low[axis], self.travel.high[axis]];
            (alarm(Condition::TravelExceeded, values, axis), met)
        });
        let area =
            self.area.as_ref().filter(|area| timed.shaped.stroke_check && area.axes.and(self.unknown).is_empty());
        // Checking on behind a refused move, where the next one begins is not where the axes are.
        let believed = |met: &Met| met.at == 0.0 && start_of(shape) != Some(&self.position);
        let into =
            area.and_then(|area| offence(area, shape, rates)).filter(|(met, _)| !believed(met)).map(|(met, what)| {
                match what {
                    Offence::Enters(at) => (alarm(Condition::StrokeAreaEntered, self.xyz(area, &at), met.axis), met),
                    Offence::Leaves(values) => (alarm(Condition::StrokeAreaLeft, values, met.axis), met),
                }
            });
        match (out, into) {
            (Some(out), Some(into)) if into.1.at < out.1.at => Some(into),
            (out, into) => out.or(into),
        }
    }

    /// The coordinates of a point along the axes of the area.
    fn xyz(&self, area: Option<&StrokeArea>, at: &Point) -> [f64; 3] {
        let mut values = [0.0; 3];
        if let Some(area) = area {
            for (value, axis) in values.iter_mut().zip(area.axes.iter()) {
                *value = at[axis];
            }
        }
        values
    }

    /// Runs a shape that is this part of the timed one.
    fn run(&mut self, shape: &Shape, timed: &Timed<'_>, part: f64, told: &mut Vec<Event>) {
        let place = &timed.shaped.place;
        let Timed { duration, length, feed, pace, .. } = *timed;
        let (duration, length) = (Seconds(duration.0 * part), length * part);
        self.pass_until(self.time + duration, told);
        let (time, place) = (self.time, *place);
        match shape {
            Shape::Rapid { from, to, .. } => {
                self.position = *to;
                told.push(Event {
                    time,
                    place,
                    kind: EventKind::Rapid { from: *from, to: *to, duration, length, pace },
                });
            }
            Shape::Line { from, to, .. } => {
                self.position = *to;
                told.push(Event {
                    time,
                    place,
                    kind: EventKind::Feed { from: *from, to: *to, feed, duration, length, pace },
                });
            }
            Shape::Arc { arc, .. } => {
                self.position = arc.to;
                told.push(Event { time, place, kind: EventKind::Arc { arc: *arc, feed, duration, length, pace } });
            }
            _ => {}
        }
    }
}

fn start_of(shape: &Shape) -> Option<&Point> {
    match shape {
        Shape::Rapid { from, .. } | Shape::Line { from, .. } => Some(from),
        Shape::Arc { arc, .. } => Some(&arc.from),
        _ => None,
    }
}

impl Machine for VirtualMachine {
    fn check(&self, timed: &Timed<'_>) -> Result<(), Refusal> {
        if self.stroke_check == StrokeCheck::AtBorder {
            return Ok(());
        }
        self.refusal(timed).map_or(Ok(()), |(refusal, _)| Err(refusal))
    }

    fn execute(&mut self, timed: &Timed<'_>, told: &mut Vec<Event>) -> Result<(), Refusal> {
        let place = &timed.shaped.place;
        match &timed.shaped.shape {
            Shape::Code(code) => self.send(*code, place, told),
            Shape::Dwell(dwell) => {
                self.wait_to_move(place, told);
                self.pass_until(self.time + timed.duration, told);
                self.tell(told, place, EventKind::Dwell(*dwell));
            }
            Shape::Set(value) => {
                if let SetValue::StrokeArea(area) = value {
                    self.area = Some(*area);
                }
                self.tell(told, place, EventKind::Set(*value));
            }
            Shape::Start(groups) => self.tell(told, place, EventKind::Start(*groups)),
            shape @ (Shape::Rapid { .. } | Shape::Line { .. } | Shape::Arc { .. }) => {
                // A move that no block has made is one by hand, and has been made already.
                if place.line > 0 {
                    self.wait_to_move(place, told);
                }
                let signal = match shape {
                    Shape::Line { from, to, feed } if timed.shaped.until_signal => {
                        let signal = self.until_signal(from, to);
                        self.was_skipped = signal.is_some();
                        signal.map(|(at, to)| (at, Shape::Line { from: *from, to, feed: *feed }))
                    }
                    _ => None,
                };
                let refused = self.refusal(timed).filter(|(_, met)| {
                    let before = signal.is_some_and(|(at, _)| at <= met.at);
                    !(before && self.stroke_check == StrokeCheck::AtBorder)
                });
                if let (Some((part, shape)), None) = (&signal, &refused) {
                    if *part > 0.0 {
                        self.run(shape, timed, *part, told);
                    }
                    return Ok(());
                }
                match refused {
                    Some((refusal, met)) => {
                        if self.stroke_check == StrokeCheck::AtBorder {
                            let (before, part) = until(shape, &met, self.rates.as_ref());
                            if part > 0.0 {
                                self.run(&before, timed, part, told);
                            }
                        }
                        return Err(refusal);
                    }
                    None => self.run(shape, timed, 1.0, told),
                }
            }
            Shape::Await(_) => {
                self.await_codes(place, told);
                self.holds_motion = false;
            }
            Shape::Close(_) | Shape::Alarm(_) => {}
        }
        Ok(())
    }

    fn finish_block(&mut self, place: &Place, waits: bool, told: &mut Vec<Event>) {
        if waits {
            self.await_codes(place, told);
        }
        self.holds_motion = false;
        self.tell(told, place, EventKind::BlockDone);
    }

    fn position(&self) -> &Point {
        &self.position
    }

    fn follow(&mut self, time: Seconds, setpoint: &Setpoint) {
        if let Some(drives) = &mut self.drives {
            drives.follow(time, setpoint);
        }
    }

    fn was_skipped(&self) -> bool {
        self.was_skipped
    }

    fn time(&self) -> Seconds {
        self.time
    }
}
