//! The lines between control and machine: which there are and what they are called.
//!
//! [`handshake`] says in what order those of codes turn on and off, [`interface`](crate::interface) what the builder
//! wired and how long each step takes.

mod handshake;
mod magazine;
mod spindle;

use meaning::CodeLine;

pub use handshake::{Fin, Handshake, Moment, Trouble, Waiting};
pub(crate) use magazine::magazine;
pub use magazine::{Magazine, MagazineFacts};
pub(crate) use spindle::spindle;
pub use spindle::{Spindle, SpindleFacts};

/// One line. Its name is what the trace and charts call it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Signal {
    /// One bit of a code: the line, which code of the block on such lines (from 0), the decade and the weight in it.
    Bit(CodeLine, u8, u8, u8),
    /// The strobe of a code.
    Strobe(CodeLine, u8),
    /// The line of its own of this M code.
    Decoded(u32),
    /// The machine has done what the strobes ask for.
    Fin,
    /// Distribution end: the motion of a block is done whose codes are still out.
    Den,
    /// The input for internal reset.
    Eop,
    /// The input for rewinding.
    Rwd,
    /// The skip input.
    Skip,
    /// The program interrupt input.
    Interrupt,
    /// The spindle has reached its speed.
    SpeedReached,
    /// The spindle stands.
    SpindleStands,
    /// The spindle stands at its angle.
    Oriented,
    /// The overtravel switch of an axis, in its positive or negative direction.
    Limit(u8, bool),
    /// The switch that an axis' dog actuates.
    Deceleration(u8),
    /// A line that the builder has named.
    Line(u8),
}

impl Signal {
    /// Its name. `decoded` names the line of an M code, `axis` the letter of an axis, `line` one of the builder's.
    pub fn name(
        self,
        decoded: impl Fn(u32) -> String,
        axis: impl Fn(u8) -> String,
        line: impl Fn(u8) -> String,
    ) -> String {
        // The second and third code of a block have lines of their own: M2, M3.
        let nth = |nth: u8| if nth == 0 { String::new() } else { (nth + 1).to_string() };
        match self {
            Signal::Bit(line, 0, decade, weight) => format!("{}{}{weight}", line.letter(), decade + 1),
            Signal::Bit(line, n, decade, weight) => format!("{}{}-{}{weight}", line.letter(), nth(n), decade + 1),
            Signal::Strobe(line, n) => format!("{}F{}", line.letter(), nth(n)),
            Signal::Decoded(code) => decoded(code),
            Signal::Fin => "FIN".to_owned(),
            Signal::Den => "DEN".to_owned(),
            Signal::Eop => "EOP".to_owned(),
            Signal::Rwd => "RWD".to_owned(),
            Signal::Skip => "skip".to_owned(),
            Signal::Interrupt => "interrupt".to_owned(),
            Signal::SpeedReached => "SAR".to_owned(),
            Signal::SpindleStands => "ZSP".to_owned(),
            Signal::Oriented => "ORE".to_owned(),
            Signal::Deceleration(index) => format!("DEC{}", axis(index)),
            Signal::Line(index) => line(index),
            Signal::Limit(index, positive) => format!("OT{}{}", if positive { '+' } else { '-' }, axis(index)),
        }
    }
}

/// The bits of a code in BCD that are on, least decade first.
pub fn bits(code: u32, digits: u8) -> impl Iterator<Item = (u8, u8)> {
    (0..digits.min(9)).flat_map(move |decade| {
        let digit = code / 10u32.pow(u32::from(decade)) % 10;
        [1u8, 2, 4, 8]
            .into_iter()
            .filter(move |&weight| digit & u32::from(weight) != 0)
            .map(move |weight| (decade, weight))
    })
}

/// An overtravel switch: it is on beyond a place, in one direction of an axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimitSwitch {
    /// The index of the axis.
    pub axis: usize,
    /// In its positive direction.
    pub positive: bool,
    /// The machine coordinate at which it turns on, mm or degrees.
    pub at: f64,
    /// It was on at the last look.
    pub on: bool,
}

impl LimitSwitch {
    /// True if the axis stands on it.
    pub fn is_on(&self, position: &base::Point) -> bool {
        let at = position[self.axis];
        if self.positive { at >= self.at } else { at <= self.at }
    }

    /// Its line.
    pub const fn signal(&self) -> Signal {
        Signal::Limit(self.axis as u8, self.positive)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_is_its_bits() {
        assert_eq!(bits(30, 2).collect::<Vec<_>>(), [(1, 1), (1, 2)]);
        assert_eq!(bits(9, 2).collect::<Vec<_>>(), [(0, 1), (0, 8)]);
        assert_eq!(bits(0, 2).count(), 0);
        let name = |signal: Signal| signal.name(|code| format!("M{code:02}R"), |_| "X".to_owned(), |_| String::new());
        assert_eq!(name(Signal::Bit(CodeLine::M, 0, 1, 2)), "M22");
        assert_eq!(name(Signal::Bit(CodeLine::M, 1, 0, 8)), "M2-18");
        assert_eq!(name(Signal::Strobe(CodeLine::B, 0)), "BF");
        assert_eq!(name(Signal::Limit(0, true)), "OT+X");
    }
}
