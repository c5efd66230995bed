//! Text on the sheet: how wide it is, how it is shortened, how it is escaped.

/// The advances of the characters from space to tilde in DejaVu Sans, in parts of 2048 of the size.
const ADVANCES: [u16; 95] = [
    651, 821, 942, 1716, 1303, 1946, 1597, 563, 799, 799, 1024, 1716, 651, 739, 651, 690, 1303, 1303, 1303, 1303, 1303,
    1303, 1303, 1303, 1303, 1303, 690, 690, 1716, 1716, 1716, 1087, 2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587,
    1540, 604, 604, 1343, 1141, 1767, 1532, 1612, 1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403,
    799, 690, 799, 1716, 1024, 1024, 1255, 1300, 1126, 1300, 1260, 721, 1300, 1298, 569, 569, 1186, 569, 1995, 1298,
    1253, 1300, 1300, 842, 1067, 803, 1298, 1212, 1675, 1212, 1212, 1075, 1303, 690, 1303, 1716,
];

/// The advance of any other character: that of the widest common ones.
const OTHER_ADVANCE: u16 = 2048;

/// The width of a text set in DejaVu Sans, in the unit of the size.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let advance = |character: char| match character {
        '\u{2212}' => 1716,
        '\u{a0}' | '\u{b7}' => 651,
        _ => (character as usize).checked_sub(32).and_then(|at| ADVANCES.get(at)).copied().unwrap_or(OTHER_ADVANCE),
    };
    text.chars().map(|character| f64::from(advance(character))).sum::<f64>() * size / 2048.0
}

/// The text, or as much of its beginning as fits with an ellipsis.
pub(crate) fn shortened(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut short = String::new();
    for character in text.chars() {
        short.push(character);
        if width(&short, size) + size > room {
            short.pop();
            break;
        }
    }
    short.truncate(short.trim_end().len());
    short.push('\u{2026}');
    short
}

/// The text as XML character data: markup escaped, what XML forbids replaced, spaces in a row kept.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            ' ' if out.ends_with([' ', '\u{a0}']) => out.push('\u{a0}'),
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' | '\r' => out.push(' '),
            control if control < ' ' || matches!(control, '\u{7f}'..='\u{9f}' | '\u{fffe}' | '\u{ffff}') => {
                out.push('\u{fffd}');
            }
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_and_control_characters_do_not_get_through() {
        assert_eq!(escaped("a<b>&\"c'\u{0}\u{1b}\n"), "a&lt;b&gt;&amp;&quot;c&#39;\u{fffd}\u{fffd} ");
        assert_eq!(escaped("a   b"), "a \u{a0}\u{a0}b");
        assert_eq!(escaped("Ø 12 × 30°"), "Ø 12 × 30°");
    }

    #[test]
    fn a_long_text_is_cut_to_its_room() {
        let long = "a program name that goes on and on";
        let short = shortened(long, 10.0, 100.0);
        assert!(short.ends_with('\u{2026}') && width(&short, 10.0) <= 100.0 && width(&short, 10.0) > 80.0, "{short}");
        assert_eq!(shortened("short", 10.0, 100.0), "short");
    }

    /// The table is that of the font which sets the text.
    #[test]
    fn the_advances_are_those_of_the_embedded_font() {
        let all: String = (' '..='~').collect();
        let svg = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='9999' height='99'><text x='0' y='50' font-size='20' \
             font-family='DejaVu Sans' xml:space='preserve' text-rendering='geometricPrecision' \
             style='font-kerning:none'>|{}|</text></svg>",
            escaped(&all)
        );
        let tree = crate::png::tree(&svg).expect("the test's own picture is well-formed");
        let drawn = f64::from(tree.root().abs_bounding_box().width());
        let expected = width(&all, 20.0) + 2.0 * width("|", 20.0);
        assert!((drawn - expected).abs() < 0.02 * expected, "{drawn} drawn, {expected} in the table");
    }
}
