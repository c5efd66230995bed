//! The memory on a disk that fails: what was acknowledged stays, what was not is there as a whole or not at all, and
//! the error is said in plain words.
#![cfg(unix)]

mod faulty;

use faulty::{Wrong, after_cut, has_failed, mend, new_disk, plan, steps};
use memory::{Change, Content, Kind, List, Program, Store};

/// Chance that is the same every time.
struct Chance(u64);

impl Chance {
    fn next(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % below
    }
}

/// What an operator writes in one go: values in many places and a program over many pages, all with one mark.
fn changes(mark: u64, chance: &mut Chance) -> Vec<Change> {
    let text = format!("O{mark}\n").repeat(1 + chance.next(4000) as usize).into_bytes();
    let mut changes = vec![Change::Load(Program { name: format!("O{}", chance.next(4)), text, protected: false })];
    for _ in 0..1 + chance.next(5) {
        let kind = Kind::ALL[chance.next(6) as usize];
        changes.push(Change::Write(kind, chance.next(30).to_string(), Some(mark.to_string())));
    }
    changes.push(Change::Note(List::Runs, mark.to_string()));
    if chance.next(3) == 0 {
        changes.push(Change::Remove(format!("O{}", chance.next(4))));
    }
    changes
}

fn content_of(folder: &std::path::Path) -> Content {
    let store = Store::open(folder, "test").expect("the memory opens after a cut");
    store.content().expect("read")
}

#[test]
fn after_a_cut_everything_acknowledged_is_there_and_nothing_by_half() {
    let (mut late, mut early) = (0, 0);
    for seed in 0..400 {
        let mut chance = Chance(seed);
        new_disk();
        let (folder, found) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
        plan(chance.next(200) as usize, Wrong::Cut);
        let mut states = vec![Content::default()];
        let mut acknowledged = 0;
        if let Ok(mut store) = Store::open(folder.path(), "test") {
            // The same changes in a memory that is not cut off say what should be there.
            for mark in 1..20 {
                let changes = changes(mark, &mut chance);
                let written = store.commit(&changes);
                states.push(applied(states.last().expect("a state"), &changes));
                match written {
                    Ok(()) => acknowledged = mark as usize,
                    Err(trouble) => {
                        assert!(has_failed(), "{trouble}");
                        assert!(trouble.0.contains("the disk failed"), "{trouble}");
                        break;
                    }
                }
            }
        }
        let lost = chance.next(4);
        after_cut(found.path(), || chance.next(4) < lost);
        mend();
        let there = content_of(found.path());
        let allowed = &states[acknowledged..states.len().min(acknowledged + 2)];
        let at = allowed.iter().position(|state| *state == there);
        assert!(at.is_some(), "seed {seed}: {acknowledged} writes were acknowledged, there is {there:?}");
        late += usize::from(acknowledged > 3);
        early += usize::from(acknowledged == 0);
    }
    assert!(late > 50 && early > 5, "the cuts came at {late} late and {early} early moments");
}

/// What the changes make of a content, worked out without SQLite.
fn applied(before: &Content, changes: &[Change]) -> Content {
    let mut content = before.clone();
    for change in changes {
        match change {
            Change::Load(program) => {
                content.programs.retain(|other| other.name != program.name);
                content.programs.push(program.clone());
            }
            Change::Remove(name) => content.programs.retain(|program| program.name != *name),
            Change::Write(kind, name, Some(value)) => {
                content.values.insert((*kind, name.clone()), value.clone());
            }
            Change::Write(kind, name, None) => drop(content.values.remove(&(*kind, name.clone()))),
            Change::Note(list, entry) => content.history.entry(*list).or_default().push(entry.clone()),
        }
    }
    content
}

#[test]
fn a_write_that_fails_changes_nothing_is_said_and_the_next_one_is_taken() {
    let words =
        [(Wrong::Full, "the disk is full"), (Wrong::Short, "the disk failed"), (Wrong::Sync, "the disk failed")];
    for (wrong, said) in words {
        let mut met = 0;
        for after in 0..60 {
            let mut chance = Chance(after as u64);
            new_disk();
            let (folder, found) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
            let mut store = Store::open(folder.path(), "test").expect("opened");
            let first = changes(1, &mut chance);
            store.commit(&first).expect("written");
            let before = store.content().expect("read");
            plan(after, wrong);
            let second = changes(2, &mut chance);
            let Err(trouble) = store.commit(&second) else { break };
            met += 1;
            assert!(trouble.0.contains(said) && trouble.0.contains("memory.sqlite"), "{trouble}");
            assert_eq!(store.content().expect("read"), before, "{wrong:?} after {after} steps");
            mend();
            let third = changes(3, &mut chance);
            store.commit(&third).expect("it is mended");
            let expected = applied(&before, &third);
            assert_eq!(store.content().expect("read"), expected);
            // The power goes behind it: what was refused does not come back.
            after_cut(found.path(), || false);
            assert_eq!(content_of(found.path()), expected, "{wrong:?} after {after} steps");
        }
        assert!(met > 0, "{wrong:?} was never met");
    }
}

#[test]
fn a_disk_without_a_sync_would_be_found_out() {
    // The test of the test: what was written and never synced does not survive the cut.
    new_disk();
    let (folder, found) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let connection = rusqlite::Connection::open(folder.path().join("memory.sqlite")).expect("opened");
    connection
        .execute_batch("PRAGMA synchronous = OFF; CREATE TABLE t (n); INSERT INTO t VALUES (1);")
        .expect("written");
    assert!(steps() > 0);
    after_cut(found.path(), || false);
    let length = std::fs::metadata(found.path().join("memory.sqlite")).map_or(0, |facts| facts.len());
    assert_eq!(length, 0);
}
