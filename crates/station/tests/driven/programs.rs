//! Longer programs of the kinds that are cut: holes, contours under compensation, surfaces of short lines.

use std::fmt::Write;

use machine::MachineFile;
use motion::{Classic, Model};
use station::{OffsetColumn, Setup};

const HEAD: &str = "O1\nG17 G21 G40 G49 G80 G90 G94\nG54\nG00 X0 Y0 Z20.\n";

/// The offsets that they use.
pub fn setup() -> Setup {
    Setup { offsets: vec![(OffsetColumn::Common, 1, 3.0)], ..Setup::default() }
}

/// The machine under one of the models, its jerk limited for that.
pub fn set_model(machine: &mut MachineFile, model: &str) {
    let classic = Classic { rapid_s: 0.15, feed_s: 0.05, block_s: 0.01, buffer: 2, in_position_mm: 0.01 };
    machine.path.model = match model {
        "jerk" => Model::Jerk,
        "classic" => Model::Classic(classic),
        _ => Model::Trapezoid,
    };
    for axis in &mut machine.axes {
        axis.jerk = if model == "jerk" { axis.acceleration * 20.0 } else { 0.0 };
    }
}

/// Their names and texts.
pub fn all() -> [(&'static str, String); 3] {
    [("holes", holes()), ("contours", contours()), ("surface", surface())]
}

fn holes() -> String {
    let mut text = HEAD.to_owned();
    for hole in 0..60 {
        let (x, y) = (hole % 10 * 6, hole / 10 * 8);
        match hole % 20 {
            0 => writeln!(text, "G98 G83 Z-18. R2. Q4. F180 X{x}. Y{y}."),
            10 => writeln!(text, "G99 G81 Z-6. R2. F250 X{x}. Y{y}."),
            _ => writeln!(text, "X{x}. Y{y}."),
        }
        .expect("into a string");
    }
    text + "G80\nG00 Z50.\nM30\n"
}

fn contours() -> String {
    let mut text = HEAD.to_owned();
    for contour in 0..3 {
        let (code, arc, sign) = if contour % 2 == 0 { ("G41", "G03", -1.0) } else { ("G42", "G02", 1.0) };
        let x = f64::from(contour) * 160.0 + 60.0;
        writeln!(text, "G00 X{:.3} Y{:.3}\nZ2.\nG01 Z-3. F300", x + 20.0, -sign * 20.0).expect("into a string");
        writeln!(text, "{code} D1 X{:.3} Y{:.3} F900", x + 6.0, -sign * 8.0).expect("into a string");
        for corner in 0..=200 {
            let angle = sign * f64::from(corner) * std::f64::consts::TAU / 200.0;
            let radius = 50.0 + 6.0 * (5.0 * angle).cos();
            writeln!(text, "X{:.3} Y{:.3} F2000", x - 50.0 + radius * angle.cos(), radius * angle.sin())
                .expect("into a string");
        }
        writeln!(text, "{arc} X{:.3} Y{:.3} I10. J0.\nG01 G40 X{:.3}\nG00 Z5.", x + 16.0, sign * 10.0, x + 31.0)
            .expect("into a string");
    }
    text + "M30\n"
}

fn surface() -> String {
    let mut text = HEAD.to_owned() + "G01 Z5. F3000\n";
    for row in 0..8 {
        for step in 0..=250 {
            let step = if row % 2 == 0 { step } else { 250 - step };
            let (x, y) = (f64::from(step) * 0.2, f64::from(row) * 0.3);
            writeln!(text, "X{x:.3} Y{y:.3} Z{:.3}", 2.0 * (x / 5.0).sin() + (y / 2.0).cos()).expect("into a string");
        }
    }
    text + "M30\n"
}
