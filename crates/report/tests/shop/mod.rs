//! A control on its stock machine with one program text, and every program of the corpus to run on it.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use base::SourceId;
use dialect::{builtin_files, load_control};
use machine::{builtin_machine, read_machine};
use station::{Configuration, Library, LibraryError, Session};

/// One text, held in memory.
pub struct OneText(pub Vec<u8>);

impl Library for OneText {
    fn read(&mut self, source: SourceId, offset: u64, len: usize, bytes: &mut Vec<u8>) -> Result<bool, LibraryError> {
        bytes.clear();
        let from = (offset as usize).min(self.0.len());
        let to = (from + len).min(self.0.len());
        if source == SourceId(0) {
            bytes.extend_from_slice(&self.0[from..to]);
        }
        Ok(to == self.0.len())
    }

    fn find_program(&mut self, _: station::Wanted) -> Result<Option<SourceId>, LibraryError> {
        Ok(None)
    }
}

/// The control at power-on, set up with nothing.
pub fn configuration() -> Configuration {
    let control = load_control(&builtin_files("yasnac-mx1").expect("it is built in")).expect("it is right");
    let (file, text) = builtin_machine(&control.stock_machine).expect("it is built in");
    let machine = read_machine(&file, text).expect("it is right");
    Configuration::new(Arc::new(control), machine, &[]).expect("nothing is set up wrongly")
}

/// A session with this text selected.
pub fn session(configuration: &Configuration, text: &[u8]) -> Session<OneText> {
    let mut session = Session::new(configuration.clone(), OneText(text.to_vec()));
    session.interpreter_mut().set_loop_limit(1000);
    session.select(SourceId(0), "in", syntax::Cursor::HEAD);
    session
}

/// Every program of the corpus and of the examples, by its path.
pub fn programs() -> Vec<(PathBuf, Vec<u8>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut found = Vec::new();
    for folder in [root.join("cases"), root.join("examples")] {
        collect(&folder, &mut found);
    }
    found.sort();
    assert!(found.len() > 300, "the corpus is there");
    found.into_iter().map(|path| (path.clone(), fs::read(&path).expect("it can be read"))).collect()
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("it can be read").flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "nc") {
            found.push(path);
        }
    }
}
