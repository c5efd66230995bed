//! How far a run is, and how long it still takes: on a terminal, and of the computer's time, not the machine's.
//!
//! What is to do is counted by running the program once without times, which is several times as fast. That happens
//! only when a run has taken [`PATIENCE`], so a short one is not delayed by it.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use machine::{Event, EventKind};

use crate::arguments::SettingArguments;
use crate::command::{open, run_through};

/// A run that takes less is not counted before.
const PATIENCE: Duration = Duration::from_millis(500);
/// Events between two looks at the clock.
const EVENTS_A_LOOK: u32 = 512;
/// Time between two pictures of the bar.
const PICTURE: Duration = Duration::from_millis(200);
/// Steps of the bar.
const STEPS: u64 = 1000;

/// What the parts of a run cost, microseconds where they were measured (`python3 benches/progress.py weights`); what
/// they cost beside each other is all that counts.
const BLOCK: f64 = 0.25;
const CUT: f64 = 1.25;
/// Behind something that is no cut, nothing is planned together with it.
const LONE_CUT: f64 = 0.6;
const ARC_CELL: f64 = 0.83;
const RAPID: f64 = 0.15;
const OTHER: f64 = 0.06;
/// Radians of an arc that are planned together, and most of them in one.
const CELL: f64 = 0.27;
const MOST_CELLS: f64 = 512.0;

/// The work of a run, added up event by event.
#[derive(Default)]
struct Work {
    all: f64,
    /// The last move was a cut.
    cutting: bool,
}

impl Work {
    fn add(&mut self, event: &Event) {
        let cut = if self.cutting { CUT } else { LONE_CUT };
        self.all += match &event.kind {
            EventKind::BlockDone => BLOCK,
            EventKind::Feed { .. } => cut,
            EventKind::Arc { arc, .. } => cut + ARC_CELL * (arc.sweep.abs() / CELL).min(MOST_CELLS),
            EventKind::Rapid { .. } => RAPID,
            _ => OTHER,
        };
        match &event.kind {
            EventKind::Feed { .. } | EventKind::Arc { .. } => self.cutting = true,
            EventKind::Rapid { .. } => self.cutting = false,
            _ => {}
        }
    }
}

/// The progress of a run.
pub struct Progress {
    bar: ProgressBar,
    /// What to count the work of; nothing where it cannot be counted before.
    counted: Option<(String, SettingArguments)>,
    /// All that is to do, once it is counted.
    all: Option<f64>,
    done: Work,
    blocks: u64,
    since_look: u32,
    begun: Instant,
    /// Time spent counting.
    counting: Duration,
    shown: Instant,
}

impl Progress {
    /// The run of this file begins.
    pub fn new(file: &str, setting: &SettingArguments) -> Progress {
        let shows = std::io::stderr().is_terminal();
        let can_count = shows && std::fs::metadata(file).is_ok_and(|facts| facts.is_file());
        let bar = if shows { ProgressBar::new(STEPS) } else { ProgressBar::hidden() };
        let now = Instant::now();
        let progress = Progress {
            bar,
            counted: can_count.then(|| (file.to_owned(), setting.clone())),
            all: None,
            done: Work::default(),
            blocks: 0,
            since_look: 0,
            begun: now,
            counting: Duration::ZERO,
            shown: now,
        };
        progress.style("{spinner} {msg}");
        progress
    }

    fn style(&self, template: &str) {
        if let Ok(style) = ProgressStyle::with_template(template) {
            self.bar.set_style(style);
        }
    }

    /// Takes an event in.
    pub fn see(&mut self, event: &Event) {
        if self.bar.is_hidden() {
            return;
        }
        self.done.add(event);
        self.blocks += u64::from(matches!(event.kind, EventKind::BlockDone));
        self.since_look += 1;
        if self.since_look >= EVENTS_A_LOOK {
            self.since_look = 0;
            self.look();
        }
    }

    fn look(&mut self) {
        if self.begun.elapsed() > PATIENCE
            && let Some((file, setting)) = self.counted.take()
        {
            let start = Instant::now();
            self.bar.set_message("counting what is to do");
            self.bar.tick();
            self.all = count(&file, &setting);
            self.counting = start.elapsed();
            if self.all.is_some() {
                self.style("{bar:40} {percent:>3} %  {msg}");
            }
        }
        if self.shown.elapsed() < PICTURE {
            return;
        }
        self.shown = Instant::now();
        match self.all.filter(|all| *all > 0.0) {
            None => {
                self.bar.set_message(format!("{} blocks done", self.blocks));
                self.bar.tick();
            }
            Some(all) => {
                let part = (self.done.all / all).min(1.0);
                let spent = (self.begun.elapsed() - self.counting).as_secs_f64();
                let left = spent * (1.0 - part) / part;
                self.bar.set_message(format!("{} blocks done, {} left", self.blocks, period(left)));
                self.bar.set_position((part * STEPS as f64) as u64);
            }
        }
    }

    /// Says something that the bar must not stand in the way of.
    pub fn suspend(&self, say: impl FnOnce()) {
        self.bar.suspend(say);
    }

    /// The run is over.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// The work of a run, counted by running it without times; nothing if that cannot be done.
fn count(file: &str, setting: &SettingArguments) -> Option<f64> {
    let mut session = open(file, setting).ok()?;
    let mut work = Work::default();
    run_through(&mut session, setting.repeat, |_, event| {
        work.add(event);
        Ok(())
    })
    .ok()?;
    Some(work.all)
}

/// Seconds as they are said of a wait.
fn period(seconds: f64) -> String {
    let tenths = (seconds * 10.0).round() as u64;
    match tenths {
        0..600 => format!("{}.{} s", tenths / 10, tenths % 10),
        600..36_000 => format!("{}:{:02} min", tenths / 600, tenths % 600 / 10),
        _ => format!("{}:{:02} h", tenths / 36_000, tenths % 36_000 / 600),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wait_is_said_in_the_unit_that_fits() {
        assert_eq!(
            [period(0.04), period(59.94), period(59.96), period(3599.0)],
            ["0.0 s", "59.9 s", "1:00 min", "59:59 min"]
        );
        assert_eq!(period(3600.0 * 2.5), "2:30 h");
    }
}
