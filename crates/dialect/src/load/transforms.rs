//! `[scaling]` and `[rotation]` of `control.toml`.

use data::{DataError, Table};

use super::{ControlFiles, parameter_index, refuse};
use crate::control::Roles;
use crate::row::ParameterRow;
use crate::transform::{RatioUnit, RotationRule, ScaledAxes, ScalingRule};

/// As written: parameters by their names.
pub(super) struct ScalingDraft {
    rule: ScalingRule,
    unit_parameter: Option<String>,
    left_out: Option<String>,
}

/// As written: parameters by their names.
pub(super) struct RotationDraft {
    rule: RotationRule,
    adds_up: Option<String>,
}

fn letter(t: &mut Table, key: &'static str) -> u8 {
    let place = t.place_of(key).unwrap_or_else(|| t.range());
    let word = t.required_string(key);
    match word.as_bytes() {
        [letter @ b'A'..=b'Z'] => *letter,
        _ => {
            t.error(place, format!("{key} is one capital letter"));
            b'P'
        }
    }
}

fn letters(t: &mut Table, key: &'static str) -> Option<[u8; 3]> {
    let place = t.place_of(key)?;
    let words = t.strings(key)?;
    let all: Vec<u8> = words.iter().filter(|word| word.len() == 1).flat_map(|word| word.bytes()).collect();
    let found = <[u8; 3]>::try_from(all).ok().filter(|all| all.iter().all(u8::is_ascii_uppercase));
    if found.is_none() {
        t.error(place, format!("{key} is a list of three capital letters, those of X, Y and Z"));
    }
    found
}

pub(super) fn scaling(t: &mut Table) -> ScalingDraft {
    let unit = t.number("unit");
    let unit_parameter = t.string("unit_parameter");
    if unit.is_some() == unit_parameter.is_some() {
        t.error_here("scaling has either a `unit` or a `unit_parameter`");
    }
    ScalingDraft {
        rule: ScalingRule {
            ratio: letter(t, "ratio"),
            ratios: letters(t, "ratios"),
            unit: RatioUnit::Fixed(unit.unwrap_or(0.001)),
            left_out: None,
            negative_mirrors: t.choice("negative", &[("refuse", false), ("mirror", true)]).unwrap_or(false),
            not_in_compensation: t.choice("in_compensation", &[("allow", false), ("refuse", true)]).unwrap_or(false),
            axes: t
                .choice("axes", &[("linear", ScaledAxes::Linear), ("XYZ", ScaledAxes::Xyz)])
                .unwrap_or(ScaledAxes::Linear),
            older_centre: letters(t, "older_centre"),
            centre_by_distance: t.choice("centre", &[("absolute", false), ("as-moves", true)]).unwrap_or(false),
        },
        unit_parameter,
        left_out: t.string("left_out"),
    }
}

pub(super) fn rotation(t: &mut Table) -> RotationDraft {
    t.require("most_deg");
    let rule =
        RotationRule { angle: letter(t, "angle"), most_deg: t.number("most_deg").unwrap_or(360.0), adds_up: None };
    RotationDraft { rule, adds_up: t.string("adds_up") }
}

/// The rules with their parameters; a control that has the codes has the tables.
pub(super) fn resolve(
    files: &ControlFiles,
    (scaling, rotation): (Option<ScalingDraft>, Option<RotationDraft>),
    roles: &Roles,
    parameters: &[ParameterRow],
) -> Result<(Option<ScalingRule>, Option<RotationRule>), Vec<DataError>> {
    for (role, there, name) in
        [(roles.scaling, scaling.is_some(), "scaling"), (roles.rotation, rotation.is_some(), "rotation")]
    {
        if role.is_some() && !there {
            return Err(refuse(
                files,
                "control.toml",
                format!("the table [{name}] is missing: the control has its codes"),
            ));
        }
    }
    let find = |name: &String| parameter_index(files, parameters, name);
    let scaling = match scaling {
        Some(ScalingDraft { mut rule, unit_parameter, left_out }) => {
            rule.left_out = left_out.as_ref().map(find).transpose()?;
            if let Some(name) = &unit_parameter {
                let index = find(name)?;
                let values = parameters.get(index).map_or(&[][..], |row| &row.values);
                let worth: Vec<f64> = values.iter().filter_map(|value| value.parse().ok()).collect();
                if worth.is_empty() || worth.len() != values.len() || worth.iter().any(|&worth| worth <= 0.0) {
                    return Err(refuse(
                        files,
                        "parameters.toml",
                        format!("the values of \"{name}\" are numbers above 0"),
                    ));
                }
                rule.unit = RatioUnit::Parameter(index, worth);
            }
            Some(rule)
        }
        None => None,
    };
    let rotation = match rotation {
        Some(RotationDraft { rule, adds_up }) => {
            Some(RotationRule { adds_up: adds_up.as_ref().map(find).transpose()?, ..rule })
        }
        None => None,
    };
    Ok((scaling, rotation))
}
