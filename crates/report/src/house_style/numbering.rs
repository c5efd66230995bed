//! New sequence numbers, and every jump led to the block that it meant.
//!
//! GOTO and M91 P mean the program they stand in, M98 Q the program called, M99 P the program that called. A jump by a
//! variable, to a number that stands twice or nowhere, or to programs that would need different numbers is refused: a
//! guess would send the tool elsewhere.

use std::collections::BTreeMap;

use base::Decimal;
use dialect::{Control, MMeaning, Meaning};
use syntax::{Item, Value, goto_number};

use super::{Kind, Parsed, is_said};

/// The first number, and how far apart they are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Numbering {
    /// The first one.
    pub start: u32,
    /// From one to the next.
    pub step: u32,
}

/// A program's old numbers: the new one of each, or that it stands more than once.
type Map = BTreeMap<u32, Option<u32>>;

/// Where a jump leads.
enum Target {
    /// To a block of its own program.
    Own(u32),
    /// To a block of the program of this number.
    Called(u32, u32),
    /// To a block of the program that called.
    Caller(u32),
}

/// Numbers every block that says something but the program's own number.
pub(super) fn renumber(blocks: &mut [Parsed], control: &Control, numbering: Numbering) -> Result<(), String> {
    let programs = blocks.iter().map(|block| block.program).max().map_or(0, |last| last + 1);
    let mut maps: Vec<Map> = vec![Map::new(); programs];
    let mut names: Vec<Option<u32>> = vec![None; programs];
    let mut numbers: Vec<Option<u32>> = Vec::with_capacity(blocks.len());
    let mut next = vec![numbering.start; programs];
    let range = control.address(b'N').map_or([0, i64::from(u32::MAX)], |address| address.range);
    let [lowest, highest] = range.map(|bound| u32::try_from(bound).unwrap_or(u32::MAX));
    for block in blocks.iter() {
        let Kind::Items { items, .. } = &block.kind else {
            if matches!(block.kind, Kind::Raw(_)) {
                return Err(format!("line {}: the block cannot be read, and its jumps neither", block.line));
            }
            numbers.push(None);
            continue;
        };
        if items.iter().filter(|item| matches!(item, Item::Word { letter: b'N', .. })).count() > 1 {
            return Err(format!("line {}: two sequence numbers stand in one block", block.line));
        }
        let fixed = |item: &Item| match item {
            Item::Word { letter: b'N' | b'O', value, .. } => matches!(value, Value::Number(_)),
            _ => true,
        };
        if !items.iter().all(fixed) {
            return Err(format!("line {}: the block's number is not a plain one", block.line));
        }
        let has_number = items.iter().any(|item| matches!(item, Item::Word { letter: b'N', .. }));
        if has_number && !whole(items, b'N').is_some_and(|number| (lowest..=highest).contains(&number)) {
            // The control refuses the block for its number: with another it would be carried out.
            return Err(format!("line {}: the block's number is not one of N{lowest} to N{highest}", block.line));
        }
        if let Some(name) = whole(items, b'O') {
            names[block.program].get_or_insert(name);
        }
        if !is_said(block) || is_name_alone(items) {
            numbers.push(None);
            continue;
        }
        let number = next[block.program];
        if number > highest {
            return Err(format!("line {}: number {number} is beyond the highest, N{highest}", block.line));
        }
        next[block.program] = number.saturating_add(numbering.step);
        if let Some(old) = whole(items, b'N') {
            maps[block.program].entry(old).and_modify(|new| *new = None).or_insert(Some(number));
        }
        numbers.push(Some(number));
    }
    let callers = callers(blocks, control, &names);
    let lead = |program: usize, target: &Target, line: u64| lead(program, target, &maps, &names, &callers, line);
    for block in blocks.iter_mut() {
        let (line, program) = (block.line, block.program);
        if let Kind::Items { items, .. } = &mut block.kind {
            redirect(items, control, line, |target| lead(program, target, line))?;
        }
    }
    for (block, number) in blocks.iter_mut().zip(numbers) {
        if let (Kind::Items { items, .. }, Some(number)) = (&mut block.kind, number) {
            put_number(items, number);
        }
    }
    Ok(())
}

/// A word's whole number.
fn whole(items: &[Item], wanted: u8) -> Option<u32> {
    items.iter().rev().find_map(|item| match item {
        Item::Word { letter, value: Value::Number(number), .. } if *letter == wanted => {
            number.integer().and_then(|number| u32::try_from(number).ok())
        }
        _ => None,
    })
}

/// True for a block that holds its program's number and nothing else.
fn is_name_alone(items: &[Item]) -> bool {
    items.iter().all(|item| matches!(item, Item::Comment(_) | Item::Word { letter: b'O', .. }))
}

fn has_m(items: &[Item], control: &Control, wanted: MMeaning) -> bool {
    items.iter().any(|item| {
        let Item::Word { letter: b'M', value: Value::Number(number), .. } = item else { return false };
        let code = number.integer().and_then(|code| u32::try_from(code).ok());
        code.and_then(|code| control.m_code(code)).is_some_and(|row| row.meaning == wanted)
    })
}

fn calls_macro(items: &[Item], control: &Control) -> bool {
    items.iter().any(|item| {
        let Item::Word { letter: b'G', value: Value::Number(number), .. } = item else { return false };
        let row = number.integer().and_then(|code| control.g_row(code));
        let code = row.and_then(|row| control.g_codes.get(usize::from(row)));
        code.is_some_and(|code| matches!(code.meaning, Meaning::MacroCall | Meaning::ModalMacroCall))
    })
}

/// The programs of the text that others in it call, by their numbers.
pub(super) fn called_programs(blocks: &[Parsed], control: &Control) -> Vec<u32> {
    let calls = blocks.iter().filter_map(|block| call_of(block, control).flatten());
    calls.collect()
}

/// The program that a block calls; the inner `None` is one that a variable names.
fn call_of(block: &Parsed, control: &Control) -> Option<Option<u32>> {
    let Kind::Items { items, .. } = &block.kind else { return None };
    let calls = has_m(items, control, MMeaning::SubprogramCall) || calls_macro(items, control);
    calls.then(|| whole(items, b'P'))
}

/// For each program of the text those that call it; `None` if some call names no fixed program.
fn callers(blocks: &[Parsed], control: &Control, names: &[Option<u32>]) -> Option<Vec<Vec<usize>>> {
    let mut callers = vec![Vec::new(); names.len()];
    for block in blocks {
        let Some(called) = call_of(block, control) else { continue };
        let called = called?;
        if let Some(index) = names.iter().position(|name| *name == Some(called)) {
            callers[index].push(block.program);
        }
    }
    callers.iter_mut().for_each(|list: &mut Vec<usize>| {
        list.sort_unstable();
        list.dedup();
    });
    Some(callers)
}

/// The new number of a target; `None` if it lies in another text and keeps its number.
fn lead(
    program: usize,
    target: &Target,
    maps: &[Map],
    names: &[Option<u32>],
    callers: &Option<Vec<Vec<usize>>>,
    line: u64,
) -> Result<Option<u32>, String> {
    let of = |program: usize, number: u32| match maps.get(program).and_then(|map| map.get(&number)) {
        Some(Some(new)) => Ok(Some(*new)),
        Some(None) => Err(format!("line {line}: block N{number}, to which it leads, stands twice in its program")),
        None => Err(format!("line {line}: there is no block N{number} to which it could lead")),
    };
    match *target {
        Target::Own(number) => of(program, number),
        Target::Called(called, number) => match names.iter().position(|name| *name == Some(called)) {
            Some(index) => of(index, number),
            None => Ok(None),
        },
        Target::Caller(number) => {
            let Some(callers) = callers else {
                return Err(format!("line {line}: M99 P leads to a caller, and a call by a variable hides which"));
            };
            let callers = callers.get(program).map(Vec::as_slice).unwrap_or_default();
            // The first program of a text runs by itself too; so does one that nothing calls.
            let alone = (program == 0 || callers.is_empty()).then_some(program);
            let mut led = callers.iter().copied().chain(alone).map(|program| of(program, number));
            let first = led.next().unwrap_or(Ok(None))?;
            for other in led {
                if other? != first {
                    return Err(format!(
                        "line {line}: N{number} gets different numbers in the programs that call this one"
                    ));
                }
            }
            Ok(first)
        }
    }
}

/// Leads a block's jump to the new number.
fn redirect(
    items: &mut [Item],
    control: &Control,
    line: u64,
    lead: impl Fn(&Target) -> Result<Option<u32>, String>,
) -> Result<(), String> {
    let by_variable = || format!("line {line}: a jump by a variable cannot be led to a new number");
    for item in items.iter_mut() {
        let Item::Statement { text, .. } = item else { continue };
        match goto_number(text) {
            None => {}
            Some(None) => return Err(by_variable()),
            Some(Some(place)) => {
                let digits = text.get(place.clone()).map(String::from_utf8_lossy).unwrap_or_default();
                let number = digits.parse().map_err(|_| by_variable())?;
                if let Some(new) = lead(&Target::Own(number))? {
                    text.splice(place, new.to_string().into_bytes());
                }
            }
        }
    }
    let call = has_m(items, control, MMeaning::SubprogramCall);
    let back = has_m(items, control, MMeaning::SubprogramEnd);
    let letter = if call { b'Q' } else { b'P' };
    if !(call || back || has_m(items, control, MMeaning::InterruptOn)) || !has_word(items, letter) {
        return Ok(());
    }
    let number = whole(items, letter).ok_or_else(by_variable)?;
    let target = match (call, back) {
        (true, _) => Target::Called(whole(items, b'P').ok_or_else(by_variable)?, number),
        (_, true) => Target::Caller(number),
        _ => Target::Own(number),
    };
    if let Some(new) = lead(&target)? {
        let last = items.iter_mut().rev().find(|item| matches!(item, Item::Word { letter: own, .. } if *own == letter));
        if let Some(item) = last {
            *item = number_word(letter, new);
        }
    }
    Ok(())
}

fn has_word(items: &[Item], wanted: u8) -> bool {
    items.iter().any(|item| matches!(item, Item::Word { letter, .. } if *letter == wanted))
}

fn number_word(letter: u8, number: u32) -> Item {
    let text = number.to_string().into_bytes();
    let digits = u8::try_from(text.len()).unwrap_or(u8::MAX);
    let value = Decimal { mantissa: u64::from(number), digits, ..Decimal::default() };
    Item::Word { letter, text, value: Value::Number(value) }
}

/// Writes the block's number, behind a block-delete sign at its head.
fn put_number(items: &mut Vec<Item>, number: u32) {
    let word = number_word(b'N', number);
    if let Some(old) = items.iter_mut().find(|item| matches!(item, Item::Word { letter: b'N', .. })) {
        *old = word;
        return;
    }
    let head = items.iter().take_while(|item| matches!(item, Item::Skip(_))).count();
    let head = head + usize::from(matches!(items.get(head), Some(Item::Word { letter: b'O', .. })));
    items.insert(head, word);
}
