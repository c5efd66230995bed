//! The bytecode of expressions: operations on a small stack.

use dialect::Function;
use syntax::Extent;

/// Values that an expression may have pending; deeper ones are refused when they are compiled.
pub(crate) const STACK: usize = 32;

/// How two values are compared.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Comparison {
    Equal,
    NotEqual,
    Greater,
    Less,
    GreaterOrEqual,
    LessOrEqual,
}

/// One operation. Those without a comment take one or two values from the stack and leave one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Op {
    /// Leaves a number.
    Number(f64),
    /// Leaves a local variable.
    Local(u8),
    /// Leaves a common variable by its index.
    Volatile(u16),
    /// Leaves a common variable by its index.
    Permanent(u16),
    /// Leaves a system variable.
    System(u32),
    /// The variable of this number.
    Indirect,
    Negate,
    Add,
    Subtract,
    Or,
    Xor,
    Multiply,
    Divide,
    And,
    Function(Function),
    Compare(Comparison),
}

/// A run of operations in a [`Code`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Run {
    pub from: u32,
    pub to: u32,
}

/// Operations of many expressions, each with the place in its block that an alarm points at.
#[derive(Clone, Default)]
pub(crate) struct Code {
    ops: Vec<Op>,
    places: Vec<Extent>,
}

impl Code {
    pub fn push(&mut self, op: Op, place: Extent) {
        self.ops.push(op);
        self.places.push(place);
    }

    pub fn len(&self) -> usize {
        self.ops.len()
    }

    pub fn truncate(&mut self, len: usize) {
        self.ops.truncate(len);
        self.places.truncate(len);
    }

    pub fn clear(&mut self) {
        self.truncate(0);
    }

    pub fn ops(&self, run: Run) -> &[Op] {
        self.ops.get(run.from as usize..run.to as usize).unwrap_or_default()
    }

    /// Where the operation of this index within a run stands.
    pub fn place(&self, run: Run, index: usize) -> Extent {
        self.places.get(run.from as usize + index).copied().unwrap_or_default()
    }
}
