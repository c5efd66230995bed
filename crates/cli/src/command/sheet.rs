//! `sheet`: the set-up sheet that a shop prints.

use std::path::Path;

use report::{Sheet, sheet_html, sheet_json, sheet_text};

use super::open;
use crate::arguments::{SheetArguments, SheetFormat};
use crate::failure::Failure;
use crate::output::{paint_out, write_file};
use crate::show_alarm::tell_alarm;

/// Standard output, where a file is named.
const STDOUT: &str = "-";

pub fn sheet(arguments: &SheetArguments) -> Result<bool, Failure> {
    let format = format(arguments)?;
    let mut session = open(&arguments.file, &arguments.setting)?;
    let mut sheet = Sheet::run(&mut session, |texts, source, offset, len| texts.excerpt(source, offset, len))
        .map_err(Failure::call)?;
    if let Some(alarm) = sheet.alarm {
        let configuration = session.configuration().clone();
        let (control, machine) = (&configuration.control, &configuration.machine);
        let (diagnostic, excerpt) = tell_alarm(&alarm, control, machine, session.library_mut());
        let name = diagnostic.alarm.map_or_else(String::new, |alarm| alarm.name);
        sheet.alarm_text = Some(format!("line {}: alarm {name}, {}", excerpt.line, diagnostic.message));
    }
    let mut paint = paint_out();
    let output = arguments.output.as_deref().unwrap_or(Path::new(STDOUT));
    paint.colour &= output == Path::new(STDOUT);
    let text = match format {
        SheetFormat::Text => sheet_text(&sheet, paint),
        SheetFormat::Json => sheet_json(&sheet) + "\n",
        SheetFormat::Html => sheet_html(&sheet),
    };
    write_file(output, text.as_bytes(), &arguments.setting.files(&arguments.file))?;
    Ok(sheet.alarm.is_none())
}

/// The format that was asked for, or the one that the ending of the file says.
fn format(arguments: &SheetArguments) -> Result<SheetFormat, Failure> {
    if let Some(format) = arguments.format {
        return Ok(format);
    }
    let Some(output) = &arguments.output else { return Ok(SheetFormat::Text) };
    let ending = output.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase());
    match ending.as_str() {
        "html" | "htm" => Ok(SheetFormat::Html),
        "json" => Ok(SheetFormat::Json),
        "txt" | "" => Ok(SheetFormat::Text),
        _ => Err(Failure::call(format!(
            "{}: end the sheet's name with .txt, .json or .html, or say which it is with --format",
            output.display()
        ))),
    }
}
