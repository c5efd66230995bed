//! Programs for the interpolator of the old controls, carried out as the stage does.

#![allow(dead_code)] // every test takes what it needs

use motion::{Interpolator, Move, Spent};

use crate::course::point;

/// What a block of the program does.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    /// A cut.
    Cut(Move),
    /// A rapid from here to there, with in-position check or without.
    Rapid([f64; 3], [f64; 3], bool),
    /// So many seconds of dwell.
    Dwell(f64),
    /// So many blocks that do nothing.
    Empty(u32),
    /// What follows is read only from here on.
    EmptyBuffer,
}

/// A whole move at a time.
pub fn by_moves(interpolator: &mut Interpolator) {
    interpolator.drive_move(|_| {});
}

/// Carries out a program; `drive` drives to the end of the next move. What the moves' and dwells' time was made of.
pub fn run(interpolator: &mut Interpolator, steps: &[Step], mut drive: impl FnMut(&mut Interpolator)) -> Vec<Spent> {
    let mut spent = Vec::new();
    for step in steps {
        while !interpolator.wants_more() || matches!(step, Step::Dwell(_) | Step::EmptyBuffer) {
            if interpolator.is_empty() {
                break;
            }
            if interpolator.wants_more() {
                interpolator.stop();
            }
            drive(interpolator);
            spent.push(interpolator.last_spent());
        }
        match step {
            Step::EmptyBuffer => interpolator.empty_buffer(),
            Step::Empty(count) => (0..*count).for_each(|_| interpolator.begin_block()),
            _ => interpolator.begin_block(),
        }
        match step {
            Step::Cut(cut) => interpolator.add(cut),
            Step::Rapid(from, to, checked) => interpolator.add_rapid(&point(*from), &point(*to), *checked),
            Step::Dwell(seconds) => {
                interpolator.pass(*seconds);
                spent.push(interpolator.last_spent());
            }
            Step::Empty(_) | Step::EmptyBuffer => {}
        }
    }
    interpolator.stop();
    while !interpolator.is_empty() {
        drive(interpolator);
        spent.push(interpolator.last_spent());
    }
    spent
}
