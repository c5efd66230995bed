//! A block of the selected program as an operator names it: by its line or its sequence number.

use std::fmt;

/// By what a block is known.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum At {
    /// The line on which it stands; of several blocks on a line the first.
    Line(u64),
    /// Its N.
    Sequence(u32),
}

/// A block.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct BlockTarget {
    /// The program in which it stands; without one it is the selected program.
    pub program: Option<String>,
    /// Where it stands there.
    pub at: At,
    /// Which execution of it, from 1, where it is executed several times.
    pub pass: Option<u32>,
}

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            At::Line(line) => write!(f, "line {line}"),
            At::Sequence(number) => write!(f, "N{number}"),
        }
    }
}

impl fmt::Display for BlockTarget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(program) = &self.program {
            write!(f, "{program} ")?;
        }
        write!(f, "{}", self.at)?;
        self.pass.map_or(Ok(()), |pass| write!(f, " pass {pass}"))
    }
}

/// Reads `[O1234] line 12 [pass 3]` or `[O1234] N50 [pass 3]`.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn read_block_target(words: &[&str]) -> Result<BlockTarget, String> {
    let whole = |text: &str, what: &str| match text.parse::<u32>() {
        Ok(number @ 1..) => Ok(number),
        _ => Err(format!("`{text}` is no {what}")),
    };
    let (words, pass) = match words {
        [before @ .., "pass", pass] => (before, Some(whole(pass, "pass")?)),
        _ => (words, None),
    };
    let (program, at) = match words {
        ["line", line] => (None, At::Line(whole(line, "line number")?.into())),
        [program, "line", line] => (Some(*program), At::Line(whole(line, "line number")?.into())),
        [number] => (None, sequence(number)?),
        [program, number] => (Some(*program), sequence(number)?),
        _ => return Err("a block is named by its line or its sequence number: line 12, N50, O1234 N50".to_owned()),
    };
    Ok(BlockTarget { program: program.map(str::to_owned), at, pass })
}

/// `N50`.
pub(crate) fn sequence(text: &str) -> Result<At, String> {
    let digits = text.strip_prefix('N').filter(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
    match digits.and_then(|digits| digits.parse().ok()) {
        Some(number @ 1..) => Ok(At::Sequence(number)),
        _ => Err(format!("`{text}` is no sequence number")),
    }
}
