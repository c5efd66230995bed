//! `operate`: the operator's script performed, its events as JSON Lines.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::Path;

use machine::EventKind;
use report::{Format, JsonLine, Tracer, render};
use station::{Action, Loaded, Operator, Said, Session, Shown, programs_in, read_script};
use syntax::Cursor;

use crate::arguments::OperateArguments;
use crate::failure::Failure;
use crate::output::{Output, colour_err, say};
use crate::setting;
use crate::show_alarm::show_alarm;
use crate::texts::Texts;

pub fn operate(arguments: &OperateArguments) -> Result<bool, Failure> {
    let name = &arguments.script;
    let cannot = |error| Failure::call(format!("cannot read {name}: {error}"));
    let text = if name == "-" {
        let mut text = String::new();
        std::io::stdin().read_to_string(&mut text).map_err(cannot)?;
        text
    } else {
        fs::read_to_string(name).map_err(cannot)?
    };
    let script =
        read_script(&text).map_err(|error| Failure::call(format!("{name}:{}: {}", error.line, error.message)))?;
    let configuration = setting::configuration(&arguments.setting)?;
    let control = configuration.control.clone();
    let machine = configuration.machine.clone();
    let mut tracer = Tracer::new(&control, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    tracer.with_time = true;
    tracer.with_io = arguments.io;
    let mut session = Session::new(configuration, setting::texts(name, &arguments.setting)?);
    session.interpreter_mut().set_loop_limit(arguments.setting.loop_limit);
    session.interpreter_mut().tell_variables(true);
    let mut operator = Operator::new(session);
    let mut loaded: BTreeMap<String, Loaded> = BTreeMap::new();
    let mut output = Output::new();
    let mut failed = None;
    for (line, action) in &script {
        if let Action::Load(file, program) = action {
            let programs =
                load(&mut operator, name, file, program.as_deref()).map_err(|failure| at_line(name, *line, failure))?;
            loaded.extend(programs.into_iter().map(|program| (program.name.clone(), program)));
        }
        let find = |_: &mut Texts, program: &str| loaded.get(&normal_name(program)).cloned();
        let mut tell = |session: &mut Session<Texts>, said: Said| {
            let written = write(&said, session, &mut tracer, &mut output.buffer);
            if let Err(failure) = written.and_then(|()| output.pass()) {
                failed.get_or_insert(failure);
            }
        };
        operator.perform(action, find, &mut tell).map_err(Failure::call)?;
        if let Some(failure) = failed.take() {
            return Err(failure);
        }
    }
    output.flush()?;
    Ok(operator.session.alarm().is_none())
}

fn at_line(script: &str, line: usize, failure: Failure) -> Failure {
    match failure {
        Failure::Call(message) => Failure::Call(format!("{script}:{line}: {message}")),
        other => other,
    }
}

/// Loads a file into memory: every program that it holds. A file not found from here is looked for beside the script.
fn load(
    operator: &mut Operator<Texts>,
    script: &str,
    file: &str,
    program: Option<&str>,
) -> Result<Vec<Loaded>, Failure> {
    let beside = Path::new(script).parent().map(|folder| folder.join(file));
    let path = match beside {
        Some(beside) if !Path::new(file).exists() && beside.exists() => beside.to_string_lossy().into_owned(),
        _ => file.to_owned(),
    };
    let configuration = operator.session.configuration();
    let grammar = configuration.control.grammar;
    let codes = configuration.fitting.tape_codes(&configuration.control);
    let texts = operator.session.library_mut();
    texts.show_tapes(codes);
    let source = texts.open(&path)?;
    texts.look_beside(&path);
    let found = programs_in(texts, source, &grammar, codes).map_err(Failure::call)?;
    let mut programs = Vec::new();
    for (number, head) in found {
        texts.keep_in_memory(number, source);
        programs.push(Loaded { source, name: format!("O{number}"), head });
    }
    // A name given by hand, or the file's where no O word stands in it, is that of the text's first program.
    let first = match program {
        Some(name) => Some(normal_name(name)),
        None if programs.is_empty() => Some(normal_name(&Texts::program_name(file))),
        None => None,
    };
    if let Some(name) = first {
        if let Some(number) = name.strip_prefix('O').and_then(|digits| digits.parse().ok()) {
            texts.keep_in_memory(number, source);
        }
        programs.push(Loaded { source, name, head: Cursor::HEAD });
    }
    Ok(programs)
}

/// `o0012` and `O12` are one program; other names stay as they are.
fn normal_name(name: &str) -> String {
    let digits = name.strip_prefix(['O', 'o']).unwrap_or_default();
    match digits.parse::<u32>() {
        Ok(number) if digits.bytes().all(|b| b.is_ascii_digit()) => format!("O{number}"),
        _ => name.to_owned(),
    }
}

fn write(said: &Said, session: &mut Session<Texts>, tracer: &mut Tracer, out: &mut Vec<u8>) -> Result<(), Failure> {
    match said {
        Said::Event(event) => {
            let mut diagnostic = None;
            if let EventKind::Alarm(alarm) = &event.kind {
                let configuration = session.configuration();
                let (control, machine) = (configuration.control.clone(), configuration.machine.clone());
                let (found, excerpt) = show_alarm(alarm, &control, &machine, session.library_mut());
                say(&render(&found, &excerpt, Format::Text { colour: colour_err() }));
                diagnostic = Some(found);
            }
            let interpreter = session.interpreter();
            tracer.write(event, |program| interpreter.program_name(program), diagnostic.as_ref(), out);
        }
        Said::Refused { action, why } => {
            let mut line = JsonLine::begin(out);
            line.text("event", "refused").text("action", action).text("why", why).number("time", session.time().0);
            line.end();
            out.push(b'\n');
        }
        Said::Shown(shown) => {
            let mut line = JsonLine::begin(out);
            line.text("event", "show");
            show(*shown, session, tracer, &mut line);
            line.number("time", session.time().0);
            line.end();
            out.push(b'\n');
        }
    }
    Ok(())
}

fn show(shown: Shown, session: &Session<Texts>, tracer: &Tracer, line: &mut JsonLine) {
    let interpreter = session.interpreter();
    match shown {
        Shown::Modal => {
            line.text("what", "modal");
            tracer.modal_value(&interpreter.executing_state().groups, line);
        }
        Shown::Position => {
            line.text("what", "position");
            let machine = *session.position();
            line.object("value", |value| {
                tracer.point("machine", &machine, value);
                tracer.point("work", &interpreter.work_position(&machine), value);
                tracer.point("universal", &interpreter.universal_position(&machine), value);
                // Every move runs to its end between two actions, so there is nothing left to go.
                tracer.point("distance_to_go", &[0.0; base::AXES], value);
            });
        }
        Shown::State => {
            line.text("what", "state");
            let place = session.place();
            let alarm = session.alarm().map(|alarm| session.configuration().control.alarm_name(alarm).name);
            line.object("value", |value| {
                value.text("mode", "memory").boolean("running", session.is_running() && !session.is_stopped());
                value.boolean("held", false);
                let waiting = if session.is_stopped() { Some("cycle-start") } else { None };
                text_or_null(value, "waiting_for", waiting);
                text_or_null(value, "alarm", alarm.as_deref());
                let program = interpreter.main_program().map(|(program, _)| interpreter.program_name(program));
                text_or_null(value, "program", program);
                value.integer("line", place.line);
            });
        }
    }
}

fn text_or_null(line: &mut JsonLine, name: &str, text: Option<&str>) {
    match text {
        Some(text) => {
            line.text(name, text);
        }
        None => line.field(name).extend_from_slice(b"null"),
    }
}
