//! G22 and G23: the second stored stroke area, a box in machine coordinates.
//!
//! G22 X Y Z I J K: X, Y, Z are the upper faces, I, J, K the lower ones (or two corners in any order, by the control's
//! table), whatever G90 or G91 says. A face that is left
//! out keeps its place; G22 without words turns the stored box on again, G23 turns it off and keeps it. The machine
//! checks its moves: here the box is only read.

use base::{AXES, Alarm, AxisSet, Condition, Point};
use dialect::Meaning;

use crate::block::Reading;
use crate::command::Body;
use crate::operation::{SetValue, StrokeArea};
use crate::unknown::letter_bit;

/// The axes of the box and the letters of their lower faces.
const FACES: [(u8, u8); 3] = [(b'X', b'I'), (b'Y', b'J'), (b'Z', b'K')];

/// The stored box: machine coordinates, counts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct StrokeBox {
    /// The axes along which it is known; all of X, Y and Z that the machine has, or none.
    pub axes: AxisSet,
    /// Lower faces along X, Y, Z.
    pub low: [f64; 3],
    /// Upper faces.
    pub high: [f64; 3],
}

impl StrokeBox {
    /// No box.
    pub(crate) const NONE: StrokeBox = StrokeBox { axes: AxisSet::NONE, low: [0.0; 3], high: [0.0; 3] };
}

impl Reading<'_> {
    /// Takes the box from the words of a block with G22; true if it did and nothing moves.
    pub fn stroke_box(&mut self) -> Result<bool, Alarm> {
        let Some(group) = self.control().roles.stroke else { return Ok(false) };
        let on = self.control().in_force(&self.next.groups, group) == Some(Meaning::StrokeCheckOn);
        self.command.stroke_check = on;
        let letters = FACES.iter().fold(0, |set, &(high, low)| set | letter_bit(high) | letter_bit(low));
        if !on || self.groups_written & (1 << group) == 0 || !self.words.has_any(letters) {
            return Ok(false);
        }
        let known = !self.next.stroke.axes.is_empty();
        let mut stroke = self.next.stroke;
        for (index, (upper, lower)) in FACES.into_iter().enumerate() {
            let Some(axis) = self.setting.facts.axis(upper) else { continue };
            stroke.axes.add(axis);
            if self.words.has(upper) {
                stroke.high[index] = self.axis_word(axis)?.0;
            }
            if let Some(low) = self.words.length(self.control(), lower, self.units)? {
                stroke.low[index] = low;
            }
            let both = self.words.has(upper) && self.words.has(lower);
            if !known && !both {
                return Err(self.group_alarm(Condition::StrokeBoxIncomplete, Some(group)).on_axis(axis));
            }
            let (low, high) = (stroke.low[index], stroke.high[index]);
            if high <= low && !self.control().functions.any_corners {
                let letter = if self.words.has(upper) { upper } else { lower };
                let alarm = self.words.alarm(Condition::StrokeBoxOrder, letter);
                return Err(alarm.with([high / 1e6, low / 1e6, 0.0]).on_axis(axis));
            }
        }
        self.next.stroke = stroke;
        self.command.body = Body::Set(SetValue::StrokeArea(self.area(&stroke)), None);
        Ok(true)
    }

    /// The box as the machine checks it.
    fn area(&self, stroke: &StrokeBox) -> StrokeArea {
        let (mut low, mut high): (Point, Point) = ([0.0; AXES], [0.0; AXES]);
        for (index, (letter, _)) in FACES.into_iter().enumerate() {
            if let Some(axis) = self.setting.facts.axis(letter) {
                let (one, other) = (stroke.low[index] / 1e6, stroke.high[index] / 1e6);
                (low[axis], high[axis]) = (one.min(other), one.max(other));
            }
        }
        let outside = self
            .control()
            .stroke_outside
            .is_some_and(|(parameter, bit)| self.setting.fitting.parameter(parameter) as u8 & (1 << bit) != 0);
        StrokeArea { axes: stroke.axes, low, high, outside }
    }
}
