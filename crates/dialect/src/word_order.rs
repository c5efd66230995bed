//! The order in which the words of a block are written in house style, and when it must not be touched.
//!
//! The control looks words up by their letter, so their order means nothing but this: of repeated words and of codes of
//! one group the last counts, a block-delete sign cuts off what follows it, a macro call counts its I J K by position,
//! and a variable in place of a code could be any code. Words are therefore only moved within one piece between
//! block-delete signs, and words of one rank keep their order.

use syntax::{Item, Value};

use crate::control::Control;
use crate::meaning::{MMeaning, Meaning};
use crate::row::GCode;

/// Ranks of the words of a block, lowest first.
const O: u8 = 0;
const N: u8 = 1;
const G: u8 = 2;
const AXES: u8 = 10;
const OTHERS: u8 = 20;
const LAST: u8 = 60;

/// The letters behind the axes, in their order: geometry, times, feed, codes, offsets, repeats.
const ORDER: &[u8] = b"IJKRQPFSTHDBLEM";

/// The axes' own order.
const AXIS_ORDER: &[u8] = b"XYZABCUVW";

/// Puts a block's parts into house order; leaves them where that could change what the block means, or where a remark
/// stands among them. `is_axis` says of a letter that can be both whether it is an axis on this machine.
pub fn put_in_order(control: &Control, is_axis: impl Fn(u8) -> bool, items: &mut [Item]) {
    if keeps_its_order(control, items) {
        return;
    }
    let calls = items.iter().any(|item| m_meaning(control, item).is_some_and(takes_words));
    let rank = |item: &Item| match item {
        Item::Word { letter, value, .. } => rank(control, &is_axis, *letter, value, calls),
        _ => LAST,
    };
    let mut rest = items;
    while !rest.is_empty() {
        let start = rest.iter().position(|item| matches!(item, Item::Word { .. })).unwrap_or(rest.len());
        let words = rest[start..].iter().take_while(|item| matches!(item, Item::Word { .. })).count();
        rest[start..start + words].sort_by_key(rank);
        rest = &mut rest[start + words..];
    }
}

/// True if the order of the words carries a meaning, or a remark stands between two of them.
fn keeps_its_order(control: &Control, items: &[Item]) -> bool {
    let is_word = |item: &Item| matches!(item, Item::Word { .. } | Item::Skip(_));
    let first = items.iter().position(is_word).unwrap_or(0);
    let last = items.iter().rposition(is_word).map_or(0, |last| last + 1);
    let mixed = items.get(first..last).unwrap_or_default().iter().any(|item| !is_word(item));
    // An O word begins a program, or is refused, by its place.
    let words = || items.iter().filter(|item| matches!(item, Item::Word { .. }));
    let late_label = words().skip(1).any(|item| matches!(item, Item::Word { letter: b'O', .. }));
    mixed || late_label || items.iter().any(|item| matches!(item, Item::Name(_)) || leads(control, item))
}

/// True for codes whose words are read in their order, or are written before the axes' by custom, and for codes that
/// cannot be known here.
fn leads(control: &Control, item: &Item) -> bool {
    use Meaning::{MacroCall, ModalMacroCall, OtherReferenceReturn, ScalingOn, WriteData};
    match item {
        Item::Word { letter: b'G' | b'M', value, .. } if !matches!(value, Value::Number(_)) => true,
        Item::Word { letter: b'G', value, .. } => match code(control, value).map(|row| row.meaning) {
            Some(code) => {
                matches!(code, MacroCall | ModalMacroCall | OtherReferenceReturn | ScalingOn | WriteData)
            }
            None => true,
        },
        Item::Word { value, .. } => matches!(value, Value::Missing),
        _ => false,
    }
}

/// The row of a G word's number.
fn code<'c>(control: &'c Control, value: &Value) -> Option<&'c GCode> {
    let Value::Number(number) = value else { return None };
    control.g_codes.get(usize::from(control.g_row(number.integer()?)?))
}

fn m_meaning(control: &Control, item: &Item) -> Option<MMeaning> {
    let Item::Word { letter: b'M', value: Value::Number(number), .. } = item else { return None };
    control.m_code(u32::try_from(number.integer()?).ok()?).map(|row| row.meaning)
}

/// M codes that take words of their own, which are written behind them.
fn takes_words(code: MMeaning) -> bool {
    matches!(code, MMeaning::SubprogramCall | MMeaning::SubprogramEnd | MMeaning::InterruptOn)
}

fn rank(control: &Control, is_axis: &impl Fn(u8) -> bool, letter: u8, value: &Value, calls: bool) -> u8 {
    match letter {
        b'O' => O,
        b'N' => N,
        b'G' => G + g_rank(control, value),
        // A call is written M98 P1000 L2.
        b'M' if calls => OTHERS - 1,
        _ if is_axis(letter) => AXES + AXIS_ORDER.iter().position(|&axis| axis == letter).unwrap_or(0) as u8,
        _ => ORDER.iter().position(|&other| other == letter).map_or(LAST, |at| OTHERS + at as u8),
    }
}

/// States first, then the level to which cycles return, then one-shot codes, last what moves: a cycle or a movement.
/// These two keep their order, for a movement code ends a cycle.
fn g_rank(control: &Control, value: &Value) -> u8 {
    match code(control, value) {
        None => 0,
        Some(row) if row.meaning.is_motion() || row.meaning.is_cycle() || row.meaning == Meaning::CycleOff => 3,
        Some(row) if row.is_one_shot() => 2,
        Some(row) => u8::from(matches!(row.meaning, Meaning::ReturnInitial | Meaning::ReturnR)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{builtin_files, load_control};
    use syntax::{Block, Cursor, lay_out, read_block, take_apart};

    fn line(text: &str) -> String {
        let control = load_control(&builtin_files("yasnac-mx1").expect("built in")).expect("right");
        let mut block = Block::default();
        read_block(text.as_bytes(), true, Cursor::HEAD, &control.grammar, &mut block);
        let mut items = take_apart(&block, text.as_bytes());
        put_in_order(&control, |letter| b"XYZ".contains(&letter), &mut items);
        String::from_utf8(lay_out(&items)).expect("text")
    }

    #[test]
    fn words_come_in_the_order_in_which_they_are_read_aloud() {
        assert_eq!(line("M03 S800 Y1. X2. G00 G90 N5"), "N5 G90 G00 X2. Y1. S800 M03");
        assert_eq!(line("F120 L0 Q6. G83 R2. Z-9. G99"), "G99 G83 Z-9. R2. Q6. F120 L0");
        assert_eq!(line("G02 G45 D31 J-15. Y-15. X15."), "G45 G02 X15. Y-15. J-15. D31");
        assert_eq!(line("N15 L2 P1010 M98"), "N15 M98 P1010 L2");
    }

    #[test]
    fn what_could_change_the_meaning_stays_where_it_is() {
        assert_eq!(line("G90 G91 X1. X2."), "G90 G91 X1. X2.", "the last of a group and of a letter counts");
        assert_eq!(line("G81 G01 X1."), "G81 G01 X1.", "a movement ends the cycle");
        assert_eq!(line("G01 G81 X1."), "G01 G81 X1.");
        assert_eq!(line("Y1. X2. /F5 G01 Z1."), "X2. Y1. /G01 Z1. F5", "nothing passes a block-delete sign");
        assert_eq!(line("G65 P9100 K1. J2. I3."), "G65 P9100 K1. J2. I3.", "arguments count by position");
        assert_eq!(line("X1. G#1 G01"), "X1. G#1 G01", "a variable may be any code");
        assert_eq!(line("Y1. (FIRST Y) X2."), "Y1. (FIRST Y) X2.");
        assert_eq!(line("M08 M03 Y1."), "Y1. M08 M03");
    }
}
