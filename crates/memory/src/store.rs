//! The file: opened by one process at a time, written in transactions.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use rusqlite::{Connection, Error, params};

use crate::content::{Change, Content, Kind, List, Program};
use crate::schema::{MIGRATIONS, VERSION};
use crate::trouble::Trouble;

/// The file in the folder.
pub const FILE: &str = "memory.sqlite";

/// So many entries a history keeps; the oldest go first.
pub const MOST_ENTRIES: usize = 1000;

/// The memory, held by this process as long as the value lives.
#[derive(Debug)]
pub struct Store {
    connection: Connection,
    path: PathBuf,
    /// Locked; the operating system lets go of it whatever way the process ends.
    _lock: File,
}

impl Store {
    /// Opens the memory in a folder, which is made if it does not exist. `holder` is what another process is told of
    /// this one.
    ///
    /// # Errors
    /// It cannot be opened, another process holds it, it is damaged, or a newer program wrote it.
    pub fn open(folder: &Path, holder: &str) -> Result<Store, Trouble> {
        fs::create_dir_all(folder).map_err(|error| Trouble::file(folder, "make the folder", &error))?;
        let lock = hold(folder, holder)?;
        let path = folder.join(FILE);
        let named = |error: Error| Trouble::sqlite(&path, &error);
        let mut connection = Connection::open(&path).map_err(named)?;
        let version: i64 = connection.query_row("PRAGMA user_version", [], |row| row.get(0)).map_err(named)?;
        if version > VERSION as i64 {
            return Err(Trouble(format!(
                "{}: a newer cyclestart wrote this memory (version {version}, this one knows {VERSION}); use that one",
                path.display()
            )));
        }
        let sound: String = connection.query_row("PRAGMA integrity_check", [], |row| row.get(0)).map_err(named)?;
        if sound != "ok" {
            return Err(Trouble(format!(
                "{}: the memory is damaged ({sound}); put it aside and import the last export into a new folder",
                path.display()
            )));
        }
        connection.query_row("PRAGMA journal_mode = WAL", [], |_| Ok(())).map_err(named)?;
        connection.execute_batch("PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;").map_err(named)?;
        migrate(&mut connection, version).map_err(named)?;
        Ok(Store { connection, path, _lock: lock })
    }

    /// Writes changes, all or none. They are on the disk when this returns.
    ///
    /// # Errors
    /// They could not be written; the memory is as it was.
    pub fn commit(&mut self, changes: &[Change]) -> Result<(), Trouble> {
        if changes.is_empty() {
            return Ok(());
        }
        write(&mut self.connection, changes).map_err(|error| Trouble::sqlite(&self.path, &error))
    }

    /// Forgets everything and takes this instead, as one change.
    ///
    /// # Errors
    /// It could not be written; the memory is as it was.
    pub fn replace(&mut self, content: &Content) -> Result<(), Trouble> {
        let mut changes = Vec::new();
        changes.extend(content.programs.iter().cloned().map(Change::Load));
        let values = content.values.iter();
        changes.extend(values.map(|((kind, name), value)| Change::Write(*kind, name.clone(), Some(value.clone()))));
        for (list, entries) in &content.history {
            changes.extend(entries.iter().map(|entry| Change::Note(*list, entry.clone())));
        }
        let mut replace = || -> Result<(), Error> {
            let transaction = self.connection.transaction()?;
            transaction.execute_batch("DELETE FROM program; DELETE FROM kept; DELETE FROM history;")?;
            apply(&transaction, &changes)?;
            transaction.commit()
        };
        replace().map_err(|error| Trouble::sqlite(&self.path, &error))
    }

    /// All that is there.
    ///
    /// # Errors
    /// It could not be read.
    pub fn content(&self) -> Result<Content, Trouble> {
        content(&self.connection).map_err(|error| Trouble::sqlite(&self.path, &error))
    }
}

/// Takes the folder's lock, or says who has it.
fn hold(folder: &Path, holder: &str) -> Result<File, Trouble> {
    let (path, note) = (folder.join("lock"), folder.join("holder"));
    let lock = File::options().create(true).truncate(false).write(true).open(&path);
    let lock = lock.map_err(|error| Trouble::file(&path, "open", &error))?;
    match lock.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let by = fs::read_to_string(&note).unwrap_or_else(|_| "another process".to_owned());
            let folder = folder.display();
            return Err(Trouble(format!("the memory in {folder} is in use by {}; end it first", by.trim())));
        }
        Err(TryLockError::Error(error)) => return Err(Trouble::file(&path, "lock", &error)),
    }
    fs::write(&note, holder).map_err(|error| Trouble::file(&note, "write", &error))?;
    Ok(lock)
}

/// Brings an older file to this version, all steps or none.
fn migrate(connection: &mut Connection, version: i64) -> Result<(), Error> {
    let done = usize::try_from(version).unwrap_or(0);
    if done == VERSION {
        return Ok(());
    }
    let transaction = connection.transaction()?;
    for step in MIGRATIONS.iter().skip(done) {
        transaction.execute_batch(step)?;
    }
    transaction.pragma_update(None, "user_version", VERSION as i64)?;
    transaction.commit()
}

fn write(connection: &mut Connection, changes: &[Change]) -> Result<(), Error> {
    let transaction = connection.transaction()?;
    apply(&transaction, changes)?;
    transaction.commit()
}

fn apply(connection: &Connection, changes: &[Change]) -> Result<(), Error> {
    let run = |sql: &str, values: &[&dyn rusqlite::ToSql]| connection.prepare_cached(sql)?.execute(values);
    for change in changes {
        match change {
            Change::Load(Program { name, text, protected }) => {
                let sql = "INSERT OR REPLACE INTO program (name, place, text, protected)
                           VALUES (?1, (SELECT coalesce(max(place), 0) + 1 FROM program), ?2, ?3)";
                run(sql, params![name, text, protected])?;
            }
            Change::Remove(name) => drop(run("DELETE FROM program WHERE name = ?1", params![name])?),
            Change::Write(kind, name, Some(value)) => {
                let sql = "INSERT OR REPLACE INTO kept (kind, name, value) VALUES (?1, ?2, ?3)";
                run(sql, params![kind.name(), name, value])?;
            }
            Change::Write(kind, name, None) => {
                run("DELETE FROM kept WHERE kind = ?1 AND name = ?2", params![kind.name(), name])?;
            }
            Change::Note(list, entry) => {
                run("INSERT INTO history (list, entry) VALUES (?1, ?2)", params![list.name(), entry])?;
                let sql = "DELETE FROM history WHERE list = ?1 AND number <=
                           (SELECT number FROM history WHERE list = ?1 ORDER BY number DESC LIMIT 1 OFFSET ?2)";
                run(sql, params![list.name(), MOST_ENTRIES as i64])?;
            }
        }
    }
    Ok(())
}

fn content(connection: &Connection) -> Result<Content, Error> {
    let mut content = Content::default();
    let mut programs = connection.prepare("SELECT name, text, protected FROM program ORDER BY place")?;
    let rows =
        programs.query_map([], |row| Ok(Program { name: row.get(0)?, text: row.get(1)?, protected: row.get(2)? }))?;
    content.programs = rows.collect::<Result<_, _>>()?;
    let mut values = connection.prepare("SELECT name, value FROM kept WHERE kind = ?1")?;
    for kind in Kind::ALL {
        let rows = values.query_map([kind.name()], |row| Ok(((kind, row.get(0)?), row.get(1)?)))?;
        for row in rows {
            let (key, value) = row?;
            content.values.insert(key, value);
        }
    }
    let mut entries = connection.prepare("SELECT entry FROM history WHERE list = ?1 ORDER BY number")?;
    for list in List::ALL {
        let rows = entries.query_map([list.name()], |row| row.get(0))?.collect::<Result<Vec<String>, _>>()?;
        if !rows.is_empty() {
            content.history.insert(list, rows);
        }
    }
    Ok(content)
}

#[cfg(test)]
mod tests;
