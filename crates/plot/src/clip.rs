//! The part of a straight line that lies in a rectangle.

use crate::rect::Rect;

/// What is left of a line.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Clipped {
    pub from: [f64; 2],
    pub to: [f64; 2],
    /// True if the line leaves the rectangle: its end was cut off.
    pub leaves: bool,
    /// True if the line enters the rectangle: its start was cut off.
    pub enters: bool,
}

/// The part of the line inside the rectangle; `None` if there is none. (Liang and Barsky's rule.)
pub(crate) fn clip(rect: &Rect, from: [f64; 2], to: [f64; 2]) -> Option<Clipped> {
    if rect.contains(from) && rect.contains(to) {
        return Some(Clipped { from, to, leaves: false, enters: false });
    }
    let along = [to[0] - from[0], to[1] - from[1]];
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    let sides = [
        (-along[0], from[0] - rect.x),
        (along[0], rect.right() - from[0]),
        (-along[1], from[1] - rect.y),
        (along[1], rect.bottom() - from[1]),
    ];
    for (outwards, room) in sides {
        if outwards == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if outwards < 0.0 {
            first = first.max(room / outwards);
        } else {
            last = last.min(room / outwards);
        }
    }
    if first > last {
        return None;
    }
    let at = |part: f64| {
        [
            (from[0] + part * along[0]).clamp(rect.x, rect.right()),
            (from[1] + part * along[1]).clamp(rect.y, rect.bottom()),
        ]
    };
    let (enters, leaves) = (first > 0.0, last < 1.0);
    Some(Clipped {
        from: if enters { at(first) } else { from },
        to: if leaves { at(last) } else { to },
        leaves,
        enters,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECT: Rect = Rect { x: 0.0, y: 0.0, width: 10.0, height: 5.0 };

    #[test]
    fn a_line_that_leaves_ends_on_the_side() {
        let part = clip(&RECT, [5.0, 2.0], [25.0, 2.0]);
        assert_eq!(part, Some(Clipped { from: [5.0, 2.0], to: [10.0, 2.0], leaves: true, enters: false }));
        let through = clip(&RECT, [-10.0, 1.0], [20.0, 4.0]);
        assert!(
            through.is_some_and(|part| part.leaves && part.enters && part.from == [0.0, 2.0] && part.to == [10.0, 3.0])
        );
    }

    #[test]
    fn a_line_outside_is_nothing_and_one_inside_is_itself() {
        assert_eq!(clip(&RECT, [-1.0, 6.0], [20.0, 6.0]), None);
        assert_eq!(clip(&RECT, [-2.0, 2.0], [3.0, -8.0]), None);
        assert_eq!(clip(&RECT, [20.0, 1.0], [20.0, 1.0]), None);
        assert!(clip(&RECT, [1.0, 1.0], [9.0, 4.0]).is_some_and(|part| !part.leaves && !part.enters));
    }
}
