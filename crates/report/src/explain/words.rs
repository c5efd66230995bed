//! The words of a block, one by one: what each comes to here, and the row of the control's tables behind it.

use base::Alarm;
use dialect::{AddressKind, MCode, Origin};
use meaning::ReadAs;
use path::Part;
use syntax::{StatementKind, Value, Word};

use super::here::Here;
use super::quantity::{plain, quantity, unit};
use super::role::role;

/// One word explained.
#[derive(Clone, PartialEq, Debug)]
pub struct WordLine {
    /// As written, without blanks.
    pub word: String,
    /// What it comes to, with its unit; empty for codes.
    pub value: String,
    /// The same as a number, and its unit.
    pub number: Option<(f64, &'static str)>,
    /// What it does here.
    pub says: String,
    /// False if it has no effect here.
    pub acts: bool,
    /// True if the control refuses the block because of it.
    pub refused: bool,
    /// How sure that is and where it stands, if a row of the tables says so.
    pub origin: Option<Origin>,
}

/// Every word of the block in its order, block-delete signs and a macro statement among them.
pub fn word_lines(here: &Here) -> Vec<WordLine> {
    let mut lines = Vec::new();
    let cut = here.cut();
    let mut skips = here.block.skips.iter().peekable();
    for (index, word) in here.block.words.iter().enumerate() {
        while let Some(skip) = skips.next_if(|skip| usize::from(skip.first_word) <= index) {
            lines.push(skip_line(here, skip));
        }
        let mut line = word_line(here, index, word);
        if let Some((_, switch)) = cut.filter(|(first, _)| index >= *first) {
            line = passed_over(line, switch);
        }
        lines.push(line);
    }
    lines.extend(skips.map(|skip| skip_line(here, skip)));
    if let Some(statement) = here.block.statement {
        let mut line = statement_line(here, statement);
        line.refused = here.alarm().is_some();
        line.acts = !line.refused;
        if let Some((_, switch)) = cut {
            line = passed_over(line, switch);
        }
        lines.push(line);
    }
    lines.extend(modal_lines(here));
    lines
}

/// What stands in no word of the block and makes it do what it does: the cycle or movement in force, the feed.
fn modal_lines(here: &Here) -> Vec<WordLine> {
    use machine::EventKind::{Arc, Feed, Rapid};
    let happened = |kind: fn(&machine::EventKind) -> bool| here.watched.events.iter().any(|event| kind(&event.kind));
    let cuts = happened(|kind| matches!(kind, Feed { .. } | Arc { .. }));
    let moves = cuts || happened(|kind| matches!(kind, Rapid { .. }));
    let mut lines = Vec::new();
    let roles = here.control.roles;
    let group = if here.cycle().is_some() { roles.cycle } else { roles.motion };
    let written = here.rows().any(|(_, code)| code.group.map(usize::from) == Some(group));
    let takes_over = here.one_shot().is_some_and(|code| code.position_offset().is_none());
    if let Some(code) = here.code_in(group).filter(|_| moves && !written && !takes_over) {
        let mut line = bare(format!("(G{:02})", code.code), format!("in force: {}", code.text));
        line.origin = Some(code.origin.clone());
        lines.push(line);
    }
    let group = roles.compensation;
    let written = here.rows().any(|(_, code)| code.group.map(usize::from) == Some(group));
    let run = here.watched.beside.first().map(|(_, run)| run).filter(|run| run.part != Part::Cancel && !written);
    if let Some((code, run)) = here.code_in(group).zip(run) {
        let mut line = bare(format!("(G{:02})", code.code), format!("in force: {}", code.text));
        line.value = quantity(ReadAs::Length, run.radius.abs(), here.units());
        line.number = Some((run.radius.abs(), unit(ReadAs::Length)));
        line.origin = Some(code.origin.clone());
        lines.push(line);
    }
    let feed = here.watched.after.feed;
    if cuts && !here.has(b'F') && feed.nanometres > 0.0 {
        let read = if feed.per_revolution { ReadAs::FeedPerRevolution } else { ReadAs::FeedPerMinute };
        let mut line = bare("(F)".to_owned(), "in force: the feed programmed last");
        line.value = quantity(read, feed.nanometres / 1e6, here.units());
        line.number = Some((feed.nanometres / 1e6, unit(read)));
        lines.push(line);
    }
    lines
}

fn passed_over(line: WordLine, switch: u8) -> WordLine {
    let says = format!("passed over: switch BLOCK DELETE {switch} is on");
    WordLine { says, acts: false, value: String::new(), number: None, ..line }
}

fn bare(word: String, says: impl Into<String>) -> WordLine {
    WordLine { word, value: String::new(), number: None, says: says.into(), acts: true, refused: false, origin: None }
}

fn skip_line(here: &Here, skip: &syntax::Skip) -> WordLine {
    let word = here.written(skip.extent.at, skip.extent.len);
    let on = here.block_delete & (1 << (skip.switch - 1)) != 0;
    let state = if on { "on: the rest of the block is passed over" } else { "off: the block is obeyed" };
    bare(word, format!("switch BLOCK DELETE {} is {state}", skip.switch))
}

fn statement_line(here: &Here, statement: syntax::Statement) -> WordLine {
    let from = usize::from(statement.extent.at);
    let text = here.text.get(from..from + usize::from(statement.extent.len)).unwrap_or_default();
    let says = match statement.kind {
        StatementKind::Assignment => "macro: the variable on the left gets the value on the right",
        StatementKind::If => "macro: jumps, or does what follows, if the condition holds",
        StatementKind::While => "macro: repeats up to its END as long as the condition holds",
        StatementKind::Do => "macro: a loop up to its END that only GOTO or M99 leaves",
        StatementKind::End => "macro: the end of the loop of this number",
        StatementKind::Goto => "macro: goes on at the block of this number",
    };
    bare(String::from_utf8_lossy(text).trim().to_owned(), says)
}

fn word_line(here: &Here, index: usize, word: &Word) -> WordLine {
    let mut line = match word.letter {
        b'G' => g_line(here, index, word),
        b'M' => m_line(here, word),
        _ => value_line(here, index, word),
    };
    line.refused = here.alarm().is_some_and(|alarm| is_about(here, alarm, word));
    if line.refused {
        line.acts = false;
    }
    line
}

fn is_about(here: &Here, alarm: &Alarm, word: &Word) -> bool {
    let span = word.extent.span(here.block.start.offset);
    span.len > 0 && span == alarm.span
}

fn written(here: &Here, word: &Word) -> String {
    here.written(word.extent.at, word.extent.len)
}

fn g_line(here: &Here, index: usize, word: &Word) -> WordLine {
    let mut line = bare(written(here, word), "");
    let Some(code) = here.row_of(word) else {
        line.says = "G code by a variable, or none of this control".to_owned();
        return line;
    };
    line.says.clone_from(&code.text);
    line.origin = Some(code.origin.clone());
    if let Some(later) = here.later_code(index, code) {
        line.says = format!("without effect: {later} later in the block takes its place");
        line.acts = false;
        return line;
    }
    let group = code.group.map(usize::from);
    if let Some(group) = group.filter(|_| here.alarm().is_none()) {
        let before = here.control.g_name(here.watched.before.groups.0[group]);
        if before == format!("G{:02}", code.code) {
            line.says.push_str("; was in force already");
        }
    }
    line
}

fn m_line(here: &Here, word: &Word) -> WordLine {
    let mut line = bare(written(here, word), "");
    let Value::Number(number) = word.value else {
        line.says = "M code by a variable".to_owned();
        return line;
    };
    let code = number.integer().and_then(|code| u32::try_from(code).ok()).unwrap_or(u32::MAX);
    match here.control.m_code(code) {
        Some(MCode { text, origin, .. }) => {
            line.says.clone_from(text);
            line.origin = Some(origin.clone());
        }
        None => {
            let after = here.machine.codes.m_after_motion.contains(&code);
            let when = if after { "after the motion" } else { "as the block begins" };
            line.says = format!("the machine builder's code: goes out {when}; the block waits for the answer");
            line.origin = here.control.address(b'M').map(|address| address.origin.clone());
        }
    }
    line
}

fn value_line(here: &Here, index: usize, word: &Word) -> WordLine {
    let mut line = bare(written(here, word), "");
    let address = here.control.address(word.letter);
    line.origin = address.map(|address| address.origin.clone());
    let general = || address.map_or_else(|| "no address of this control".to_owned(), |address| address.text.clone());
    let argument = here.watched.words.arguments.iter().find(|(at, ..)| *at == word.extent.at);
    if let Some((_, variable, value)) = argument {
        line.value = plain(*value, 6);
        line.number = Some((*value, ""));
        line.says = format!("argument: variable #{variable} of the program called");
        return line;
    }
    if here.is_overridden(index, word) {
        line.says = "without effect: the last word of an address counts".to_owned();
        line.acts = false;
        return line;
    }
    match here.read(word.letter) {
        Some((read, value)) => {
            line.value = shown(here, word.letter, read, value);
            line.number = Some((value, unit(read)));
            line.says = role(here, word.letter, read, value).unwrap_or_else(general);
        }
        // What follows the word that is refused is not looked at any more.
        None if here.alarm().is_some() => line.says = general(),
        None => {
            line.says = match word.value {
                Value::Expression => "without effect: its variable is blank, or nothing in this block asks for it",
                _ => "without effect: nothing in this block asks for it",
            }
            .to_owned();
            line.acts = false;
        }
    }
    line
}

/// The value as it stands in the column: numbers of blocks and offsets need no second writing.
fn shown(here: &Here, letter: u8, read: ReadAs, value: f64) -> String {
    let speaks = match here.control.address(letter).map(|address| address.kind) {
        Some(AddressKind::Number | AddressKind::Code) => false,
        _ => read != ReadAs::Whole,
    };
    if speaks { quantity(read, value, here.units()) } else { String::new() }
}
