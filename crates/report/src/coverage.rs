//! Which rows of a control's tables are guarded by a case, which wait for later work, which have none.

use std::fmt::Write as _;

use dialect::{Control, Division};

/// What is known of a case here.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CoveringCase {
    /// Its folder's name.
    pub name: String,
    /// What it says it covers.
    pub covers: Vec<String>,
    /// What it waits for.
    pub waits: Option<String>,
}

/// A row that is to be guarded.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CoveredRow {
    /// The table it stands in.
    pub table: String,
    /// Its name, as cases write it in `covers`.
    pub name: String,
    /// What it says, in short.
    pub text: String,
}

/// The rows of the control's own tables: codes, options, policies with each value, alarms.
pub fn rows_of(control: &Control) -> Vec<CoveredRow> {
    let mut rows = Vec::new();
    let mut row = |table: &str, name: String, text: &str| {
        rows.push(CoveredRow { table: table.to_owned(), name, text: text.to_owned() });
    };
    let mut codes: Vec<_> = control.g_codes.iter().collect();
    codes.sort_by_key(|code| code.code);
    for code in codes {
        let absent = if code.division == Division::Sibling { "not on this control: " } else { "" };
        row("G codes", format!("G{:02}", code.code), &format!("{absent}{}", code.text));
    }
    for code in &control.m_codes {
        row("M codes", format!("M{:02}", code.code), &code.text);
    }
    for option in control.options.iter().filter(|option| control.asks_for(&option.name)) {
        row("options", format!("option {}", option.name), &option.text);
    }
    for policy in &control.policies {
        for value in &policy.values {
            row("policies", format!("policy {}={value}", policy.name), &policy.text);
        }
    }
    for alarm in &control.alarms {
        row("alarms", alarm.name.clone(), &alarm.text);
    }
    rows
}

/// The listing, and whether every row has a case.
pub fn coverage(title: &str, rows: &[CoveredRow], cases: &[CoveringCase]) -> (String, bool) {
    let mut out = String::new();
    let mut bare = Vec::new();
    let (mut guarded, mut waiting) = (0usize, 0usize);
    let _ = writeln!(out, "{title}: which rows of its tables are guarded by a case");
    let mut table = "";
    for row in rows {
        if row.table != table {
            table = &row.table;
            let _ = writeln!(out, "\n{table}");
        }
        let covering: Vec<_> = cases.iter().filter(|case| case.covers.contains(&row.name)).collect();
        let running: Vec<_> = covering.iter().filter(|case| case.waits.is_none()).collect();
        let what = match (running.first(), covering.first()) {
            (Some(first), _) => {
                guarded += 1;
                let more = running.len() - 1;
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                format!("{}{more}", first.name)
            }
            (None, Some(first)) => {
                waiting += 1;
                let what = first.waits.as_deref().unwrap_or_default();
                format!("waits for {what}: {}", first.name)
            }
            (None, None) => {
                bare.push(row);
                "no case".to_owned()
            }
        };
        let _ = writeln!(out, "  {:<40} {what}", row.name);
    }
    let _ = writeln!(
        out,
        "\n{} rows: {guarded} with a case, {waiting} waiting, {} without; {} cases",
        rows.len(),
        bare.len(),
        cases.len()
    );
    for row in &bare {
        let _ = writeln!(out, "without: {} ({}): {}", row.name, row.table, row.text);
    }
    (out, bare.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_guarded_waits_or_is_bare() {
        let row = |name: &str| CoveredRow { table: "t".into(), name: name.into(), text: "what it is".into() };
        let case = |name: &str, covers: &str, waits: Option<&str>| CoveringCase {
            name: name.into(),
            covers: vec![covers.into()],
            waits: waits.map(str::to_owned),
        };
        let cases = [case("a", "A", None), case("b", "B", Some("station")), case("c", "A", None)];
        let (text, whole) = coverage("toy", &[row("A"), row("B"), row("C")], &cases);
        assert!(!whole && text.contains("a and 1 more") && text.contains("waits for station: b"), "{text}");
        assert!(text.contains("3 rows: 1 with a case, 1 waiting, 1 without; 3 cases"), "{text}");
        assert!(coverage("toy", &[row("A"), row("B")], &cases).1);
    }
}
