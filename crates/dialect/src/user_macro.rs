//! The user macro of a control: its variables, the arguments of a call, its functions and limits.

use crate::meaning::{Function, VariableMeaning};
use crate::row::Origin;

/// Variables of one kind, by their numbers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct VariableRow {
    /// The lowest number.
    pub from: u32,
    /// The highest number.
    pub to: u32,
    /// A program may read them.
    pub read: bool,
    /// A program may write them.
    pub write: bool,
    /// What stands behind them.
    pub meaning: VariableMeaning,
    /// Which axis (from 1) or work system (0 = all) they are of, where the meaning asks for one.
    pub which: u8,
    /// The letter of a modal word, 0 for none.
    pub letter: u8,
    /// What they are, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// An address letter of a macro call and the local variable that it fills.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ArgumentRow {
    /// The letter.
    pub letter: u8,
    /// The variable.
    pub variable: u8,
    /// What the row rests on.
    pub origin: Origin,
}

/// A function of expressions.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FunctionRow {
    /// As programs write it.
    pub name: String,
    /// What it does.
    pub meaning: Function,
    /// What it does, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// The user macro of one control.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UserMacro {
    /// Brackets that may stand inside one another.
    pub brackets: usize,
    /// Loops that may stand inside one another; their numbers are 1 to this.
    pub loops: usize,
    /// IF may be followed by THEN and an assignment.
    pub then: bool,
    /// I J K groups that a call may have.
    pub triples: usize,
    /// The variables, lowest numbers first.
    pub variables: Vec<VariableRow>,
    /// The arguments.
    pub arguments: Vec<ArgumentRow>,
    /// The functions.
    pub functions: Vec<FunctionRow>,
}

impl UserMacro {
    /// The row of a variable, if the control has one of this number.
    pub fn variable(&self, number: u32) -> Option<&VariableRow> {
        let after = self.variables.partition_point(|row| row.from <= number);
        self.variables.get(after.checked_sub(1)?).filter(|row| number <= row.to)
    }

    /// The local variable that a letter of a call fills.
    pub fn argument(&self, letter: u8) -> Option<u8> {
        self.arguments.iter().find(|row| row.letter == letter).map(|row| row.variable)
    }

    /// The numbers of one kind of variables.
    pub fn range_of(&self, meaning: VariableMeaning) -> Option<(u32, u32)> {
        self.variables.iter().find(|row| row.meaning == meaning).map(|row| (row.from, row.to))
    }
}
