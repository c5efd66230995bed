//! One control on one machine, set up: what a session starts from.

use std::sync::Arc;

use base::{AXES, AxisSet, Point};
use data::nearest;
use dialect::{AxisLetter, Control, Fitting, ParameterSetting};
use machine::MachineFile;
use meaning::{Memory, OffsetTable, Variables};

use crate::memory;
use crate::setup::{OffsetColumn, Setup};
use crate::switches::{self, SessionSwitches, Which};

/// A set-up that this control or machine refuses.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ConfigurationError(pub String);

impl std::fmt::Display for ConfigurationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for ConfigurationError {}

/// The inputs that can be held.
const INPUTS: &str = "EOP, RWD, skip, interrupt, FIN, UI0 to UI31";

/// Signals held by hand; `None` follows the machine's wiring.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Inputs {
    /// Internal reset input.
    pub eop: Option<bool>,
    /// Rewind input.
    pub rwd: Option<bool>,
    /// The interface inputs UI0 to UI31 that macros read, one bit each.
    pub interface: u32,
    /// Skip signal.
    pub skip: bool,
    /// Program interrupt: it acts in the moment in which it turns on.
    pub interrupt: bool,
}

impl Inputs {
    /// Holds an input.
    ///
    /// # Errors
    /// There is no such input.
    pub fn set(&mut self, name: &str, on: bool) -> Result<(), ConfigurationError> {
        match name {
            "EOP" => self.eop = Some(on),
            "RWD" => self.rwd = Some(on),
            "skip" => self.skip = on,
            "interrupt" => self.interrupt = on,
            "FIN" => return Err(wrong("`FIN` is given by an operator's script: input FIN on".to_owned())),
            "overtravel" | "servo-power" | "servo-fault" | "battery-low" | "memory-fault" => {
                return Err(wrong(format!("the input `{name}` is not built yet")));
            }
            _ => {
                let number = name.strip_prefix("UI").and_then(|digits| digits.parse::<u32>().ok());
                let Some(number @ 0..=31) = number else {
                    return Err(wrong(match nearest(name, ["EOP", "RWD", "skip", "interrupt", "FIN"].into_iter()) {
                        Some(near) => format!("there is no input `{name}`, perhaps `{near}` is meant"),
                        None => format!("there is no input `{name}`; the inputs are {INPUTS}"),
                    }));
                };
                self.interface = if on { self.interface | 1 << number } else { self.interface & !(1 << number) };
            }
        }
        Ok(())
    }
}

/// A control, its machine, and everything set on both.
#[derive(Clone, PartialEq, Debug)]
pub struct Configuration {
    /// The control.
    pub control: Arc<Control>,
    /// Options, policies, parameters.
    pub fitting: Fitting,
    /// The machine.
    pub machine: MachineFile,
    /// Offsets and work origins.
    pub memory: Memory,
    /// Origin of the base work system, counts.
    pub base_origin: Point,
    /// Where the axes stand at power-on, mm and degrees.
    pub start: Point,
    /// Axes that have not been returned to their reference point since power-on.
    pub not_returned: AxisSet,
    /// Where the skip signal comes: axes and machine coordinates, mm or degrees.
    pub contact: Vec<(usize, f64)>,
    /// The operator's switches.
    pub switches: SessionSwitches,
    /// Signals held by hand.
    pub inputs: Inputs,
    /// Inputs of the builder's that are held by hand.
    pub lines: Vec<(u8, bool)>,
}

fn wrong(message: impl Into<String>) -> ConfigurationError {
    ConfigurationError(message.into())
}

fn letter_of(axis: u8) -> String {
    char::from(axis).to_string()
}

impl Configuration {
    /// A control on a machine as they come, and the set-ups on top of them, later ones over earlier ones.
    ///
    /// # Errors
    /// The first thing that this control or machine does not have, or that excludes another.
    pub fn new(
        control: Arc<Control>,
        machine: MachineFile,
        setups: &[&Setup],
    ) -> Result<Configuration, ConfigurationError> {
        let fitting = Fitting::stock(&control);
        let lengths = OffsetTable::new(control.highest_offset);
        let variables = Variables::new(&control.user_macro, control.macro_levels);
        let radii = (!control.common_offsets).then(|| OffsetTable::new(control.highest_offset));
        let mut configuration = Configuration {
            memory: Memory { lengths, radii, variables, work: [[0.0; AXES]; 6], external: [0.0; AXES] },
            fitting,
            machine,
            base_origin: [0.0; AXES],
            start: [0.0; AXES],
            not_returned: AxisSet::NONE,
            contact: Vec::new(),
            switches: SessionSwitches::default(),
            inputs: Inputs::default(),
            lines: Vec::new(),
            control,
        };
        configuration.fit_axes(setups)?;
        for setup in setups {
            configuration.apply(setup)?;
        }
        configuration.check_start(setups)?;
        configuration.fitting.check_options(&configuration.control).map_err(|error| wrong(error.0))?;
        if configuration.fitting.options.tool_tip && configuration.machine.kinematics.is_none() {
            let name = &configuration.machine.name;
            return Err(wrong(format!(
                "option `tool-tip` wants [kinematics] in the machine's file, which says what tilts and turns; `{name}` has none"
            )));
        }
        configuration.fitting.check_tape_codes(&configuration.control).map_err(|error| wrong(error.0))?;
        Ok(configuration)
    }

    /// The axes cannot stand where they cannot get to.
    fn check_start(&self, setups: &[&Setup]) -> Result<(), ConfigurationError> {
        for (axis, &at) in self.machine.axes.iter().zip(&self.start) {
            let [low, high] = axis.travel;
            if at < low || at > high {
                let letter = letter_of(axis.letter);
                let message = format!("start {letter} = {at} lies outside the axis' travel {low} to {high}");
                let said = setups.iter().rfind(|setup| setup.start.iter().any(|&(named, _)| named == axis.letter));
                return Err(match said {
                    Some(setup) => setup.refuse(&["start", &letter], message),
                    None => wrong(message),
                });
            }
        }
        Ok(())
    }

    /// Gives the machine's axes the letters that the control has for them. An axis whose letter a parameter chooses has
    /// the machine's letter where the set-up does not choose; chosen otherwise it is what its new letter usually is,
    /// turning (A, B, C) or sliding.
    fn name_axes(&mut self, setups: &[&Setup]) -> Result<(), ConfigurationError> {
        let control = self.control.clone();
        if control.axes.is_empty() {
            return Ok(());
        }
        if self.machine.axes.len() > control.axes.len() {
            let (title, most, count) = (&control.title, control.axes.len(), self.machine.axes.len());
            return Err(wrong(format!("the {title} has {most} axes at most, the machine {count}")));
        }
        let settings = || setups.iter().flat_map(|setup| &setup.parameters);
        for (axis, own) in self.machine.axes.iter_mut().zip(&control.axes) {
            match *own {
                AxisLetter::Fixed(letter) if letter == axis.letter => {}
                AxisLetter::Fixed(letter) => {
                    let (title, own, other) = (&control.title, char::from(letter), char::from(axis.letter));
                    return Err(wrong(format!("the {title} has an axis {own} where the machine has {other}")));
                }
                AxisLetter::Parameter(index) => {
                    let Some(row) = control.parameters.get(index) else { continue };
                    let letter = match settings().rfind(|setting| setting.name.eq_ignore_ascii_case(&row.name)) {
                        Some(setting) => setting.value.trim().to_ascii_uppercase(),
                        None => char::from(axis.letter).to_string(),
                    };
                    let setting = ParameterSetting { name: row.name.clone(), bit: None, value: letter.clone() };
                    self.fitting.set_parameter(&control, &setting).map_err(|error| wrong(error.0))?;
                    let letter = letter.bytes().next().unwrap_or(axis.letter);
                    if letter != axis.letter {
                        let kind = control.address(letter).map(|address| address.kind);
                        axis.rotary = kind == Some(dialect::AddressKind::RotaryAxis);
                        axis.letter = letter;
                    }
                }
            }
        }
        Ok(())
    }

    /// What the machine's axes say of the control's options: a fourth axis, an axis B.
    fn fit_axes(&mut self, setups: &[&Setup]) -> Result<(), ConfigurationError> {
        let control = self.control.clone();
        let known = |letter: u8| {
            control.address(letter).is_some_and(|address| {
                use dialect::AddressKind::{LinearAxis, RotaryAxis};
                matches!(address.kind, LinearAxis | RotaryAxis) || letter == b'B'
            })
        };
        self.name_axes(setups)?;
        if let Some(axis) = self.machine.axes.iter().find(|axis| !known(axis.letter)) {
            return Err(wrong(format!("the {} has no axis {}", control.title, char::from(axis.letter))));
        }
        let has_option = |name: &str| control.options.iter().any(|row| row.name == name);
        let fourth = self.machine.axes.iter().any(|axis| !matches!(axis.letter, b'X' | b'Y' | b'Z'));
        if fourth && has_option("fourth-axis") {
            self.fitting.set_option(&control, "fourth-axis", true).map_err(|error| wrong(error.0))?;
        }
        let said = setups.iter().any(|setup| setup.options.iter().any(|(name, _)| name == "b-function"));
        if self.machine.b_axis && has_option("b-function") && !said {
            self.fitting.set_option(&control, "b-function", false).map_err(|error| wrong(error.0))?;
        }
        Ok(())
    }

    /// Sets what a set-up says.
    ///
    /// # Errors
    /// The first thing that this control or machine does not have.
    pub fn apply(&mut self, setup: &Setup) -> Result<(), ConfigurationError> {
        let control = self.control.clone();
        for (name, fitted) in &setup.options {
            let set = self.fitting.set_option(&control, name, *fitted);
            set.map_err(|error| setup.refuse(&["options", name], error.0))?;
        }
        for (name, value) in &setup.policies {
            let set = self.fitting.set_policy(&control, name, value);
            set.map_err(|error| setup.refuse(&["policies", name], error.0))?;
        }
        for setting in &setup.parameters {
            let set = self.fitting.set_parameter(&control, setting);
            set.map_err(|error| setup.refuse(&["parameters", &setting.name], error.0))?;
        }
        for (kind, name, value) in &setup.kept {
            self.take_kept(*kind, name, value)?;
        }
        for &(column, number, mm) in &setup.offsets {
            let set = self.set_offset(column, number, mm);
            set.map_err(|error| setup.refuse(&[column.table(), &number.to_string()], error.0))?;
        }
        for (system, axis, mm) in &setup.work {
            let set = self.set_work(system, *axis, *mm);
            set.map_err(|error| match memory::work_system(&control, &self.memory, system) {
                Ok(_) => setup.refuse(&["work", system, &letter_of(*axis)], error.0),
                Err(error) => setup.refuse(&["work", system], error.0),
            })?;
        }
        for &(letter, mm) in &setup.start {
            let axis = self.axis_in(setup, "start", letter)?;
            self.start[axis] = mm;
        }
        for &(letter, returned) in &setup.returned {
            let axis = AxisSet::only(self.axis_in(setup, "returned", letter)?);
            self.not_returned = if returned { self.not_returned.without(axis) } else { self.not_returned.or(axis) };
        }
        for &(letter, at) in &setup.contact {
            let axis = self.axis_in(setup, "contact", letter)?;
            self.contact.push((axis, at));
        }
        for (name, which) in &setup.switches {
            let set = self.check_switch(name, *which).and_then(|()| self.switches.set(name, *which, true));
            set.map_err(|error| setup.refuse(&["switches", name], error))?;
        }
        for (name, on) in &setup.inputs {
            if let Some(line) = self.machine.logic.input(name) {
                self.lines.push((line, *on));
                continue;
            }
            self.inputs.set(name, *on).map_err(|error| setup.refuse(&["inputs", name], error.0))?;
        }
        Ok(())
    }

    /// The axis that a table of the set-up names.
    /// Whether the control has this switch, and the machine its axis.
    ///
    /// # Errors
    /// It has not, in words.
    pub fn check_switch(&self, name: &str, which: Which) -> Result<(), String> {
        let rows = &self.control.station.switches;
        if switches::names().any(|known| known == name) && !rows.iter().any(|row| row.name == name) {
            let own: Vec<_> = rows.iter().map(|row| row.name.as_str()).collect();
            return Err(format!("the {} has no switch `{name}`; it has {}", self.control.title, own.join(", ")));
        }
        match which {
            Which::Axis(letter) => memory::axis_of(&self.machine, letter).map(|_| ()).map_err(|error| error.0),
            _ => Ok(()),
        }
    }

    fn axis_in(&self, setup: &Setup, table: &str, letter: u8) -> Result<usize, ConfigurationError> {
        let axis = memory::axis_of(&self.machine, letter);
        axis.map_err(|error| setup.refuse(&[table, &letter_of(letter)], error.0))
    }

    /// Writes an offset, mm.
    ///
    /// # Errors
    /// There is no such number, or the value is too large.
    pub fn set_offset(&mut self, column: OffsetColumn, number: u32, mm: f64) -> Result<(), ConfigurationError> {
        memory::write_offset(&self.control, &mut self.memory, column, number, mm)
    }

    /// Writes the origin of a work system on one axis, mm or degrees.
    ///
    /// # Errors
    /// There is no such system or axis.
    pub fn set_work(&mut self, system: &str, letter: u8, mm: f64) -> Result<(), ConfigurationError> {
        let axis = memory::axis_of(&self.machine, letter)?;
        let counts = (mm * 1e6).round();
        match memory::work_system(&self.control, &self.memory, system)? {
            memory::WorkSystem::Stored(index) => {
                if let Some(origin) = self.memory.work.get_mut(index) {
                    origin[axis] = counts;
                }
            }
            memory::WorkSystem::External => self.memory.external[axis] = counts,
            memory::WorkSystem::Base => self.base_origin[axis] = counts,
        }
        Ok(())
    }
}
