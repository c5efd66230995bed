//! What tool radius compensation is told of a block: how the tool runs beside the path, and the block's own way in the
//! plane, in counts, so that directions are exact however far from zero the way lies.

use base::{AXES, Alarm};
use dialect::{CornerMode, Meaning};

use crate::block::Reading;
use crate::command::{Body, Command};
use crate::operation::{Plane, Side};
use crate::state::Corner;

/// How the tool runs beside the path.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Offset {
    /// The tool's radius, mm: positive left of the path, negative right of it.
    pub radius: f64,
    /// The plane in force.
    pub plane: Plane,
    /// Its two axes in their order.
    pub axes: [u8; 2],
    /// Outside corners are gone round on an arc.
    pub round_corners: bool,
}

/// A way in the plane, counts of machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Element {
    /// From here.
    pub from: [f64; 2],
    /// To there.
    pub to: [f64; 2],
    /// How it turns, if it is an arc.
    pub turn: Option<Turn>,
}

/// How an arc turns.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Turn {
    /// About this point, counts.
    pub center: [f64; 2],
    /// Clockwise, seen from the + end of the third axis.
    pub clockwise: bool,
    /// All the way round to where it began.
    pub full_circle: bool,
}

impl Command {
    /// How the tool runs beside the path of this block, while it does.
    #[inline]
    pub fn offset(&self) -> Option<Offset> {
        self.offset
    }

    /// True if the block goes to places of its own on these axes, whatever the tool's offset was.
    #[inline]
    pub fn drops_offset(&self, plane: [u8; 2]) -> bool {
        plane.iter().any(|&axis| self.drops_on(axis))
    }

    /// True if it goes to a place of its own on this axis.
    #[inline]
    pub fn drops_on(&self, axis: u8) -> bool {
        self.drops.has(usize::from(axis))
    }

    /// Writes the way of the block in a plane to `way`; false if it has none. `part` 1 is the straight piece behind an
    /// arc that has one.
    pub fn element(&self, plane: [u8; 2], part: u8, way: &mut Element) -> bool {
        let at = |point: &base::Point| plane.map(|axis| point[usize::from(axis) % AXES]);
        way.from = at(&self.from);
        way.turn = None;
        match (&self.body, part) {
            (Body::Rapid { to, .. } | Body::Line { to, .. } | Body::Checked { to, .. }, 0) => way.to = at(to),
            (Body::Arc { to, center, clockwise, full_circle, foot, .. }, 0) => {
                way.to = foot.unwrap_or(at(to));
                way.turn = Some(Turn { center: *center, clockwise: *clockwise, full_circle: *full_circle });
            }
            (Body::Arc { to, foot: Some(foot), .. }, 1) => (way.from, way.to) = (*foot, at(to)),
            _ => return false,
        }
        way.turn.is_some() || way.from != way.to
    }

    /// Into how many parts the way of the block falls.
    #[inline]
    pub fn parts(&self) -> u8 {
        if matches!(self.body, Body::Arc { foot: Some(_), .. }) { 2 } else { 1 }
    }
}

impl Reading<'_> {
    /// Refuses to change the plane under compensation.
    pub fn check_plane(&self) -> Result<(), Alarm> {
        if self.command.side == Side::Off || self.before.d == 0 {
            return Ok(());
        }
        let roles = self.control().roles;
        let was_on = self
            .control()
            .in_force(&self.before.groups, roles.compensation)
            .is_some_and(|code| code != Meaning::CompensationOff);
        if was_on && self.before.groups.0[roles.plane] != self.next.groups.0[roles.plane] {
            return Err(self.group_alarm(base::Condition::PlaneInCompensation, Some(roles.plane)));
        }
        Ok(())
    }

    /// Notes how the tool runs beside the path. A mirror image exchanges left and right.
    pub fn take_offset(&mut self) {
        if self.command.side == Side::Off {
            return;
        }
        let written = self.groups_written & (1 << self.control().roles.compensation) != 0;
        if written || self.words.has(b'D') {
            self.next.radius = self.offset(self.setting.memory.radius(self.next.d)).unwrap_or(0.0);
        }
        let plane = self.plane();
        let axes = plane.letters().map(|letter| self.setting.facts.axis(letter));
        let [Some(u), Some(v)] = axes else { return };
        if !self.next.transform.is_plain() && self.next.transform.turns_over([u, v]) {
            self.command.side = if self.command.side == Side::Left { Side::Right } else { Side::Left };
        }
        if self.next.d == 0 {
            return;
        }
        let radius = self.next.radius / 1e6;
        let round_corners = match self.next.corner {
            Corner::NotProgrammed => self.setting.fitting.policies.corner_mode == CornerMode::Arc,
            corner => corner == Corner::Arc,
        };
        self.command.offset = Some(Offset {
            radius: if self.command.side == Side::Left { radius } else { -radius },
            plane,
            axes: [u as u8, v as u8],
            round_corners,
        });
    }

    /// Refuses a move that goes a way of its own under compensation: nothing is known of a path beside it.
    pub fn refuse_in_compensation(&self) -> Result<(), Alarm> {
        if self.command.side == Side::Off || self.next.d == 0 {
            return Ok(());
        }
        Err(self.motion_alarm(base::Condition::WayInCompensation))
    }

    /// Refuses a code that goes to places of the machine, on a control that does so under compensation; elsewhere the
    /// tool's offset is left out on these axes.
    pub fn leave_offset(&mut self, axes: base::AxisSet) -> Result<(), Alarm> {
        if self.command.side != Side::Off && self.control().functions.compensation.refuses_machine_places {
            return Err(self.one_shot_alarm(base::Condition::MachinePlaceInCompensation));
        }
        self.command.drops = axes;
        Ok(())
    }
}
