//! `case.toml`: what a case shows, how it is run, where its rule stands.

use std::fs;
use std::path::Path;

use data::{DataError, Document, Table};

/// The only version of the file there is.
const FORMAT: i64 = 1;

/// What a case waits for, because the program does not execute it yet.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Waits {
    /// Macro statements and calls.
    Macro,
    /// Tool radius compensation.
    Compensation,
    /// A canned cycle or hole pattern.
    Cycle,
    /// Any other function of the control.
    Function,
    /// Time and motion.
    Motion,
    /// The operator's station and the machine's signals.
    Station,
}

impl Waits {
    const NAMES: &'static [(&'static str, Waits)] = &[
        ("macro", Waits::Macro),
        ("compensation", Waits::Compensation),
        ("cycle", Waits::Cycle),
        ("function", Waits::Function),
        ("motion", Waits::Motion),
        ("station", Waits::Station),
    ];

    /// The word that the file has for it.
    pub fn name(self) -> &'static str {
        Waits::NAMES.iter().find(|(_, waits)| *waits == self).map_or("", |(name, _)| name)
    }
}

/// A case as its `case.toml` describes it.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Case {
    /// What it shows, in one sentence.
    pub why: String,
    /// Rules, codes, alarms, tables, policies that it guards.
    pub covers: Vec<String>,
    /// How sure the rule is: the marks of the control's tables.
    pub certainty: String,
    /// Document and section that the rule follows.
    pub source: String,
    /// Command of the program and options that belong to it.
    pub run: Vec<String>,
    /// The control, where the corpus of a family does not name it; options of the call name it otherwise.
    pub control: Option<String>,
    /// What the command works on; `None` if it works on no file.
    pub file: Option<String>,
    /// Further arguments of the command line.
    pub arguments: Vec<String>,
    /// The exit code.
    pub exit: i32,
    /// What the case waits for.
    pub waits: Option<Waits>,
    /// `a.nc` and `b.nc` must agree in their motion.
    pub same_motion: bool,
    /// They may differ by a least increment, where one rounds words and the other derives points.
    pub within_increment: bool,
    /// Files that the command writes, compared with those of the folder.
    pub writes: Vec<String>,
    /// Files that the command writes over, compared with `NAME.after` of the folder.
    pub rewrites: Vec<String>,
}

impl Case {
    /// Reads a folder's `case.toml`.
    ///
    /// # Errors
    /// The file is missing, or every error in it.
    pub fn read(folder: &Path) -> Result<Case, String> {
        let path = folder.join("case.toml");
        let name = path.to_string_lossy();
        let text = fs::read_to_string(&path).map_err(|error| format!("cannot read {name}: {error}"))?;
        let read = Document::read(&name, &text, case);
        read.map_err(|errors| errors.iter().map(DataError::to_string).collect::<Vec<_>>().join("\n\n"))
    }
}

fn case(table: &mut Table) -> Case {
    table.require("format");
    if let Some(place) = table.place_of("format")
        && table.integer("format") != Some(FORMAT)
    {
        table.error(place, format!("this runner reads format {FORMAT} only"));
    }
    let why = sentence(table, "why");
    table.require("covers");
    let covers = table.strings("covers").unwrap_or_default();
    if covers.is_empty() {
        table.error_here("`covers` names what the case guards: a rule, a code, an alarm, a policy");
    }
    const CERTAINTIES: &[(&str, &str)] =
        &[("S", "S"), ("J", "J"), ("P", "P"), ("L", "L"), ("H", "H"), ("Y", "Y"), ("F", "F"), ("D", "D")];
    table.require("certainty");
    let certainty = table.choice("certainty", CERTAINTIES).unwrap_or_default().to_owned();
    let source = sentence(table, "source");
    let run: Vec<String> =
        table.string("run").unwrap_or_else(|| "trace".to_owned()).split_whitespace().map(str::to_owned).collect();
    let file = table.string("file").or_else(|| usual_file(&run));
    // The second of the two: within an increment.
    let same = table.choice("same", &[("motion", false), ("motion-within-increment", true)]);
    Case {
        why,
        covers,
        certainty,
        source,
        run,
        control: table.string("control"),
        file,
        arguments: table.strings("arguments").unwrap_or_default(),
        exit: table.integer("exit").and_then(|exit| i32::try_from(exit).ok()).unwrap_or(0),
        waits: table.choice("waits", Waits::NAMES),
        same_motion: same.is_some(),
        within_increment: same.unwrap_or(false),
        writes: table.strings("writes").unwrap_or_default(),
        rewrites: table.strings("rewrites").unwrap_or_default(),
    }
}

fn sentence(table: &mut Table, key: &'static str) -> String {
    let place = table.place_of(key);
    let text = table.required_string(key);
    if let Some(place) = place
        && text.trim().is_empty()
    {
        table.error(place, format!("`{key}` is empty"));
    }
    text
}

/// What a command works on unless the case names another file.
fn usual_file(run: &[String]) -> Option<String> {
    match run.first().map(String::as_str) {
        Some("operate") => Some("script.txt".to_owned()),
        Some("controls") => None,
        _ => Some("in.nc".to_owned()),
    }
}
