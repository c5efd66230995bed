//! A memory as the control punches it, and read back: what is data is written by G10 and macro statements, so that the
//! control itself can read it; programs follow under their O numbers. No page about the tape of the parameters was found,
//! and most of them have no known number: they are not on it, which is said.

use std::fmt::Write;
use std::sync::Arc;

use base::SourceId;
use dialect::{Control, MMeaning, Meaning};
use machine::EventKind;
use memory::{Change, Content, Kind};
use station::{Operator, Session, Step, number_of, programs_in};
use syntax::Cursor;

use crate::arguments::{ExportArguments, ImportArguments};
use crate::command::operate::keeping::Keeping;
use crate::failure::Failure;
use crate::output::say;
use crate::setting;
use crate::show_alarm::tell_alarm;
use crate::texts::Texts;

/// Digits behind the point that a word has.
const DIGITS: usize = 3;

/// The tape's text.
pub fn write(content: &Content, arguments: &ExportArguments) -> Result<String, Failure> {
    let name = content.values.get(&(Kind::State, "control".to_owned()));
    let name = name.ok_or_else(|| Failure::call("the memory does not say which control's it is; export it as text"))?;
    let control = setting::load(name, arguments.controls.as_deref())?;
    let mut text = "%\n".to_owned();
    for meaning in [Meaning::Metric, Meaning::Absolute] {
        if let Some(row) = control.row_of(meaning) {
            let _ = writeln!(text, "{}", control.g_name(row));
        }
    }
    data(content, &control, &mut text);
    let end = control.m_of(MMeaning::TapeEnd).or_else(|| control.m_of(MMeaning::ProgramEnd));
    let _ = writeln!(text, "M{:02}", end.map_or(2, |row| row.code));
    let mut texts = Texts::new(Vec::new());
    for program in &content.programs {
        if control.files.is_some() {
            say(&format!("{}: programs are files on this control; export them as text\n", program.name));
            continue;
        }
        let source = texts.hold(&program.name, program.text.clone())?;
        for (number, own) in numbered(&mut texts, source, program, content, &control)? {
            let _ = writeln!(text, "O{number}{}", own.trim_end());
        }
    }
    text.push_str("%\n");
    Ok(text)
}

/// Offsets and origins as G10, variables as statements, in the order of their numbers.
fn data(content: &Content, control: &Control, text: &mut String) {
    let of_kind = |kind: Kind| content.values.iter().filter(move |((own, _), _)| *own == kind);
    let kinds = &control.functions.data;
    let letter = kinds.letters.first().map_or('L', |&letter| char::from(letter));
    let code = control.row_of(Meaning::WriteData).map_or_else(String::new, |row| control.g_name(row));
    let mut lines: Vec<(u8, u32, String)> = Vec::new();
    for ((_, name), value) in of_kind(Kind::Offset) {
        let (column, number) = match name.split_at_checked(1) {
            Some(("H", number)) => (kinds.length, number),
            Some(("D", number)) => (kinds.radius, number),
            _ => (None, name.as_str()),
        };
        let column = column.map_or_else(String::new, |kind| format!("{letter}{kind} "));
        let order = (u8::from(name.starts_with('D')), number.parse().unwrap_or(0));
        lines.push((order.0, order.1, format!("{code} {column}P{number} R{}", word(name, value))));
    }
    let mut origins: Vec<(String, String)> = Vec::new();
    for ((_, name), value) in of_kind(Kind::Work) {
        let Some((system, axis)) = name.rsplit_once(' ') else { continue };
        let Some(number) = system_number(control, system) else {
            say(&format!("{name} = {value}: it cannot be written by {code} and is not on the tape\n"));
            continue;
        };
        let head = format!("{code} {letter}{} P{number}", kinds.work);
        let axis = format!(" {axis}{}", word(name, value));
        match origins.iter_mut().find(|(own, _)| *own == head) {
            Some((_, axes)) => axes.push_str(&axis),
            None => origins.push((head, axis)),
        }
    }
    lines.extend(origins.into_iter().map(|(head, axes)| (2, 0, head + &axes)));
    for ((_, name), value) in of_kind(Kind::Variable) {
        lines.push((3, name.parse().unwrap_or(0), format!("#{name}={value}")));
    }
    for kind in [Kind::Parameter, Kind::Switch] {
        let count = of_kind(kind).count();
        if count > 0 {
            say(&format!(
                "{} ({count}): how the control punches them is not known; --form text keeps them\n",
                kind.name()
            ));
        }
    }
    lines.sort();
    lines.iter().for_each(|(_, _, line)| text.extend([line.as_str(), "\n"]));
}

/// The value of a word, with its point; what it cannot hold is said.
fn word(name: &str, value: &str) -> String {
    let number = value
        .strip_suffix(" nm")
        .map_or_else(|| value.parse::<f64>().unwrap_or(0.0), |counts| counts.parse::<f64>().unwrap_or(0.0) / 1e6);
    let text = format!("{number:.DIGITS$}");
    if text.parse::<f64>() != Ok(number) {
        say(&format!("{name} = {value}: a word on tape has {DIGITS} digits behind the point, so it becomes {text}\n"));
    }
    let short = text.trim_end_matches('0');
    short.to_owned()
}

/// By which number G10 knows a work system; 0 for the one that counts in all of them.
fn system_number(control: &Control, system: &str) -> Option<u8> {
    if system == "external" {
        return Some(0);
    }
    let row = (0..control.g_codes.len()).find(|&row| control.g_name(row as u8) == system)?;
    let code = control.g_codes.get(row).filter(|code| code.meaning == Meaning::WorkSystem)?;
    Some(code.number)
}

/// The programs of a text that are in memory: number, and what stands behind the number.
fn numbered(
    texts: &mut Texts,
    source: SourceId,
    program: &memory::Program,
    content: &Content,
    control: &Control,
) -> Result<Vec<(u32, String)>, Failure> {
    let found = programs_in(texts, source, &control.grammar, None).map_err(Failure::call)?;
    let key = (Kind::State, format!("programs of {}", program.name));
    let listed = content.values.get(&key).map_or_else(Vec::new, |text| Keeping::heads_of(text));
    let listed: Vec<_> = if listed.is_empty() {
        let own = number_of(&program.name).filter(|own| !found.iter().any(|(other, _)| other == own));
        found.iter().map(|(number, head)| (*number, *head)).chain(own.map(|own| (own, Cursor::HEAD))).collect()
    } else {
        listed.into_iter().filter_map(|(name, head)| Some((number_of(&name)?, head))).collect()
    };
    let text = String::from_utf8_lossy(&program.text).into_owned();
    let mut programs = Vec::new();
    for (number, head) in listed {
        // The first program may have been given another number when it was loaded.
        let first = found.first().filter(|(_, first)| head.offset <= first.offset);
        let from = first.map_or(head.offset, |(_, first)| first.offset);
        let to = found.iter().map(|(_, other)| other.offset).filter(|&other| other > from).min();
        let own = text.get(from as usize..to.map_or(text.len(), |to| to as usize)).unwrap_or_default();
        let own: Vec<_> = own.lines().filter(|line| line.trim() != "%").collect();
        let own = own.join("\n");
        let behind = own.trim_start().strip_prefix(['O', 'o', ':']);
        let behind = behind.map(|behind| behind.trim_start_matches(|c: char| c.is_ascii_digit()));
        programs.push((number, behind.map_or_else(|| format!("\n{own}"), str::to_owned)));
    }
    Ok(programs)
}

/// The control reads the tape: its data blocks are carried out, its programs loaded.
pub fn read(arguments: &ImportArguments, text: String) -> Result<bool, Failure> {
    let settings = &arguments.setting;
    let control = Arc::new(setting::load(&settings.control, settings.controls.as_deref())?);
    let mut keeping = Keeping::open(&arguments.folder, &control)?;
    let configuration = setting::configuration_over(control.clone(), settings, &[keeping.setup()])?;
    let as_kept = setting::kept_configuration(control.clone(), settings, keeping.setup())?;
    let mut operator = Operator::new(Session::new(configuration, Texts::new(Vec::new())));
    keeping.take_up(&as_kept, &mut operator, &mut |_, _| {})?;
    let session = &mut operator.session;
    session.reset();
    let source = session.library_mut().hold(&arguments.file, text.clone().into_bytes())?;
    session.select(source, "tape", Cursor::HEAD);
    session.start();
    loop {
        match session.next() {
            Step::Event(event) => {
                if let EventKind::Alarm(alarm) = &event.kind {
                    let machine = session.configuration().machine.clone();
                    tell_alarm(alarm, &control, &machine, session.library_mut());
                    return Ok(false);
                }
            }
            Step::Stopped => session.start(),
            Step::Idle => break,
            Step::Failed(error) => return Err(Failure::call(error)),
        }
    }
    let codes = None;
    let found = programs_in(session.library_mut(), source, &control.grammar, codes).map_err(Failure::call)?;
    for (at, (number, head)) in found.iter().enumerate() {
        let to = found.get(at + 1).map_or(text.len(), |(_, next)| next.offset as usize);
        let own = text.get(head.offset as usize..to).unwrap_or_default();
        let own = own.lines().filter(|line| line.trim() != "%").fold(String::new(), |all, line| all + line + "\n");
        let name = format!("O{number}");
        let source = operator.session.library_mut().hold(&name, own.into_bytes())?;
        operator.put_back(&name, source, vec![(name.clone(), Cursor::HEAD)]).map_err(Failure::call)?;
    }
    let mut changes = keeping.changes(&mut operator)?;
    changes.retain(|change| match change {
        Change::Load(_) | Change::Remove(_) => true,
        Change::Write(Kind::State, name, _) => name == "control" || name.starts_with("programs of "),
        Change::Write(kind, ..) => matches!(kind, Kind::Offset | Kind::Work | Kind::Variable),
        Change::Note(..) => false,
    });
    keeping.commit(&changes)?;
    Ok(true)
}
