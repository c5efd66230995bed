//! `alarms.toml` and `conditions.toml`: together they must cover every condition, each once.

use base::Condition;
use data::Table;

use super::origin;
use crate::alarm::{AlarmRow, Sentences};
use crate::fix::FIXES;

pub(super) fn alarms(root: &mut Table) -> (Vec<AlarmRow>, Vec<usize>) {
    let mut of_condition = vec![None; Condition::ALL.len()];
    let mut count = 0;
    let rows = root.tables("alarm", |row| {
        let place = row.place_of("conditions").unwrap_or_else(|| row.range());
        for id in row.strings("conditions").unwrap_or_default() {
            match Condition::from_id(&id) {
                None => row.error(place.clone(), format!("there is no condition `{id}`")),
                Some(condition) if of_condition[condition as usize].is_some() => {
                    row.error(place.clone(), format!("the condition `{id}` has its alarm already"));
                }
                Some(condition) => of_condition[condition as usize] = Some(count),
            }
        }
        count += 1;
        AlarmRow {
            name: row.required_string("name"),
            number: row.integer("number").and_then(|n| u32::try_from(n).ok()),
            text: row.required_string("text"),
            origin: origin(row),
        }
    });
    for (condition, alarm) in Condition::ALL.iter().zip(&of_condition) {
        if alarm.is_none() {
            root.error_here(format!("no alarm lists the condition `{}`", condition.id()));
        }
    }
    (rows, of_condition.into_iter().map(|alarm| alarm.unwrap_or(0)).collect())
}

pub(super) fn sentences(root: &mut Table) -> Vec<Sentences> {
    let mut all: Vec<Option<Sentences>> = vec![None; Condition::ALL.len()];
    root.tables("condition", |row| {
        let place = row.place_of("id").unwrap_or_else(|| row.range());
        let id = row.required_string("id");
        let sentences = Sentences {
            what: row.required_string("what"),
            why: row.required_string("why"),
            help: row.required_string("help"),
            fix: row.choice("fix", FIXES),
        };
        match Condition::from_id(&id) {
            Some(condition) => all[condition as usize] = Some(sentences),
            None => row.error(place, format!("there is no condition `{id}`")),
        }
    });
    for (condition, sentences) in Condition::ALL.iter().zip(&all) {
        if sentences.is_none() {
            root.error_here(format!("the condition `{}` has no row", condition.id()));
        }
    }
    all.into_iter().map(Option::unwrap_or_default).collect()
}
