//! `[path]` of a machine file: how its control leads the axes from block to block.

use data::Table;
use motion::{Classic, Model};

/// How the control leads the axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PathTable {
    /// How motion follows from the path.
    pub model: Model,
    /// How far a corner that is passed without a stop may be left, mm.
    pub corner_tolerance: f64,
    /// True if rapid positioning runs in a straight line.
    pub straight_rapid: bool,
    /// The time from one setpoint to the next, s.
    pub servo_period: f64,
}

/// What a file without `[path]` means.
impl Default for PathTable {
    fn default() -> Self {
        PathTable { model: Model::Trapezoid, corner_tolerance: 0.01, straight_rapid: false, servo_period: 0.001 }
    }
}

/// What missing keys of model `classic` mean.
const CLASSIC: Classic = Classic { rapid_s: 0.10, feed_s: 0.05, block_s: 0.0, buffer: 2, in_position_mm: 0.01 };

/// Which model a file names.
#[derive(Clone, Copy)]
enum Named {
    Trapezoid,
    Jerk,
    Classic,
}

/// Reads `[path]`. What is told of another model than the one in use is read all the same, so that a slip in it shows.
pub(crate) fn path(table: &mut Table) -> PathTable {
    let default = PathTable::default();
    let model =
        table.choice("model", &[("trapezoid", Named::Trapezoid), ("jerk", Named::Jerk), ("classic", Named::Classic)]);
    let corner_tolerance = not_negative(table, "corner_tolerance", default.corner_tolerance);
    let straight_rapid = table.boolean("straight_rapid").unwrap_or(default.straight_rapid);
    let servo_period = positive(table, "servo_period", default.servo_period);
    let constants = |t: &mut Table| [positive(t, "rapid", CLASSIC.rapid_s), positive(t, "feed", CLASSIC.feed_s)];
    let [rapid_s, feed_s] = table.table("time_constant", constants).unwrap_or([CLASSIC.rapid_s, CLASSIC.feed_s]);
    let block_s = not_negative(table, "block_time", CLASSIC.block_s);
    let buffer = buffer(table);
    let in_position_mm = positive(table, "in_position", CLASSIC.in_position_mm);
    let model = match model {
        None | Some(Named::Trapezoid) => Model::Trapezoid,
        Some(Named::Jerk) => Model::Jerk,
        Some(Named::Classic) => Model::Classic(Classic { rapid_s, feed_s, block_s, buffer, in_position_mm }),
    };
    PathTable { model, corner_tolerance, straight_rapid, servo_period }
}

/// Two blocks, four under tool radius compensation, seven with the multi-active register of the YASNAC.
fn buffer(table: &mut Table) -> u32 {
    let place = table.place_of("buffer").unwrap_or_default();
    match table.integer("buffer") {
        None => CLASSIC.buffer,
        Some(2) => 2,
        Some(4) => 4,
        Some(7) => 7,
        Some(_) => {
            table.error(place, "buffer is 2, 4 or 7, the blocks that the control holds ready");
            CLASSIC.buffer
        }
    }
}

/// A number above zero.
pub(crate) fn positive(table: &mut Table, key: &'static str, default: f64) -> f64 {
    number(table, key, default, |value| value > 0.0, "greater than zero")
}

/// A number not below zero.
pub(crate) fn not_negative(table: &mut Table, key: &'static str, default: f64) -> f64 {
    number(table, key, default, |value| value >= 0.0, "zero or more")
}

fn number(table: &mut Table, key: &'static str, default: f64, is_right: fn(f64) -> bool, asked: &str) -> f64 {
    let place = table.place_of(key).unwrap_or_default();
    match table.number(key) {
        None => default,
        Some(value) if is_right(value) => value,
        Some(_) => {
            table.error(place, format!("{key} must be {asked}"));
            default
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{MachineFile, read_machine};

    fn read(lines: &str) -> Result<MachineFile, Vec<String>> {
        let axis = "kind = \"linear\"\ntravel = [-1.0, 1.0]\n";
        let text = format!("name = \"x\"\n[axes.X]\n{axis}jerk = 5000\n[axes.Y]\n{axis}[path]\n{lines}");
        let said = |errors: Vec<data::DataError>| errors.iter().map(|e| format!("{}: {}", e.line, e.message)).collect();
        read_machine("x.toml", &text).map_err(said)
    }

    #[test]
    fn a_file_without_keys_is_the_trapezoid_with_the_values_of_the_template() {
        let limits = read("").expect("it is right").limits();
        assert_eq!((limits.model, limits.straight_rapid), (Model::Trapezoid, false));
        assert_eq!((limits.corner_tolerance, limits.servo_period), (0.01, 0.001));
        assert_eq!((limits.axes[0].jerk, limits.axes[1].jerk), (5000.0, f64::INFINITY), "0 is not limited");
    }

    #[test]
    fn every_key_reaches_motion() {
        let limits = read("model = \"jerk\"\ncorner_tolerance = 0\nservo_period = 0.002\nstraight_rapid = true\n")
            .expect("it is right")
            .limits();
        assert_eq!((limits.model, limits.straight_rapid), (Model::Jerk, true));
        assert_eq!((limits.corner_tolerance, limits.servo_period), (0.0, 0.002));
        let classic =
            "time_constant = { rapid = 0.2, feed = 0.03 }\nblock_time = 0.04\nbuffer = 7\nin_position = 0.02\n";
        let limits = read(&format!("model = \"classic\"\n{classic}")).expect("it is right").limits();
        let told = Classic { rapid_s: 0.2, feed_s: 0.03, block_s: 0.04, buffer: 7, in_position_mm: 0.02 };
        assert_eq!(limits.model, Model::Classic(told));
        // Told of a model that is not in use.
        assert_eq!(read(classic).expect("it is right").limits().model, Model::Trapezoid);
    }

    #[test]
    fn classic_has_defaults() {
        let model = read("model = \"classic\"\n").expect("it is right").limits().model;
        assert_eq!(model, Model::Classic(CLASSIC));
        let model = read("model = \"classic\"\ntime_constant = { feed = 0.03 }\n").expect("it is right").limits().model;
        assert_eq!(model, Model::Classic(Classic { feed_s: 0.03, ..CLASSIC }));
    }

    #[test]
    fn wrong_values_are_named() {
        let rows = [
            ("model = \"clasic\"", "10: model = \"clasic\" is not one of trapezoid, jerk, classic"),
            ("corner_tolerance = -0.1", "10: corner_tolerance must be zero or more"),
            ("servo_period = 0", "10: servo_period must be greater than zero"),
            ("time_constant = { rapid = 0 }", "10: rapid must be greater than zero"),
            ("time_constant = { feed = -1 }", "10: feed must be greater than zero"),
            ("time_constant = { fead = 1 }", "10: `fead` is not a known key, perhaps `feed` is meant"),
            ("block_time = -1", "10: block_time must be zero or more"),
            ("buffer = 3", "10: buffer is 2, 4 or 7, the blocks that the control holds ready"),
            ("in_position = 0.0", "10: in_position must be greater than zero"),
            ("block_time = nan", "10: `block_time` wants a finite number"),
        ];
        for (line, said) in rows {
            assert_eq!(read(line).expect_err(line), [said], "{line}");
        }
    }
}
