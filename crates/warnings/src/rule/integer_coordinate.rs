//! `integer-coordinate`: a coordinate without a decimal point in a program that mostly writes points.
//!
//! What: `X600. Y400`: without a point Y counts least increments, so it is 0.400 mm and not 400 mm.
//! Why: the axis stops a thousandth of the way along, and whatever comes next starts from there.
//! Do: write the point, `Y400.`; if increments are meant, write 0.400 so that the next reader sees it.
//!
//! Where a parameter makes an integer the value itself it means what it says here, and a thousandth of it wherever
//! integers count: then that is said.
//!
//! Silent in programs that write most coordinates without a point, for zero, and where only one reading makes sense:
//! with a point the number would lead further than the machine's longest axis travels (`Q6000` for a peck of 6 mm).
//! Not looked at: the X of a dwell, ratios of scaling, how often a hole is repeated, the arguments of macro calls (a count
//! is as likely as a length), the Q of M98 and G10.
//! The program as a whole decides, so the findings come at its end; at most 4096 places are kept.

use std::collections::BTreeSet;

use base::{Place, SourceId};
use dialect::{AddressKind, Control, Fitting, Meaning};
use meaning::{Command, MachineFacts, letter_bit};

use crate::finding::{At, Finding, Found, Readings};
use crate::rules::Rule;

/// Places that are kept until the program has shown how it writes.
const MOST_PLACES: usize = 4096;

struct Candidate {
    order: u64,
    place: Place,
    letter: u8,
    readings: Readings,
}

/// How the program writes its coordinates.
pub(crate) struct IntegerCoordinate {
    coordinates: u32,
    rotary: u32,
    /// Group and letters of the ratios of scaling, which are no coordinates.
    ratios: Option<(usize, u32)>,
    /// Group and letter of the angle of rotation.
    angle: Option<(usize, u32)>,
    /// Letters that repeat a hole.
    repeats: u32,
    whole_units: bool,
    pointed: u64,
    plain: u64,
    coarse: i64,
    candidates: Vec<Candidate>,
    seen: BTreeSet<(SourceId, u64)>,
}

impl IntegerCoordinate {
    pub fn new(control: &Control, fitting: &Fitting, facts: &MachineFacts) -> IntegerCoordinate {
        let mut coordinates = 0;
        for letter in b'A'..=b'Z' {
            let kind = control.address(letter).map(|address| address.kind);
            if facts.axis(letter).is_some() || kind == Some(AddressKind::Length) {
                coordinates |= letter_bit(letter);
            }
        }
        let roles = &control.roles;
        let ratios = roles
            .scaling
            .zip(control.scaling.as_ref().and_then(|rule| rule.ratios))
            .map(|(group, letters)| (group, letters.iter().fold(0, |set, &letter| set | letter_bit(letter))));
        let coarse = if fitting.options.input_x10 { 10 } else { 1 };
        let rotary = facts.axes.iter().filter(|axis| axis.rotary).fold(0, |set, axis| set | letter_bit(axis.letter));
        IntegerCoordinate {
            coordinates,
            rotary,
            ratios,
            angle: roles.rotation.zip(control.rotation).map(|(group, rule)| (group, letter_bit(rule.angle))),
            repeats: control.functions.cycle.repeats.iter().fold(0, |set, &letter| set | letter_bit(letter)),
            whole_units: fitting.parameter_if_any(control.whole_units) != 0.0,
            pointed: 0,
            plain: 0,
            coarse,
            candidates: Vec::new(),
            seen: BTreeSet::new(),
        }
    }

    /// Counts a block's coordinates; true if one of them has no point.
    #[inline]
    pub fn count(&mut self, command: &Command) -> bool {
        let wording = &command.wording;
        let coordinates = self.coordinates_in(command);
        self.pointed += u64::from((wording.pointed & coordinates).count_ones());
        let plain = wording.plain & coordinates;
        if plain == 0 {
            return false;
        }
        self.plain += u64::from(plain.count_ones());
        self.candidates.len() < MOST_PLACES
    }

    /// The letters that are coordinates in a block.
    fn coordinates_in(&self, command: &Command) -> u32 {
        let wording = &command.wording;
        let coordinates = match self.ratios {
            Some((group, letters)) if wording.writes(group) => self.coordinates & !letters,
            _ => self.coordinates,
        };
        let repeats = wording.letters & coordinates & self.repeats != 0 && command.levels().is_some();
        if repeats { coordinates & !self.repeats } else { coordinates }
    }

    /// The letters that are angles in a block, beside those of rotary axes.
    fn angles_in(&self, command: &Command, control: &Control) -> u32 {
        let turned = match self.angle {
            Some((group, letter)) if command.wording.writes(group) => letter,
            _ => 0,
        };
        let polar = match control.in_force(&command.after.groups, control.roles.plane) {
            _ if !command.after.polar.on => return turned,
            Some(Meaning::PlaneZx) => b'X',
            Some(Meaning::PlaneYz) => b'Z',
            _ => b'Y',
        };
        turned | letter_bit(polar)
    }

    /// Keeps a block with a coordinate without a point.
    pub fn keep(&mut self, command: &Command, control: &Control, inch: bool) {
        let wording = &command.wording;
        let mut letters = wording.plain & self.coordinates_in(command);
        match wording.one_shot {
            Some(Meaning::Dwell | Meaning::MacroCall | Meaning::ModalMacroCall) => return,
            // In the body of a macro, where the option does not act, it cannot be told from here.
            _ if self.coarse != 1 && command.is_called() => return,
            // Q chooses what G10 writes.
            Some(Meaning::WriteData) => letters &= !letter_bit(b'Q'),
            _ if wording.has(b'M') && wording.has(b'P') => letters &= !letter_bit(b'Q'),
            _ => {}
        }
        let key = (command.place.source, command.place.block.start);
        // In a canned cycle's words and the like the axes come last: they are what goes astray.
        let Some(last) = letters.checked_ilog2().filter(|_| self.seen.insert(key)) else { return };
        let letter = b'A' + last as u8;
        let is_pattern =
            matches!(wording.one_shot, Some(Meaning::BoltCircle | Meaning::ArcPattern | Meaning::LinePattern));
        let angles = self.rotary | self.angles_in(command, control);
        let turns = angles & letter_bit(letter) != 0 || is_pattern && matches!(letter, b'J' | b'K');
        let readings = match (turns, inch) {
            (true, _) => Readings::Degrees,
            (false, true) => Readings::Inches,
            (false, false) => Readings::Millimetres,
        };
        self.candidates.push(Candidate { order: command.block, place: command.place, letter, readings });
    }

    /// The program has ended: is a number without a point the exception in it?
    pub fn end(&mut self, found: &mut Found) {
        if self.pointed >= self.plain {
            let (coarse, whole_units) = (self.coarse, self.whole_units);
            let shade = if whole_units { "whole" } else { "" };
            for Candidate { order, place, letter, readings } in self.candidates.drain(..) {
                found.say(Rule::IntegerCoordinate, &place, || {
                    let finding = Finding::at(Rule::IntegerCoordinate, shade, order, place, At::Letter(letter));
                    Finding { readings: Some(readings), coarse, whole_units, ..finding }
                });
            }
        }
        self.candidates.clear();
    }
}
