//! Restart in mid-program: asked for, shown, confirmed, and begun by CYCLE START.

use base::AXES;
use dialect::VariableMeaning;
use meaning::{CodeLine, SetValue};
use syntax::Cursor;

use super::{Begins, Loaded, Operator, Said, table};
use crate::action::Action;
use crate::block_target::BlockTarget;
use crate::display::Value;
use crate::library::{Library, Shelf};
use crate::session::{ProgramHead, RestartPlan, Session};

/// A restart that has been asked for and shown.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Asked {
    target: BlockTarget,
    plan: RestartPlan,
    /// What is restarted: the program in memory, or the tape.
    of: Begins,
    confirmed: bool,
}

/// Why a restart asked for in mode tape is not begun in mode memory.
const OTHER_MODE: &str = "the restart was asked for in another mode; go back to it, or ask again";

/// True for an action behind which a restart must be asked for again.
pub(super) fn is_dropped_by(action: &Action) -> bool {
    matches!(
        action,
        Action::Reset
            | Action::EmergencyStop
            | Action::PowerOff
            | Action::Select(_)
            | Action::Load(..)
            | Action::Key(_)
    )
}

impl<L: Shelf> Operator<L> {
    /// Works out the restart and shows it. Nothing moves.
    pub(super) fn ask_restart(
        &mut self,
        target: &BlockTarget,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<(), String> {
        let of = self.restarts()?;
        let target = BlockTarget { program: target.program.as_deref().map(super::normal_name), ..target.clone() };
        let plan = self.session.plan_restart(&target, self.program_head(of).as_ref())?;
        let value = show(&self.session, &plan);
        self.restart = Some(Asked { target, plan, of, confirmed: false });
        tell(&mut self.session, Said::Shown { what: "restart".to_owned(), value });
        Ok(())
    }

    /// The operator has looked at what was shown; CYCLE START begins it.
    pub(super) fn confirm_restart(&mut self) -> Result<(), String> {
        let of = self.restarts()?;
        let head = self.program_head(of);
        let Some(asked) = &mut self.restart else {
            return Err("no restart has been asked for".to_owned());
        };
        if asked.of != of {
            return Err(OTHER_MODE.to_owned());
        }
        // What has been given by MDI since is no longer missing.
        let plan = self.session.plan_restart(&asked.target, head.as_ref())?;
        if !plan.give.is_empty() {
            let codes: Vec<_> = plan.give.iter().map(code).collect();
            return Err(format!("the machine wants {} first: give it by MDI", codes.join(" ")));
        }
        (asked.plan, asked.confirmed) = (plan, true);
        Ok(())
    }

    /// CYCLE START: the restart that was confirmed, if one was.
    pub(super) fn begin_restart(&mut self) -> Option<Result<(), String>> {
        let head = self.restart.as_ref().and_then(|asked| self.program_head(asked.of));
        let Asked { target, plan, of, confirmed } = self.restart.as_ref()?;
        if self.restarts() != Ok(*of) {
            return Some(Err(OTHER_MODE.to_owned()));
        }
        if !confirmed {
            return Some(Err("a restart has been asked for and not confirmed; RESET drops it".to_owned()));
        }
        let begun = self.session.restart(target, head.as_ref(), plan, *of == Begins::Tape);
        if begun.is_ok() {
            self.restart = None;
        }
        Some(begun)
    }

    /// The program that is taken up.
    fn program_head(&self, of: Begins) -> Option<ProgramHead> {
        if let (Begins::Tape, Some((name, source))) = (of, &self.tape) {
            return Some((*source, name.clone(), Cursor::HEAD));
        }
        let Loaded { name, source, head, .. } = self.programs.get(self.selected.as_ref()?)?;
        Some((*source, name.clone(), *head))
    }

    /// What a restart takes up in this mode.
    fn restarts(&self) -> Result<Begins, String> {
        let begins = table::begins(self.mode())?;
        match begins {
            Begins::Typed => Err("what is typed is not entered in its middle: restart in mode memory".to_owned()),
            Begins::Tape if self.tape.is_some() => Ok(begins),
            _ if self.selected.is_none() => Err("no program is selected".to_owned()),
            _ => Ok(begins),
        }
    }
}

fn code((line, code): &(CodeLine, u32)) -> String {
    line.word(*code)
}

/// The restart as it is shown before it is confirmed.
fn show<L: Library>(session: &Session<L>, plan: &RestartPlan) -> Value {
    let configuration = session.configuration();
    let control = &configuration.control;
    let axes = &configuration.machine.axes;
    let letter = |axis: usize| axes.get(axis).map_or('?', |axis| char::from(axis.letter));
    let point = |point: &[f64; AXES]| {
        let letters = axes.iter().take(AXES).map(|axis| char::from(axis.letter.to_ascii_lowercase()).to_string());
        Value::Object(letters.zip(point).map(|(letter, &at)| (letter, Value::Number(at))).collect())
    };
    let whole = |number: u32| Value::Number(f64::from(number));
    let groups = control
        .shown_groups()
        .map(|(index, group)| (format!("{:02}", group.number), Value::Text(control.g_name(plan.groups.0[index]))));
    let leg = |&(axis, mm): &(usize, f64)| Value::Text(format!("{} {mm}", letter(axis)));
    let texts = |texts: Vec<String>| Value::List(texts.into_iter().map(Value::Text).collect());
    let [pass, passes] = plan.pass;
    let [s, t, b, h, d] = plan.words;
    let sequence = plan.place.sequence;
    Value::object([
        ("program", Value::Text(plan.program.clone())),
        ("line", Value::Number(plan.place.line as f64)),
        ("n", if sequence > 0 { whole(sequence) } else { Value::Null }),
        ("pass", whole(pass)),
        ("passes", whole(passes)),
        ("modal", Value::Object(groups.collect())),
        ("f", Value::Number(plan.feed)),
        ("s", whole(s)),
        ("t", whole(t)),
        ("b", whole(b)),
        ("h", whole(h)),
        ("d", whole(d)),
        ("machine", point(&plan.to)),
        ("work", point(&plan.work)),
        ("approach", Value::List(plan.legs.iter().map(leg).collect())),
        ("give", texts(plan.give.iter().map(code).collect())),
        ("not_restored", texts(not_restored(session, plan))),
    ])
}

/// What the control cannot bring back, or cannot know, one sentence each.
fn not_restored<L: Library>(session: &Session<L>, plan: &RestartPlan) -> Vec<String> {
    let mut lines = Vec::new();
    let axes = &session.configuration().machine.axes;
    for axis in plan.uncounted.iter() {
        if let Some(axis) = axes.get(axis) {
            let letter = char::from(axis.letter);
            lines.push(format!("{letter} has been moved without being counted: the restart counts it anew"));
        }
    }
    for axis in plan.unplaced.iter() {
        if let Some(axis) = axes.get(axis) {
            let letter = char::from(axis.letter);
            lines.push(format!(
                "the program does not place {letter} by itself before this block: it counts from where {letter} stands, which must be where the program begins"
            ));
        }
    }
    lines.extend(plan.unknown.iter().map(|code| {
        format!("M{code:02} went out before this block: what it does is the machine's, give it again if it shall hold")
    }));
    lines.extend(plan.way.written.iter().filter_map(|value| written_twice(session, value)));
    let asked = plan.way.asked;
    for (was, what) in [
        (asked.clock, "the program reads the clock on the way: what follows from it may be another"),
        (asked.inputs, "the program reads inputs on the way: they are taken as they are now"),
        (asked.position, "the program reads where the axes stand on the way"),
        (asked.skip, "a skip or measuring move is made on the way: where the signal came is not known"),
    ] {
        if was {
            lines.push(what.to_owned());
        }
    }
    lines
}

/// A value that is kept and that the restart writes once more, if it changes by it.
fn written_twice<L: Library>(session: &Session<L>, value: &SetValue) -> Option<String> {
    let interpreter = session.interpreter();
    let shown = |value: Option<f64>| value.map_or_else(|| "blank".to_owned(), |value| value.to_string());
    match *value {
        SetValue::Variable { number, value } => {
            let row = interpreter.control().user_macro.variable(number)?;
            let now = interpreter.variable(number);
            let then = (value != meaning::BLANK && !value.is_nan()).then_some(value);
            let kept = row.meaning == VariableMeaning::CommonPermanent && now != then;
            kept.then(|| format!("variable {number} is {} and becomes {} by the restart", shown(now), shown(then)))
        }
        SetValue::Offset { number, value } => {
            let now = interpreter.memory().length(number).map(|counts| counts / 1e6);
            (now != Some(value))
                .then(|| format!("offset {number} is {} and becomes {value} by the restart", shown(now)))
        }
        SetValue::Radius { number, value } => {
            let now = interpreter.memory().radius(number).map(|counts| counts / 1e6);
            (now != Some(value))
                .then(|| format!("offset D{number} is {} and becomes {value} by the restart", shown(now)))
        }
        SetValue::WorkOrigin { system, .. } => {
            let name = interpreter.control().g_name(system);
            Some(format!("the program writes the origin of {name} on the way: it is written again"))
        }
        _ => None,
    }
}
