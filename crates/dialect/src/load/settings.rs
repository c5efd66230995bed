//! Options, policies, `parameters.toml` and `addresses.toml`.

use data::{DataError, Table};

use super::{ControlFiles, origin, parameter_if_any, parameter_index, range, refuse};
use crate::address::{Address, AddressKind, PointRule};
use crate::control::{FeedSettings, TapeRules, Tolerances};
use crate::row::{OptionRow, ParameterBit, ParameterKind, ParameterRow, PolicyRow};

/// Whether a row is there on this member of the family.
fn is_of(row: &mut Table, member: &str) -> bool {
    row.strings("only").is_none_or(|only| only.iter().any(|name| name == member))
}

pub(super) fn option(row: &mut Table, member: &str) -> Option<OptionRow> {
    row.require("default");
    let there = is_of(row, member);
    let option = OptionRow {
        name: row.required_string("name"),
        text: row.required_string("text"),
        default: row.boolean("default").unwrap_or(true),
        excludes: row.strings("excludes").unwrap_or_default(),
        origin: origin(row),
    };
    there.then_some(option)
}

pub(super) fn policy(row: &mut Table, member: &str) -> Option<PolicyRow> {
    let there = is_of(row, member);
    let values = row.strings("values").unwrap_or_default();
    let place = row.place_of("default").unwrap_or_else(|| row.range());
    let default = row.required_string("default");
    let index = values.iter().position(|value| *value == default);
    if index.is_none() {
        row.error(place, format!("default \"{default}\" is not one of the values"));
    }
    let policy = PolicyRow {
        name: row.required_string("name"),
        values,
        default: index.unwrap_or(0),
        text: row.required_string("text"),
        bears_on: row.strings("bears_on"),
        origin: origin(row),
    };
    there.then_some(policy)
}

pub(super) fn parameters(root: &mut Table, member: &str) -> Vec<ParameterRow> {
    let rows = root.tables("parameter", |row| {
        let there = is_of(row, member);
        let number = row.integer("number").map(|n| n.to_string());
        let name = row.string("name");
        if number.is_none() && name.is_none() {
            row.error_here("a parameter has a `number` or a `name`");
        }
        row.require("kind");
        let kinds = [
            ("bits", ParameterKind::Bits),
            ("length", ParameterKind::Length),
            ("number", ParameterKind::Number),
            ("choice", ParameterKind::Choice),
        ];
        let parameter = ParameterRow {
            name: number.or(name).unwrap_or_default(),
            kind: row.choice("kind", &kinds).unwrap_or(ParameterKind::Number),
            default: row.number("default").unwrap_or(0.0),
            values: row.strings("values").unwrap_or_default(),
            range: range(row, "range"),
            text: row.required_string("text"),
            bits: row.tables("bit", |bit| ParameterBit {
                bit: bit.integer("bit").and_then(|n| u8::try_from(n).ok()).unwrap_or(0),
                text: bit.required_string("text"),
                origin: origin(bit),
            }),
            origin: origin(row),
        };
        if (parameter.kind == ParameterKind::Choice) == parameter.values.is_empty() {
            row.error_here("a choice has its `values`, and no other parameter has");
        }
        there.then_some(parameter)
    });
    rows.into_iter().flatten().collect()
}

/// How tapes are read, the parameters still by their names.
pub(super) struct TapeDraft {
    pub block_parity: (String, u8),
    pub eia_codes: Vec<(u8, String)>,
}

pub(super) fn tape(table: &mut Table) -> TapeDraft {
    table.require("block_parity");
    let block_parity = table.table("block_parity", |row| {
        let bit = row.integer("bit").and_then(|n| u8::try_from(n).ok()).unwrap_or(0);
        (row.required_string("parameter"), bit.min(7))
    });
    let eia_codes = table.tables("eia_codes", |row| {
        let character = row.required_string("character");
        (character.bytes().next().unwrap_or(0), row.required_string("parameter"))
    });
    TapeDraft { block_parity: block_parity.unwrap_or_default(), eia_codes }
}

/// The tape rules, their parameters found.
pub(super) fn resolve_tape(
    files: &ControlFiles,
    draft: &TapeDraft,
    parameters: &[ParameterRow],
) -> Result<TapeRules, Vec<DataError>> {
    let (name, bit) = &draft.block_parity;
    let eia_codes = draft.eia_codes.iter().map(|(character, name)| {
        if tape::PUNCTUATION.contains(character) {
            Ok((*character, parameter_index(files, parameters, name)?))
        } else {
            let character = char::from(*character);
            Err(refuse(files, "control.toml", format!("tape: `{character}` has its EIA row by the standard")))
        }
    });
    Ok(TapeRules {
        block_parity: (parameter_index(files, parameters, name)?, *bit),
        eia_codes: eia_codes.collect::<Result<_, _>>()?,
    })
}

/// The parameters that hold tolerances and clearances.
pub(super) fn tolerances(files: &ControlFiles, parameters: &[ParameterRow]) -> Result<Tolerances, Vec<DataError>> {
    Ok(Tolerances {
        cycle_clearance: parameter_index(files, parameters, "cycle clearance")?,
        cycle_shift: parameter_if_any(parameters, "cycle shift direction"),
        arc_radius: parameter_index(files, parameters, "arc radius tolerance")?,
        arc_end: parameter_index(files, parameters, "arc end limit")?,
    })
}

/// The parameters of feeds and of the spindle's speed, as far as the control has them.
pub(super) fn feeds(parameters: &[ParameterRow]) -> FeedSettings {
    FeedSettings {
        stored: std::array::from_fn(|index| parameter_if_any(parameters, &format!("feed F{}", index + 1))),
        limit: parameter_if_any(parameters, "cutting feed limit"),
        dwell: parameter_if_any(parameters, "dwell in revolutions"),
        spindle_limit: parameter_if_any(parameters, "maximum spindle speed"),
    }
}

pub(super) fn addresses(root: &mut Table) -> [Option<Address>; 26] {
    let mut all: [Option<Address>; 26] = std::array::from_fn(|_| None);
    let rows = root.tables("address", |row| {
        let place = row.range();
        (place, address(row))
    });
    for (place, row) in rows {
        match all.get_mut(usize::from(row.letter.wrapping_sub(b'A'))) {
            Some(slot) if slot.is_none() => *slot = Some(row),
            _ => root.error(place, "letter is one of A to Z, and each has one row"),
        }
    }
    all
}

const POINT_RULES: &[(&str, PointRule)] =
    &[("yes", PointRule::Yes), ("no", PointRule::No), ("dwell", PointRule::Dwell), ("whole", PointRule::Whole)];

fn address(row: &mut Table) -> Address {
    let letter = row.required_string("letter");
    row.require("kind");
    let kinds = [
        ("axis", AddressKind::LinearAxis),
        ("length", AddressKind::Length),
        ("code", AddressKind::Code),
        ("number", AddressKind::Number),
        ("feed", AddressKind::Feed),
        ("time-or-number", AddressKind::TimeOrNumber),
        ("macro-only", AddressKind::MacroOnly),
    ];
    let kind = row.choice("kind", &kinds).unwrap_or(AddressKind::Number);
    let rotary = row.choice("axis_kind", &[("linear", false), ("rotary", true)]).unwrap_or(false);
    let everything = [f64::MIN, f64::MAX];
    let whole = range(row, "range").unwrap_or([0.0, 999_999_999.0]);
    let mut of = |key| range(row, key).unwrap_or(everything);
    Address {
        letter: letter.bytes().next().unwrap_or(0),
        kind: if rotary { AddressKind::RotaryAxis } else { kind },
        metric: of("metric"),
        inch: of("inch"),
        rotary: of("rotary"),
        feed: [of("metric_per_minute"), of("inch_per_minute"), of("metric_per_revolution"), of("inch_per_revolution")],
        seconds: of("seconds"),
        zero_is_none: row.boolean("zero_is_none").unwrap_or(false),
        digits: row.integer("digits").and_then(|n| u8::try_from(n).ok()).unwrap_or(u8::MAX),
        range: whole.map(|value| value as i64),
        point: row.choice("point", POINT_RULES).unwrap_or(PointRule::No),
        alarm: row.required_string("alarm"),
        absent: row.string("absent"),
        text: row.required_string("text"),
        origin: origin(row),
    }
}
