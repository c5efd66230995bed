//! What may be typed in MDI mode.

use dialect::{Control, MMeaning, MdiCalls, Meaning, Policies};
use syntax::{Block, Cursor, Outcome, Value, Word, read_block};
use tape::{Reader, Text};

/// Refuses calls and macros, unless the policy `mdi-calls` allows them.
pub(super) fn check(control: &Control, policies: &Policies, blocks: &str) -> Result<(), String> {
    if policies.mdi_calls == MdiCalls::Allow {
        return Ok(());
    }
    let mut characters = blocks.as_bytes().to_vec();
    let settled = Text.translate(&mut characters, 0, true);
    let (mut block, mut cursor) = (Block::default(), Cursor::HEAD);
    loop {
        let window = usize::try_from(cursor.offset).ok().and_then(|from| characters.get(from..settled));
        match read_block(window.unwrap_or_default(), true, cursor, &control.grammar, &mut block) {
            Outcome::Block => {}
            Outcome::End | Outcome::More => return Ok(()),
        }
        if block.statement.is_some() || block.words.iter().any(|word| word.value == Value::Expression) {
            return Err("macro statements and variables are not taken in MDI (policy mdi-calls)".to_owned());
        }
        if let Some(code) = block.words.iter().find_map(|word| call(control, word)) {
            return Err(format!("{code} is not taken in MDI (policy mdi-calls)"));
        }
        cursor = block.next;
    }
}

/// The code's name, if it calls another program or returns from one.
fn call(control: &Control, word: &Word) -> Option<String> {
    let Value::Number(number) = word.value else { return None };
    let code = number.integer()?;
    match word.letter {
        b'M' => {
            let meaning = control.m_code(u32::try_from(code).ok()?)?.meaning;
            matches!(meaning, MMeaning::SubprogramCall | MMeaning::InternalCall | MMeaning::SubprogramEnd)
                .then(|| format!("M{code:02}"))
        }
        b'G' => {
            let row = control.g_row(code)?;
            let meaning = control.g_codes.get(usize::from(row))?.meaning;
            matches!(meaning, Meaning::MacroCall | Meaning::ModalMacroCall).then(|| control.g_name(row))
        }
        _ => None,
    }
}
