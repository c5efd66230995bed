//! The table of docs/operating.md, pair by pair: every state is reached by a script, and every action tried there is taken or
//! refused with the reason that the page gives.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// How each state is reached, by its column.
const STATES: &[(&str, &str)] = &[
    ("power off", "power-off"),
    ("emergency stop", "emergency-stop"),
    ("alarm", "select O2\ncycle-start\nrun until alarm"),
    ("automatic mode, nothing runs", "select O1"),
    ("manual mode, nothing moves", "select O1\nmode jog"),
    ("axis moved by hand", "mode jog\njog X -\nrun for 0.1"),
    ("program runs", "select O1\ncycle-start\nrun for 1"),
    ("program waits for the machine (FIN)", "input FIN off\nselect O4\ncycle-start\nrun for 1"),
    ("held (FEED HOLD)", "select O1\ncycle-start\nrun for 1\nfeed-hold"),
    ("stopped (M00, M01, SINGLE BLOCK)", "select O3\ncycle-start\nrun until stop"),
];

/// An action of each kind, by its first word.
const ACTIONS: &[&str] = &[
    "power-on",
    "power-off",
    "load part.nc",
    "select O1",
    "mode memory",
    "mdi G00X1.",
    "cycle-start",
    "feed-hold",
    "reset",
    "key F1",
    "emergency-stop",
    "release",
    "switch single-block on",
    "override feed 50",
    "input skip on",
    "offset 31 = 1.5",
    "touch 31",
    "origin X",
    "work G54 X = 2",
    "parameter 6005 = 0",
    "variable 500 = 3",
    "fault servo X",
    "show state",
    "run for 0.001",
    "jog X - for 0.01",
    "step X - 0.01",
    "home X",
    "restart line 2",
    "search N2",
    "edit top",
    "tape part.nc",
    "verify",
];

const PART: &str = "%\nO1\nN1 G91 G01 X-100. F600\nN2 G90 X-50.\nM30\nO2\nG90 G00 X9999.\nM30\nO3\nM00\nG04 P100\nM30\nO4\nM08\nM30\n%\n";

type Rows = BTreeMap<String, Vec<String>>;

/// The page: its columns, a row's cells by the action's word, the reasons by their letters.
fn table() -> (Vec<String>, Rows, BTreeMap<String, String>) {
    let page = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/operating.md"));
    let text = std::fs::read_to_string(page).unwrap();
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    let head = text.lines().find(|line| line.starts_with("| action |")).unwrap();
    let mut rows = BTreeMap::new();
    for line in text.lines().skip_while(|line| *line != head).skip(2).take_while(|line| line.starts_with('|')) {
        let row = cells(line);
        for word in row[0].split('`').skip(1).step_by(2) {
            rows.insert(word.to_owned(), row[1..].to_vec());
        }
    }
    let reasons = text.lines().filter_map(|line| line.strip_prefix("* ")?.split_once(": "));
    let reasons = reasons.filter(|(letter, _)| letter.len() == 1);
    (cells(head)[1..].to_vec(), rows, reasons.map(|(letter, why)| (letter.to_owned(), why.to_owned())).collect())
}

/// Why the last action of a script was refused, if it was.
fn refusal(folder: &Path, reach: &str, action: &str) -> Option<String> {
    std::fs::write(folder.join("script.txt"), format!("load part.nc\n{reach}\n{action}\n")).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_cyclestart"));
    let done = command.current_dir(folder).args(["operate", "script.txt"]).output().unwrap();
    assert!(matches!(done.status.code(), Some(0 | 1)), "{reach}\n{action}: {}", String::from_utf8_lossy(&done.stderr));
    let told = String::from_utf8(done.stdout).unwrap();
    let refused: Vec<_> = told.lines().filter(|line| line.starts_with("{\"event\":\"refused\"")).collect();
    let last = refused.last()?;
    assert!(refused.len() == 1 && last.contains(&format!("\"action\":\"{action}\"")), "{reach}\n{action}: {refused:?}");
    Some(last.split("\"why\":\"").nth(1).unwrap().split("\",\"time\"").next().unwrap().to_owned())
}

#[test]
fn every_action_in_every_state_is_answered_as_the_page_says() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.nc"), PART).unwrap();
    let (columns, rows, reasons) = table();
    assert_eq!(columns, STATES.iter().map(|(name, _)| *name).collect::<Vec<_>>(), "every column is reached");
    let tried: Vec<&str> = ACTIONS.iter().map(|action| action.split(' ').next().unwrap()).collect();
    assert_eq!(
        rows.keys().map(String::as_str).collect::<std::collections::BTreeSet<_>>(),
        tried.into_iter().collect(),
        "every row is tried"
    );
    let (mut pairs, mut refused, mut by_value, mut wrong) = (0, 0, 0, Vec::new());
    for action in ACTIONS {
        let row = &rows[action.split(' ').next().unwrap()];
        for ((state, reach), cell) in STATES.iter().zip(row) {
            let why = refusal(folder.path(), reach, action);
            let by_table = why.as_ref().filter(|why| reasons.values().any(|reason| reason == *why));
            let expected = reasons.get(cell);
            assert!(expected.is_some() || cell == "yes", "{cell}");
            if by_table != expected {
                wrong.push(format!("{state}: {action}: the page says {cell}, the control {why:?}"));
            }
            pairs += 1;
            refused += usize::from(by_table.is_some());
            by_value += usize::from(why.is_some() && by_table.is_none());
        }
    }
    println!(
        "{pairs} pairs of action and state: {refused} refused by the table, {by_value} for what they name, the others taken"
    );
    assert!(wrong.is_empty(), "{} of {pairs}:\n{}", wrong.len(), wrong.join("\n"));
}
