//! Words that count or name something: programs, blocks, cells of memory, how often.

use dialect::{MMeaning, Meaning};

use super::here::Here;
use super::quantity::plain;
use super::role::{is_pattern, shifts};

/// What the number of this letter is in the block at hand; `None` for what is no count here.
pub fn count(here: &Here, letter: u8, value: f64) -> Option<String> {
    let count = plain(value, 0);
    let shot = here.one_shot();
    let macro_call = matches!(shot, Some(Meaning::MacroCall)) || here.has_code(Meaning::ModalMacroCall);
    let calls = here.has_m(MMeaning::SubprogramCall) || macro_call;
    if shot == Some(Meaning::WriteData)
        && let Some(says) = written_data(here, letter, value)
    {
        return Some(says);
    }
    if here.cycle().is_some() && here.control.functions.cycle.repeats.contains(&letter) && !is_pattern(shot) {
        return Some(match value == 0.0 {
            true => "the cycle's data are kept, no hole is made".to_owned(),
            false => format!("the hole {count} times"),
        });
    }
    Some(match letter {
        b'P' if calls => format!("calls program O{count}"),
        b'P' if here.has_m(MMeaning::InternalCall) => format!("calls what stands from block N{count} on to M99"),
        b'P' if here.has_m(MMeaning::SubprogramEnd) => format!("goes on at block N{count} of the calling program"),
        b'P' if here.has_m(MMeaning::InterruptOn) => format!("an interrupt goes on at block N{count}"),
        b'P' if here.has_code(Meaning::ScalingOn) => format!("factor of scaling: {}", plain(value / 1000.0, 3)),
        b'P' if shot == Some(Meaning::OtherReferenceReturn) => format!("reference point {count}"),
        b'Q' if here.has_m(MMeaning::SubprogramCall) => format!("begins at block N{count} of that program"),
        b'Q' if here.cycle().is_some_and(|cycle| here.control.functions.cycle.pecks(cycle)) => {
            "depth of each cut".to_owned()
        }
        b'Q' if shifts(here) => "shift away from the wall, spindle oriented".to_owned(),
        b'L' if calls || here.has_m(MMeaning::InternalCall) => format!("{count} times"),
        b'L' if is_pattern(shot) => format!("{} holes", plain(value.abs(), 0)),
        _ => return None,
    })
}

/// What is written into memory, and where.
fn written_data(here: &Here, letter: u8, value: f64) -> Option<String> {
    let kinds = &here.control.functions.data;
    let count = plain(value, 0);
    let kind_of = |value: f64| match value as i64 {
        kind if kind == kinds.work => "origins of work systems",
        kind if kinds.length == Some(kind) => "tool lengths",
        kind if kinds.radius == Some(kind) => "tool radii",
        _ => "data of this kind",
    };
    if kinds.letters.contains(&letter) {
        return Some(format!("what is written: {}", kind_of(value)));
    }
    let named = kinds.letters.iter().find_map(|&letter| here.read(letter)).map(|(_, value)| kind_of(value));
    let origin = named == Some("origins of work systems");
    match letter {
        b'P' if origin && value == 0.0 => Some("the origin that counts in every work system".to_owned()),
        b'P' if origin => Some(format!("work system {count}")),
        b'P' => Some(format!("number of the offset: {count}")),
        _ => None,
    }
}
