//! One machine's fitting of a control: which options it has, how the policies are set, its parameters.

use std::fmt;

use data::nearest;
use tape::{CodeError, Codes};

use crate::control::Control;
use crate::policy::{KNOWN, Options, Policies};
use crate::row::{Division, ParameterKind, ParameterRow};

/// A parameter as a user sets it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ParameterSetting {
    /// Its number or name.
    pub name: String,
    /// One bit alone, if only that is set.
    pub bit: Option<u8>,
    /// The value as written: a number, `0b…`, or eight digits D7 to D0.
    pub value: String,
}

/// A fitting that the control refuses.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FittingError(pub String);

impl fmt::Display for FittingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for FittingError {}

/// Options, policies and parameters as they stand on one machine.
#[derive(Clone, PartialEq, Debug)]
pub struct Fitting {
    fitted: Vec<bool>,
    /// Index of each policy's value, in the order of the control's rows.
    chosen: Vec<usize>,
    /// The options that code asks for.
    pub options: Options,
    /// The policies that code reads.
    pub policies: Policies,
    parameters: Vec<f64>,
}

/// Options that the machine's axes decide.
pub(crate) const FROM_AXES: &[&str] = &["fourth-axis"];

fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a str>) -> FittingError {
    let known: Vec<_> = known.collect();
    // The number nearest to a number says nothing.
    let near = nearest(name, known.iter().copied()).filter(|_| !name.bytes().all(|b| b.is_ascii_digit()));
    FittingError(match near {
        Some(near) => format!("there is no {what} `{name}` on this control, perhaps `{near}` is meant"),
        None => format!("there is no {what} `{name}` on this control; it has: {}", known.join(", ")),
    })
}

impl Fitting {
    /// The control as it comes: every default.
    pub fn stock(control: &Control) -> Fitting {
        let mut fitting = Fitting {
            fitted: control.options.iter().map(|row| row.default).collect(),
            chosen: control.policies.iter().map(|row| row.default).collect(),
            options: Options::default(),
            policies: Policies::default(),
            parameters: control.parameters.iter().map(|row| row.default).collect(),
        };
        for row in &control.options {
            fitting.options.set(&row.name, row.default);
        }
        for row in &control.policies {
            fitting.policies.set(&row.name, row.values.get(row.default).map_or("", String::as_str));
        }
        fitting
    }

    /// Fits or removes an option.
    ///
    /// # Errors
    /// The control has no such option, or one that is fitted excludes it.
    pub fn set_option(&mut self, control: &Control, name: &str, fitted: bool) -> Result<(), FittingError> {
        let Some(index) = control.options.iter().position(|row| row.name == name) else {
            return Err(unknown("option", name, control.options.iter().map(|row| row.name.as_str())));
        };
        if !control.asks_for(name) && fitted != control.options[index].default {
            let state = if fitted { "on" } else { "off" };
            return Err(FittingError(format!("option `{name}` = {state} is not built yet: it would have no effect")));
        }
        self.fitted[index] = fitted;
        self.options.set(name, fitted);
        Ok(())
    }

    /// Refuses options that cannot be fitted together; to be called when all are set.
    ///
    /// # Errors
    /// Two fitted options exclude each other.
    pub fn check_options(&self, control: &Control) -> Result<(), FittingError> {
        for (index, row) in control.options.iter().enumerate() {
            if !self.fitted[index] {
                continue;
            }
            for other in &row.excludes {
                if self.has_option(control, other) {
                    let source = &row.origin.source;
                    return Err(FittingError(format!(
                        "the options `{}` and `{other}` exclude each other on the {} ({source}); turn one of them off",
                        row.name, control.title
                    )));
                }
            }
        }
        Ok(())
    }

    /// True if the option is fitted.
    pub fn has_option(&self, control: &Control, name: &str) -> bool {
        control.options.iter().zip(&self.fitted).any(|(row, &fitted)| fitted && row.name == name)
    }

    /// Most programs that memory takes; `None` for no limit.
    pub fn most_programs(&self, control: &Control) -> Option<usize> {
        let more = control.station.more_programs.and_then(|index| self.fitted.get(index)).copied().unwrap_or(false);
        (!more).then_some(control.station.most_programs)
    }

    /// True if a setting protects the program of this number.
    pub fn protects(&self, control: &Control, number: u32) -> bool {
        let Some(protection) = control.station.protection else { return false };
        let bits = self.bits(protection);
        let mut ranges = control.station.protected.iter().enumerate();
        ranges.any(|(bit, [low, high])| bits >> bit & 1 == 1 && (*low..=*high).contains(&number))
    }

    /// True if a control of this fitting has a code of this division.
    pub fn has(&self, division: Division) -> bool {
        match division {
            Division::Basic => true,
            Division::Option(index) => self.fitted.get(usize::from(index)).copied().unwrap_or(false),
            Division::Sibling => false,
        }
    }

    /// Sets a policy.
    ///
    /// # Errors
    /// The control has no such policy, or the policy no such value.
    pub fn set_policy(&mut self, control: &Control, name: &str, value: &str) -> Result<(), FittingError> {
        let Some(index) = control.policies.iter().position(|row| row.name == name) else {
            return Err(unknown("policy", name, control.policies.iter().map(|row| row.name.as_str())));
        };
        let row = &control.policies[index];
        let Some(choice) = row.values.iter().position(|known| known == value) else {
            return Err(FittingError(format!("policy `{name}` is one of {}, not `{value}`", row.values.join(", "))));
        };
        if !KNOWN.iter().any(|(known, _)| *known == name) && row.values.get(row.default).is_none_or(|d| d != value) {
            return Err(FittingError(format!("policy `{name}` = {value} is not built yet: it would have no effect")));
        }
        self.policies.set(name, value);
        self.chosen[index] = choice;
        Ok(())
    }

    /// The value that the policy of this row has.
    pub fn policy_value<'c>(&self, control: &'c Control, row: usize) -> &'c str {
        let values = control.policies.get(row).map(|policy| &policy.values);
        values.zip(self.chosen.get(row)).and_then(|(values, &index)| values.get(index)).map_or("", String::as_str)
    }

    /// Writes a parameter or one bit of it.
    ///
    /// # Errors
    /// The control has no such parameter, or the value does not fit it.
    pub fn set_parameter(&mut self, control: &Control, setting: &ParameterSetting) -> Result<(), FittingError> {
        let name = &setting.name;
        let Some(index) = control.parameters.iter().position(|row| row.name.eq_ignore_ascii_case(name)) else {
            return Err(unknown("parameter", name, control.parameters.iter().map(|row| row.name.as_str())));
        };
        let row = &control.parameters[index];
        let bit = setting.bit.map_or_else(String::new, |bit| format!(".{bit}"));
        let wrong = |why: &str| FittingError(format!("parameter {name}{bit} = {}: {why}", setting.value));
        let value = parse_value(&setting.value, row).ok_or_else(|| {
            let values = row.values.join(", ");
            wrong(&match row.kind {
                ParameterKind::Bits => {
                    "it has eight bits, as 0b100, as eight digits D7 to D0, or as a number up to 255".to_owned()
                }
                ParameterKind::Length | ParameterKind::Number => "this is no number".to_owned(),
                ParameterKind::Choice => format!("it is one of {values}"),
            })
        })?;
        if let Some(bit) = setting.bit {
            if row.kind != ParameterKind::Bits || bit > 7 {
                return Err(wrong("it has no such bit"));
            }
            if value != 0.0 && value != 1.0 {
                return Err(wrong("a bit is 0 or 1"));
            }
            let others = self.bits(index) & !(1 << bit);
            self.parameters[index] = f64::from(others | (u8::from(value == 1.0) << bit));
            return Ok(());
        }
        if let Some([low, high]) = row.range
            && (value < low || value > high)
        {
            return Err(wrong(&format!("its range is {low} to {high}")));
        }
        if row.kind == ParameterKind::Bits && !(0.0..=255.0).contains(&value) {
            return Err(wrong("it has eight bits"));
        }
        self.parameters[index] = value;
        Ok(())
    }

    /// Writes a parameter that the control itself keeps.
    pub(crate) fn write(&mut self, index: usize, value: f64) {
        if let Some(parameter) = self.parameters.get_mut(index) {
            *parameter = value;
        }
    }

    /// The value of the parameter with this index.
    pub fn parameter(&self, index: usize) -> f64 {
        self.parameters.get(index).copied().unwrap_or(0.0)
    }

    /// The value of a parameter that not every control has; 0 without one.
    pub fn parameter_if_any(&self, index: Option<usize>) -> f64 {
        index.map_or(0.0, |index| self.parameter(index))
    }

    /// The value of a parameter by its number or name.
    pub fn parameter_by_name(&self, control: &Control, name: &str) -> Option<f64> {
        let index = control.parameters.iter().position(|row| row.name.eq_ignore_ascii_case(name))?;
        self.parameters.get(index).copied()
    }

    /// The tape codes as the parameters have them; `None` on a control without tapes.
    pub fn tape_codes(&self, control: &Control) -> Option<Codes> {
        let mut codes = Codes::default();
        for &(character, index) in &control.tape.as_ref()?.eia_codes {
            // What cannot be a character's row was refused when it was set.
            let _ = codes.assign(character, self.bits(index));
        }
        Some(codes)
    }

    /// True if the number of characters of a block on tape must be even.
    pub fn checks_block_parity(&self, control: &Control) -> bool {
        control.tape.as_ref().is_some_and(|tape| {
            let (index, bit) = tape.block_parity;
            self.bits(index) & (1 << bit) != 0
        })
    }

    /// Refuses EIA rows that cannot be a character's; to be called when all parameters are set.
    ///
    /// # Errors
    /// A row has an even number of holes, or belongs to another character.
    pub fn check_tape_codes(&self, control: &Control) -> Result<(), FittingError> {
        let mut codes = Codes::default();
        for &(character, index) in control.tape.iter().flat_map(|tape| &tape.eia_codes) {
            let row = self.bits(index);
            let why = match codes.assign(character, row) {
                Ok(()) => continue,
                Err(CodeError::Even) => "has an even number of holes, and EIA characters have an odd one",
                Err(CodeError::Taken | CodeError::Fixed) => "is that of another character",
            };
            let name = control.parameters.get(index).map_or("", |parameter| parameter.name.as_str());
            let character = char::from(character);
            return Err(FittingError(format!(
                "parameter {name}: {character} cannot be punched {row:02X}, which {why}"
            )));
        }
        Ok(())
    }

    pub(crate) fn bits(&self, index: usize) -> u8 {
        self.parameter(index) as u8
    }
}

/// A parameter's value as users write it.
fn parse_value(text: &str, row: &ParameterRow) -> Option<f64> {
    let (text, kind) = (text.trim(), row.kind);
    if kind == ParameterKind::Choice {
        let same = |value: &String| value.eq_ignore_ascii_case(text);
        return row.values.iter().position(same).map(|index| index as f64);
    }
    if kind == ParameterKind::Bits {
        if let Some(bits) = text.strip_prefix("0b") {
            return u8::from_str_radix(bits, 2).ok().map(f64::from);
        }
        if text.len() == 8 && text.bytes().all(|b| b == b'0' || b == b'1') {
            return u8::from_str_radix(text, 2).ok().map(f64::from);
        }
        if text.len() == 8 || text.len() > 1 && text.starts_with('0') {
            // Digits D7 to D0, of which one is neither 0 nor 1, or some are missing.
            return None;
        }
        return text.parse::<u8>().ok().map(f64::from);
    }
    text.parse::<f64>().ok().filter(|value| value.is_finite())
}
