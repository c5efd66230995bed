//! S, T, B and M words: what goes out to the machine, and in which order.
//!
//! Codes that start with the block come first (S, T, B, M), then those that the machine file sends after the motion.
//! Codes that the control works off inside (M90 to M99 of a YASNAC) are not sent.

use base::{Alarm, Condition};
use dialect::{MMeaning, MOver99};

use crate::block::{Flow, Reading};
use crate::command::{Finish, MOST_CODES};
use crate::cycle::Spindle;
use crate::operation::{CodeLine, CodeOut, EndKind};
use crate::state::Corner;
use crate::word::Refusal;

/// The highest of the two-digit codes that stand for spindle speeds.
const HIGHEST_SPEED_CODE: u32 = 99;

impl Reading<'_> {
    /// Takes the block's codes; writes to `flow` where one of them sends the program.
    pub fn take_codes(&mut self, flow: &mut Flow) -> Result<(), Refusal> {
        let by_surface = self.is_surface_speed();
        if !by_surface && !self.words.has_any(self.setting.code_letters) {
            return Ok(());
        }
        let control = self.control();
        let digits = self.setting.facts.codes.digits;
        if by_surface {
            if let Some(speed) = self.follow_surface()? {
                self.push_code(CodeLine::S, speed, digits[1], false, None)?;
            }
        } else if let Some(speed) = self.words.count(control, b'S')? {
            let coded = !self.setting.fitting.options.spindle_rpm;
            if coded && speed > HIGHEST_SPEED_CODE {
                let values = [f64::from(speed), 0.0, f64::from(HIGHEST_SPEED_CODE)];
                return Err(self.words.alarm(Condition::ValueOutOfRange, b'S').with(values).into());
            }
            self.next.spindle = speed;
            self.send(CodeLine::S, b'S', speed, if coded { 2 } else { digits[1] }, false)?;
        }
        if let Some(tool) = self.words.count(control, b'T')? {
            self.next.tool = tool;
            self.send(CodeLine::T, b'T', tool, digits[2], false)?;
        }
        if self.words.has(b'B') && self.setting.facts.axis(b'B').is_none() {
            if !self.setting.fitting.options.b_function {
                return Err(self.words.alarm(Condition::AddressUnavailable, b'B').into());
            }
            if let Some(index) = self.words.count(control, b'B')? {
                self.next.index = index;
                self.send(CodeLine::B, b'B', index, digits[3], self.setting.facts.codes.b_after_motion)?;
            }
        }
        if self.words.has(b'M') {
            *flow = self.take_m_codes(digits[0])?;
        }
        Ok(())
    }

    fn take_m_codes(&mut self, digits: u8) -> Result<Flow, Refusal> {
        let control = self.control();
        let mut flow = Flow::Next;
        let mut taken = 0;
        for word in self.words.block.words.iter().take(self.word_count).filter(|word| word.letter == b'M') {
            taken += 1;
            let most = if self.setting.fitting.options.several_m_codes { control.most_m_codes } else { 1 };
            if taken > most {
                return Err(self.words.alarm_at(Condition::MSeveral, word).into());
            }
            let number = self.words.value(word)?;
            let Some(address) = control.address(b'M') else {
                return Err(self.words.alarm_at(Condition::AddressUnavailable, word).into());
            };
            let code = control
                .integer(address, number)
                .map_err(|(condition, values)| self.words.alarm_at(condition, word).with(values))?;
            let code = u32::try_from(code).unwrap_or(u32::MAX);
            self.words.note_m(code);
            let Some(row) = control.m_code(code) else {
                self.send_builders_code(code, digits, word)?;
                self.next.miscellaneous = code;
                continue;
            };
            self.next.miscellaneous = code;
            self.command.stops_reading |= row.stops_read_ahead;
            let after = self.setting.facts.codes.m_after_motion.contains(&code);
            if let Some(leads) = self.m_code(row.meaning, code, word)? {
                flow = leads;
            }
            if row.to_machine {
                self.push_code(CodeLine::M, code, digits, after, Some(word))?;
            }
        }
        // The program's end is stronger than a call or return in its block.
        Ok(if matches!(self.command.finish, Finish::End(_)) { Flow::Next } else { flow })
    }

    /// What a code of the control itself does; where the program goes on, if that is its doing.
    fn m_code(&mut self, meaning: MMeaning, code: u32, word: &syntax::Word) -> Result<Option<Flow>, Refusal> {
        match meaning {
            // The program's end in the same block is stronger than a stop, in either order.
            MMeaning::ProgramStop if !matches!(self.command.finish, Finish::End(_)) => {
                self.command.finish = Finish::ProgramStop;
            }
            MMeaning::ProgramStop => {}
            MMeaning::OptionalStop => {
                if self.command.finish == Finish::Next {
                    self.command.finish = Finish::OptionalStop;
                }
                self.command.optional_code = Some(self.command.code_count);
            }
            MMeaning::ProgramEnd => self.command.finish = Finish::End(EndKind::M02),
            MMeaning::TapeEnd => self.command.finish = Finish::End(EndKind::M30),
            MMeaning::SubprogramCall => {
                self.calls_or_returns = true;
                return self.call(word).map(Some);
            }
            MMeaning::InternalCall => {
                self.calls_or_returns = true;
                return self.internal_call(word, code).map(Some);
            }
            MMeaning::SubprogramEnd => {
                self.calls_or_returns = true;
                return self.subprogram_end().map(Some);
            }
            MMeaning::InterruptOff | MMeaning::InterruptOn if !self.setting.fitting.options.program_interrupt => {
                let alarm = self.words.alarm_at(Condition::MNotFitted, word);
                return Err(alarm.with([f64::from(code), 0.0, 0.0]).into());
            }
            MMeaning::InterruptOff => self.next.interrupt = None,
            MMeaning::InterruptOn => {
                self.calls_or_returns = true;
                self.interrupt_on(word)?;
            }
            MMeaning::BufferingOff => self.next.buffering = false,
            MMeaning::BufferingOn => self.next.buffering = true,
            MMeaning::CornerArc => self.next.corner = Corner::Arc,
            MMeaning::CornerIntersection => self.next.corner = Corner::Intersection,
            MMeaning::MirrorOn => self.mirror_on(),
            MMeaning::MirrorOff => self.mirror_off(),
        }
        Ok(None)
    }

    /// A code whose meaning is the machine builder's.
    fn send_builders_code(&mut self, code: u32, digits: u8, word: &syntax::Word) -> Result<(), Alarm> {
        let [machine, control, extended] = self.setting.control.m_ranges;
        let within = |range: [u32; 2]| range[0] <= code && code <= range[1];
        if within(control) || !(within(machine) || within(extended)) {
            return Err(self.words.alarm_at(Condition::MUnknown, word).with([f64::from(code), 0.0, 0.0]));
        }
        let after = self.setting.facts.codes.m_after_motion.contains(&code);
        let lines = if within(extended) && !self.setting.fitting.options.m_three_digits { 2 } else { digits };
        let sent = if code >= 10u32.saturating_pow(u32::from(lines))
            && self.setting.fitting.policies.m_over_99 == MOver99::DropHundreds
        {
            code % 100
        } else {
            code
        };
        if let Some(spindle) = Spindle::sent_by(sent, &self.setting.control.cycle_codes) {
            self.next.spindle_stopped = !spindle.turns();
            if spindle.turns() {
                self.next.spindle_direction = Some(spindle);
            }
        }
        self.push_code(CodeLine::M, sent, lines, after, Some(word))
    }

    fn send(&mut self, line: CodeLine, letter: u8, code: u32, digits: u8, after: bool) -> Result<(), Alarm> {
        match self.words.word(letter) {
            Some(word) => self.push_code(line, code, digits, after, Some(word)),
            None => Ok(()),
        }
    }

    fn push_code(
        &mut self,
        line: CodeLine,
        code: u32,
        digits: u8,
        after: bool,
        word: Option<&syntax::Word>,
    ) -> Result<(), Alarm> {
        let alarm = |condition| match word {
            Some(word) => self.words.alarm_at(condition, word),
            None => self.words.alarm(condition, b'S'),
        };
        if code >= 10u32.saturating_pow(u32::from(digits)) {
            let values = [f64::from(code), f64::from(digits), 0.0];
            return Err(alarm(Condition::CodeTooLargeForLines).with(values));
        }
        let count = usize::from(self.command.code_count);
        if count >= MOST_CODES {
            return Err(alarm(Condition::MSeveral));
        }
        self.command.codes[count] = CodeOut { line, code, digits, after_motion: after };
        self.command.code_count += 1;
        Ok(())
    }
}
