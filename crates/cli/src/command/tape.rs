//! `tape read` and `tape punch`: images of punched tape to text and back.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Read, Write};
use std::path::Path;

use base::{Alarm, Condition, Place, Span};
use dialect::{Control, Fitting};
use report::{Excerpt, Format, render};
use syntax::Semicolon;
use tape::{Codes, Fault, Finding, Format as Recognised, Lacking, Punch, System, Tape, Written, Wrong};

use crate::arguments::{
    CodeArgument, OnOff, PunchCodeArgument, TapeArguments, TapeCommand, TapePunchArguments, TapeReadArguments,
};
use crate::failure::Failure;
use crate::output::{colour_err, say, write_file};
use crate::setting;
use crate::texts::readable;

/// Longest stretch of a block that is read to show it.
const LINE: usize = 16 * 1024;

pub fn tape(command: &TapeCommand) -> Result<bool, Failure> {
    match command {
        TapeCommand::Read(arguments) => read(arguments),
        TapeCommand::Punch(arguments) => punch(arguments),
    }
}

/// The control whose tapes are meant, its codes, and whether it checks block parity.
struct Reels {
    control: Control,
    codes: Codes,
    block_parity: bool,
}

fn reels(arguments: &TapeArguments) -> Result<Reels, Failure> {
    let control = setting::load(&arguments.control, arguments.controls.as_deref())?;
    let mut fitting = Fitting::stock(&control);
    for text in &arguments.parameter {
        fitting.set_parameter(&control, &setting::parameter(text)?).map_err(|error| Failure::call(error.0))?;
    }
    fitting.check_tape_codes(&control).map_err(|error| Failure::call(error.0))?;
    let codes = fitting.tape_codes(&control);
    let codes = codes.ok_or_else(|| Failure::call(format!("the {} reads no punched tape", control.title)))?;
    Ok(Reels { block_parity: fitting.checks_block_parity(&control), codes, control })
}

fn contents(file: &str) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = if file == "-" { std::io::stdin().read_to_end(&mut bytes).map(|_| bytes) } else { fs::read(file) };
    read.map_err(|error| Failure::call(format!("cannot read {file}: {error}")))
}

/// Draws the tape as it was asked for; `tv` marks odd blocks, `file` is what the command reads.
fn draw(
    bytes: &[u8],
    tape: Tape,
    codes: &Codes,
    tv: bool,
    arguments: &TapeArguments,
    file: &str,
) -> Result<(), Failure> {
    if arguments.draw {
        std::io::stdout().lock().write_all(tape::draw(bytes, tape, codes, tv).as_bytes())?;
    }
    match &arguments.svg {
        Some(output) => write_file(output, tape::strip(bytes, tape, codes).as_bytes(), &[Path::new(file)]),
        None => Ok(()),
    }
}

fn read(arguments: &TapeReadArguments) -> Result<bool, Failure> {
    let Reels { control, codes, block_parity } = reels(&arguments.tape)?;
    let bytes = contents(&arguments.file)?;
    let tape = tape_of(&bytes, arguments, &codes)?;
    let tv = arguments.tv.map_or(block_parity, |tv| tv == OnOff::On);
    let written = tape::read_tape(&bytes, tape, &codes, tv);
    let name = if arguments.file == "-" { "<stdin>" } else { &arguments.file };
    for finding in &written.findings {
        say(&show(finding, &bytes, tape, &codes, &control, name));
    }
    say(&notes(&bytes, tape, &codes, &written, name));
    say(&verdict(&written.findings, tape.system, name));
    match &arguments.output {
        Some(output) => write_file(output, &written.text, &[Path::new(&arguments.file)])?,
        None if arguments.tape.draw || arguments.tape.svg.is_some() => {}
        None => std::io::stdout().lock().write_all(&written.text)?,
    }
    draw(&bytes, tape, &codes, tv, &arguments.tape, &arguments.file)?;
    Ok(written.findings.is_empty())
}

/// The tape in these bytes.
fn tape_of(bytes: &[u8], arguments: &TapeReadArguments, codes: &Codes) -> Result<Tape, Failure> {
    let file = &arguments.file;
    let forced = match arguments.code {
        CodeArgument::Auto => None,
        CodeArgument::Iso => Some(System::Iso),
        CodeArgument::Eia => Some(System::Eia),
    };
    let Some(system) = forced else {
        return match tape::recognise(&bytes[..bytes.len().min(meaning::WINDOW)], codes) {
            Recognised::Tape(tape) => Ok(tape),
            Recognised::Text if bytes.iter().all(|byte| matches!(byte, 0 | 0x7F | b' ' | b'\t'..=b'\r')) => {
                Err(Failure::call(format!("{file} is empty or blank: it holds no tape to read")))
            }
            Recognised::Text => Err(Failure::call(format!(
                "{file} is no tape that can be recognised, it reads as text; name its code with --code if it is one"
            ))),
        };
    };
    Tape::new(system, bytes, codes).ok_or_else(|| {
        let (name, row) = (system.name(), system.end_of_block());
        Failure::call(format!("{file} holds no {name} end of block ({row:02X}), so nothing of it would be read"))
    })
}

/// A finding as the control's alarm.
fn show(finding: &Finding, bytes: &[u8], tape: Tape, codes: &Codes, control: &Control, name: &str) -> String {
    let block = Span { start: finding.block, len: finding.rows };
    let place = Place { line: finding.line, line_start: finding.block, block, ..Place::default() };
    let (condition, values, span) = match finding.wrong {
        Wrong::Odd { rows } => (Condition::BlockParity, [rows as f64, 0.0, 0.0], block),
        Wrong::Row { row, fault } => {
            let row = f64::from(row);
            let (condition, values) = match fault {
                Fault::Parity(guesses) => (Condition::CharacterParity, [row, guesses.number(), 0.0]),
                Fault::Blank => (Condition::TapeBlank, [0.0; 3]),
                Fault::Unknown => (Condition::TapeCodeUnknown, [row, 0.0, 0.0]),
            };
            (condition, values, Span { start: finding.at, len: 1 })
        }
    };
    let alarm = Alarm::new(condition, place, span).with(values);
    let from = usize::try_from(finding.block).unwrap_or(usize::MAX).min(bytes.len());
    let column = place.column(span);
    let length = LINE.max((column as usize).saturating_add(256));
    let mut line = bytes[from..bytes.len().min(from.saturating_add(length))].to_vec();
    Recognised::Tape(tape).translate(codes, &mut line, finding.block, true);
    readable(&mut line);
    let excerpt = Excerpt::new(name, finding.line, &line, column, span.len);
    render(&control.diagnose(&alarm, &excerpt.word, None), &excerpt, Format::Text { colour: colour_err() })
}

/// What was not read, in words; nothing if that is blank tape.
fn notes(bytes: &[u8], tape: Tape, codes: &Codes, written: &Written, name: &str) -> String {
    let mut notes = String::new();
    let rows = |number: u64| count(number, "character");
    let head = usize::try_from(tape.head).unwrap_or(usize::MAX).min(bytes.len());
    let table = codes.table(tape.system);
    let label = bytes[..head].iter().filter(|&&row| !matches!(table.character(row), tape::IGNORED | b'\n')).count();
    if label > 0 {
        notes.push_str(&format!(
            "note: {name}: {} before the first end of block: a label, which the control skips\n",
            rows(label as u64)
        ));
    }
    if written.unread > 0 {
        let unread = rows(written.unread);
        notes.push_str(&format!("note: {name}: {unread} behind the end of the tape (%), not read\n"));
    }
    notes
}

/// How much is wrong; nothing if nothing is.
fn verdict(findings: &[Finding], system: System, name: &str) -> String {
    let odd = findings.iter().filter(|finding| matches!(finding.wrong, Wrong::Odd { .. })).count();
    let said = match (findings.len() - odd, odd) {
        (0, 0) => return String::new(),
        (rows, 0) => count(rows as u64, "character"),
        (0, odd) => count(odd as u64, "odd block"),
        (rows, odd) => format!("{} and {}", count(rows as u64, "character"), count(odd as u64, "odd block")),
    };
    format!("{name}: {} tape with {said} wrong\n", system.name())
}

fn count(number: u64, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn punch(arguments: &TapePunchArguments) -> Result<bool, Failure> {
    let shown = arguments.tape.draw || arguments.tape.svg.is_some();
    if arguments.output.is_none() && !shown {
        return Err(Failure::call("name the image to write with -o OUT, or draw it with --draw"));
    }
    let Reels { control, codes, .. } = reels(&arguments.tape)?;
    let text = contents(&arguments.file)?;
    let file = &arguments.file;
    if tape::recognise(&text[..text.len().min(meaning::WINDOW)], &codes) != Recognised::Text {
        return Err(Failure::call(format!("{file} is the image of a tape already; read it to text first")));
    }
    let how = Punch {
        system: match arguments.code {
            PunchCodeArgument::Iso => System::Iso,
            PunchCodeArgument::Eia => System::Eia,
        },
        leader: arguments.leader as usize,
        even: arguments.tv == OnOff::On,
        semicolon_ends: control.grammar.semicolon == Semicolon::EndOfBlock,
    };
    let image = tape::punch(&text, how, &codes).map_err(|lacking| lacks(&lacking, how.system, file, &control))?;
    if let Some(output) = &arguments.output {
        write_file(output, &image, &[Path::new(file)])?;
    }
    if shown && let Some(tape) = Tape::new(how.system, &image, &codes) {
        draw(&image, tape, &codes, how.even, &arguments.tape, file)?;
    }
    Ok(true)
}

/// The characters that a code lacks, each with its first place.
fn lacks(lacking: &[Lacking], system: System, file: &str, control: &Control) -> Failure {
    let mut places: BTreeMap<&str, (&Lacking, usize)> = BTreeMap::new();
    for lack in lacking {
        places.entry(&lack.character).or_insert((lack, 0)).1 += 1;
    }
    let mut places: Vec<_> = places.into_values().collect();
    places.sort_by_key(|(first, _)| (first.line, first.column));
    let mut message = format!("{file} holds characters that {} tape does not have", system.name());
    for (first, count) in &places {
        let more = if *count > 1 { format!(", and {} more", count - 1) } else { String::new() };
        message.push_str(&format!("\n  `{}` in line {}, column {}{more}", first.character, first.line, first.column));
    }
    let rows = control.tape.iter().flat_map(|tape| &tape.eia_codes);
    for &(character, index) in rows {
        let name = control.parameters.get(index).map_or("", |row| row.name.as_str());
        if system == System::Eia && places.iter().any(|(first, _)| first.character.as_bytes() == [character]) {
            let character = char::from(character);
            message.push_str(&format!("\nhelp: the parameter \"{name}\" says which holes {character} has"));
        }
    }
    if system == System::Eia && places.iter().any(|(first, _)| first.character.bytes().all(|b| b.is_ascii_lowercase()))
    {
        message.push_str("\nhelp: EIA tape has one case of letters, write capitals");
    }
    Failure::call(message)
}
