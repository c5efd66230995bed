//! Diagnosis: every line between control and machine by its name, in groups, on or off.

use machine::Signal;

use super::Value;
use crate::library::Library;
use crate::session::Session;

/// The groups, in the order in which they are shown.
const GROUPS: [&str; 8] = ["codes", "strobes", "decoded", "handshake", "inputs", "spindle", "overtravel", "dogs"];

fn group_of(signal: Signal) -> usize {
    match signal {
        Signal::Bit(..) => 0,
        Signal::Strobe(..) => 1,
        Signal::Decoded(_) => 2,
        Signal::Fin | Signal::Den => 3,
        Signal::Eop | Signal::Rwd | Signal::Skip | Signal::Interrupt | Signal::Line(_) => 4,
        Signal::SpeedReached | Signal::SpindleStands | Signal::Oriented => 5,
        Signal::Limit(..) => 6,
        Signal::Deceleration(_) => 7,
    }
}

/// Every line; a group that this machine does not have is left out.
pub(super) fn diagnosis<L: Library>(session: &Session<L>) -> Value {
    let configuration = session.configuration();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let decoded = |code| control.m_code(code).and_then(|row| row.decoded.clone()).unwrap_or_default();
    let axis = |axis: u8| {
        machine.axes.get(usize::from(axis)).map_or_else(String::new, |axis| char::from(axis.letter).to_string())
    };
    let mut groups: [Vec<(String, Value)>; GROUPS.len()] = Default::default();
    session.see_lines(&mut |signal, on| {
        if let Some(group) = groups.get_mut(group_of(signal)) {
            group.push((signal.name(decoded, axis, |_| String::new()), Value::Truth(on)));
        }
    });
    let mut shown: Vec<(&str, Vec<(String, Value)>)> = GROUPS.into_iter().zip(groups).collect();
    let bits = session.interface_bits();
    if session.interpreter().fitting().options.user_macro {
        for ((name, letters), (value, count)) in [("macro_inputs", "UI"), ("macro_outputs", "UO")].into_iter().zip(bits)
        {
            let bit = |index: u32| (format!("{letters}{index}"), Value::Truth(value >> index & 1 == 1));
            shown.push((name, (0..count).map(bit).collect()));
        }
    }
    for (name, output) in [("builder_inputs", false), ("builder_outputs", true)] {
        let lines = session.logic_lines().zip(&machine.logic.lines).filter(|(_, line)| line.output == output);
        shown.push((name, lines.map(|((name, on), _)| (name.to_owned(), Value::Truth(on))).collect()));
    }
    let fitted = shown.into_iter().filter(|(_, lines)| !lines.is_empty());
    Value::fields(fitted.map(|(name, lines)| (name, Value::Object(lines))).collect())
}
