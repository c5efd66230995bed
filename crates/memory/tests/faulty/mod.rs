//! A disk that fails on purpose: SQLite's own file layer, with short writes, no room, a failing fsync, and a cut at which
//! everything that was not synced is lost in part or whole. One disk for each thread.
#![allow(unsafe_code)] // SQLite's file layer is a table of C functions.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ffi::{CStr, c_int, c_void};
use std::path::Path;
use std::sync::Once;

use rusqlite::ffi::{
    SQLITE_FULL, SQLITE_IOERR_FSYNC, SQLITE_IOERR_WRITE, SQLITE_OK, sqlite3_file, sqlite3_filename, sqlite3_io_methods,
    sqlite3_vfs, sqlite3_vfs_find, sqlite3_vfs_register,
};

/// What goes wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wrong {
    /// The disk is full from then on.
    Full,
    /// Half of what is to be written is written, once.
    Short,
    /// What is written cannot be synced, once.
    Sync,
    /// The power goes: nothing is written any more.
    Cut,
}

enum Step {
    Write(usize, Vec<u8>),
    Truncate(usize),
}

/// A file as it is on the disk for certain, and what has been done to it since.
#[derive(Default)]
struct Logged {
    synced: Vec<u8>,
    since: Vec<Step>,
}

#[derive(Default)]
struct Disk {
    files: BTreeMap<String, Logged>,
    open: BTreeMap<usize, (String, usize)>,
    /// How many more writes or syncs go well, and what goes wrong then.
    plan: Option<(usize, Wrong)>,
    /// It goes wrong.
    failing: bool,
    steps: usize,
}

thread_local! {
    static DISK: RefCell<Disk> = RefCell::default();
}

/// A new disk for this thread.
pub fn new_disk() {
    static REGISTERED: Once = Once::new();
    REGISTERED.call_once(register);
    DISK.with_borrow_mut(|disk| *disk = Disk::default());
}

/// After so many more steps that could, this goes wrong.
pub fn plan(after: usize, wrong: Wrong) {
    DISK.with_borrow_mut(|disk| (disk.plan, disk.failing) = (Some((after, wrong)), false));
}

/// All is well again.
pub fn mend() {
    DISK.with_borrow_mut(|disk| (disk.plan, disk.failing) = (None, false));
}

/// True if what was planned has happened.
pub fn has_failed() -> bool {
    DISK.with_borrow(|disk| disk.failing)
}

/// Writes and syncs so far.
pub fn steps() -> usize {
    DISK.with_borrow(|disk| disk.steps)
}

/// What is found in another folder after the cut. `chance` says of each sector that was not synced whether it is there.
pub fn after_cut(folder: &Path, mut chance: impl FnMut() -> bool) {
    DISK.with_borrow(|disk| {
        for (name, file) in &disk.files {
            let mut bytes = file.synced.clone();
            for step in &file.since {
                match step {
                    Step::Truncate(length) if chance() => bytes.resize(*length, 0),
                    Step::Truncate(_) => {}
                    Step::Write(at, new) => {
                        for (index, sector) in new.chunks(512).enumerate() {
                            if chance() {
                                put(&mut bytes, at + index * 512, sector);
                            }
                        }
                    }
                }
            }
            let name = Path::new(name).file_name().expect("a file");
            std::fs::write(folder.join(name), bytes).expect("written");
        }
    });
}

fn put(bytes: &mut Vec<u8>, at: usize, new: &[u8]) {
    if bytes.len() < at + new.len() {
        bytes.resize(at + new.len(), 0);
    }
    bytes[at..at + new.len()].copy_from_slice(new);
}

impl Disk {
    /// What goes wrong with this step, if anything does.
    fn wrong(&mut self, is_sync: bool) -> Option<Wrong> {
        self.steps += 1;
        let (left, wrong) = self.plan.as_mut()?;
        if !self.failing && *left > 0 {
            *left -= 1;
            return None;
        }
        let first = !std::mem::replace(&mut self.failing, true);
        let wrong = *wrong;
        match wrong {
            Wrong::Cut => Some(wrong),
            Wrong::Full => (!is_sync).then_some(wrong),
            Wrong::Short if !is_sync && first => Some(wrong),
            Wrong::Sync if is_sync && first => Some(wrong),
            Wrong::Short | Wrong::Sync => {
                // This step is of the other kind: the next one of its own kind fails.
                self.failing = !first;
                None
            }
        }
    }

    fn logged(&mut self, file: *mut sqlite3_file) -> Option<&mut Logged> {
        let (name, _) = self.open.get(&(file as usize))?;
        Some(self.files.entry(name.clone()).or_default())
    }
}

/// The functions that lie below.
fn below(file: *mut sqlite3_file) -> &'static sqlite3_io_methods {
    let at = DISK.with_borrow(|disk| disk.open.get(&(file as usize)).map(|(_, below)| *below)).expect("an open file");
    // SAFETY: the address was taken from SQLite's own table, which is never freed.
    unsafe { &*(at as *const sqlite3_io_methods) }
}

unsafe extern "C" fn write(file: *mut sqlite3_file, from: *const c_void, len: c_int, at: i64) -> c_int {
    let wrong = DISK.with_borrow_mut(|disk| disk.wrong(false));
    let (len, code) = match wrong {
        None => (len, SQLITE_OK),
        Some(Wrong::Full) => return SQLITE_FULL,
        Some(Wrong::Short) => (len / 2, SQLITE_IOERR_WRITE),
        Some(_) => return SQLITE_IOERR_WRITE,
    };
    // SAFETY: SQLite gives `len` bytes or more, and the table below has every function.
    let (written, bytes) = unsafe {
        let bytes = std::slice::from_raw_parts(from.cast::<u8>(), len as usize);
        ((below(file).xWrite.expect("there"))(file, from, len, at), bytes)
    };
    DISK.with_borrow_mut(|disk| {
        if let Some(logged) = disk.logged(file) {
            logged.since.push(Step::Write(at as usize, bytes.to_vec()));
        }
    });
    if code == SQLITE_OK { written } else { code }
}

unsafe extern "C" fn truncate(file: *mut sqlite3_file, length: i64) -> c_int {
    if DISK.with_borrow_mut(|disk| disk.wrong(false)).is_some() {
        return SQLITE_IOERR_WRITE;
    }
    DISK.with_borrow_mut(|disk| {
        if let Some(logged) = disk.logged(file) {
            logged.since.push(Step::Truncate(length as usize));
        }
    });
    // SAFETY: the file is open, and the table below has every function.
    unsafe { (below(file).xTruncate.expect("there"))(file, length) }
}

unsafe extern "C" fn sync(file: *mut sqlite3_file, _flags: c_int) -> c_int {
    if DISK.with_borrow_mut(|disk| disk.wrong(true)).is_some() {
        return SQLITE_IOERR_FSYNC;
    }
    DISK.with_borrow_mut(|disk| {
        let Some(logged) = disk.logged(file) else { return };
        for step in std::mem::take(&mut logged.since) {
            match step {
                Step::Truncate(length) => logged.synced.resize(length, 0),
                Step::Write(at, bytes) => put(&mut logged.synced, at, &bytes),
            }
        }
    });
    SQLITE_OK
}

unsafe extern "C" fn close(file: *mut sqlite3_file) -> c_int {
    let below = below(file);
    DISK.with_borrow_mut(|disk| disk.open.remove(&(file as usize)));
    // SAFETY: as above.
    unsafe { (below.xClose.expect("there"))(file) }
}

/// Nothing is promised of the disk.
unsafe extern "C" fn characteristics(_file: *mut sqlite3_file) -> c_int {
    0
}

unsafe extern "C" fn open(
    vfs: *mut sqlite3_vfs,
    name: sqlite3_filename,
    file: *mut sqlite3_file,
    flags: c_int,
    out: *mut c_int,
) -> c_int {
    // SAFETY: SQLite gives room for a file of the layer below, whose table is copied with other functions in it.
    unsafe {
        let code = (base().xOpen.expect("there"))(vfs, name, file, flags, out);
        if code != SQLITE_OK || name.is_null() || (*file).pMethods.is_null() {
            return code;
        }
        let below = (*file).pMethods;
        let methods = sqlite3_io_methods {
            xWrite: Some(write),
            xTruncate: Some(truncate),
            xSync: Some(sync),
            xClose: Some(close),
            xDeviceCharacteristics: Some(characteristics),
            ..*below
        };
        (*file).pMethods = Box::leak(Box::new(methods));
        let name = CStr::from_ptr(name).to_string_lossy().into_owned();
        DISK.with_borrow_mut(|disk| {
            disk.files.entry(name.clone()).or_default();
            disk.open.insert(file as usize, (name, below as usize));
        });
        code
    }
}

unsafe extern "C" fn delete(vfs: *mut sqlite3_vfs, name: *const std::ffi::c_char, sync: c_int) -> c_int {
    if DISK.with_borrow_mut(|disk| disk.wrong(false)).is_some() {
        return SQLITE_IOERR_WRITE;
    }
    // SAFETY: SQLite gives a name, and the table below has every function.
    unsafe {
        let name_text = CStr::from_ptr(name).to_string_lossy().into_owned();
        DISK.with_borrow_mut(|disk| disk.files.remove(&name_text));
        (base().xDelete.expect("there"))(vfs, name, sync)
    }
}

fn base() -> &'static sqlite3_vfs {
    // SAFETY: SQLite's own layer of the system is never freed.
    unsafe { &*sqlite3_vfs_find(c"unix".as_ptr()) }
}

fn register() {
    // SAFETY: the layer's table is copied whole, with other functions in it, and never freed.
    unsafe {
        rusqlite::ffi::sqlite3_initialize();
        let vfs = sqlite3_vfs { zName: c"faulty".as_ptr(), xOpen: Some(open), xDelete: Some(delete), ..*base() };
        assert_eq!(sqlite3_vfs_register(Box::leak(Box::new(vfs)), 1), SQLITE_OK);
    }
}
