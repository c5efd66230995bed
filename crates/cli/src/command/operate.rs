//! `operate`: the operator's script performed, its events as JSON Lines.

use std::fs;
use std::io::Read;

use base::Condition;
use machine::EventKind;
use report::{Format, JsonLine, Tracer, render};
use station::{LibraryError, Operator, Said, Session, Value, read_script};

use crate::arguments::OperateArguments;
use crate::failure::Failure;
use crate::output::{Output, colour_err, say};
use crate::setting;
use crate::show_alarm::{show_alarm, show_typed_alarm};
use crate::texts::{Texts, folder_of};
use realtime::Hands;

mod realtime;

/// What a script's performance writes, and to where.
struct Performance<'a> {
    name: &'a str,
    tracer: Tracer<'a>,
    output: Output,
}

impl Performance<'_> {
    fn write(&mut self, said: &Said, session: &mut Session<Texts>) {
        write(said, session, &mut self.tracer, &mut self.output.buffer);
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
    let configuration = setting::configuration(&arguments.setting)?;
    let control = configuration.control.clone();
    let machine = configuration.machine.clone();
    let mut tracer = Tracer::new(&control, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    tracer.name_lines(machine.logic.lines.iter().map(|line| line.name.as_str()));
    tracer.with_time = true;
    tracer.with_io = arguments.io;
    let mut texts = setting::texts(name, &arguments.setting)?;
    texts.show_tapes(configuration.fitting.tape_codes(&control));
    if name != "-" {
        texts.load_beside(folder_of(name));
    }
    let mut session = Session::new(configuration, texts);
    session.interpreter_mut().set_loop_limit(arguments.setting.loop_limit);
    session.interpreter_mut().tell_variables(true);
    session.tell_signals(arguments.io);
    let mut operator = Operator::new(session);
    let mut performance = Performance { name, tracer, output: Output::new() };
    if arguments.realtime {
        let hands = if live { Hands::Live } else { Hands::Script(script) };
        realtime::run(&mut operator, hands, &mut performance, arguments.displays)?;
        return Ok(operator.session.alarm().is_none());
    }
    let mut failed = None;
    for station::ScriptLine { line, written, action } in &script {
        let mut tell = |session: &mut Session<Texts>, said: Said| {
            performance.write(&said, session);
            if let Err(failure) = performance.output.pass() {
                failed.get_or_insert(failure);
            }
        };
        let performed = operator.perform_written(action, Some(written), &mut tell);
        performed.map_err(|error| Failure::call(format!("{name}:{line}: {error}")))?;
        if let Some(failure) = failed.take() {
            return Err(failure);
        }
    }
    performance.output.flush()?;
    Ok(operator.session.alarm().is_none())
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

fn write(said: &Said, session: &mut Session<Texts>, tracer: &mut Tracer, out: &mut Vec<u8>) {
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
