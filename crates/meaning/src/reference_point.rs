//! G28: by way of an intermediate point to the reference point, both in rapid.

use base::Alarm;

use crate::block::Reading;
use crate::command::Body;

impl Reading<'_> {
    /// G28. The intermediate point is a programmed one; the reference point is the machine's, offsets do not count.
    pub fn reference_return(&mut self) -> Result<(), Alarm> {
        let axes = self.axes_named()?;
        let mut via = self.next.machine;
        let mut to = self.next.machine;
        for axis in axes.iter() {
            via[axis] = self.target(axis)?;
            to[axis] = self.setting.facts.axes.get(axis).map_or(0.0, |facts| facts.reference_points[0]);
            self.next.displacement[axis] = 0.0;
        }
        // Where the reference point is, the axis is known again, whatever came before.
        self.now_known = self.now_known.or(axes);
        self.next.machine = to;
        self.command.body = Body::Via { via, to };
        Ok(())
    }
}
