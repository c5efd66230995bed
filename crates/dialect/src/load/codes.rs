//! `control.toml`'s groups, `g_codes.toml` and `m_codes.toml`.

use data::Table;

use super::origin;
use crate::meaning::{MMeaning, Meaning};
use crate::row::{Class, Division, GCode, MCode, OptionRow, Origin, Takes};

/// A group whose codes are still names.
pub(super) struct GroupDraft {
    pub number: u8,
    pub name: String,
    pub power_on: RuleDraft,
    pub reset: RuleDraft,
    pub emergency_stop: RuleDraft,
    pub program_end: RuleDraft,
    pub stored: bool,
    pub origin: Origin,
}

/// A rule whose codes are still names; the parameter is its name, its bits, a code for each value.
#[derive(Clone)]
pub(super) struct RuleDraft {
    pub code: String,
    pub parameter: Option<(String, Vec<u8>, Vec<String>)>,
}

fn rule(row: &mut Table, code: &'static str, parameter: &'static str) -> RuleDraft {
    RuleDraft {
        code: row.required_string(code),
        parameter: row.table(parameter, |t| {
            let number = t.integer("number").map(|n| n.to_string());
            let bits = t.integers("bits").unwrap_or_default();
            let codes = t.strings("codes").unwrap_or_default();
            if bits.is_empty() || bits.iter().any(|bit| !(0..8).contains(bit)) || codes.len() != 1 << bits.len().min(8)
            {
                t.error_here("bits are numbers 0 to 7, and codes has one entry for each of their values");
            }
            (number.or_else(|| t.string("name")).unwrap_or_default(), bits.iter().map(|&b| b as u8).collect(), codes)
        }),
    }
}

pub(super) fn group(row: &mut Table) -> GroupDraft {
    let number = row.integer("number").and_then(|n| u8::try_from(n).ok()).unwrap_or(0);
    let reset = rule(row, "reset", "reset_parameter");
    // What is not written is as after the RESET key.
    let mut as_reset = |key, parameter| {
        let written = row.place_of(key).is_some();
        if written { rule(row, key, parameter) } else { reset.clone() }
    };
    GroupDraft {
        number,
        emergency_stop: as_reset("emergency_stop", "emergency_stop_parameter"),
        program_end: as_reset("program_end", "program_end_parameter"),
        reset,
        name: row.required_string("name"),
        power_on: rule(row, "power_on", "power_on_parameter"),
        stored: row.boolean("stored").unwrap_or(false),
        origin: origin(row),
    }
}

/// A code by its name (`G54`).
pub(super) fn row_of_name(rows: &[GCode], name: &str) -> Option<u8> {
    let code: u16 = name.strip_prefix('G')?.parse().ok()?;
    rows.iter().position(|row| row.code == code).map(|row| row as u8)
}

fn code_number(row: &mut Table, key: &'static str, seen: &mut Vec<u16>) -> u16 {
    row.require(key);
    let place = row.place_of(key).unwrap_or_else(|| row.range());
    let code = row.integer(key).and_then(|n| u16::try_from(n).ok()).unwrap_or(u16::MAX);
    if code > 999 {
        row.error(place, format!("{key} is a number from 0 to 999"));
    } else if seen.contains(&code) {
        row.error(place, format!("{key} = {code} has a row already"));
    } else {
        seen.push(code);
    }
    code
}

pub(super) fn g_codes(root: &mut Table, groups: &[u8], options: &[OptionRow]) -> Vec<GCode> {
    let mut seen = Vec::new();
    let mut forbidding = Vec::new();
    let mut rows = root.tables("code", |row| {
        let place = row.place_of("not_under").unwrap_or_else(|| row.range());
        forbidding.push((place, row.strings("not_under").unwrap_or_default()));
        g_code(row, groups, options, &mut seen)
    });
    if rows.len() >= usize::from(crate::control::NO_CODE) {
        root.error_here("more than 254 G codes");
    }
    for (index, (place, names)) in forbidding.into_iter().enumerate() {
        for name in names {
            match row_of_name(&rows, &name).filter(|&other| rows[usize::from(other)].group.is_some()) {
                Some(other) => rows[index].not_under.push(other),
                None => root.error(place.clone(), format!("not_under: {name} is no modal code of this control")),
            }
        }
    }
    rows
}

const CLASSES: &[(&str, Class)] = &[
    ("state", Class::State),
    ("movement", Class::Movement),
    ("solo", Class::Solo),
    ("modifier", Class::Modifier),
    ("one-shot", Class::OneShot),
];

const TAKES: &[(&str, Takes)] =
    &[("axis-words", Takes::AxisWords), ("target", Takes::Target), ("all-words", Takes::AllWords)];

fn g_code(row: &mut Table, groups: &[u8], options: &[OptionRow], seen: &mut Vec<u16>) -> GCode {
    let code = code_number(row, "g", seen);
    let group_place = row.place_of("group");
    let group_number = row.integer("group");
    let one_shot = row.boolean("one_shot").unwrap_or(false);
    let division = row.choice("division", &[("basic", 0), ("option", 1), ("sibling", 2)]).unwrap_or(0);
    row.require("division");
    let option_place = row.place_of("option").unwrap_or_else(|| row.range());
    let option = row.string("option");
    let division = match (division, option) {
        (0, None) => Division::Basic,
        (2, None) => Division::Sibling,
        (1, Some(name)) => match options.iter().position(|row| row.name == name) {
            Some(index) => Division::Option(index as u8),
            None => {
                row.error(option_place, format!("there is no option `{name}` in control.toml"));
                Division::Basic
            }
        },
        _ => {
            row.error_here("`option` names the option of a code whose division is \"option\", and of no other");
            Division::Basic
        }
    };
    let group = match (group_number, one_shot) {
        (Some(number), false) => {
            let index = groups.iter().position(|&known| i64::from(known) == number);
            // Codes that only related controls have may belong to groups that this control lacks.
            if index.is_none() && division != Division::Sibling {
                row.error(group_place.unwrap_or_default(), format!("there is no group {number} in control.toml"));
            }
            index.map(|index| index as u8)
        }
        (None, true) => None,
        (None, false) if division == Division::Sibling => None,
        _ => {
            row.error_here("a code has either `group` or `one_shot = true`");
            None
        }
    };
    GCode {
        code,
        group,
        division,
        class: row.choice("class", CLASSES).unwrap_or_default(),
        takes: row.choice("takes", TAKES).unwrap_or_default(),
        meaning: row.choice("meaning", Meaning::TABLE).unwrap_or(Meaning::Dwell),
        number: row.integer("number").and_then(|n| u8::try_from(n).ok()).unwrap_or(0),
        not_under: Vec::new(),
        text: row.required_string("text"),
        origin: origin(row),
    }
}

/// The ranges of M codes, how many a block may have, and the codes that the control knows.
pub(super) fn m_codes(root: &mut Table) -> ([[u32; 2]; 3], usize, Vec<MCode>) {
    let most = root.integer("most_in_block").and_then(|most| usize::try_from(most).ok()).unwrap_or(usize::MAX);
    root.require("range");
    let ranges = root.table("range", |t| {
        ["machine", "control", "extended"].map(|key| {
            let list = t.integers(key).unwrap_or_default();
            match list[..] {
                [low, high] if 0 <= low && low <= high => [low as u32, high as u32],
                _ => [1, 0],
            }
        })
    });
    let mut seen = Vec::new();
    let rows = root.tables("code", |row| MCode {
        code: code_number(row, "m", &mut seen),
        meaning: row.choice("meaning", MMeaning::TABLE).unwrap_or(MMeaning::ProgramStop),
        decoded: row.string("decoded"),
        to_machine: row.boolean("to_machine").unwrap_or(false),
        stops_read_ahead: row.boolean("stops_read_ahead").unwrap_or(false),
        text: row.required_string("text"),
        origin: origin(row),
    });
    (ranges.unwrap_or([[1, 0]; 3]), most, rows)
}
