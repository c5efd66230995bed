//! What a call wants of the warnings: `--deny NAME`, `--allow NAME`.

use base::Severity;
use data::nearest;

use crate::rules::Rule;

/// Every warning at once, in `--deny all` and `--allow all`; a name given beside it is stronger.
const ALL: &str = "all";

/// What becomes of each warning.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Choice {
    severities: Vec<Option<Severity>>,
}

impl Choice {
    /// Warnings as `deny` (an error) and `allow` (nothing is said) want them; all others stay warnings.
    ///
    /// # Errors
    /// A name that no warning has, in words, with the nearest one; a name that is both denied and allowed.
    pub fn new(deny: &[String], allow: &[String]) -> Result<Choice, String> {
        let is_all = |names: &[String]| names.iter().any(|name| name == ALL);
        let base = match (is_all(deny), is_all(allow)) {
            (true, true) => return Err("--deny all and --allow all exclude each other".to_owned()),
            (true, false) => Some(Severity::Error),
            (false, true) => None,
            (false, false) => Some(Severity::Warning),
        };
        let mut severities = vec![base; Rule::ALL.len()];
        let mut chosen = vec![false; Rule::ALL.len()];
        for (option, names, severity) in [("deny", deny, Some(Severity::Error)), ("allow", allow, None)] {
            for name in names.iter().filter(|name| *name != ALL) {
                let rule = rule_of(option, name)?;
                let index = rule as usize;
                if chosen[index] && severities[index] != severity {
                    return Err(format!("`{name}` is both denied and allowed"));
                }
                chosen[index] = true;
                severities[index] = severity;
            }
        }
        Ok(Choice { severities })
    }

    /// How bad a warning is, `None` if nothing is to be said.
    pub fn severity(&self, rule: Rule) -> Option<Severity> {
        self.severities.get(rule as usize).copied().flatten()
    }
}

fn rule_of(option: &str, name: &str) -> Result<Rule, String> {
    if let Some(rule) = Rule::from_name(name) {
        return Ok(rule);
    }
    if base::Condition::from_id(name).is_some() {
        return Err(format!("--{option} {name}: this is an alarm of the control, not a warning"));
    }
    let near = nearest(name, Rule::ALL.iter().map(|rule| rule.name()));
    let hint = match near {
        Some(near) => format!("perhaps `{near}` is meant"),
        None => {
            format!("the warnings are: {}", Rule::ALL.iter().map(|rule| rule.name()).collect::<Vec<_>>().join(", "))
        }
    };
    Err(format!("--{option} {name}: there is no such warning, {hint}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(list: &[&str]) -> Vec<String> {
        list.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn a_name_is_stronger_than_all() {
        let choice = Choice::new(&names(&["all"]), &names(&["endless"])).expect("known names");
        assert_eq!(choice.severity(Rule::Endless), None);
        assert_eq!(choice.severity(Rule::MemorySize), Some(Severity::Error));
    }

    #[test]
    fn unknown_names_and_contradictions_are_refused() {
        let error = Choice::new(&names(&["integer-cordinate"]), &[]).expect_err("no such name");
        assert!(error.contains("`integer-coordinate`"), "{error}");
        assert!(Choice::new(&names(&["feed-missing"]), &[]).expect_err("an alarm").contains("alarm"));
        assert!(Choice::new(&names(&["endless"]), &names(&["endless"])).is_err());
    }
}
