//! The tables of `control.toml` that say how functions are carried out.

use data::Table;

use crate::function::{
    CompensationRules, CycleStep, CycleSteps, CycleTable, DataKinds, Functions, MOST_STEPS, ReferenceRules, WorkRules,
};
use crate::meaning::Meaning;
use crate::row::{Division, GCode};

/// The functions, the parameter of the reference points still by its name.
pub(super) struct FunctionsDraft {
    pub functions: Functions,
    pub cycle_codes: [u32; 4],
    pub base_code: Option<String>,
    pub before_start: Option<String>,
    pub stroke_outside: Option<(String, u8)>,
}

pub(super) fn functions(root: &mut Table) -> FunctionsDraft {
    let (cycle_codes, cycle) = root.table("cycle", cycle).unwrap_or_default();
    let (base_code, work) = root.table("work", work).unwrap_or_default();
    let (reference, before_start) = root.table("reference", reference).unwrap_or_default();
    let stroke = root.table("stored_stroke", |t| {
        let corners = t.choice("corners", &[("upper-and-lower", false), ("any", true)]).unwrap_or(false);
        (
            t.table("outside", |bit| (bit.required_string("name"), super::small(bit.integer("bit")).min(7) as u8)),
            corners,
        )
    });
    let (stroke_outside, any_corners) = stroke.unwrap_or_default();
    let data = root.table("data_setting", data_kinds).unwrap_or_default();
    let compensation = root.table("compensation", compensation).unwrap_or_default();
    FunctionsDraft {
        functions: Functions { cycle, work, reference, data, compensation, any_corners },
        cycle_codes,
        base_code,
        before_start,
        stroke_outside,
    }
}

fn cycle(table: &mut Table) -> ([u32; 4], CycleTable) {
    let codes = ["spindle_forward", "spindle_reverse", "spindle_stop", "spindle_orient"]
        .map(|key| super::small(table.integer(key)) as u32);
    let steps = table.table("steps", |steps| {
        let cycles = Meaning::TABLE.iter().filter(|(_, meaning)| meaning.is_cycle());
        cycles.filter_map(|&(name, cycle)| Some((cycle, steps_of(steps, name)?))).collect()
    });
    let table = CycleTable {
        steps: steps.unwrap_or_default(),
        repeats: letters(table, "repeats"),
        shifts_by_ij: table.choice("shift", &[("Q", false), ("Q or I J", true)]).unwrap_or(false),
    };
    (codes, table)
}

/// A cycle of the control's codes whose steps are not listed.
pub(super) fn without_steps(functions: &Functions, codes: &[GCode]) -> Option<&'static str> {
    let own = codes.iter().filter(|code| code.division != Division::Sibling && code.meaning.is_cycle());
    let bare = own.map(|code| code.meaning).find(|cycle| functions.cycle.steps_of(*cycle) == CycleSteps::default())?;
    Meaning::TABLE.iter().find(|(_, meaning)| *meaning == bare).map(|(name, _)| *name)
}

fn steps_of(table: &mut Table, cycle: &'static str) -> Option<CycleSteps> {
    let place = table.place_of(cycle)?;
    let names = table.strings(cycle)?;
    let mut steps = CycleSteps::default();
    for (index, name) in names.iter().enumerate() {
        match (CycleStep::TABLE.iter().find(|(word, _)| word == name), steps.get_mut(index)) {
            (Some(&(_, step)), Some(slot)) => *slot = step,
            (Some(_), None) => table.error(place.clone(), format!("a cycle has at most {MOST_STEPS} steps")),
            (None, _) => {
                let known: Vec<_> = CycleStep::TABLE.iter().map(|(word, _)| *word).collect();
                table.error(place.clone(), format!("there is no step \"{name}\"; the steps are: {}", known.join(", ")));
            }
        }
    }
    Some(steps)
}

/// Address letters, each written as a string of its own.
fn letters(table: &mut Table, key: &'static str) -> Vec<u8> {
    let place = table.place_of(key);
    let written = table.strings(key).unwrap_or_default();
    let letters: Vec<u8> = written.iter().filter(|text| text.len() == 1).flat_map(|text| text.bytes()).collect();
    if let (true, Some(place)) = (letters.len() != written.len() || !letters.iter().all(u8::is_ascii_uppercase), place)
    {
        table.error(place, format!("{key} lists address letters, each as \"L\""));
        return Vec::new();
    }
    letters
}

fn work(table: &mut Table) -> (Option<String>, WorkRules) {
    let rules = WorkRules {
        shifts_all: table.choice("g92", &[("base", false), ("all", true)]).unwrap_or(false),
        external: table.boolean("external").unwrap_or(false),
    };
    (table.string("base"), rules)
}

fn reference(table: &mut Table) -> (ReferenceRules, Option<String>) {
    let rules = ReferenceRules {
        wants_axis: table.boolean("wants_axis").unwrap_or(false),
        drops_length: table.boolean("drops_length").unwrap_or(false),
        checks_places: table.boolean("checks_places").unwrap_or(false),
        before_start: None,
    };
    (rules, table.string("before_start"))
}

fn compensation(table: &mut Table) -> CompensationRules {
    CompensationRules {
        refuses_machine_places: table.choice("machine_places", &[("drop", false), ("refuse", true)]).unwrap_or(false),
        refuses_equal_arc: table.choice("inner_arc", &[("smaller", false), ("not-larger", true)]).unwrap_or(false),
        circles_close: table.choice("full_circle", &[("any", false), ("closes", true)]).unwrap_or(false),
    }
}

fn data_kinds(table: &mut Table) -> DataKinds {
    table.require("work");
    DataKinds {
        letters: letters(table, "letters"),
        work: table.integer("work").unwrap_or(-1),
        length: table.integer("length"),
        radius: table.integer("radius"),
    }
}
