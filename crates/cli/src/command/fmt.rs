//! `fmt`: programs in house style, proved to run as before, then written over themselves at one stroke.

use std::collections::BTreeSet;
use std::fs;
use std::io::Read;

use base::{Condition, SourceId};
use machine::EventKind;
use meaning::WINDOW;
use report::{Difference, Formatted, HouseStyle, Numbering, house_style, same_run};
use station::{AfterAlarm, Configuration, Session, Step, Which, blocks_of, programs_in};
use syntax::Cursor;
use tape::{Format, recognise};

use crate::arguments::FmtArguments;
use crate::failure::Failure;
use crate::named_programs::named_programs;
use crate::output::Output;
use crate::replace::write_at_one_stroke;
use crate::setting;
use crate::texts::{Texts, one_byte_a_character};

/// The text in question, in a session's texts.
const OWN: SourceId = SourceId(0);
/// A program may run for ever: beyond so many events two texts that run alike are taken for the same.
const MOST_EVENTS: u64 = 20_000_000;
/// Lines shown before and after a change.
const CONTEXT: usize = 2;

pub fn fmt(arguments: &FmtArguments) -> Result<bool, Failure> {
    let numbering = arguments.number.as_deref().map(numbering).transpose()?;
    let configuration = setting::configuration(&arguments.setting)?;
    let files = named_programs(&arguments.files)?;
    if arguments.output.is_some() && files.len() > 1 {
        return Err(Failure::call("--output takes one program"));
    }
    let (mut changed, mut output) = (0, Output::new());
    for file in &files {
        let bytes = read(file, &configuration)?;
        let formatted = format_one(file, &bytes, numbering, &configuration, arguments)?;
        changed += usize::from(!formatted.unchanged);
        if arguments.check {
            output.buffer.extend_from_slice(&changes(file, &formatted));
            output.flush()?;
            continue;
        }
        match arguments.output.as_deref().unwrap_or(file) {
            "-" => {
                output.buffer.extend_from_slice(&formatted.text);
                output.flush()?;
            }
            path if path == file && formatted.unchanged => {}
            path => write_at_one_stroke(path, &formatted.text)?,
        }
    }
    if arguments.output.is_none() && !arguments.files.iter().any(|file| file == "-") {
        let rest = files.len() - changed;
        let said = if arguments.check { "would be rewritten" } else { "rewritten" };
        output.buffer.extend_from_slice(format!("{changed} {said}, {rest} already in house style\n").as_bytes());
        output.flush()?;
    }
    Ok(changed == 0 || !arguments.check)
}

/// `10,10`: the first number and the step.
fn numbering(text: &str) -> Result<Numbering, Failure> {
    let wrong = || Failure::call(format!("--number {text}: write START,STEP, as in 10,10"));
    let (start, step) = text.split_once(',').ok_or_else(wrong)?;
    match (start.trim().parse(), step.trim().parse()) {
        (Ok(start @ 1..), Ok(step @ 1..)) => Ok(Numbering { start, step }),
        _ => Err(wrong()),
    }
}

/// A program as it stands in its file; the image of a tape and texts of two bytes a character are refused.
pub fn read(file: &str, configuration: &Configuration) -> Result<Vec<u8>, Failure> {
    let cannot = |error: std::io::Error| Failure::call(format!("cannot read {file}: {error}"));
    let mut bytes = Vec::new();
    if file == "-" {
        std::io::stdin().lock().read_to_end(&mut bytes).map_err(cannot)?;
    } else {
        bytes = fs::read(file).map_err(cannot)?;
    }
    one_byte_a_character(file, &bytes).map_err(Failure::call)?;
    let codes = configuration.fitting.tape_codes(&configuration.control);
    let head = bytes.get(..bytes.len().min(WINDOW)).unwrap_or_default();
    if codes.is_some_and(|codes| recognise(head, &codes) != Format::Text) {
        return Err(Failure::call(format!(
            "{file}: the image of a tape; `cyclestart tape read {file}` makes text of it"
        )));
    }
    Ok(bytes)
}

fn format_one(
    file: &str,
    bytes: &[u8],
    numbering: Option<Numbering>,
    configuration: &Configuration,
    arguments: &FmtArguments,
) -> Result<Formatted, Failure> {
    let run = Run { file, configuration, arguments };
    let style = HouseStyle {
        axes: configuration.machine.axes.iter().map(|axis| axis.letter).collect(),
        numbering,
        refused: run.refused(bytes)?,
    };
    let formatted = house_style(bytes, &configuration.control, &style)
        .map_err(|why| Failure::call(format!("{file}: {why}; nothing is written")))?;
    if !formatted.unchanged {
        // With new numbers M99 P leads to blocks of the caller: a program called does not run by itself.
        let called = if numbering.is_some() { &formatted.called[..] } else { &[] };
        run.prove(bytes, &formatted.text, called)?;
    }
    Ok(formatted)
}

/// What a text is run under.
struct Run<'r> {
    file: &'r str,
    configuration: &'r Configuration,
    arguments: &'r FmtArguments,
}

impl Run<'_> {
    fn session(&self, bytes: &[u8], head: Cursor, after: AfterAlarm) -> Result<Session<Texts>, Failure> {
        let mut texts = setting::texts(self.file, &self.arguments.setting)?;
        let source = texts.hold(self.file, bytes.to_vec())?;
        let mut session = Session::new(self.configuration.clone(), texts);
        session.interpreter_mut().set_loop_limit(self.arguments.setting.loop_limit);
        session.set_after_alarm(after);
        session.select(source, &Texts::program_name(self.file), head);
        Ok(session)
    }

    /// Where the programs of a text begin: its head, then every one that an O word begins further down, but those called.
    fn heads(&self, bytes: &[u8], called: &[u32]) -> Result<Vec<Cursor>, Failure> {
        let mut session = self.session(bytes, Cursor::HEAD, AfterAlarm::Stand)?;
        let grammar = self.configuration.control.grammar;
        let programs = programs_in(session.library_mut(), OWN, &grammar, None).map_err(Failure::call)?;
        let mut heads = vec![Cursor::HEAD];
        heads.extend(programs.into_iter().filter(|(number, _)| !called.contains(number)).map(|(_, head)| head));
        Ok(heads)
    }

    /// The blocks that the control refuses, by the byte at which they begin.
    fn refused(&self, bytes: &[u8]) -> Result<BTreeSet<u64>, Failure> {
        let mut refused = BTreeSet::new();
        for head in self.heads(bytes, &[])? {
            let mut session = self.session(bytes, head, AfterAlarm::GoOn)?;
            session.start();
            for _ in 0..MOST_EVENTS {
                match session.next() {
                    Step::Event(event) => {
                        if let EventKind::Alarm(alarm) = event.kind
                            && alarm.place.source == OWN
                            // Nothing is wrong with a block that is not built here yet, or that is the program's own alarm.
                            && !matches!(alarm.condition, Condition::NotYetBuilt | Condition::MacroUser)
                        {
                            refused.insert(alarm.place.block.start);
                        }
                    }
                    Step::Stopped => session.start(),
                    Step::Idle => break,
                    Step::Failed(error) => return Err(Failure::call(error)),
                }
            }
        }
        Ok(refused)
    }

    /// Both texts run alike: every program of them, as the control runs it and checking on behind alarms, with the
    /// switches of the set-up and with every BLOCK DELETE switch turned over.
    fn prove(&self, old: &[u8], new: &[u8], called: &[u32]) -> Result<(), Failure> {
        let (old_heads, new_heads) = (self.heads(old, called)?, self.heads(new, called)?);
        if old_heads.len() != new_heads.len() {
            return Err(self.differs(None));
        }
        let deletes = self.has_skips(old)?;
        for (&old_head, &new_head) in old_heads.iter().zip(&new_heads) {
            for after in [AfterAlarm::Stand, AfterAlarm::GoOn] {
                for turned in [false, true].into_iter().take(1 + usize::from(deletes)) {
                    let mut first = self.session(old, old_head, after)?;
                    let mut second = self.session(new, new_head, after)?;
                    if turned {
                        for switch in 1..=9 {
                            let on = self.configuration.switches.block_delete & (1 << (switch - 1)) == 0;
                            for session in [&mut first, &mut second] {
                                session.set_switch("block-delete", Which::Number(switch), on).map_err(Failure::call)?;
                            }
                        }
                    }
                    if let Some(difference) = same_run(&mut first, &mut second, MOST_EVENTS).map_err(Failure::call)? {
                        return Err(self.differs(Some(difference)));
                    }
                }
            }
        }
        Ok(())
    }

    fn has_skips(&self, bytes: &[u8]) -> Result<bool, Failure> {
        let mut session = self.session(bytes, Cursor::HEAD, AfterAlarm::Stand)?;
        let mut found = false;
        let grammar = self.configuration.control.grammar;
        blocks_of(session.library_mut(), OWN, &grammar, None, |block, _| {
            found |= !block.skips.is_empty();
            !found
        })
        .map_err(Failure::call)?;
        Ok(found)
    }

    fn differs(&self, difference: Option<Difference>) -> Failure {
        let place = difference.map_or_else(String::new, |it| format!(" at line {}", it.first.line));
        Failure::call(format!(
            "{}: in house style the program would not run as before{place}; nothing is written. Please report it with the program.",
            self.file
        ))
    }
}

/// What changes, as a unified difference; nothing if nothing does.
fn changes(file: &str, formatted: &Formatted) -> Vec<u8> {
    let differs = |index: usize| formatted.lines.get(index).is_some_and(|(old, new)| *new != [old.clone()]);
    let mut out = Vec::new();
    let (mut index, mut new_line) = (0, 1);
    while index < formatted.lines.len() {
        if !differs(index) {
            new_line += 1;
            index += 1;
            continue;
        }
        if out.is_empty() {
            out.extend_from_slice(format!("--- {file}\n+++ {file}\n").as_bytes());
        }
        let from = index.saturating_sub(CONTEXT);
        let mut to = index + 1;
        let near = |to: usize| (to..to + 2 * CONTEXT + 1).any(differs);
        while to < formatted.lines.len() && near(to) {
            to += 1;
        }
        let end = (to + CONTEXT).min(formatted.lines.len());
        let part = formatted.lines.get(from..end).unwrap_or_default();
        let before = index - from;
        let news: usize = part.iter().map(|(_, new)| new.len()).sum();
        let first_new = new_line - before;
        let head = format!("@@ -{},{} +{first_new},{news} @@\n", from + 1, part.len());
        out.extend_from_slice(head.as_bytes());
        for (old, new) in part {
            if *new == [old.clone()] {
                push_line(&mut out, b' ', old);
            } else {
                push_line(&mut out, b'-', old);
                new.iter().for_each(|line| push_line(&mut out, b'+', line));
            }
        }
        new_line = first_new + news;
        index = end;
    }
    if out.is_empty() && !formatted.unchanged {
        out.extend_from_slice(format!("--- {file}\n+++ {file}\nonly the ends of its lines change\n").as_bytes());
    }
    out
}

fn push_line(out: &mut Vec<u8>, mark: u8, line: &[u8]) {
    out.push(mark);
    out.extend_from_slice(line);
    out.push(b'\n');
}
