//! `operate --memory` where the disk has no more room: the error is said, what was acknowledged is kept, and what could not
//! be kept was not acknowledged. A limit on the size of files stands for the disk; the shell sets it.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const PROGRAM: &str = env!("CARGO_BIN_EXE_cyclestart");
/// Sizes that a file may have, in 512 bytes: from less than an empty memory to more than is written.
const SIZES: [u32; 16] = [0, 8, 16, 32, 48, 64, 72, 80, 96, 112, 128, 192, 256, 512, 1024, 100_000];
/// Variables that are written, each many times, and one that is written before.
const VARIABLES: std::ops::Range<u32> = 510..540;
const BEFORE: u32 = 545;

fn perform(mut command: Command, input: &str) -> Output {
    let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = pipes.spawn().expect("started");
    // A process that ends early does not read to the end.
    let _ = child.stdin.take().expect("piped").write_all(input.as_bytes());
    child.wait_with_output().expect("ended")
}

fn cyclestart(arguments: &[&str], input: &str) -> Output {
    let mut command = Command::new(PROGRAM);
    command.args(arguments);
    perform(command, input)
}

/// The same where no file may become larger; a write beyond that fails.
fn on_a_full_disk(size: u32, arguments: &[&str], input: &str) -> Output {
    let mut command = Command::new("sh");
    // Signal 25 says that a file is too large: ignored, so that the write itself says it.
    let limited = "trap '' 25; ulimit -f \"$1\"; shift; exec \"$@\"";
    command.args(["-c", limited, "sh", &size.to_string(), PROGRAM]).args(arguments);
    perform(command, input)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The values of variables that the output shows, the last of each.
fn shown(out: &str) -> BTreeMap<u32, f64> {
    let value = |line: &str| {
        let (number, rest) = line.split_once(r#""what":"variable "#)?.1.split_once('"')?;
        let value = rest.strip_prefix(r#","value":"#)?.split(',').next()?;
        Some((number.parse().ok()?, value.parse().ok()?))
    };
    // A line that was not written as a whole says nothing.
    out.rsplit_once('\n').map_or("", |(whole, _)| whole).lines().filter_map(value).collect()
}

fn kept(memory: &str) -> BTreeMap<u32, f64> {
    let lines: String = VARIABLES.chain([BEFORE]).map(|number| format!("show variable {number}\n")).collect();
    let done = cyclestart(&["operate", "-", "--memory", memory], &lines);
    assert!(done.status.success(), "the memory opens again: {}", text(&done.stderr));
    shown(&text(&done.stdout))
}

/// Writes, and looks at what was written; programs come in too. Values only grow.
fn script(folder: &Path) -> String {
    let part = format!("O1\n{}M30\n", "G91 G01 X0.01 F500\n".repeat(1500));
    fs::write(folder.join("part.nc"), part).expect("written");
    let mut lines = String::new();
    for round in 1..=20 {
        for number in VARIABLES {
            lines += &format!(
                "variable {number} = {round}\nshow variable {number}\nshow program\nshow position\nshow machine\n"
            );
        }
        if round % 5 == 0 {
            lines += &format!("load {} as O{round}\n", folder.join("part.nc").display());
        }
    }
    lines
}

/// How a run on a disk of this size ended, and how much of it had been said.
#[derive(PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Ended {
    RefusedAtOnce,
    InTheMiddle,
    Well,
}

fn run(size: u32, by_the_clock: bool) -> Ended {
    let folder = tempfile::tempdir().expect("a folder");
    let memory = folder.path().join("memory");
    let memory = memory.to_str().expect("a name");
    let first = cyclestart(&["operate", "-", "--memory", memory], &format!("variable {BEFORE} = 7.5\n"));
    assert!(first.status.success(), "{}", text(&first.stderr));
    let mut arguments = vec!["operate", "-", "--memory", memory];
    if by_the_clock {
        arguments.push("--realtime");
    }
    let done = on_a_full_disk(size, &arguments, &script(folder.path()));
    let (out, errors) = (text(&done.stdout), text(&done.stderr));
    let said = shown(&out);
    let kept = kept(memory);
    assert_eq!(kept.get(&BEFORE), Some(&7.5), "size {size}: what was acknowledged before stays");
    for (number, value) in &said {
        let there = kept.get(number);
        assert!(
            there.is_some_and(|there| there >= value),
            "size {size}: #{number} was said to be {value}, there is {there:?}"
        );
    }
    let written = cyclestart(&["operate", "-", "--memory", memory], "variable 546 = 1\nshow variable 546\n");
    assert!(written.status.success(), "with room again it is written: {}", text(&written.stderr));
    if done.status.success() {
        assert_eq!(said.len(), VARIABLES.len());
        assert!(said.values().all(|value| *value == 20.0), "size {size}: all was said, {said:?}");
        return Ended::Well;
    }
    assert_eq!(done.status.code(), Some(2), "size {size}: {errors}");
    let names = errors.contains("memory") && (errors.contains("disk") || errors.contains("check"));
    assert!(names, "size {size}: it is said what failed and what to do: {errors}");
    assert!(!errors.contains("panicked"), "size {size}: {errors}");
    if said.is_empty() { Ended::RefusedAtOnce } else { Ended::InTheMiddle }
}

#[test]
fn a_script_on_a_full_disk_acknowledges_nothing_that_is_not_kept() {
    let ends: Vec<Ended> = SIZES.iter().map(|size| run(*size, false)).collect();
    for end in [Ended::RefusedAtOnce, Ended::InTheMiddle, Ended::Well] {
        assert!(ends.contains(&end), "{end:?} is met: {ends:?}");
    }
}

#[test]
fn by_the_clock_nor_does_a_panel() {
    let ends: Vec<Ended> = SIZES.iter().map(|size| run(*size, true)).collect();
    for end in [Ended::RefusedAtOnce, Ended::InTheMiddle, Ended::Well] {
        assert!(ends.contains(&end), "{end:?} is met: {ends:?}");
    }
}

#[test]
fn an_import_on_a_full_disk_leaves_the_memory_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let memory = folder.path().join("memory");
    let memory = memory.to_str().expect("a name");
    assert!(cyclestart(&["operate", "-", "--memory", memory], "variable 545 = 7.5\n").status.success());
    let export = text(&cyclestart(&["memory", "export", memory], "").stdout);
    let long = "X".repeat(400_000);
    let large = format!("{export}\n[[programs]]\nname = \"O9\"\nprotected = false\ntext = \"{long}\"\n");
    let large = large.replace("programs = []\n", "");
    let done = on_a_full_disk(256, &["memory", "import", memory, "-"], &large);
    assert_eq!(done.status.code(), Some(2), "{}", text(&done.stderr));
    assert!(text(&done.stderr).contains("disk"), "{}", text(&done.stderr));
    assert_eq!(text(&cyclestart(&["memory", "export", memory], "").stdout), export);
    let done = cyclestart(&["memory", "import", memory, "-"], &large);
    assert!(done.status.success(), "with room it is one: {}", text(&done.stderr));
}
