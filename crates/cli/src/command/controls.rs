//! `controls`: the controls, or one control's tables.

use std::io::Write;

use report::{control_list, control_table};

use super::coverage::coverage;
use crate::arguments::ControlsArguments;
use crate::failure::Failure;
use crate::setting;

pub fn controls(arguments: &ControlsArguments) -> Result<bool, Failure> {
    let folder = arguments.controls.as_deref();
    if let (true, Some(name)) = (arguments.coverage, &arguments.name) {
        return coverage(name, folder, &arguments.cases);
    }
    let text = match &arguments.name {
        Some(name) => control_table(&setting::load(name, folder)?),
        None => {
            let names = setting::control_names(folder)?;
            let controls = names.iter().map(|name| setting::load(name, folder)).collect::<Result<Vec<_>, _>>()?;
            control_list(controls.iter())
        }
    };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(true)
}
