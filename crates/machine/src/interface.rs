//! What the builder's file says of the lines between control and machine: times, wiring, spindle.

use base::Seconds;
use data::Table;

use crate::path_table::not_negative;

/// How long the steps of a handshake take, s. All but the last are none unless the builder says so.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HandshakeTimes {
    /// From a code on its lines to its strobe.
    pub set_up: Seconds,
    /// From FIN to the fall of the strobes.
    pub strobe_off: Seconds,
    /// From the fall of the strobes to that of FIN.
    pub fin_off: Seconds,
    /// The longest wait for an edge of FIN; 0 waits for ever.
    pub time_out: Seconds,
}

/// The longest wait for FIN if the builder says nothing, s.
const TIME_OUT_S: f64 = 60.0;

/// Reads the keys of a handshake in `[functions]`. A machine whose slowest code takes `longest` is not given up before
/// twice that time.
pub(crate) fn handshake_times(table: &mut Table, longest: f64) -> HandshakeTimes {
    let mut time = |key, missing| Seconds(not_negative(table, key, missing));
    HandshakeTimes {
        set_up: time("setup_time", 0.0),
        strobe_off: time("strobe_off_time", 0.0),
        fin_off: time("fin_off_time", 0.0),
        time_out: time("fin_timeout", default_time_out(longest)),
    }
}

/// The times of a file without `[functions]`.
pub(crate) fn default_handshake_times(longest: f64) -> HandshakeTimes {
    let none = Seconds(0.0);
    HandshakeTimes { set_up: none, strobe_off: none, fin_off: none, time_out: Seconds(default_time_out(longest)) }
}

fn default_time_out(longest: f64) -> f64 {
    TIME_OUT_S.max(2.0 * longest)
}

/// An M code with a line of its own, and the inputs that the builder drives by it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct DecodedLine {
    /// The code.
    pub code: u32,
    /// It drives the input for internal reset.
    pub eop: bool,
    /// It drives the rewind input.
    pub rwd: bool,
}
