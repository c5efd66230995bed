//! A file written over at one stroke.

use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use crate::failure::Failure;
use crate::texts::folder_of;

/// The new text in a file beside the old one, which then takes its place: there is never half a program.
pub fn write_at_one_stroke(path: &str, text: &[u8]) -> Result<(), Failure> {
    let cannot = |error: std::io::Error| Failure::call(format!("cannot write {path}: {error}"));
    // A link stays a link, to the file that it names.
    let goal = fs::canonicalize(path).unwrap_or_else(|_| Path::new(path).to_path_buf());
    let folder = folder_of(&goal.to_string_lossy());
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(cannot)?;
    file.write_all(text).map_err(cannot)?;
    file.as_file().sync_all().map_err(cannot)?;
    keep_permissions(&goal, file.as_file()).map_err(cannot)?;
    file.persist(&goal).map_err(|error| cannot(error.error))?;
    Ok(())
}

/// Whoever could read the old file can read the new one.
fn keep_permissions(old: &Path, new: &File) -> std::io::Result<()> {
    match fs::metadata(old) {
        Ok(facts) => new.set_permissions(facts.permissions()),
        #[cfg(unix)]
        Err(_) => new.set_permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644)),
        #[cfg(not(unix))]
        Err(_) => Ok(()),
    }
}
