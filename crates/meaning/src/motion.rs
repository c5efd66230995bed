//! Positioning, lines and arcs: from the words of a block to one move in machine coordinates.

use base::{AXES, Alarm, AxisSet, Condition, Point};
use dialect::{ArcWithoutCentre, LengthWithoutZ, Meaning, PositionOffsetArcRadius, PositionOffsetLetter};

use crate::arc::{ArcWords, solve};
use crate::block::Reading;
use crate::command::Body;
use crate::coordinate::LENGTH_AXIS;
use crate::operation::{Feed, Plane, RapidKind, Side};
use crate::position_offset::PositionOffset;

impl Reading<'_> {
    /// The block's movement under the motion code in force.
    pub fn motion(&mut self, motion: Meaning) -> Result<(), Alarm> {
        if self.control().tool_tip.is_some() && matches!(motion, Meaning::Rapid | Meaning::Linear) {
            match self.setting.tip().copied() {
                Some(tip) => return self.tip_motion(tip, motion),
                None => self.refuse_vector()?,
            }
        }
        match motion {
            Meaning::ArcClockwise | Meaning::ArcCounterClockwise => self.arc(motion == Meaning::ArcClockwise),
            _ => {
                let mut to = [0.0; AXES];
                let moved = self.targets(&mut to)?;
                if moved.is_empty() {
                    return Ok(());
                }
                self.now_known = self.now_known.or(moved);
                match motion {
                    Meaning::Linear => {
                        let feed = self.feed_to(&to)?;
                        self.command.cut_to(&to, feed);
                    }
                    Meaning::Thread => {
                        // Neither override nor feed hold may part the tool from the thread.
                        let feed = Feed { tapping: true, ..self.feed_to(&to)? };
                        self.command.body = Body::Line { to, feed };
                    }
                    Meaning::OneSidedPositioning => {
                        self.refuse_in_compensation()?;
                        self.one_sided(to, moved);
                    }
                    _ => self.command.body = Body::Rapid { to, kind: self.rapid_kind },
                }
                self.next.machine = to;
                Ok(())
            }
        }
    }

    /// G60: every moving axis first goes to its approach point, stops, then arrives from one side.
    fn one_sided(&mut self, to: Point, moved: AxisSet) {
        let mut via = to;
        for axis in moved.iter() {
            if to[axis] != self.next.machine[axis] {
                via[axis] -= self.setting.facts.axes.get(axis).map_or(0.0, |facts| facts.approach);
            }
        }
        self.command.body = Body::Via { via, to, stops: false };
        self.rapid_kind = RapidKind::Checked;
    }

    /// G53: one block in machine coordinates, offsets suspended; in incremental mode its words are without effect.
    pub fn machine_coordinates(&mut self) -> Result<(), Alarm> {
        let axes = self.axes_named();
        if !self.absolute || axes.is_empty() {
            return Ok(());
        }
        self.leave_offset(axes)?;
        let mut to = self.next.machine;
        for axis in axes.iter() {
            to[axis] = self.axis_word(axis)?.0;
            self.length_axis_placed(axis);
            self.next.displacement[axis] = 0.0;
            self.next.transform.close_gap(axis);
        }
        let roles = self.setting.control.roles;
        self.command.body = match self.setting.control.in_force(&self.next.groups, roles.motion) {
            Some(Meaning::Linear) => Body::Line { to, feed: self.feed_to(&to)? },
            _ => Body::Rapid { to, kind: RapidKind::Checked },
        };
        self.now_known = self.now_known.or(axes);
        self.next.machine = to;
        Ok(())
    }

    /// The offset of G45 to G48, from D (or H, by policy).
    pub fn read_position_offset(&mut self, code: Meaning) -> Result<(), Alarm> {
        let Some(factor) = code.position_offset() else { return Ok(()) };
        let roles = self.setting.control.roles;
        if self.setting.control.in_force(&self.next.groups, roles.cycle).is_some_and(Meaning::is_cycle) {
            return Err(self.one_shot_alarm(Condition::PositionOffsetInCycle));
        }
        if self.command.side != Side::Off {
            return Err(self.one_shot_alarm(Condition::PositionOffsetInCompensation));
        }
        let by_h = self.setting.fitting.policies.position_offset_letter == PositionOffsetLetter::DOrH
            && !self.words.has(b'D')
            && self.words.has(b'H');
        let (letter, value) = if by_h {
            (b'H', self.offset(self.setting.memory.length(self.next.h)))
        } else {
            (b'D', self.offset(self.setting.memory.radius(self.next.d)))
        };
        let Some(offset) = value else {
            return Err(self.words.alarm(Condition::OffsetNumber, letter));
        };
        self.position_offset = Some(PositionOffset { factor, offset });
        Ok(())
    }

    /// The plane in force.
    pub fn plane(&self) -> Plane {
        match self.setting.control.in_force(&self.next.groups, self.setting.control.roles.plane) {
            Some(Meaning::PlaneZx) => Plane::Zx,
            Some(Meaning::PlaneYz) => Plane::Yz,
            _ => Plane::Xy,
        }
    }

    fn arc(&mut self, clockwise: bool) -> Result<(), Alarm> {
        let plane = self.plane();
        let letters = plane.centre_letters();
        let has_center = self.words.has(letters[0]) || self.words.has(letters[1]);
        let has_radius = self.words.has(b'R');
        if !has_center && !has_radius && self.axes_named().is_empty() && !self.words.has(b'H') {
            return Ok(());
        }
        let axes = plane.letters().map(|letter| self.arc_axis(letter));
        // An offset that waits for its axis disturbs no arc beside it.
        let takes_up = self.setting.fitting.policies.length_without_z == LengthWithoutZ::AtOnce
            || axes.contains(&self.setting.length_axis);
        if self.length_change != 0.0 && takes_up && (has_center || has_radius || !self.axes_named().is_empty()) {
            return Err(self.words.alarm(Condition::LengthOffsetWithArc, b'H'));
        }
        let [Some(u), Some(v)] = axes else { return Err(self.motion_alarm(Condition::AddressUnavailable)) };
        let (from_program, stretched) = match self.next.transform.stretches([u, v]) {
            true => (self.last_programmed(), has_center && !has_radius),
            false => (self.next.machine, false),
        };
        let mut to = [0.0; AXES];
        let moved = self.targets(&mut to)?;
        let units = self.units;
        let control = self.control();
        let transform = self.next.transform;
        let clockwise = clockwise != transform.turns_over([u, v]);
        let radius = self.words.length(control, b'R', units)?.map(|radius| transform.size([u, v], radius));
        let straight = self.setting.fitting.policies.arc_without_centre == ArcWithoutCentre::StraightLine;
        if !has_center && radius.is_none() && straight {
            self.command.body = Body::Line { to, feed: self.feed()? };
            self.now_known = self.now_known.or(moved);
            self.next.machine = to;
            return Ok(());
        }
        if radius.is_some()
            && self.position_offset.is_some()
            && self.setting.fitting.policies.position_offset_arc_radius == PositionOffsetArcRadius::Refuse
        {
            return Err(self.words.alarm(Condition::PositionOffsetArcRadius, b'R'));
        }
        self.check_helix(moved, u, v)?;
        let from = self.next.machine;
        let tolerances = control.tolerances;
        let words = ArcWords {
            start: [from[u], from[v]],
            end: [to[u], to[v]],
            center: if has_center { Some(self.centre_words(letters, [u, v])?) } else { None },
            radius,
            clockwise,
            radius_tolerance: self.setting.fitting.parameter(tolerances.arc_radius) * 1e6,
            end_limit: self.setting.fitting.parameter(tolerances.arc_end) * 1e6,
        };
        // Of unequal factors the programmed arc must be one; the one that is cut is closed by a straight piece.
        let words = if stretched { self.check_unscaled(words, plane, [u, v], &from_program, &to)? } else { words };
        let solved = solve(words)
            .map_err(|(condition, values)| self.arc_alarm(condition, plane, [u, v], has_radius).with(values));
        let Some(solved) = solved? else { return Ok(()) };
        let feed = self.feed()?;
        self.command.body = Body::Arc {
            to,
            center: solved.center,
            axes: [u as u8, v as u8],
            plane,
            clockwise,
            full_circle: solved.full_circle,
            foot: if stretched { foot(&words, solved.center) } else { None },
            feed,
        };
        self.now_known = self.now_known.or(moved);
        self.next.machine = to;
        Ok(())
    }

    /// The alarm for an arc that cannot be, at the word that says so.
    fn arc_alarm(&self, condition: Condition, plane: Plane, ends: [usize; 2], by_radius: bool) -> Alarm {
        let first_of = |[one, other]: [u8; 2]| if self.words.has(one) { one } else { other };
        match condition {
            Condition::ArcWithoutCentre => self.motion_alarm(condition),
            Condition::ArcEndOff => {
                let letters = ends.map(|axis| self.setting.facts.axes.get(axis).map_or(b'X', |facts| facts.letter));
                self.words.alarm(condition, first_of(letters))
            }
            _ if by_radius => self.words.alarm(condition, b'R'),
            _ => self.words.alarm(condition, first_of(plane.centre_letters())),
        }
    }

    /// The axis of one of the plane's letters: the linear fourth axis along it (U, V, W along X, Y, Z) takes its place
    /// where it stands in the block alone.
    fn arc_axis(&self, letter: u8) -> Option<usize> {
        let facts = &self.setting.facts;
        let along = facts.axis(letter - (b'X' - b'U'));
        let is_linear = |axis: &usize| facts.axes.get(*axis).is_some_and(|facts| !facts.rotary);
        let alone = self.words.has(letter - (b'X' - b'U')) && !self.words.has(letter);
        along.filter(is_linear).filter(|_| alone).or_else(|| facts.axis(letter))
    }

    /// Another axis beside the plane's two makes a helix, which is an option.
    fn check_helix(&self, moved: AxisSet, u: usize, v: usize) -> Result<(), Alarm> {
        let others = moved.without(AxisSet::only(u)).without(AxisSet::only(v));
        match others.iter().next() {
            Some(axis) if !self.setting.fitting.options.helical => {
                let letter = self.setting.facts.axes.get(axis).map_or(0, |facts| facts.letter);
                Err(self.words.alarm(Condition::HelixNotFitted, letter))
            }
            _ => Ok(()),
        }
    }

    /// The centre words in counts, each lengthened by G45 to G48 as the axis of its name would be.
    fn centre_words(&self, letters: [u8; 2], axes: [usize; 2]) -> Result<[f64; 2], Alarm> {
        let transform = self.next.transform;
        let mut center = transform.vector(axes, self.centre_written(letters)?);
        let Some(offset) = self.position_offset else { return Ok(center) };
        for (place, letter) in letters.into_iter().enumerate() {
            if let Some(number) = self.words.number(letter)? {
                center[place] += offset.change(center[place], number.negative != transform.negates(axes[place]));
            }
        }
        Ok(center)
    }

    /// The centre words as written, counts; a missing one is zero.
    fn centre_written(&self, letters: [u8; 2]) -> Result<[f64; 2], Alarm> {
        let word = |letter| Ok(self.words.length(self.control(), letter, self.units)?.unwrap_or(0.0));
        Ok([word(letters[0])?, word(letters[1])?])
    }

    /// Holds the arc as it is written against the limit for its end; as it is scaled, its end may lie where it likes.
    #[cold]
    fn check_unscaled(
        &self,
        words: ArcWords,
        plane: Plane,
        axes: [usize; 2],
        from: &Point,
        to: &Point,
    ) -> Result<ArcWords, Alarm> {
        let to = self.setting.programmed(self.next, to);
        let [start, end] = [from, &to].map(|point| axes.map(|axis| point[axis]));
        let center = Some(self.centre_written(plane.centre_letters())?);
        match solve(ArcWords { start, end, center, ..words }) {
            Ok(_) => Ok(ArcWords { end_limit: 0.0, ..words }),
            Err((condition, values)) => Err(self.arc_alarm(condition, plane, axes, false).with(values)),
        }
    }

    /// The distances of positioning from one side, where the motion code in force asks for them; none along the axis of
    /// the spindle.
    pub fn cycle_approach(&self) -> Point {
        let mut approach = [0.0; AXES];
        let motion = self.setting.control.in_force(&self.next.groups, self.setting.control.roles.motion);
        if motion == Some(Meaning::OneSidedPositioning) {
            for (axis, facts) in self.setting.facts.axes.iter().enumerate().take(AXES) {
                if facts.letter != LENGTH_AXIS {
                    approach[axis] = facts.approach;
                }
            }
        }
        approach
    }
}

/// Where an arc ends whose end lies off its circle, on the way from there to its centre; `None` if it does not.
fn foot(words: &ArcWords, center: [f64; 2]) -> Option<[f64; 2]> {
    let way = |to: [f64; 2]| [to[0] - center[0], to[1] - center[1]];
    let (start, end) = (way(words.start), way(words.end));
    let (radius, reach) = (libm::hypot(start[0], start[1]), libm::hypot(end[0], end[1]));
    let off = (radius - reach).abs() >= 1.0 && reach > 0.0;
    off.then(|| [center[0] + end[0] * radius / reach, center[1] + end[1] * radius / reach])
}
