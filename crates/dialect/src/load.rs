//! The tables of one control, read and held against each other.
//!
//! Every error points into the TOML file in which it stands; all errors are reported together.

mod alarms;
mod codes;
mod functions;
mod grammar;
mod groups;
mod members;
mod settings;
mod station;
mod transforms;
mod user_macro;
mod warnings;

use data::{DataError, Document, Table};
use syntax::Grammar;

use crate::combination::Combination;
use crate::control::{Control, FileNames};
use crate::member::Member;
use crate::row::{Certainty, Origin, ParameterRow};

/// The text of a control's files.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ControlFiles {
    /// The folder's name, for messages.
    pub folder: String,
    /// File name and text of every table.
    pub tables: Vec<(String, String)>,
    /// Which member of the folder's family, where it holds one.
    pub member: Option<String>,
    /// The text of `conditions.toml`, shared by all controls.
    pub conditions: String,
    /// The text of `warnings.toml`, shared by all controls.
    pub warnings: String,
}

impl ControlFiles {
    fn read<T>(&self, name: &str, build: impl FnOnce(&mut Table) -> T) -> Result<T, Vec<DataError>> {
        let path = format!("{}/{name}", self.folder);
        match self.tables.iter().find(|(file, _)| file == name) {
            Some((_, text)) => Document::read(&path, text, build),
            None => Err(vec![DataError::at(&path, "", 0..0, format!("`{name}` is missing from the control's folder"))]),
        }
    }
}

/// What a row rests on: its `certainty` and `source`.
fn origin(row: &mut Table) -> Origin {
    row.require("source");
    let place = row.place_of("certainty");
    let letter = row.required_string("certainty");
    let mut letters = letter.chars();
    let certainty = match (letters.next(), letters.next()) {
        (Some(mark @ 'A'..='Z'), None) => mark,
        _ => {
            if let Some(place) = place {
                row.error(place, "certainty is one capital letter");
            }
            '?'
        }
    };
    Origin { certainty: Certainty(certainty), source: row.string("source").unwrap_or_default() }
}

/// A list of two numbers, lowest first.
fn range(row: &mut Table, key: &'static str) -> Option<[f64; 2]> {
    let place = row.place_of(key)?;
    let list = row.numbers(key)?;
    match list[..] {
        [low, high] if low <= high => Some([low, high]),
        _ => {
            row.error(place, format!("{key} is a list of two numbers, the lowest first"));
            None
        }
    }
}

/// Rows by their number, for codes 0 to 999.
fn index_by(codes: impl Iterator<Item = u16>) -> Vec<u8> {
    let mut index = vec![crate::control::NO_CODE; 1000];
    for (row, code) in codes.enumerate() {
        if let Some(slot) = index.get_mut(usize::from(code)) {
            *slot = row as u8;
        }
    }
    index
}

struct Head {
    name: String,
    title: String,
    maker: String,
    summary: String,
    stock_machine: String,
    grammar: Grammar,
    files: Option<FileNames>,
    last_word_wins: bool,
    increments: [i64; 3],
    whole_units: Option<String>,
    combination: Option<Combination>,
    read_ahead: [usize; 3],
    levels: [usize; 2],
    highest_offset: u32,
    offset_limit_mm: f64,
    common_offsets: bool,
    functions: functions::FunctionsDraft,
    universal_preset: Option<(String, u8)>,
    mirror_setting: Option<String>,
    scaling: Option<transforms::ScalingDraft>,
    rotation: Option<transforms::RotationDraft>,
    tape: Option<settings::TapeDraft>,
    groups: Vec<codes::GroupDraft>,
    options: Vec<crate::row::OptionRow>,
    policies: Vec<crate::row::PolicyRow>,
}

fn small(value: Option<i64>) -> usize {
    value.and_then(|n| usize::try_from(n).ok()).unwrap_or(0)
}

fn head(root: &mut Table, member: &str) -> Head {
    let format_place = root.place_of("format");
    root.require("format");
    if let (Some(format), Some(place)) = (root.integer("format"), format_place)
        && format != 1
    {
        root.error(place, format!("format {format} is not known; this program reads format 1"));
    }
    let (grammar, last_word_wins) = grammar::grammar(root);
    for key in ["increments", "read_ahead", "nesting", "offsets", "cycle"] {
        root.require(key);
    }
    let increments = root.table("increments", |t| {
        let whole_units = t.string("whole_units");
        let mut counts =
            |key, unit: f64, fallback: i64| t.number(key).map_or(fallback, |value| (value * unit).round() as i64);
        (
            whole_units,
            [counts("metric_mm", 1e6, 1000), counts("inch_in", 25.4e6, 2540), counts("rotary_deg", 1e6, 1000)],
        )
    });
    let (whole_units, increments) = increments.map_or((None, None), |(whole, counts)| (whole, Some(counts)));
    let increments = increments.filter(|all| all.iter().all(|&n| n > 0)).unwrap_or([1000, 2540, 1000]);
    let read_ahead = root.table("read_ahead", |t| {
        [small(t.integer("blocks")), small(t.integer("compensation")), small(t.integer("buffering"))]
    });
    let levels = root.table("nesting", |t| [small(t.integer("subprograms")), small(t.integer("macros"))]);
    let offsets = root.table("offsets", |t| {
        let common = t.choice("table", &[("common", true), ("columns", false)]).unwrap_or(true);
        (common, small(t.integer("highest")) as u32, t.number("limit_mm").unwrap_or(f64::MAX))
    });
    let (common_offsets, highest_offset, offset_limit_mm) = offsets.unwrap_or((true, 99, f64::MAX));
    let universal_preset = root.table("displays", |t| {
        t.table("universal_preset", |bit| {
            let number = bit.integer("number").map_or_else(String::new, |number| number.to_string());
            (number, small(bit.integer("bit")).min(7) as u8)
        })
    });
    let mirror_setting = root.table("mirror", |t| t.integer("axes").map(|number| number.to_string()));
    Head {
        name: root.required_string("name"),
        title: root.required_string("title"),
        maker: root.required_string("maker"),
        summary: root.required_string("summary"),
        stock_machine: root.required_string("stock_machine"),
        grammar,
        files: root.table("files", |t| FileNames { ending: t.required_string("ending"), large: t.string("large") }),
        last_word_wins,
        increments,
        whole_units,
        combination: root.table("combination", combination),
        read_ahead: read_ahead.unwrap_or([1; 3]),
        levels: levels.unwrap_or([4; 2]),
        highest_offset,
        offset_limit_mm,
        common_offsets,
        functions: functions::functions(root),
        universal_preset: universal_preset.flatten(),
        mirror_setting: mirror_setting.flatten(),
        scaling: root.table("scaling", transforms::scaling),
        rotation: root.table("rotation", transforms::rotation),
        tape: root.table("tape", settings::tape),
        groups: root.tables("group", codes::group),
        options: root.tables("option", |row| settings::option(row, member)).into_iter().flatten().collect(),
        policies: root.tables("policy", |row| settings::policy(row, member)).into_iter().flatten().collect(),
    }
}

fn combination(table: &mut Table) -> Combination {
    let [most_codes, most_states, most_states_with_movement] =
        ["most_codes", "most_states", "most_states_with_movement"].map(|key| {
            table.require(key);
            small(table.integer(key))
        });
    Combination { most_codes, most_states, most_states_with_movement }
}

/// Reads and validates a control.
///
/// # Errors
/// Everything that is wrong with its tables, each error at its place in its file.
pub fn load_control(files: &ControlFiles) -> Result<Control, Vec<DataError>> {
    let mut errors = Vec::new();
    let mut keep = |found: Vec<DataError>| errors.extend(found);
    let member = files.own_member()?;
    let name = member.as_ref().map_or("", |member| member.name.as_str());
    let head = files.read("control.toml", |root| head(root, name)).map_err(&mut keep).ok();
    let parameters = files.read("parameters.toml", |root| settings::parameters(root, name)).map_err(&mut keep).ok();
    let addresses = files.read("addresses.toml", settings::addresses).map_err(&mut keep).ok();
    let m_codes = files.read("m_codes.toml", codes::m_codes).map_err(&mut keep).ok();
    let user_macro = files.read("macro.toml", user_macro::user_macro).map_err(&mut keep).ok();
    let station = files.read("station.toml", station::station).map_err(&mut keep).ok();
    let (
        Some(head),
        Some(parameters),
        Some(addresses),
        Some((m_ranges, most_m_codes, m_codes)),
        Some(user_macro),
        Some(station),
    ) = (head, parameters, addresses, m_codes, user_macro, station)
    else {
        return Err(errors);
    };
    let numbers: Vec<u8> = head.groups.iter().map(|group| group.number).collect();
    let g_codes = files.read("g_codes.toml", |t| codes::g_codes(t, &numbers, &head.options))?;
    let g_index = index_by(g_codes.iter().map(|row| row.code));
    let mut meanings = [None; 1 + u8::MAX as usize];
    for (meaning, row) in meanings.iter_mut().zip(&g_codes) {
        *meaning = Some(row.meaning);
    }
    let (alarms, alarm_of_condition) = files.read("alarms.toml", alarms::alarms)?;
    let sentences = Document::read("controls/conditions.toml", &files.conditions, alarms::sentences)?;
    let warnings = Document::read("controls/warnings.toml", &files.warnings, warnings::rows)?;
    let own_warnings = match files.tables.iter().any(|(file, _)| file == "warnings.toml") {
        true => files.read("warnings.toml", warnings::own)?,
        false => Vec::new(),
    };
    let groups = groups::resolve(files, &head.groups, &g_codes, &parameters)?;
    let roles = groups::roles(files, &groups, &g_codes)?;
    let base_system = head.functions.base_code.as_deref().and_then(|name| codes::row_of_name(&g_codes, name));
    let index = |name: &String| parameter_index(files, &parameters, name);
    let bit_of = |named: &Option<(String, u8)>| {
        named.as_ref().map(|(name, bit)| Ok::<_, Vec<DataError>>((index(name)?, *bit))).transpose()
    };
    let universal_preset = bit_of(&head.universal_preset)?;
    let stroke_outside = bit_of(&head.functions.stroke_outside)?;
    let mut functions = head.functions.functions;
    if let Some(cycle) = functions::without_steps(&functions, &g_codes) {
        return Err(refuse(files, "control.toml", format!("[cycle.steps] does not say what `{cycle}` does")));
    }
    functions.reference.before_start = head.functions.before_start.as_ref().map(index).transpose()?;
    let mirror_setting = head.mirror_setting.as_ref().map(index).transpose()?;
    let (scaling, rotation) = transforms::resolve(files, (head.scaling, head.rotation), &roles, &parameters)?;
    let tape = head.tape.as_ref().map(|draft| settings::resolve_tape(files, draft, &parameters)).transpose()?;
    let station = station::resolve(files, station, &parameters, &head.options)?;
    let whole_units = head.whole_units.as_ref().map(index).transpose()?;
    let family = head.name.clone();
    let member = member.unwrap_or(Member {
        name: head.name,
        title: head.title,
        summary: head.summary,
        stock_machine: head.stock_machine,
        axes: Vec::new(),
    });
    let axes = member.axes.iter().map(|axis| axis.resolve(files, &parameters)).collect::<Result<_, _>>()?;
    Ok(Control {
        name: member.name,
        family,
        title: member.title,
        maker: head.maker,
        summary: member.summary,
        stock_machine: member.stock_machine,
        axes,
        combination: head.combination,
        whole_units,
        grammar: head.grammar,
        files: head.files,
        last_word_wins: head.last_word_wins,
        increments: head.increments,
        read_ahead: head.read_ahead,
        subprogram_levels: head.levels[0],
        macro_levels: head.levels[1],
        highest_offset: head.highest_offset,
        offset_limit_mm: head.offset_limit_mm,
        common_offsets: head.common_offsets,
        cycle_codes: head.functions.cycle_codes,
        functions,
        universal_preset,
        stroke_outside,
        mirror_setting,
        scaling,
        rotation,
        tool_tip: parameter_if_any(&parameters, "tool tip tolerance"),
        tape,
        base_system,
        m_ranges,
        most_m_codes,
        groups,
        roles,
        tolerances: settings::tolerances(files, &parameters)?,
        feeds: settings::feeds(&parameters),
        m_index: index_by(m_codes.iter().map(|row| row.code)),
        m_codes,
        g_codes,
        meanings,
        g_index,
        addresses,
        options: head.options,
        policies: head.policies,
        parameters,
        station,
        user_macro,
        alarms,
        warnings,
        own_warnings,
        sentences,
        alarm_of_condition,
    })
}

fn refuse(files: &ControlFiles, file: &str, message: String) -> Vec<DataError> {
    vec![DataError::at(&format!("{}/{file}", files.folder), "", 0..0, message)]
}

fn parameter_index(files: &ControlFiles, rows: &[ParameterRow], name: &str) -> Result<usize, Vec<DataError>> {
    rows.iter()
        .position(|row| row.name == name)
        .ok_or_else(|| refuse(files, "parameters.toml", format!("the parameter \"{name}\" is missing")))
}

fn parameter_if_any(rows: &[ParameterRow], name: &str) -> Option<usize> {
    rows.iter().position(|row| row.name == name)
}
