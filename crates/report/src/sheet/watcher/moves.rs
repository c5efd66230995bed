//! What the moves of a run tell: what they rely on, how low they lead, what they cut.

use base::{AXES, Point};
use dialect::Meaning;
use meaning::{LENGTH_AXIS, State};

use super::super::tool::{Lowest, Operation, Range};
use super::super::{Spot, WorkSystem};
use super::{Now, Watcher};

impl Watcher {
    /// A move: what it relies on, and how low it leads.
    pub(super) fn moved(&mut self, from: &Point, to: &Point) {
        let Some(now) = &self.now else { return };
        let control = self.configuration.control.clone();
        let roles = control.roles;
        let groups = now.state.groups;
        let system = groups.0[roles.work];
        let to_reference = matches!(
            now.one_shot,
            Some(Meaning::ReferenceReturn | Meaning::OtherReferenceReturn | Meaning::MachineCoordinates)
        );
        let absolute = control.in_force(&groups, roles.distance) != Some(Meaning::Incremental);
        if absolute && !to_reference && self.systems.insert(system) {
            let system = self.system(system, &now.spot, &now.state);
            self.sheet.systems.push(system);
        }
        let Some(now) = &self.now else { return };
        let by_system = absolute && control.in_force(&groups, roles.work) == Some(Meaning::WorkSystem);
        if by_system {
            for (axis, facts) in self.configuration.machine.axes.iter().enumerate().take(AXES) {
                if now.words.word(facts.letter).is_some() {
                    self.anchored.add(axis);
                }
            }
        }
        let length = control.in_force(&groups, roles.length).and_then(Meaning::length_offset);
        // An offset counts where it leads the tool along its axis.
        let axis = self.axes().iter().position(|axis| axis.letter == LENGTH_AXIS);
        let along = !to_reference && axis.is_some_and(|axis| from[axis] != to[axis]);
        let h = length.filter(|factor| *factor != 0.0 && along).map(|_| now.state.h).filter(|&h| h > 0);
        let side = matches!(
            control.in_force(&groups, roles.compensation),
            Some(Meaning::CompensationLeft | Meaning::CompensationRight)
        );
        let circle = [Meaning::CircleCutClockwise, Meaning::CircleCutCounterClockwise];
        let by_d = side || now.one_shot.is_some_and(|code| code.position_offset().is_some() || circle.contains(&code));
        let d = by_d.then_some(now.state.d).filter(|&d| d > 0);
        let lowest = self.lowest(now, from, to, system);
        for tool in self.floor.tools() {
            tool.h.extend(h);
            tool.d.extend(d);
            if let Some(lowest) = &lowest
                && tool.lowest.as_ref().is_none_or(|known| lowest.tip < known.tip)
            {
                tool.lowest = Some(lowest.clone());
            }
        }
    }

    fn lowest(&self, now: &Now, from: &Point, to: &Point, system: u8) -> Option<Lowest> {
        let axis = self.axes().iter().position(|axis| axis.letter == LENGTH_AXIS)?;
        if from[axis] == to[axis] && now.state.length != 0.0 {
            return None;
        }
        let (machine, length) = (to[axis], now.state.length / 1e6);
        Some(Lowest {
            machine,
            tip: machine - length,
            program: machine - now.zero[axis],
            system: self.control().g_name(system),
            spot: now.spot.clone(),
        })
    }

    fn system(&self, row: u8, spot: &Spot, state: &State) -> WorkSystem {
        let control = self.control();
        let code = control.g_codes.get(usize::from(row)).filter(|code| code.meaning == Meaning::WorkSystem);
        let memory = &self.configuration.memory.work;
        let origin = match code.and_then(|code| memory.get(usize::from(code.number.saturating_sub(1)))) {
            Some(origin) => *origin,
            None => state.base_origin,
        };
        let axes = self.axes().iter().enumerate().take(AXES);
        WorkSystem {
            name: control.g_name(row),
            origin: axes.map(|(index, axis)| (char::from(axis.letter), origin[index] / 1e6)).collect(),
            first: spot.clone(),
            base: code.is_none(),
        }
    }

    /// A cut: how far, how fast, in which piece of work.
    pub(super) fn cut(&mut self, feed: f64, seconds: f64, length: f64, extent: [&Point; 2], to: &Point) {
        self.sheet.times.cutting += seconds;
        let Some(now) = &mut self.now else { return };
        let fresh = std::mem::take(&mut now.fresh);
        let control = &self.configuration.control;
        let system = control.g_name(now.state.groups.0[control.roles.work]);
        let axes = &self.configuration.machine.axes;
        let program = |axis: usize, at: f64| at - now.zero[axis];
        let depth_axis = axes.iter().position(|axis| axis.letter == LENGTH_AXIS);
        let depth = depth_axis.map(|axis| program(axis, extent[0][axis].min(extent[1][axis])));
        let row = now.cycle.and_then(|row| control.g_codes.get(usize::from(row)));
        let (code, text) = match row {
            Some(row) => {
                let text = row.text.split([':', ';', '.']).next().unwrap_or_default();
                (format!("G{:02}", row.code), text.to_owned())
            }
            None => (String::new(), "lines and arcs".to_owned()),
        };
        // Holes of one cycle to one depth are one piece of work.
        let bottom = row.and(now.state.cycle.bottom);
        let place = [to[0], to[1]];
        for tool in self.floor.tools() {
            tool.cutting += seconds;
            if now.state.spindle > 0 {
                Range::take(&mut tool.speeds, f64::from(now.state.spindle));
            }
            Range::take(&mut tool.feeds, feed);
            for (index, axis) in axes.iter().enumerate().take(AXES) {
                let ends = [program(index, extent[0][index]), program(index, extent[1][index])];
                tool.reach(&system, char::from(axis.letter), ends[0].min(ends[1]), ends[0].max(ends[1]));
            }
            let same = |operation: &&mut Operation| operation.code == code && operation.bottom == bottom;
            if tool.operations.last_mut().filter(same).is_none() {
                tool.operations.push(Operation {
                    code: code.clone(),
                    text: text.clone(),
                    holes: 0,
                    length: 0.0,
                    depth: None,
                    bottom,
                    first: now.spot.clone(),
                    last_hole: None,
                });
            }
            if let Some(operation) = tool.operations.last_mut() {
                operation.length += length;
                operation.depth = match (operation.depth, depth) {
                    (Some(a), Some(b)) => Some(a.min(b)),
                    (known, now) => known.or(now),
                };
                if row.is_some() && (fresh || operation.last_hole != Some(place)) {
                    operation.holes += 1;
                    operation.last_hole = Some(place);
                }
            }
        }
    }
}
