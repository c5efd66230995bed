//! Two streams laid side by side, so that what one has too much or too little does not part everything behind it.
//!
//! Where the two differ, up to `window` items of each are looked through for the nearest place from which on they agree
//! again: after one changed item in both, or by leaving out some of either. What lies before that place differs. If
//! there is none, the two items at the head count as one that has changed, and half a window is taken like that before
//! the next search, so that two streams that have nothing in common cost little too.

use std::collections::VecDeque;

/// So many items must agree in a row before one of the streams is taken to have too much or too little.
const SURE: usize = 3;

/// One step along both streams.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Pair<T> {
    /// Both have it.
    Same(T, T),
    /// The second has another in its place.
    Changed(T, T),
    /// Only the first has it.
    First(T),
    /// Only the second has it.
    Second(T),
}

/// The streams, as far as they are held.
pub struct Alignment<T> {
    window: usize,
    waiting: [VecDeque<T>; 2],
    ended: [bool; 2],
    /// So many items of each are known to differ.
    apart: [usize; 2],
    /// So many changed pairs are taken before there is another search.
    blind: usize,
}

impl<T: Copy> Alignment<T> {
    /// Nothing read yet; at most `window` items of each stream are held.
    pub fn new(window: usize) -> Alignment<T> {
        let waiting = || VecDeque::with_capacity(window.clamp(1, 1 << 16));
        Alignment { window: window.max(1), waiting: [waiting(), waiting()], ended: [false; 2], apart: [0; 2], blind: 0 }
    }

    /// The item of a stream before which the last step stands; known while the other stream has one too much.
    pub fn head(&self, side: usize) -> Option<T> {
        self.waiting.get(side)?.front().copied()
    }

    /// The next step; `None` at the end of both. `pull` gives the items of the stream with this index.
    ///
    /// # Errors
    /// A stream cannot be read.
    pub fn next<E>(
        &mut self,
        mut pull: impl FnMut(usize) -> Result<Option<T>, E>,
        same: impl Fn(&T, &T) -> bool,
    ) -> Result<Option<Pair<T>>, E> {
        self.fill(1, &mut pull)?;
        if self.apart == [0; 2]
            && let (Some(a), Some(b)) = (self.head(0), self.head(1))
        {
            if same(&a, &b) {
                self.blind = 0;
                return Ok(self.both().map(|(a, b)| Pair::Same(a, b)));
            }
            if self.blind == 0 {
                self.fill(self.window, &mut pull)?;
                self.apart = self.meet(&same).unwrap_or_default();
            }
            if self.apart == [0; 2] {
                // Nothing in sight: another pair, and no search for a while.
                self.blind = if self.blind == 0 { self.window / 2 } else { self.blind - 1 };
                return Ok(self.both().map(|(a, b)| Pair::Changed(a, b)));
            }
        }
        let [first, second] = self.apart;
        self.apart = [first.saturating_sub(1), second.saturating_sub(1)];
        Ok(match (first, second) {
            (1.., 1..) => self.both().map(|(a, b)| Pair::Changed(a, b)),
            (1.., 0) => self.waiting[0].pop_front().map(Pair::First),
            (0, 1..) => self.waiting[1].pop_front().map(Pair::Second),
            // One of the streams has ended, or both.
            (0, 0) => {
                let [a, b] = &mut self.waiting;
                a.pop_front().map(Pair::First).or_else(|| b.pop_front().map(Pair::Second))
            }
        })
    }

    fn both(&mut self) -> Option<(T, T)> {
        let [a, b] = &mut self.waiting;
        a.pop_front().zip(b.pop_front())
    }

    fn fill<E>(&mut self, count: usize, pull: &mut impl FnMut(usize) -> Result<Option<T>, E>) -> Result<(), E> {
        for side in [0, 1] {
            while self.waiting[side].len() < count && !self.ended[side] {
                match pull(side)? {
                    Some(item) => self.waiting[side].push_back(item),
                    None => self.ended[side] = true,
                }
            }
        }
        Ok(())
    }

    /// How many items of each must be left out for the streams to agree again; the fewest first.
    fn meet(&self, same: &impl Fn(&T, &T) -> bool) -> Option<[usize; 2]> {
        let [a, b] = [self.waiting[0].len(), self.waiting[1].len()];
        for left_out in 1..=a + b {
            // As many of one as of the other is the likeliest, for then nothing has shifted; then one more, one less …
            for step in 0..=left_out + 1 {
                let (middle, aside) = (left_out / 2, step.div_ceil(2));
                let first = if step % 2 == 1 { middle + aside } else { middle.wrapping_sub(aside) };
                let second = left_out.wrapping_sub(first);
                if first < a && second < b && self.agree([first, second], same) {
                    return Some([first, second]);
                }
            }
        }
        None
    }

    /// The streams agree from here on: at once where nothing has shifted, for a while where something has.
    fn agree(&self, at: [usize; 2], same: &impl Fn(&T, &T) -> bool) -> bool {
        let items = |run: usize| (self.waiting[0].get(at[0] + run), self.waiting[1].get(at[1] + run));
        let needed = if at[0] == at[1] { 1 } else { SURE };
        (0..needed).all(|run| match items(run) {
            (Some(a), Some(b)) => same(a, b),
            // Behind the end of either there is nothing to compare; that some agreed before it is enough.
            _ => run > 0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps as `=`, `~` changed, `<` only the first, `>` only the second; and the most items held.
    fn steps(a: &[u32], b: &[u32], window: usize) -> String {
        let mut alignment = Alignment::new(window);
        let mut at = [0; 2];
        let mut out = String::new();
        loop {
            let pull = |side: usize| {
                let list = [a, b][side];
                at[side] += 1;
                Ok::<_, ()>(list.get(at[side] - 1).copied())
            };
            match alignment.next(pull, |a, b| a == b).expect("lists can be read") {
                None => return out,
                Some(Pair::Same(..)) => out.push('='),
                Some(Pair::Changed(..)) => out.push('~'),
                Some(Pair::First(_)) => out.push('<'),
                Some(Pair::Second(_)) => out.push('>'),
            }
            assert!(alignment.waiting.iter().all(|held| held.len() <= window));
        }
    }

    #[test]
    fn what_is_missing_or_too_much_parts_nothing_behind_it() {
        assert_eq!(steps(&[1, 2, 3, 4, 5], &[1, 2, 3, 4, 5], 8), "=====");
        assert_eq!(steps(&[1, 2, 3, 4, 5], &[1, 3, 4, 5], 8), "=<===");
        assert_eq!(steps(&[1, 3, 4, 5], &[1, 2, 3, 4, 5], 8), "=>===");
        assert_eq!(steps(&[1, 2, 3, 4, 5], &[1, 9, 3, 4, 5], 8), "=~===");
        assert_eq!(steps(&[1, 2, 3, 4, 5], &[1, 9, 8, 3, 4, 5], 8), "=~>===");
        assert_eq!(steps(&[1, 2, 3], &[1, 2], 8), "==<");
        assert_eq!(steps(&[], &[1, 2], 8), ">>");
        assert_eq!(steps(&[], &[], 8), "");
    }

    #[test]
    fn the_last_may_be_missing_or_changed() {
        assert_eq!(steps(&[1, 2, 9], &[1, 9], 8), "=<=");
        assert_eq!(steps(&[1, 2, 8, 9], &[1, 8, 9], 8), "=<==");
        assert_eq!(steps(&[1, 2], &[1, 3], 8), "=~");
    }

    #[test]
    fn what_has_nothing_in_common_is_taken_pair_by_pair() {
        let a: Vec<u32> = (0..1000).collect();
        let b: Vec<u32> = (2000..3000).collect();
        assert_eq!(steps(&a, &b, 8), "~".repeat(1000));
    }

    #[test]
    fn a_place_beyond_the_window_is_not_found() {
        let a = [1, 11, 12, 13, 14, 15, 16, 2, 3, 4];
        assert_eq!(steps(&a, &[1, 2, 3, 4], 10), "=<<<<<<===");
        assert_eq!(steps(&a, &[1, 2, 3, 4], 4), "=~~~<<<<<<");
    }
}
