//! What the fuzz targets have in common with the property tests: the same assertions on the same stages.

#[path = "../../crates/syntax/tests/reading/mod.rs"]
pub mod reading;
#[path = "../../crates/tape/tests/tapes/mod.rs"]
pub mod tapes;
#[path = "../../crates/station/tests/watch/mod.rs"]
pub mod watch;

use base::SourceId;
use dialect::{Control, builtin_controls};
use station::{Configuration, Setup};
use watch::Texts;

/// First bytes of an input that only choose a control; any other chooses one too, and is the text's.
const CHOICES: u8 = 8;
/// Programs that can be called by their files' names, `MAIN.CNC` being the text itself.
const SUB: &[u8] = b"G91G1X1.F100.\nM99\n";
const LARGE: &[u8] = b"G90G1Y1.F100.\nM98 SUB\n";

/// Every built-in control on a machine.
pub struct Fleet(Vec<Configuration>);

impl Fleet {
    /// Each on its own machine with this travel, mm; with `other` every policy is not what it is by default.
    pub fn new(travel: f64, setup: impl Fn(&Control) -> Setup, other: bool) -> Fleet {
        let fitted = |name: &String| {
            let control = watch::load(name);
            let machine = watch::machine(&control.stock_machine, Some(travel));
            let mut setup = setup(&control);
            let policies = control.policies.iter().filter(|_| other);
            setup.policies.extend(policies.filter_map(|row| {
                let value = row.values.iter().enumerate().rfind(|&(index, _)| index != row.default)?.1;
                Some((row.name.clone(), value.clone()))
            }));
            Configuration::new(control, machine, &[&setup]).expect("the set-up fits")
        };
        Fleet(builtin_controls().iter().map(fitted).collect())
    }

    /// The control that the first byte of an input chooses, and what is left of the input.
    pub fn choose<'i>(&self, input: &'i [u8]) -> (Configuration, &'i [u8]) {
        let first = input.first().copied().unwrap_or_default();
        let rest = if first < CHOICES { input.get(1..).unwrap_or_default() } else { input };
        (self.0[usize::from(first) % self.0.len()].clone(), rest)
    }
}

/// A text beside those that it may call by name.
pub fn texts(text: &[u8]) -> Texts {
    let files = vec![("MAIN.CNC", SourceId(0)), ("SUB.CNC", SourceId(1)), ("BIG.NC", SourceId(2))];
    Texts { texts: vec![text.to_vec(), SUB.to_vec(), LARGE.to_vec()], files, ..Texts::default() }
}
