//! The handshake of codes: code lines, strobe, FIN, and everything off again.
//!
//! A code goes on its lines; a set-up time later its strobe turns on. The machine acts, and when all codes that are out
//! are done it turns FIN on, one line for all of them. The control drops the strobes, the machine FIN, the control the
//! code lines. The lines of M00, M01, M02 and M30 turn on with the strobe and off with the code lines, so that inputs
//! wired to them can still be read when the code is done.

use base::{Place, Seconds};
use meaning::{CodeLine, CodeOut};

use super::Signal;
use crate::interface::HandshakeTimes;

/// Codes that can be out at once: those of one block.
const OUT: usize = 16;

/// A code on its lines.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Out {
    code: CodeOut,
    place: Place,
    /// Which code of the block on such lines.
    nth: u8,
    /// When its strobe turns on, s.
    strobe_at: f64,
    strobe: bool,
    /// From the strobe to the end of what the machine does, s.
    takes: f64,
    /// It is not done before this time: the builder's logic says when, at first never.
    until: f64,
    done: bool,
}

impl Out {
    /// When the machine has done it.
    fn due(&self) -> f64 {
        (self.strobe_at + self.takes).max(self.until)
    }
}

/// What the machine does with FIN.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Fin {
    /// What it should.
    #[default]
    Right,
    /// It never comes.
    Never,
    /// It is on before the strobe.
    Early,
    /// It never goes off.
    Stuck,
    /// The operator's script gives it.
    ByHand,
}

/// Why the control gives a handshake up.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Trouble {
    /// FIN has not come in time.
    Missing,
    /// FIN is on when a strobe turns on.
    Early,
    /// FIN has not gone off in time.
    Stuck,
}

/// What the control waits for.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Waiting {
    /// The signal.
    pub signal: Signal,
    /// It is to turn on.
    pub on: bool,
    /// The code that it is about.
    pub code: CodeOut,
    /// The block of the code.
    pub place: Place,
}

/// What happens next on the lines.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Moment {
    /// The strobe of this code turns on.
    Strobe(usize),
    /// The machine has done this code.
    Done(usize),
    /// FIN turns on.
    FinOn,
    /// The strobes fall.
    StrobesOff,
    /// FIN falls, and the code lines are cleared.
    Clear,
}

/// The codes that are out.
#[derive(Clone, PartialEq, Debug)]
pub struct Handshake {
    times: HandshakeTimes,
    out: [Option<Out>; OUT],
    any: bool,
    /// Since when FIN is on.
    fin: Option<f64>,
    /// Since when the strobes are off again.
    strobes_off: Option<f64>,
    /// What is wrong with FIN.
    fault: Fin,
    trouble: Option<(Trouble, f64)>,
}

impl Handshake {
    /// No code is out.
    pub fn new(times: HandshakeTimes) -> Handshake {
        let out = [None; OUT];
        Handshake { times, out, any: false, fin: None, strobes_off: None, fault: Fin::Right, trouble: None }
    }

    /// True while a code is out.
    #[inline]
    pub fn is_busy(&self) -> bool {
        self.any
    }

    /// True if a new code must wait: its lines carry one of another block, or FIN is being taken off.
    pub fn is_taken(&self, line: CodeLine, place: &Place) -> bool {
        let other = |out: &Out| out.code.line == line && (out.place.line, out.place.block) != (place.line, place.block);
        self.any && (self.fin.is_some() && self.fault != Fin::ByHand || self.out.iter().flatten().any(other))
    }

    /// A code goes on its lines; the machine is done so many seconds after its strobe, or when the builder's logic says
    /// so. Which code of the block on such lines it is.
    pub fn send(&mut self, code: CodeOut, place: &Place, now: Seconds, takes: Option<Seconds>) -> u8 {
        let nth = self.out.iter().flatten().filter(|out| out.code.line == code.line).count() as u8;
        let strobe_at = now.0 + self.times.set_up.0;
        if let Some(slot) = self.out.iter_mut().find(|slot| slot.is_none()) {
            let (until, takes) = takes.map_or((f64::INFINITY, 0.0), |takes| (f64::NEG_INFINITY, takes.0));
            *slot = Some(Out { code, place: *place, nth, strobe_at, strobe: false, takes, until, done: false });
            self.any = true;
        }
        nth
    }

    /// A code that is out: itself, its number among those on such lines, its block.
    pub fn out(&self, index: usize) -> Option<(CodeOut, u8, Place)> {
        self.out.get(index).copied().flatten().map(|out| (out.code, out.nth, out.place))
    }

    /// Every code that is out.
    pub fn all_out(&self) -> impl Iterator<Item = (CodeOut, u8, bool)> {
        self.out.iter().flatten().map(|out| (out.code, out.nth, out.strobe))
    }

    /// True while FIN is on.
    pub fn has_fin(&self) -> bool {
        self.fin.is_some()
    }

    /// True while the strobes are on.
    pub fn has_strobes(&self) -> bool {
        self.strobes_off.is_none() && self.out.iter().flatten().any(|out| out.strobe)
    }

    /// True when the strobes have fallen.
    pub fn is_ending(&self) -> bool {
        self.strobes_off.is_some()
    }

    /// The machine takes at least so long for a code.
    pub fn lengthen(&mut self, index: usize, takes: f64) {
        if let Some(Some(out)) = self.out.get_mut(index) {
            out.takes = out.takes.max(takes);
        }
    }

    /// The builder's logic has done a code.
    pub fn end(&mut self, index: usize, at: f64) {
        if let Some(Some(out)) = self.out.get_mut(index) {
            out.until = out.until.min(at);
        }
    }

    /// The next thing on the lines, and when.
    pub fn next(&self) -> Option<(f64, Moment)> {
        if !self.any || self.trouble.is_some() {
            return None;
        }
        if let Some(off) = self.strobes_off {
            let falls = !matches!(self.fault, Fin::Stuck | Fin::ByHand);
            return falls.then_some((off + self.times.fin_off.0, Moment::Clear));
        }
        let early = self.fault == Fin::Early && self.fin.is_none();
        let mut first: Option<(f64, Moment)> = early.then_some((f64::NEG_INFINITY, Moment::FinOn));
        let mut last = f64::NEG_INFINITY;
        let mut all_done = true;
        for (index, out) in self.out.iter().enumerate() {
            let Some(out) = out else { continue };
            let done = out.due();
            last = last.max(done);
            let next = match (out.strobe, out.done) {
                (false, _) => (out.strobe_at, Moment::Strobe(index)),
                (true, false) => (done, Moment::Done(index)),
                (true, true) => continue,
            };
            all_done = false;
            let waits = matches!(next.1, Moment::Done(_)) && !matches!(self.fault, Fin::Right | Fin::Stuck);
            if !waits && first.is_none_or(|(at, _)| next.0 < at) {
                first = Some(next);
            }
        }
        match (all_done, self.fin) {
            (false, _) => first,
            (true, None) => Some((last, Moment::FinOn)),
            (true, Some(on)) => Some((on.max(last) + self.times.strobe_off.0, Moment::StrobesOff)),
        }
    }

    /// When the control gives up, and why.
    pub fn gives_up(&self) -> Option<(f64, Trouble)> {
        if let Some((trouble, at)) = self.trouble {
            return Some((at, trouble));
        }
        if !self.any || self.times.time_out.0 <= 0.0 {
            return None;
        }
        let time_out = self.times.time_out.0;
        match self.strobes_off {
            Some(off) => Some((off + time_out, Trouble::Stuck)),
            None if self.fin.is_some() => None,
            None => {
                // Whom the builder's logic keeps waiting it tells itself.
                let begins = self.out.iter().flatten().map(|out| out.strobe_at.max(out.until));
                Some((begins.fold(f64::NEG_INFINITY, f64::max) + time_out, Trouble::Missing))
            }
        }
    }

    /// What came next has come. True if the codes are done.
    pub fn pass(&mut self, at: f64, moment: Moment) -> bool {
        match moment {
            Moment::Strobe(index) => {
                if self.fin.is_some() {
                    self.trouble = Some((Trouble::Early, at));
                }
                if let Some(Some(out)) = self.out.get_mut(index) {
                    out.strobe = true;
                }
            }
            Moment::Done(index) => {
                if let Some(Some(out)) = self.out.get_mut(index) {
                    out.done = true;
                }
            }
            Moment::FinOn => self.fin = Some(at),
            Moment::StrobesOff => self.strobes_off = Some(at),
            Moment::Clear => {
                self.clear();
                return true;
            }
        }
        false
    }

    /// The lines are cleared.
    fn clear(&mut self) {
        self.out = [None; OUT];
        self.any = false;
        self.fin = None;
        self.strobes_off = None;
    }

    /// RESET: no code is out any more, and what was wrong with FIN has been put right. True if FIN falls by that.
    pub fn drop_codes(&mut self) -> bool {
        let by_hand = self.fault == Fin::ByHand;
        let fin = self.fin.filter(|_| by_hand);
        let falls = self.fin.is_some() && fin.is_none();
        self.clear();
        self.fin = fin;
        self.trouble = None;
        if !by_hand {
            self.fault = Fin::Right;
        }
        falls
    }

    /// What the machine does with FIN from now on.
    pub fn set_fault(&mut self, fault: Fin) {
        self.fault = fault;
    }

    /// The script turns FIN on or off, and gives it from now on. True if that is an edge.
    pub fn set_fin(&mut self, on: bool, now: Seconds) -> bool {
        self.fault = Fin::ByHand;
        if on == self.fin.is_some() {
            return false;
        }
        self.fin = on.then_some(now.0);
        true
    }

    /// The next code that FIN by hand answers: FIN is on, and its strobe.
    pub fn answered_by_hand(&self) -> Option<usize> {
        let answered = self.fault == Fin::ByHand && self.fin.is_some() && self.trouble.is_none();
        let waits = |out: &Option<Out>| out.is_some_and(|out| out.strobe && !out.done);
        if answered { self.out.iter().position(waits) } else { None }
    }

    /// True if FIN by hand has fallen behind the strobes.
    pub fn is_cleared_by_hand(&self) -> bool {
        self.fault == Fin::ByHand && self.strobes_off.is_some() && self.fin.is_none()
    }

    /// What the control waits for on these lines.
    pub fn waiting(&self) -> Option<Waiting> {
        // The one that takes longest, of several alike the first.
        let mut last: Option<&Out> = None;
        for out in self.out.iter().flatten().filter(|out| !out.done || self.fin.is_some()) {
            if last.is_none_or(|last| out.due() > last.due()) {
                last = Some(out);
            }
        }
        let &Out { code, place, .. } = last.or_else(|| self.out.iter().flatten().next())?;
        Some(Waiting { signal: Signal::Fin, on: self.strobes_off.is_none(), code, place })
    }
}
