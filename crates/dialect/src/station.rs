//! The operator's station of a control: its modes, the steps of its override switches, the speeds it is set to.

use crate::occasion::StateRow;
use crate::row::Origin;

/// What CYCLE START does in a mode.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ModeKind {
    /// Runs the selected program from memory.
    Memory,
    /// Runs the program from the tape reader.
    Tape,
    /// Runs the blocks typed at the panel.
    Mdi,
    /// Nothing: programs are loaded and changed.
    Edit,
    /// Nothing: an axis button moves its axis at the jog speed.
    Jog,
    /// Nothing: an axis button moves its axis by an increment.
    Step,
    /// Nothing: the pulse handle moves an axis by so many increments.
    Handle,
    /// Nothing: an axis button moves its axis at the rapid rate.
    Rapid,
    /// Nothing: an axis button returns its axis to the reference point.
    Return,
}

/// What a key beside the usual buttons does.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Key {
    /// Stops the program and resets the control.
    Reset,
    /// Turns to the mode of this name.
    Mode(String),
}

/// One position of the mode switch.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ModeRow {
    /// Its name in operators' scripts.
    pub name: String,
    /// What CYCLE START does in it.
    pub kind: ModeKind,
    /// What it is for, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// A switch of the panel.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SwitchRow {
    /// Its name in operators' scripts.
    pub name: String,
    /// What it does, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// What the pages of a control can show: a display of the station, or of the positions one of them.
pub const SHOWN: &[&str] = &[
    "modal",
    "position.universal",
    "position.work",
    "position.machine",
    "position.distance_to_go",
    "alarm",
    "alarms",
    "offsets",
    "works",
    "parameters",
    "variables",
    "program",
    "directory",
    "command",
    "diagnosis",
];

/// A page of the control's displays.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DisplayRow {
    /// The key that calls it.
    pub key: String,
    /// Its name.
    pub name: String,
    /// What it shows, one of [`SHOWN`].
    pub shows: String,
    /// What it is for, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// The station as the tables describe it.
#[derive(Clone, PartialEq, Debug)]
pub struct StationTable {
    /// The modes; the station begins in the first.
    pub modes: Vec<ModeRow>,
    /// The switches of the panel.
    pub switches: Vec<SwitchRow>,
    /// Steps of the override switches in percent: feed, rapid, spindle. No steps: the control has no such switch.
    pub overrides: [Vec<u16>; 3],
    /// The increments of mode step, mm or degrees.
    pub increments: Vec<f64>,
    /// Index of the parameter with the speed of DRY RUN, mm/min.
    pub jog_speed: usize,
    /// Index of the parameter that says whether DRY RUN replaces the rapid rate too.
    pub dry_run_rapid: usize,
    /// Index of the parameter with the rate of the lowest step of the rapid override, mm/min; `None`: the axes stand still.
    pub lowest_rapid: Option<usize>,
    /// Programs that can be registered.
    pub most_programs: usize,
    /// Index of the option with which there is no such limit.
    pub more_programs: Option<usize>,
    /// Index of the parameter whose bits protect ranges of program numbers.
    pub protection: Option<usize>,
    /// Those ranges, the first for D0.
    pub protected: Vec<[u32; 2]>,
    /// Keys beside the usual buttons, and what they do.
    pub keys: Vec<(String, Key)>,
    /// A program's end always resets the control, whatever is wired.
    pub end_resets: bool,
    /// M30 always goes back to the program's head, whatever is wired.
    pub end_rewinds: bool,
    /// Index of the parameter that says whether M02 does too: 0 = no, 1 = yes.
    pub m02_rewinds: Option<usize>,
    /// The pages of the displays, in the order of their keys.
    pub displays: Vec<DisplayRow>,
    /// What becomes of every state that is no modal group.
    pub states: Vec<StateRow>,
}

impl StationTable {
    /// True if one of the control's pages shows this display, or a part of it.
    pub fn shows(&self, display: &str) -> bool {
        self.displays.iter().any(|row| row.shows.split('.').next() == Some(display))
    }

    /// The mode of this name.
    pub fn mode(&self, name: &str) -> Option<&ModeRow> {
        self.modes.iter().find(|mode| mode.name == name)
    }
}
