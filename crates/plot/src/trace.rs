//! Values over time in bounded memory: of a long time, what a picture of it can show.

/// So many points, and so many spans, are kept at most; twice as many make room.
const MOST: usize = 16_384;

/// A long time is parted into so many cells. No picture has as many columns.
const CELLS: f64 = 4_096.0;

/// A value that is this near to a straight line of its neighbours lies on it, as a part of the greatest.
const ON_THE_LINE: f64 = 1e-6;

/// A value that changes steadily between points.
#[derive(Clone, Debug)]
pub(crate) struct Trace {
    points: Vec<[f64; 2]>,
    pub lowest: f64,
    pub highest: f64,
    /// Points have been left out.
    pub is_thinned: bool,
}

impl Trace {
    /// Nothing.
    pub fn new() -> Trace {
        Trace { points: Vec::new(), lowest: 0.0, highest: 0.0, is_thinned: false }
    }

    /// The points: time, value.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The time of the last point.
    pub fn end(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point[0])
    }

    /// The value at a time, which is not before the last one.
    pub fn push(&mut self, time: f64, value: f64) {
        if !(time.is_finite() && value.is_finite()) || time < self.end() {
            return;
        }
        self.lowest = self.lowest.min(value);
        self.highest = self.highest.max(value);
        if let [.., before, last] = self.points[..] {
            let (step, whole) = (last[0] - before[0], time - before[0]);
            let line = if whole > 0.0 { before[1] + (value - before[1]) * step / whole } else { f64::NAN };
            if (line - last[1]).abs() <= ON_THE_LINE * (self.highest - self.lowest) {
                self.points.pop();
            }
        }
        self.points.push([time, value]);
        if self.points.len() >= 2 * MOST {
            self.thin(self.end() / CELLS);
        }
    }

    /// Leaves of every cell of time the first point, the last, and those of the extremes.
    fn thin(&mut self, cell: f64) {
        let mut kept: Vec<[f64; 2]> = Vec::with_capacity(MOST);
        let mut rest = &self.points[..];
        while let Some(first) = rest.first() {
            let number = (first[0] / cell).floor();
            let count = rest.iter().take_while(|point| (point[0] / cell).floor() == number).count().max(1);
            let (of_cell, behind) = rest.split_at(count);
            rest = behind;
            let extreme = |better: fn(f64, f64) -> bool| {
                (0..count).reduce(|best, next| if better(of_cell[next][1], of_cell[best][1]) { next } else { best })
            };
            let mut chosen = [Some(0), extreme(|a, b| a < b), extreme(|a, b| a > b), Some(count - 1)]
                .map(|index| index.unwrap_or(0));
            chosen.sort_unstable();
            kept.extend(
                chosen
                    .iter()
                    .enumerate()
                    .filter(|(at, index)| *at == 0 || chosen[at - 1] != **index)
                    .map(|(_, index)| of_cell[*index]),
            );
        }
        self.is_thinned |= kept.len() < self.points.len();
        self.points = kept;
    }
}

/// Spans of time, each with a value.
#[derive(Clone, Debug)]
pub(crate) struct Spans<T> {
    spans: Vec<([f64; 2], T)>,
}

impl<T: Copy + PartialEq> Spans<T> {
    /// None.
    pub fn new() -> Spans<T> {
        Spans { spans: Vec::new() }
    }

    /// The end of the last one.
    pub fn end(&self) -> f64 {
        self.spans.last().map_or(0.0, |(during, _)| during[1])
    }

    /// The spans in order.
    pub fn iter(&self) -> impl Iterator<Item = ([f64; 2], T)> {
        self.spans.iter().copied()
    }

    /// A span behind the others. Of very many, short neighbours become one with the value that `both` gives.
    pub fn push(&mut self, [from, to]: [f64; 2], value: T, both: impl Fn(&T, &T) -> T) {
        if from >= to || !to.is_finite() {
            return;
        }
        match self.spans.last_mut() {
            Some((during, last)) if *last == value && from <= during[1] => during[1] = to,
            _ => self.spans.push(([from, to], value)),
        }
        if self.spans.len() >= MOST {
            let cell = to / CELLS;
            self.spans.dedup_by(|next, kept| {
                let joins = next.0[1] - kept.0[0] <= cell;
                if joins {
                    *kept = ([kept.0[0], next.0[1]], both(&kept.1, &next.1));
                }
                joins
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_two_points() {
        let mut trace = Trace::new();
        (0..100).for_each(|step| trace.push(f64::from(step), 3.0 * f64::from(step)));
        assert_eq!(trace.points(), [[0.0, 0.0], [99.0, 297.0]]);
        trace.push(99.0, 0.0);
        trace.push(120.0, 0.0);
        assert_eq!(trace.points().len(), 4, "a jump stays a jump");
    }

    #[test]
    fn a_long_time_keeps_its_extremes_in_bounded_memory() {
        let mut trace = Trace::new();
        for step in 0..2_000_000u32 {
            let value = if step == 1_234_567 { 900.0 } else { f64::from(step % 7) };
            trace.push(f64::from(step) * 0.001, value);
            assert!(trace.points().len() < 2 * MOST);
        }
        assert!(trace.is_thinned && trace.points().contains(&[1234.567, 900.0]));
        assert!(trace.points().windows(2).all(|pair| pair[0][0] <= pair[1][0]));
    }

    #[test]
    fn very_many_spans_become_fewer() {
        let mut spans = Spans::new();
        for step in 0..500_000u32 {
            spans.push([f64::from(step), f64::from(step) + 1.0], step, |first, _| *first);
        }
        let all: Vec<_> = spans.iter().collect();
        assert!(all.len() < MOST && all[0].0[0] == 0.0 && all[0].1 == 0 && spans.end() == 500_000.0);
        assert!(all.windows(2).all(|pair| pair[0].0[1] == pair[1].0[0]), "no gap");
    }
}
