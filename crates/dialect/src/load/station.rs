//! `station.toml`: modes, override switches, pages of the displays, what becomes of states.

use data::{DataError, Entry, Table};

use super::{ControlFiles, origin, parameter_index, refuse};
use crate::occasion::{Fate, StateItem, StateRow};
use crate::row::{OptionRow, ParameterRow};
use crate::station::{DisplayRow, Key, ModeKind, ModeRow, SHOWN, StationTable, SwitchRow};

/// The station whose parameters are still names.
pub(super) struct StationDraft {
    pub modes: Vec<ModeRow>,
    pub switches: Vec<SwitchRow>,
    pub overrides: [Vec<u16>; 3],
    pub increments: Vec<f64>,
    /// Names of the parameters: jog speed, whether it replaces the rapid rate.
    pub parameters: [String; 2],
    /// Name of the parameter: lowest rapid rate.
    pub lowest_rapid: Option<String>,
    pub programs: usize,
    pub more: Option<String>,
    pub protection: Option<String>,
    pub protected: Vec<[u32; 2]>,
    pub keys: Vec<(String, Key)>,
    pub end_resets: bool,
    pub end_rewinds: bool,
    /// Name of the parameter: whether M02 rewinds.
    pub m02_rewinds: Option<String>,
    pub displays: Vec<DisplayRow>,
    pub states: Vec<StateRow>,
    /// For each state the name of the parameter that keeps it.
    pub keeping: Vec<Option<String>>,
}

pub(super) fn station(root: &mut Table) -> StationDraft {
    root.require("overrides");
    let overrides = root.table("overrides", |t| ["feed", "rapid", "spindle"].map(|key| steps(t, key)));
    let by_hand = root.table("by_hand", |t| t.numbers("increments").unwrap_or_default());
    root.require("speeds");
    let speeds = root
        .table("speeds", |t| (["jog", "dry_run_rapid"].map(|key| t.required_string(key)), t.string("lowest_rapid")));
    let (parameters, lowest_rapid) = speeds.unwrap_or_default();
    root.require("memory");
    let memory = root.table("memory", |t| {
        let programs = t.integer("programs").and_then(|n| usize::try_from(n).ok()).unwrap_or(usize::MAX);
        (programs, t.string("more"), t.string("protection"), ranges(t, "protected"))
    });
    let (programs, more, protection, protected) = memory.unwrap_or_default();
    let modes: Vec<ModeRow> = root.tables("mode", mode);
    if modes.is_empty() {
        root.error_here("a station has at least one [[mode]]");
    }
    let switches = root.tables("switch", switch);
    let increments = by_hand.unwrap_or_default();
    let steps = modes.iter().any(|mode| mode.kind == ModeKind::Step);
    if steps == increments.is_empty() || increments.iter().any(|&mm| mm <= 0.0) {
        root.error_here("[by_hand] lists the increments of a mode of kind step, mm, and only where there is one");
    }
    let keys: Option<Vec<(String, Key)>> = root.table("keys", |t| t.rest().iter().filter_map(key).collect());
    let is_mode = |name: &String| modes.iter().any(|mode| mode.name == *name);
    if keys.iter().flatten().any(|(_, key)| matches!(key, Key::Mode(name) if !is_mode(name))) {
        root.error_here("[keys] turns to a mode that has no [[mode]]");
    }
    let end = root.table("program_end", |t| {
        let resets = t.choice("resets", &[("always", true), ("EOP", false)]).unwrap_or(false);
        let rewinds = t.choice("rewinds", &[("always", true), ("RWD", false)]).unwrap_or(false);
        (resets, rewinds, t.string("m02_rewinds"))
    });
    let (end_resets, end_rewinds, m02_rewinds) = end.unwrap_or_default();
    let (mut seen, mut keeping) = (Vec::new(), Vec::new());
    let states = root.tables("state", |row| {
        keeping.push(row.string("kept_by_parameter"));
        state(row, &mut seen)
    });
    StationDraft {
        displays: root.tables("display", display),
        keys: keys.unwrap_or_default(),
        end_resets,
        end_rewinds,
        m02_rewinds,
        modes,
        switches,
        increments,
        overrides: overrides.unwrap_or_default(),
        parameters,
        lowest_rapid,
        programs,
        more,
        protection,
        protected,
        states,
        keeping,
    }
}

fn key(entry: &Entry) -> Option<(String, Key)> {
    let text = entry.string();
    match text.as_deref().map(|text| (text, text.strip_prefix("mode "))) {
        Some(("reset", _)) => Some((entry.key.clone(), Key::Reset)),
        Some((_, Some(mode))) => Some((entry.key.clone(), Key::Mode(mode.to_owned()))),
        _ => {
            entry.error("a key does \"reset\" or turns to a mode, as in \"mode mdi\"");
            None
        }
    }
}

fn steps(table: &mut Table, key: &'static str) -> Vec<u16> {
    let place = table.place_of(key);
    let steps: Vec<u16> =
        table.integers(key).unwrap_or_default().into_iter().filter_map(|n| u16::try_from(n).ok()).collect();
    if let (false, Some(place)) = (steps.is_sorted() && steps.last().is_none_or(|&n| n <= 1000), place) {
        table.error(place, format!("{key} lists percents from 0 to 1000, the lowest first"));
    }
    steps
}

/// Ranges of program numbers, `8000-8999`, one for each bit of a parameter.
fn ranges(table: &mut Table, key: &'static str) -> Vec<[u32; 2]> {
    let place = table.place_of(key);
    let written = table.strings(key).unwrap_or_default();
    let read = |text: &String| {
        let (low, high) = text.split_once('-')?;
        let range = [low.parse().ok()?, high.parse().ok()?];
        (range[0] <= range[1]).then_some(range)
    };
    let ranges: Vec<[u32; 2]> = written.iter().filter_map(read).collect();
    if let (true, Some(place)) = (ranges.len() != written.len() || ranges.len() > 8, place) {
        table.error(place, format!("{key} lists up to eight ranges of program numbers, as in \"8000-8999\""));
    }
    ranges
}

fn switch(row: &mut Table) -> SwitchRow {
    SwitchRow { name: row.required_string("name"), text: row.required_string("text"), origin: origin(row) }
}

fn mode(row: &mut Table) -> ModeRow {
    const KINDS: &[(&str, ModeKind)] = &[
        ("memory", ModeKind::Memory),
        ("tape", ModeKind::Tape),
        ("mdi", ModeKind::Mdi),
        ("edit", ModeKind::Edit),
        ("jog", ModeKind::Jog),
        ("step", ModeKind::Step),
        ("handle", ModeKind::Handle),
        ("rapid", ModeKind::Rapid),
        ("return", ModeKind::Return),
    ];
    row.require("kind");
    ModeRow {
        name: row.required_string("name"),
        kind: row.choice("kind", KINDS).unwrap_or(ModeKind::Edit),
        text: row.required_string("text"),
        origin: origin(row),
    }
}

fn display(row: &mut Table) -> DisplayRow {
    let place = row.place_of("shows");
    let shows = row.required_string("shows");
    if let (false, Some(place)) = (SHOWN.contains(&shows.as_str()), place) {
        row.error(place, format!("a page shows one of {}", SHOWN.join(", ")));
    }
    DisplayRow {
        key: row.required_string("key"),
        name: row.required_string("name"),
        shows,
        text: row.required_string("text"),
        origin: origin(row),
    }
}

fn state(row: &mut Table, seen: &mut Vec<StateItem>) -> StateRow {
    const FATES: &[(&str, Fate)] = &[("keep", Fate::Keep), ("initial", Fate::Initial)];
    row.require("item");
    row.require("power_on");
    row.require("reset");
    let place = row.place_of("item").unwrap_or_else(|| row.range());
    let item = row.choice("item", StateItem::TABLE);
    if let Some(item) = item {
        if seen.contains(&item) {
            row.error(place, "this state has a row already");
        }
        seen.push(item);
    }
    let reset = row.choice("reset", FATES).unwrap_or(Fate::Keep);
    StateRow {
        item: item.unwrap_or(StateItem::Feed),
        initial: row.required_string("initial"),
        fates: [
            row.choice("power_on", FATES).unwrap_or(Fate::Initial),
            reset,
            row.choice("emergency_stop", FATES).unwrap_or(reset),
            row.choice("program_end", FATES).unwrap_or(reset),
        ],
        kept_by: row.string("kept_by"),
        kept_by_parameter: None,
        origin: origin(row),
    }
}

/// The station with its parameters and options found.
pub(super) fn resolve(
    files: &ControlFiles,
    draft: StationDraft,
    parameters: &[ParameterRow],
    options: &[OptionRow],
) -> Result<StationTable, Vec<DataError>> {
    let option = |name: &String| {
        options
            .iter()
            .position(|option| option.name == *name)
            .ok_or_else(|| refuse(files, "station.toml", format!("there is no option `{name}` in control.toml")))
    };
    draft.states.iter().filter_map(|row| row.kept_by.as_ref()).try_for_each(|name| option(name).map(|_| ()))?;
    let [jog_speed, dry_run_rapid] = &draft.parameters;
    let found = |name: &Option<String>| name.as_ref().map(|name| parameter_index(files, parameters, name)).transpose();
    let mut states = draft.states;
    for (state, name) in states.iter_mut().zip(&draft.keeping) {
        state.kept_by_parameter = found(name)?;
    }
    Ok(StationTable {
        jog_speed: parameter_index(files, parameters, jog_speed)?,
        dry_run_rapid: parameter_index(files, parameters, dry_run_rapid)?,
        lowest_rapid: found(&draft.lowest_rapid)?,
        most_programs: draft.programs,
        more_programs: draft.more.as_ref().map(option).transpose()?,
        protection: found(&draft.protection)?,
        keys: draft.keys,
        end_resets: draft.end_resets,
        end_rewinds: draft.end_rewinds,
        m02_rewinds: found(&draft.m02_rewinds)?,
        protected: draft.protected,
        modes: draft.modes,
        switches: draft.switches,
        overrides: draft.overrides,
        increments: draft.increments,
        displays: draft.displays,
        states,
    })
}
