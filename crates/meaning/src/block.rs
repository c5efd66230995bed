//! The order of work inside one block: what acts before what.
//!
//! 1 block delete · 2 modal G codes, the last of each group · 3 F S T B D H and M · 4 the one-shot code, the cycle or
//! the movement · 5 what ends the block. A refused block leaves everything as it was: the work is done on copies.

use base::{Alarm, AxisSet, Condition, UnitSystem};
use dialect::{Control, Meaning};
use syntax::{Block, Cursor, Grouping};

use crate::command::Command;
use crate::jump::{Calls, Found};
use crate::operation::{RapidKind, Side};
use crate::position_offset::PositionOffset;
use crate::program::CallName;
use crate::record::ReadAs;
use crate::setting::Setting;
use crate::state::State;
use crate::unknown::letter_bit;
use crate::user_macro::call::Arguments;
use crate::word::{MOST_WORDS, Refusal, Words};

/// Where the program goes on after a block.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Flow {
    /// With the next block.
    Next,
    /// In a subprogram, so many times, each time from its entry on; it may be a large one.
    Call { found: Found, entry: Cursor, repeats: u32, large: bool },
    /// In a macro with the block's arguments, so many times.
    MacroCall(Found, u32),
    /// With the next block, and in a macro after every move.
    ModalCall(Found, u32),
    /// Back in the caller, at the block after the call or at the found one.
    Return(Option<Found>),
    /// The main program from its head.
    Again,
    /// In the main program, at the found block.
    Jump(Found),
}

/// One block while it is given its meaning.
pub(crate) struct Reading<'r> {
    pub setting: &'r Setting,
    pub calls: &'r Calls,
    pub words: Words<'r>,
    /// The values of words that were variables, by their index; blanks for the others.
    pub word_values: &'r [f64],
    /// The program that the block calls by name.
    pub called: CallName,
    /// The arguments of a macro call.
    pub arguments: &'r mut Arguments,
    /// Words before a block-delete sign whose switch is on.
    pub word_count: usize,
    /// The state before the block.
    pub before: &'r State,
    /// The state after the block, in the making.
    pub next: &'r mut State,
    pub command: &'r mut Command,
    /// Modal groups whose codes stand in the block, one bit each.
    pub groups_written: u32,
    pub units: UnitSystem,
    pub absolute: bool,
    pub exact_stop: bool,
    /// Tapping mode: cuts know no override.
    pub tapping: bool,
    pub rapid_kind: RapidKind,
    pub position_offset: Option<PositionOffset>,
    /// The block calls a subprogram or returns from one: its P and L are the call's.
    pub calls_or_returns: bool,
    /// By how much the length offset has changed.
    pub length_change: f64,
    /// The block's one-shot code and the index of its word.
    pub one_shot: Option<(Meaning, usize)>,
    /// The axis words lead nowhere: they are the centre of scaling or the faces of a box.
    pub words_taken: bool,
    /// Letters of axes whose words are something else in this block, one bit each.
    pub not_axes: u32,
    /// Axes whose place the block determines, if nothing it rests on is unknown.
    pub now_known: AxisSet,
}

/// Gives a block its meaning: fills `command` and `next` (which holds a copy of `before`), and writes to `flow` where the
/// program goes on if that is not with the next block.
///
/// # Errors
/// The control refuses the block, or a jump's target must be found first; `next` is then worth nothing.
pub(crate) fn read_meaning(
    setting: &Setting,
    calls: &Calls,
    before: &State,
    next: &mut State,
    (block, word_values, called): (&Block, &[f64], CallName),
    arguments: &mut Arguments,
    (command, flow): (&mut Command, &mut Flow),
) -> Result<(), Refusal> {
    let (word_count, cut) = cut_by_block_delete(block, setting.switches.block_delete);
    let words = Words::new(block, command.place, setting.record.as_ref());
    let control = setting.control.as_ref();
    let mut reading = Reading {
        setting,
        calls,
        words,
        word_values,
        called,
        arguments,
        word_count,
        before,
        next,
        command,
        groups_written: 0,
        units: UnitSystem::Metric,
        absolute: true,
        exact_stop: false,
        tapping: false,
        rapid_kind: RapidKind::Checked,
        position_offset: None,
        calls_or_returns: false,
        length_change: 0.0,
        one_shot: None,
        words_taken: false,
        not_axes: 0,
        now_known: AxisSet::NONE,
    };
    reading.follow_mirror_switches();
    let words = &mut reading.words;
    words.take(word_count);
    // The multiplier counts in program text and in a macro call's arguments, not inside a macro's body.
    words.coarse = if setting.fitting.options.input_x10 && calls.macro_level() == 0 { 10 } else { 1 };
    words.whole_units = setting.whole_units();
    check_faults(setting, words, block, cut)?;
    check_skips(setting, words, block)?;
    reading.check_letters()?;
    reading.take_g_codes()?;
    let roles = control.roles;
    let groups = &reading.next.groups;
    reading.units = match control.in_force(groups, roles.units) {
        Some(Meaning::Inch) => UnitSystem::Inch,
        _ => UnitSystem::Metric,
    };
    reading.absolute = control.in_force(groups, roles.distance) != Some(Meaning::Incremental);
    let stop_mode = control.in_force(groups, roles.stop_mode);
    reading.tapping = stop_mode == Some(Meaning::TappingMode);
    let stops = stop_mode == Some(Meaning::ExactStopMode)
        || reading.one_shot.is_some_and(|(code, _)| code == Meaning::ExactStop);
    reading.exact_stop = stops && reading.next.feed_control & 4 == 0;
    reading.command.side = match control.in_force(groups, roles.compensation) {
        Some(Meaning::CompensationLeft) => Side::Left,
        Some(Meaning::CompensationRight) => Side::Right,
        _ => Side::Off,
    };
    reading.check_plane()?;
    let wording = &mut reading.command.wording;
    (wording.groups, wording.one_shot) = (reading.groups_written, reading.one_shot.map(|(code, _)| code));
    if let Some(modal) = reading.macro_call_kind() {
        // Every other word is an argument and means nothing else.
        *flow = reading.macro_call(modal)?;
        return Ok(());
    }
    reading.take_values()?;
    reading.take_codes(flow)?;
    reading.act()?;
    reading.check_returned()?;
    reading.finish();
    Ok(())
}

/// How many words a block-delete switch leaves, and from which character on the rest is ignored.
pub(crate) fn cut_by_block_delete(block: &Block, switches: u16) -> (usize, u16) {
    for skip in &block.skips {
        if switches & (1 << (skip.switch - 1)) != 0 {
            return (usize::from(skip.first_word), skip.extent.at);
        }
    }
    (block.words.len(), u16::MAX)
}

/// Refuses what could not be read, as far as it is not skipped.
fn check_faults(setting: &Setting, words: &Words, block: &Block, cut: u16) -> Result<(), Alarm> {
    let start = block.start.offset;
    if let Some(fault) = block.faults.iter().find(|f| f.extent.at < cut || f.condition == Condition::BlockTooLong) {
        let alarm = Alarm::new(fault.condition, words.place, fault.extent.span(start));
        return Err(alarm.with([f64::from(setting.control.grammar.block_length), 0.0, 0.0]));
    }
    Ok(())
}

/// Refuses block-delete switches that are not fitted.
fn check_skips(setting: &Setting, words: &Words, block: &Block) -> Result<(), Alarm> {
    match block.skips.iter().find(|skip| skip.switch > 1) {
        Some(skip) if !setting.fitting.options.block_delete_2_9 => {
            Err(Alarm::new(Condition::AddressUnavailable, words.place, skip.extent.span(block.start.offset)))
        }
        _ => Ok(()),
    }
}

impl<'r> Reading<'r> {
    /// The control's tables.
    pub fn control(&self) -> &'r Control {
        &self.setting.control
    }
}

impl Reading<'_> {
    /// Refuses letters that mean nothing on this control and machine, and variables.
    #[inline]
    fn check_letters(&self) -> Result<(), Alarm> {
        let own_rules = letter_bit(b'G') | letter_bit(b'M');
        let is_usual =
            self.words.letters() & !self.setting.usual_letters == 0 && self.words.repeated() & !own_rules == 0;
        // More words than are taken in by their letters are looked at one by one.
        if is_usual && self.word_count <= MOST_WORDS { Ok(()) } else { self.check_each_letter() }
    }

    fn check_each_letter(&self) -> Result<(), Alarm> {
        for word in self.words.block.words.iter().take(self.word_count) {
            if word.letter == b'G' || self.setting.axis_letters & letter_bit(word.letter) != 0 {
                continue;
            }
            let known = self.setting.control.address(word.letter).is_some_and(|address| !address.is_axis_or_macro());
            if !known && !self.is_argument(word) {
                return Err(self.words.alarm_at(Condition::AddressUnavailable, word));
            }
        }
        if self.words.has(b'O') {
            self.refuse_stray_label()?;
        }
        if !self.setting.control.last_word_wins {
            return self.refuse_repeated_words();
        }
        Ok(())
    }

    /// Whether a letter that means nothing else is an argument of the block's macro call.
    fn is_argument(&self, word: &syntax::Word) -> bool {
        let control = self.control();
        let calls = self.words.block.words.iter().any(|word| {
            let syntax::Value::Number(number) = word.value else { return false };
            let row = number.integer().filter(|_| word.letter == b'G').and_then(|code| control.g_row(code));
            row.and_then(|row| control.g_codes.get(usize::from(row)))
                .is_some_and(|code| matches!(code.meaning, Meaning::MacroCall | Meaning::ModalMacroCall))
        });
        calls && control.user_macro.argument(word.letter).is_some()
    }

    /// Refuses a second word of an address. G and M have rules of their own, and the arguments I, J, K of a macro call
    /// come in groups.
    fn refuse_repeated_words(&self) -> Result<(), Alarm> {
        let mut seen = 0u32;
        for word in self.words.block.words.iter().take(self.word_count) {
            let own_rules = matches!(word.letter, b'G' | b'M');
            if !own_rules && seen & letter_bit(word.letter) != 0 {
                let in_groups = matches!(word.letter, b'I' | b'J' | b'K') && self.is_argument(word);
                if !in_groups {
                    return Err(self.words.alarm_at(Condition::WordRepeated, word));
                }
            }
            seen |= letter_bit(word.letter);
        }
        Ok(())
    }

    /// Refuses an O word behind other words where it is a mere label.
    fn refuse_stray_label(&self) -> Result<(), Alarm> {
        let is_label = self.control().grammar.grouping == Grouping::Files;
        match self.words.word(b'O').filter(|_| is_label) {
            Some(word) if word.extent.at > self.words.block.words.first().map_or(0, |first| first.extent.at) => {
                Err(self.words.alarm_at(Condition::LabelPlace, word))
            }
            _ => Ok(()),
        }
    }

    /// F, H, D; of O and N only the range matters here.
    fn take_values(&mut self) -> Result<(), Alarm> {
        if self.words.has_any(letter_bit(b'O') | letter_bit(b'N')) {
            for letter in [b'O', b'N'] {
                self.words.integer(self.control(), letter)?;
            }
        }
        if !self.words.has_any(letter_bit(b'F') | letter_bit(b'H') | letter_bit(b'D')) {
            return Ok(());
        }
        let control = self.control();
        self.take_feed()?;
        let highest = control.highest_offset;
        for letter in [b'H', b'D'] {
            let number = self.words.count(control, letter)?;
            let Some(number) = number else { continue };
            if number > highest {
                let values = [f64::from(number), f64::from(highest), 0.0];
                return Err(self.words.alarm(Condition::OffsetNumber, letter).with(values));
            }
            if letter == b'H' { self.next.h = number } else { self.next.d = number }
        }
        Ok(())
    }

    /// The one-shot code, the cycle or the movement.
    fn act(&mut self) -> Result<(), Alarm> {
        let roles = self.control().roles;
        self.check_tip()?;
        self.words_taken = self.groups_written & self.setting.transform_groups != 0 && self.take_transforms()?;
        self.words_taken |= self.stroke_box()?;
        self.take_offset();
        self.length_change = self.change_length_offset()?;
        let control = self.control();
        let motion = control.in_force(&self.next.groups, roles.motion).unwrap_or(Meaning::Rapid);
        self.enter_cycle()?;
        if self.words_taken {
            return Ok(());
        }
        let cycle = control.in_force(&self.next.groups, roles.cycle).filter(|code| code.is_cycle());
        let Some((code, _)) = self.one_shot else {
            return self.move_or_cycle(cycle, motion);
        };
        match code {
            Meaning::ExactStop => self.move_or_cycle(cycle, motion),
            Meaning::PositionExtend
            | Meaning::PositionReduce
            | Meaning::PositionDoubleExtend
            | Meaning::PositionDoubleReduce => {
                self.read_position_offset(code)?;
                self.motion(motion)
            }
            Meaning::RapidWithoutCheck => {
                self.rapid_kind = RapidKind::Unchecked;
                self.motion(Meaning::Rapid)
            }
            Meaning::Dwell => self.dwell(),
            Meaning::WriteData => self.write_data(),
            Meaning::CircleCutClockwise | Meaning::CircleCutCounterClockwise => self.cut_circle(code),
            Meaning::SetCoordinates => self.set_coordinates(),
            Meaning::LocalCoordinates => self.local_coordinates(),
            Meaning::Skip => self.skip(),
            Meaning::CentringXy | Meaning::CentringX | Meaning::CentringY => self.centring(code),
            Meaning::ReferenceReturn => self.reference_return(),
            Meaning::OtherReferenceReturn => self.other_reference_return(),
            Meaning::ReturnFromReference => self.return_from_reference(),
            Meaning::ReferenceCheck => self.reference_check(),
            Meaning::MachineCoordinates => self.machine_coordinates(),
            Meaning::BoltCircle | Meaning::ArcPattern | Meaning::LinePattern => self.pattern(code, cycle),
            _ => Err(self.one_shot_alarm(Condition::NotYetBuilt)),
        }
    }

    fn move_or_cycle(&mut self, cycle: Option<Meaning>, motion: Meaning) -> Result<(), Alarm> {
        match cycle {
            Some(cycle) => self.cycle_block(cycle),
            None => self.motion(motion),
        }
    }

    /// The axes that have a word in this block.
    #[inline]
    pub fn axes_named(&self) -> AxisSet {
        self.setting.axes_of(self.words.letters() & !self.not_axes)
    }

    /// An axis' word in counts, and whether it was written with a minus sign.
    pub fn axis_word(&self, axis: usize) -> Result<(f64, bool), Alarm> {
        let Some(facts) = self.setting.facts.axes.get(axis) else { return Ok((0.0, false)) };
        let Some(number) = self.words.number(facts.letter)? else { return Ok((0.0, false)) };
        let control = self.setting.control.as_ref();
        let Some(address) = control.address(facts.letter) else {
            return Err(self.words.alarm(Condition::AddressUnavailable, facts.letter));
        };
        let value = if facts.rotary {
            control.angle(address, self.words.pointed(number))
        } else {
            control.length(address, self.words.pointed(number), self.units, self.words.coarse)
        };
        match value {
            Ok(value) => {
                let read = if facts.rotary { ReadAs::Angle } else { ReadAs::Length };
                self.words.note(facts.letter, read, value as f64 / 1e6);
                Ok((value as f64, number.negative))
            }
            Err((condition, values)) => Err(self.words.alarm(condition, facts.letter).with(values).on_axis(axis)),
        }
    }

    /// Notes where the axis words stand and what is known now.
    fn finish(&mut self) {
        // The words of a dwell, of G10, G52 and G92 lead nowhere.
        use Meaning::{Dwell, LocalCoordinates, SetCoordinates, WriteData};
        let leads_nowhere = matches!(self.one_shot, Some((Dwell | WriteData | SetCoordinates | LocalCoordinates, _)));
        let places = !self.words_taken && !leads_nowhere;
        let words = self.words.block.words.get(..self.word_count).unwrap_or_default();
        let mut written = AxisSet::NONE;
        for word in words.iter().take(MOST_WORDS) {
            if let Some(axis) = self.setting.axis_of(word.letter) {
                self.command.axis_words[axis] = word.extent;
                written.add(axis);
            }
        }
        self.command.written = written;
        let absolute = if self.absolute && places { written } else { AxisSet::NONE };
        self.command.absolute = absolute;
        self.command.wording.take(words, self.word_values);
        if !self.next.unknown.is_nothing() {
            self.learn(absolute);
        }
    }

    /// What the block wrote is known again, as far as what it rests on is.
    fn learn(&mut self, absolute: AxisSet) {
        let roles = self.setting.control.roles;
        let mut unknown = self.next.unknown;
        unknown.groups &= !self.groups_written;
        unknown.words &= !self.words.letters();
        if let Some((Meaning::SetCoordinates, _)) = self.one_shot {
            // An origin set from an unknown place is unknown; one set from a known place is known again.
            let named = self.axes_named();
            unknown.origins = unknown.origins.without(named).or(named.and(unknown.axes));
            unknown.memory |= self.control().functions.work.shifts_all && !named.and(unknown.axes).is_empty();
            unknown.groups &= !(1 << roles.work);
            self.next.unknown = unknown;
            return;
        }
        let in_base = self.control().in_force(&self.next.groups, roles.work) == Some(Meaning::BaseSystem);
        let mut astray = if in_base { unknown.origins } else { AxisSet::NONE };
        if unknown.memory {
            let offset = self.control().in_force(&self.next.groups, roles.length).and_then(Meaning::length_offset);
            let by_length = self.setting.length_axis.filter(|_| offset != Some(0.0)).map(AxisSet::only);
            astray = astray.or(if in_base { by_length.unwrap_or_default() } else { self.setting.facts.all() });
        }
        let rests = [roles.distance, roles.work, roles.units, roles.cycle, roles.scaling.unwrap_or(roles.work)];
        let turns = [roles.rotation, roles.polar].iter().flatten().any(|&group| unknown.group(group));
        let named = self.now_known.or(absolute);
        if turns || rests.iter().any(|&group| unknown.group(group)) {
            unknown.axes = unknown.axes.or(named);
        } else {
            let at_reference =
                matches!(self.one_shot, Some((Meaning::ReferenceReturn | Meaning::OtherReferenceReturn, _)));
            let known = if at_reference { self.now_known } else { absolute };
            let known = if at_reference { known } else { known.without(astray) };
            let half = self.half_turned(absolute, unknown.axes);
            unknown.axes = unknown.axes.without(known.without(half)).or(absolute.and(astray)).or(half);
        }
        self.next.unknown = unknown;
    }
}
