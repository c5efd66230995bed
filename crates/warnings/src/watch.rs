//! The watch: it sees every event of a run, looks at the block that each belongs to, and lets the rules judge.
//!
//! Comes in: events, with the interpreter that made them. Goes out: findings. It never changes what runs. A block's
//! cost is a few bit sets; only a block that does something rare is looked at by all rules.

use std::mem;

use base::{AXES, Place, Point};
use dialect::Meaning;
use machine::{Event, EventKind};
use meaning::{EndKind, Finish, Interpreter, LENGTH_AXIS, letter_bit};
use path::{Arc, Part, RunBeside};
use station::Configuration;

use crate::finding::{Finding, Found};
use crate::look::{Look, widest};
use crate::rule::barrier_in_compensation::BarrierInCompensation;
use crate::rule::boring_code_differs::BoringCodeDiffers;
use crate::rule::corner_mode_unset::CornerModeUnset;
use crate::rule::endless::Endless;
use crate::rule::ends_with_offset::EndsWithOffset;
use crate::rule::g92_moves_meaning::G92MovesMeaning;
use crate::rule::gouge_ahead::{GougeAhead, LOOK_AHEAD};
use crate::rule::inherited_state::InheritedState;
use crate::rule::integer_coordinate::IntegerCoordinate;
use crate::rule::integer_feed::IntegerFeed;
use crate::rule::offset_unset::OffsetUnset;
use crate::rule::one_shot_company::Company;
use crate::rule::{BLOCK_RULES, missing_return, rapid_down_and_across};
use crate::rules::Rule;
use crate::way::Stretch;

/// Letters that only rare blocks have: codes, offsets, levels.
const RARE_LETTERS: &[u8] = b"DFHMQRST";

/// What watches over a run.
pub struct Watch {
    found: Found,
    /// An alarm was raised in the block being executed.
    refused: bool,
    /// Rules that this control's own tables do not list.
    silent: Vec<Rule>,
    rare_letters: u32,
    /// The axis on which length offsets act, its letter, and the other axes that slide.
    length_axis: Option<(usize, u8)>,
    across: [bool; AXES],
    /// A work system is in force: an absolute word leads to a place that is known.
    in_work_system: bool,
    inherited: InheritedState,
    points: IntegerCoordinate,
    feed: IntegerFeed,
    boring: BoringCodeDiffers,
    company: Company,
    offsets: OffsetUnset,
    ends: EndsWithOffset,
    g92: G92MovesMeaning,
    endless: Endless,
    /// Tool radius compensation, and whether an alarm has made it doubtful where the tool stands beside its path.
    stretch: Stretch,
    doubtful: bool,
    corner: CornerModeUnset,
    barrier: BarrierInCompensation,
    says_barriers: bool,
    gouge: GougeAhead,
    widest: f64,
}

impl Watch {
    /// A watch over a run that starts from this configuration.
    pub fn new(configuration: &Configuration) -> Watch {
        let Configuration { control, fitting, machine, memory, .. } = configuration;
        let facts = machine.facts();
        let own = |name: &str| control.own_warnings.iter().any(|row| row.name == name);
        let needs_row = |name: &str| control.warnings.iter().any(|row| row.own && row.name == name);
        let silent = Rule::ALL.iter().copied().filter(|rule| needs_row(rule.name()) && !own(rule.name()));
        let silent: Vec<Rule> = silent.collect();
        let length_axis =
            facts.axis(LENGTH_AXIS).filter(|_| !machine.path.straight_rapid).map(|axis| (axis, LENGTH_AXIS));
        let mut across = [false; AXES];
        for (index, axis) in facts.axes.iter().enumerate().take(AXES) {
            across[index] = !axis.rotary && length_axis.is_some_and(|(length, _)| length != index);
        }
        let travel: Vec<[f64; 2]> = machine.axes.iter().map(|axis| axis.travel).collect();
        Watch {
            found: Found::default(),
            refused: false,
            says_barriers: !silent.contains(&Rule::BarrierInCompensation),
            silent,
            rare_letters: RARE_LETTERS.iter().fold(0, |set, &letter| set | letter_bit(letter)),
            length_axis,
            across,
            in_work_system: false,
            inherited: InheritedState::new(control),
            points: IntegerCoordinate::new(control, fitting, &facts),
            feed: IntegerFeed::default(),
            boring: BoringCodeDiffers::default(),
            company: Company::default(),
            offsets: OffsetUnset::new(memory, control.highest_offset),
            ends: EndsWithOffset::default(),
            g92: G92MovesMeaning::default(),
            endless: Endless::default(),
            stretch: Stretch::default(),
            doubtful: false,
            corner: CornerModeUnset::default(),
            barrier: BarrierInCompensation::default(),
            gouge: GougeAhead::new(LOOK_AHEAD),
            widest: widest(&travel),
        }
    }

    /// The same with so many elements of a compensated contour held against each other; 0 for none.
    #[must_use]
    pub fn looking_ahead(mut self, elements: u32) -> Watch {
        self.gouge = GougeAhead::new(elements);
        self
    }

    /// Sees an event, at once after it has happened; `beside` is how the move follows from the programmed path.
    pub fn see(&mut self, event: &Event, interpreter: &Interpreter, beside: Option<&RunBeside>) {
        match &event.kind {
            EventKind::BlockDone if event.place.line > 0 => self.block(interpreter),
            EventKind::Rapid { from, to, .. } => {
                self.rapid(from, to, interpreter);
                self.way(&event.place, (from, to, None), beside, interpreter);
            }
            EventKind::Feed { from, to, .. } => self.way(&event.place, (from, to, None), beside, interpreter),
            EventKind::Arc { arc, .. } => self.way(&event.place, (&arc.from, &arc.to, Some(arc)), beside, interpreter),
            EventKind::Start(_) => {
                // The contour of the piece before is cut.
                self.break_off();
                self.corner.begin();
            }
            EventKind::Alarm(_) => {
                self.refused = true;
                self.doubtful = true;
                self.break_off();
            }
            EventKind::End { kind, groups, reset, .. } => {
                self.barrier.flush(&mut self.found);
                let look = look(interpreter);
                // What a refused block has left unknown is not judged.
                if look.after().unknown.is_nothing() {
                    self.ends.end(&look, groups, (*kind, *reset), &mut self.found);
                    self.endless.end(&look, *kind, &mut self.found);
                }
                self.inherited.end(*kind, &mut self.found);
            }
            _ => {}
        }
    }

    /// The run is over, whatever ended it: what only the whole shows.
    pub fn finish(&mut self) {
        self.break_off();
        self.inherited.end(EndKind::Text, &mut self.found);
        self.points.end(&mut self.found);
    }

    /// The findings so far; they are handed out once.
    pub fn take(&mut self) -> Vec<Finding> {
        let mut list = mem::take(&mut self.found.list);
        list.retain(|finding| !self.silent.contains(&finding.rule));
        list
    }

    /// True if there are findings to take.
    pub fn has_found(&self) -> bool {
        !self.found.list.is_empty()
    }

    /// The longest travel of the machine's axes, mm or degrees: what lies beyond cannot be meant.
    pub fn widest(&self) -> f64 {
        self.widest
    }

    /// The states that the program used before it set them.
    pub(crate) fn inherited(&self) -> u32 {
        self.inherited.used()
    }

    fn rapid(&mut self, from: &Point, to: &Point, interpreter: &Interpreter) {
        let Some((axis, letter)) = self.length_axis else { return };
        if let Some((down, across)) = rapid_down_and_across::legs(from, to, axis, &self.across) {
            let [command, before] = interpreter.done();
            if command.after.unknown.is_nothing() && before.after.unknown.is_nothing() {
                self.found.say(Rule::RapidDownAndAcross, &command.place, || {
                    rapid_down_and_across::finding(command, letter, down, across)
                });
            }
        }
    }

    /// A move, if the tool runs beside its path or did until now.
    #[inline]
    fn way(
        &mut self,
        place: &Place,
        ends: (&Point, &Point, Option<&Arc>),
        beside: Option<&RunBeside>,
        interpreter: &Interpreter,
    ) {
        if beside.is_some() || self.stretch.is_on() {
            self.step(place, ends, beside, interpreter);
        }
    }

    fn step(
        &mut self,
        place: &Place,
        ends: (&Point, &Point, Option<&Arc>),
        beside: Option<&RunBeside>,
        interpreter: &Interpreter,
    ) {
        if self.doubtful {
            // Until it begins anew it is not known where the tool stands.
            let is_known = interpreter.executing_state().unknown.is_nothing();
            if !is_known || beside.is_none_or(|beside| beside.part != Part::Start) {
                return;
            }
            self.doubtful = false;
        }
        let (way, turns) = self.gouge.slot();
        if !self.stretch.write((way, turns), place, ends, beside, interpreter) {
            return;
        }
        let found = &mut self.found;
        self.corner.look((way, turns), interpreter, found);
        way.claimed = self.barrier.step((way, turns), found) && self.says_barriers;
        let leaves = way.leaves;
        self.gouge.step(interpreter, found);
        if leaves {
            self.break_off();
        }
    }

    /// What the tool does beside its path is not known from here on.
    fn break_off(&mut self) {
        self.stretch.end();
        self.barrier.end(&mut self.found);
        self.gouge.end(&mut self.found);
        self.corner.drop_corner();
    }

    fn block(&mut self, interpreter: &Interpreter) {
        let [command, before] = interpreter.done();
        missing_return::look(interpreter, command, &mut self.found);
        if mem::take(&mut self.refused) || command.is_refused() {
            return self.inherited.pass_over(&look(interpreter));
        }
        let control = interpreter.control();
        if self.points.count(command) {
            let inch = control.in_force(&command.after.groups, control.roles.units) == Some(Meaning::Inch);
            self.points.keep(command, control, inch);
        }
        if self.in_work_system {
            self.g92.anchor(command.absolute);
        }
        let wording = &command.wording;
        let is_rare = wording.groups != 0
            || wording.letters & self.rare_letters != 0
            || wording.one_shot.is_some()
            || command.finish != Finish::Next
            || command.levels().is_some()
            || self.inherited.is_open()
            || before.after.displacement.iter().fold(false, |any, &way| any | (way != 0.0));
        if !is_rare {
            return;
        }
        let look = look(interpreter);
        if !command.after.unknown.is_nothing() || !before.after.unknown.is_nothing() {
            return self.inherited.pass_over(&look);
        }
        self.in_work_system = look.in_force(control.roles.work) == Some(Meaning::WorkSystem);
        let found = &mut self.found;
        self.inherited.look(&look, found);
        self.feed.look(&look, found);
        self.boring.look(&look, found);
        self.company.look(&look, found);
        self.offsets.look(&look, found);
        self.ends.look(&look);
        self.barrier.look(&look, found);
        self.g92.look(&look, found);
        self.endless.look(&look);
        for (_, rule) in BLOCK_RULES {
            rule(&look, found);
        }
    }
}

fn look(interpreter: &Interpreter) -> Look<'_> {
    let [command, before] = interpreter.done();
    Look {
        interpreter,
        control: interpreter.control(),
        fitting: interpreter.fitting(),
        facts: interpreter.facts(),
        memory: interpreter.memory(),
        before: &before.after,
        command,
    }
}
