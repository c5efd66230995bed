//! A command to its operations, one at a time: codes, motion piece by piece, codes after motion, the close.

use base::{AXES, AxisSet, Point};
use dialect::M01OffOutput;

use crate::arc::closed_arc;
use crate::centring::Centring;
use crate::command::{Body, Command, Finish, TipMove};
use crate::cycle::{Cursor, Holes, Spindle, Step, begins_at_r, next_step};
use crate::operation::{Act, ArcMove, Close, CodeLine, CodeOut, Dwell, Feed, Operation, RapidKind, StopKind};
use crate::setting::{Setting, to_mm};

/// Which part of the block is next.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    /// No command is at hand.
    Idle,
    CodesBefore,
    Body,
    CodesAfter,
    Close,
    Done,
}

/// How far the work on a command is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Expansion {
    part: Part,
    index: u8,
    phase: u8,
    hole: u32,
    cursor: Cursor,
    position: Point,
    /// Where a move that waits for the skip signal ends without it.
    target: Point,
    /// Where the signal came along the axis that is being centred.
    hits: [f64; 2],
    /// Where that axis stood before.
    start: f64,
    /// The signal did not come.
    missed: bool,
}

impl Expansion {
    /// An expansion with no command at hand.
    pub fn idle() -> Expansion {
        Expansion {
            part: Part::Idle,
            index: 0,
            phase: 0,
            hole: 0,
            cursor: Cursor::default(),
            position: [0.0; AXES],
            target: [0.0; AXES],
            hits: [0.0; 2],
            start: 0.0,
            missed: false,
        }
    }

    pub fn is_idle(&self) -> bool {
        self.part == Part::Idle
    }

    /// Begins with a command; written field by field, for it is done for every block.
    pub fn begin(&mut self, command: &Command) {
        self.part = Part::CodesBefore;
        (self.index, self.phase, self.hole) = (0, 0, 0);
        // A single move asks for none of the rest.
        if !matches!(command.body, Body::Line { .. } | Body::Rapid { .. }) {
            self.cursor = Cursor::default();
            (self.position, self.target) = (command.from, command.from);
            (self.hits, self.start) = ([0.0; 2], 0.0);
            self.missed = false;
        }
    }

    /// The command is done with.
    pub fn end(&mut self) {
        self.part = Part::Idle;
    }

    /// A move that waits for the skip signal has ended here (mm and degrees); the same in counts.
    pub fn arrived(&mut self, at: &Point, signalled: bool) -> Point {
        for axis in 0..AXES {
            // Where the axis is just where it was, or was to go, its counts are known to the last digit.
            self.position[axis] = match at[axis] {
                at if at == self.target[axis] / 1e6 => self.target[axis],
                at if at == self.position[axis] / 1e6 => self.position[axis],
                at => (at * 1e6).round(),
            };
        }
        self.missed = !signalled;
        self.position
    }

    /// The axis that has been centred on both sides now, and its middle.
    pub fn middle(&mut self, centring: &Centring) -> Option<(usize, f64)> {
        // A phase has been stepped on when its move ends.
        let (measure, side) = (usize::from(self.phase.saturating_sub(1)) / 3, (self.phase.saturating_sub(1)) % 3);
        let axis = centring.along.iter().flatten().nth(measure).map(|&(axis, _)| usize::from(axis))?;
        self.hits[usize::from(side == 1)] = self.position[axis];
        (side == 1).then_some((axis, (self.hits[0] + self.hits[1]) / 2.0))
    }

    /// The close of the block is handed out once more.
    pub fn close_again(&mut self) {
        self.part = Part::Close;
    }

    /// Writes the next operation of the command to `out`; false when the block is done.
    pub fn next(&mut self, command: &Command, setting: &Setting, out: &mut Operation) -> bool {
        out.stop_point = false;
        out.until_signal = false;
        out.closes = false;
        if !self.next_act(command, setting, out) {
            return false;
        }
        out.block = command.block;
        out.place = command.place;
        out.compensated = command.offset.is_some();
        out.stroke_check = command.stroke_check;
        out.from_unknown = command.from_unknown;
        true
    }

    /// Writes what happens next; false when the block is done.
    fn next_act(&mut self, command: &Command, setting: &Setting, out: &mut Operation) -> bool {
        if self.part == Part::CodesBefore {
            if let Some(code) = self.next_code(command, false, setting) {
                out.act = Act::Code(code);
                return true;
            }
            self.part = Part::Body;
        }
        if self.part == Part::Body {
            if self.next_move(command, out) {
                // There is no second piece of it, and mostly nothing behind it.
                out.closes = command.code_count == 0 && command.finish == Finish::Next;
                (self.part, self.index) = (if out.closes { Part::Done } else { Part::CodesAfter }, 0);
                return true;
            }
            if let Some(act) = self.next_piece(command, setting, out) {
                out.act = act;
                return true;
            }
            (self.part, self.index) = (Part::CodesAfter, 0);
        }
        if self.part == Part::CodesAfter {
            if let Some(code) = self.next_code(command, true, setting) {
                out.act = Act::Code(code);
                return true;
            }
            self.part = Part::Close;
        }
        if self.part == Part::Close {
            self.part = Part::Done;
            out.act = Act::Close(close(command.finish, setting.switches.optional_stop));
            return true;
        }
        false
    }

    fn next_code(&mut self, command: &Command, after: bool, setting: &Setting) -> Option<CodeOut> {
        while self.index < command.code_count {
            let index = self.index;
            self.index += 1;
            let code = command.codes[usize::from(index)];
            let disregarded = command.optional_code == Some(index) && !passes_m01(setting);
            if code.after_motion == after && !disregarded {
                return Some(code);
            }
        }
        None
    }

    /// The usual case first: a single line or rapid, written where it goes to without a copy.
    #[inline]
    fn next_move(&mut self, command: &Command, out: &mut Operation) -> bool {
        if self.phase > 0 {
            return false;
        }
        match &command.body {
            Body::Line { to, feed } => cut(&mut out.act, to, feed),
            Body::Rapid { to, kind } => out.act = Act::Rapid { to: to_mm(to), kind: *kind },
            _ => return false,
        }
        self.phase = 1;
        true
    }

    /// On its own: most blocks are single moves, and an act handed on by value is large.
    #[inline(never)]
    fn next_piece(&mut self, command: &Command, setting: &Setting, out: &mut Operation) -> Option<Act> {
        match &command.body {
            Body::Holes(holes) => return self.next_in_hole(holes, setting, &mut out.stop_point),
            Body::Skip { .. } => return self.next_in_skip(command, out),
            Body::Tip(tip) => return self.next_of_tip(tip, command),
            Body::Centring(centring) => return self.next_in_centring(centring, out),
            _ => {}
        }
        let phase = self.phase;
        self.phase += 1;
        match (&command.body, phase) {
            (Body::Arc { foot: Some(_), .. }, _) => closed_arc(&command.body, phase),
            (Body::Arc { to, center, axes, plane, clockwise, full_circle, feed, .. }, 0) => Some(Act::Arc {
                arc: ArcMove {
                    to: to_mm(to),
                    plane: *plane,
                    axes: *axes,
                    center: [center[0] / 1e6, center[1] / 1e6],
                    clockwise: *clockwise,
                    full_circle: *full_circle,
                },
                feed: *feed,
            }),
            (Body::Checked { to, .. }, 0) => Some(Act::Rapid { to: to_mm(to), kind: RapidKind::Checked }),
            (Body::Checked { alarm: Some(alarm), .. }, 1) => Some(Act::Alarm(*alarm)),
            (Body::Circle(cut), phase) => cut.piece(phase),
            (Body::Via { via, stops, .. }, 0) => {
                out.stop_point = *stops;
                Some(Act::Rapid { to: to_mm(via), kind: RapidKind::Checked })
            }
            (Body::Via { to, .. }, 1) => Some(Act::Rapid { to: to_mm(to), kind: RapidKind::Checked }),
            (Body::Dwell(dwell), 0) => Some(Act::Dwell(*dwell)),
            (Body::Set(value, _), 0) => Some(Act::Set(*value)),
            (Body::Set(_, Some(value)), 1) => Some(Act::Set(*value)),
            (Body::Alarm(alarm), 0) => Some(Act::Alarm(*alarm)),
            (Body::Start(groups), 0) => Some(Act::Start(*groups)),
            _ => None,
        }
    }

    /// The next part of a way of the tool's tip: where it would stand upright, straight on, and the machine with it.
    #[cold]
    #[inline(never)]
    fn next_of_tip(&mut self, tip: &TipMove, command: &Command) -> Option<Act> {
        if self.hole >= tip.parts {
            return None;
        }
        self.hole += 1;
        if self.hole == tip.parts {
            return Some(Act::Line { to: to_mm(&tip.machine), feed: tip.feed });
        }
        let part = f64::from(self.hole) / f64::from(tip.parts);
        let from = tip.kinematics.upright(&to_mm(&command.from), tip.lengths[0]);
        let to = to_mm(&tip.upright);
        let between: Point = std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * part);
        let length = tip.lengths[0] + (tip.lengths[1] - tip.lengths[0]) * part;
        let feed = Feed { exact_stop: false, ..tip.feed };
        Some(Act::Line { to: tip.kinematics.placed(&between, length), feed })
    }

    /// A line until the skip signal, and the alarm where it did not come.
    #[cold]
    #[inline(never)]
    fn next_in_skip(&mut self, command: &Command, out: &mut Operation) -> Option<Act> {
        let Body::Skip { to, feed, missed } = &command.body else { return None };
        self.phase += 1;
        match (self.phase, missed) {
            (1, _) => {
                self.target = *to;
                out.until_signal = true;
                Some(Act::Line { to: to_mm(to), feed: *feed })
            }
            (2, Some(alarm)) if self.missed => Some(Act::Alarm(*alarm)),
            _ => None,
        }
    }

    /// Three phases an axis: to one side, to the other, to the middle.
    #[cold]
    #[inline(never)]
    fn next_in_centring(&mut self, centring: &Centring, out: &mut Operation) -> Option<Act> {
        let phase = self.phase;
        let &(axis, distance) = centring.along.iter().flatten().nth(usize::from(phase) / 3)?;
        let axis = usize::from(axis);
        if self.missed {
            self.phase = u8::MAX;
            self.missed = false;
            return Some(Act::Alarm(centring.missed));
        }
        self.phase += 1;
        let to = match phase % 3 {
            0 => {
                self.start = self.position[axis];
                self.start + distance
            }
            1 => self.start - distance,
            _ => {
                self.position[axis] = (self.hits[0] + self.hits[1]) / 2.0;
                return Some(self.rapid(RapidKind::Checked));
            }
        };
        self.target = self.position;
        self.target[axis] = to;
        out.until_signal = true;
        Some(Act::Line { to: to_mm(&self.target), feed: centring.feed })
    }

    /// Phases of a hole: 0 the approach from one side, 1 the position, 2 the R level, 3 the cycle's own steps.
    fn next_in_hole(&mut self, holes: &Holes, setting: &Setting, stop_point: &mut bool) -> Option<Act> {
        let count = holes.places.count();
        while self.hole < count {
            let phase = self.phase;
            // From the third on the cycle's own cursor counts, however many pecks a hole has.
            self.phase = (phase + 1).min(3);
            let act = match (phase, holes.cycle) {
                (0 | 1, _) => {
                    // A place without a hole ends the block if it is the last.
                    *stop_point = phase == 1 && (holes.cycle.is_some() || self.hole + 1 < count);
                    self.place_move(phase == 0, holes)
                }
                (2, Some(cycle)) if begins_at_r(cycle) => {
                    self.position[usize::from(holes.axis)] = holes.r;
                    *stop_point = true;
                    Some(self.rapid(holes.rapid))
                }
                (2, Some(_)) => None,
                (_, cycle) => {
                    let step = if cycle.is_some() { next_step(holes, &mut self.cursor) } else { Step::Done };
                    if step != Step::Done {
                        self.step(step, holes, setting)
                    } else {
                        self.hole += 1;
                        self.phase = 0;
                        self.cursor = Cursor::default();
                        // The machine has answered before the next hole is begun; the last one ends with its block.
                        *stop_point = cycle.is_some() && self.hole < count;
                        stop_point.then_some(Act::Await(None))
                    }
                }
            };
            if act.is_some() {
                return act;
            }
        }
        None
    }

    /// The move to the hole's place, or before it to where the approach from one side begins.
    fn place_move(&mut self, approaching: bool, holes: &Holes) -> Option<Act> {
        let axis = usize::from(holes.axis);
        let mut place = holes.places.at(self.hole);
        if holes.cycle.is_some() {
            place[axis] = self.position[axis];
        }
        if approaching {
            place = approach(&self.position, &place, &holes.approach)?;
        }
        self.position = place;
        Some(self.rapid(holes.rapid))
    }

    fn rapid(&self, kind: RapidKind) -> Act {
        Act::Rapid { to: to_mm(&self.position), kind }
    }

    fn step(&mut self, step: Step, holes: &Holes, setting: &Setting) -> Option<Act> {
        let axis = usize::from(holes.axis);
        match step {
            Step::Rapid(level) => {
                self.position[axis] = level;
                Some(self.rapid(holes.rapid))
            }
            Step::Feed(level) | Step::Tap(level) => {
                self.position[axis] = level;
                let feed = Feed { tapping: matches!(step, Step::Tap(_)), ..holes.feed };
                Some(Act::Line { to: to_mm(&self.position), feed })
            }
            Step::Dwell(seconds) => (seconds > 0.0).then_some(Act::Dwell(Dwell::Seconds(seconds))),
            Step::Spindle(spindle) => Some(spindle_code(spindle, setting)),
            Step::Start if self.hole > 0 => None,
            Step::Start => holes.start.map(|spindle| spindle_code(spindle, setting)),
            Step::Restart => holes.restart.map(|spindle| spindle_code(spindle, setting)),
            Step::Aside => {
                for (axis, shift) in holes.shift_axes.into_iter().zip(holes.shift) {
                    self.position[usize::from(axis)] += shift;
                }
                Some(self.rapid(holes.rapid))
            }
            Step::Back => {
                let place = holes.places.at(self.hole);
                for axis in holes.shift_axes.map(usize::from) {
                    self.position[axis] = place[axis];
                }
                Some(self.rapid(holes.rapid))
            }
            Step::ByHand => holes.by_hand.then_some(Act::Await(Some(StopKind::Cycle))),
            Step::Done => None,
        }
    }
}

/// On its own, as [`Command::cut_to`] is.
#[inline(never)]
fn cut(act: &mut Act, to: &Point, feed: &Feed) {
    *act = Act::Line { to: to_mm(to), feed: *feed };
}

fn spindle_code(spindle: Spindle, setting: &Setting) -> Act {
    let code = setting.control.cycle_codes[spindle as usize];
    Act::Code(CodeOut { line: CodeLine::M, code, digits: setting.facts.codes.digits[0], after_motion: true })
}

/// Where a move from one side goes first, if any of its axes has such a side.
fn approach(from: &Point, to: &Point, distances: &Point) -> Option<Point> {
    let mut moving = AxisSet::NONE;
    let mut via = *to;
    for axis in 0..AXES {
        if distances[axis] != 0.0 && from[axis] != to[axis] {
            via[axis] -= distances[axis];
            moving.add(axis);
        }
    }
    (!moving.is_empty()).then_some(via)
}

/// Whether the code of M01 goes out: its switch is looked at when the block is executed.
fn passes_m01(setting: &Setting) -> bool {
    setting.switches.optional_stop || setting.fitting.policies.m01_off_output == M01OffOutput::Code
}

fn close(finish: Finish, optional_stop: bool) -> Close {
    match finish {
        Finish::OptionalStop if !optional_stop => Close::Next,
        Finish::Next => Close::Next,
        Finish::End(kind) => Close::End(kind),
        Finish::ProgramStop | Finish::OptionalStop => finish.stop().map_or(Close::Next, Close::Stop),
    }
}
