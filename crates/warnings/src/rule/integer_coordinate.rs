//! `integer-coordinate`: a coordinate without a decimal point in a program that mostly writes points.
//!
//! What: `X600. Y400`: without a point Y counts least increments, so it is 0.400 mm and not 400 mm.
//! Why: the axis stops a thousandth of the way along, and whatever comes next starts from there.
//! Do: write the point, `Y400.`; if increments are meant, write 0.400 so that the next reader sees it.
//!
//! Silent in programs that write most coordinates without a point, for zero, and where only one reading makes sense:
//! with a point the number would lead further than the machine's longest axis travels (`Q6000` for a peck of 6 mm).
//! Not looked at: the X of a dwell, the arguments of macro calls (a count is as likely as a length), the Q of M98 and G10.
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
        let coarse = if fitting.options.input_x10 { 10 } else { 1 };
        let rotary = facts.axes.iter().filter(|axis| axis.rotary).fold(0, |set, axis| set | letter_bit(axis.letter));
        IntegerCoordinate {
            coordinates,
            rotary,
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
        self.pointed += u64::from((wording.pointed & self.coordinates).count_ones());
        let plain = wording.plain & self.coordinates;
        if plain == 0 {
            return false;
        }
        self.plain += u64::from(plain.count_ones());
        self.candidates.len() < MOST_PLACES
    }

    /// Keeps a block with a coordinate without a point.
    pub fn keep(&mut self, command: &Command, inch: bool) {
        let wording = &command.wording;
        let mut letters = wording.plain & self.coordinates;
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
        let turns = self.rotary & letter_bit(letter) != 0 || is_pattern && matches!(letter, b'J' | b'K');
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
            let coarse = self.coarse;
            for Candidate { order, place, letter, readings } in self.candidates.drain(..) {
                found.say(Rule::IntegerCoordinate, &place, || {
                    let finding = Finding::at(Rule::IntegerCoordinate, "", order, place, At::Letter(letter));
                    Finding { readings: Some(readings), coarse, ..finding }
                });
            }
        }
        self.candidates.clear();
    }
}
