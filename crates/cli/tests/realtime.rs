//! `operate --realtime`: what comes out is what comes out without the clock, and hands on standard input act when they act.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

const PART: &str = "%\nO0001\nG91 G28 X0 Y0 Z0\nG90 G54 G01 X-20. F6000.\nG04 X0.1\nM08\nX0 Y-20.\nM30\n%\n";
const LONG: &str = "%\nO0001\nG91 G28 X0 Y0 Z0\nG90 G54 G01 X-400. F100.\nM30\n%\n";

fn folder(part: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.nc"), part).unwrap();
    folder
}

fn operate(folder: &tempfile::TempDir, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cyclestart"));
    command.current_dir(folder.path()).arg("operate").args(arguments).args(["--control", "yasnac-mx1"]);
    command
}

#[test]
fn the_clock_changes_nothing_but_when() {
    let folder = folder(PART);
    let script = "load part.nc\nselect O1\ncycle-start\nrun for 0.10033\nfeed-hold\nrun for 0.1\ncycle-start\nrun until end\n\
                  mode jog\njog X - for 0.1\njog X -\nrun for 0.05\nreset\nmode step\nstep X + 0.01\nshow position\n";
    std::fs::write(folder.path().join("script.txt"), script).unwrap();
    let by_itself = operate(&folder, &["script.txt", "--io"]).output().unwrap();
    let by_the_clock = operate(&folder, &["script.txt", "--io", "--realtime"]).output().unwrap();
    let text = String::from_utf8(by_itself.stdout).unwrap();
    assert!(text.lines().count() > 20, "{text}");
    assert_eq!(text, String::from_utf8(by_the_clock.stdout).unwrap());
    let told = String::from_utf8(by_the_clock.stderr).unwrap();
    assert!(told.contains("servo periods of 1000 µs by the clock"), "{told}");
}

struct Panel {
    child: Child,
    hands: ChildStdin,
    told: BufReader<ChildStdout>,
}

impl Panel {
    fn new(folder: &tempfile::TempDir, more: &[&str]) -> Panel {
        let mut command = operate(folder, &[&["-", "--realtime"], more].concat());
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let (hands, told) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()));
        Panel { child, hands, told }
    }

    fn does(&mut self, lines: &str) {
        self.hands.write_all(lines.as_bytes()).unwrap();
        self.hands.flush().unwrap();
    }

    /// Reads on to the line in which this stands.
    fn tells(&mut self, what: &str) -> String {
        let mut line = String::new();
        while self.told.read_line(&mut line).unwrap() > 0 {
            if line.contains(what) {
                return line;
            }
            line.clear();
        }
        panic!("{what} was never told");
    }

    fn ends(self) -> i32 {
        let Panel { mut child, hands, told } = self;
        drop(hands);
        for _ in told.lines() {}
        child.wait().unwrap().code().unwrap()
    }
}

#[test]
fn time_passes_between_the_actions_of_hands() {
    let folder = folder(PART);
    let mut panel = Panel::new(&folder, &[]);
    panel.does("load part.nc\nselect O1\ncycle-start\n");
    panel.tells("\"event\":\"end\"");
    panel.does("show position\n");
    assert!(panel.tells("\"what\":\"position\"").contains("\"work\":{\"x\":0,\"y\":-20,\"z\":0}"));
    assert_eq!(panel.ends(), 0);
}

#[test]
fn an_emergency_stop_overtakes_what_waits() {
    let folder = folder(LONG);
    let mut panel = Panel::new(&folder, &[]);
    panel.does("load part.nc\nselect O1\ncycle-start\nrun until end\nshow position\nemergency-stop\n");
    let refused = panel.tells("refused");
    assert!(refused.contains("\"action\":\"show position\"") && refused.contains("EMERGENCY STOP"), "{refused}");
    panel.tells("\"alarm\"");
    panel.does("cycle-start\n");
    assert!(panel.tells("refused").contains("cycle-start"));
    assert_eq!(panel.ends(), 1);
}

#[test]
fn what_is_no_action_changes_nothing() {
    let folder = folder(PART);
    let mut panel = Panel::new(&folder, &[]);
    panel.does("cycle start\n");
    assert!(panel.tells("refused").contains("`cycle start` is no action"));
    panel.does("load nowhere.nc\n");
    assert!(panel.tells("refused").contains("nowhere.nc"));
    panel.hands.write_all(b"show position\xff\n").unwrap();
    assert!(panel.tells("refused").contains("show position"));
    let long = format!("show position {}\nshow state\n", " ".repeat(300_000));
    panel.does(&long);
    panel.tells("refused");
    assert!(panel.tells("\"show\"").contains("\"what\":\"state\""));
    assert_eq!(panel.ends(), 0);
}

#[test]
fn displays_are_told_while_the_axes_move() {
    let folder = folder(LONG);
    let mut panel = Panel::new(&folder, &["--displays", "100"]);
    panel.does("load part.nc\nselect O1\ncycle-start\n");
    let mut places = std::collections::BTreeSet::new();
    while places.len() < 20 {
        places.insert(panel.tells("\"what\":\"position\""));
    }
    panel.does("emergency-stop\n");
    panel.tells("\"alarm\"");
    assert_eq!(panel.ends(), 1);
}
