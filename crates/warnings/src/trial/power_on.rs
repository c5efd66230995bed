//! Every combination of the power-on and reset parameters.

use std::collections::BTreeSet;

use base::AxisSet;
use dialect::{Control, Fitting, GroupCodes, MOST_GROUPS, NO_CODE, Occasion, ParameterKind, ParameterSetting};
use station::{Library, LibraryError, Session};

use super::{Parting, compare};
use crate::finding::{At, Finding};
use crate::rules::Rule;

/// Combinations that are tried; a control with more leaves its last parameters as they are.
const MOST_COMBINATIONS: usize = 4096;

/// One combination that leads to states of its own.
#[derive(Clone, PartialEq, Debug)]
pub struct PowerOn {
    /// The control with these parameters.
    pub fitting: Fitting,
    /// Parameters and bits of parameters that differ from those set, in words.
    parameters: Vec<String>,
    /// Groups that begin in another state: index, code as set, code here.
    changed: Vec<(usize, u8, u8)>,
    /// Groups that a reset brings to another state.
    reset_changed: Vec<usize>,
}

/// Every combination of the parameters that decide groups at power-on, and of those that decide them at reset if the
/// program runs more than once; each set of states that can come of it once, the one as set left out.
pub fn power_on_trials(control: &Control, fitting: &Fitting, pieces: u64) -> Vec<PowerOn> {
    let mut knobs = BTreeSet::new();
    for group in &control.groups {
        let reset = group.program_end.parameter.as_ref().filter(|_| pieces > 1);
        for (parameter, own, _) in group.power_on.parameter.iter().chain(reset) {
            let row = control.parameters.get(*parameter);
            match row.filter(|row| row.kind == ParameterKind::Choice) {
                Some(row) => drop(knobs.insert((*parameter, None, row.values.len()))),
                None => knobs.extend(own.iter().map(|bit| (*parameter, Some(*bit), 2))),
            }
        }
    }
    let mut combinations = 1;
    knobs.retain(|(.., positions)| {
        let fits = combinations * positions <= MOST_COMBINATIONS;
        combinations *= if fits { *positions } else { 1 };
        fits
    });
    let as_set = fitting.power_on(control);
    // From nothing, so that what a reset keeps differs from what it sets.
    let nothing = GroupCodes([NO_CODE; MOST_GROUPS]);
    let reset_as_set = fitting.groups_after(control, Occasion::ProgramEnd, nothing);
    let mut seen = BTreeSet::from([(as_set.0, reset_as_set.0)]);
    let mut trials = Vec::new();
    for mut combination in 0..combinations {
        let mut fitting = fitting.clone();
        let mut parameters = Vec::new();
        for &(parameter, bit, positions) in &knobs {
            let value = combination % positions;
            combination /= positions;
            let stands = fitting.parameter(parameter) as usize;
            let is = bit.map_or(stands, |bit| stands >> bit & 1);
            let Some(row) = control.parameters.get(parameter).filter(|_| value != is) else { continue };
            let (written, said) = match bit {
                Some(bit) => (value.to_string(), format!("#{} D{bit} = {value}", row.name)),
                None => {
                    let word = row.values.get(value).cloned().unwrap_or_default();
                    (word.clone(), format!("{} = {word}", row.name))
                }
            };
            let setting = ParameterSetting { name: row.name.clone(), bit, value: written };
            if fitting.set_parameter(control, &setting).is_ok() {
                parameters.push(said);
            }
        }
        let groups = fitting.power_on(control);
        let reset = fitting.groups_after(control, Occasion::ProgramEnd, nothing);
        if !seen.insert((groups.0, reset.0)) {
            continue;
        }
        let changed = |a: &[u8], b: &[u8]| {
            (0..control.groups.len()).filter(|&g| a[g] != b[g]).map(|g| (g, a[g], b[g])).collect::<Vec<_>>()
        };
        let reset_changed = changed(&reset_as_set.0, &reset.0).into_iter().map(|(group, ..)| group).collect();
        trials.push(PowerOn { fitting, parameters, changed: changed(&as_set.0, &groups.0), reset_changed });
    }
    trials.sort_by_key(|trial| trial.changed.len() + trial.reset_changed.len());
    trials
}

/// What came of the trials.
#[derive(Default)]
pub struct Outcomes {
    partings: Vec<(PowerOn, Finding)>,
    total: usize,
    differ: usize,
}

impl Outcomes {
    /// Runs the program as set and in one of the trials, side by side.
    ///
    /// # Errors
    /// A text cannot be read.
    pub fn run<L: Library>(
        &mut self,
        as_set: &mut Session<L>,
        otherwise: &mut Session<L>,
        trial: PowerOn,
        pieces: u64,
    ) -> Result<(), LibraryError> {
        self.total += 1;
        let all = as_set.interpreter().facts().all();
        let Some(parting) = compare(as_set, otherwise, pieces, AxisSet(all.0))? else { return Ok(()) };
        self.differ += 1;
        // What a smaller change explains is not said again.
        let explained = |(said, _): &(PowerOn, Finding)| {
            said.changed.iter().all(|change| trial.changed.contains(change))
                && said.reset_changed.iter().all(|group| trial.reset_changed.contains(group))
        };
        if self.partings.iter().any(explained) {
            return Ok(());
        }
        let finding = finding(as_set, &parting, &trial);
        self.partings.push((trial, finding));
        Ok(())
    }

    /// The findings, each with the count of combinations that make a difference.
    pub fn findings(self) -> Vec<Finding> {
        let summary = format!("{} of {}", self.differ, self.total);
        self.partings.into_iter().map(|(_, finding)| finding.with("summary", summary.clone())).collect()
    }
}

fn finding<L: Library>(session: &Session<L>, parting: &Parting, trial: &PowerOn) -> Finding {
    let control = &session.configuration().control;
    let letters: Vec<u8> = session.interpreter().facts().axes.iter().map(|axis| axis.letter).collect();
    let (place, order, first, again) = parting.words(&letters, control);
    let mut states: Vec<String> = trial
        .changed
        .iter()
        .map(|&(_, was, is)| format!("{} in place of {}", control.g_name(is), control.g_name(was)))
        .collect();
    if trial.changed.is_empty() {
        let number = |&group: &usize| control.groups.get(group).map_or(0, |group| group.number);
        let groups: Vec<_> = trial.reset_changed.iter().map(|group| format!("group {:02}", number(group))).collect();
        states.push(format!("another reset of {}", groups.join(", ")));
    }
    Finding::at(Rule::InheritedState, "power-on", order, place, At::Block)
        .labelled(format!("{again} under {}", states.join(", ")))
        .with("states", states.join(", "))
        .with("parameters", trial.parameters.join(", "))
        .with("again", again)
        .with("first", first)
}
