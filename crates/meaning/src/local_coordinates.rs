//! G52: a local origin in every work system.
//!
//! Its words count from the zero of the work system whatever G90 or G91 says; axes without a word keep theirs, and a
//! zero takes it back. Nothing moves.

use base::Alarm;
use dialect::Meaning;

use crate::block::Reading;
use crate::command::Body;
use crate::operation::SetValue;

impl Reading<'_> {
    /// G52.
    pub fn local_coordinates(&mut self) -> Result<(), Alarm> {
        let axes = self.axes_named();
        for axis in axes.iter() {
            let (value, _) = self.axis_word(axis)?;
            self.next.common_shift[axis] += value - self.next.local[axis];
            self.next.local[axis] = value;
        }
        if !axes.is_empty() {
            let code = self.control().row_of(Meaning::LocalCoordinates);
            let shift = self.setting.to_mm(&self.next.local);
            self.command.body = Body::Set(SetValue::Shift { code, axes, shift }, None);
        }
        Ok(())
    }
}
