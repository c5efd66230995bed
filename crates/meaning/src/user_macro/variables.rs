//! The variables that a program owns: local ones by level of call, common ones, the outputs behind some numbers.

use dialect::{UserMacro, VariableMeaning};

/// What a variable holds that was never written: no number at all. (A NaN, which no expression can yield.)
pub const BLANK: f64 = f64::NAN;

/// Local variables of a level.
pub(crate) const LOCALS: usize = 33;

/// Every variable that is written by programs and by hand.
#[derive(Clone, Debug)]
pub struct Variables {
    /// #1 to #33 of the main program and of every level of macro calls.
    locals: Vec<[f64; LOCALS]>,
    /// Blank at power-on and after reset.
    volatile: Vec<f64>,
    /// Kept while power is off.
    permanent: Vec<f64>,
    /// Numbers of the first volatile and the first permanent one.
    first: [u32; 2],
    /// The interface outputs that programs switch.
    pub outputs: u32,
    /// What the clock (s) and the hour counter (h) showed when they were last written, less what they would have shown.
    pub clock_shift: [f64; 2],
}

impl PartialEq for Variables {
    /// Equal if they hold the same, blanks included.
    fn eq(&self, other: &Self) -> bool {
        let same =
            |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
        self.outputs == other.outputs
            && same(&self.volatile, &other.volatile)
            && same(&self.permanent, &other.permanent)
            && same(&self.clock_shift, &other.clock_shift)
            && self.locals.len() == other.locals.len()
            && self.locals.iter().zip(&other.locals).all(|(a, b)| same(a, b))
    }
}

impl Variables {
    /// All blank, for a control with this user macro and so many levels of macro calls.
    pub fn new(table: &UserMacro, levels: usize) -> Variables {
        let range = |meaning| table.range_of(meaning).unwrap_or((1, 0));
        let size = |(from, to): (u32, u32)| (to + 1).saturating_sub(from) as usize;
        let (volatile, permanent) = (range(VariableMeaning::CommonVolatile), range(VariableMeaning::CommonPermanent));
        Variables {
            locals: vec![[BLANK; LOCALS]; levels + 1],
            volatile: vec![BLANK; size(volatile)],
            permanent: vec![BLANK; size(permanent)],
            first: [volatile.0, permanent.0],
            outputs: 0,
            clock_shift: [0.0; 2],
        }
    }

    /// Takes everything over from another one of the same control, without allocating.
    pub(crate) fn copy_from(&mut self, other: &Variables) {
        if self.locals.len() != other.locals.len() {
            *self = other.clone();
            return;
        }
        self.locals.copy_from_slice(&other.locals);
        self.volatile.copy_from_slice(&other.volatile);
        self.permanent.copy_from_slice(&other.permanent);
        self.outputs = other.outputs;
        self.clock_shift = other.clock_shift;
    }

    /// The variables that are kept while power is off, by their numbers; a blank is [`BLANK`].
    pub fn kept(&self) -> impl Iterator<Item = (u32, f64)> {
        (self.first[1]..).zip(self.permanent.iter().copied())
    }

    /// Writes a variable that is kept while power is off; false if there is none of this number.
    pub fn set_kept(&mut self, number: u32, value: f64) -> bool {
        let slot = number.checked_sub(self.first[1]).and_then(|index| self.permanent.get_mut(index as usize));
        slot.is_some_and(|slot| {
            *slot = value;
            true
        })
    }

    /// What reset and power-on blank: local and volatile variables.
    pub fn reset(&mut self) {
        self.locals.fill([BLANK; LOCALS]);
        self.volatile.fill(BLANK);
    }

    /// The index of a volatile (0) or permanent (1) variable by its number.
    pub(crate) fn index(&self, kind: usize, number: u32) -> u16 {
        number.saturating_sub(self.first[kind]).min(u32::from(u16::MAX)) as u16
    }

    /// The number of the volatile (0) or permanent (1) variable of this index.
    pub(crate) fn number(&self, kind: usize, index: u16) -> u32 {
        self.first[kind] + u32::from(index)
    }

    #[inline]
    pub(crate) fn local(&self, level: usize, index: u8) -> f64 {
        self.locals.get(level).and_then(|set| set.get(usize::from(index).wrapping_sub(1))).copied().unwrap_or(BLANK)
    }

    #[inline]
    pub(crate) fn set_local(&mut self, level: usize, index: u8, value: f64) {
        if let Some(slot) = self.locals.get_mut(level).and_then(|set| set.get_mut(usize::from(index).wrapping_sub(1))) {
            *slot = value;
        }
    }

    #[inline]
    pub(crate) fn volatile(&self, index: u16) -> f64 {
        self.volatile.get(usize::from(index)).copied().unwrap_or(BLANK)
    }

    #[inline]
    pub(crate) fn set_volatile(&mut self, index: u16, value: f64) {
        if let Some(slot) = self.volatile.get_mut(usize::from(index)) {
            *slot = value;
        }
    }

    #[inline]
    pub(crate) fn permanent(&self, index: u16) -> f64 {
        self.permanent.get(usize::from(index)).copied().unwrap_or(BLANK)
    }

    #[inline]
    pub(crate) fn set_permanent(&mut self, index: u16, value: f64) {
        if let Some(slot) = self.permanent.get_mut(usize::from(index)) {
            *slot = value;
        }
    }

    /// The whole set of a level.
    pub(crate) fn set_locals(&mut self, level: usize, values: &[f64; LOCALS]) {
        if let Some(set) = self.locals.get_mut(level) {
            *set = *values;
        }
    }
}
