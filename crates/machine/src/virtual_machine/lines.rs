//! How the lines between control and machine stand, for whoever looks: nothing is changed by a look.

use meaning::CodeLine;

use super::VirtualMachine;
use crate::signals::{Signal, bits};

/// The lines of codes, in the order in which a machine's file gives their digits.
const LINES: [CodeLine; 4] = [CodeLine::M, CodeLine::S, CodeLine::T, CodeLine::B];

impl VirtualMachine {
    /// Shows how every line that codes go out on stands: of each code line so many decades, the strobes, the lines of
    /// single M codes, FIN and DEN, EOP and RWD as those M codes drive them. A block's further codes on the same lines
    /// are shown while they are out.
    pub fn see_code_lines(&self, digits: [u8; 4], see: &mut dyn FnMut(Signal, bool)) {
        let codes = &self.handshake;
        for (line, digits) in LINES.into_iter().zip(digits) {
            let mut further = 0;
            for nth in 0.. {
                let out =
                    codes.all_out().find(|(code, own, _)| code.line == line && *own == nth).map(|(code, ..)| code);
                if out.is_none() && nth > 0 {
                    break;
                }
                for decade in 0..digits {
                    for weight in [1, 2, 4, 8] {
                        let on = |code: u32| bits(code, digits).any(|bit| bit == (decade, weight));
                        see(Signal::Bit(line, nth, decade, weight), out.is_some_and(|code| on(code.code)));
                    }
                }
                further = nth;
            }
            for nth in 0..=further {
                let strobe = codes.all_out().any(|(code, own, strobe)| code.line == line && own == nth && strobe);
                see(Signal::Strobe(line, nth), strobe && codes.has_strobes());
            }
        }
        let is_out = |wanted: u32| {
            codes.all_out().any(|(code, _, strobe)| strobe && code.line == CodeLine::M && code.code == wanted)
        };
        self.decoded.iter().for_each(|row| see(Signal::Decoded(row.code), is_out(row.code)));
        see(Signal::Fin, codes.has_fin());
        see(Signal::Den, self.den);
        see(Signal::Eop, self.decoded.iter().any(|row| row.eop && is_out(row.code)));
        see(Signal::Rwd, self.decoded.iter().any(|row| row.rwd && is_out(row.code)));
    }

    /// Shows what the spindle's drive says.
    pub fn see_spindle_lines(&self, see: &mut dyn FnMut(Signal, bool)) {
        let says = self.spindle_says();
        let lines = [Signal::SpeedReached, Signal::SpindleStands, Signal::Oriented];
        lines.into_iter().zip(says).for_each(|(signal, on)| see(signal, on));
    }
}
