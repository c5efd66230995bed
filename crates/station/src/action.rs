//! The operator's actions as values, and back in words: the same vocabulary for scripts, tests and a panel.

use std::fmt;

use crate::block_target::BlockTarget;
use crate::edit::Edit;
use crate::fault::Fault;
use crate::setup::OffsetColumn;
use crate::switches::Which;

/// What to show.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Show {
    /// The codes in force.
    Modal,
    /// Where the axes are.
    Position,
    /// The machine: what goes out to it and comes from it.
    Machine,
    /// The alarms that stand.
    Alarm,
    /// The alarms that have been.
    Alarms,
    /// An offset.
    Offset(OffsetColumn, u32),
    /// Every offset.
    Offsets,
    /// The origin of a work system.
    Work(String),
    /// Every origin, and what shifts them.
    Works,
    /// A parameter, or one bit of it.
    Parameter(String, Option<u8>),
    /// Every parameter.
    Parameters,
    /// A macro variable.
    Variable(u32),
    /// Every variable that holds something.
    Variables,
    /// The programs in memory.
    Directory,
    /// The blocks that the control holds: the one being executed and those read ahead.
    Command,
    /// The lines between control and machine.
    Diagnosis,
    /// The pages that the control has.
    Displays,
    /// The feed.
    Feed,
    /// The program page: what is selected, and the words in force.
    Program,
    /// What the station is doing.
    State,
}

/// How long to run.
#[derive(Clone, PartialEq, Debug)]
pub enum Until {
    /// Until automatic operation stops.
    Stop,
    /// Until the program ends.
    End,
    /// Until an alarm.
    Alarm,
    /// Until nothing more happens by itself.
    Idle,
    /// Until the control begins to execute this source line.
    Line(u64),
    /// For so many seconds.
    Seconds(f64),
}

/// An override switch.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum OverrideSwitch {
    /// Of the cutting feed.
    Feed,
    /// Of the rapid rate.
    Rapid,
    /// Of the spindle speed.
    Spindle,
}

impl OverrideSwitch {
    /// Its name in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            OverrideSwitch::Feed => "feed",
            OverrideSwitch::Rapid => "rapid",
            OverrideSwitch::Spindle => "spindle",
        }
    }
}

/// An action of the operator.
#[derive(Clone, PartialEq, Debug)]
pub enum Action {
    /// `power-on`
    PowerOn,
    /// `power-off`
    PowerOff,
    /// `load FILE [as NAME]`
    Load(String, Option<String>),
    /// `select NAME`
    Select(String),
    /// `mode MODE`
    Mode(String),
    /// `mdi BLOCK`
    Mdi(String),
    /// `cycle-start`
    CycleStart,
    /// `feed-hold`
    FeedHold,
    /// `reset`
    Reset,
    /// `key F10`
    Key(String),
    /// `emergency-stop`
    EmergencyStop,
    /// `release`
    Release,
    /// `switch NAME on|off`
    Switch(String, Which, bool),
    /// `override feed|rapid|spindle N`
    Override(OverrideSwitch, u16),
    /// `input NAME on|off`
    Input(String, bool),
    /// `offset 31 = 10.0`, mm
    Offset(OffsetColumn, u32, f64),
    /// `touch 31 [at MM]`: the offset of the tool that touches something of this height, mm
    Touch(OffsetColumn, u32, f64),
    /// `work G54 X = 100.0`, mm or degrees
    Work(String, u8, f64),
    /// `origin X`, `origin Z = 100`, `origin all`: what the UNIVERSAL display shows of an axis where it stands, mm or
    /// degrees; without an axis all of them
    Origin(Option<u8>, f64),
    /// `parameter 6005.2 = 1`
    Parameter(dialect::ParameterSetting),
    /// `variable 500 = 1.5`; no value makes it blank
    Variable(u32, Option<f64>),
    /// `fault …`
    Fault(Fault),
    /// `show …`
    Show(Show),
    /// `run until …`
    Run(Until),
    /// `jog X + [for SECONDS]`: upwards or not
    Jog(u8, bool, Option<f64>),
    /// `step X + 0.01`, mm or degrees, with its sign
    Step(u8, f64),
    /// `home X`
    Home(u8),
    /// `restart [O1234] line N|N50 [pass P]`
    Restart(BlockTarget),
    /// `restart confirm`
    ConfirmRestart,
    /// `search N50`, `search O1234`
    Search(String),
    /// `edit …`
    Edit(Edit),
    /// `tape FILE`: a tape is put into the reader
    Tape(String),
    /// `verify [O1234]`: the tape in the reader is compared with memory
    Verify(Option<String>),
}

/// How a script writes the offset's cell.
fn cell(column: OffsetColumn, number: u32) -> String {
    match column {
        OffsetColumn::Common => number.to_string(),
        OffsetColumn::Length => format!("H{number}"),
        OffsetColumn::Radius => format!("D{number}"),
    }
}

impl Show {
    /// The display of the control that this is, or is a part of; `None` for what every station shows.
    pub const fn display(&self) -> Option<&'static str> {
        Some(match self {
            Show::Modal => "modal",
            Show::Position => "position",
            Show::Alarm => "alarm",
            Show::Alarms => "alarms",
            Show::Offset(..) | Show::Offsets => "offsets",
            Show::Work(_) | Show::Works => "works",
            Show::Parameter(..) | Show::Parameters => "parameters",
            Show::Variable(_) | Show::Variables => "variables",
            Show::Program => "program",
            Show::Directory => "directory",
            Show::Command => "command",
            Show::Diagnosis => "diagnosis",
            Show::Machine | Show::Feed | Show::State | Show::Displays => return None,
        })
    }
}

impl fmt::Display for Show {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Show::Modal => f.write_str("modal"),
            Show::Position => f.write_str("position"),
            Show::Machine => f.write_str("machine"),
            Show::Alarm => f.write_str("alarm"),
            Show::Offset(column, number) => write!(f, "offset {}", cell(*column, *number)),
            Show::Alarms => f.write_str("alarms"),
            Show::Offsets => f.write_str("offsets"),
            Show::Works => f.write_str("works"),
            Show::Parameters => f.write_str("parameters"),
            Show::Variables => f.write_str("variables"),
            Show::Directory => f.write_str("directory"),
            Show::Command => f.write_str("command"),
            Show::Diagnosis => f.write_str("diagnosis"),
            Show::Displays => f.write_str("displays"),
            Show::Work(system) => write!(f, "work {system}"),
            Show::Parameter(name, None) => write!(f, "parameter {name}"),
            Show::Parameter(name, Some(bit)) => write!(f, "parameter {name}.{bit}"),
            Show::Variable(number) => write!(f, "variable {number}"),
            Show::Feed => f.write_str("feed"),
            Show::Program => f.write_str("program"),
            Show::State => f.write_str("state"),
        }
    }
}

impl fmt::Display for Until {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Until::Stop => f.write_str("until stop"),
            Until::End => f.write_str("until end"),
            Until::Alarm => f.write_str("until alarm"),
            Until::Idle => f.write_str("until idle"),
            Until::Line(line) => write!(f, "until line {line}"),
            Until::Seconds(seconds) => write!(f, "for {seconds}"),
        }
    }
}

impl fmt::Display for Action {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let state = |on: &bool| if *on { "on" } else { "off" };
        match self {
            Action::PowerOn => f.write_str("power-on"),
            Action::PowerOff => f.write_str("power-off"),
            Action::Load(file, None) => write!(f, "load {file}"),
            Action::Load(file, Some(name)) => write!(f, "load {file} as {name}"),
            Action::Select(name) => write!(f, "select {name}"),
            Action::Mode(name) => write!(f, "mode {name}"),
            Action::Mdi(blocks) => write!(f, "mdi {blocks}"),
            Action::CycleStart => f.write_str("cycle-start"),
            Action::FeedHold => f.write_str("feed-hold"),
            Action::Reset => f.write_str("reset"),
            Action::Key(name) => write!(f, "key {name}"),
            Action::EmergencyStop => f.write_str("emergency-stop"),
            Action::Release => f.write_str("release"),
            Action::Switch(name, which, on) => write!(f, "switch {name}{} {}", which.suffix(), state(on)),
            Action::Override(switch, percent) => write!(f, "override {} {percent}", switch.name()),
            Action::Input(name, on) => write!(f, "input {name} {}", state(on)),
            Action::Offset(column, number, mm) => write!(f, "offset {} = {mm}", cell(*column, *number)),
            Action::Touch(column, number, 0.0) => write!(f, "touch {}", cell(*column, *number)),
            Action::Touch(column, number, mm) => write!(f, "touch {} at {mm}", cell(*column, *number)),
            Action::Work(system, axis, mm) => write!(f, "work {system} {} = {mm}", char::from(*axis)),
            Action::Origin(None, _) => f.write_str("origin all"),
            Action::Origin(Some(axis), 0.0) => write!(f, "origin {}", char::from(*axis)),
            Action::Origin(Some(axis), mm) => write!(f, "origin {} = {mm}", char::from(*axis)),
            Action::Parameter(setting) => match setting.bit {
                None => write!(f, "parameter {} = {}", setting.name, setting.value),
                Some(bit) => write!(f, "parameter {}.{bit} = {}", setting.name, setting.value),
            },
            Action::Variable(number, Some(value)) => write!(f, "variable {number} = {value}"),
            Action::Variable(number, None) => write!(f, "variable {number} = blank"),
            Action::Fault(fault) => write!(f, "fault {fault}"),
            Action::Show(show) => write!(f, "show {show}"),
            Action::Run(until) => write!(f, "run {until}"),
            Action::Jog(axis, up, seconds) => {
                write!(f, "jog {} {}", char::from(*axis), if *up { '+' } else { '-' })?;
                seconds.map_or(Ok(()), |seconds| write!(f, " for {seconds}"))
            }
            Action::Step(axis, way) => {
                write!(f, "step {} {} {}", char::from(*axis), if *way < 0.0 { '-' } else { '+' }, way.abs())
            }
            Action::Home(axis) => write!(f, "home {}", char::from(*axis)),
            Action::Restart(target) => write!(f, "restart {target}"),
            Action::Search(wanted) => write!(f, "search {wanted}"),
            Action::Edit(edit) => write!(f, "edit {edit}"),
            Action::Tape(file) => write!(f, "tape {file}"),
            Action::Verify(None) => f.write_str("verify"),
            Action::Verify(Some(name)) => write!(f, "verify {name}"),
            Action::ConfirmRestart => f.write_str("restart confirm"),
        }
    }
}
