//! What becomes of the control's states at power-on, RESET, emergency stop and a program's end that resets: a table of
//! the control. The modal groups have their rows in [`crate::Group`]; every other state has a [`StateRow`].

use crate::control::{Control, GroupCodes, GroupRule, MOST_GROUPS, NO_CODE};
use crate::fitting::Fitting;
use crate::row::Origin;

/// What brings the control into another state than a program does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Occasion {
    /// The power is switched on.
    PowerOn,
    /// The RESET key.
    Reset,
    /// The emergency stop button.
    EmergencyStop,
    /// The end of a program, where the control resets at it.
    ProgramEnd,
}

impl Occasion {
    /// Every occasion, in the order of the table's columns.
    pub const ALL: [Occasion; 4] = [Occasion::PowerOn, Occasion::Reset, Occasion::EmergencyStop, Occasion::ProgramEnd];
}

macro_rules! states {
    ($($(#[$doc:meta])* $name:ident = $word:literal,)*) => {
        /// A state that is no modal group.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum StateItem { $($(#[$doc])* $name,)* }

        impl StateItem {
            /// Every state by its name in the tables.
            pub const TABLE: &'static [(&'static str, StateItem)] = &[$(($word, StateItem::$name),)*];
        }
    };
}

states! {
    /// F.
    Feed = "feed",
    /// The current S, T and B codes.
    Codes = "codes",
    /// The H and D numbers in force.
    OffsetNumbers = "offset-numbers",
    /// How compensation turns outside corners.
    Corner = "corner-mode",
    /// Mirror image.
    Mirror = "mirror",
    /// Program interrupt.
    Interrupt = "interrupt",
    /// Reading ahead of many blocks.
    Buffering = "buffering",
    /// Macro variables that are not kept at power-off.
    VolatileVariables = "volatile-variables",
    /// Where in the program the control goes on.
    ProgramPointer = "program-pointer",
    /// Passing over a tape's label.
    LabelSkip = "label-skip",
    /// The local origin in every work system (G52).
    LocalSystem = "local-system",
    /// Where the UNIVERSAL display shows zero.
    Universal = "universal-display",
    /// Whether the reference points are established.
    ReferencePoints = "reference-points",
}

/// What becomes of a state.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// It stays.
    Keep,
    /// It takes its initial value.
    Initial,
}

/// One state's row.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct StateRow {
    /// Which state.
    pub item: StateItem,
    /// Its initial value, for people.
    pub initial: String,
    /// What becomes of it, in the order of [`Occasion::ALL`].
    pub fates: [Fate; 4],
    /// The option that keeps it through an emergency stop.
    pub kept_by: Option<String>,
    /// Index of the parameter that keeps it, power-on excepted, where it is not 0.
    pub kept_by_parameter: Option<usize>,
    /// What the row rests on.
    pub origin: Origin,
}

impl Fitting {
    /// What a rule makes of a group. A parameter that chooses a code whose option is not fitted chooses nothing.
    fn decide(&self, control: &Control, rule: &GroupRule) -> Option<u8> {
        let Some((index, bits, rows)) = &rule.parameter else { return rule.row };
        let value = self.bits(*index);
        let choice =
            bits.iter().enumerate().fold(0, |choice, (place, bit)| choice | usize::from(value >> bit & 1) << place);
        let chosen = rows.get(choice).copied().unwrap_or(rule.row);
        let is_fitted = |row: u8| control.g_codes.get(usize::from(row)).is_some_and(|code| self.has(code.division));
        if chosen.is_none_or(is_fitted) { chosen } else { rule.row }
    }

    /// Every group's state at power-on.
    pub fn power_on(&self, control: &Control) -> GroupCodes {
        self.groups_after(control, Occasion::PowerOn, GroupCodes([NO_CODE; MOST_GROUPS]))
    }

    /// Every group's state after an occasion.
    pub fn groups_after(&self, control: &Control, occasion: Occasion, before: GroupCodes) -> GroupCodes {
        let mut codes = before;
        for (index, group) in control.groups.iter().enumerate() {
            let rule = match occasion {
                Occasion::PowerOn => &group.power_on,
                Occasion::Reset => &group.reset,
                Occasion::EmergencyStop => &group.emergency_stop,
                Occasion::ProgramEnd => &group.program_end,
            };
            if let Some(row) = self.decide(control, rule) {
                codes.0[index] = row;
            }
        }
        codes
    }

    /// What becomes of a state; one that the control's table does not name is kept once the power is on.
    pub fn fate(&self, control: &Control, item: StateItem, occasion: Occasion) -> Fate {
        let Some(row) = control.station.states.iter().find(|row| row.item == item) else {
            return if occasion == Occasion::PowerOn { Fate::Initial } else { Fate::Keep };
        };
        let kept = row.kept_by.as_ref().is_some_and(|option| self.has_option(control, option));
        match occasion {
            Occasion::EmergencyStop if kept => Fate::Keep,
            Occasion::PowerOn => row.fates[0],
            _ if self.parameter_if_any(row.kept_by_parameter) != 0.0 => Fate::Keep,
            Occasion::Reset => row.fates[1],
            Occasion::EmergencyStop => row.fates[2],
            Occasion::ProgramEnd => row.fates[3],
        }
    }

    /// Settings that follow the codes last programmed, such as the unit of input, are written, where the code has
    /// changed: one that was set by hand since stays as it was set.
    pub fn store_codes(&mut self, control: &Control, before: &GroupCodes, now: &GroupCodes) {
        for (index, group) in control.groups.iter().enumerate() {
            let code = now.0[index];
            if !group.stored || code == before.0[index] {
                continue;
            }
            let Some((parameter, bits, rows)) = group.power_on.parameter.as_ref() else { continue };
            let Some(choice) = rows.iter().position(|&row| row == Some(code)) else { continue };
            let mut value = self.bits(*parameter);
            for (place, bit) in bits.iter().enumerate() {
                value = value & !(1 << bit) | ((choice >> place & 1) as u8) << bit;
            }
            self.write(*parameter, f64::from(value));
        }
    }
}
