//! The panel's pages: offsets, work shifts, parameters, variables.

use base::AXES;
use dialect::{AxisLetter, ParameterSetting, TouchOff, VariableMeaning};

use super::Operator;
use crate::action::{Action, OverrideSwitch};
use crate::library::Library;
use crate::memory::{self, WorkSystem};
use crate::session::Percents;
use crate::setup::OffsetColumn;

impl<L: Library> Operator<L> {
    /// Writes what the action says; why not, if it cannot.
    pub(super) fn write(&mut self, action: &Action) -> Result<(), String> {
        match action {
            Action::Switch(name, number, on) => self.session.set_switch(name, *number, *on),
            Action::Input(name, on) => self.session.set_input(name, *on),
            Action::Override(switch, percent) => self.turn_override(*switch, *percent),
            Action::Offset(column, number, mm) => self.write_offset(*column, *number, *mm),
            Action::Touch(column, number, height) => self.touch_off(*column, *number, *height),
            Action::Origin(axis, shown) => self.set_origin(*axis, *shown),
            Action::Work(system, axis, mm) => self.write_work(system, *axis, *mm),
            Action::Parameter(setting) => self.write_parameter(setting),
            Action::Variable(number, value) => self.write_variable(*number, *value),
            _ => Ok(()),
        }
    }

    fn turn_override(&mut self, switch: OverrideSwitch, percent: u16) -> Result<(), String> {
        let station = &self.session.configuration().control.station;
        let steps = &station.overrides[switch as usize];
        let name = switch.name();
        if !steps.contains(&percent) {
            return Err(match (&steps[..], steps.last()) {
                ([], _) | (_, None) => format!("this control has no {name} override"),
                ([first, second, ..], Some(last)) => {
                    format!("the {name} override has the steps {first}, {second} … {last} %")
                }
                ([only], _) => format!("the {name} override has the step {only} % alone"),
            });
        }
        let percents = self.session.percents();
        self.session.set_percents(match switch {
            OverrideSwitch::Feed => Percents { feed: percent, ..percents },
            OverrideSwitch::Rapid => Percents { rapid: percent, ..percents },
            OverrideSwitch::Spindle => Percents { spindle: percent, ..percents },
        });
        Ok(())
    }

    fn write_offset(&mut self, column: OffsetColumn, number: u32, mm: f64) -> Result<(), String> {
        let control = self.session.configuration().control.clone();
        let memory = self.session.interpreter_mut().memory_mut();
        memory::write_offset(&control, memory, memory::named_column(&control, column), number, mm)
            .map_err(|error| error.0)
    }

    /// Tool length by touching off: where the tool's axis stands, less the height of what the tool touches.
    fn touch_off(&mut self, column: OffsetColumn, number: u32, height: f64) -> Result<(), String> {
        if column == OffsetColumn::Radius {
            return Err("the length of a tool is touched off, not its radius".to_owned());
        }
        let session = &self.session;
        let Some(axis) = session.tool_axis() else { return Err("the machine has no axis Z".to_owned()) };
        let interpreter = session.interpreter();
        let place = match interpreter.fitting().policies.touch_off {
            TouchOff::Relative => session.universal_display()[axis],
            TouchOff::Work => session.work_display()[axis] + interpreter.executing_state().length / 1e6,
            TouchOff::Machine => session.position()[axis],
        };
        let increment = interpreter.control().increments[0] as f64 / 1e6;
        self.write_offset(column, number, ((place - height) / increment).round() * increment)
    }

    /// ORG: what the UNIVERSAL display shows of an axis, or of all of them, where they stand.
    fn set_origin(&mut self, letter: Option<u8>, shown: f64) -> Result<(), String> {
        let machine = &self.session.configuration().machine;
        let axes = match letter {
            Some(letter) => {
                let axis = memory::axis_of(machine, letter).map_err(|error| error.0)?;
                axis..axis + 1
            }
            None => 0..machine.axes.len().min(AXES),
        };
        if (shown * 1e6).abs() > MOST_COUNTS {
            return Err(format!("no display shows a number as large as {shown}"));
        }
        axes.for_each(|axis| self.session.preset_universal(axis, shown));
        Ok(())
    }

    fn write_work(&mut self, system: &str, letter: u8, mm: f64) -> Result<(), String> {
        let configuration = self.session.configuration();
        let control = configuration.control.clone();
        let axis = memory::axis_of(&configuration.machine, letter).map_err(|error| error.0)?;
        // An alarm in mid-program is followed by RESET, which brings back what the program had.
        let running = self.session.is_in_program();
        let interpreter = self.session.interpreter_mut();
        let counts = (mm * 1e6).round();
        if counts.abs() > MOST_COUNTS {
            return Err(format!("work {system} {} = {mm}: no work shift is as large as this", char::from(letter)));
        }
        match memory::work_system(&control, interpreter.memory(), system).map_err(|error| error.0)? {
            WorkSystem::Stored(index) => {
                if let Some(origin) = interpreter.memory_mut().work.get_mut(index) {
                    origin[axis] = counts;
                }
            }
            WorkSystem::External => interpreter.memory_mut().external[axis] = counts,
            WorkSystem::Base if running => {
                return Err(format!("{system} is the program's own until it has ended or RESET is pressed"));
            }
            WorkSystem::Base => interpreter.set_base_origin(axis, counts),
        }
        Ok(())
    }

    fn write_parameter(&mut self, setting: &ParameterSetting) -> Result<(), String> {
        let control = self.session.configuration().control.clone();
        let names_axis = |axis: &AxisLetter| match axis {
            AxisLetter::Parameter(index) => {
                control.parameters.get(*index).is_some_and(|row| row.name.eq_ignore_ascii_case(&setting.name))
            }
            AxisLetter::Fixed(_) => false,
        };
        if control.axes.iter().any(names_axis) {
            return Err(format!(
                "the machine's axes have their letters from `{}` when it is set up: say it with --parameter or in the set-up file",
                setting.name
            ));
        }
        let interpreter = self.session.interpreter_mut();
        interpreter.store_codes();
        let before = interpreter.fitting().clone();
        let fitting = interpreter.fitting_mut();
        let written = fitting.set_parameter(&control, setting).and_then(|()| fitting.check_tape_codes(&control));
        if let Err(error) = written {
            *interpreter.fitting_mut() = before;
            return Err(error.0);
        }
        // A tape may be read in another code now.
        interpreter.forget_texts();
        self.session.take_parameters();
        Ok(())
    }

    fn write_variable(&mut self, number: u32, value: Option<f64>) -> Result<(), String> {
        let running = self.session.is_running();
        let interpreter = self.session.interpreter_mut();
        if !interpreter.fitting().options.user_macro {
            return Err("the option user-macro is not fitted".to_owned());
        }
        let row = interpreter.control().user_macro.variable(number);
        if !running && row.is_some_and(|row| row.meaning == VariableMeaning::Local) {
            return Err(format!("variable {number} is local: it is written while a program runs"));
        }
        match interpreter.set_variable(number, value) {
            true => Ok(()),
            false => Err(format!("there is no variable {number} that is written by hand")),
        }
    }
}

/// The largest work shift, nanometres or microdegrees: as many digits as an axis word can have.
const MOST_COUNTS: f64 = 99_999_999_000.0;
