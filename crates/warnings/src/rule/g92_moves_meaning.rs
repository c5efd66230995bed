//! `g92-moves-meaning`: G92, and what the program relies on with it.
//!
//! What: G92 gives the place where the axes stand new coordinates. Two shades: it stands where a work system is in
//! force, or it stands at a place that only the operator decided.
//! Why: in a work system it selects another one here (or shifts all of them, by make and setting), and the words after
//! it mean other places. At a start position that nothing fixes, every coordinate rests on where the axes were jogged:
//! the second piece, or a restart, is cut elsewhere.
//! Do: use G54 to G59, or go to a known place first (G28, G53) so that G92 says the same every time.
//!
//! Silent for the start position where every axis that G92 names has been brought to a reference point, to machine
//! coordinates, to a place of a work system or by a skip signal to the work before. Said once a program for the start position.

use base::AxisSet;
use dialect::{G92System, Meaning};

use crate::finding::{At, Finding, Found};
use crate::look::{Look, places};
use crate::rules::Rule;

/// Which axes stand where the program has put them.
#[derive(Default)]
pub(crate) struct G92MovesMeaning {
    anchored: AxisSet,
    said: bool,
}

impl G92MovesMeaning {
    /// Axes written absolutely while a work system is in force stand at a known place.
    pub fn anchor(&mut self, axes: AxisSet) {
        self.anchored = self.anchored.or(axes);
    }

    pub fn look(&mut self, look: &Look, found: &mut Found) {
        match look.command.wording.one_shot {
            // Where a skip signal or a centred hole has led, the work itself says where that is.
            Some(Meaning::CentringXy | Meaning::CentringX | Meaning::CentringY) => {
                [b'X', b'Y']
                    .iter()
                    .filter_map(|&letter| look.facts.axis(letter))
                    .for_each(|axis| self.anchored.add(axis));
            }
            Some(Meaning::ReferenceReturn | Meaning::OtherReferenceReturn | Meaning::Skip) => {
                look.named().for_each(|axis| self.anchored.add(axis));
            }
            Some(Meaning::MachineCoordinates) => self.anchor(look.command.absolute),
            Some(Meaning::SetCoordinates) => self.judge(look, found),
            _ => {}
        }
    }

    fn judge(&mut self, look: &Look, found: &mut Found) {
        if look.named().next().is_none() {
            return;
        }
        let Some((code, name)) = look.one_shot() else { return };
        let place = &look.command.place;
        let work = look.control.roles.work;
        let before = look.before.groups.0[work];
        // The block may select a system itself; it acts before the G92.
        let written = look.command.wording.writes(work);
        let in_system = look.control.in_force(&look.before.groups, work) == Some(Meaning::WorkSystem);
        // Where there are work systems only, G92 shifts them all: what matters first is where the axes stand.
        let only_systems = look.control.base_system.is_none();
        let is_loose = look.named().any(|axis| !self.anchored.has(axis));
        if in_system && !written && !(only_systems && is_loose && !self.said) {
            let all = look.control.functions.work.shifts_all || look.fitting.policies.g92_system == G92System::All;
            let system = look.control.g_name(before);
            found.say(Rule::G92MovesMeaning, place, || {
                let does = match all {
                    true => "shifts every work system".to_owned(),
                    false => format!("sets the base system and selects it: {}", look.code_name(work)),
                };
                let shade = if only_systems { "shift" } else { "system" };
                Finding::new(Rule::G92MovesMeaning, shade, look.command, At::G(code))
                    .labelled(format!("{system} was in force"))
                    .with("code", name)
                    .with("system", system)
                    .with("does", does)
            });
            return;
        }
        if self.said || !is_loose {
            return;
        }
        self.said = true;
        let start = places(look.facts, look.named(), &look.command.from);
        found.say(Rule::G92MovesMeaning, place, || {
            Finding::new(Rule::G92MovesMeaning, "start", look.command, At::G(code))
                .labelled(format!("machine coordinates {start}"))
                .with("code", name)
                .with("start", start)
        });
    }
}
