//! The `d` attribute of an SVG path, as short as it can be: hundredths of a sheet unit, relative, without idle moves.

/// A hundredth of a unit is the finest that is written.
const PARTS: f64 = 100.0;

/// A path that has more points than this is continued in another element: renderers are slow with very long ones.
const MOST_POINTS: usize = 4_000;

/// Path data that grows.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathData {
    text: String,
    /// Where the pen is.
    at: Option<[i64; 2]>,
    /// Where the pen will be put down with the next line.
    lifted_to: Option<[i64; 2]>,
    points: usize,
    command: char,
    finished: Vec<String>,
}

impl PathData {
    /// Draws a straight line; one that begins where the last one ended continues it.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        let Some([at, to]) = self.begin(from, to) else { return };
        self.say('l');
        self.number(to[0] - at[0]);
        self.number(to[1] - at[1]);
        self.arrive(to);
    }

    /// Draws part of an upright ellipse, less than half of it; `clockwise` is as seen on the sheet.
    pub fn ellipse(&mut self, from: [f64; 2], to: [f64; 2], radii: [f64; 2], clockwise: bool) {
        let Some([at, to]) = self.begin(from, to) else { return };
        self.say('a');
        self.number(parts(radii[0]));
        self.number(parts(radii[1]));
        self.text.push_str(if clockwise { " 0 0 1" } else { " 0 0 0" });
        self.number(to[0] - at[0]);
        self.number(to[1] - at[1]);
        self.arrive(to);
    }

    /// Puts the pen down at the beginning of a stroke; its two ends, if they are two places on the sheet.
    fn begin(&mut self, from: [f64; 2], to: [f64; 2]) -> Option<[[i64; 2]; 2]> {
        self.move_to(from);
        let (at, to) = (self.lifted_to.or(self.at)?, to.map(parts));
        if to == at {
            return None;
        }
        self.put_down();
        Some([at, to])
    }

    /// The finished paths, each fit for one `d` attribute.
    pub fn finish(mut self) -> Vec<String> {
        self.cut();
        self.finished
    }

    fn move_to(&mut self, from: [f64; 2]) {
        let from = from.map(parts);
        self.lifted_to = (self.at != Some(from)).then_some(from);
    }

    fn put_down(&mut self) {
        if let Some(to) = self.lifted_to.take() {
            self.text.push('M');
            self.command = 'M';
            self.number(to[0]);
            self.number(to[1]);
        }
    }

    fn arrive(&mut self, to: [i64; 2]) {
        self.at = Some(to);
        self.points += 1;
        if self.points >= MOST_POINTS {
            self.cut();
        }
    }

    fn cut(&mut self) {
        self.at = None;
        self.points = 0;
        if !self.text.is_empty() {
            self.finished.push(std::mem::take(&mut self.text));
        }
    }

    /// Writes a command unless it is already in force.
    fn say(&mut self, command: char) {
        if self.command != command || self.text.is_empty() {
            self.text.push(command);
            self.command = command;
        }
    }

    /// Writes a number of hundredths, parted from what stands before it if needed.
    fn number(&mut self, value: i64) {
        let after_command = self.text.ends_with(|last: char| last.is_ascii_alphabetic());
        if value < 0 {
            self.text.push('-');
        } else if !after_command {
            self.text.push(' ');
        }
        let (whole, rest) = (value.unsigned_abs() / 100, value.unsigned_abs() % 100);
        if whole > 0 || rest == 0 {
            push_digits(&mut self.text, whole);
        }
        if rest > 0 {
            self.text.push('.');
            self.text.push(char::from(b'0' + (rest / 10) as u8));
            if rest % 10 > 0 {
                self.text.push(char::from(b'0' + (rest % 10) as u8));
            }
        }
    }
}

fn parts(value: f64) -> i64 {
    (value * PARTS).round() as i64
}

fn push_digits(text: &mut String, value: u64) {
    if value >= 10 {
        push_digits(text, value / 10);
    }
    text.push(char::from(b'0' + (value % 10) as u8));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(draw: impl FnOnce(&mut PathData)) -> String {
        let mut path = PathData::default();
        draw(&mut path);
        path.finish().join("|")
    }

    #[test]
    fn a_chain_is_one_move_and_relative_lines() {
        let text = drawn(|path| {
            path.line([10.0, 20.0], [12.5, 19.0]);
            path.line([12.5, 19.0], [12.5, 19.05]);
            path.line([0.0, -1.0], [3.0, 0.0]);
        });
        assert_eq!(text, "M10 20l2.5-1 0 .05M0-1l3 1");
    }

    #[test]
    fn what_is_finer_than_a_hundredth_draws_nothing() {
        assert_eq!(drawn(|path| path.line([1.0, 1.0], [1.004, 1.0])), "");
        // A slow creep is not lost: the end is compared with where the pen is.
        let creep = drawn(|path| {
            for step in 0..1000 {
                path.line([f64::from(step) * 0.004, 0.0], [f64::from(step + 1) * 0.004, 0.0]);
            }
        });
        assert!(creep.starts_with("M0 0l.01 0"), "{creep}");
    }

    #[test]
    fn a_long_path_is_cut_and_each_part_begins_with_a_move() {
        let mut path = PathData::default();
        for step in 0..9_000 {
            path.line([f64::from(step), 0.0], [f64::from(step + 1), 1.0 - f64::from(step % 2)]);
        }
        let finished = path.finish();
        assert!(finished.len() >= 3 && finished.iter().all(|part| part.starts_with('M')));
    }

    #[test]
    fn a_quarter_of_an_ellipse() {
        let text = drawn(|path| path.ellipse([0.0, 5.0], [20.0, 0.0], [20.0, 5.0], true));
        assert_eq!(text, "M0 5a20 5 0 0 1 20-5");
    }
}
