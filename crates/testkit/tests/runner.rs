//! The runner itself: what must fail does fail.

#![allow(clippy::disallowed_methods, clippy::disallowed_types)] // folders to be judged are made here
#![allow(clippy::expect_used)] // a folder that cannot be made is no verdict

use std::fs;
use std::path::Path;

use tempfile::TempDir;
use testkit::{Call, Mode, Outcome, alarms_are_covered, covers_are_known, judge, rules_have_folders, trials};

const CASE: &str =
    "format = 1\nwhy = \"it shows something\"\ncovers = [\"R1\"]\ncertainty = \"S\"\nsource = \"a manual\"\n";

/// A folder with these files.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    write(folder.path(), files);
    folder
}

fn write(folder: &Path, files: &[(&str, &str)]) {
    for (name, text) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        fs::write(path, text).expect("a file");
    }
}

/// Judges a case folder against a program that always says the same.
fn judged(files: &[(&str, &str)], out: &str, err: &str, exit: i32) -> Result<(), String> {
    let folder = folder(files);
    let outcome = Outcome { out: out.into(), err: err.into(), exit: Some(exit) };
    judge(folder.path(), Mode::Compare, &|_: &Call| Ok(outcome.clone()))
}

fn refusal(files: &[(&str, &str)], out: &str, err: &str, exit: i32) -> String {
    judged(files, out, err, exit).expect_err("this must fail")
}

#[test]
fn a_right_expectation_passes() {
    assert_eq!(judged(&[("case.toml", CASE), ("out.trace", "a\nb\n")], "a\nb\n", "", 0), Ok(()));
}

#[test]
fn a_wrong_expectation_fails_with_the_lines() {
    let message = refusal(&[("case.toml", CASE), ("out.trace", "a\nb\n")], "a\nc\n", "", 0);
    assert!(message.contains("- b\n+ c\n"), "{message}");
    assert!(message.starts_with("it shows something\n"), "{message}");
}

#[test]
fn a_wrong_exit_code_fails() {
    let message = refusal(&[("case.toml", CASE), ("out.trace", "a\n")], "a\n", "oh\n", 1);
    assert!(message.contains("exit code 1 instead of 0"), "{message}");
}

#[test]
fn a_missing_file_fails() {
    assert!(refusal(&[("out.trace", "a\n")], "a\n", "", 0).contains("case.toml"));
    assert!(refusal(&[("case.toml", CASE)], "a\n", "", 0).contains("out.trace cannot be read"));
    assert!(refusal(&[("case.toml", CASE)], "", "", 0).contains("out.trace cannot be read"));
}

#[test]
fn standard_error_is_compared_where_the_folder_says_so() {
    let case = format!("{CASE}exit = 2\n");
    assert_eq!(judged(&[("case.toml", &case), ("err.txt", "no\n")], "", "no\n", 2), Ok(()));
    assert!(refusal(&[("case.toml", &case), ("err.txt", "no\n")], "", "yes\n", 2).contains("- no\n+ yes\n"));
    assert!(refusal(&[("case.toml", &case), ("err.txt", "no\n")], "out\n", "no\n", 2).contains("+ out\n"));
}

#[test]
fn a_success_with_words_on_standard_error_fails() {
    assert!(refusal(&[("case.toml", CASE), ("out.trace", "a\n")], "a\n", "hm\n", 0).contains("standard error"));
}

#[test]
fn the_keys_of_case_toml_are_checked() {
    let unknown = format!("{CASE}exti = 1\n");
    let message = refusal(&[("case.toml", &unknown), ("out.trace", "a\n")], "a\n", "", 0);
    assert!(message.contains("`exti` is not a known key, perhaps `exit` is meant"), "{message}");
    for missing in ["format", "why", "covers", "certainty", "source"] {
        let case: String =
            CASE.lines().filter(|line| !line.starts_with(missing)).map(|line| format!("{line}\n")).collect();
        let message = refusal(&[("case.toml", &case), ("out.trace", "a\n")], "a\n", "", 0);
        assert!(message.contains(missing), "{missing}: {message}");
    }
    for wrong in ["format = 2", "why = \"\"", "covers = []", "certainty = \"Q\""] {
        let key = wrong.split(' ').next().expect("a key");
        let lines = CASE.lines().map(|line| if line.starts_with(key) { wrong } else { line });
        let case: String = lines.map(|line| format!("{line}\n")).collect();
        refusal(&[("case.toml", &case), ("out.trace", "a\n")], "a\n", "", 0);
    }
    for wrong in ["waits = \"luck\"", "same = \"time\"", "exit = \"one\"", "arguments = \"--json\""] {
        refusal(&[("case.toml", &format!("{CASE}{wrong}\n")), ("out.trace", "a\n")], "a\n", "", 0);
    }
}

#[test]
fn a_waiting_case_fails_as_soon_as_it_works() {
    let case = format!("{CASE}waits = \"macro\"\nexit = 1\n");
    let refused = "{\"event\":\"alarm\",\"text\":\"cyclestart does not execute it yet\"}\n";
    assert_eq!(judged(&[("case.toml", &case)], refused, "", 1), Ok(()));
    assert_eq!(judged(&[("case.toml", &case), ("out.trace", refused)], refused, "", 1), Ok(()));
    assert!(refusal(&[("case.toml", &case)], "{\"event\":\"alarm\",\"name\":\"ARC\"}\n", "", 1).contains("no longer"));
    assert!(refusal(&[("case.toml", &case), ("out.trace", "x\n")], refused, "", 1).contains("- x\n"));
}

/// Judges a pair whose programs are the traces that running them prints.
fn pair(a: &str, b: &str) -> Result<(), String> {
    pair_of("motion", a, b)
}

fn pair_of(same: &str, a: &str, b: &str) -> Result<(), String> {
    let case = format!("{CASE}same = \"{same}\"\n");
    let folder = folder(&[("case.toml", &case), ("a.nc", a), ("b.nc", b)]);
    let program = |call: &Call| {
        let out = fs::read_to_string(call.folder.join(&call.arguments[1]))?;
        Ok(Outcome { out, err: String::new(), exit: Some(0) })
    };
    judge(folder.path(), Mode::Compare, &program)
}

#[test]
fn a_pair_agrees_in_its_motion_alone() {
    let a = "{\"event\":\"start\"}\n{\"event\":\"feed\",\"line\":1,\"to\":{\"x\":1},\"f\":100}\n";
    let b = "{\"event\":\"feed\",\"line\":7,\"n\":3,\"to\":{\"x\":1},\"f\":100}\n{\"event\":\"m\",\"code\":3}\n";
    assert_eq!(pair(a, b), Ok(()));
    for other in [b.replace("\"x\":1", "\"x\":2"), b.replace("feed", "rapid"), b.replace("\"f\":100", "\"f\":99")] {
        assert!(pair(a, &other).is_err(), "{other}");
    }
    assert!(pair("{\"event\":\"start\"}\n", "{\"event\":\"start\"}\n").is_err(), "two empty paths prove nothing");
    assert!(pair(a, "nonsense\n").is_err());
    let case = format!("{CASE}same = \"motion\"\n");
    assert!(refusal(&[("case.toml", &case), ("a.nc", a)], a, "", 0).contains("b.nc is missing"));
}

#[test]
fn a_pair_within_an_increment_may_differ_by_that_much() {
    let line = |x: &str| format!("{{\"event\":\"feed\",\"to\":{{\"x\":{x},\"y\":-2}},\"f\":100}}\n");
    let two = |x: &str| line("1") + &line(x);
    assert!(pair(&two("34.641016"), &two("34.641")).is_err());
    let within = |a: &str, b: &str| pair_of("motion-within-increment", a, b);
    assert_eq!(within(&two("34.641016"), &two("34.641")), Ok(()));
    assert_eq!(within(&two("-0.0005"), &two("0.0005")), Ok(()));
    for (a, b) in
        [(two("34.641"), two("34.6421")), (two("1"), line("1")), (two("1"), two("1").replace("feed", "rapid"))]
    {
        assert!(within(&a, &b).is_err(), "{a}{b}");
    }
}

#[test]
fn the_command_line_is_that_of_the_case() {
    let called = |extra: &str| {
        let folder = folder(&[("case.toml", &format!("{CASE}{extra}")), ("out.trace", ""), ("in.nc", "M30\n")]);
        let program = |call: &Call| {
            let words = format!("{} < {}", call.arguments.join(" "), String::from_utf8_lossy(&call.input));
            Ok(Outcome { out: words, err: String::new(), exit: Some(0) })
        };
        let message = judge(folder.path(), Mode::Compare, &program).expect_err("the words are no expectation");
        message.lines().find_map(|line| line.strip_prefix("+ ")).unwrap_or_default().to_owned()
    };
    assert_eq!(called(""), "trace in.nc <   (no line end)");
    assert_eq!(
        called("run = \"check --format json\"\narguments = [\"--repeat\", \"2\"]\n"),
        "check --format json in.nc --repeat 2 <   (no line end)"
    );
    assert_eq!(called("run = \"operate\"\n"), "operate script.txt <   (no line end)");
    assert_eq!(called("run = \"controls yasnac-mx1\"\n"), "controls yasnac-mx1 <   (no line end)");
    assert_eq!(called("file = \"-\"\n"), "trace - < M30");
}

#[test]
fn files_that_a_command_writes_are_compared_and_leave_the_folder_alone() {
    let case = format!("{CASE}writes = [\"part.svg\"]\n");
    let files = [("case.toml", case.as_str()), ("out.trace", ""), ("part.svg", "right\n"), ("in.nc", "M30\n")];
    let judged = |text: Option<&'static str>| {
        let folder = folder(&files);
        let program = |call: &Call| {
            if let Some(text) = text {
                fs::write(call.folder.join("part.svg"), text)?;
            }
            Ok(Outcome { exit: Some(0), ..Outcome::default() })
        };
        let verdict = judge(folder.path(), Mode::Compare, &program);
        assert_eq!(fs::read_to_string(folder.path().join("part.svg")).expect("a file"), "right\n");
        verdict
    };
    assert_eq!(judged(Some("right\n")), Ok(()));
    assert!(judged(Some("wrong\n")).expect_err("another picture").contains("+ wrong"));
    assert!(judged(None).expect_err("no picture").contains("was not written"));
}

#[test]
fn files_that_a_command_writes_over_are_compared_with_what_they_become() {
    let case = format!("{CASE}rewrites = [\"in.nc\"]\n");
    let files = [("case.toml", case.as_str()), ("out.trace", ""), ("in.nc", "before\n"), ("in.nc.after", "after\n")];
    let judged = |text: Option<&'static str>| {
        let folder = folder(&files);
        let program = |call: &Call| {
            if let Some(text) = text {
                fs::write(call.folder.join("in.nc"), text)?;
            }
            Ok(Outcome { exit: Some(0), ..Outcome::default() })
        };
        let verdict = judge(folder.path(), Mode::Compare, &program);
        assert_eq!(fs::read_to_string(folder.path().join("in.nc")).expect("a file"), "before\n");
        verdict
    };
    assert_eq!(judged(Some("after\n")), Ok(()));
    assert!(judged(None).expect_err("nothing was written").contains("+ before"));
}

#[test]
fn rewriting_makes_the_expectation_and_never_hides_a_wrong_exit() {
    let case = format!("{CASE}exit = 1\n");
    let folder = folder(&[("case.toml", &case), ("err.txt", "old\n")]);
    let said = |exit| move |_: &Call| Ok(Outcome { out: "new\n".into(), err: "words\n".into(), exit: Some(exit) });
    judge(folder.path(), Mode::Rewrite, &said(0)).expect_err("the exit code is the author's");
    assert!(!folder.path().join("out.trace").exists());
    assert_eq!(judge(folder.path(), Mode::Rewrite, &said(1)), Ok(()));
    assert_eq!(judge(folder.path(), Mode::Compare, &said(1)), Ok(()));
    assert_eq!(fs::read_to_string(folder.path().join("err.txt")).expect("a file"), "words\n");
}

const RULES: &str = "format = 1\n[[rule]]\nname = \"R1\"\ntext = \"one\"\n[[rule]]\nname = \"R2\"\ntext = \"two\"\n";

#[test]
fn a_rule_without_a_folder_is_found() {
    let both = CASE.replace("R1", "R2");
    let corpus = folder(&[("rules.toml", RULES), ("r01-a/case.toml", CASE)]);
    assert!(rules_have_folders(corpus.path()).expect_err("R2 is missing").contains("R2 has no folder r02-"));
    write(corpus.path(), &[("r02-b/case.toml", CASE)]);
    assert!(rules_have_folders(corpus.path()).expect_err("it covers R1").contains("does not name R2"));
    write(corpus.path(), &[("r02-b/case.toml", &both)]);
    assert_eq!(rules_have_folders(corpus.path()), Ok(()));
    assert!(rules_have_folders(folder(&[("rules.toml", "format = 1\n")]).path()).is_err(), "no rules, no proof");
    assert!(rules_have_folders(folder(&[]).path()).is_err());
}

#[test]
fn an_alarm_raised_and_not_covered_is_found() {
    let trace = "{\"event\":\"start\"}\n{\"event\":\"alarm\",\"line\":1,\"name\":\"ARC\"}\n";
    let corpus = folder(&[("a/case.toml", CASE), ("a/out.trace", trace)]);
    assert!(alarms_are_covered(corpus.path()).expect_err("ARC").contains("a: `covers` does not name the alarm ARC"));
    write(corpus.path(), &[("a/case.toml", &CASE.replace("\"R1\"", "\"R1\", \"ARC\""))]);
    assert_eq!(alarms_are_covered(corpus.path()), Ok(()));
}

#[test]
fn a_covered_rule_that_does_not_exist_is_found() {
    for (covered, known) in [("R1", true), ("R9", false), ("5.11", false), ("P1", false), ("G81", true), ("ARC", true)]
    {
        let corpus =
            folder(&[("rules.toml", RULES), ("a/case.toml", &CASE.replace("\"R1\"", &format!("\"{covered}\"")))]);
        assert_eq!(covers_are_known(corpus.path()).is_ok(), known, "{covered}");
    }
}

#[test]
fn a_corpus_that_is_not_there_is_no_success() {
    let nothing = folder(&[]);
    assert!(trials(Path::new("program"), nothing.path(), Mode::Compare).is_err());
    assert!(trials(Path::new("program"), &nothing.path().join("nowhere"), Mode::Compare).is_err());
    let one = folder(&[("yasnac-mx1/r01-a/case.toml", CASE)]);
    let names: Vec<String> = trials(Path::new("program"), one.path(), Mode::Compare)
        .expect("tests")
        .iter()
        .map(|t| t.name().to_owned())
        .collect();
    assert_eq!(names[0], "yasnac-mx1/r01-a");
    assert_eq!(names.len(), 5);
}
