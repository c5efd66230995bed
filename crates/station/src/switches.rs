//! The operator's switches, as far as they are built.

/// The operator's switches.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct SessionSwitches {
    /// M01 stops.
    pub optional_stop: bool,
    /// A stop after every block.
    pub single_block: bool,
    /// Block delete 1 to 9, bit 0 for the first.
    pub block_delete: u16,
}

impl SessionSwitches {
    /// Turns a switch by its name.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn set(&mut self, name: &str, number: Option<u8>, on: bool) -> Result<(), String> {
        match name {
            "optional-stop" => self.optional_stop = on,
            "single-block" => self.single_block = on,
            "block-delete" => {
                let bit = 1 << (number.unwrap_or(1).clamp(1, 9) - 1);
                self.block_delete = if on { self.block_delete | bit } else { self.block_delete & !bit };
            }
            "dry-run" | "machine-lock" | "display-lock" | "aux-lock" | "z-cancel" | "manual-absolute" => {
                return Err(format!("the switch `{name}` is not built yet"));
            }
            _ => {
                return Err(format!(
                    "there is no switch `{name}`; built are optional-stop, block-delete[=n], single-block"
                ));
            }
        }
        Ok(())
    }
}
