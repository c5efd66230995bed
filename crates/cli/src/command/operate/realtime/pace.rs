//! The clock on the wall beside the control's own time, and how late each servo period came.

use std::thread;
use std::time::{Duration, Instant};

use base::Seconds;

/// Later than this, the schedule is set anew: a computer that slept must not make up for it at full speed.
const LOST: Duration = Duration::from_millis(500);
/// Latenesses are counted by the microsecond up to here.
const COUNTED_US: usize = 100_000;

/// Waits for the time to come.
pub struct Pace {
    zero: Instant,
    from: Seconds,
    period: Duration,
    counts: Vec<u32>,
    periods: u64,
    most: Duration,
    late_by_a_period: u64,
    lost: Duration,
    comes_first: bool,
}

/// Asks the system to let this thread run before all others; false if it does not grant that.
#[cfg(unix)]
fn comes_first() -> bool {
    use thread_priority::unix::{
        RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
    };
    use thread_priority::{ThreadPriority, ThreadPriorityValue};

    let Ok(value) = ThreadPriorityValue::try_from(50u8) else { return false };
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Crossplatform(value), policy).is_ok()
}

/// As above.
#[cfg(not(unix))]
fn comes_first() -> bool {
    thread_priority::set_current_thread_priority(thread_priority::ThreadPriority::Max).is_ok()
}

impl Pace {
    /// The clock starts, at this time of the control's.
    pub fn new(from: Seconds, period: Duration) -> Pace {
        Pace {
            zero: Instant::now(),
            from,
            period,
            counts: vec![0; COUNTED_US + 1],
            periods: 0,
            most: Duration::ZERO,
            late_by_a_period: 0,
            lost: Duration::ZERO,
            comes_first: comes_first(),
        }
    }

    /// Waits until the clock on the wall has come so far.
    pub fn wait_until(&mut self, time: Seconds) {
        let due = self.zero + Duration::from_secs_f64((time.0 - self.from.0).max(0.0));
        let left = due.saturating_duration_since(Instant::now());
        if !left.is_zero() {
            thread::sleep(left);
        }
        let late = Instant::now().saturating_duration_since(due);
        self.periods += 1;
        self.most = self.most.max(late);
        self.late_by_a_period += u64::from(late > self.period);
        let slot = usize::try_from(late.as_micros()).unwrap_or(COUNTED_US).min(COUNTED_US);
        if let Some(count) = self.counts.get_mut(slot) {
            *count += 1;
        }
        if late > LOST {
            self.zero += late;
            self.lost += late;
        }
    }

    /// So many of a thousand periods came at most so late, µs.
    fn quantile(&self, of_thousand: u64) -> usize {
        let wanted = (self.periods * of_thousand).div_ceil(1000);
        let mut seen = 0;
        let found = self.counts.iter().position(|&count| {
            seen += u64::from(count);
            seen >= wanted
        });
        found.unwrap_or(COUNTED_US)
    }

    /// What was seen, in a line.
    pub fn tells(&self) -> String {
        let mut text = format!(
            "{} servo periods of {} µs by the clock: late by {} µs (median), {} µs (99 of 100), {} µs (999 of 1000), {} µs (most); {} by more than a period\n",
            self.periods,
            self.period.as_micros(),
            self.quantile(500),
            self.quantile(990),
            self.quantile(999),
            self.most.as_micros(),
            self.late_by_a_period,
        );
        if !self.comes_first {
            text.push_str("the system grants no real-time priority: other programs hold the control up\n");
        }
        if !self.lost.is_zero() {
            text.push_str(&format!(
                "the computer did not keep up: {:.3} s were not made up for\n",
                self.lost.as_secs_f64()
            ));
        }
        text
    }
}
