//! Which blocks lose time, and what holds them: a run's moves held against the speeds that they ask for.
//!
//! Comes in: events of a session that plans ahead. Goes out: the blocks that lose most, with their causes and what would
//! help. What a move loses is its time less its length at the speed it asks for, and has three parts: what the axes'
//! limits leave of that speed on the move itself, what it loses because it begins slower, and because it ends slower.
//! For a constant acceleration the last two are as the squares of the missing speeds.

mod advice;
mod cause;
mod face;
mod top;

use base::{Place, Point, ProgramId, SourceId};
use dialect::{Control, MMeaning, Meaning};
use machine::{CodeTimes, Event, EventKind, MachineFile, StopCause};
use meaning::{CodeLine, CodeOut};
use motion::{Limits, Model, Pace, Way};
use station::{Library, Session};

pub use cause::Cause;
use cause::{CAUSES, Detail};
pub(crate) use face::why_json;
pub use face::why_text;
use top::{Block, Top};

use crate::cycle_time::{asked, lost};
use crate::explain::printable;

/// Speeds are told to so many digits.
const ROUNDING: f64 = 1e-6;
/// What is less, s, is nothing but rounding.
const LEAST: f64 = 1e-7;
/// Speeds nearer than this part of each other are the same.
const SAME: f64 = 1e-3;
/// A turn as sharp as this (its cosine) is never rounded: 150°.
const REVERSAL: f64 = -0.866;
/// A turn by less than this (its cosine) is none.
const STRAIGHT: f64 = 1.0 - 1e-9;
/// Characters of a block that are shown.
const SHOWN: usize = 72;

/// A cut, as far as the next one must know.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Cut {
    place: Place,
    pace: Pace,
    /// Its direction at its end.
    heading: Point,
    /// It ends with an exact stop: 0 for the code of the block, 1 for the modal one.
    exact_stop: Option<u8>,
    /// What it loses because it ends slower than it may run, s.
    at_end: f64,
    /// Its block has ended.
    block_done: bool,
}

/// What stands between two moves, or ends one.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Next<'n> {
    Cut(&'n Pace, &'n Point),
    Because(Cause, Option<CodeOut>),
}

/// A block that loses time.
#[derive(Clone, PartialEq, Debug)]
pub struct Loss {
    /// Its program, and its line there.
    pub program: String,
    /// Its line.
    pub line: u64,
    /// The block.
    pub text: String,
    /// What it loses in all its executions, s; dwell and waiting are counted whole.
    pub seconds: f64,
    /// What it may have lost beside that while others stood on the list, s.
    pub maybe: f64,
    /// Executions counted.
    pub times: u64,
    /// What holds it, the worst first, s.
    pub causes: Vec<(Cause, f64)>,
    /// What holds it in words, with its numbers.
    pub held: String,
    /// What would help.
    pub help: String,
}

/// What a run loses, and where.
pub struct Losses {
    limits: Limits,
    letters: Vec<char>,
    times: CodeTimes,
    top: Top,
    by_cause: [f64; CAUSES],
    cut: Option<Cut>,
    /// Why the axes stood last.
    stood: (Cause, Option<CodeOut>),
    /// Which code made them stand, if it was an exact stop.
    exact_by: u8,
    /// M codes that stop or end the program.
    stops: Vec<u32>,
    /// The code that went out last on each line.
    sent: [Option<CodeOut>; 4],
    /// Names of the codes G09 and G61, and of what ends G61.
    exact: [Option<String>; 3],
}

impl Losses {
    /// Nothing lost yet.
    pub fn new(control: &Control, machine: &MachineFile) -> Losses {
        let exact = [Meaning::ExactStop, Meaning::ExactStopMode, Meaning::CuttingMode];
        let stops = [MMeaning::ProgramStop, MMeaning::OptionalStop, MMeaning::ProgramEnd, MMeaning::TapeEnd];
        Losses {
            limits: machine.limits(),
            letters: machine.axes.iter().map(|axis| char::from(axis.letter)).collect(),
            times: machine.times.clone(),
            top: Top::default(),
            by_cause: [0.0; CAUSES],
            cut: None,
            stood: (Cause::Standing, None),
            exact_by: 1,
            stops: stops.iter().filter_map(|&meaning| control.m_of(meaning).map(|row| row.code.into())).collect(),
            sent: [None; 4],
            exact: exact.map(|meaning| control.row_of(meaning).map(|row| control.g_name(row))),
        }
    }

    /// Takes an event in.
    pub fn see<L: Library>(&mut self, session: &Session<L>, event: &Event) {
        let place = &event.place;
        match &event.kind {
            EventKind::Feed { from, to, duration, length, pace, .. } => {
                let way = Way::line(from, to, self.limits.count);
                self.cuts(session, place, &way, (duration.0, *length, pace));
            }
            EventKind::Arc { arc, duration, length, pace, .. } => {
                self.cuts(session, place, &Way::arc(arc), (duration.0, *length, pace));
            }
            EventKind::Rapid { from, to, duration, length, pace } => {
                self.end(Next::Because(Cause::BesideRapid, None));
                let detail = Detail { axis: self.slowest(from, to, *length), ..Detail::default() };
                self.lose(place, Cause::Positioning, lost(duration.0, *length, pace), detail, false);
            }
            EventKind::Dwell(dwell) => {
                self.end(Next::Because(Cause::Standing, None));
                self.lose(place, Cause::Dwell, dwell.seconds(), Detail::default(), false);
            }
            EventKind::Code(code) => {
                let stops = code.line == CodeLine::M && self.stops.contains(&code.code);
                self.end(Next::Because(if stops { Cause::Standing } else { Cause::Code }, Some(*code)));
                self.sent[code.line.index()] = Some(*code);
            }
            EventKind::Waited(seconds) => {
                // Of several codes the slowest is waited for last, and it is the others' answer too.
                let code = self.sent.iter().flatten().max_by_key(|code| code.line == CodeLine::M).copied();
                self.lose(place, Cause::Waiting, seconds.0, Detail { code, ..Detail::default() }, false);
            }
            EventKind::Finished(line) => {
                let sent = self.sent[line.index()].take();
                self.top.name(place, sent);
            }
            EventKind::Stop(StopCause::Program(_)) | EventKind::End { .. } | EventKind::Alarm(_) => {
                self.end(Next::Because(Cause::Standing, None));
            }
            EventKind::BlockDone => {
                if let Some(cut) = self.cut.as_mut().filter(|cut| cut.place.block == place.block) {
                    cut.block_done = true;
                }
                self.top.done(place);
            }
            _ => {}
        }
    }

    fn cuts<L: Library>(
        &mut self,
        session: &Session<L>,
        place: &Place,
        way: &Way,
        (seconds, length, pace): (f64, f64, &Pace),
    ) {
        let [before, after] = [0.0, way.length()].map(|s| unit(&way.slope(s)));
        let asked = asked(pace);
        let all = lost(seconds, length, pace);
        let allowed = f64::from(pace.allowed).min(asked);
        let is_held = allowed > 0.0 && allowed < asked * (1.0 - ROUNDING);
        let by_limits = if is_held { (length / allowed - length / asked).min(all) } else { 0.0 };
        let missing = [pace.start, pace.end].map(|speed| (allowed - f64::from(speed)).max(0.0));
        let missing = missing.map(|speed| speed * speed);
        let sum = missing[0] + missing[1];
        let rest = (all - by_limits).max(0.0);
        let from_rest = pace.start <= 0.0;
        let part = |own: f64| if sum > 0.0 { rest * own / sum } else { rest / 2.0 };
        let reaches = f64::from(pace.top) >= allowed * (1.0 - SAME);
        let classic = matches!(self.limits.model, Model::Classic(_));
        let [lost_at_start, lost_at_end] = match self.rest_to_speed(way, allowed) {
            _ if classic => [rest, 0.0],
            // What a start or a stop costs is known; a corner at the other end also has its own short way round.
            Some(own) if reaches && from_rest => [own.min(rest), (rest - own).max(0.0)],
            Some(own) if reaches && pace.end <= 0.0 => [(rest - own).max(0.0), own.min(rest)],
            _ => missing.map(part),
        };
        let turn = self.cut.as_ref().map_or(1.0, |cut| dot(&cut.heading, &before));
        let at_start = self.end(Next::Cut(pace, &before));
        let at_start = match (classic, from_rest) {
            (true, _) => (Cause::Control, None),
            (false, true) => self.stood,
            (false, false) => at_start,
        };
        let (limit, axis, radius) = self.limit(way, allowed);
        let reached = f64::from(pace.top);
        let detail = Detail {
            axis,
            radius,
            asked,
            allowed,
            reached,
            length,
            passed: f64::from(pace.start),
            turn,
            code: at_start.1,
        };
        self.lose(place, limit, by_limits, detail, false);
        let by = if at_start.0 == Cause::ExactStop { self.exact_by } else { axis };
        self.lose(place, at_start.0, lost_at_start, Detail { axis: by, ..detail }, false);
        let exact_stop = session.stops_exactly().then(|| exact_code(session));
        let (at_end, heading) = (lost_at_end, after);
        self.cut = Some(Cut { place: *place, pace: *pace, heading, exact_stop, at_end, block_done: false });
        self.top.pending =
            Detail { axis: exact_stop.unwrap_or(axis), code: None, passed: f64::from(pace.end), ..detail };
    }

    /// What comes behind the last cut says why it ended as it did, and why what comes begins so.
    fn end(&mut self, next: Next<'_>) -> (Cause, Option<CodeOut>) {
        let Some(cut) = self.cut.take() else {
            return self.stand(&next);
        };
        self.exact_by = cut.exact_stop.unwrap_or(1);
        let pace = &cut.pace;
        let [start, top, end] = [pace.start, pace.top, pace.end].map(f64::from);
        let mut turn = 1.0;
        let (at_end, at_start) = match next {
            Next::Because(cause, code) => {
                // An exact stop is none where the axes stand in any case.
                self.stood = (cause, code);
                (self.stood, self.stood)
            }
            Next::Cut(_, heading) if end <= 0.0 => {
                turn = dot(&cut.heading, heading);
                let cause = match turn {
                    _ if cut.exact_stop.is_some() => Cause::ExactStop,
                    turn if turn < REVERSAL => Cause::Reversal,
                    turn if turn < STRAIGHT => Cause::Corner,
                    _ => Cause::Asked,
                };
                self.stood = (cause, None);
                (self.stood, self.stood)
            }
            Next::Cut(next, heading) => {
                turn = dot(&cut.heading, heading);
                let brakes = end < top * (1.0 - SAME);
                let gains = start < end * (1.0 - SAME);
                let [begins, fastest] = [next.start, next.top].map(f64::from);
                let speeds_up = fastest > begins * (1.0 + SAME);
                let turns = turn < STRAIGHT;
                let corner = |is: bool| if is && turns { Cause::Corner } else { Cause::Change };
                let own = corner(if brakes { speeds_up } else { !gains });
                let others =
                    corner(if speeds_up { brakes || !gains } else { f64::from(next.end) >= begins * (1.0 - SAME) });
                ((own, None), (others, None))
            }
        };
        let detail = Detail { turn, code: at_end.1, ..self.top.pending };
        self.lose(&cut.place, at_end.0, cut.at_end, detail, cut.block_done);
        at_start
    }

    /// As [`Losses::end`], where no cut comes before.
    fn stand(&mut self, next: &Next<'_>) -> (Cause, Option<CodeOut>) {
        if let Next::Because(cause, code) = *next {
            self.stood = (cause, code);
        }
        self.stood
    }

    fn lose(&mut self, place: &Place, cause: Cause, seconds: f64, detail: Detail, is_done: bool) {
        if seconds > LEAST {
            self.by_cause[cause as usize] += seconds;
            self.top.add(place, cause, seconds, detail, is_done);
        }
    }

    /// What a straight way loses from rest to a speed, s.
    fn rest_to_speed(&self, way: &Way, speed: f64) -> Option<f64> {
        let Way::Line { along, .. } = way else { return None };
        let axes = self.limits.axes.iter().zip(along).take(self.limits.count).filter(|(_, along)| **along != 0.0);
        let acceleration = axes.map(|(axis, along)| axis.acceleration / along.abs()).fold(f64::INFINITY, f64::min);
        Some(speed / 2.0 / acceleration)
    }

    /// What holds a cut at less than its F: an axis' highest feed, or the pull towards the centre of an arc.
    fn limit(&self, way: &Way, allowed: f64) -> (Cause, u8, f64) {
        let axes = &self.limits.axes[..self.limits.count];
        let slope = way.slope(way.length() / 2.0);
        if let Way::Arc { arc, .. } = way {
            let [u, v] = arc.axes.map(usize::from);
            let rate = axes[u].max_feed.min(axes[v].max_feed);
            let axis = if axes[u].acceleration <= axes[v].acceleration { u } else { v };
            if allowed < rate * (1.0 - 0.01) {
                return (Cause::Centripetal, axis as u8, arc.radius[0].min(arc.radius[1]));
            }
        }
        let needs = |axis: usize| slope[axis].abs() / axes[axis].max_feed;
        let axis = (0..axes.len()).max_by(|&a, &b| needs(a).total_cmp(&needs(b)));
        (Cause::AxisLimit, axis.unwrap_or(0) as u8, 0.0)
    }

    /// The axis that a rapid move waits for.
    fn slowest(&self, from: &Point, to: &Point, _length: f64) -> u8 {
        let needs = |axis: usize| {
            let (limits, way) = (&self.limits.axes[axis], (to[axis] - from[axis]).abs());
            if way > 0.0 { way / limits.rapid + limits.rapid / limits.acceleration } else { 0.0 }
        };
        (0..self.limits.count).max_by(|&a, &b| needs(a).total_cmp(&needs(b))).unwrap_or(0) as u8
    }

    /// The blocks that lose most, at most so many; `text` gives characters of a text.
    pub fn worst<L: Library>(
        &self,
        session: &mut Session<L>,
        count: usize,
        mut text: impl FnMut(&mut L, SourceId, u64, usize) -> Vec<u8>,
    ) -> Vec<Loss> {
        let main = session.interpreter().main_program().map(|(program, _)| program);
        let mut found = Vec::new();
        for block in self.top.worst(count) {
            let place = &block.place;
            let bytes = text(session.library_mut(), place.source, place.block.start, place.block.len as usize);
            let mut shown = printable(&bytes).trim().to_owned();
            if shown.chars().count() > SHOWN {
                shown = shown.chars().take(SHOWN - 1).chain(['…']).collect();
            }
            found.push(self.loss(block, shown, program_of(session, main, place.program)));
        }
        found
    }

    fn loss(&self, block: &Block, text: String, program: String) -> Loss {
        let mut causes: Vec<_> = Cause::ALL.iter().map(|&cause| (cause, block.lost[cause as usize])).collect();
        causes.retain(|(_, seconds)| *seconds > 0.0);
        causes.sort_by(|a, b| b.1.total_cmp(&a.1));
        // What nothing can be done about is not what is helped, if there is something else.
        let may_be_helped = |(cause, _): &&(Cause, f64)| *cause != Cause::Standing;
        let helped = causes.iter().find(may_be_helped).or(causes.first());
        Loss {
            program,
            line: block.place.line,
            text,
            seconds: block.all(),
            maybe: block.maybe,
            times: block.times.max(1),
            held: self.held(block, &causes),
            help: helped.map_or_else(String::new, |(cause, _)| self.help(*cause, block)),
            causes,
        }
    }

    /// What is lost by each cause, the worst first, s; exact for programs of any length.
    pub fn by_cause(&self) -> Vec<(Cause, f64)> {
        let mut all: Vec<_> = Cause::ALL.iter().map(|&cause| (cause, self.by_cause[cause as usize])).collect();
        all.retain(|(_, seconds)| *seconds > 0.0);
        all.sort_by(|a, b| b.1.total_cmp(&a.1));
        all
    }
}

/// A program's name, nothing for the main one.
fn program_of<L: Library>(session: &Session<L>, main: Option<ProgramId>, program: ProgramId) -> String {
    if main == Some(program) { String::new() } else { session.interpreter().program_name(program).to_owned() }
}

/// Which of the codes of an exact stop acts: 0 that of a block, 1 the modal one.
fn exact_code<L: Library>(session: &Session<L>) -> u8 {
    let one_shot = session.interpreter().executing().and_then(|command| command.wording.one_shot);
    u8::from(one_shot != Some(Meaning::ExactStop))
}

fn dot(a: &Point, b: &Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(of: &Point) -> Point {
    let length = dot(of, of).sqrt();
    if length > 0.0 { of.map(|part| part / length) } else { *of }
}
