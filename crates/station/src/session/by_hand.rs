//! An axis moved by hand: while its button is pressed, by an increment, or to its reference point.
//!
//! It keeps the axis' limits and the overrides, ends within the travel, and stands at once by FEED HOLD, RESET or
//! emergency stop; what is left of it is dropped.

use base::{AXES, AxisSet, Place, Point};
use dialect::{Intervention, Meaning};
use machine::{Machine, Refusal};
use meaning::RapidKind;
use motion::{Setpoint, Stroke, Timed};
use path::{Shape, Shaped};

use super::Session;
use super::locks::CANCELLED_AXIS;
use super::searching::Search;
use crate::library::Library;

/// How an axis is moved by hand.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum HandMove {
    /// Its button is pressed: upwards or not, at the rapid rate or the jog speed.
    Button {
        /// Towards higher coordinates.
        up: bool,
        /// At the rapid rate.
        rapid: bool,
    },
    /// By so much, mm or degrees, at the jog speed.
    By(f64),
    /// To the first reference point, at the rapid rate.
    Home,
    /// To this machine coordinate, at the jog speed: where a program is taken up.
    To(f64),
}

/// A move by hand under way.
#[derive(Clone, Debug)]
pub(super) struct ByHand {
    axis: usize,
    how: HandMove,
    from: Point,
    to: Point,
    stroke: Stroke,
    /// Axes that return to their reference points, in place of the stroke.
    searches: Vec<Search>,
    /// G28 makes it, not a hand.
    of_program: bool,
    elapsed: f64,
    /// A lock switch holds the axis here, and it is only counted.
    locked_at: Option<Point>,
    /// Why it ends before the place that was asked for.
    border: Option<Refusal>,
}

/// A pressed button leads beyond the border of the travel by this, mm or degrees.
const BEYOND: f64 = 0.001;
/// A look whether the axis still moves, s.
const STRIDE_S: f64 = 1.0;

impl ByHand {
    /// Axes on their way to their reference points.
    pub fn searching(how: HandMove, from: Point, searches: Vec<Search>, of_program: bool) -> ByHand {
        let mut to = from;
        searches.iter().for_each(|search| to[search.axis] = search.point());
        let (axis, stroke) =
            (searches.first().map_or(0, |search| search.axis), Stroke::new(0.0, 1.0, 1.0, f64::INFINITY));
        ByHand { axis, how, from, to, stroke, searches, of_program, elapsed: 0.0, locked_at: None, border: None }
    }

    /// True if G28 makes it.
    pub fn is_of_program(&self) -> bool {
        self.of_program
    }

    fn has_arrived(&self) -> bool {
        if self.searches.is_empty() { self.stroke.has_arrived() } else { self.searches.iter().all(Search::has_arrived) }
    }

    fn stands(&self) -> bool {
        if self.searches.is_empty() { self.stroke.leg().is_none() } else { self.searches.iter().all(Search::stands) }
    }

    /// The axes shall stand, or go on.
    pub fn hold(&mut self, held: bool) {
        self.stroke.hold(held);
        self.searches.iter_mut().for_each(|search| search.hold(held));
    }

    /// Goes on for a time, at most to its end; edges of dogs are told with their axis and the time since then.
    fn advance(&mut self, seconds: f64, tell: &mut dyn FnMut(usize, f64, bool)) {
        let left = if self.searches.is_empty() {
            self.stroke.advance(seconds)
        } else {
            let left = self.searches.iter_mut().map(|search| {
                let axis = search.axis;
                search.advance(seconds, &mut |at, on| tell(axis, at, on))
            });
            left.fold(seconds, f64::min)
        };
        self.elapsed += seconds - left;
    }

    pub fn elapsed(&self) -> f64 {
        self.elapsed
    }

    /// Where the axes are, and how fast.
    pub fn setpoint(&self) -> Setpoint {
        match self.locked_at {
            Some(position) => Setpoint { position, velocity: [0.0; AXES] },
            None => self.course(),
        }
    }

    /// Where the control counts an axis to be that a lock switch holds.
    pub fn counted(&self) -> Option<Point> {
        self.locked_at.map(|_| self.course().position)
    }

    fn course(&self) -> Setpoint {
        let mut setpoint = Setpoint { position: self.to, velocity: [0.0; AXES] };
        if !self.searches.is_empty() {
            for search in &self.searches {
                [setpoint.position[search.axis], setpoint.velocity[search.axis]] = search.here();
            }
        } else if !self.stroke.has_arrived() {
            let (here, axis) = (self.stroke.here(), self.axis);
            let sign = (self.to[axis] - self.from[axis]).signum();
            setpoint.position[axis] = self.from[axis] + sign * here.s;
            setpoint.velocity[axis] = sign * here.speed;
        }
        setpoint
    }

    /// To the end of an increment or the reference point; a pressed button has no end.
    pub fn distance_to_go(&self) -> Point {
        match self.how {
            HandMove::Button { .. } => [0.0; AXES],
            _ => {
                let position = self.course().position;
                std::array::from_fn(|axis| self.to[axis] - position[axis])
            }
        }
    }

    /// True while it is on its way.
    pub fn moves(&self) -> bool {
        !self.stands()
    }

    /// It comes to stand as fast as it can.
    pub fn slow_down(&mut self) {
        self.hold(true);
    }

    /// Time passes while the axis stands.
    pub fn stand(&mut self, elapsed: f64) {
        self.elapsed = self.elapsed.max(elapsed);
    }
}

impl<L: Library> Session<L> {
    /// An axis begins to move by hand.
    ///
    /// # Errors
    /// Why it cannot, in words.
    pub fn begin_by_hand(&mut self, axis: usize, how: HandMove) -> Result<(), String> {
        let letter = self.configuration.machine.axes.get(axis).map_or(b'?', |axis| axis.letter);
        let locked = self.switches.machine_lock || (self.switches.z_cancel && letter == CANCELLED_AXIS);
        if locked && matches!(how, HandMove::Home | HandMove::To(_)) {
            return Err(format!("a lock switch holds axis {}", char::from(letter)));
        }
        if self.is_searching() {
            return Err(
                "the program is returning axes to their reference points; let them arrive or press RESET".into()
            );
        }
        self.part_move();
        let locked_at = locked.then_some(*self.machine.position());
        let from = locked_at.map_or(*self.machine.position(), |_| self.counted_position());
        let dog = self.configuration.machine.axes.get(axis).and_then(|axis| axis.reference_return);
        if let (HandMove::Home, Some(_), Some(search)) = (how, dog, self.search(axis, true)) {
            self.forget_rehearsal();
            self.begin_searches(vec![search], false);
            return Ok(());
        }
        let travel = self.configuration.machine.travel();
        let mut to = from;
        to[axis] = match how {
            HandMove::Button { up: true, .. } => from[axis].max(travel.high[axis]) + BEYOND,
            HandMove::Button { .. } => from[axis].min(travel.low[axis]) - BEYOND,
            HandMove::To(mm) => mm,
            HandMove::By(way) => self.in_counts(from[axis] + way),
            HandMove::Home => {
                let axes = &self.configuration.machine.axes;
                axes.get(axis).and_then(|axis| axis.reference_points.first()).copied().unwrap_or(0.0)
            }
        };
        let shape = Shape::Rapid { from, to, kind: RapidKind::Checked };
        let shaped = self.hand_shape(shape);
        let timed = self.motion.time(&shaped);
        let (shape, border) = self.machine.free_part(&timed);
        if let Shape::Rapid { to: end, .. } = shape {
            to = end;
        }
        self.forget_rehearsal();
        let limits = self.configuration.machine.limits();
        let (acceleration, jerk) = (limits.axes[axis].acceleration, limits.jerk(axis));
        let stroke = Stroke::new((to[axis] - from[axis]).abs(), self.hand_speed(axis, how), acceleration, jerk);
        let (searches, of_program) = (Vec::new(), false);
        self.by_hand =
            Some(ByHand { axis, how, from, to, stroke, searches, of_program, elapsed: 0.0, locked_at, border });
        if stroke.has_arrived() {
            self.end_by_hand();
        }
        Ok(())
    }

    /// A place in whole counts, where no program has left the axis between them.
    fn in_counts(&self, mm: f64) -> f64 {
        if self.ended { (mm * 1e6).round() / 1e6 } else { mm }
    }

    /// True while an axis is moved by hand.
    pub fn is_moved_by_hand(&self) -> bool {
        self.by_hand.as_ref().is_some_and(|by_hand| !by_hand.of_program)
    }

    /// What a move by hand is to the machine.
    pub(super) fn hand_shape(&self, shape: Shape) -> Shaped {
        let (interpreter, groups) = (self.interpreter(), &self.interpreter().executing_state().groups);
        let control = interpreter.control();
        // Without such codes an area that the machine's file has is always looked at.
        let stroke_check =
            control.roles.stroke.is_none_or(|group| control.in_force(groups, group) == Some(Meaning::StrokeCheckOn));
        Shaped { shape, place: Place::default(), certain: true, stroke_check, ..Shaped::default() }
    }

    /// mm/s: the rapid rate or the jog speed, as the override switches have it.
    fn hand_speed(&self, axis: usize, how: HandMove) -> f64 {
        let limits = self.configuration.machine.limits().axes[axis];
        match how {
            HandMove::Home | HandMove::Button { rapid: true, .. } => self.motion.overrides().rapid(limits.rapid),
            _ => {
                let jog = self.interpreter().fitting().parameter(self.configuration.control.station.jog_speed);
                (jog / 60.0 * f64::from(self.percents.feed) / 100.0).min(limits.max_feed)
            }
        }
    }

    /// An override switch has been turned.
    pub(super) fn pass_hand_speed(&mut self) {
        if let Some(&ByHand { axis, how, .. }) = self.by_hand.as_ref() {
            let speed = self.hand_speed(axis, how);
            let speeds: Vec<f64> = self.search_speeds();
            if let Some(by_hand) = &mut self.by_hand {
                by_hand.stroke.set_speed(speed);
                by_hand.searches.iter_mut().zip(speeds).for_each(|(search, speed)| search.set_speed(speed));
            }
        }
    }

    /// The speed of each search, as the override switches have it, mm/s.
    fn search_speeds(&self) -> Vec<f64> {
        let searches = self.by_hand.iter().flat_map(|by_hand| &by_hand.searches);
        let limits = self.configuration.machine.limits();
        let speed = |search: &Search| match search.dog() {
            Some(dog) => self.search_speed(dog),
            None => self.motion.overrides().rapid(limits.axes[search.axis].rapid),
        };
        searches.map(speed).collect()
    }

    /// The move by hand goes on to its end or the end of the time; false if nothing more comes of it.
    pub(super) fn go_on_by_hand(&mut self) -> bool {
        loop {
            let now = self.time().0;
            let stride = (now + STRIDE_S).min(self.next_trip());
            self.drive_by_hand(self.deadline.map_or(stride, |deadline| deadline.0.min(stride)));
            let Some(by_hand) = &self.by_hand else { return true };
            if by_hand.has_arrived() {
                self.end_by_hand();
                return true;
            }
            let stands = by_hand.stands();
            if self.tripped.is_some() || self.next_trip() <= self.time().0 || !self.has_told_all() {
                return true;
            }
            if self.is_time_up() || stands {
                return false;
            }
        }
    }

    /// Drives the move by hand until then, at most to its end. Setpoints on the way go to the machine, if it takes them,
    /// and overtravel switches are looked at.
    fn drive_by_hand(&mut self, until: f64) {
        let looks = !self.machine.switches().is_empty();
        if self.machine.drives().is_none() && !looks {
            return self.pass_by_hand(until);
        }
        loop {
            let next = self.next_setpoint();
            self.pass_by_hand(next.min(until));
            let Some(by_hand) = self.by_hand.as_ref().filter(|by_hand| !by_hand.has_arrived()) else { return };
            if next > until || by_hand.stands() {
                return;
            }
            let setpoint = by_hand.setpoint();
            self.machine.follow(base::Seconds(next), &setpoint);
            self.look_at_switches();
            if self.tripped.is_some() {
                return;
            }
        }
    }

    /// The move by hand goes on until then; what happens on the lines is told.
    fn pass_by_hand(&mut self, until: f64) {
        let now = self.time().0;
        let Some(by_hand) = &mut self.by_hand else { return };
        // Seldom more than two: the dog is met and left.
        let mut edges: Vec<(f64, usize, bool)> = Vec::new();
        by_hand.advance((until - now).max(0.0), &mut |axis, at, on| edges.push((now + at, axis, on)));
        edges.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (at, axis, on) in edges {
            self.machine.pass_signals(base::Seconds(at), &mut self.events);
            self.tell_dog(axis, on, at);
        }
        let now = self.time();
        self.machine.pass_signals(now, &mut self.events);
    }

    /// The axis comes to stand as fast as it can, and what is left of its move is dropped.
    pub fn stop_by_hand(&mut self) {
        self.hold_by_hand();
        self.end_by_hand();
    }

    /// The axes come to stand as fast as they can.
    pub(super) fn hold_by_hand(&mut self) {
        let Some(by_hand) = &mut self.by_hand else { return };
        by_hand.hold(true);
        while self.by_hand.as_ref().is_some_and(|by_hand| !by_hand.stands()) {
            let now = self.time().0;
            self.pass_by_hand(now + STRIDE_S);
        }
    }

    /// The axis stands: what has been moved is told and counted.
    fn end_by_hand(&mut self) {
        let Some(by_hand) = self.by_hand.take() else { return };
        let (arrived, axis) = (by_hand.has_arrived(), by_hand.axis);
        if by_hand.of_program {
            return self.end_search(&by_hand, arrived);
        }
        let before = self.lock.counted(self.machine.position());
        let mut to = by_hand.course().position;
        to[axis] = self.in_counts(to[axis]);
        if let HandMove::To(mm) = by_hand.how
            && arrived
            && by_hand.border.is_none()
        {
            to[axis] = mm;
        }
        let way = to[axis] - by_hand.from[axis];
        let shaped = self.hand_shape(Shape::Rapid { from: by_hand.from, to, kind: RapidKind::Checked });
        let duration = base::Seconds(by_hand.elapsed);
        let timed = Timed { shaped: &shaped, duration, length: way.abs(), feed: 0.0, pace: motion::Pace::default() };
        if way != 0.0 && by_hand.locked_at.is_none() {
            // The move has been cut to what the machine takes.
            let _ = self.machine.execute(&timed, &mut self.events);
        } else {
            let until = self.machine.time() + duration;
            self.machine.stand_until(until, &mut self.events);
        }
        if matches!(by_hand.how, HandMove::To(_)) || self.approach.is_some() {
            // The program counts the axes to be there already where it is taken up.
            if let (true, Some(refusal)) = (arrived, by_hand.border) {
                self.raise(refusal.alarm);
            }
            return;
        }
        let home = arrived && by_hand.border.is_none() && by_hand.how == HandMove::Home;
        let returned = if home { AxisSet::only(axis) } else { AxisSet::NONE };
        self.lock.settle(returned);
        match (by_hand.locked_at, self.switches.manual_absolute) {
            (None, false) if !home => self.lock.moved_uncounted(axis, way),
            (Some(_), true) => self.lock.counted_unmoved(axis, way),
            _ => {}
        }
        let counted = self.counted_position();
        let counts = std::array::from_fn(|axis| counted[axis] - before[axis]);
        self.count_by_hand(&counted, &counts, returned);
        if let (true, Some(refusal)) = (arrived, by_hand.border) {
            self.raise(refusal.alarm);
        }
    }

    /// The control counts that axes have been moved by hand: by so much, to there.
    fn count_by_hand(&mut self, counted: &Point, counts: &Point, returned: AxisSet) {
        if self.switches.display_lock {
            self.keep_from_displays(counts);
        }
        if self.ended {
            self.motion.upstream.stand_at(counted);
            return self.interpreter_mut().moved_by_hand(counted, returned);
        }
        // In the middle of a program it goes on from there.
        let to_the_end = self.interpreter().fitting().policies.intervention == Intervention::ToTheEnd;
        for axis in (0..AXES).filter(|&axis| counts[axis] != 0.0) {
            self.motion.upstream.displace(axis, counts[axis], self.pulled, to_the_end);
        }
    }

    /// The program has ended: where axes still stand beside its places, the next one begins.
    pub(super) fn settle_displacement(&mut self) {
        if self.motion.upstream.is_displaced() {
            let counted = self.counted_position();
            self.motion.upstream.stand_at(&counted);
            self.interpreter_mut().moved_by_hand(&counted, AxisSet::NONE);
        }
    }

    /// The axes that G28 has sent to their reference points stand: there, or where they were broken off.
    fn end_search(&mut self, by_hand: &ByHand, arrived: bool) {
        if arrived {
            self.searched = Some(base::Seconds(by_hand.elapsed));
            self.perform_shape();
            self.searched = None;
            return;
        }
        let to = by_hand.setpoint().position;
        let shape = Shape::Rapid { from: by_hand.from, to, kind: RapidKind::Checked };
        let shaped = Shaped { shape, ..*self.motion.upstream.current() };
        let timed = Timed { shaped: &shaped, duration: base::Seconds(by_hand.elapsed), ..self.motion.time(&shaped) };
        // What could not be made as a whole was refused before it began.
        let _ = self.machine.execute(&timed, &mut self.events);
        self.come_to_stand();
    }
}
