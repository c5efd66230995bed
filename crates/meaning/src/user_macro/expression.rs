//! Expressions: compiled from their text, carried out on a small stack.
//!
//! `+ - OR XOR` bind weakest, then `* / AND`, then functions and brackets. A blank counts as zero in arithmetic; EQ and
//! NE tell it from zero.

use base::Condition;
use dialect::{Control, Function, VariableMeaning};
use syntax::Extent;

use super::code::{Code, Comparison, Op, Run, STACK};
use super::scanner::Scanner;
use super::trouble::Trouble;
use super::variables::Variables;

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
