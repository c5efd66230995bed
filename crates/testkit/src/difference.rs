//! Two texts compared line by line.

/// Equal lines shown before and after a difference.
const CONTEXT: usize = 2;

/// Beyond so many pairs of lines the texts are not aligned: everything from the first difference on is shown.
const MOST_PAIRS: usize = 4_000_000;

/// What a line of the comparison is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mark {
    Both,
    Left,
    Right,
}

/// The lines in which two texts differ, `-` before those of the first and `+` before those of the second, with a little
/// of what surrounds them; `None` if the texts are equal to the byte.
pub fn difference(left: &str, right: &str) -> Option<String> {
    if left == right {
        return None;
    }
    let left: Vec<&str> = left.split_inclusive('\n').collect();
    let right: Vec<&str> = right.split_inclusive('\n').collect();
    let marked = align(&left, &right);
    let near = |index: usize| {
        let from = index.saturating_sub(CONTEXT);
        let to = (index + CONTEXT + 1).min(marked.len());
        marked[from..to].iter().any(|(mark, _)| *mark != Mark::Both)
    };
    let mut text = String::new();
    let mut skipping = false;
    for (index, (mark, line)) in marked.iter().enumerate() {
        if !near(index) {
            if !skipping {
                text.push_str("  …\n");
            }
            skipping = true;
            continue;
        }
        skipping = false;
        text.push_str(match mark {
            Mark::Both => "  ",
            Mark::Left => "- ",
            Mark::Right => "+ ",
        });
        text.push_str(&shown(line));
        text.push('\n');
    }
    Some(text)
}

/// A line as it can be read: control characters by their code, a missing line end by name.
fn shown(line: &str) -> String {
    let mut text = String::new();
    for character in line.strip_suffix('\n').unwrap_or(line).chars() {
        match character {
            '\t' => text.push(character),
            c if c.is_control() => text.push_str(&format!("\\x{:02x}", u32::from(c))),
            c => text.push(c),
        }
    }
    if !line.ends_with('\n') {
        text.push_str("  (no line end)");
    }
    text
}

/// Both texts in one list, with as many lines in common as can be.
fn align<'t>(left: &[&'t str], right: &[&'t str]) -> Vec<(Mark, &'t str)> {
    let head = left.iter().zip(right).take_while(|(a, b)| a == b).count();
    let mut marked: Vec<(Mark, &str)> = left[..head].iter().map(|line| (Mark::Both, *line)).collect();
    let (left, right) = (&left[head..], &right[head..]);
    if left.len().saturating_mul(right.len()) > MOST_PAIRS {
        marked.extend(left.iter().map(|line| (Mark::Left, *line)));
        marked.extend(right.iter().map(|line| (Mark::Right, *line)));
        return marked;
    }
    // common[i][j]: how many lines left[i..] and right[j..] have in common, in order.
    let mut common = vec![vec![0usize; right.len() + 1]; left.len() + 1];
    for i in (0..left.len()).rev() {
        for j in (0..right.len()).rev() {
            common[i][j] =
                if left[i] == right[j] { common[i + 1][j + 1] + 1 } else { common[i + 1][j].max(common[i][j + 1]) };
        }
    }
    let (mut i, mut j) = (0, 0);
    while i < left.len() || j < right.len() {
        if i < left.len() && j < right.len() && left[i] == right[j] {
            marked.push((Mark::Both, left[i]));
            i += 1;
            j += 1;
        } else if i < left.len() && (j == right.len() || common[i + 1][j] >= common[i][j + 1]) {
            marked.push((Mark::Left, left[i]));
            i += 1;
        } else {
            marked.push((Mark::Right, right[j]));
            j += 1;
        }
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_texts_do_not_differ() {
        assert_eq!(difference("a\nb\n", "a\nb\n"), None);
        assert_eq!(difference("", ""), None);
    }

    #[test]
    fn a_changed_line_stands_among_its_neighbours() {
        let (left, right) = ("1\n2\n3\n4\nx\n6\n7\n8\n", "1\n2\n3\n4\n5\n6\n7\n8\n");
        assert_eq!(difference(left, right).as_deref(), Some("  …\n  3\n  4\n- x\n+ 5\n  6\n  7\n  …\n"));
    }

    #[test]
    fn a_missing_line_and_a_missing_line_end_are_differences() {
        assert_eq!(difference("a\n", "").as_deref(), Some("- a\n"));
        assert_eq!(difference("a\n", "a").as_deref(), Some("- a\n+ a  (no line end)\n"));
        assert_eq!(difference("a\n", "a\r\n").as_deref(), Some("- a\n+ a\\x0d\n"));
    }
}
