//! F: per minute, per revolution, one digit for a stored feed; what a cutting move makes of it.

use base::units::NM_PER_INCH;
use base::{AXES, Alarm, Condition, Point, UnitSystem};
use dialect::{FeedModeChange, InchFeedInteger, Meaning};

use crate::block::Reading;
use crate::operation::Feed;
use crate::record::ReadAs;
use crate::state::FeedWord;

impl Reading<'_> {
    /// True where F counts per revolution: under feed per revolution, and of a thread, whose lead it is.
    pub fn is_per_revolution(&self) -> bool {
        let control = self.setting.control.as_ref();
        control.in_force(&self.next.groups, control.roles.feed_mode) == Some(Meaning::FeedPerRevolution)
            || self.cuts_thread()
    }

    /// The way of counting F changes. F does not come back with the old way either, unless its number is kept.
    #[cold]
    pub fn leave_feed(&mut self) {
        if self.setting.fitting.policies.feed_mode_change == FeedModeChange::NeedsF {
            self.next.feed.nanometres = 0.0;
        }
    }

    /// True if the block's cut is synchronised with the spindle.
    fn cuts_thread(&self) -> bool {
        let (control, groups) = (self.setting.control.as_ref(), &self.next.groups);
        control.in_force(groups, control.roles.motion) == Some(Meaning::Thread)
            && matches!(self.one_shot, None | Some((Meaning::ExactStop, _)))
            && !control.in_force(groups, control.roles.cycle).is_some_and(Meaning::is_cycle)
    }

    /// The block's F.
    pub fn take_feed(&mut self) -> Result<(), Alarm> {
        let control = self.setting.control.as_ref();
        let (Some(number), Some(address)) = (self.words.number(b'F')?, control.address(b'F')) else { return Ok(()) };
        let per_revolution = self.is_per_revolution();
        let one_digit = number.digits == 1 && !number.point && !number.negative;
        if one_digit && !per_revolution && self.setting.fitting.options.one_digit_feed {
            let nanometres = self.stored_feed(number.mantissa)?;
            self.words.note(b'F', ReadAs::FeedPerMinute, nanometres / 1e6);
            self.next.feed = FeedWord { nanometres, per_revolution, inch: false };
            return Ok(());
        }
        let nanometres = if per_revolution {
            control.feed_per_revolution(address, self.words.pointed(number), self.units, self.words.coarse)
        } else {
            let tenths = self.setting.fitting.policies.inch_feed_integer == InchFeedInteger::Tenth;
            control.feed_per_minute(address, number, self.units, tenths)
        };
        let nanometres = nanometres.map_err(|(condition, values)| self.words.alarm(condition, b'F').with(values))?;
        let read = if per_revolution { ReadAs::FeedPerRevolution } else { ReadAs::FeedPerMinute };
        self.words.note(b'F', read, nanometres / 1e6);
        self.next.feed = FeedWord { nanometres, per_revolution, inch: self.units == UnitSystem::Inch };
        Ok(())
    }

    /// What 1 of an F without a point is worth, in mm or inches a minute or a turn.
    pub fn least_feed(&self) -> f64 {
        let [metric, inch, _] = self.setting.control.increments;
        let coarse = self.words.coarse as f64;
        let tenths = self.setting.fitting.policies.inch_feed_integer == InchFeedInteger::Tenth;
        match (self.is_per_revolution(), self.units) {
            (true, UnitSystem::Metric) => metric as f64 * coarse / 1e6,
            (true, UnitSystem::Inch) => inch as f64 * coarse / NM_PER_INCH as f64,
            (false, UnitSystem::Inch) if tenths => 0.1,
            (false, _) => 1.0,
        }
    }

    /// What a one-digit F calls: a feed from the parameters, or for F0 one without bounds, which is the rapid rate.
    fn stored_feed(&self, digit: u64) -> Result<f64, Alarm> {
        if digit == 0 {
            return Ok(f64::INFINITY);
        }
        let index = usize::try_from(digit - 1).unwrap_or(usize::MAX);
        let parameter = self.setting.control.feeds.stored.get(index).copied().flatten();
        let mm_per_min = self.setting.fitting.parameter_if_any(parameter);
        if mm_per_min <= 0.0 {
            return Err(self.words.alarm(Condition::StoredFeedMissing, b'F').with([digit as f64, 0.0, 0.0]));
        }
        Ok(mm_per_min * 1e6)
    }

    /// The feed of a straight cut to `to`. If rotary axes alone move, F is degrees a minute or a turn, in inches too.
    #[inline]
    pub fn feed_to(&self, to: &Point) -> Result<Feed, Alarm> {
        if self.next.feed.inch && self.turns_alone(to) {
            self.feed_by(1e6 / NM_PER_INCH as f64)
        } else {
            self.feed_by(1.0)
        }
    }

    /// True if rotary axes alone move.
    #[cold]
    fn turns_alone(&self, to: &Point) -> bool {
        let axes = self.setting.facts.axes.iter().enumerate().take(AXES);
        let mut moving = axes.filter(|&(axis, _)| to[axis] != self.next.machine[axis]).peekable();
        moving.peek().is_some() && moving.all(|(_, facts)| facts.rotary)
    }

    /// The feed of a cutting move.
    #[inline]
    pub fn feed(&self) -> Result<Feed, Alarm> {
        self.feed_by(1.0)
    }

    #[inline]
    fn feed_by(&self, factor: f64) -> Result<Feed, Alarm> {
        let per_revolution = self.is_per_revolution();
        let keeps = self.setting.fitting.policies.feed_mode_change == FeedModeChange::KeepsNumber;
        let feed = self.next.feed;
        if feed.nanometres <= 0.0 || (feed.per_revolution != per_revolution && !keeps) {
            return Err(self.motion_alarm(Condition::FeedMissing));
        }
        let mut mm = feed.nanometres / 1e6 * factor;
        if per_revolution {
            mm *= self.spindle_rpm().map_err(|condition| self.motion_alarm(condition))?;
        }
        let limit = self.setting.fitting.parameter_if_any(self.setting.control.feeds.limit);
        if limit > 0.0 && mm.is_finite() {
            mm = mm.min(limit);
        }
        Ok(Feed { mm_per_min: mm, exact_stop: self.exact_stop, tapping: self.tapping, per_revolution, way_mm: 0.0 })
    }

    /// The spindle speed that S has set, rev/min.
    pub fn spindle_rpm(&self) -> Result<f64, Condition> {
        if !self.setting.fitting.options.spindle_rpm {
            return Err(Condition::SpindleSpeedCoded);
        }
        if self.next.spindle == 0 {
            return Err(Condition::SpindleSpeedMissing);
        }
        Ok(f64::from(self.next.spindle))
    }
}
