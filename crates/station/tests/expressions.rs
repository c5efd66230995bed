//! Expressions of macros against an evaluation of their own, and programs against the same ones written out.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::fmt::Write;

use machine::EventKind;
use proptest::prelude::*;
use station::{Session, Setup, Step};
use watch::{Texts, configuration, machine, select};

/// How far two evaluations of the same expression may differ, relative to the larger of it and 1.
const EXACTNESS: f64 = 1e-9;

/// An expression as a tree.
#[derive(Clone, Debug)]
enum Tree {
    Number(u32),
    Negative(Box<Tree>),
    Two(&'static str, Box<Tree>, Box<Tree>),
    Function(&'static str, Box<Tree>),
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = (0u32..100_000).prop_map(Tree::Number);
    leaf.prop_recursive(3, 12, 2, |inner| {
        let two = prop::sample::select(vec!["+", "-", "*", "/"]);
        let one = prop::sample::select(vec!["SIN", "COS", "ABS", "SQRT", "FIX", "FUP", "ROUND"]);
        prop_oneof![
            (two, inner.clone(), inner.clone()).prop_map(|(op, a, b)| Tree::Two(op, a.into(), b.into())),
            (one, inner.clone()).prop_map(|(name, a)| Tree::Function(name, a.into())),
            inner.prop_map(|a| Tree::Negative(a.into())),
        ]
    })
}

impl Tree {
    fn text(&self) -> String {
        match self {
            Tree::Number(thousandths) => format!("{}.{:03}", thousandths / 1000, thousandths % 1000),
            Tree::Negative(a) => format!("[-{}]", a.text()),
            Tree::Two(op, a, b) => format!("[{}{op}{}]", a.text(), b.text()),
            Tree::Function(name, a) => format!("{name}[{}]", a.text()),
        }
    }

    /// Its value by the standard library; `None` where there is none, or where rounding decides.
    fn value(&self) -> Option<f64> {
        let value = match self {
            Tree::Number(thousandths) => f64::from(*thousandths) / 1000.0,
            Tree::Negative(a) => -a.value()?,
            Tree::Two(op, a, b) => {
                let (a, b) = (a.value()?, b.value()?);
                match *op {
                    "+" => a + b,
                    "-" => a - b,
                    "*" => a * b,
                    // A divisor that is nothing but rounding has no value worth comparing.
                    _ if b.abs() < 1e-6 => return None,
                    _ => a / b,
                }
            }
            Tree::Function(name, a) => {
                let a = a.value()?;
                let near_a_step = ((a * 2.0).round() - a * 2.0).abs() < 1e-6 && a != a.trunc();
                match *name {
                    "SIN" => a.to_radians().sin(),
                    "COS" => a.to_radians().cos(),
                    "ABS" => a.abs(),
                    "SQRT" if a < 1e-6 => return None,
                    "SQRT" => a.sqrt(),
                    _ if near_a_step || (a - a.round()).abs() < 1e-6 => return None,
                    "FIX" => a.trunc(),
                    "FUP" => a.signum() * a.abs().ceil(),
                    _ => a.round(),
                }
            }
        };
        // Large angles lose more digits than are compared.
        (value.abs() < 1e6).then_some(value)
    }

    fn depth(&self) -> usize {
        match self {
            Tree::Number(_) => 0,
            Tree::Negative(a) | Tree::Function(_, a) => 1 + a.depth(),
            Tree::Two(_, a, b) => 1 + a.depth().max(b.depth()),
        }
    }
}

/// Runs a program; where its moves end, and the value of #100.
fn run(text: &str) -> (Vec<[f64; 3]>, Option<f64>) {
    let configuration = configuration(machine("unlimited", None), &Setup::default());
    let mut session = Session::new(configuration, Texts::one(text));
    select(&mut session, 0);
    session.start();
    let mut points = Vec::new();
    loop {
        match session.next() {
            Step::Event(event) => match event.kind {
                EventKind::Rapid { to, .. } | EventKind::Feed { to, .. } => points.push([to[0], to[1], to[2]]),
                EventKind::Alarm(alarm) => panic!("{:?} in line {} of\n{text}", alarm.condition, alarm.place.line),
                _ => {}
            },
            Step::Stopped => session.start(),
            Step::Idle => return (points, session.interpreter().variable(100)),
            Step::Failed(error) => panic!("{error}"),
        }
    }
}

proptest! {
    #[test]
    fn expressions_have_the_value_of_their_tree(tree in tree()) {
        prop_assume!(tree.depth() <= 5);
        let text = tree.text();
        prop_assume!(text.len() < 110);
        let Some(value) = tree.value() else { return Ok(()) };
        let got = run(&format!("#100={text}\n")).1.expect("it has a value");
        prop_assert!((got - value).abs() <= EXACTNESS * value.abs().max(1.0), "{text} is {value}, not {got}");
    }

    #[test]
    fn a_loop_moves_as_the_same_blocks_written_out(
        turns in 0u32..12,
        step in 1i32..5000,
        radius in 1u32..90,
        calls in any::<bool>(),
    ) {
        let step_mm = f64::from(step) / 1000.0;
        let body = "X[#1*#2] Y[#3*SIN[#1*10]]";
        let mut text = format!("O1\nG90 G01 F500\n#1=0\n#2={step_mm:.3}\n#3={radius}\n");
        let mut plain = "G90 G01 F500\n".to_owned();
        if calls {
            let _ = writeln!(text, "G66 P2 A9.");
        }
        let _ = writeln!(text, "WHILE [#1 LT {turns}] DO 1\n{body}\n#1=#1+1\nEND 1\nG67\nM30\nO2\nZ-#1\nZ#1\nM99");
        for turn in 0..turns {
            let angle = f64::from(turn * 10).to_radians();
            let (x, y) = (f64::from(turn) * step_mm, f64::from(radius) * angle.sin());
            let _ = writeln!(plain, "X{x:.3} Y{y:.3}");
            if calls {
                let _ = writeln!(plain, "Z-9.\nZ9.");
            }
        }
        let (ours, theirs) = (run(&text).0, run(&plain).0);
        prop_assert_eq!(ours.len(), theirs.len());
        for (a, b) in ours.iter().zip(&theirs) {
            for axis in 0..3 {
                // A value half way between two increments may be printed either way.
                prop_assert!((a[axis] - b[axis]).abs() <= 0.001 + 1e-9, "{:?} {:?}", a, b);
            }
        }
    }
}
