//! What is legal and dangerous: the warnings of `check`.
//!
//! Comes in: the events of a run and the interpreter that made them, afterwards the texts. Goes out: [`Finding`]s, and
//! [`base::Diagnostic`]s of them. Must never know: files, how findings are printed. It looks on and changes nothing of
//! what runs; memory does not grow with the program.

mod blocks;
mod choice;
mod finding;
mod hygiene;
mod look;
mod rule;
mod rules;
mod show;
mod trial;
mod watch;
mod way;

pub use choice::Choice;
pub use finding::Finding;
pub use hygiene::look_at_text;
pub use rules::Rule;
pub use trial::{Outcomes, PowerOn, power_on_trials, second_piece};
pub use watch::Watch;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_has_its_sentences_and_every_row_its_rule() {
        let files = dialect::builtin_files("yasnac-mx1").expect("it is built in");
        let control = dialect::load_control(&files).expect("it loads");
        for rule in Rule::ALL {
            assert!(control.warnings.iter().any(|row| row.name == rule.name()), "{} has no row", rule.name());
        }
        for row in &control.warnings {
            assert!(Rule::from_name(&row.name).is_some(), "{} has no rule", row.name);
        }
    }

    #[test]
    fn what_a_control_lists_is_a_warning_of_single_controls_or_helps_in_its_own_way() {
        for name in dialect::builtin_controls() {
            let files = dialect::builtin_files(&name).expect("it is built in");
            let control = dialect::load_control(&files).expect("it loads");
            for own in &control.own_warnings {
                let is_shade = |shade: &str| own.shade.is_empty() || own.shade == shade;
                let row = control.warnings.iter().find(|row| row.name == own.name && is_shade(&row.shade));
                assert!(row.is_some_and(|row| row.own || own.help.is_some()), "{name}: {}", own.name);
            }
        }
    }
}
