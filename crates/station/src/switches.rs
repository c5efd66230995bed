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
}

/// Every switch by its name; `block-delete` may take a number.
const NAMES: &str = "optional-stop, block-delete[=n], single-block, dry-run, machine-lock, display-lock, aux-lock, \
                     z-cancel, manual-absolute, edit-lock";

impl SessionSwitches {
    /// The names of those that are on, as scripts write them.
    pub fn on(&self) -> Vec<String> {
        let switches = [
            ("optional-stop", self.optional_stop),
            ("single-block", self.single_block),
            ("dry-run", self.dry_run),
            ("machine-lock", self.machine_lock),
            ("display-lock", self.display_lock),
            ("aux-lock", self.aux_lock),
            ("z-cancel", self.z_cancel),
            ("manual-absolute", self.manual_absolute),
        ];
        let deletes = (1..=9).filter(|number| self.block_delete >> (number - 1) & 1 == 1);
        let on = switches.into_iter().filter(|(_, on)| *on).map(|(name, _)| name.to_owned());
        on.chain(deletes.map(|number| format!("block-delete={number}"))).collect()
    }

    /// Turns a switch by its name.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn set(&mut self, name: &str, number: Option<u8>, on: bool) -> Result<(), String> {
        let switch = match name {
            "block-delete" => {
                let bit = 1 << (number.unwrap_or(1).clamp(1, 9) - 1);
                self.block_delete = if on { self.block_delete | bit } else { self.block_delete & !bit };
                return Ok(());
            }
            "optional-stop" => &mut self.optional_stop,
            "single-block" => &mut self.single_block,
            "dry-run" => &mut self.dry_run,
            "machine-lock" => &mut self.machine_lock,
            "display-lock" => &mut self.display_lock,
            "aux-lock" => &mut self.aux_lock,
            "z-cancel" => &mut self.z_cancel,
            "manual-absolute" => &mut self.manual_absolute,
            "edit-lock" => &mut self.edit_lock,
            _ => {
                let names = NAMES.split(", ").map(|name| name.trim_end_matches("[=n]"));
                return Err(match nearest(name, names) {
                    Some(near) => format!("there is no switch `{name}`, perhaps `{near}` is meant"),
                    None => format!("there is no switch `{name}`; the switches are {NAMES}"),
                });
            }
        };
        *switch = on;
        Ok(())
    }
}
