//! Statements, compiled: assignments, jumps, loops.

use base::Condition;
use syntax::{Extent, StatementKind};

use super::code::Run;
use super::expression::{Compiler, Reference};
use super::scanner::Scanner;
use super::trouble::Trouble;

/// A compiled statement.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Statement {
    /// `#i = …`, `IF [ … ] THEN #i = …`
    Assign { condition: Option<Run>, target: Reference, place: Extent, value: Run },
    /// `GOTO n`, `IF [ … ] GOTO n`
    Goto { condition: Option<Run>, to: Destination, place: Extent },
    /// `WHILE [ … ] DO m`, `DO m`
    Loop { condition: Option<Run>, number: u8 },
    /// `END m`
    End { number: u8 },
}

/// Where a GOTO leads.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Destination {
    Number(u32),
    Computed(Run),
}

/// Compiles a statement; `text` is its block's, `extent` the statement's within it.
pub(crate) fn compile(
    compiler: &mut Compiler,
    kind: StatementKind,
    text: &[u8],
    extent: Extent,
) -> Result<Statement, Trouble> {
    let mut scanner = Scanner::new(text, extent);
    let statement = match kind {
        StatementKind::Assignment => assignment(compiler, &mut scanner, None)?,
        StatementKind::Goto => goto(compiler, &mut scanner, None)?,
        StatementKind::If => {
            scanner.take_word("IF");
            let condition = compiler.condition(&mut scanner)?;
            let at = scanner.here();
            match (scanner.take_word("THEN"), compiler.control.user_macro.then) {
                (true, true) => assignment(compiler, &mut scanner, Some(condition))?,
                (true, false) => return Err(Trouble::at(Condition::MacroThen, scanner.since(at))),
                (false, _) => goto(compiler, &mut scanner, Some(condition))?,
            }
        }
        StatementKind::While => {
            scanner.take_word("WHILE");
            let condition = compiler.condition(&mut scanner)?;
            let number = loop_number(compiler, &mut scanner, "DO")?;
            Statement::Loop { condition: Some(condition), number }
        }
        StatementKind::Do => Statement::Loop { condition: None, number: loop_number(compiler, &mut scanner, "DO")? },
        StatementKind::End => Statement::End { number: loop_number(compiler, &mut scanner, "END")? },
    };
    if scanner.peek().is_some() { Err(scanner.unreadable()) } else { Ok(statement) }
}

fn assignment(compiler: &mut Compiler, scanner: &mut Scanner, condition: Option<Run>) -> Result<Statement, Trouble> {
    let from = scanner.here();
    let target = compiler.variable(scanner)?;
    let place = scanner.since(from);
    if !scanner.take(b'=') {
        return Err(scanner.unreadable());
    }
    Ok(Statement::Assign { condition, target, place, value: compiler.expression(scanner)? })
}

fn goto(compiler: &mut Compiler, scanner: &mut Scanner, condition: Option<Run>) -> Result<Statement, Trouble> {
    let from = scanner.here();
    if !scanner.take_word("GOTO") {
        return Err(scanner.unreadable());
    }
    let to = match scanner.peek() {
        Some(b'0'..=b'9') => match scanner.whole() {
            Some(number) => Destination::Number(number),
            None => return Err(scanner.unreadable()),
        },
        _ => Destination::Computed(compiler.expression(scanner)?),
    };
    Ok(Statement::Goto { condition, to, place: scanner.since(from) })
}

/// The number of a loop; a scan for a loop's end reads no more than this.
pub(crate) fn loop_number(compiler: &Compiler, scanner: &mut Scanner, word: &str) -> Result<u8, Trouble> {
    if !scanner.take_word(word) {
        return Err(scanner.unreadable());
    }
    let from = scanner.here();
    let Some(number) = scanner.whole() else { return Err(scanner.unreadable()) };
    let loops = compiler.control.user_macro.loops;
    match u8::try_from(number) {
        Ok(number) if number > 0 && usize::from(number) <= loops => Ok(number),
        _ => {
            let values = [f64::from(number), loops as f64, 0.0];
            Err(Trouble::Refused(Condition::MacroLoopNumber, scanner.since(from), values))
        }
    }
}

/// What a statement is to a scan that looks for a loop's end: `Some((true, n))` opens loop n, `(false, n)` ends it.
pub(crate) fn loop_mark(text: &[u8], kind: StatementKind, extent: Extent) -> Option<(bool, u32)> {
    let mut scanner = Scanner::new(text, extent);
    match kind {
        StatementKind::Do => scanner.take_word("DO").then(|| scanner.whole()).flatten().map(|n| (true, n)),
        StatementKind::End => scanner.take_word("END").then(|| scanner.whole()).flatten().map(|n| (false, n)),
        StatementKind::While => {
            // The condition is not compiled here: DO follows its closing bracket.
            let end = scanner.end;
            let close = text.get(scanner.at..end)?.iter().rposition(|&b| b == b']')?;
            scanner.at += close + 1;
            scanner.take_word("DO").then(|| scanner.whole()).flatten().map(|n| (true, n))
        }
        _ => None,
    }
}
