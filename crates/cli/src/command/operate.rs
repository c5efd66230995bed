//! `operate`: the operator's script performed, its events as JSON Lines.

use std::fs;
use std::io::Read;
use std::sync::Arc;

use base::{Condition, Diagnostic};
use machine::EventKind;
use report::{Format, JsonLine, Tracer, render};
use station::{Action, LibraryError, Operator, Said, Session, Setup, Value, read_script};

use crate::arguments::OperateArguments;
use crate::failure::Failure;
use crate::output::{Output, colour_err, say};
use crate::setting;
use crate::show_alarm::{show_alarm, show_typed_alarm};
use crate::texts::{Texts, folder_of};
use keeping::{Keeping, default_folder};
use realtime::Hands;

mod history;
pub mod keeping;
mod realtime;

/// What a script's performance writes, and to where.
struct Performance<'a> {
    name: &'a str,
    tracer: Tracer<'a>,
    output: Output,
    keeping: Option<Keeping>,
}

impl Performance<'_> {
    fn write(&mut self, said: &Said, session: &mut Session<Texts>) {
        let diagnostic = write(said, session, &mut self.tracer, &mut self.output.buffer);
        if let Some(keeping) = &mut self.keeping {
            keeping.note(said, session, diagnostic.as_ref());
        }
    }

    /// In the middle of an action: what was written goes out once there is enough of it, and nothing before it is in
    /// the memory.
    fn pass(&mut self, session: &mut Session<Texts>) -> Result<(), Failure> {
        if let Some(keeping) = &mut self.keeping
            && (self.output.is_enough() || keeping.is_late(session))
        {
            let changes = keeping.session_changes(session);
            keeping.commit(&changes)?;
        }
        self.output.pass()
    }

    /// Between two actions.
    fn settle(&mut self, operator: &mut Operator<Texts>) -> Result<(), Failure> {
        if self.output.is_enough() || self.keeping.as_ref().is_some_and(|keeping| keeping.is_late(&operator.session)) {
            self.keep(operator)?;
        }
        self.output.pass()
    }

    /// All that has changed is in the memory when this returns.
    fn keep(&mut self, operator: &mut Operator<Texts>) -> Result<(), Failure> {
        let Some(keeping) = &mut self.keeping else { return Ok(()) };
        let changes = keeping.changes(operator)?;
        keeping.commit(&changes)
    }
}

/// The operator does something; what comes of it is written.
fn perform<T>(
    operator: &mut Operator<Texts>,
    performance: &mut Performance<'_>,
    does: impl FnOnce(&mut Operator<Texts>, &mut dyn FnMut(&mut Session<Texts>, Said)) -> Result<T, LibraryError>,
) -> Result<T, String> {
    does(operator, &mut |session, said| performance.write(&said, session)).map_err(|error| error.to_string())
}

pub fn operate(arguments: &OperateArguments) -> Result<bool, Failure> {
    let name = &arguments.script;
    // By the clock, lines on standard input act as they come.
    let live = arguments.realtime && name == "-";
    let script = if live { Vec::new() } else { script(name)? };
    let setting = &arguments.setting;
    let control = Arc::new(setting::load(&setting.control, setting.controls.as_deref())?);
    let mut keeping = match &arguments.memory {
        Some(Some(folder)) => Some(Keeping::open(folder, &control)?),
        Some(None) => Some(Keeping::open(&default_folder(&control.name)?, &control)?),
        None => None,
    };
    let kept: Vec<&Setup> = keeping.iter().map(Keeping::setup).collect();
    let configuration = setting::configuration_over(control.clone(), setting, &kept)?;
    let machine = configuration.machine.clone();
    let mut tracer = Tracer::new(&control, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    tracer.name_lines(machine.logic.lines.iter().map(|line| line.name.as_str()));
    tracer.with_time = true;
    tracer.with_io = arguments.io;
    let mut texts = setting::texts(name, setting)?;
    if keeping.is_some() {
        texts.copy_loaded();
    }
    texts.show_tapes(configuration.fitting.tape_codes(&control));
    if name != "-" {
        texts.load_beside(folder_of(name));
    }
    let mut session = Session::new(configuration, texts);
    session.interpreter_mut().set_loop_limit(arguments.setting.loop_limit);
    session.interpreter_mut().tell_variables(true);
    session.tell_signals(arguments.io);
    let mut operator = Operator::new(session);
    let mut performance = Performance { name, tracer, output: Output::new(), keeping: None };
    if let Some(keeping) = &mut keeping {
        let as_kept = setting::kept_configuration(control.clone(), setting, keeping.setup())?;
        keeping.take_up(&as_kept, &mut operator, &mut |session, said| performance.write(&said, session))?;
    }
    performance.keeping = keeping;
    performance.keep(&mut operator)?;
    if arguments.realtime {
        let hands = if live { Hands::Live } else { Hands::Script(script) };
        realtime::run(&mut operator, hands, &mut performance, arguments.displays)?;
        return Ok(operator.session.alarm().is_none());
    }
    let mut failed = None;
    for station::ScriptLine { line, written, action } in &script {
        let lasts = matches!(action, Action::Run(_));
        let mut tell = |session: &mut Session<Texts>, said: Said| {
            performance.write(&said, session);
            if lasts && failed.is_none() {
                failed = performance.pass(session).err();
            }
        };
        let performed = operator.perform_written(action, Some(written), &mut tell);
        performed.map_err(|error| Failure::call(format!("{name}:{line}: {error}")))?;
        if let Some(failure) = failed.take() {
            return Err(failure);
        }
        performance.settle(&mut operator)?;
    }
    let alarm = operator.session.alarm().is_some();
    if let Some(keeping) = &mut performance.keeping {
        keeping.switch_off(&mut operator);
    }
    performance.keep(&mut operator)?;
    performance.output.flush()?;
    Ok(!alarm)
}

/// Reads a script as a whole.
fn script(name: &str) -> Result<Vec<station::ScriptLine>, Failure> {
    let cannot = |error| Failure::call(format!("cannot read {name}: {error}"));
    let text = if name == "-" {
        let mut text = String::new();
        std::io::stdin().read_to_string(&mut text).map_err(cannot)?;
        text
    } else {
        fs::read_to_string(name).map_err(cannot)?
    };
    read_script(&text).map_err(|error| Failure::call(format!("{name}:{}: {}", error.line, error.message)))
}

/// Writes what was said; an alarm is given back in words.
fn write(said: &Said, session: &mut Session<Texts>, tracer: &mut Tracer, out: &mut Vec<u8>) -> Option<Diagnostic> {
    let time = session.time().0;
    match said {
        Said::Event(event) => {
            let mut diagnostic = None;
            if let EventKind::Alarm(alarm) = &event.kind {
                let configuration = session.configuration();
                let (control, machine) = (configuration.control.clone(), configuration.machine.clone());
                let (found, excerpt) = if alarm.place.source == station::TYPED {
                    show_typed_alarm(alarm, &control, &machine, session.typed_text())
                } else {
                    show_alarm(alarm, &control, &machine, session.library_mut())
                };
                // What stands in no block, or comes of the operator's own button, has no line to show.
                if alarm.place.line > 0 && alarm.condition != Condition::EmergencyStop {
                    say(&render(&found, &excerpt, Format::Text { colour: colour_err() }));
                }
                diagnostic = Some(found);
            }
            let interpreter = session.interpreter();
            tracer.write(event, |program| interpreter.program_name(program), diagnostic.as_ref(), out);
            return diagnostic;
        }
        Said::Refused { action, why } => {
            let mut line = JsonLine::begin(out);
            line.text("event", "refused").text("action", action).text("why", why).number("time", time);
            line.end();
            out.push(b'\n');
        }
        Said::Shown { what, value } => {
            let mut line = JsonLine::begin(out);
            line.text("event", "show").text("what", what);
            write_value("value", value, &mut line);
            line.number("time", time);
            line.end();
            out.push(b'\n');
        }
    }
    None
}

fn write_value(name: &str, value: &Value, line: &mut JsonLine) {
    match value {
        Value::Null => line.field(name).extend_from_slice(b"null"),
        Value::Truth(truth) => {
            line.boolean(name, *truth);
        }
        Value::Number(number) => {
            line.number(name, *number);
        }
        Value::Text(text) => {
            line.text(name, text);
        }
        Value::List(items) => {
            line.list(name, items, |item, list| write_value("", item, list));
        }
        Value::Object(fields) => {
            line.object(name, |object| fields.iter().for_each(|(name, value)| write_value(name, value, object)));
        }
    }
}
