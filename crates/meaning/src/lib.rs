//! Blocks to operations: what the control makes of a program.
//!
//! Comes in: the text of programs, asked for piece by piece. Goes out: [`Operation`]s in the order in which the
//! control executes them, pulled one at a time with [`Interpreter::next`]. Must never know: files, time, how fast
//! axes move, what any picture looks like.
//!
//! What the control has *read* ([`State`] of the reader) and what it is *executing* (the [`State`] that each queued
//! block carries) are two things: between them stands a queue as deep as the control's own buffer.

mod arc;
mod block;
mod centring;
mod circle_cutting;
mod codes;
mod command;
mod coordinate;
mod cycle;
mod data_setting;
mod dwell;
mod element;
mod expand;
mod facts;
mod feed;
mod g_codes;
mod interpreter;
mod interrupt;
mod jump;
mod kinematics;
mod local_coordinates;
mod mirror;
mod motion;
mod occasion;
mod operation;
mod polar;
mod position_offset;
mod program;
mod pull;
mod queue;
mod reader;
mod record;
mod reference_point;
mod repetition;
mod rotation;
mod scaling;
mod search;
mod setting;
mod skip;
mod state;
mod stroke;
mod supply;
mod surface_speed;
mod target;
mod tool_tip;
mod transform;
mod unknown;
mod user_macro;
mod word;
mod wording;

pub use command::{Command, CycleLevels, Finish, Leads};
pub use coordinate::LENGTH_AXIS;
pub use cycle::Spindle;
pub use element::{Element, Offset, Turn};
pub use facts::{AxisFacts, CodeRules, MachineFacts, Memory, OffsetTable, Switches};
pub use interpreter::Interpreter;
pub use interrupt::Interrupt;
pub use kinematics::{Carrier, Kinematics};
pub use operation::{
    Act, ArcMove, Close, CodeLine, CodeOut, Dwell, EndKind, Feed, Operation, Plane, RapidKind, SetValue, Side,
    StopKind, StrokeArea,
};
pub use polar::Polar;
pub use program::{Pointer, ProgramKey};
pub use pull::{Answer, Barrier, BarrierKind, Pull, Quantity, StaleBarrier};
pub use record::{ReadAs, StatementRead, StatementRuns, WordsRead};
pub use reference_point::ReferenceData;
pub use state::{Corner, FeedWord, State};
pub use stroke::StrokeBox;
pub use supply::WINDOW;
pub use transform::{Rotation, TRANSFORMED, Transform};
pub use unknown::{Unknown, letter_bit};
pub use user_macro::{BLANK, Variables};
pub use wording::Wording;
