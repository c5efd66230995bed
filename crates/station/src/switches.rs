//! The operator's switches.

use data::nearest;

/// The operator's switches, on or off.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct SessionSwitches {
    /// M01 stops.
    pub optional_stop: bool,
    /// A stop after every block.
    pub single_block: bool,
    /// Block delete 1 to 9, bit 0 for the first.
    pub block_delete: u16,
    /// Feed moves run at the jog speed.
    pub dry_run: bool,
    /// No axis moves, the displays run.
    pub machine_lock: bool,
    /// The axes move, the displays stand.
    pub display_lock: bool,
    /// M, S, T and B are not sent, except the M codes of the control.
    pub aux_lock: bool,
    /// Z does not move, its display runs.
    pub z_cancel: bool,
    /// Moves by hand count into the program's coordinates. Off, the program runs beside its place by as much.
    pub manual_absolute: bool,
    /// Programs in memory are not changed.
    pub edit_lock: bool,
    /// The feed override counts as 100 %.
    pub override_cancel: bool,
    /// CYCLE START does nothing.
    pub start_lock: bool,
    /// Axes by their letters, bit 0 for A: their distances change sign.
    pub mirror_image: u32,
}

/// A switch that is on or off and nothing else.
type Plain = (&'static str, fn(&mut SessionSwitches) -> &mut bool);

const PLAIN: &[Plain] = &[
    ("optional-stop", |switches| &mut switches.optional_stop),
    ("single-block", |switches| &mut switches.single_block),
    ("dry-run", |switches| &mut switches.dry_run),
    ("machine-lock", |switches| &mut switches.machine_lock),
    ("display-lock", |switches| &mut switches.display_lock),
    ("aux-lock", |switches| &mut switches.aux_lock),
    ("z-cancel", |switches| &mut switches.z_cancel),
    ("manual-absolute", |switches| &mut switches.manual_absolute),
    ("edit-lock", |switches| &mut switches.edit_lock),
    ("override-cancel", |switches| &mut switches.override_cancel),
    ("start-lock", |switches| &mut switches.start_lock),
];

/// The switches with a number.
const BLOCK_DELETE: &str = "block-delete";
/// The switches with an axis.
pub(crate) const MIRROR_IMAGE: &str = "mirror-image";

/// Which of several switches of a name is meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Which {
    /// The only one, or the first.
    One,
    /// By its number.
    Number(u8),
    /// By the letter of its axis.
    Axis(u8),
}

impl Which {
    /// `=2`, `=X`, or nothing.
    pub fn suffix(self) -> String {
        match self {
            Which::One => String::new(),
            Which::Number(number) => format!("={number}"),
            Which::Axis(letter) => format!("={}", char::from(letter)),
        }
    }
}

/// Every switch by its name.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    PLAIN.iter().map(|(name, _)| *name).chain([BLOCK_DELETE, MIRROR_IMAGE])
}

/// A switch as users write it: `optional-stop`, `block-delete=2`, `mirror-image=X`.
///
/// # Errors
/// A number where none may be, or one that no switch has.
pub fn split_switch(text: &str) -> Result<(String, Which), String> {
    let Some((name, which)) = text.split_once('=') else { return Ok((text.to_owned(), Which::One)) };
    let which = match (name, which.as_bytes()) {
        (BLOCK_DELETE, _) => match which.parse() {
            Ok(number @ 1..=9) => Which::Number(number),
            _ => return Err(format!("block delete switches are numbered 1 to 9, not `{which}`")),
        },
        (MIRROR_IMAGE, [letter @ b'A'..=b'Z']) => Which::Axis(*letter),
        (MIRROR_IMAGE, _) => return Err(format!("`{which}` is no axis letter")),
        _ => return Err(format!("the switch `{name}` takes no number")),
    };
    Ok((name.to_owned(), which))
}

impl SessionSwitches {
    /// The names of those that are on, as scripts write them.
    pub fn on(mut self) -> Vec<String> {
        let mut on: Vec<_> =
            PLAIN.iter().filter(|(_, switch)| *switch(&mut self)).map(|(name, _)| (*name).to_owned()).collect();
        let deletes = (1..=9).filter(|number| self.block_delete >> (number - 1) & 1 == 1);
        on.extend(deletes.map(|number| format!("{BLOCK_DELETE}={number}")));
        let mirrored = (b'A'..=b'Z').filter(|&letter| self.mirrors(letter));
        on.extend(mirrored.map(|letter| format!("{MIRROR_IMAGE}={}", char::from(letter))));
        on
    }

    /// True if the axis' mirror image is on.
    pub fn mirrors(&self, letter: u8) -> bool {
        letter.is_ascii_uppercase() && self.mirror_image >> (letter - b'A') & 1 == 1
    }

    /// Turns a switch by its name.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn set(&mut self, name: &str, which: Which, on: bool) -> Result<(), String> {
        if let Some((_, switch)) = PLAIN.iter().find(|(own, _)| *own == name) {
            *switch(self) = on;
            return Ok(());
        }
        match (name, which) {
            (BLOCK_DELETE, _) => {
                let number = if let Which::Number(number) = which { number.clamp(1, 9) } else { 1 };
                let bit = 1 << (number - 1);
                self.block_delete = if on { self.block_delete | bit } else { self.block_delete & !bit };
                Ok(())
            }
            (MIRROR_IMAGE, Which::Axis(letter @ b'A'..=b'Z')) => {
                let bit = 1 << (letter - b'A');
                self.mirror_image = if on { self.mirror_image | bit } else { self.mirror_image & !bit };
                Ok(())
            }
            (MIRROR_IMAGE, _) => Err("mirror image has a switch for each axis: mirror-image=X".to_owned()),
            _ => Err(match nearest(name, names()) {
                Some(near) => format!("there is no switch `{name}`, perhaps `{near}` is meant"),
                None => {
                    format!("there is no switch `{name}`; the switches are {}", names().collect::<Vec<_>>().join(", "))
                }
            }),
        }
    }
}
