//! The controls that come with the program: every folder of `controls/`, by its presence.

use include_dir::{Dir, include_dir};

use crate::load::ControlFiles;

static CONTROLS: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../controls");

/// The names of the built-in controls.
pub fn builtin_controls() -> impl Iterator<Item = &'static str> {
    CONTROLS.dirs().filter_map(|dir| dir.path().to_str())
}

/// The files of a built-in control.
pub fn builtin_files(name: &str) -> Option<ControlFiles> {
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
        conditions: shared("conditions.toml"),
        warnings: shared("warnings.toml"),
    })
}
