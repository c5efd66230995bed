//! `operate --memory`: what the station holds, written to the memory before anything is said that rests on it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use base::{Diagnostic, Place, SourceId, Span};
use dialect::Control;
use etcetera::BaseStrategy;
use machine::MachineFile;
use memory::{Change, Content, Kind, List, Program, Store};
use station::{
    CellKind, Configuration, Interrupted, Operator, Panel, Percents, Said, Session, Setup, TYPED, split_switch,
};
use syntax::Cursor;

use super::history::{History, past_alarm};
use crate::command::memory::holder;
use crate::failure::Failure;
use crate::texts::Texts;

/// State: the control whose memory it is.
const CONTROL: &str = "control";
/// State: the program that runs, and the block at which it is.
const RUNNING: &str = "running";
const MODE: &str = "mode";
const SELECTED: &str = "selected";
const OVERRIDES: [&str; 3] = ["override feed", "override rapid", "override spindle"];
/// State, with a text's name behind it: the programs in it and where each begins.
const PROGRAMS: &str = "programs of ";

/// The memory, and what of the station is in it.
pub struct Keeping {
    store: Option<Store>,
    content: Content,
    setup: Setup,
    cells: Vec<u64>,
    programs: Vec<Listed>,
    /// Under which name each text is kept.
    texts: BTreeMap<SourceId, String>,
    panel: Panel,
    switches: Vec<String>,
    running: Option<(String, Place)>,
    history: History,
}

/// A program in memory: its name, the text it stands in, where it begins there.
type Listed = (String, SourceId, Cursor);

/// The kinds of cells by those of the memory.
const CELLS: [(Kind, CellKind); 4] = [
    (Kind::Offset, CellKind::Offset),
    (Kind::Work, CellKind::Work),
    (Kind::Parameter, CellKind::Parameter),
    (Kind::Variable, CellKind::Variable),
];

/// Where a control's memory is kept if no folder is named: in the user's data folder, as the platform has it.
pub fn default_folder(control: &str) -> Result<PathBuf, Failure> {
    match etcetera::choose_base_strategy() {
        Ok(places) => Ok(places.data_dir().join("cyclestart").join("memory").join(control)),
        Err(error) => Err(Failure::call(format!("no folder for the memory: {error}; name one: --memory DIR"))),
    }
}

impl Keeping {
    /// Opens the memory in a folder for this control.
    pub fn open(folder: &Path, control: &Control) -> Result<Keeping, Failure> {
        let store = Store::open(folder, &holder()).map_err(Failure::call)?;
        let content = store.content().map_err(Failure::call)?;
        let (owner, name) = (content.values.get(&(Kind::State, CONTROL.to_owned())), &control.name);
        if let Some(owner) = owner.filter(|owner| *owner != name) {
            let folder = folder.display();
            return Err(Failure::call(format!(
                "the memory in {folder} is that of a control {owner}, not of {name}; name another folder, or --control {owner}"
            )));
        }
        let setup = kept_setup(&content)?;
        let history = History::default();
        let (cells, programs, texts, switches) = Default::default();
        let (panel, running) = (Panel::default(), None);
        Ok(Keeping { store: Some(store), content, setup, cells, programs, texts, panel, switches, running, history })
    }

    /// What is kept, as the set-up that comes before any other.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Hands the store over, to whoever writes from now on.
    pub fn take_store(&mut self) -> Option<Store> {
        self.store.take()
    }

    /// The station takes up what is kept. `kept` is the control with nothing but that set.
    pub fn take_up(
        &mut self,
        kept: &Configuration,
        operator: &mut Operator<Texts>,
        tell: &mut dyn FnMut(&mut Session<Texts>, Said),
    ) -> Result<(), Failure> {
        kept.see_kept(&mut |_, value| self.cells.push(value.to_bits()));
        self.switches = kept.switches.on();
        let content = std::mem::take(&mut self.content);
        for entry in content.history.get(&List::Alarms).into_iter().flatten() {
            operator.session.remember_alarm(past_alarm(entry));
        }
        let state = |name: &str| content.values.get(&(Kind::State, name.to_owned()));
        for program in &content.programs {
            let name = &program.name;
            let source = operator.session.library_mut().hold(name, program.text.clone())?;
            let heads = state(&format!("{PROGRAMS}{name}")).map_or_else(Vec::new, |text| Keeping::heads_of(text));
            operator.put_back(name, source, heads).map_err(Failure::call)?;
            self.texts.insert(source, name.clone());
        }
        self.programs = programs_of(operator);
        let percent =
            |index: usize, now: u16| state(OVERRIDES[index]).and_then(|text| text.parse::<u16>().ok()).unwrap_or(now);
        let now = operator.session.percents();
        let percents =
            Percents { feed: percent(0, now.feed), rapid: percent(1, now.rapid), spindle: percent(2, now.spindle) };
        let mode = state(MODE).cloned().unwrap_or_else(|| operator.mode().name.clone());
        let panel = Panel { mode, percents, selected: state(SELECTED).cloned(), ..operator.panel() };
        operator.turn_panel(&panel);
        self.panel = operator.panel();
        if state(CONTROL).is_none() {
            let name = operator.session.configuration().control.name.clone();
            self.history.changes.push(Change::Write(Kind::State, CONTROL.to_owned(), Some(name)));
        }
        if let Some(interrupted) = state(RUNNING).and_then(|text| interrupted_of(text)) {
            self.history.broken_off(&interrupted);
            self.running = Some((interrupted.program.clone(), interrupted.place));
            operator.come_back_from(&interrupted, tell).map_err(Failure::call)?;
        }
        Ok(())
    }

    /// Something has been said: what of it belongs in a history.
    pub fn note(&mut self, said: &Said, session: &Session<Texts>, diagnostic: Option<&Diagnostic>) {
        self.history.note(said, session, diagnostic);
    }

    /// True if a program has begun or ended of which the memory does not know yet.
    pub fn is_late(&self, session: &Session<Texts>) -> bool {
        session.at_work().is_some() != self.running.is_some()
    }

    /// The power is switched off in order: a program that runs is not interrupted but given up.
    pub fn switch_off(&mut self, operator: &mut Operator<Texts>) {
        if operator.session.is_powered() {
            if let Some((name, place)) = operator.at_work() {
                self.history.switched_off(name, place.line);
            }
            operator.session.power_off();
        }
    }

    /// What has changed at the whole station since the last time.
    pub fn changes(&mut self, operator: &mut Operator<Texts>) -> Result<Vec<Change>, Failure> {
        let mut changes = self.session_changes(&mut operator.session);
        self.panel_changes(operator, &mut changes);
        self.program_changes(operator, &mut changes)?;
        Ok(changes)
    }

    /// What has changed in the session since the last time: cells, histories, the block that is executed.
    pub fn session_changes(&mut self, session: &mut Session<Texts>) -> Vec<Change> {
        let mut changes = std::mem::take(&mut self.history.changes);
        let (mut at, mut changed) = (0, Vec::new());
        let cells = &mut self.cells;
        session.see_kept(&mut |cell, value| {
            if let Some(last) = cells.get_mut(at).filter(|last| **last != value.to_bits()) {
                *last = value.to_bits();
                changed.push((cell, value));
            }
            at += 1;
        });
        let configuration = session.configuration();
        let (control, machine): (&Control, &MachineFile) = (&configuration.control, &configuration.machine);
        for (cell, value) in changed {
            let (kind, name) = cell.name(control, machine);
            let kind = CELLS.iter().find(|(_, own)| *own == kind).map_or(Kind::State, |(kind, _)| *kind);
            changes.push(Change::Write(kind, name, cell.text(control, value)));
        }
        let place = session.at_work();
        if place != self.running.as_ref().map(|(_, place)| *place) {
            let running = place.map(|place| (session.interpreter().program_name(place.program).to_owned(), place));
            let text = running.as_ref().map(|(name, place)| running_text(name, place));
            changes.push(Change::Write(Kind::State, RUNNING.to_owned(), text));
            self.running = running;
        }
        changes
    }

    fn panel_changes(&mut self, operator: &Operator<Texts>, changes: &mut Vec<Change>) {
        if operator.stands_at(&self.panel) {
            return;
        }
        let panel = operator.panel();
        let mut write = |name: &str, text: Option<String>| {
            changes.push(Change::Write(Kind::State, name.to_owned(), text));
        };
        write(MODE, Some(panel.mode.clone()));
        write(SELECTED, panel.selected.clone());
        let percents = [panel.percents.feed, panel.percents.rapid, panel.percents.spindle];
        OVERRIDES.iter().zip(percents).for_each(|(name, percent)| write(name, Some(percent.to_string())));
        let switches = panel.switches.on();
        let off = self.switches.iter().filter(|name| !switches.contains(name));
        let on = switches.iter().filter(|name| !self.switches.contains(name));
        changes.extend(off.map(|name| Change::Write(Kind::Switch, name.clone(), None)));
        changes.extend(on.map(|name| Change::Write(Kind::Switch, name.clone(), Some("on".to_owned()))));
        (self.panel, self.switches) = (panel, switches);
    }

    fn program_changes(&mut self, operator: &mut Operator<Texts>, changes: &mut Vec<Change>) -> Result<(), Failure> {
        if self.lists(operator) {
            return Ok(());
        }
        let texts = names_of_texts(operator);
        for name in self.texts.iter().filter(|(source, name)| texts.get(source) != Some(name)).map(|(_, name)| name) {
            changes.push(Change::Remove(name.clone()));
            changes.push(Change::Write(Kind::State, format!("{PROGRAMS}{name}"), None));
        }
        let programs = programs_of(operator);
        for (&source, name) in &texts {
            if self.texts.get(&source) != Some(name) {
                let text = operator.session.library_mut().bytes_of(source).map_err(Failure::call)?;
                let protected = is_protected(operator, name);
                changes.push(Change::Load(Program { name: name.clone(), text, protected }));
            }
            let heads = heads_text(&programs, source);
            changes.push(Change::Write(Kind::State, format!("{PROGRAMS}{name}"), Some(heads)));
        }
        (self.programs, self.texts) = (programs, texts);
        Ok(())
    }

    /// The programs of a text, as they are listed.
    pub fn heads_of(text: &str) -> Vec<(String, Cursor)> {
        let head = |line: &str| {
            let mut words = line.splitn(4, ' ');
            let mut number = || words.next()?.parse::<u64>().ok();
            let (offset, line, line_start) = (number()?, number()?, number()?);
            Some((words.next()?.to_owned(), Cursor { offset, line, line_start, skipping: false }))
        };
        text.lines().filter_map(head).collect()
    }

    /// True if the memory lists the programs that the station has.
    fn lists(&self, operator: &Operator<Texts>) -> bool {
        let mut now = operator.kept_programs();
        let same = |(name, source, head): &Listed| {
            now.next().is_some_and(|own| (own.0, own.2, own.3) == (name.as_str(), *source, *head))
        };
        self.programs.iter().all(same) && now.next().is_none()
    }

    /// Writes changes; nothing that rests on them may be said before this returns.
    pub fn commit(&mut self, changes: &[Change]) -> Result<(), Failure> {
        match &mut self.store {
            Some(store) => store.commit(changes).map_err(Failure::call),
            None => Ok(()),
        }
    }
}

fn kept_setup(content: &Content) -> Result<Setup, Failure> {
    let mut setup = Setup::default();
    for ((kind, name), value) in &content.values {
        match (kind, CELLS.iter().find(|(own, _)| own == kind)) {
            (_, Some((_, kind))) => setup.keep(*kind, name, value),
            (Kind::Switch, None) => setup.switches.push(split_switch(name).map_err(Failure::call)?),
            _ => {}
        }
    }
    Ok(setup)
}

fn programs_of(operator: &Operator<Texts>) -> Vec<Listed> {
    operator.kept_programs().map(|(key, _, source, head)| (key.to_owned(), source, head)).collect()
}

/// Every text with programs in memory, by the name of the first of them; a file by its name with its ending.
fn names_of_texts(operator: &Operator<Texts>) -> BTreeMap<SourceId, String> {
    let mut first: BTreeMap<SourceId, (u64, String)> = BTreeMap::new();
    for (key, shown, source, head) in operator.kept_programs() {
        let name = operator.session.library().ending_of(source).map(|ending| format!("{shown}.{ending}"));
        let own = (head.offset, name.unwrap_or_else(|| key.to_owned()));
        match first.get(&source) {
            Some(other) if *other <= own => {}
            _ => drop(first.insert(source, own)),
        }
    }
    first.into_iter().map(|(source, (_, name))| (source, name)).collect()
}

fn is_protected(operator: &Operator<Texts>, name: &str) -> bool {
    let interpreter = operator.session.interpreter();
    let number = station::number_of(name);
    number.is_some_and(|number| interpreter.fitting().protects(interpreter.control(), number))
}

/// The programs of a text, one a line: offset, line, offset of that line, name.
fn heads_text(programs: &[Listed], source: SourceId) -> String {
    let own = programs.iter().filter(|(_, of, _)| *of == source);
    let lines = own.map(|(name, _, head)| format!("{} {} {} {name}", head.offset, head.line, head.line_start));
    lines.collect::<Vec<_>>().join("\n")
}

/// The block that is executed: line and sequence number, offset of the line, of the block and its length, whether it
/// was typed, the program's name.
fn running_text(name: &str, place: &Place) -> String {
    let Place { line, sequence, line_start, block, source, .. } = place;
    let from = if *source == TYPED { "typed" } else { "memory" };
    format!("line {line} N{sequence} {line_start} {} {} {from} {name}", block.start, block.len)
}

fn interrupted_of(text: &str) -> Option<Interrupted> {
    let mut words = text.strip_prefix("line ")?.splitn(7, ' ');
    let line = words.next()?.parse().ok()?;
    let sequence = words.next()?.strip_prefix('N')?.parse().ok()?;
    let line_start = words.next()?.parse().ok()?;
    let block = Span { start: words.next()?.parse().ok()?, len: words.next()?.parse().ok()? };
    let source = if words.next()? == "typed" { TYPED } else { SourceId::default() };
    let place = Place { line, sequence, line_start, block, source, ..Place::default() };
    Some(Interrupted { program: words.next()?.to_owned(), place })
}
