//! `check`: every alarm the control would raise, and what is legal and dangerous, of many programs, without motion.

use std::collections::BTreeSet;
use std::io;

use base::Severity;
use dialect::Fitting;
use machine::EventKind;
use report::{Format, Rules, begin, end, render, render_with_labels, separator};
use station::{AfterAlarm, Configuration, Session};
use tempfile::NamedTempFile;
use warnings::{Choice, Finding, Outcomes, Rule, Watch, look_at_text, power_on_trials, second_piece};

use super::fix::{correction, fix_file};
use super::{begin_session, run_through};
use crate::arguments::{CheckArguments, FormatArgument, SettingArguments};
use crate::failure::Failure;
use crate::named_programs::named_programs;
use crate::output::{Output, colour_out};
use crate::setting;
use crate::show_alarm::{show_alarm, show_warning};
use crate::texts::Texts;

/// Findings that are remembered so as not to be said twice.
const MOST_REMEMBERED: usize = 100_000;
/// Findings that are held to be told in order.
const MOST_HELD: usize = 1000;

pub fn check(arguments: &CheckArguments) -> Result<bool, Failure> {
    let mut counts = Counts::default();
    match check_all(arguments, &mut counts) {
        // Whoever reads no further has still been told that there are alarms.
        Err(Failure::PipeClosed) => Ok(counts.are_clean()),
        outcome => outcome,
    }
}

/// How many findings were told.
#[derive(Default)]
struct Counts {
    alarms: u64,
    denied: u64,
    warnings: u64,
    /// Refused blocks that can safely be written otherwise.
    fixable: u64,
}

impl Counts {
    fn are_clean(&self) -> bool {
        self.alarms == 0 && self.denied == 0
    }

    fn total(&self) -> u64 {
        self.alarms + self.denied + self.warnings
    }

    /// The closing line.
    fn line(&self, programs: u64) -> String {
        let gap = if self.total() > 0 { "\n" } else { "" };
        let alarms = if self.alarms == 0 { "no alarms".to_owned() } else { count(self.alarms, "alarm") };
        let mut line = format!("{gap}{}: {alarms}", count(programs, "program"));
        for (number, what) in [(self.denied, "denied warning"), (self.warnings, "warning")] {
            if number > 0 {
                line += &format!(", {}", count(number, what));
            }
        }
        line += "\n";
        if self.fixable > 0 {
            line += &format!(
                "{} can be written otherwise: check --fix does it where the run then proves right\n",
                count(self.fixable, "block")
            );
        }
        line
    }
}

/// Findings on their way to the reader: those of a program in the order in which it runs.
struct Findings<'c> {
    choice: &'c Choice,
    format: Format,
    output: Output,
    counts: &'c mut Counts,
    rules: Rules,
    /// Piece and block at which each came up, and its text.
    held: Vec<((u64, u64), String)>,
}

impl Findings<'_> {
    fn hold(&mut self, order: (u64, u64), text: String) -> Result<(), Failure> {
        self.held.push((order, text));
        if self.held.len() >= MOST_HELD { self.tell() } else { Ok(()) }
    }

    fn hold_warning(
        &mut self,
        piece: u64,
        finding: &Finding,
        watch: &Watch,
        session: &mut Session<Texts>,
    ) -> Result<(), Failure> {
        let Some(severity) = self.choice.severity(finding.rule) else { return Ok(()) };
        let control = session.configuration().control.clone();
        let Some((diagnostic, excerpt, labels)) =
            show_warning(finding, &control, watch.widest(), severity, session.library_mut())
        else {
            return Ok(());
        };
        self.rules.take_in(diagnostic.code, &control);
        match severity {
            Severity::Error => self.counts.denied += 1,
            Severity::Warning => self.counts.warnings += 1,
        }
        self.hold((piece, finding.order), render_with_labels(&diagnostic, &excerpt, &labels, self.format))
    }

    fn tell(&mut self) -> Result<(), Failure> {
        self.held.sort_by_key(|(order, _)| *order);
        let told = self.counts.total() - self.held.len() as u64;
        for (number, (_, text)) in (told..).zip(self.held.drain(..)) {
            if number > 0 {
                self.output.buffer.extend_from_slice(separator(self.format).as_bytes());
            }
            self.output.buffer.extend_from_slice(text.as_bytes());
        }
        self.output.pass()
    }
}

fn check_all(arguments: &CheckArguments, counts: &mut Counts) -> Result<bool, Failure> {
    let format = match arguments.format {
        FormatArgument::Text => Format::Text { colour: colour_out() },
        FormatArgument::Json => Format::Json,
        FormatArgument::Sarif => Format::Sarif,
        FormatArgument::Github => Format::Github,
    };
    let choice = Choice::new(&arguments.deny, &arguments.allow).map_err(Failure::call)?;
    let files = named_programs(&arguments.files)?;
    let mut rewritten = Vec::new();
    if arguments.fix {
        for file in &files {
            rewritten.push(fix_file(file, &arguments.setting)?);
        }
    }
    let mut findings =
        Findings { choice: &choice, format, output: Output::new(), counts, rules: Rules::default(), held: Vec::new() };
    findings.output.buffer.extend_from_slice(begin(format).as_bytes());
    for file in &files {
        check_one(file, arguments, &mut findings)?;
        findings.tell()?;
    }
    let mut output = findings.output;
    output.buffer.extend_from_slice(end(format, &findings.rules).as_bytes());
    if matches!(format, Format::Text { .. }) {
        output.buffer.extend_from_slice(findings.counts.line(files.len() as u64).as_bytes());
        for (file, blocks) in files.iter().zip(rewritten).filter(|(_, blocks)| *blocks > 0) {
            output.buffer.extend_from_slice(format!("{file}: {} rewritten\n", count(blocks, "block")).as_bytes());
        }
    }
    output.flush()?;
    Ok(findings.counts.are_clean())
}

fn check_one(file: &str, arguments: &CheckArguments, findings: &mut Findings) -> Result<(), Failure> {
    let repeat = arguments.setting.repeat;
    let program = Program::new(file, &arguments.setting, arguments.all_power_on || repeat > 1)?;
    let configuration = &program.configuration;
    let (control, machine) = (&configuration.control, &configuration.machine);
    let mut session = program.session(configuration.fitting.clone())?;
    let mut watch = Watch::new(configuration).looking_ahead(arguments.look_ahead);
    let mut said = BTreeSet::new();
    let mut piece = 0;
    session.set_after_alarm(AfterAlarm::GoOn);
    let mut alarmed = false;
    run_through(&mut session, repeat, |session, event| {
        watch.see(event, session.interpreter(), session.beside());
        match &event.kind {
            EventKind::Start(_) => piece += 1,
            EventKind::Alarm(alarm) => {
                alarmed = true;
                // A block that is executed again is not refused anew.
                let key = (alarm.place.source, alarm.span.start, alarm.condition.id());
                if !said.contains(&key) {
                    if said.len() < MOST_REMEMBERED {
                        said.insert(key);
                    }
                    let (mut diagnostic, excerpt) = show_alarm(alarm, control, machine, session.library_mut());
                    diagnostic.fix = correction(alarm, session);
                    findings.counts.fixable += u64::from(diagnostic.fix.as_ref().is_some_and(|fix| fix.safe));
                    findings.rules.take_in(diagnostic.code, control);
                    findings.counts.alarms += 1;
                    let order = (piece, session.interpreter().done()[0].block);
                    findings.hold(order, render(&diagnostic, &excerpt, findings.format))?;
                }
            }
            _ => {}
        }
        if watch.has_found() {
            for finding in watch.take() {
                findings.hold_warning(piece, &finding, &watch, session)?;
            }
        }
        Ok(())
    })?;
    watch.finish();
    for finding in watch.take() {
        findings.hold_warning(piece, &finding, &watch, &mut session)?;
    }
    let characters = session.library().length(base::SourceId(0));
    for finding in look_at_text(&mut session, characters).map_err(Failure::call)? {
        findings.hold_warning(piece, &finding, &watch, &mut session)?;
    }
    // A second piece is made only after a first one.
    if repeat > 1 && !alarmed && findings.choice.severity(Rule::SecondPiece).is_some() {
        compare_pieces(&program, repeat, &watch, findings)?;
    }
    if arguments.all_power_on && findings.choice.severity(Rule::InheritedState).is_some() {
        compare_power_on(&program, repeat, &watch, findings)?;
    }
    Ok(())
}

/// The second and every further piece beside the first, up to one that differs.
fn compare_pieces(program: &Program, pieces: u64, watch: &Watch, findings: &mut Findings) -> Result<(), Failure> {
    let fitting = &program.configuration.fitting;
    let mut used = program.session(fitting.clone())?;
    run_through(&mut used, 1, |_, _| Ok(()))?;
    for piece in 2..=pieces {
        let mut fresh = program.session(fitting.clone())?;
        if let Some(finding) = second_piece(&mut fresh, &mut used, watch, piece).map_err(Failure::call)? {
            return findings.hold_warning(piece, &finding, watch, &mut used);
        }
    }
    Ok(())
}

/// The program under every combination of the parameters that decide its state at power-on and reset.
fn compare_power_on(program: &Program, pieces: u64, watch: &Watch, findings: &mut Findings) -> Result<(), Failure> {
    let configuration = &program.configuration;
    let mut outcomes = Outcomes::default();
    for trial in power_on_trials(&configuration.control, &configuration.fitting, pieces) {
        let mut as_set = program.session(configuration.fitting.clone())?;
        let mut otherwise = program.session(trial.fitting.clone())?;
        outcomes.run(&mut as_set, &mut otherwise, trial, pieces).map_err(Failure::call)?;
    }
    let mut session = program.session(configuration.fitting.clone())?;
    for finding in outcomes.findings() {
        findings.hold_warning(1, &finding, watch, &mut session)?;
    }
    Ok(())
}

/// A program that can be run many times.
struct Program<'a> {
    name: &'a str,
    arguments: &'a SettingArguments,
    configuration: Configuration,
    /// Standard input, if it must be read more than once.
    spooled: Option<NamedTempFile>,
}

impl<'a> Program<'a> {
    fn new(name: &'a str, arguments: &'a SettingArguments, many_times: bool) -> Result<Program<'a>, Failure> {
        let configuration = setting::configuration(arguments)?;
        let spooled = if name == "-" && many_times {
            let cannot = |error: io::Error| Failure::call(format!("no room to spool <stdin>: {error}"));
            let mut file = NamedTempFile::new().map_err(cannot)?;
            io::copy(&mut io::stdin(), &mut file).map_err(cannot)?;
            Some(file)
        } else {
            None
        };
        Ok(Program { name, arguments, configuration, spooled })
    }

    /// A session with the program selected, in which nothing has run.
    fn session(&self, fitting: Fitting) -> Result<Session<Texts>, Failure> {
        let mut texts = setting::texts(self.name, self.arguments)?;
        texts.show_tapes(self.configuration.fitting.tape_codes(&self.configuration.control));
        let source = match &self.spooled {
            Some(file) => texts.open_as(&file.path().to_string_lossy(), "<stdin>")?,
            None => texts.open(self.name)?,
        };
        Ok(begin_session(
            Configuration { fitting, ..self.configuration.clone() },
            texts,
            source,
            self.name,
            self.arguments,
        ))
    }
}

fn count(number: u64, what: &str) -> String {
    if number == 1 { format!("1 {what}") } else { format!("{number} {what}s") }
}
