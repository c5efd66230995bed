//! `members.toml`: what the members of a family differ in.

use data::{DataError, Table};

use super::{ControlFiles, origin, parameter_index};
use crate::member::{AxisDraft, AxisLetter, Member};
use crate::row::ParameterRow;

/// The file that makes a folder a family.
const FILE: &str = "members.toml";

impl ControlFiles {
    /// The members of the folder's family; none if it holds a single control.
    ///
    /// # Errors
    /// Everything that is wrong with `members.toml`.
    pub fn members(&self) -> Result<Vec<String>, Vec<DataError>> {
        Ok(self.read_members()?.into_iter().map(|member| member.name).collect())
    }

    /// The names of the controls in the folder of this name: its members, or its own.
    pub fn names(&self, folder: &str) -> Vec<String> {
        match self.members() {
            Ok(members) if !members.is_empty() => members,
            _ => vec![folder.to_owned()],
        }
    }

    /// These files for the control of this name, if the folder holds it.
    pub fn of(self, folder: &str, name: &str) -> Option<ControlFiles> {
        let found = self.names(folder).iter().any(|known| known == name);
        let member = (name != folder).then(|| name.to_owned());
        found.then_some(ControlFiles { member, ..self })
    }

    /// The member that is asked for.
    pub(super) fn own_member(&self) -> Result<Option<Member>, Vec<DataError>> {
        let Some(name) = &self.member else { return Ok(None) };
        let found = self.read_members()?.into_iter().find(|member| member.name == *name);
        found.map(Some).ok_or_else(|| super::refuse(self, FILE, format!("there is no member `{name}`")))
    }

    fn read_members(&self) -> Result<Vec<Member>, Vec<DataError>> {
        if !self.tables.iter().any(|(file, _)| file == FILE) {
            return Ok(Vec::new());
        }
        self.read(FILE, |root| root.tables("member", member))
    }
}

fn member(row: &mut Table) -> Member {
    row.require("axes");
    let axes = row.strings("axes").unwrap_or_default().into_iter().map(AxisDraft).collect();
    let member = Member {
        name: row.required_string("name"),
        title: row.required_string("title"),
        summary: row.required_string("summary"),
        stock_machine: row.required_string("stock_machine"),
        axes,
    };
    origin(row);
    member
}

impl AxisDraft {
    /// A letter, or the parameter that gives it.
    pub(super) fn resolve(
        &self,
        files: &ControlFiles,
        parameters: &[ParameterRow],
    ) -> Result<AxisLetter, Vec<DataError>> {
        match self.0.as_bytes() {
            [letter @ b'A'..=b'Z'] => Ok(AxisLetter::Fixed(*letter)),
            _ => Ok(AxisLetter::Parameter(parameter_index(files, parameters, &self.0)?)),
        }
    }
}
