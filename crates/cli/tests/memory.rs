//! `operate --memory` and `memory`: what survives from one call to the next, and what is said when it cannot.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use std::io::Write;

fn cyclestart(arguments: &[&str], input: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cyclestart"));
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("started");
    child.stdin.take().expect("piped").write_all(input.as_bytes()).expect("taken");
    child.wait_with_output().expect("ended")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// What an operator's script says with this memory.
fn operate(memory: &Path, more: &[&str], script: &str) -> String {
    let mut arguments = vec!["operate", "-", "--memory", memory.to_str().expect("a name")];
    arguments.extend(more);
    let done = cyclestart(&arguments, script);
    assert!(matches!(done.status.code(), Some(0 | 1)), "{}", text(&done.stderr));
    text(&done.stdout)
}

fn refused(arguments: &[&str]) -> String {
    let done = cyclestart(arguments, "");
    assert_eq!(done.status.code(), Some(2), "{}", text(&done.stdout));
    assert!(done.stdout.is_empty());
    text(&done.stderr)
}

fn has(said: &str, parts: &[&str]) {
    for part in parts {
        assert!(said.contains(part), "{part} is not in\n{said}");
    }
}

const PART: &str = "(TWO PROGRAMS)\nO1 (PART)\nG91 G01 X1. F100\nX1.\n#500=#500+1.5\nM30\nO2\nG00 Y1.\nM30\n";

/// A folder with a program and a memory in it.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("part.nc"), PART).expect("written");
    folder
}

fn load(folder: &Path) -> String {
    format!("load {}\n", folder.join("part.nc").display())
}

#[test]
fn what_the_panel_and_the_program_wrote_is_there_at_the_next_power_on() {
    let folder = folder();
    let memory = folder.path().join("memory");
    let script = "select O1\noffset 31 = 10.25\nwork G54 X = 100.5\nwork G52 Y = 7\nparameter 6005.2 = 1\n\
                  variable 501 = 1.1\nswitch optional-stop on\nswitch block-delete=3 on\noverride feed 50\ncycle-start\nrun until idle\nmode jog\n";
    operate(&memory, &[], &(load(folder.path()) + script));
    // The file is gone: the program is the control's own now.
    fs::remove_file(folder.path().join("part.nc")).expect("removed");
    let shows = "show offset 31\nshow work G54\nshow work G52\nshow parameter 6005\nshow variable 501\nshow variable 500\nshow state\nshow feed\n\
                 mode memory\nselect O2\ncycle-start\nrun until idle\n";
    let said = operate(&memory, &[], shows);
    has(
        &said,
        &[
            r#""what":"offset 31","value":10.25"#,
            r#""what":"work G54","value":{"x":100.5,"#,
            r#""what":"work G52","value":{"x":0,"y":7,"#,
            r#""what":"parameter 6005","value":4"#,
            r#""what":"variable 501","value":1.1"#,
            r#""what":"variable 500","value":1.5"#,
            r#""mode":"jog""#,
            r#""program":"O1""#,
            r#""override":50"#,
            // Its line is that of the text as it was loaded.
            r#""event":"rapid","line":8"#,
        ],
    );
    let export = cyclestart(&["memory", "export", memory.to_str().expect("a name")], "");
    has(&text(&export.stdout), &["optional-stop = \"on\"", "\"block-delete=3\" = \"on\"", "(TWO PROGRAMS)"]);
}

#[test]
fn what_the_call_sets_is_written_over_what_was_kept() {
    let folder = folder();
    let memory = folder.path().join("memory");
    operate(&memory, &[], "offset 31 = 10.25\noffset 32 = 1\n");
    let said = operate(&memory, &["--offset", "31=2"], "show offset 31\nshow offset 32\n");
    has(&said, &[r#""what":"offset 31","value":2"#, r#""what":"offset 32","value":1"#]);
    has(&operate(&memory, &[], "show offset 31\n"), &[r#""what":"offset 31","value":2"#]);
}

#[test]
fn after_a_power_failure_the_next_start_says_what_was_interrupted_and_where() {
    let folder = folder();
    let memory = folder.path().join("memory");
    let script = "select O1\ncycle-start\nrun until line 4\nrun for 0.1\nfault power\n";
    operate(&memory, &[], &(load(folder.path()) + script));
    let said = operate(&memory, &[], "show state\ncycle-start\nreset\nshow state\n");
    let first = said.lines().next().unwrap_or_default();
    has(first, &[r#""event":"alarm""#, r#""program":"O1","line":4"#, r#""name":"POWER""#]);
    has(
        &said,
        &[r#""action":"cycle-start","why":"an alarm stands; RESET clears it""#, r#""alarm":null,"program":"O1""#],
    );
    // It is said until somebody has pressed RESET.
    let said = operate(&memory, &[], "show state\n");
    assert!(!said.contains("POWER"), "{said}");
    let history = cyclestart(&["memory", "history", memory.to_str().expect("a name")], "");
    has(&text(&history.stdout), &["O1 begun", "O1 was interrupted at line 4: the power had gone"]);
}

#[test]
fn the_alarm_page_shows_what_earlier_calls_have_raised() {
    let folder = folder();
    let memory = folder.path().join("memory");
    fs::write(folder.path().join("part.nc"), "O1\nG01 X1.\nM30\nO2\nG91 G00 X1.\nG04 P9000\nM30\n").expect("written");
    operate(&memory, &[], &(load(folder.path()) + "select O1\ncycle-start\nrun until alarm\nreset\nshow alarms\n"));
    operate(&memory, &[], "select O2\ncycle-start\nrun for 2\nfault power\n");
    let said = operate(&memory, &[], "emergency-stop\nshow alarms\n");
    let page = said.lines().last().unwrap_or_default();
    let alarms: Vec<_> = page.split("{\"name\":").skip(1).collect();
    let [pressed, power, no_feed] = alarms[..] else { panic!("three alarms: {page}") };
    // This call's own have the time of its own; those of earlier ones the date that the memory has kept.
    assert!(pressed.starts_with("\"EMERGENCY\",\"number\":280,\"text\":\"emergency stop\",\"time\":"), "{pressed}");
    has(power, &["\"POWER\"", "\"program\":\"O2\",\"line\":6,\"time\":0}"]);
    has(no_feed, &["\"NO_F\",\"number\":30,", "\"program\":\"O1\",\"line\":2,\"date\":\"20", " UTC\"}"]);
    // As many as the page shows, whatever the memory keeps.
    let presses = "emergency-stop\nrelease\nreset\n".repeat(120);
    operate(&memory, &[], &presses);
    let said = operate(&memory, &[], "show alarms\n");
    assert_eq!(said.matches("\"name\":").count(), 100, "{said}");
}

#[test]
fn a_program_given_up_by_power_off_in_order_is_no_alarm() {
    let folder = folder();
    let memory = folder.path().join("memory");
    operate(&memory, &[], &(load(folder.path()) + "select O1\ncycle-start\nrun until line 4\nrun for 0.1\n"));
    assert!(!operate(&memory, &[], "show state\n").contains("POWER"));
    let history = cyclestart(&["memory", "history", memory.to_str().expect("a name")], "");
    has(&text(&history.stdout), &["O1 given up at line 4: the power was switched off"]);
}

#[test]
fn an_export_read_into_another_memory_is_the_same_memory() {
    let folder = folder();
    let (memory, other) = (folder.path().join("memory"), folder.path().join("other"));
    let script = "parameter 6001.0 = 1\nswitch dry-run on\noffset 31 = 10.25\noffset 7 = -0.001\nwork G59 Z = -250\nvariable 549 = 0.000001234\nvariable 503 = -123456.75\n";
    operate(&memory, &[], &(load(folder.path()) + script));
    let (memory, other) = (memory.to_str().expect("a name"), other.to_str().expect("a name"));
    for form in ["text", "tape"] {
        let export = text(&cyclestart(&["memory", "export", memory, "--form", form], "").stdout);
        assert_eq!(cyclestart(&["memory", "import", other, "-"], &export).status.code(), Some(0));
        let again = text(&cyclestart(&["memory", "export", other, "--form", form], "").stdout);
        assert_eq!(again, export);
        fs::remove_dir_all(other).expect("removed");
    }
    let tape = cyclestart(&["memory", "export", memory, "--form", "tape"], "");
    let left_out = "how the control punches them is not known; --form text keeps them";
    has(&text(&tape.stderr), &[&format!("parameters (1): {left_out}"), &format!("switches (1): {left_out}")]);
    let tape = text(&tape.stdout);
    let lines: Vec<_> = tape.lines().collect();
    // As it was written down beforehand: data in the order of its numbers, programs without the label.
    let expected = [
        "%",
        "G21",
        "G90",
        "G10 P7 R-0.001",
        "G10 P31 R10.25",
        "G10 Q2 P6 Z-250.",
        "#503=-123456.75",
        "#549=0.000001234",
        "M30",
        "O1 (PART)",
        "G91 G01 X1. F100",
        "X1.",
        "#500=#500+1.5",
        "M30",
        "O2",
        "G00 Y1.",
        "M30",
        "%",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn the_other_family_writes_its_two_columns_and_its_common_origin() {
    let folder = folder();
    let (memory, other) = (folder.path().join("memory"), folder.path().join("other"));
    let own = ["--control", "incon-m84"];
    operate(&memory, &own, "offset H1 = 12.5\noffset D1 = 5\nwork external X = 1\nwork G54 X = 2\n");
    let (memory_name, other_name) = (memory.to_str().expect("a name"), other.to_str().expect("a name"));
    let tape = text(&cyclestart(&["memory", "export", memory_name, "--form", "tape"], "").stdout);
    has(&tape, &["G10 L10 P1 R12.5\nG10 L12 P1 R5.\n", "G10 L2 P0 X1.\n", "G10 L2 P1 X2.\n"]);
    let read = cyclestart(&["memory", "import", other_name, "-", "--control", "incon-m84"], &tape);
    assert_eq!(read.status.code(), Some(0), "{}", text(&read.stderr));
    let said = operate(&other, &own, "show offset H1\nshow offset D1\nshow work external\nshow work G54\n");
    has(&said, &[r#""value":12.5"#, r#""value":5"#, r#""value":{"x":1,"#, r#""value":{"x":2,"#]);
}

#[test]
fn a_memory_that_cannot_be_used_is_refused_in_plain_words() {
    let folder = folder();
    let memory = folder.path().join("memory");
    let name = memory.to_str().expect("a name").to_owned();
    operate(&memory, &[], "offset 1 = 1\n");
    has(&refused(&["operate", "-", "--memory", &name, "--control", "incon-m84"]), &["that of a control yasnac-mx1"]);
    has(&refused(&["memory", "export", "nowhere"]), &["there is no memory in nowhere"]);
    let file = folder.path().join("part.nc");
    has(&refused(&["operate", "-", "--memory", file.to_str().expect("a name")]), &["part.nc"]);
    // What is no export changes nothing.
    let wrong = cyclestart(&["memory", "import", &name, "-"], "[offsets]\n1 = 2\n");
    assert_eq!(wrong.status.code(), Some(2));
    has(&operate(&memory, &[], "show offset 1\n"), &[r#""value":1"#]);
    fs::write(memory.join("memory.sqlite"), [b'x'; 8192]).expect("written");
    has(&refused(&["operate", "-", "--memory", &name]), &["memory.sqlite", "damaged", "import the last export"]);
}

#[test]
fn a_second_process_is_told_who_holds_the_memory() {
    let folder = folder();
    let memory = folder.path().join("memory");
    let name = memory.to_str().expect("a name");
    let mut first = Command::new(env!("CARGO_BIN_EXE_cyclestart"));
    first.args(["operate", "-", "--realtime", "--memory", name]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut first = first.stderr(Stdio::null()).spawn().expect("started");
    let mut hands = first.stdin.take().expect("piped");
    hands.write_all(b"show state\n").expect("typed");
    let mut answer = [0; 1];
    std::io::Read::read_exact(first.stdout.as_mut().expect("piped"), &mut answer).expect("it answers");
    let said = refused(&["operate", "-", "--memory", name]);
    has(&said, &["is in use by cyclestart, process", &first.id().to_string(), "end it first"]);
    drop(hands);
    std::io::Read::read_to_end(first.stdout.as_mut().expect("piped"), &mut Vec::new()).expect("read");
    assert!(first.wait().expect("ended").success());
    operate(&memory, &[], "show state\n");
}

#[test]
fn without_the_option_nothing_is_kept() {
    let folder = folder();
    let done = cyclestart(&["operate", "-"], &(load(folder.path()) + "offset 1 = 5\n"));
    assert_eq!(done.status.code(), Some(0));
    let said = text(&cyclestart(&["operate", "-"], "show offset 1\nshow program\n").stdout);
    has(&said, &[r#""what":"offset 1","value":0"#, r#""memory":[]"#]);
}

#[test]
fn without_a_folder_the_memory_is_in_the_users_data_folder() {
    let home = tempfile::tempdir().expect("a folder");
    let operate = |script: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cyclestart"));
        command.args(["operate", "-", "--memory"]).env("HOME", home.path()).env_remove("XDG_DATA_HOME");
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("started");
        child.stdin.take().expect("piped").write_all(script.as_bytes()).expect("taken");
        text(&child.wait_with_output().expect("ended").stdout)
    };
    operate("offset 31 = 12.5\n");
    has(&operate("show offset 31\n"), &["12.5"]);
    if cfg!(target_os = "linux") {
        assert!(home.path().join(".local/share/cyclestart/memory/yasnac-mx1/memory.sqlite").is_file());
    }
}
