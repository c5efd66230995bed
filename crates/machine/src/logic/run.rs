//! The builder's logic at work: steps, outputs, inputs, and what stands between them.

use std::sync::Arc;

use meaning::CodeOut;

use super::iron::{Counted, Slide, Turning};
use super::{LogicFate, LogicStep, LogicTable, Place, SpindleSays, Watched};

/// A sequence that runs.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Run {
    code: CodeOut,
    /// Which of the codes that are out it answers, if it still does.
    answers: Option<usize>,
    step: usize,
    since: f64,
    /// Where what turns is to stand, from 0.
    goal: u32,
}

/// What a sequence waits for.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LogicWait {
    /// Which sequence.
    pub sequence: usize,
    /// Which of its steps, from 0.
    pub step: usize,
    /// The line, and whether it is to turn on; `None` where only time passes.
    pub line: Option<(Watched, bool)>,
}

/// Why the logic cannot go on.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum LogicTrouble {
    /// A step has waited too long.
    TimeOut(LogicWait),
    /// The code names no position of what is to turn.
    NoPosition,
}

/// The builder's logic in virtual time.
#[derive(Clone, PartialEq, Debug)]
pub struct Logic {
    table: Arc<LogicTable>,
    /// Every line, as the logic sees it.
    on: Vec<bool>,
    /// What the iron gives each input.
    given: Vec<bool>,
    /// Inputs that a script holds.
    held: Vec<Option<bool>>,
    /// Inputs that stay as they are.
    stuck: Vec<bool>,
    /// What runs, and what comes next, of each sequence.
    runs: Vec<[Option<Run>; 2]>,
    slides: Vec<Slide>,
    turnings: Vec<Turning>,
    /// Where the logic takes what turns to be.
    counted: Vec<Counted>,
    spindle: [bool; 3],
    /// Codes that are done, a bit each.
    finished: u32,
    trouble: Option<(f64, CodeOut, LogicTrouble)>,
    /// The last look; a step whose time is over by then waits for lines.
    looked: f64,
}

/// Who is told of an edge.
type Tell<'t> = &'t mut dyn FnMut(u8, bool);

impl Logic {
    /// The logic at power-on.
    pub fn new(table: Arc<LogicTable>) -> Logic {
        let count = table.lines.len();
        let on: Vec<bool> = table.lines.iter().map(|line| line.on).collect();
        let is_on = |line: u8| on.get(usize::from(line)).copied().unwrap_or(false);
        let slides = table.actuators.iter().map(|row| Slide::standing(is_on(row.output))).collect();
        let mut logic = Logic {
            given: on.clone(),
            held: vec![None; count],
            stuck: vec![false; count],
            runs: vec![[None; 2]; table.sequences.len()],
            slides,
            turnings: vec![Turning::STANDS; table.rotors.len()],
            counted: vec![Counted::default(); table.rotors.len()],
            spindle: [false; 3],
            finished: 0,
            trouble: None,
            looked: f64::NEG_INFINITY,
            on,
            table,
        };
        logic.follow_iron(0.0, &mut |_, _| {});
        logic
    }

    /// What it works by.
    pub fn table(&self) -> &LogicTable {
        &self.table
    }

    /// Every line and whether it is on.
    pub fn lines(&self) -> impl Iterator<Item = (&str, bool)> {
        self.table.lines.iter().map(|line| line.name.as_str()).zip(self.on.iter().copied())
    }

    /// The code goes to its sequence, and is told by [`Logic::take_finished`] when it is done.
    pub fn begin(&mut self, sequence: usize, code: CodeOut, answers: usize) {
        let run = Run { code, answers: Some(answers), step: usize::MAX, since: 0.0, goal: 0 };
        if let Some(runs) = self.runs.get_mut(sequence) {
            let slot = usize::from(runs[0].is_some());
            runs[slot] = Some(run);
        }
    }

    /// A code that is done, told once.
    pub fn take_finished(&mut self) -> Option<usize> {
        let index = self.finished.trailing_zeros();
        self.finished &= self.finished.wrapping_sub(1);
        (index < 32).then_some(index as usize)
    }

    /// Nobody waits for answers any more; what has not begun is dropped.
    pub fn detach(&mut self) {
        self.finished = 0;
        for [run, next] in &mut self.runs {
            *next = None;
            if let Some(run) = run {
                run.answers = None;
            }
        }
    }

    /// The next time at which something happens by itself.
    pub fn next(&self) -> Option<f64> {
        let table = &self.table;
        let slides = self.slides.iter().zip(&table.actuators).filter_map(|(slide, row)| slide.arrives(row));
        let turnings = self.turnings.iter().zip(&table.rotors).filter_map(|(turning, row)| turning.next(row));
        let runs = self.running().filter_map(|(_, run, step)| (step.seconds > 0.0).then_some(run.since + step.seconds));
        let runs = runs.filter(|at| *at > self.looked);
        slides.chain(turnings.map(|(at, _)| at)).chain(runs).min_by(f64::total_cmp)
    }

    /// When and why it gives up, and on which code.
    pub fn gives_up(&self) -> Option<(f64, CodeOut, LogicTrouble)> {
        let late = self.running().filter(|(_, _, step)| step.timeout > 0.0 && step.waits_for_lines()).map(
            |(sequence, run, step)| {
                let line = self.awaited(run, step);
                let wait = LogicWait { sequence, step: run.step, line };
                (run.since + step.timeout, run.code, LogicTrouble::TimeOut(wait))
            },
        );
        self.trouble.into_iter().chain(late).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Which of the codes that are out a trouble is about.
    pub fn answers(&self, code: CodeOut) -> Option<usize> {
        self.runs.iter().flatten().flatten().find(|run| run.code == code).and_then(|run| run.answers)
    }

    /// What the sequence of a code waits for.
    pub fn waiting(&self, code: CodeOut) -> Option<LogicWait> {
        let (sequence, run, step) = self.running().find(|(_, run, _)| run.code == code && run.answers.is_some())?;
        Some(LogicWait { sequence, step: run.step, line: self.awaited(run, step) })
    }

    fn running(&self) -> impl Iterator<Item = (usize, &Run, &LogicStep)> {
        self.runs.iter().enumerate().filter_map(|(index, runs)| {
            let run = runs[0].as_ref()?;
            Some((index, run, self.table.sequences.get(index)?.steps.get(run.step)?))
        })
    }

    /// The first line that a step still waits for.
    fn awaited(&self, run: &Run, step: &LogicStep) -> Option<(Watched, bool)> {
        if let Some((rotor, _)) = step.turns
            && self.counted.get(rotor) != Some(&Counted { position: run.goal, left: 0 })
        {
            return self.table.rotors.get(rotor).map(|rotor| (Watched::Line(rotor.count), true));
        }
        step.waits.iter().find(|(line, on)| self.is_on(*line) != *on).copied()
    }

    fn is_on(&self, watched: Watched) -> bool {
        match watched {
            Watched::Line(index) => self.on.get(usize::from(index)).copied().unwrap_or(false),
            Watched::Spindle(says) => self.spindle[says as usize],
        }
    }

    /// What has become due by now happens; the spindle's drive says so much.
    pub fn advance(&mut self, now: f64, spindle: [bool; 3], tell: Tell) {
        self.spindle = spindle;
        self.looked = now;
        self.move_iron(now);
        self.follow_iron(now, tell);
        for sequence in 0..self.runs.len() {
            while self.go_on(sequence, now, tell) {}
        }
    }

    /// A sequence goes on by a step, if it can.
    fn go_on(&mut self, sequence: usize, now: f64, tell: Tell) -> bool {
        let Some([Some(mut run), _]) = self.runs.get(sequence).copied() else { return false };
        let table = Arc::clone(&self.table);
        let Some(row) = table.sequences.get(sequence) else { return false };
        if let Some(step) = row.steps.get(run.step) {
            let passed = now >= run.since + step.seconds;
            if !passed || self.awaited(&run, step).is_some() {
                return false;
            }
            if step.answers {
                self.answer(&mut run);
            }
        }
        run.step = run.step.wrapping_add(1);
        run.since = now;
        while row
            .steps
            .get(run.step)
            .is_some_and(|step| !step.only_if.iter().all(|(line, on)| self.is_on(*line) == *on))
        {
            run.step += 1;
        }
        let Some(step) = row.steps.get(run.step) else {
            self.answer(&mut run);
            if let Some(runs) = self.runs.get_mut(sequence) {
                *runs = [runs[1], None];
            }
            return true;
        };
        let places = self.begin_step(step, &mut run, now, tell);
        if let Some(runs) = self.runs.get_mut(sequence) {
            runs[0] = places.then_some(run);
        }
        places
    }

    fn answer(&mut self, run: &mut Run) {
        self.finished |= run.answers.take().map_or(0, |index| 1u32.checked_shl(index as u32).unwrap_or(0));
    }

    /// A step switches its outputs; false if what it turns has no such place.
    fn begin_step(&mut self, step: &LogicStep, run: &mut Run, now: f64, tell: Tell) -> bool {
        if let Some((index, place)) = step.turns {
            let table = Arc::clone(&self.table);
            let (Some(rotor), Some(&counted)) = (table.rotors.get(index), self.counted.get(index)) else {
                return false;
            };
            let code = match place {
                Place::OfCode => run.code.code,
                Place::At(code) => code,
            };
            let Some(goal) = rotor.position_of(code) else {
                self.trouble = Some((now, run.code, LogicTrouble::NoPosition));
                return false;
            };
            run.goal = goal;
            let way = rotor.way(counted, goal);
            if way != 0 {
                let output = rotor.backward.filter(|_| way < 0).unwrap_or(rotor.forward);
                self.switch(output, true, now, tell);
            }
        }
        for &(output, on) in &step.switches {
            self.switch(output, on, now, tell);
        }
        true
    }

    /// An output turns on or off, and what it moves begins to move or stops.
    fn switch(&mut self, output: u8, on: bool, now: f64, tell: Tell) {
        match self.on.get_mut(usize::from(output)) {
            Some(state) if *state != on => *state = on,
            _ => return,
        }
        tell(output, on);
        self.move_iron(now);
        let table = Arc::clone(&self.table);
        let is_on = |line: u8| self.on.get(usize::from(line)).copied().unwrap_or(false);
        for (slide, row) in self.slides.iter_mut().zip(&table.actuators) {
            let way = match (is_on(row.output), row.back.map(is_on)) {
                (true, Some(true)) | (false, Some(false)) => 0,
                (true, _) => 1,
                (false, _) => -1,
            };
            slide.turn(way, row, now);
        }
        for (turning, row) in self.turnings.iter_mut().zip(&table.rotors) {
            let way = i8::from(is_on(row.forward)) - i8::from(row.backward.is_some_and(is_on));
            turning.turn(way, row, now);
        }
        self.follow_iron(now, tell);
    }

    /// What is on its way arrives, if it is due.
    fn move_iron(&mut self, now: f64) {
        let table = Arc::clone(&self.table);
        for (slide, row) in self.slides.iter_mut().zip(&table.actuators) {
            if let Some(at) = slide.arrives(row).filter(|at| *at <= now) {
                slide.arrive(at);
            }
        }
        for (turning, row) in self.turnings.iter_mut().zip(&table.rotors) {
            if let Some((at, on)) = turning.next(row).filter(|(at, _)| *at <= now) {
                turning.pass(on, row, at);
            }
        }
    }

    /// The inputs are what the iron gives them, but for those that are held or stuck.
    fn follow_iron(&mut self, now: f64, tell: Tell) {
        let table = Arc::clone(&self.table);
        for (slide, row) in self.slides.iter().zip(&table.actuators) {
            for (input, on) in row.inputs.into_iter().zip(slide.ends()) {
                if let Some(given) = input.and_then(|input| self.given.get_mut(usize::from(input))) {
                    *given = on;
                }
            }
        }
        for (turning, row) in self.turnings.iter().zip(&table.rotors) {
            if let Some(given) = self.given.get_mut(usize::from(row.count)) {
                *given = turning.cam;
            }
        }
        for index in 0..self.on.len() {
            if table.lines.get(index).is_none_or(|line| line.output) {
                continue;
            }
            let (held, given) = (self.held[index], self.given[index]);
            let seen = held.unwrap_or(if self.stuck[index] { self.on[index] } else { given });
            if std::mem::replace(&mut self.on[index], seen) != seen {
                tell(index as u8, seen);
                self.count(index as u8, seen, now, tell);
            }
        }
    }

    /// An input has turned on or off: what turns is a position farther, and stops where it is to stand.
    fn count(&mut self, input: u8, on: bool, now: f64, tell: Tell) {
        let table = Arc::clone(&self.table);
        let is_on = |logic: &Logic, line: u8| logic.on.get(usize::from(line)).copied().unwrap_or(false);
        for (index, row) in table.rotors.iter().enumerate().filter(|(_, row)| row.count == input) {
            let back = row.backward.is_some_and(|line| is_on(self, line));
            let way = i8::from(is_on(self, row.forward)) - i8::from(back);
            let Some(counted) = self.counted.get_mut(index) else { continue };
            counted.see(on, way, row.positions);
            let position = counted.position;
            let turns = |step: &LogicStep| step.turns.is_some_and(|(rotor, _)| rotor == index);
            let stands = on && self.running().any(|(_, run, step)| turns(step) && run.goal == position);
            if stands {
                self.stop(index, now, tell);
            }
        }
    }

    /// What turns stops.
    fn stop(&mut self, rotor: usize, now: f64, tell: Tell) {
        let table = Arc::clone(&self.table);
        let Some(row) = table.rotors.get(rotor) else { return };
        for output in [Some(row.forward), row.backward].into_iter().flatten() {
            self.switch(output, false, now, tell);
        }
    }

    /// A script holds an input.
    pub fn hold(&mut self, input: u8, on: bool, now: f64, tell: Tell) {
        if let Some(held) = self.held.get_mut(usize::from(input)) {
            *held = Some(on);
        }
        self.follow_iron(now, tell);
    }

    /// An input stays as it is, until RESET.
    pub fn stick(&mut self, input: u8) {
        if let Some(stuck) = self.stuck.get_mut(usize::from(input)) {
            *stuck = true;
        }
    }

    /// RESET: inputs follow the machine again, and what turns is where it is.
    pub fn mend(&mut self, now: f64, tell: Tell) {
        self.stuck.fill(false);
        self.follow_iron(now, tell);
        let rotors = self.turnings.iter().zip(&self.table.rotors);
        let places = rotors.map(|(turning, row)| turning.found(row));
        self.counted.iter_mut().zip(places).for_each(|(counted, place)| *counted = place);
    }

    /// The sequence that has given up is dropped, and what it turns stops.
    pub fn drop_late(&mut self, now: f64, tell: Tell) {
        self.trouble = None;
        for sequence in 0..self.runs.len() {
            let late = self.running().find(|(own, run, step)| {
                let waits = step.timeout > 0.0 && step.waits_for_lines();
                *own == sequence && waits && run.since + step.timeout <= now
            });
            let turns = late.map(|(_, _, step)| step.turns);
            if let (Some(turns), Some(runs)) = (turns, self.runs.get_mut(sequence)) {
                *runs = [None; 2];
                if let Some((rotor, _)) = turns {
                    self.stop(rotor, now, tell);
                }
            }
        }
    }

    /// RESET, emergency stop or power: what becomes of steps and outputs.
    pub fn end(&mut self, fate: LogicFate, now: f64, tell: Tell) {
        self.trouble = None;
        self.detach();
        if fate == LogicFate::Finish {
            return;
        }
        self.runs.fill([None; 2]);
        for rotor in 0..self.turnings.len() {
            self.stop(rotor, now, tell);
        }
        if fate == LogicFate::Keep {
            return;
        }
        let table = Arc::clone(&self.table);
        for (index, line) in table.lines.iter().enumerate().filter(|(_, line)| line.output) {
            self.switch(index as u8, line.on && fate == LogicFate::Initial, now, tell);
        }
    }
}

/// What the spindle's drive says, in the order of [`SpindleSays`].
pub(crate) fn spindle_says(turning: bool, angle: bool, arrived: bool) -> [bool; 3] {
    let mut says = [false; 3];
    let what = match (turning, angle) {
        (true, _) => SpindleSays::Speed,
        (_, true) => SpindleSays::Angle,
        _ => SpindleSays::Stands,
    };
    says[what as usize] = arrived;
    says
}
