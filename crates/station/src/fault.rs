//! Faults that a script makes on purpose: what breaks, in the words of the vocabulary.

use std::fmt;

use machine::Fin;

/// What breaks.
#[derive(Clone, PartialEq, Debug)]
pub enum Fault {
    /// The machine answers the next code wrongly.
    Fin(Fin),
    /// The spindle does not get to its speed.
    SpindleSpeed,
    /// An overtravel switch turns on: axis letter, whether in its positive direction, machine coordinate in mm or degrees.
    Limit(u8, bool, f64),
    /// The drive of an axis fails.
    Servo(u8),
    /// An input of the builder's stays as it is: its name.
    Input(String),
    /// The power fails.
    Power,
}

/// How FIN can go wrong.
const FINS: [(&str, Fin); 3] = [("never", Fin::Never), ("early", Fin::Early), ("stuck", Fin::Stuck)];

/// Reads what stands behind `fault`.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn read_fault(words: &[&str]) -> Result<Fault, String> {
    const KNOWN: &str = "fin never|early|stuck, spindle-speed, limit X + at 12.5, servo X, input NAME stuck, power";
    let letter = |word: &str| match word.as_bytes() {
        [letter @ b'A'..=b'Z'] => Ok(*letter),
        _ => Err(format!("`{word}` is no axis letter")),
    };
    match words {
        ["fin", how] => {
            let found = FINS.iter().find(|(name, _)| name == how);
            found.map(|(_, fin)| Fault::Fin(*fin)).ok_or_else(|| format!("FIN is never, early or stuck, not `{how}`"))
        }
        ["spindle-speed"] => Ok(Fault::SpindleSpeed),
        ["limit", axis, sign @ ("+" | "-"), "at", at] => match at.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Fault::Limit(letter(axis)?, *sign == "+", value)),
            _ => Err(format!("`{at}` is no number")),
        },
        ["servo", axis] => Ok(Fault::Servo(letter(axis)?)),
        ["input", name, "stuck"] => Ok(Fault::Input((*name).to_owned())),
        ["power"] => Ok(Fault::Power),
        _ => Err(format!("there is no fault `{}`; the faults are {KNOWN}", words.join(" "))),
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Fin(fin) => {
                let name = FINS.iter().find(|(_, own)| own == fin).map_or("", |(name, _)| name);
                write!(f, "fin {name}")
            }
            Fault::SpindleSpeed => f.write_str("spindle-speed"),
            Fault::Limit(axis, positive, at) => {
                write!(f, "limit {} {} at {at}", char::from(*axis), if *positive { '+' } else { '-' })
            }
            Fault::Servo(axis) => write!(f, "servo {}", char::from(*axis)),
            Fault::Input(name) => write!(f, "input {name} stuck"),
            Fault::Power => f.write_str("power"),
        }
    }
}
