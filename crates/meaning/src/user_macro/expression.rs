//! Expressions: compiled from their text, carried out on a small stack.
//!
//! `+ - OR XOR` bind weakest, then `* / AND`, then functions and brackets. A blank counts as zero in arithmetic; EQ and
//! NE tell it from zero.

use base::Condition;
use dialect::{Control, Function, VariableMeaning};
use syntax::Extent;

use super::code::{Code, Comparison, Op, Run, STACK};
use super::system::Source;
use super::trouble::Trouble;
use super::variables::Variables;

/// The text of a block, read character by character; blanks have no meaning.
pub(crate) struct Scanner<'t> {
    pub text: &'t [u8],
    pub at: usize,
    pub end: usize,
    /// Where the statement or word begins.
    begin: usize,
}

impl<'t> Scanner<'t> {
    pub fn new(text: &'t [u8], extent: Extent) -> Scanner<'t> {
        let end = (usize::from(extent.at) + usize::from(extent.len)).min(text.len());
        let begin = usize::from(extent.at);
        Scanner { text, at: begin, end, begin }
    }

    fn skip(&mut self) {
        while self.at < self.end && matches!(self.text[self.at], b' ' | b'\t' | 0) {
            self.at += 1;
        }
    }

    /// Where the next character stands.
    pub fn here(&mut self) -> usize {
        self.skip();
        self.at
    }

    pub fn peek(&mut self) -> Option<u8> {
        self.skip();
        self.text.get(self.at).filter(|_| self.at < self.end).map(u8::to_ascii_uppercase)
    }

    pub fn take(&mut self, character: u8) -> bool {
        let there = self.peek() == Some(character);
        self.at += usize::from(there);
        there
    }

    /// Takes a word of letters if it stands here.
    pub fn take_word(&mut self, word: &str) -> bool {
        let from = self.at;
        let there = word.bytes().all(|letter| self.take(letter));
        if !there {
            self.at = from;
        }
        there
    }

    /// From a character on up to here.
    pub fn since(&self, from: usize) -> Extent {
        let len = self.at.saturating_sub(from).max(1);
        Extent { at: from.min(usize::from(u16::MAX)) as u16, len: len.min(usize::from(u16::MAX)) as u16 }
    }

    /// The rest, as what cannot be read.
    pub fn unreadable(&mut self) -> Trouble {
        self.skip();
        // What breaks off is shown as a whole.
        let from = if self.at < self.end { self.at } else { self.begin.min(self.end.saturating_sub(1)) };
        let len = self.end.saturating_sub(from).max(1);
        Trouble::at(Condition::MacroStatement, Extent { at: from as u16, len: len.min(usize::from(u16::MAX)) as u16 })
    }

    /// A whole number without sign or point.
    pub fn whole(&mut self) -> Option<u32> {
        let mut value = None;
        while let Some(digit @ b'0'..=b'9') = self.peek() {
            self.at += 1;
            value = Some(value.unwrap_or(0u32).saturating_mul(10).saturating_add(u32::from(digit - b'0')));
        }
        value
    }

    fn number(&mut self) -> Option<f64> {
        let (mut mantissa, mut decimals, mut any, mut point) = (0u64, 0i32, false, false);
        loop {
            match self.peek() {
                Some(digit @ b'0'..=b'9') => {
                    any = true;
                    if mantissa < 100_000_000_000_000_000 {
                        mantissa = mantissa * 10 + u64::from(digit - b'0');
                        decimals += i32::from(point);
                    } else if !point {
                        decimals -= 1;
                    }
                }
                Some(b'.') if !point => point = true,
                _ => break,
            }
            self.at += 1;
        }
        let power = |n: i32| libm::pow(10.0, f64::from(n));
        any.then(|| if decimals >= 0 { mantissa as f64 / power(decimals) } else { mantissa as f64 * power(-decimals) })
    }
}

/// Compiles expressions into a [`Code`].
pub(crate) struct Compiler<'c> {
    pub control: &'c Control,
    pub variables: &'c Variables,
    pub code: &'c mut Code,
    brackets: usize,
    pending: usize,
}

impl<'c> Compiler<'c> {
    pub fn new(control: &'c Control, variables: &'c Variables, code: &'c mut Code) -> Compiler<'c> {
        Compiler { control, variables, code, brackets: 0, pending: 0 }
    }

    /// Compiles the expression at the scanner, which goes on behind it.
    pub fn expression(&mut self, scanner: &mut Scanner) -> Result<Run, Trouble> {
        let from = self.code.len() as u32;
        self.pending = 0;
        self.sum(scanner)?;
        Ok(Run { from, to: self.code.len() as u32 })
    }

    /// Compiles `[a EQ b]`.
    pub fn condition(&mut self, scanner: &mut Scanner) -> Result<Run, Trouble> {
        let from = self.code.len() as u32;
        self.pending = 0;
        self.open(scanner)?;
        self.sum(scanner)?;
        let at = scanner.here();
        let Some(comparison) = comparison(scanner) else { return Err(scanner.unreadable()) };
        let place = scanner.since(at);
        self.sum(scanner)?;
        self.close(scanner)?;
        self.push(Op::Compare(comparison), place)?;
        Ok(Run { from, to: self.code.len() as u32 })
    }

    /// Compiles the variable behind `#`: its number, or the run that gives it.
    pub fn variable(&mut self, scanner: &mut Scanner) -> Result<Reference, Trouble> {
        let from = scanner.here();
        if scanner.take(b'#') && scanner.peek() == Some(b'[') {
            let start = self.code.len() as u32;
            self.bracketed(scanner)?;
            return Ok(Reference::Computed(Run { from: start, to: self.code.len() as u32 }));
        }
        let Some(number) = scanner.whole() else { return Err(scanner.unreadable()) };
        match self.control.user_macro.variable(number).map(|row| row.meaning) {
            Some(VariableMeaning::Local) => Ok(Reference::Local(number.min(255) as u8)),
            Some(VariableMeaning::CommonVolatile) => Ok(Reference::Volatile(self.variables.index(0, number))),
            Some(VariableMeaning::CommonPermanent) => Ok(Reference::Permanent(self.variables.index(1, number))),
            Some(_) => Ok(Reference::System(number)),
            None => Err(unknown(number, scanner.since(from))),
        }
    }

    fn push(&mut self, op: Op, place: Extent) -> Result<(), Trouble> {
        match op {
            Op::Number(_) | Op::Local(_) | Op::Volatile(_) | Op::Permanent(_) | Op::System(_) => self.pending += 1,
            Op::Indirect | Op::Negate => {}
            Op::Function(Function::ArcTangent) => self.pending -= 1,
            Op::Function(_) => {}
            _ => self.pending -= 1,
        }
        if self.pending > STACK {
            return Err(Trouble::at(Condition::MacroBrackets, place));
        }
        self.code.push(op, place);
        Ok(())
    }

    fn sum(&mut self, scanner: &mut Scanner) -> Result<(), Trouble> {
        let start = scanner.here();
        let minus = scanner.take(b'-');
        if !minus {
            scanner.take(b'+');
        }
        self.product(scanner)?;
        if minus {
            self.push(Op::Negate, scanner.since(start))?;
        }
        loop {
            let from = scanner.here();
            let op = match scanner.peek() {
                Some(b'+') => Op::Add,
                Some(b'-') => Op::Subtract,
                Some(b'O') if scanner.take_word("OR") => Op::Or,
                Some(b'X') if scanner.take_word("XOR") => Op::Xor,
                _ => return Ok(()),
            };
            scanner.at += usize::from(matches!(op, Op::Add | Op::Subtract));
            self.product(scanner)?;
            self.push(op, scanner.since(from))?;
        }
    }

    fn product(&mut self, scanner: &mut Scanner) -> Result<(), Trouble> {
        self.primary(scanner)?;
        loop {
            let from = scanner.here();
            let op = match scanner.peek() {
                Some(b'*') => Op::Multiply,
                Some(b'/') => Op::Divide,
                Some(b'A') if scanner.take_word("AND") => Op::And,
                _ => return Ok(()),
            };
            scanner.at += usize::from(op != Op::And);
            self.primary(scanner)?;
            self.push(op, scanner.since(from))?;
        }
    }

    fn primary(&mut self, scanner: &mut Scanner) -> Result<(), Trouble> {
        match scanner.peek() {
            Some(b'[') => self.bracketed(scanner),
            Some(b'#') => {
                let from = scanner.here();
                let reference = self.variable(scanner)?;
                let place = scanner.since(from);
                match reference {
                    Reference::Local(index) => self.push(Op::Local(index), place),
                    Reference::Volatile(index) => self.push(Op::Volatile(index), place),
                    Reference::Permanent(index) => self.push(Op::Permanent(index), place),
                    Reference::System(number) => self.read(number, place),
                    Reference::Computed(_) => self.push(Op::Indirect, place),
                }
            }
            Some(b'0'..=b'9' | b'.') => {
                let from = scanner.here();
                match scanner.number() {
                    Some(number) => self.push(Op::Number(number), scanner.since(from)),
                    None => Err(scanner.unreadable()),
                }
            }
            Some(b'A'..=b'Z') => self.function(scanner),
            _ => Err(scanner.unreadable()),
        }
    }

    fn read(&mut self, number: u32, place: Extent) -> Result<(), Trouble> {
        let Some(row) = self.control.user_macro.variable(number) else { return Err(unknown(number, place)) };
        if !row.read {
            return Err(Trouble::Refused(Condition::MacroWriteOnly, place, [f64::from(number), 0.0, 0.0]));
        }
        self.push(Op::System(number), place)
    }

    fn function(&mut self, scanner: &mut Scanner) -> Result<(), Trouble> {
        let from = scanner.here();
        let named = self.control.user_macro.functions.iter().find(|row| {
            let name = scanner.take_word(&row.name);
            if name && scanner.peek() != Some(b'[') {
                scanner.at = from;
            }
            name && scanner.at != from
        });
        let Some(meaning) = named.map(|row| row.meaning) else {
            while scanner.peek().is_some_and(|c| c.is_ascii_uppercase()) {
                scanner.at += 1;
            }
            return Err(Trouble::at(Condition::MacroFunction, scanner.since(from)));
        };
        self.bracketed(scanner)?;
        if meaning == Function::ArcTangent {
            if !scanner.take(b'/') {
                return Err(Trouble::at(Condition::MacroFunction, scanner.since(from)));
            }
            self.bracketed(scanner)?;
        }
        self.push(Op::Function(meaning), scanner.since(from))
    }

    fn bracketed(&mut self, scanner: &mut Scanner) -> Result<(), Trouble> {
        self.open(scanner)?;
        self.sum(scanner)?;
        self.close(scanner)
    }

    fn open(&mut self, scanner: &mut Scanner) -> Result<(), Trouble> {
        let from = scanner.here();
        if !scanner.take(b'[') {
            return Err(scanner.unreadable());
        }
        self.brackets += 1;
        if self.brackets > self.control.user_macro.brackets {
            let limit = self.control.user_macro.brackets as f64;
            return Err(Trouble::Refused(Condition::MacroBrackets, scanner.since(from), [limit, 0.0, 0.0]));
        }
        Ok(())
    }

    fn close(&mut self, scanner: &mut Scanner) -> Result<(), Trouble> {
        self.brackets -= 1;
        if scanner.take(b']') { Ok(()) } else { Err(scanner.unreadable()) }
    }
}

fn comparison(scanner: &mut Scanner) -> Option<Comparison> {
    [
        ("EQ", Comparison::Equal),
        ("NE", Comparison::NotEqual),
        ("GT", Comparison::Greater),
        ("LT", Comparison::Less),
        ("GE", Comparison::GreaterOrEqual),
        ("LE", Comparison::LessOrEqual),
    ]
    .into_iter()
    .find(|(word, _)| scanner.take_word(word))
    .map(|(_, comparison)| comparison)
}

/// Which variable is meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Reference {
    /// A local one.
    Local(u8),
    /// A common one, by its index.
    Volatile(u16),
    /// A common one, by its index.
    Permanent(u16),
    /// The system variable of this number, which the control has.
    System(u32),
    /// The one whose number this run gives.
    Computed(Run),
}

/// There is no variable of this number.
pub(crate) fn unknown(number: u32, place: Extent) -> Trouble {
    Trouble::Refused(Condition::MacroVariableUnknown, place, [f64::from(number), 0.0, 0.0])
}

/// A value as the number of a variable.
pub(crate) fn variable_number(value: f64, place: Extent) -> Result<u32, Trouble> {
    let number = (if value.is_nan() { 0.0 } else { value }).round();
    if (0.0..=999_999.0).contains(&number) {
        Ok(number as u32)
    } else {
        Err(Trouble::Refused(Condition::MacroVariableUnknown, place, [number, 0.0, 0.0]))
    }
}

/// Carries out a run. A lone variable may give a blank, everything else gives a number.
pub(crate) fn evaluate(code: &Code, run: Run, source: &Source) -> Result<f64, Trouble> {
    let mut stack = [0.0f64; STACK];
    let mut top = 0usize;
    let ops = code.ops(run);
    for (index, op) in ops.iter().enumerate() {
        let value = match *op {
            Op::Number(value) => value,
            Op::Local(index) => source.variables().local(source.level, index),
            Op::Volatile(index) => source.variables().volatile(index),
            Op::Permanent(index) => source.variables().permanent(index),
            Op::System(number) => source.read(number, code.place(run, index))?,
            _ => {
                let below = top.saturating_sub(1);
                let last = stack[below % STACK];
                let (value, taken) = match *op {
                    Op::Indirect => {
                        let place = code.place(run, index);
                        (source.read(variable_number(last, place)?, place)?, 1)
                    }
                    Op::Negate => (-filled(last), 1),
                    Op::Function(Function::ArcTangent) => (0.0, 2),
                    Op::Function(function) => (apply(function, filled(last)), 1),
                    _ => (0.0, 2),
                };
                if taken == 1 {
                    top = below;
                    finite(value, op, last, code, run, index)?
                } else {
                    let first = stack[top.saturating_sub(2) % STACK];
                    top = top.saturating_sub(2);
                    let value = match *op {
                        Op::Compare(comparison) => f64::from(u8::from(compare(comparison, first, last))),
                        _ => combine(*op, filled(first), filled(last)),
                    };
                    finite(value, op, last, code, run, index)?
                }
            }
        };
        if let Some(slot) = stack.get_mut(top) {
            *slot = value;
        }
        top += 1;
    }
    Ok(stack[0])
}

/// A blank as the zero that it is in arithmetic.
#[inline]
fn filled(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value }
}

/// Refuses a result that is no number; a blank read through another variable is one.
fn finite(value: f64, op: &Op, last: f64, code: &Code, run: Run, index: usize) -> Result<f64, Trouble> {
    if value.is_finite() || matches!(op, Op::Indirect) {
        return Ok(value);
    }
    let condition = match op {
        Op::Divide => Condition::MacroDivisionByZero,
        Op::Function(Function::Exponential | Function::Tangent) => Condition::MacroOverflow,
        Op::Function(_) | Op::And | Op::Or | Op::Xor => Condition::MacroArgumentRange,
        _ => Condition::MacroOverflow,
    };
    let condition = if condition == Condition::MacroDivisionByZero && filled(last) != 0.0 {
        Condition::MacroOverflow
    } else {
        condition
    };
    Err(Trouble::Refused(condition, code.place(run, index), [filled(last), 0.0, 0.0]))
}

fn compare(comparison: Comparison, a: f64, b: f64) -> bool {
    let blank = (a.is_nan(), b.is_nan());
    match comparison {
        Comparison::Equal => blank == (true, true) || (blank == (false, false) && a == b),
        Comparison::NotEqual => !compare(Comparison::Equal, a, b),
        Comparison::Greater => filled(a) > filled(b),
        Comparison::Less => filled(a) < filled(b),
        Comparison::GreaterOrEqual => filled(a) >= filled(b),
        Comparison::LessOrEqual => filled(a) <= filled(b),
    }
}

fn combine(op: Op, a: f64, b: f64) -> f64 {
    match op {
        Op::Add => a + b,
        Op::Subtract => a - b,
        Op::Multiply => a * b,
        Op::Divide => a / b,
        Op::And => bits(a, b, |a, b| a & b),
        Op::Or => bits(a, b, |a, b| a | b),
        Op::Xor => bits(a, b, |a, b| a ^ b),
        _ => arc_tangent(a, b),
    }
}

/// A logical operation on 32-bit integers; NaN where an operand is none.
fn bits(a: f64, b: f64, op: impl Fn(i32, i32) -> i32) -> f64 {
    let integer = |value: f64| {
        let rounded = value.round();
        (rounded >= f64::from(i32::MIN) && rounded <= f64::from(u32::MAX)).then_some(rounded as i64 as i32)
    };
    match (integer(a), integer(b)) {
        (Some(a), Some(b)) => f64::from(op(a, b)),
        _ => f64::NAN,
    }
}

/// The angle from 0 to 360° whose tangent is `a / b`.
fn arc_tangent(a: f64, b: f64) -> f64 {
    if a == 0.0 && b == 0.0 {
        return f64::NAN;
    }
    let degrees = libm::atan2(a, b).to_degrees();
    if degrees < 0.0 { degrees + 360.0 } else { degrees }
}

fn apply(function: Function, x: f64) -> f64 {
    match function {
        Function::Sine => sine(x),
        Function::Cosine => sine(x + 90.0),
        Function::Tangent => {
            let cosine = sine(x + 90.0);
            if cosine == 0.0 { f64::INFINITY } else { sine(x) / cosine }
        }
        Function::ArcTangent => libm::atan(x).to_degrees(),
        Function::ArcSine => libm::asin(x).to_degrees(),
        Function::ArcCosine => libm::acos(x).to_degrees(),
        Function::SquareRoot => x.sqrt(),
        Function::Absolute => x.abs(),
        Function::FromBcd => digits(x, 16, 10),
        Function::ToBcd => digits(x, 10, 16),
        Function::Round => x.round(),
        Function::Fix => x.trunc(),
        Function::Fup => {
            if x < 0.0 {
                x.floor()
            } else {
                x.ceil()
            }
        }
        Function::Logarithm => libm::log(x),
        Function::Exponential => libm::exp(x),
    }
}

/// The sine of an angle in degrees, exact at every multiple of 30° that has an exact one.
fn sine(degrees: f64) -> f64 {
    let turn = libm::fmod(degrees, 360.0);
    let (sign, angle) = if turn < 0.0 { (-1.0, -turn) } else { (1.0, turn) };
    let (sign, angle) = if angle >= 180.0 { (-sign, angle - 180.0) } else { (sign, angle) };
    let angle = if angle > 90.0 { 180.0 - angle } else { angle };
    let value = if angle == 30.0 {
        0.5
    } else if angle > 45.0 {
        libm::cos((90.0 - angle).to_radians())
    } else {
        libm::sin(angle.to_radians())
    };
    sign * value
}

/// The digits of a whole number in one base read in another; NaN where a digit is none.
fn digits(x: f64, from: u32, to: u32) -> f64 {
    let rounded = x.round();
    if !(0.0..=99_999_999.0).contains(&rounded) && from == 10 || !(0.0..=f64::from(u32::MAX)).contains(&rounded) {
        return f64::NAN;
    }
    let (mut rest, mut value, mut place) = (rounded as u64, 0u64, 1u64);
    while rest > 0 {
        let digit = rest % u64::from(from);
        if digit >= u64::from(to.min(10)) {
            return f64::NAN;
        }
        value += digit * place;
        place *= u64::from(to);
        rest /= u64::from(from);
    }
    value as f64
}
