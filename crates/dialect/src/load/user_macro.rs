//! `macro.toml`: variables, arguments, functions, limits.

use data::Table;

use super::{origin, small};
use crate::meaning::{Function, VariableMeaning};
use crate::user_macro::{ArgumentRow, FunctionRow, UserMacro, VariableRow};

/// Local variables that a call can have at most.
const MOST_LOCALS: u32 = 33;
/// Common variables of one kind that a control can have at most.
const MOST_COMMON: u32 = 1000;

pub(super) fn user_macro(root: &mut Table) -> UserMacro {
    root.require("limits");
    let limits = root.table("limits", |t| {
        (["brackets", "loops", "triples"].map(|key| small(t.integer(key))), t.boolean("then").unwrap_or(false))
    });
    let ([brackets, loops, triples], then) = limits.unwrap_or(([5, 3, 10], false));
    let mut variables = root.tables("variable", variable);
    variables.sort_by_key(|row| row.from);
    if variables.windows(2).any(|pair| pair[0].to >= pair[1].from) {
        root.error_here("the numbers of two rows of variables overlap");
    }
    UserMacro {
        brackets,
        loops: loops.min(9),
        then,
        triples,
        variables,
        arguments: root.tables("argument", |row| ArgumentRow {
            letter: letter(row),
            variable: row.integer("variable").and_then(|n| u8::try_from(n).ok()).unwrap_or(0).min(MOST_LOCALS as u8),
            origin: origin(row),
        }),
        functions: root.tables("function", |row| FunctionRow {
            name: row.required_string("name"),
            meaning: row.choice("meaning", Function::TABLE).unwrap_or(Function::Absolute),
            text: row.required_string("text"),
            origin: origin(row),
        }),
    }
}

fn letter(row: &mut Table) -> u8 {
    row.string("letter").and_then(|text| text.bytes().next()).filter(u8::is_ascii_uppercase).unwrap_or(0)
}

fn variable(row: &mut Table) -> VariableRow {
    for key in ["from", "to", "access", "meaning"] {
        row.require(key);
    }
    let number = |value: Option<i64>| value.and_then(|n| u32::try_from(n).ok()).unwrap_or(0);
    let (from, to) = (number(row.integer("from")), number(row.integer("to")));
    let access = [("read", (true, false)), ("write", (false, true)), ("both", (true, true))];
    let (read, write) = row.choice("access", &access).unwrap_or_default();
    let meaning = row.choice("meaning", VariableMeaning::TABLE).unwrap_or(VariableMeaning::Null);
    let most = match meaning {
        VariableMeaning::Local => MOST_LOCALS,
        VariableMeaning::CommonVolatile | VariableMeaning::CommonPermanent => MOST_COMMON,
        _ => u32::MAX,
    };
    if from > to || to - from >= most {
        row.error_here(format!("`from` is the lowest number, `to` the highest, at most {most} of them"));
    }
    let axis = row.integer("axis");
    let system = row.integer("system");
    VariableRow {
        from,
        to,
        read,
        write,
        meaning,
        which: small(axis.or(system)).min(99) as u8,
        letter: letter(row),
        text: row.required_string("text"),
        origin: origin(row),
    }
}
