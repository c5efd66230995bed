//! A block where it stands: its words as the control read them, the codes in force, what it is about.

use base::{Alarm, UnitSystem};
use dialect::{Control, Fitting, GCode, MMeaning, Meaning};
use machine::{MachineAxis, MachineFile};
use meaning::ReadAs;
use syntax::{Block, Value, Word};

use super::watch::Watched;

/// Everything that explaining a block rests on.
pub struct Here<'h> {
    pub control: &'h Control,
    pub fitting: &'h Fitting,
    pub machine: &'h MachineFile,
    pub watched: &'h Watched,
    pub block: &'h Block,
    /// The block's own characters.
    pub text: &'h [u8],
    /// BLOCK DELETE switches that are on, bit 0 for the first.
    pub block_delete: u16,
}

impl<'h> Here<'h> {
    /// The row in force in a group for the block's words: its own code counts, in a refused block too.
    fn row_in(&self, group: usize) -> u8 {
        let own = self.rows().filter(|(_, code)| code.group.map(usize::from) == Some(group)).last();
        match own {
            Some((row, _)) if self.watched.alarm.is_some() => row,
            _ => self.watched.after.groups.0.get(group).copied().unwrap_or(dialect::NO_CODE),
        }
    }

    /// What the code in force in a group means.
    pub fn in_force(&self, group: usize) -> Option<Meaning> {
        self.control.g_codes.get(usize::from(self.row_in(group))).map(|code| code.meaning)
    }

    /// The code in force in a group.
    pub fn code_in(&self, group: usize) -> Option<&'h GCode> {
        self.control.g_codes.get(usize::from(self.row_in(group)))
    }

    pub fn units(&self) -> UnitSystem {
        match self.in_force(self.control.roles.units) {
            Some(Meaning::Inch) => UnitSystem::Inch,
            _ => UnitSystem::Metric,
        }
    }

    pub fn is_absolute(&self) -> bool {
        self.in_force(self.control.roles.distance) != Some(Meaning::Incremental)
    }

    /// The canned cycle in force.
    pub fn cycle(&self) -> Option<Meaning> {
        self.in_force(self.control.roles.cycle).filter(|code| code.is_cycle())
    }

    /// True while the spindle is to keep a surface speed.
    pub fn keeps_surface_speed(&self) -> bool {
        let group = self.control.roles.surface_speed;
        group.and_then(|group| self.in_force(group)) == Some(Meaning::SurfaceSpeedOn)
    }

    pub fn motion(&self) -> Option<Meaning> {
        self.in_force(self.control.roles.motion)
    }

    /// The rows of the block's G codes, as far as they were read.
    pub fn rows(&self) -> impl Iterator<Item = (u8, &'h GCode)> + use<'h> {
        let control = self.control;
        self.watched
            .words
            .g_rows
            .iter()
            .filter_map(move |&(_, row)| control.g_codes.get(usize::from(row)).map(|code| (row, code)))
    }

    /// The block's one-shot code.
    pub fn one_shot(&self) -> Option<Meaning> {
        self.rows().find(|(_, code)| code.is_one_shot()).map(|(_, code)| code.meaning)
    }

    /// True if the block has a G code of this meaning.
    pub fn has_code(&self, meaning: Meaning) -> bool {
        self.rows().any(|(_, code)| code.meaning == meaning)
    }

    /// True if the block has an M code of this meaning.
    pub fn has_m(&self, meaning: MMeaning) -> bool {
        let of = |code: &u32| self.control.m_code(*code).is_some_and(|row| row.meaning == meaning);
        self.watched.words.m_codes.iter().any(of)
    }

    /// True if a word of this letter stands in the block.
    pub fn has(&self, letter: u8) -> bool {
        self.block.words.iter().any(|word| word.letter == letter)
    }

    pub fn alarm(&self) -> Option<&Alarm> {
        self.watched.alarm.as_ref()
    }

    /// What a word was read as.
    pub fn read(&self, letter: u8) -> Option<(ReadAs, f64)> {
        self.watched.words.word(letter)
    }

    /// The axis of this letter and its index.
    pub fn axis(&self, letter: u8) -> Option<(usize, &'h MachineAxis)> {
        self.machine.axes.iter().enumerate().find(|(_, axis)| axis.letter == letter)
    }

    /// The name of the code in force in a group.
    pub fn name_in(&self, group: usize) -> String {
        self.control.g_name(self.row_in(group))
    }

    /// A word as it is written, blanks and blank tape left out.
    pub fn written(&self, at: u16, len: u16) -> String {
        let (from, to) = (usize::from(at), usize::from(at) + usize::from(len));
        let bytes: Vec<u8> =
            self.text.get(from..to).unwrap_or_default().iter().copied().filter(|&b| b > b' ').collect();
        String::from_utf8_lossy(&bytes).into_owned()
    }

    /// True if this is not the last word of its letter, where only the last counts.
    pub fn is_overridden(&self, index: usize, word: &Word) -> bool {
        let later = self.block.words.iter().skip(index + 1).find(|later| later.letter == word.letter);
        !matches!(word.letter, b'G' | b'M') && later.is_some()
    }

    /// The code in the block that takes the place of this one: a later one of the same group.
    pub fn later_code(&self, index: usize, code: &GCode) -> Option<String> {
        let group = code.group?;
        let later = self.block.words.iter().skip(index + 1).filter_map(|word| self.row_of(word));
        let later = later.rev().find(|later| later.group == Some(group))?;
        (later.code != code.code).then(|| format!("G{:02}", later.code))
    }

    /// The row of a G word.
    pub fn row_of(&self, word: &Word) -> Option<&'h GCode> {
        if let Some((_, row)) = self.watched.words.g_rows.iter().find(|(at, _)| *at == word.extent.at) {
            return self.control.g_codes.get(usize::from(*row));
        }
        let Value::Number(number) = word.value else { return None };
        let row = self.control.g_row(number.integer()?).filter(|_| word.letter == b'G')?;
        self.control.g_codes.get(usize::from(row))
    }

    /// The block-delete sign whose switch is on: from this word on the block is passed over.
    pub fn cut(&self) -> Option<(usize, u8)> {
        let skip = self.block.skips.iter().find(|skip| self.block_delete & (1 << (skip.switch - 1)) != 0)?;
        Some((usize::from(skip.first_word), skip.switch))
    }
}
