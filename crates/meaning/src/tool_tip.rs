//! Programming of the tool's tip: X, Y, Z of a straight movement are the tip, B C, A C or I J K the tool's direction.
//!
//! The words are read as they are for a tool that stands upright; what the machine's axes must do for it follows from its
//! kinematics. A cut is divided so finely that the tip stays on its straight way; a rapid leads to its end only. Whatever
//! is no straight movement wants the tool upright, where nothing differs from plain axes.

use base::{AXES, Alarm, AxisSet, Condition, Point};
use dialect::{Meaning, TipSingularity};

use crate::block::Reading;
use crate::command::{Body, TipMove};
use crate::kinematics::Kinematics;
use crate::operation::Feed;
use crate::setting::Setting;
use crate::state::State;
use crate::unknown::letter_bit;

/// Counts in a mm or a degree.
const COUNTS: f64 = 1e6;
/// The most parts of a cut.
const MOST_PARTS: f64 = 1e6;
/// The letters of a vector.
const VECTOR: [u8; 3] = [b'I', b'J', b'K'];
/// The letters of the two tilting axes: about X, about Y.
const TILTS: [u8; 2] = [b'A', b'B'];
const TURN: u8 = b'C';

/// A point in mm and degrees.
fn mm(counts: &Point) -> Point {
    counts.map(|value| value / COUNTS)
}

fn counts(point: &Point) -> Point {
    point.map(|value| value * COUNTS)
}

impl Setting {
    /// How the tip follows from the axes, while X, Y and Z are the tip.
    pub fn tip(&self) -> Option<&Kinematics> {
        if self.fitting.options.tool_tip { self.facts.kinematics.as_ref() } else { None }
    }

    /// The place at which the axes would stand for the same tip if nothing were turned.
    pub fn upright(&self, state: &State, machine: &Point) -> Point {
        match self.tip() {
            Some(tip) if !tip.is_upright(&mm(machine)) => {
                counts(&tip.upright(&mm(machine), (state.length - state.length_due) / COUNTS))
            }
            _ => *machine,
        }
    }
}

impl Reading<'_> {
    /// Refuses a vector beside a straight movement where X, Y and Z are the places of the axes.
    pub fn refuse_vector(&self) -> Result<(), Alarm> {
        match VECTOR.into_iter().find(|&letter| self.words.has(letter)) {
            Some(letter) => Err(self.words.alarm(Condition::DirectionWithoutOption, letter)),
            None => Ok(()),
        }
    }

    /// Refuses what wants the tool upright while it is tilted.
    #[inline]
    pub fn check_tip(&self) -> Result<(), Alarm> {
        self.setting.tip().map_or(Ok(()), |tip| self.refuse_tilted(tip))
    }

    #[cold]
    fn refuse_tilted(&self, tip: &Kinematics) -> Result<(), Alarm> {
        let roles = self.control().roles;
        let in_force = |group| self.control().in_force(&self.next.groups, group);
        let straight = matches!(in_force(roles.motion), Some(Meaning::Rapid | Meaning::Linear))
            && !in_force(roles.cycle).is_some_and(Meaning::is_cycle);
        let tilts = self.words.has_any(letter_bit(TILTS[0]) | letter_bit(TILTS[1]) | letter_bit(TURN));
        if tip.is_upright(&mm(&self.next.machine)) {
            let stays = straight || !tilts || self.one_shot.is_some_and(|(code, _)| code != Meaning::ExactStop);
            return if stays { Ok(()) } else { Err(self.tilted_alarm(tip)) };
        }
        let transforms = self.groups_written & self.setting.transform_groups & !(1 << roles.plane) != 0;
        let free = match self.one_shot.map(|(code, _)| code) {
            None | Some(Meaning::ExactStop) => !transforms && (straight || self.axes_named().is_empty()),
            Some(code) => matches!(
                code,
                Meaning::Dwell
                    | Meaning::WriteData
                    | Meaning::ReferenceReturn
                    | Meaning::OtherReferenceReturn
                    | Meaning::MachineCoordinates
                    | Meaning::LocalCoordinates
            ),
        };
        if free { Ok(()) } else { Err(self.tilted_alarm(tip)) }
    }

    fn tilted_alarm(&self, tip: &Kinematics) -> Alarm {
        let tilt = self.next.machine[usize::from(tip.tilt)] / COUNTS;
        let alarm = match self.one_shot {
            Some(_) => self.one_shot_alarm(Condition::ToolTilted),
            None => self.motion_alarm(Condition::ToolTilted),
        };
        alarm.with([tilt, 0.0, 0.0])
    }

    /// A straight movement of the tip.
    #[cold]
    pub fn tip_motion(&mut self, tip: Kinematics, motion: Meaning) -> Result<(), Alarm> {
        let from = self.next.machine;
        let lengths_before = (self.before.length - self.before.length_due) / COUNTS;
        let upright_from = tip.upright(&mm(&from), lengths_before);
        let direction = self.direction(&tip)?;
        // The other words are read as for a tool that stands upright.
        self.next.machine = counts(&upright_from);
        self.not_axes = letter_bit(TILTS[0]) | letter_bit(TILTS[1]) | letter_bit(TURN);
        let mut to = [0.0; AXES];
        let mut moved = self.targets(&mut to)?;
        self.not_axes = 0;
        if let Some(angles) = direction {
            for (axis, angle) in [tip.tilt, tip.turn].map(usize::from).into_iter().zip(angles) {
                to[axis] = angle;
                moved.add(axis);
            }
        }
        self.next.machine = from;
        if moved.is_empty() {
            return Ok(());
        }
        let upright_to = mm(&to);
        let stays_upright = tip.is_upright(&upright_from) && tip.is_upright(&upright_to);
        if !stays_upright && !self.next.transform.is_plain() {
            return Err(self.tilted_alarm(&tip));
        }
        let lengths = [lengths_before, (self.next.length - self.next.length_due) / COUNTS];
        let machine = match tip.is_upright(&upright_to) {
            true => to,
            false => counts(&tip.placed(&upright_to, lengths[1])),
        };
        let moved = tip.linear.iter().fold(moved, |set, &axis| set.or(AxisSet::only(usize::from(axis))));
        self.now_known = self.now_known.or(moved);
        self.command.body = match motion {
            Meaning::Linear => {
                let way = way(&upright_from, &upright_to, self.setting.facts.axes.len());
                let feed = self.feed_to(&machine)?;
                let tolerance = self.setting.fitting.parameter_if_any(self.control().tool_tip).max(1e-4);
                let parts = (tip.bend(&upright_from, &upright_to, lengths) / tolerance).sqrt().ceil();
                match parts.clamp(1.0, MOST_PARTS) as u32 {
                    1 => Body::Line { to: machine, feed: Feed { way_mm: way, ..feed } },
                    parts => {
                        self.refuse_in_compensation()?;
                        let feed = Feed { way_mm: way / f64::from(parts), ..feed };
                        Body::Tip(TipMove { kinematics: tip, upright: to, machine, lengths, parts, feed })
                    }
                }
            }
            _ => Body::Rapid { to: machine, kind: self.rapid_kind },
        };
        self.next.machine = machine;
        Ok(())
    }

    /// The angles of the tilting and the turning axis that the block's direction words ask for, counts of the machine.
    fn direction(&mut self, tip: &Kinematics) -> Result<Option<[f64; 2]>, Alarm> {
        let has = |letter: &u8| self.words.has(*letter);
        let (own, other) = if tip.about_y { (b'B', b'A') } else { (b'A', b'B') };
        let by_angles = [own, other, TURN].into_iter().find(|letter| has(letter));
        let vector = VECTOR.into_iter().find(|letter| has(letter));
        match (by_angles, vector) {
            (None, None) => return Ok(None),
            (Some(_), Some(letter)) => return Err(self.words.alarm(Condition::DirectionTwice, letter)),
            (None, Some(_)) => return self.by_vector(tip).map(Some),
            (Some(_), None) if self.words.has(own) && self.words.has(other) => {
                return Err(self.words.alarm(Condition::DirectionTwice, other));
            }
            (Some(_), None) => {}
        }
        let now = [tip.tilt, tip.turn].map(|axis| self.next.machine[usize::from(axis)]);
        // Told by the other pair of letters, C counts from elsewhere.
        let (letter, shift) = match self.words.has(other) {
            true => (other, tip.other_turn() * COUNTS),
            false => (own, 0.0),
        };
        let mut angles = now;
        for (place, (letter, axis, shift)) in [(letter, tip.tilt, 0.0), (TURN, tip.turn, shift)].into_iter().enumerate()
        {
            if let Some(angle) = self.words.angle(self.control(), letter)? {
                let zero = self.zero(usize::from(axis));
                angles[place] = if self.absolute { angle - shift + zero } else { now[place] + angle };
            }
        }
        Ok(Some(angles))
    }

    /// The angles of the block's vector.
    fn by_vector(&self, tip: &Kinematics) -> Result<[f64; 2], Alarm> {
        let least = self.control().increments[0] as f64 / COUNTS;
        let mut vector = [0.0; 3];
        for (part, letter) in vector.iter_mut().zip(VECTOR) {
            if let Some(number) = self.words.number(letter)? {
                let is_counted = !self.words.pointed(number).point;
                *part = number.to_f64() * if is_counted { least } else { 1.0 };
            }
        }
        let first = VECTOR.into_iter().find(|&letter| self.words.has(letter)).unwrap_or(b'I');
        if vector == [0.0; 3] {
            return Err(self.words.alarm(Condition::DirectionZero, first));
        }
        let axes = [tip.tilt, tip.turn].map(usize::from);
        let zeros = axes.map(|axis| self.zero(axis));
        let near = [0, 1].map(|place| (self.next.machine[axes[place]] - zeros[place]) / COUNTS);
        let (tilt, turn) = tip.towards(vector, near);
        let turn = match turn {
            Some(turn) => turn * COUNTS + zeros[1],
            None if self.setting.fitting.policies.tip_singularity == TipSingularity::Refuse => {
                return Err(self.words.alarm(Condition::DirectionUndecided, first).on_axis(axes[1]));
            }
            None => self.next.machine[axes[1]],
        };
        Ok([tilt * COUNTS + zeros[0], turn])
    }
}

/// The way of the tip and of the axes that turn, degrees as mm: what F counts along.
fn way(from: &Point, to: &Point, axes: usize) -> f64 {
    (0..axes.min(AXES)).map(|axis| (to[axis] - from[axis]) * (to[axis] - from[axis])).sum::<f64>().sqrt()
}
