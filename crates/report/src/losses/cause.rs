//! What holds a move.

use meaning::CodeOut;

/// What costs time.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cause {
    /// G09 or G61.
    ExactStop,
    /// A code goes out before or behind it.
    Code,
    /// A rapid move comes before or behind it.
    BesideRapid,
    /// A corner that the tolerance lets pass only at less.
    Corner,
    /// The way turns back.
    Reversal,
    /// The highest feed of an axis.
    AxisLimit,
    /// The pull towards the centre of an arc.
    Centripetal,
    /// It gains or loses speed, because of something slower before it or behind it.
    Change,
    /// Positioning begins and ends at rest.
    Positioning,
    /// A dwell.
    Dwell,
    /// The machine has not answered.
    Waiting,
    /// A dwell, a stop, the program's beginning or end beside it.
    Standing,
    /// The program asks where the machine stands.
    Asked,
    /// Model `classic`: acceleration behind the interpolator, and blocks that are not ready in time.
    Control,
}

/// How many there are.
pub const CAUSES: usize = Cause::ALL.len();

impl Cause {
    /// Each of them, in the order of their numbers.
    pub const ALL: [Cause; 14] = [
        Cause::ExactStop,
        Cause::Code,
        Cause::BesideRapid,
        Cause::Corner,
        Cause::Reversal,
        Cause::AxisLimit,
        Cause::Centripetal,
        Cause::Change,
        Cause::Positioning,
        Cause::Dwell,
        Cause::Waiting,
        Cause::Standing,
        Cause::Asked,
        Cause::Control,
    ];

    /// Its name in JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Cause::ExactStop => "exact-stop",
            Cause::Code => "code",
            Cause::BesideRapid => "beside-rapid",
            Cause::Corner => "corner",
            Cause::Reversal => "reversal",
            Cause::AxisLimit => "axis-limit",
            Cause::Centripetal => "centripetal",
            Cause::Change => "speed-change",
            Cause::Positioning => "positioning",
            Cause::Dwell => "dwell",
            Cause::Waiting => "waiting",
            Cause::Standing => "stop",
            Cause::Asked => "macro",
            Cause::Control => "control",
        }
    }

    /// What it is in a few words.
    pub const fn words(self) -> &'static str {
        match self {
            Cause::ExactStop => "exact stops",
            Cause::Code => "stops for M, S, T and B codes",
            Cause::BesideRapid => "cuts that begin or end at a rapid move",
            Cause::Corner => "corners",
            Cause::Reversal => "turning back",
            Cause::AxisLimit => "axes slower than F",
            Cause::Centripetal => "arcs too tight for F",
            Cause::Change => "gaining or losing speed over several blocks",
            Cause::Positioning => "rapid moves speeding up and slowing down",
            Cause::Dwell => "dwells",
            Cause::Waiting => "waiting for FIN",
            Cause::Standing => "stops, dwells, beginning and end",
            Cause::Asked => "macros that ask the machine",
            Cause::Control => "the control's lag and its blocks not ready in time",
        }
    }
}

/// The numbers of a loss: mm, mm/s.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Detail {
    /// The axis that holds; of an exact stop 0 for the code of the block, 1 for the modal one.
    pub axis: u8,
    /// The code.
    pub code: Option<CodeOut>,
    /// The radius of the arc.
    pub radius: f64,
    /// The speed asked for.
    pub asked: f64,
    /// What the limits leave of it.
    pub allowed: f64,
    /// The highest speed reached.
    pub reached: f64,
    /// The speed at the corner.
    pub passed: f64,
    /// The length of the move.
    pub length: f64,
    /// The cosine of the turn.
    pub turn: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn causes_stand_in_the_order_of_their_numbers() {
        assert!(Cause::ALL.iter().enumerate().all(|(index, cause)| *cause as usize == index));
    }
}
