//! Positions as displays and reports show them: where a machine position lies for the program.

use base::{AXES, Point};

use super::Interpreter;
use crate::state::State;

impl Interpreter {
    /// Where the axes are in the coordinates of the work system in force: mm and degrees for a machine position.
    pub fn work_position(&self, machine: &Point) -> Point {
        self.work_position_in(self.executing_state(), machine)
    }

    /// The same in the work system of a state.
    pub fn work_position_in(&self, state: &State, machine: &Point) -> Point {
        let setting = &self.reader.setting;
        let mut work = [0.0; AXES];
        let place = setting.upright(state, &machine.map(|mm| (mm * 1e6).round()));
        for axis in 0..setting.facts.axes.len().min(AXES) {
            work[axis] = (place[axis] - setting.zero(state, axis)) / 1e6;
        }
        work
    }

    /// The words that lead to a place of the machine in a state (counts).
    pub fn programmed(&self, state: &State, machine: &Point) -> Point {
        let setting = &self.reader.setting;
        setting.programmed(state, &setting.upright(state, machine))
    }

    /// The coordinates programmed last, the axes standing there (counts).
    pub fn last_programmed(&self, state: &State, machine: &Point) -> Point {
        let setting = &self.reader.setting;
        setting.last_programmed(state, &setting.upright(state, machine))
    }

    /// Where program zero lies in a state, offsets included: mm and degrees, machine coordinates.
    pub fn program_zero(&self, state: &State) -> Point {
        let setting = &self.reader.setting;
        let mut zero = [0.0; AXES];
        for axis in 0..setting.facts.axes.len().min(AXES) {
            zero[axis] = setting.zero(state, axis) / 1e6;
        }
        zero
    }

    /// What the UNIVERSAL display shows for a machine position.
    pub fn universal_position(&self, machine: &Point) -> Point {
        let state = self.executing_state();
        let mut shown = [0.0; AXES];
        for axis in 0..self.reader.setting.facts.axes.len().min(AXES) {
            shown[axis] = ((machine[axis] * 1e6).round() - state.universal_zero[axis]) / 1e6;
        }
        shown
    }
}
