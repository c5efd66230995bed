//! The modal groups: the codes of their states, and which group decides what.

use data::DataError;

use super::{ControlFiles, codes, parameter_index, refuse};
use crate::control::{Group, GroupRule, MOST_GROUPS, Roles};
use crate::meaning::Meaning;
use crate::row::{GCode, ParameterRow};

/// The names of a group's states as rows of the G table.
pub(super) fn resolve(
    files: &ControlFiles,
    drafts: &[codes::GroupDraft],
    rows: &[GCode],
    parameters: &[ParameterRow],
) -> Result<Vec<Group>, Vec<DataError>> {
    if drafts.len() > MOST_GROUPS {
        return Err(refuse(files, "control.toml", format!("more than {MOST_GROUPS} modal groups")));
    }
    let mut groups = Vec::with_capacity(drafts.len());
    for (index, draft) in drafts.iter().enumerate() {
        let row = |name: &String| -> Result<Option<u8>, Vec<DataError>> {
            if name == "keep" {
                return Ok(None);
            }
            codes::row_of_name(rows, name)
                .filter(|&row| rows[usize::from(row)].group == Some(index as u8))
                .map(Some)
                .ok_or_else(|| {
                    refuse(files, "control.toml", format!("group {}: {name} is no code of it", draft.number))
                })
        };
        let rule = |draft_rule: &codes::RuleDraft| -> Result<GroupRule, Vec<DataError>> {
            let parameter = match &draft_rule.parameter {
                None => None,
                Some((name, bits, names)) => {
                    let parameter = parameter_index(files, parameters, name)?;
                    Some((parameter, bits.clone(), names.iter().map(row).collect::<Result<Vec<_>, _>>()?))
                }
            };
            Ok(GroupRule { row: row(&draft_rule.code)?, parameter })
        };
        groups.push(Group {
            number: draft.number,
            name: draft.name.clone(),
            power_on: rule(&draft.power_on)?,
            reset: rule(&draft.reset)?,
            emergency_stop: rule(&draft.emergency_stop)?,
            program_end: rule(&draft.program_end)?,
            stored: draft.stored,
            origin: draft.origin.clone(),
        });
    }
    Ok(groups)
}

/// Which group decides what, by what its codes mean.
pub(super) fn roles(files: &ControlFiles, groups: &[Group], rows: &[GCode]) -> Result<Roles, Vec<DataError>> {
    let of = |meaning: Meaning| -> Result<usize, Vec<DataError>> {
        rows.iter()
            .find(|row| row.meaning == meaning)
            .and_then(|row| row.group)
            .map(usize::from)
            .filter(|&group| group < groups.len())
            .ok_or_else(|| {
                let name = Meaning::TABLE.iter().find(|(_, m)| *m == meaning).map_or("?", |(name, _)| name);
                refuse(files, "g_codes.toml", format!("no modal code means `{name}`"))
            })
    };
    Ok(Roles {
        motion: of(Meaning::Rapid)?,
        plane: of(Meaning::PlaneXy)?,
        distance: of(Meaning::Absolute)?,
        feed_mode: of(Meaning::FeedPerMinute)?,
        units: of(Meaning::Metric)?,
        compensation: of(Meaning::CompensationOff)?,
        length: of(Meaning::LengthOff)?,
        cycle: of(Meaning::CycleOff)?,
        return_level: of(Meaning::ReturnInitial)?,
        work: of(Meaning::WorkSystem)?,
        stop_mode: of(Meaning::CuttingMode)?,
        modal_macro: of(Meaning::ModalMacroOff)?,
        scaling: of(Meaning::ScalingOff).ok(),
        stroke: of(Meaning::StrokeCheckOn).ok(),
        rotation: of(Meaning::RotationOff).ok(),
        polar: of(Meaning::PolarOff).ok(),
        surface_speed: of(Meaning::SurfaceSpeedOff).ok(),
    })
}
