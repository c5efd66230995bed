//! Members of a family of controls: one folder of tables, and what each member has of its own.

/// One axis of a control by its letter.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AxisLetter {
    /// This letter.
    Fixed(u8),
    /// The letter that the parameter of this index names.
    Parameter(usize),
}

/// An axis as `members.toml` names it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct AxisDraft(pub String);

/// What a member has of its own.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Member {
    pub name: String,
    pub title: String,
    pub summary: String,
    pub stock_machine: String,
    pub axes: Vec<AxisDraft>,
}
