//! The controls that come with the program: every folder of `controls/`, by its presence, and the members of families.

use include_dir::{Dir, include_dir};

use crate::load::ControlFiles;

static CONTROLS: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../controls");

/// The names of the built-in controls.
pub fn builtin_controls() -> Vec<String> {
    let folders = CONTROLS.dirs().filter_map(|dir| dir.path().to_str());
    folders.flat_map(|folder| folder_files(folder).map_or_else(Vec::new, |files| files.names(folder))).collect()
}

/// The files of a built-in control.
pub fn builtin_files(name: &str) -> Option<ControlFiles> {
    let mut folders = CONTROLS.dirs().filter_map(|dir| dir.path().to_str());
    folders.find_map(|folder| folder_files(folder)?.of(folder, name))
}

fn folder_files(name: &str) -> Option<ControlFiles> {
    let folder = CONTROLS.get_dir(name)?;
    let text = |file: &include_dir::File| Some((file.path().to_str()?.to_owned(), file.contents_utf8()?.to_owned()));
    let shared = |name: &str| CONTROLS.get_file(name).and_then(text).map(|(_, text)| text).unwrap_or_default();
    Some(ControlFiles {
        folder: format!("controls/{name}"),
        tables: folder
            .files()
            .filter_map(text)
            .map(|(path, content)| (path.rsplit('/').next().unwrap_or_default().to_owned(), content))
            .collect(),
        member: None,
        conditions: shared("conditions.toml"),
        warnings: shared("warnings.toml"),
    })
}
