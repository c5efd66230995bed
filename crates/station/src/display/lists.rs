//! The pages that are lists: offsets, work systems, parameters, variables, programs in memory, the pages themselves.

use std::collections::BTreeMap;

use base::{Point, SourceId};
use dialect::{G92System, Meaning, ParameterKind, StateItem, VariableMeaning};
use syntax::Cursor;

use super::{Value, axes};
use crate::kept::Cell;
use crate::library::Library;
use crate::memory;
use crate::operator::Operator;
use crate::program_text::number_of;
use crate::session::Session;

/// Every offset, mm: its number and its value, or its length and its radius where they have columns of their own.
pub(super) fn offsets<L: Library>(session: &Session<L>) -> Value {
    let interpreter = session.interpreter();
    let memory = interpreter.memory();
    let mm = |counts: f64| Value::Number(counts / 1e6);
    let row = |number: u32| {
        let first = memory.lengths.value(number)?;
        let name = if memory.radii.is_some() { "length" } else { "value" };
        let mut row = vec![("number", Value::Number(f64::from(number))), (name, mm(first))];
        row.extend(memory.radii.as_ref().and_then(|radii| radii.value(number)).map(|radius| ("radius", mm(radius))));
        Some(Value::fields(row))
    };
    Value::List((1..=interpreter.control().highest_offset).filter_map(row).collect())
}

/// Every origin by the name under which it is written, the system in force, and what shifts them now.
pub(super) fn works<L: Library>(session: &Session<L>) -> Value {
    let interpreter = session.interpreter();
    let (control, memory) = (interpreter.control(), interpreter.memory());
    let state = interpreter.executing_state();
    let mm = |counts: &Point| axes(session, &counts.map(|count| count / 1e6));
    let systems = control.g_codes.iter().enumerate().filter(|(_, code)| code.meaning == Meaning::WorkSystem);
    let stored = systems.filter_map(|(row, code)| {
        let origin = memory.work.get(usize::from(code.number).checked_sub(1)?)?;
        Some((control.g_name(row as u8), mm(origin)))
    });
    let base = control.base_system.map(|row| (control.g_name(row), mm(&state.base_origin)));
    let has_external = control.functions.work.external;
    let external = has_external.then(|| (memory::EXTERNAL.to_owned(), mm(&memory.external)));
    let origins = base.into_iter().chain(stored).chain(external).collect();
    let mut shown = vec![
        ("in_force", Value::Text(control.g_name(state.groups.0[control.roles.work]))),
        ("origins", Value::Object(origins)),
    ];
    // A local origin is one of the control's states where it has one.
    if control.station.states.iter().any(|row| row.item == StateItem::LocalSystem) {
        shown.push(("local", mm(&state.local)));
    }
    let shifts = control.functions.work.shifts_all || interpreter.fitting().policies.g92_system == G92System::All;
    if shifts {
        let shift: Point = std::array::from_fn(|axis| state.common_shift[axis] - state.local[axis]);
        shown.push(("shift", mm(&shift)));
    }
    shown.push(("zero", axes(session, &interpreter.program_zero(state))));
    Value::fields(shown)
}

/// Every parameter: its value as a number, as it is written, and what it does.
pub(super) fn parameters<L: Library>(session: &mut Session<L>) -> Value {
    session.interpreter_mut().store_codes();
    let interpreter = session.interpreter();
    let (control, fitting) = (interpreter.control(), interpreter.fitting());
    let rows = control.parameters.iter().enumerate().map(|(index, row)| {
        let value = fitting.parameter(index);
        let kind = match row.kind {
            ParameterKind::Bits => "bits",
            ParameterKind::Choice => "choice",
            ParameterKind::Length => "length",
            ParameterKind::Number => "number",
        };
        let mut shown = vec![
            ("name", Value::text(&row.name)),
            ("kind", Value::text(kind)),
            ("value", Value::Number(value)),
            ("written", Value::Text(Cell::Parameter(index).text(control, value).unwrap_or_default())),
            ("text", Value::text(&row.text)),
        ];
        if !row.bits.is_empty() {
            let bit = |bit: &dialect::ParameterBit| {
                let on = value as u8 >> bit.bit.min(7) & 1 == 1;
                Value::object([
                    ("bit", Value::Number(f64::from(bit.bit))),
                    ("on", Value::Truth(on)),
                    ("text", Value::text(&bit.text)),
                ])
            };
            shown.push(("bits", Value::List(row.bits.iter().map(bit).collect())));
        }
        Value::fields(shown)
    });
    Value::List(rows.collect())
}

/// The local variables of the level in execution and the common ones that hold something.
pub(super) fn variables<L: Library>(session: &Session<L>) -> Result<Value, String> {
    let interpreter = session.interpreter();
    if !interpreter.fitting().options.user_macro {
        return Err("the option user-macro is not fitted".to_owned());
    }
    let table = &interpreter.control().user_macro;
    let of = |meanings: &[VariableMeaning]| {
        let numbers = meanings.iter().filter_map(|&meaning| table.range_of(meaning)).flat_map(|(from, to)| from..=to);
        let row = |number: u32| {
            let value = interpreter.variable(number)?;
            Some(Value::object([("number", Value::Number(f64::from(number))), ("value", Value::Number(value))]))
        };
        Value::List(numbers.filter_map(row).collect())
    };
    Ok(Value::object([
        ("level", Value::Number(interpreter.macro_level() as f64)),
        ("local", of(&[VariableMeaning::Local])),
        ("common", of(&[VariableMeaning::CommonVolatile, VariableMeaning::CommonPermanent])),
    ]))
}

/// The pages that the control has, by their keys.
pub(super) fn displays<L: Library>(session: &Session<L>) -> Value {
    let rows = session.configuration().control.station.displays.iter();
    let row = |row: &dialect::DisplayRow| {
        Value::object([
            ("key", Value::text(&row.key)),
            ("name", Value::text(&row.name)),
            ("shows", Value::text(&row.shows)),
            ("text", Value::text(&row.text)),
            ("certainty", Value::Text(row.origin.certainty.0.to_string())),
        ])
    };
    Value::List(rows.map(row).collect())
}

impl<L: Library> Operator<L> {
    /// The programs in memory, what they take and what is left.
    pub(super) fn directory(&self) -> Value {
        let session = &self.session;
        let (control, fitting) = (&session.configuration().control, session.interpreter().fitting());
        let programs: Vec<_> = self.kept_programs().collect();
        // Where the programs of a text begin; each goes on to the next one.
        let mut heads: BTreeMap<SourceId, Vec<u64>> = BTreeMap::new();
        programs.iter().for_each(|(_, _, source, head)| heads.entry(*source).or_default().push(head.offset));
        let size = |source: SourceId, head: u64| {
            let next = heads.get(&source).into_iter().flatten().copied().filter(|&other| other > head).min();
            let end = next.or_else(|| session.library().size(source))?;
            Some(("bytes", Value::Number(end.saturating_sub(head) as f64)))
        };
        let row = |&(key, name, source, head): &(&str, &str, SourceId, Cursor)| {
            let number = number_of(key);
            let protected = number.is_some_and(|number| fitting.protects(control, number));
            let mut row = vec![("name", Value::text(name))];
            row.extend(size(source, head.offset));
            row.push(("protected", Value::Truth(protected)));
            Value::fields(row)
        };
        let rows: Vec<_> = programs.iter().map(row).collect();
        let bytes: Option<u64> = heads.keys().map(|&source| session.library().size(source)).sum();
        let count = |count: usize| Value::Number(count as f64);
        let mut used = vec![("programs", count(programs.len()))];
        used.extend(bytes.map(|bytes| ("bytes", Value::Number(bytes as f64))));
        let mut shown = vec![("programs", Value::List(rows)), ("used", Value::fields(used))];
        if let Some(most) = fitting.most_programs(control).filter(|&most| most < usize::MAX) {
            let free = most.saturating_sub(programs.len());
            shown.push(("free", Value::fields(vec![("programs", count(free))])));
        }
        Value::fields(shown)
    }
}
