//! The machine builder's file: axes, limits, what codes do and when, wiring.
//!
//! `name` and each axis' `kind` and `travel` are required; any other missing key has its default.

use std::sync::Arc;

use base::{AXES, Alarm, AxisSet, Condition, Point, Seconds};
use data::{DataError, Document, Table};
use include_dir::{Dir, include_dir};
use meaning::{AxisFacts, CodeLine, CodeRules, Kinematics, MachineFacts};
use motion::{AxisLimits, Limits};

use crate::interface::{HandshakeTimes, default_handshake_times, handshake_times};
use crate::kinematics::kinematics;
use crate::logic::{CodesOut, LogicTable, logic};
use crate::path_table::{PathTable, not_negative, path, positive};
use crate::reference_return::ReferenceReturn;
use crate::signals::{LimitSwitch, MagazineFacts, SpindleFacts, magazine, spindle};
use crate::travel::Travel;

static MACHINES: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../machines");

/// The text of a machine that comes with the program, with its file name.
pub fn builtin_machine(name: &str) -> Option<(String, &'static str)> {
    let file = format!("{name}.toml");
    let text = MACHINES.get_file(&file)?.contents_utf8()?;
    Some((format!("machines/{file}"), text))
}

/// The names of the machines that come with the program.
pub fn builtin_machines() -> impl Iterator<Item = &'static str> {
    MACHINES.files().filter_map(|file| file.path().file_stem()?.to_str())
}

/// Times until the machine answers a code.
#[derive(Clone, PartialEq, Debug)]
pub struct CodeTimes {
    single: Vec<(CodeLine, Option<u32>, Seconds)>,
    other: Seconds,
}

impl CodeTimes {
    /// That of the slowest code, s.
    fn longest(&self) -> f64 {
        self.single.iter().fold(self.other.0, |longest, (_, _, time)| longest.max(time.0))
    }

    /// The time from a code to its answer.
    pub fn of(&self, line: CodeLine, code: u32) -> Seconds {
        let fits = |entry: &&(CodeLine, Option<u32>, Seconds)| entry.0 == line && entry.1.is_none_or(|own| own == code);
        let exact = self.single.iter().find(|entry| entry.1.is_some() && fits(entry));
        exact.or_else(|| self.single.iter().find(fits)).map_or(self.other, |entry| entry.2)
    }
}

/// Contacts that the control reads, as the builder wired them: which decoded lines drive them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Wiring {
    /// Internal reset input.
    pub eop: Vec<String>,
    /// Rewind input.
    pub rwd: Vec<String>,
}

/// One axis as the builder made it.
#[derive(Clone, PartialEq, Debug)]
pub struct MachineAxis {
    /// Its letter.
    pub letter: u8,
    /// True if it turns.
    pub rotary: bool,
    /// Lowest and highest machine coordinate, mm or degrees.
    pub travel: [f64; 2],
    /// Rapid rate, mm/min.
    pub rapid: f64,
    /// Highest cutting feed, mm/min.
    pub max_feed: f64,
    /// Acceleration, mm/s².
    pub acceleration: f64,
    /// Change of acceleration, mm/s³; 0 is not limited.
    pub jerk: f64,
    /// Reference points 1 to 4, machine coordinates.
    pub reference_points: [f64; 4],
    /// Signed distance of positioning from one side.
    pub approach: f64,
    /// Where the overtravel switches are, machine coordinates; `None` where the travel is all there is.
    pub limit_switches: Option<[f64; 2]>,
    /// Its dog, by which it returns to its reference point; without one it goes straight there.
    pub reference_return: Option<ReferenceReturn>,
}

/// A machine.
#[derive(Clone, PartialEq, Debug)]
pub struct MachineFile {
    /// Its name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// Its axes in their order.
    pub axes: Vec<MachineAxis>,
    /// How the control leads them.
    pub path: PathTable,
    /// True if B is an axis and there is no B function.
    pub b_axis: bool,
    /// How codes go out.
    pub codes: CodeRules,
    /// Times until codes are answered.
    pub times: CodeTimes,
    /// How codes are answered.
    pub handshake: HandshakeTimes,
    /// The spindle.
    pub spindle: SpindleFacts,
    /// The tool magazine.
    pub magazine: MagazineFacts,
    /// What is wired to the control's inputs.
    pub wiring: Wiring,
    /// Characters that the tape reader reads in a second; 0 is as fast as they are wanted.
    pub tape_speed: f64,
    /// What the builder's logic does with codes.
    pub logic: Arc<LogicTable>,
    /// How the axes that turn move the tip of the tool; `None` if the builder does not say.
    pub kinematics: Option<Kinematics>,
}

impl MachineFile {
    /// The machine as programs see it.
    pub fn facts(&self) -> MachineFacts {
        let counts = |mm: f64| (mm * 1e6).round();
        let axes = self.axes.iter().map(|axis| AxisFacts {
            letter: axis.letter,
            rotary: axis.rotary,
            reference_points: axis.reference_points.map(counts),
            approach: counts(axis.approach),
        });
        MachineFacts { axes: axes.collect(), codes: self.codes.clone(), kinematics: self.kinematics }
    }

    /// The machine as motion sees it.
    pub fn limits(&self) -> Limits {
        let mut axes = [AxisLimits::default(); AXES];
        for (limits, axis) in axes.iter_mut().zip(&self.axes) {
            let jerk = if axis.jerk > 0.0 { axis.jerk } else { f64::INFINITY };
            let (rapid, max_feed) = (axis.rapid / 60.0, axis.max_feed / 60.0);
            *limits = AxisLimits { rapid, max_feed, acceleration: axis.acceleration, jerk };
        }
        let PathTable { model, corner_tolerance, straight_rapid, servo_period } = self.path;
        Limits { axes, count: self.axes.len(), straight_rapid, model, corner_tolerance, servo_period }
    }

    /// The limits of travel.
    pub fn travel(&self) -> Travel {
        let mut travel = Travel { low: [0.0; AXES], high: [0.0; AXES], axes: AxisSet::NONE };
        for (index, axis) in self.axes.iter().enumerate() {
            travel.low[index] = axis.travel[0];
            travel.high[index] = axis.travel[1];
            travel.axes.add(index);
        }
        travel
    }

    /// The overtravel switches.
    pub fn limit_switches(&self) -> Vec<LimitSwitch> {
        let of = |(axis, row): (usize, &MachineAxis)| {
            let [low, high] = row.limit_switches?;
            Some([(false, low), (true, high)].map(|(positive, at)| LimitSwitch { axis, positive, at, on: false }))
        };
        self.axes.iter().enumerate().filter_map(of).flatten().collect()
    }

    /// What an alarm is about in the builder's own words, if it is about his logic.
    pub fn words_of(&self, alarm: &Alarm) -> Option<String> {
        let is_late = alarm.condition == Condition::LogicTimeOut;
        is_late.then(|| self.logic.alarm_in_words(alarm.values[2])).flatten()
    }

    /// The rapid rates, mm/min, as a point.
    pub fn rapid_rates(&self) -> Point {
        let mut rates = [0.0; AXES];
        for (rate, axis) in rates.iter_mut().zip(&self.axes) {
            *rate = axis.rapid;
        }
        rates
    }
}

/// Reads a machine file.
///
/// # Errors
/// Every error of the file, each naming its line and key.
pub fn read_machine(file: &str, text: &str) -> Result<MachineFile, Vec<DataError>> {
    Document::read(file, text, machine)
}

fn machine(root: &mut Table) -> MachineFile {
    let name = root.required_string("name");
    let description = root.string("description").unwrap_or_default();
    root.require("axes");
    let axes = root.table("axes", axes).unwrap_or_default();
    let path = root.table("path", path);
    let spindle = root.table("spindle", spindle).unwrap_or_default();
    let functions = root.table("functions", |t| functions(t, &axes));
    let wiring = root.table("wiring", |t| Wiring {
        eop: t.strings("EOP").unwrap_or_else(default_eop),
        rwd: t.strings("RWD").unwrap_or_else(default_rwd),
    });
    let tape_speed = root.table("tape", |t| not_negative(t, "speed", 0.0)).unwrap_or_default();
    let magazine = root.table("magazine", magazine).unwrap_or_default();
    let kinematics = root.table("kinematics", |t| kinematics(t, &axes)).flatten();
    let Functions { codes, times, handshake, b_axis } = match functions {
        Some(functions) => functions,
        None => default_functions(root, &axes),
    };
    let out = CodesOut { digits: codes.digits, b_axis };
    let logic = root.table("logic", |t| logic(t, out)).unwrap_or_default();
    MachineFile {
        name,
        description,
        axes,
        path: path.unwrap_or_default(),
        b_axis,
        codes,
        times,
        handshake,
        spindle,
        magazine,
        kinematics,
        tape_speed,
        logic: Arc::new(logic),
        wiring: wiring.unwrap_or_else(|| Wiring { eop: default_eop(), rwd: default_rwd() }),
    }
}

fn default_eop() -> Vec<String> {
    vec!["M02R".to_owned(), "M30R".to_owned()]
}

fn default_rwd() -> Vec<String> {
    vec!["M30R".to_owned()]
}

fn axes(table: &mut Table) -> Vec<MachineAxis> {
    let mut axes = Vec::new();
    for entry in table.rest() {
        let letter = match entry.key.as_bytes() {
            [letter @ (b'A'..=b'C' | b'U'..=b'Z')] => *letter,
            _ => {
                entry.error(format!("`{}` is no axis letter; axes are X Y Z A B C U V W", entry.key));
                continue;
            }
        };
        if let Some(axis) = entry.table(|t| axis(t, letter)) {
            axes.push(axis);
        }
    }
    if axes.is_empty() || axes.len() > AXES {
        table.error_here(format!("a machine has 1 to {AXES} axes"));
        axes.truncate(AXES);
    }
    axes
}

fn axis(table: &mut Table, letter: u8) -> MachineAxis {
    table.require("kind");
    table.require("travel");
    let travel_place = table.place_of("travel");
    let travel = match table.numbers("travel").as_deref() {
        Some(&[low, high]) if low < high => [low, high],
        Some(_) => {
            table.error(travel_place.unwrap_or_default(), "travel is a list of two numbers, the lowest first");
            [0.0, 0.0]
        }
        None => [0.0, 0.0],
    };
    let points_place = table.place_of("reference_points");
    let reference_points = match table.numbers("reference_points").as_deref() {
        None => [0.0; 4],
        Some(&[first, second, third, fourth]) => [first, second, third, fourth],
        Some(_) => {
            table.error(points_place.unwrap_or_default(), "reference_points is a list of four numbers");
            [0.0; 4]
        }
    };
    let kind = table.choice("kind", &[("linear", false), ("rotary", true)]);
    let rapid = positive(table, "rapid", 12_000.0);
    let max_feed = positive(table, "max_feed", 6000.0);
    let acceleration = positive(table, "acceleration", 500.0);
    let jerk = not_negative(table, "jerk", 0.0);
    let reference_return = table.table("return", |t| ReferenceReturn::read(t, [rapid, acceleration, jerk]));
    MachineAxis {
        letter,
        rotary: kind.unwrap_or(false),
        travel,
        rapid,
        max_feed,
        acceleration,
        jerk,
        reference_points,
        approach: table.number("approach").unwrap_or(0.0),
        limit_switches: limit_switches(table),
        reference_return,
    }
}

/// Overtravel switches; without the key there are none before the ends of the travel.
fn limit_switches(table: &mut Table) -> Option<[f64; 2]> {
    let place = table.place_of("limit_switches").unwrap_or_default();
    match table.numbers("limit_switches")?.as_slice() {
        &[low, high] if low < high => Some([low, high]),
        _ => {
            table.error(place, "limit_switches is a list of two numbers, the lowest first");
            None
        }
    }
}

struct Functions {
    codes: CodeRules,
    times: CodeTimes,
    handshake: HandshakeTimes,
    b_axis: bool,
}

fn default_functions(root: &Table, axes: &[MachineAxis]) -> Functions {
    check_b(root, root.range(), axes, false);
    let times = CodeTimes { single: default_times(), other: Seconds(0.05) };
    let handshake = default_handshake_times(times.longest());
    Functions { codes: code_rules(), times, handshake, b_axis: false }
}

fn code_rules() -> CodeRules {
    CodeRules { digits: [2, 4, 2, 3], m_after_motion: vec![5, 6, 9], b_after_motion: false }
}

fn default_times() -> Vec<(CodeLine, Option<u32>, Seconds)> {
    vec![(CodeLine::M, Some(6), Seconds(4.0)), (CodeLine::B, None, Seconds(1.5))]
}

fn check_b(table: &Table, place: std::ops::Range<usize>, axes: &[MachineAxis], b_axis: bool) {
    let has_b = axes.iter().any(|axis| axis.letter == b'B');
    if has_b && !b_axis {
        table.error(place.clone(), "a B axis and the B function exclude each other; with [axes.B] set b_axis = true");
    }
    if b_axis && !has_b {
        table.error(place, "b_axis = true wants an [axes.B]");
    }
}

fn functions(table: &mut Table, axes: &[MachineAxis]) -> Functions {
    let place = table.place_of("b_axis").unwrap_or_else(|| table.range());
    let b_axis = table.boolean("b_axis").unwrap_or(false);
    check_b(table, place, axes, b_axis);
    let mut codes = code_rules();
    for (slot, key) in
        codes.digits.iter_mut().zip(["m_output_digits", "s_output_digits", "t_output_digits", "b_output_digits"])
    {
        let place = table.place_of(key);
        if let (Some(digits), Some(place)) = (table.integer(key), place) {
            match u8::try_from(digits) {
                Ok(digits @ 1..=8) => *slot = digits,
                _ => table.error(place, format!("{key} is a number from 1 to 8")),
            }
        }
    }
    if let Some(list) = table.integers("after_motion") {
        codes.m_after_motion = list.into_iter().filter_map(|code| u32::try_from(code).ok()).collect();
    }
    codes.b_after_motion = table.boolean("b_after_motion").unwrap_or(false);
    let single = table.table("time", times).unwrap_or_else(default_times);
    let place = table.place_of("fin_time");
    let other = table.number("fin_time").unwrap_or(0.05);
    if other < 0.0 {
        table.error(place.unwrap_or_default(), "fin_time must not be negative");
    }
    let times = CodeTimes { single, other: Seconds(other.max(0.0)) };
    let handshake = handshake_times(table, times.longest());
    Functions { codes, times, handshake, b_axis }
}

fn times(table: &mut Table) -> Vec<(CodeLine, Option<u32>, Seconds)> {
    let mut times = Vec::new();
    for entry in table.rest() {
        let (line, number) = entry.key.split_at(entry.key.len().min(1));
        let line = match line {
            "m" => Some(CodeLine::M),
            "s" => Some(CodeLine::S),
            "t" => Some(CodeLine::T),
            "b" => Some(CodeLine::B),
            _ => None,
        };
        let code = if number.is_empty() { Some(None) } else { number.parse().ok().map(Some) };
        let (Some(line), Some(code)) = (line, code) else {
            entry.error(format!("`{}` is no code; write m6 for one code, b for all of B", entry.key));
            continue;
        };
        match entry.number() {
            Some(seconds) if seconds >= 0.0 => times.push((line, code, Seconds(seconds))),
            Some(_) => entry.error("a time must not be negative"),
            None => {}
        }
    }
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stock_machine_is_what_a_file_with_the_required_keys_alone_gives() {
        let (name, text) = builtin_machine("stock-vmc").expect("it is built in");
        let stock = read_machine(&name, text).expect("it is right");
        let axis = "kind = \"linear\"\ntravel = [-1000.0, 1000.0]\n";
        let least = format!("name = \"stock-vmc\"\n[axes.X]\n{axis}[axes.Y]\n{axis}[axes.Z]\n{axis}");
        let mut least = read_machine("least.toml", &least).expect("it is enough");
        least.description.clone_from(&stock.description);
        assert_eq!(least, stock);
    }

    #[test]
    fn every_builtin_machine_is_right() {
        for name in builtin_machines() {
            let (file, text) = builtin_machine(name).expect("it is built in");
            assert!(read_machine(&file, text).is_ok_and(|machine| machine.name == name), "{name}");
        }
    }

    #[test]
    fn errors_name_their_line_and_key() {
        let text = "name = \"x\"\n[axes.X]\nkind = \"linear\"\ntravel = [1.0, -1.0]\nrapit = 5\n[axes.B]\nkind = \"rotary\"\ntravel = [0.0, 360.0]\n";
        let errors = read_machine("x.toml", text).expect_err("three errors");
        let said: Vec<_> = errors.iter().map(|e| format!("{}: {}", e.line, e.message)).collect();
        assert_eq!(
            said,
            [
                "4: travel is a list of two numbers, the lowest first",
                "5: `rapit` is not a known key, perhaps `rapid` is meant",
                "1: a B axis and the B function exclude each other; with [axes.B] set b_axis = true",
            ]
        );
    }
}
