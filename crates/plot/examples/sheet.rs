//! Draws a plate with an outside contour, a pocket, arcs, helices and drilled holes to `plot-sheet.svg` and `.png`.
//! `cargo run -p plot --example sheet -- FOLDER`

use plot::{Arc, Drawing, Kind, Mark, MarkKind, Plane, Stroke, Title};

/// Where the machine changes tools.
const REFERENCE: [f64; 3] = [0.0, 0.0, 0.0];
/// The plate's corner and top in machine coordinates.
const PLATE: [f64; 3] = [-420.0, -280.0, -310.0];

/// A tool that moves in the plate's coordinates and draws where it goes.
struct Tool {
    drawing: Drawing,
    at: [f64; 3],
    feed: f64,
    tool: u32,
}

impl Tool {
    fn go(&mut self, kind: Kind, to: [f64; 3], arc: Option<Arc>) {
        let stroke = Stroke { kind, from: self.at, to, arc, feed: self.feed, tool: self.tool };
        self.drawing.stroke(&stroke);
        self.at = to;
    }

    fn rapid(&mut self, x: f64, y: f64, z: f64) {
        self.go(Kind::Rapid, [PLATE[0] + x, PLATE[1] + y, PLATE[2] + z], None);
    }

    fn line(&mut self, x: f64, y: f64, z: f64) {
        self.go(Kind::Feed, [PLATE[0] + x, PLATE[1] + y, PLATE[2] + z], None);
    }

    fn arc(&mut self, end: [f64; 3], center: [f64; 2], sweep_deg: f64) {
        let to = [PLATE[0] + end[0], PLATE[1] + end[1], PLATE[2] + end[2]];
        let arc = Arc { plane: Plane::Xy, center: [PLATE[0] + center[0], PLATE[1] + center[1]], sweep_deg };
        self.go(Kind::Feed, to, Some(arc));
    }

    fn mark(&mut self, kind: MarkKind, text: &str) {
        self.drawing.mark(Mark { at: self.at, kind, text: text.to_owned() });
    }

    fn change(&mut self, tool: u32) {
        self.go(Kind::Rapid, [self.at[0], self.at[1], REFERENCE[2]], None);
        self.go(Kind::Rapid, REFERENCE, None);
        self.tool = tool;
        self.mark(MarkKind::ToolChange(tool), "");
    }

    fn outside_contour(&mut self) {
        self.rapid(-15.0, -15.0, 50.0);
        for depth in [-6.0, -12.0] {
            self.rapid(-15.0, -15.0, 2.0);
            self.feed = 150.0;
            self.line(-15.0, -15.0, depth);
            self.feed = 450.0;
            self.line(-5.0, 20.0, depth);
            self.line(-5.0, 125.0, depth);
            self.arc([20.0, 150.0, depth], [20.0, 125.0], -90.0);
            self.line(160.0, 150.0, depth);
            self.arc([180.0, 130.0, depth], [160.0, 130.0], -90.0);
            self.line(180.0, 95.0, depth);
            self.arc([180.0, 45.0, depth], [180.0, 70.0], 180.0);
            self.line(180.0, 10.0, depth);
            self.line(165.0, -5.0, depth);
            self.line(10.0, -5.0, depth);
            self.line(-5.0, 10.0, depth);
            self.line(-15.0, 20.0, depth);
            self.rapid(-15.0, 20.0, 2.0);
        }
        self.rapid(-15.0, 20.0, 50.0);
    }

    fn pocket(&mut self) {
        self.rapid(60.0, 75.0, 2.0);
        self.feed = 150.0;
        self.line(60.0, 75.0, 0.0);
        for turn in 1..=4 {
            self.arc([60.0, 75.0, -2.0 * f64::from(turn)], [55.0, 75.0], 360.0);
        }
        self.feed = 900.0;
        for out in 1..=6 {
            let (half, deep) = (4.5 * f64::from(out), 15.0 + 4.5 * f64::from(out));
            self.line(70.0 - 0.5 * half - 10.0, 75.0 - half, -8.0);
            self.line(50.0 + deep, 75.0 - half, -8.0);
            self.arc([50.0 + deep, 75.0 + half, -8.0], [50.0 + deep, 75.0], 180.0);
            self.line(40.0, 75.0 + half, -8.0);
            self.arc([40.0, 75.0 - half, -8.0], [40.0, 75.0], 180.0);
        }
        self.rapid(40.0, 48.0, 2.0);
    }

    fn round_boss(&mut self) {
        self.rapid(150.0, 118.0, 2.0);
        self.feed = 450.0;
        self.line(150.0, 118.0, -3.0);
        self.arc([150.0, 118.0, -3.0], [140.0, 118.0], -360.0);
        self.rapid(150.0, 118.0, 50.0);
    }

    fn holes(&mut self) {
        self.feed = 80.0;
        for (x, y) in [(10.0, 20.0), (10.0, 75.0), (20.0, 135.0), (90.0, 135.0), (160.0, 20.0), (90.0, 12.0)] {
            self.rapid(x, y, 5.0);
            for depth in [-8.0, -16.0, -25.0] {
                self.line(x, y, depth);
                self.rapid(x, y, 5.0);
            }
        }
        self.mark(MarkKind::Stop, "M00 turn the clamps");
        for step in 0..8 {
            let (sin, cos) = (f64::from(step) * 45.0f64).to_radians().sin_cos();
            let (x, y) = (140.0 + 16.0 * cos, 118.0 + 16.0 * sin);
            self.rapid(x, y, 5.0);
            self.line(x, y, -10.0);
            self.rapid(x, y, 5.0);
        }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args_os().nth(1).ok_or("usage: sheet FOLDER")?;
    let title = Title {
        program: "O1234 CLAMP PLATE".to_owned(),
        control: "Yasnac MX1".to_owned(),
        machine: "vertical machining centre".to_owned(),
    };
    let mut tool = Tool { drawing: Drawing::new(title), at: REFERENCE, feed: 0.0, tool: 1 };
    tool.mark(MarkKind::Start, "");
    tool.outside_contour();
    tool.pocket();
    tool.round_boss();
    tool.change(2);
    tool.rapid(10.0, 20.0, 50.0);
    tool.holes();
    tool.go(Kind::Rapid, [tool.at[0], tool.at[1], REFERENCE[2]], None);
    tool.go(Kind::Rapid, REFERENCE, None);
    tool.mark(MarkKind::End, "");
    let folder = std::path::Path::new(&folder);
    std::fs::write(folder.join("plot-sheet.svg"), tool.drawing.svg())?;
    std::fs::write(folder.join("plot-sheet.png"), tool.drawing.png(1600)?)?;
    Ok(())
}
