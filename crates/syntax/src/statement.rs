//! Macro statements and expressions, recognised by their shape only.

use crate::block::StatementKind;
use crate::number::is_blank;

/// The statement that begins at the head of `text`, if one does; blanks inside the word have no meaning.
pub(crate) fn statement_at(text: &[u8], fold: bool) -> Option<StatementKind> {
    let mut letters =
        text.iter().copied().filter(|&b| !is_blank(b)).map(|b| if fold { b.to_ascii_uppercase() } else { b });
    let mut word = [0u8; 5];
    for slot in &mut word {
        *slot = letters.next().unwrap_or(0);
    }
    match &word {
        [b'#', ..] => Some(StatementKind::Assignment),
        [b'I', b'F', ..] => Some(StatementKind::If),
        b"WHILE" => Some(StatementKind::While),
        [b'D', b'O', ..] => Some(StatementKind::Do),
        [b'E', b'N', b'D', ..] => Some(StatementKind::End),
        [b'G', b'O', b'T', b'O', ..] => Some(StatementKind::Goto),
        _ => None,
    }
}

/// Characters of the expression at the head of `text` (`#1`, `-#[#2+1]`, `[#1*2]`), 0 if there is none.
///
/// `None` if the characters ran out before it closed and are not the `last` ones; `Err` at the character where it cannot go on.
pub(crate) fn expression_len(text: &[u8], last: bool) -> Option<Result<usize, usize>> {
    let mut i = 0;
    let skip_blanks = |i: &mut usize| {
        while text.get(*i).is_some_and(|&b| is_blank(b)) {
            *i += 1;
        }
    };
    skip_blanks(&mut i);
    if matches!(text.get(i), Some(b'-' | b'+')) {
        i += 1;
        skip_blanks(&mut i);
    }
    if !matches!(text.get(i), Some(b'#' | b'[')) {
        return if i < text.len() { Some(Ok(0)) } else { None };
    }
    while text.get(i) == Some(&b'#') {
        i += 1;
        skip_blanks(&mut i);
    }
    match text.get(i)? {
        b'[' => {
            let mut depth = 0;
            loop {
                match text.get(i)? {
                    b'[' => depth += 1,
                    b']' => depth -= 1,
                    b'\n' => return Some(Err(i)),
                    _ => {}
                }
                i += 1;
                if depth == 0 {
                    return Some(Ok(i));
                }
            }
        }
        b'0'..=b'9' => {
            let mut end = i;
            while let Some(&byte) = text.get(i) {
                match byte {
                    b'0'..=b'9' => end = i + 1,
                    _ if is_blank(byte) => {}
                    _ => return Some(Ok(end)),
                }
                i += 1;
            }
            last.then_some(Ok(end))
        }
        _ => Some(Err(i)),
    }
}
