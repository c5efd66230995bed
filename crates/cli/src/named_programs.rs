//! The programs that a command line names: files, folders, patterns.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::texts::looks_like_program;

/// The programs that files, folders and patterns name, each once, in order.
pub fn named_programs(names: &[String]) -> Result<Vec<String>, Failure> {
    let mut files = Vec::new();
    for name in names {
        let path = Path::new(name);
        if name == "-" || (path.exists() && !path.is_dir()) {
            files.push(name.clone());
        } else if path.is_dir() {
            let before = files.len();
            programs_in(path, &mut files)?;
            if files.len() == before {
                return Err(Failure::call(format!(
                    "{name}: the folder holds no programs (.nc .cnc .tap .eia .txt, O1234)"
                )));
            }
        } else {
            let matches = glob::glob(name).map_err(|e| Failure::call(format!("{name}: {e}")))?;
            let mut found: Vec<PathBuf> = matches.flatten().filter(|path| path.is_file()).collect();
            found.sort();
            if found.is_empty() {
                return Err(Failure::call(format!("cannot read {name}: there is no such file")));
            }
            files.extend(found.into_iter().map(|path| path.to_string_lossy().into_owned()));
        }
    }
    let mut seen = BTreeSet::new();
    files.retain(|file| seen.insert(file.clone()));
    Ok(files)
}

fn programs_in(folder: &Path, files: &mut Vec<String>) -> Result<(), Failure> {
    let cannot = |error| Failure::call(format!("cannot read {}: {error}", folder.display()));
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).map_err(cannot)?.flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() && !path.is_symlink() {
            programs_in(&path, files)?;
        } else if path.is_file() && looks_like_program(&path) {
            files.push(path.to_string_lossy().into_owned());
        }
    }
    Ok(())
}
