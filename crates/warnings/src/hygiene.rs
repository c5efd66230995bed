//! What stands in the text and no run shows: `unreachable`, `unused-subprogram`, `allow-unknown`, and the size of the
//! whole.
//!
//! A run says where the program ends; if something stands behind that end the text is read once more, twice in all: for
//! the targets of its jumps and calls, then for the rules. A long text with nothing behind its end is not read again.

use std::collections::BTreeSet;

use base::Place;
use dialect::{Control, MMeaning, Meaning};
use meaning::Command;
use station::{Library, LibraryError, Session};
use syntax::{Block, Cursor, StatementKind, Value, goto_number};
use tape::Codes;

use crate::blocks::Blocks;
use crate::finding::Finding;
use crate::rule::unreachable::Unreachable;
use crate::rule::unused_subprogram::{UnusedSection, UnusedSubprogram};
use crate::rule::{allow_unknown, memory_size};

/// Jumps and calls that are kept; a text with more is not judged.
const MOST_TARGETS: usize = 65_536;
/// Findings of one text.
const MOST_FOUND: usize = 1000;
/// Texts up to this many characters are read once more in any case.
const SHORT: u64 = 256 * 1024;

/// Where jumps and calls of a text lead.
#[derive(Default)]
pub(crate) struct Targets {
    pub blocks: BTreeSet<i64>,
    pub programs: BTreeSet<i64>,
    /// A number is computed: every block with an N, every program, may be meant.
    pub any_block: bool,
    pub any_program: bool,
}

/// What the rules want to know of a block.
pub(crate) struct Facts {
    /// Its N.
    pub sequence: Option<i64>,
    /// It ends a main program.
    pub ends: bool,
    /// It ends a subprogram.
    pub returns: bool,
    /// The next block does not follow.
    pub leaves: bool,
    /// A block-delete sign may take the end out.
    pub can_be_passed: bool,
}

/// What the text of the program that has run shows. `characters` is the text's length.
///
/// # Errors
/// The text cannot be read.
pub fn look_at_text<L: Library>(session: &mut Session<L>, characters: u64) -> Result<Vec<Finding>, LibraryError> {
    let control = session.configuration().control.clone();
    let last = *session.interpreter().done()[0];
    let Some((program, source)) = session.interpreter().main_program() else { return Ok(Vec::new()) };
    let head = Place { program, source, line: 1, ..Place::default() };
    let mut found = Vec::new();
    found.extend(memory_size::finding(&control, session.interpreter().fitting(), characters, head));
    if last.place.source == source {
        let codes = session.interpreter().fitting().tape_codes(&control);
        found.extend(hygiene(&control, codes, &last, session.library_mut())?);
    }
    Ok(found)
}

fn hygiene<L: Library>(
    control: &Control,
    codes: Option<Codes>,
    last: &Command,
    library: &mut L,
) -> Result<Vec<Finding>, LibraryError> {
    let place = &last.place;
    if place.block.end() > SHORT {
        let Place { line, line_start, .. } = *place;
        let behind = Cursor { offset: place.block.end(), line, line_start, skipping: false };
        let mut blocks = Blocks::new(library, place.source, &control.grammar, codes);
        blocks.go_to(behind)?;
        loop {
            if !blocks.next()? || blocks.block.rewind {
                return Ok(Vec::new());
            }
            if !blocks.block.is_empty() {
                break;
            }
        }
    }
    let mut blocks = Blocks::new(library, place.source, &control.grammar, codes);
    let targets = targets(control, &mut blocks)?;
    judge(control, place, &mut Blocks::new(library, place.source, &control.grammar, codes), &targets)
}

fn targets<L: Library>(control: &Control, blocks: &mut Blocks<L>) -> Result<Targets, LibraryError> {
    let mut targets = Targets::default();
    while blocks.next()? {
        let block = &blocks.block;
        if block.words.iter().any(|word| word.letter == b'P' || word.letter == b'Q') {
            take_words(control, block, &mut targets);
        }
        if let Some(statement) = block.statement {
            take_jump(blocks.text(statement.extent), &mut targets);
        }
        if targets.blocks.len() + targets.programs.len() > MOST_TARGETS {
            (targets.any_block, targets.any_program) = (true, true);
            break;
        }
    }
    Ok(targets)
}

/// What the words of a block call and jump to.
fn take_words(control: &Control, block: &Block, targets: &mut Targets) {
    let calls_macro = |code: i64| {
        let row = control.g_row(code).and_then(|row| control.g_codes.get(usize::from(row)));
        row.is_some_and(|row| matches!(row.meaning, Meaning::MacroCall | Meaning::ModalMacroCall))
    };
    let (mut calls, mut jumps) = (false, false);
    for word in &block.words {
        let Value::Number(number) = word.value else { continue };
        let Some(code) = number.integer() else { continue };
        let meaning = u32::try_from(code).ok().and_then(|code| control.m_code(code)).map(|row| row.meaning);
        match (word.letter, meaning) {
            (b'M', Some(MMeaning::SubprogramCall)) => calls = true,
            (b'M', Some(MMeaning::SubprogramEnd | MMeaning::InternalCall | MMeaning::InterruptOn)) => jumps = true,
            (b'G', _) => calls |= calls_macro(code),
            _ => {}
        }
    }
    for word in block.words.iter().filter(|word| matches!(word.letter, b'P' | b'Q')) {
        let number = match word.value {
            Value::Number(number) => number.integer(),
            _ => None,
        };
        // P of a call names a program; its Q, and P of a jump, a block.
        let (list, any) = match (word.letter, calls) {
            (b'P', true) => (&mut targets.programs, &mut targets.any_program),
            _ if calls || jumps => (&mut targets.blocks, &mut targets.any_block),
            _ => continue,
        };
        match number {
            Some(number) => drop(list.insert(number)),
            None => *any = true,
        }
    }
}

/// Where a macro statement jumps to.
fn take_jump(text: &[u8], targets: &mut Targets) {
    let Some(place) = goto_number(text) else { return };
    match place.and_then(|place| std::str::from_utf8(text.get(place)?).ok()?.parse().ok()) {
        Some(number) => drop(targets.blocks.insert(number)),
        None => targets.any_block = true,
    }
}

fn judge<L: Library>(
    control: &Control,
    last: &Place,
    blocks: &mut Blocks<L>,
    targets: &Targets,
) -> Result<Vec<Finding>, LibraryError> {
    let mut found = Vec::new();
    let (mut unreachable, mut unused) = (Unreachable::default(), UnusedSubprogram::default());
    let mut internal = UnusedSection::new(control.m_of(MMeaning::InternalCall).is_some());
    let mut begun = false;
    while blocks.next()? && found.len() < MOST_FOUND {
        let block = &blocks.block;
        if block.rewind && begun {
            break;
        }
        let place = place_of(block, last);
        for comment in &block.comments {
            found.extend(allow_unknown::look(&String::from_utf8_lossy(blocks.text(*comment)), place));
        }
        if block.is_empty() || block.rewind {
            continue;
        }
        if block.begins_program(&control.grammar) && begun {
            found.extend(unused.end(targets));
            unused.begin(block.whole_number(b'O'), place);
            unreachable.begin();
        }
        begun = true;
        let facts = facts(control, block);
        if !unreachable.is_dead() {
            unused.look(&facts);
        }
        found.extend(unreachable.look(&facts, place, targets).and_then(|finding| internal.begin(&facts, finding)));
        found.extend(internal.look(&facts, unreachable.is_dead()));
    }
    found.extend(internal.end());
    found.extend(unused.end(targets));
    Ok(found)
}

fn facts(control: &Control, block: &Block) -> Facts {
    let (mut ends, mut returns) = (false, false);
    for word in block.words.iter().filter(|word| word.letter == b'M') {
        let Value::Number(number) = word.value else { continue };
        let code = number.integer().and_then(|code| u32::try_from(code).ok());
        match code.and_then(|code| control.m_code(code)).map(|row| row.meaning) {
            Some(MMeaning::ProgramEnd | MMeaning::TapeEnd) => ends = true,
            Some(MMeaning::SubprogramEnd) => returns = true,
            _ => {}
        }
    }
    let jumps = block.statement.is_some_and(|statement| statement.kind == StatementKind::Goto);
    Facts {
        sequence: block.whole_number(b'N'),
        ends,
        returns,
        leaves: ends || returns || jumps,
        can_be_passed: !block.skips.is_empty(),
    }
}

fn place_of(block: &Block, like: &Place) -> Place {
    Place {
        line: block.start.line,
        line_start: block.start.line_start,
        block: block.span(),
        sequence: 0,
        program: like.program,
        source: like.source,
    }
}
