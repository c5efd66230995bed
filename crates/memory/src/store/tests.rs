use super::*;

fn a_program(name: &str, text: &[u8]) -> Change {
    Change::Load(Program { name: name.to_owned(), text: text.to_vec(), protected: false })
}

fn offset(number: &str, value: &str) -> Change {
    Change::Write(Kind::Offset, number.to_owned(), Some(value.to_owned()))
}

#[test]
fn what_was_committed_is_there_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = Store::open(folder.path(), "test").expect("opened");
    let changes = [
        a_program("O1", b"O1\r\nM30\r\n\0\x80"),
        a_program("O2", b"M30"),
        offset("31", "10"),
        Change::Note(List::Alarms, "alarm 1".to_owned()),
    ];
    store.commit(&changes).expect("written");
    store.commit(&[a_program("O1", b"G4\n"), Change::Remove("O2".to_owned())]).expect("written");
    let before = store.content().expect("read");
    drop(store);
    let after = Store::open(folder.path(), "test").expect("opened").content().expect("read");
    assert_eq!(before, after);
    assert_eq!(after.programs, [Program { name: "O1".to_owned(), text: b"G4\n".to_vec(), protected: false }]);
    assert_eq!(after.values.get(&(Kind::Offset, "31".to_owned())).map(String::as_str), Some("10"));
    assert_eq!(after.history.get(&List::Alarms).map(Vec::len), Some(1));
}

#[test]
fn every_commit_waits_for_the_disk() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = Store::open(folder.path(), "test").expect("opened");
    let asked = |name: &str| -> String {
        let sql = format!("SELECT CAST({name} AS TEXT) FROM pragma_{name}");
        store.connection.query_row(&sql, [], |row| row.get(0)).expect("answered")
    };
    assert_eq!((asked("journal_mode").as_str(), asked("synchronous").as_str()), ("wal", "2"));
    assert_eq!(asked("foreign_keys"), "1");
}

#[test]
fn a_second_one_is_refused_and_told_who_holds_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = Store::open(folder.path(), "cyclestart, process 4711").expect("opened");
    let refused = Store::open(folder.path(), "second").expect_err("held");
    assert!(refused.0.contains("process 4711"), "{refused}");
    drop(store);
    Store::open(folder.path(), "second").expect("free again");
}

#[test]
fn a_file_of_version_1_becomes_this_version_with_what_it_holds() {
    let folder = tempfile::tempdir().expect("a folder");
    let old = Connection::open(folder.path().join("memory.sqlite")).expect("made");
    old.execute_batch(
        "CREATE TABLE program (name TEXT PRIMARY KEY, place INTEGER NOT NULL, text BLOB NOT NULL) STRICT;
         CREATE TABLE kept (kind TEXT NOT NULL, name TEXT NOT NULL, value TEXT NOT NULL, PRIMARY KEY (kind, name)) STRICT;
         INSERT INTO program VALUES ('O7', 1, x'4d3330');
         INSERT INTO kept VALUES ('offsets', '31', '-2.5');
         PRAGMA user_version = 1;",
    )
    .expect("written");
    drop(old);
    let mut store = Store::open(folder.path(), "test").expect("migrated");
    let content = store.content().expect("read");
    assert_eq!(content.programs, [Program { name: "O7".to_owned(), text: b"M30".to_vec(), protected: false }]);
    assert_eq!(content.values.get(&(Kind::Offset, "31".to_owned())).map(String::as_str), Some("-2.5"));
    store.commit(&[Change::Note(List::Runs, "run".to_owned())]).expect("what version 1 had not");
    let version: i64 = store.connection.query_row("PRAGMA user_version", [], |row| row.get(0)).expect("read");
    assert_eq!(version, VERSION as i64);
}

#[test]
fn a_newer_file_is_refused_and_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("memory.sqlite");
    Connection::open(&path).and_then(|new| new.execute_batch("PRAGMA user_version = 99;")).expect("made");
    let before = fs::read(&path).expect("read");
    let refused = Store::open(folder.path(), "test").expect_err("newer");
    assert!(refused.0.contains("version 99") && refused.0.contains("memory.sqlite"), "{refused}");
    assert_eq!(fs::read(&path).expect("read"), before);
}

#[test]
fn a_damaged_file_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("memory.sqlite"), [b'x'; 5000]).expect("written");
    let refused = Store::open(folder.path(), "test").expect_err("damaged");
    assert!(refused.0.contains("damaged"), "{refused}");
}

#[test]
fn a_full_disk_changes_nothing_and_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = Store::open(folder.path(), "test").expect("opened");
    store.commit(&[offset("1", "1")]).expect("written");
    let before = store.content().expect("read");
    let pages: i64 = store.connection.query_row("PRAGMA page_count", [], |row| row.get(0)).expect("read");
    store.connection.query_row(&format!("PRAGMA max_page_count = {pages}"), [], |_| Ok(())).expect("set");
    let refused = store.commit(&[offset("1", "2"), a_program("O1", &[b'X'; 100_000])]).expect_err("full");
    assert!(refused.0.contains("disk is full") && refused.0.contains("memory.sqlite"), "{refused}");
    assert_eq!(store.content().expect("read"), before);
    store.connection.query_row("PRAGMA max_page_count = 100000", [], |_| Ok(())).expect("set");
    store.commit(&[offset("1", "2")]).expect("there is room again");
}

#[test]
fn histories_are_bounded() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = Store::open(folder.path(), "test").expect("opened");
    let notes = |list| (0..MOST_ENTRIES + 5).map(move |n| Change::Note(list, n.to_string()));
    store.commit(&notes(List::Alarms).chain(notes(List::Runs)).collect::<Vec<_>>()).expect("written");
    for list in List::ALL {
        let entries = store.content().expect("read").history.remove(&list).expect("entries");
        assert_eq!((entries.len(), entries.first().map(String::as_str)), (MOST_ENTRIES, Some("5")));
    }
}

#[test]
fn export_and_import_and_export_is_the_same_text() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = Store::open(folder.path(), "test").expect("opened");
    let changes = [
        a_program("O2", b"%\r\nO2\tG0 X1\n\0'''\"\"\"\\\r"),
        a_program("O1", &[0x80, 0x0a, 0xff]),
        a_program("TEIL ä", "(ä)".as_bytes()),
        offset("31", "10.5"),
        Change::Write(Kind::Switch, "dry-run".to_owned(), Some("on".to_owned())),
        Change::Note(List::Runs, "O1 \"M30\"".to_owned()),
    ];
    store.commit(&changes).expect("written");
    let text = store.content().expect("read").export().expect("text");
    let other = tempfile::tempdir().expect("a folder");
    let mut second = Store::open(other.path(), "test").expect("opened");
    second.commit(&[offset("99", "1"), a_program("O9", b"M2")]).expect("what an import forgets");
    second.replace(&Content::import(&text).expect("understood")).expect("written");
    assert_eq!(second.content().expect("read"), store.content().expect("read"));
    assert_eq!(second.content().expect("read").export().expect("text"), text);
    assert!(Content::import("[offsets]\n1 = 2").is_err() && Content::import("[strange]").is_err());
}
