//! Controls as typed tables: what a code means here, which group it belongs to, what may stand beside it.
//!
//! Comes in: the TOML files of `controls/`. Goes out: a [`Control`], validated, and the [`Fitting`] of one machine
//! (options, policies, parameters). Must never know: where a program stands, what it has done. This is the only
//! crate in which controls differ; every other stage asks it and gets an answer that is already decided.

mod address;
mod alarm;
mod builtin;
mod combination;
mod control;
mod fitting;
mod fix;
mod function;
mod load;
mod meaning;
mod member;
mod occasion;
mod policy;
mod row;
mod station;
mod transform;
mod user_macro;
mod warning;
mod word;
mod word_order;

pub use address::{Address, AddressKind, PointRule};
pub use alarm::AlarmRow;
pub use builtin::{builtin_controls, builtin_files};
pub use combination::{Combination, Written, check_combination};
pub use control::{
    Control, FeedSettings, FileNames, Group, GroupCodes, GroupRule, MOST_GROUPS, NO_CODE, Roles, TapeRules, Tolerances,
};
pub use fitting::{Fitting, FittingError, ParameterSetting};
pub use fix::{Fix, Refused, Rewritten};
pub use function::{
    CompensationRules, CycleStep, CycleSteps, CycleTable, DataKinds, Functions, MOST_STEPS, ReferenceRules, WorkRules,
};
pub use load::{ControlFiles, load_control};
pub use meaning::{Function, MMeaning, Meaning, VariableMeaning};
pub use member::AxisLetter;
pub use occasion::{Fate, Occasion, StateItem, StateRow};
pub use policy::{
    ArcWithoutCentre, CallFromLarge, CallL0, CompensationCut, CompensationRestart, CompensationStart, CornerMode,
    CycleInCompensation, CycleL0Moves, CycleSpindleUnknown, CycleWithMotion, DwellVariable, FeedModeChange, G87Return,
    G92System, InchFeedInteger, Intervention, LengthWithoutZ, M01OffOutput, MOver99, MdiCalls, OneShotCompany, Options,
    Policies, PositionOffsetAbsolute, PositionOffsetArcRadius, PositionOffsetLetter, ProgrammedPosition,
    ReferenceFirst, ReferenceVia, ResetPointer, RestartApproach, ScalingBoreLevels, ScalingCompany,
    ScalingNegativeRatio, SkipWithoutSignal, StrokeCheck, SubprogramTextEnd, TipSingularity, TouchOff,
    UnitChangeOffsets,
};
pub use row::{
    Certainty, Class, Division, GCode, MCode, OptionRow, Origin, ParameterBit, ParameterKind, ParameterRow, PolicyRow,
    Takes,
};
pub use station::{DisplayRow, Key, ModeKind, ModeRow, SHOWN, StationTable, SwitchRow};
pub use transform::{RatioUnit, RotationRule, ScaledAxes, ScalingRule};
pub use word_order::put_in_order;

pub use user_macro::{ArgumentRow, FunctionRow, UserMacro, VariableRow};
pub use warning::{OwnWarning, WarningRow};

#[cfg(test)]
mod tests {
    use super::*;

    fn yasnac() -> Control {
        let files = builtin_files("yasnac-mx1").expect("it is built in");
        match load_control(&files) {
            Ok(control) => control,
            Err(errors) => panic!("{}", errors.iter().map(|e| format!("{e}\n\n")).collect::<String>()),
        }
    }

    /// Every control that comes with the program.
    fn builtin() -> Vec<Control> {
        let files = builtin_controls().into_iter().filter_map(|name| builtin_files(&name));
        files.filter_map(|files| load_control(&files).ok()).collect()
    }

    #[test]
    fn every_builtin_control_loads() {
        for name in builtin_controls() {
            let files = builtin_files(&name).expect("it is built in");
            match load_control(&files) {
                Ok(control) => assert_eq!(control.name, name),
                Err(errors) => panic!("{}", errors.iter().map(|e| format!("{e}\n\n")).collect::<String>()),
            }
        }
    }

    #[test]
    fn policies_that_code_reads_are_in_the_tables_with_the_same_values_and_default() {
        // What the YASNAC's tables do not list is what a control without the policy does; another control lists it then.
        let controls: Vec<_> = builtin_controls()
            .iter()
            .map(|name| load_control(&builtin_files(name).expect("built in")).expect("right"))
            .collect();
        for (name, values) in policy::KNOWN {
            let listing = controls.iter().filter_map(|control| {
                control.policies.iter().find(|row| row.name == *name).map(|row| (control.name.as_str(), row))
            });
            let rows: Vec<_> = listing.collect();
            assert!(!rows.is_empty(), "{name}");
            for (control, row) in rows {
                let mut listed: Vec<_> = row.values.iter().map(String::as_str).collect();
                let mut known = values.to_vec();
                if control == "yasnac-mx1" {
                    assert_eq!(row.values[row.default], known[0], "default of {name}");
                }
                listed.sort_unstable();
                known.sort_unstable();
                assert_eq!(listed, known, "{name}");
            }
        }
    }

    #[test]
    fn options_that_code_asks_for_are_in_the_tables() {
        let controls = builtin();
        for name in policy::ASKED {
            let mut options = controls.iter().flat_map(|control| &control.options);
            assert!(options.any(|row| row.name == *name), "{name}");
        }
    }

    #[test]
    fn a_wrong_row_is_reported_at_its_place() {
        let mut files = builtin_files("yasnac-mx1").expect("it is built in");
        for (name, text) in &mut files.tables {
            if name == "g_codes.toml" {
                *text = text.replacen("meaning = \"linear\"", "meaning = \"liniar\"", 1);
            }
        }
        let errors = load_control(&files).expect_err("no such meaning");
        assert!(errors[0].file.ends_with("g_codes.toml") && errors[0].source.contains("liniar"), "{}", errors[0]);
    }

    #[test]
    fn parameters_decide_the_state_at_power_on() {
        let control = yasnac();
        let mut fitting = Fitting::stock(&control);
        let motion = |fitting: &Fitting| fitting.power_on(&control).0[control.roles.motion];
        assert_eq!(control.g_name(motion(&fitting)), "G00");
        let setting = |value: &str, bit| ParameterSetting { name: "6005".into(), bit, value: value.into() };
        fitting.set_parameter(&control, &setting("0b100", None)).expect("it has this bit");
        assert_eq!(control.g_name(motion(&fitting)), "G01");
        fitting.set_parameter(&control, &setting("0", Some(2))).expect("it has this bit");
        assert_eq!(control.g_name(motion(&fitting)), "G00");
        assert!(fitting.set_parameter(&control, &setting("256", None)).is_err());
        assert!(fitting.set_parameter(&control, &setting("2", Some(2))).is_err());
    }
}
