//! Colours: the ink of the sheet and the ordered scale of the feeds.
//!
//! The scale is the dark four fifths of viridis (Smith and van der Walt, public domain): perceptually uniform, ordered in
//! lightness and so readable in grey, and safe for colour-blind readers. Its light end would vanish on white paper.

/// A colour in sRGB.
pub(crate) type Rgb = [u8; 3];

/// Text and strong lines.
pub(crate) const INK: &str = "#1b2129";
/// Text of second rank.
pub(crate) const SOFT_INK: &str = "#56606b";
/// Axes and panel borders.
pub(crate) const AXIS: &str = "#8b949e";
/// The grid.
pub(crate) const GRID: &str = "#e2e6ea";
/// Rapid moves.
pub(crate) const RAPID: &str = "#8a95a1";
/// The programmed contour.
pub(crate) const CONTOUR: &str = INK;
/// The path that the axes drive.
pub(crate) const DRIVEN: &str = "#e0700a";
/// The tool, and the area that it sweeps.
pub(crate) const TOOL: &str = "#c07f10";
pub(crate) const SWEPT: &str = "#fcf0d6";
/// Alarms, the only red on the sheet.
pub(crate) const ALARM: &str = "#c2121f";
/// The paper.
pub(crate) const PAPER: &str = "#ffffff";

/// Viridis from its dark end to where it is still dark enough for white paper, at equal distances.
const SCALE: [Rgb; 9] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x25, 0x76],
    [0x41, 0x44, 0x87],
    [0x35, 0x60, 0x8d],
    [0x2a, 0x78, 0x8e],
    [0x21, 0x90, 0x8d],
    [0x22, 0xa8, 0x84],
    [0x42, 0xbe, 0x71],
    [0x7a, 0xd1, 0x51],
];

/// Where a single feed lies on the scale.
const ALONE: f64 = 0.36;

/// The colour at a place of the scale: 0 the slowest feed, dark; 1 the fastest, light.
pub(crate) fn on_scale(place: f64) -> Rgb {
    let at = place.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let below = (at.floor() as usize).min(SCALE.len() - 2);
    let part = at - below as f64;
    std::array::from_fn(|channel| {
        let [low, high] = [below, below + 1].map(|stop| f64::from(SCALE[stop][channel]));
        (low + (high - low) * part).round() as u8
    })
}

/// The colour of one of a few feeds.
pub(crate) fn of_few(index: usize, count: usize) -> Rgb {
    on_scale(if count < 2 { ALONE } else { index as f64 / (count - 1) as f64 })
}

/// A colour as SVG writes it.
pub(crate) fn hex([red, green, blue]: Rgb) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance, as the eye and a grey printer see it.
    fn luminance(colour: Rgb) -> f64 {
        let linear = colour.map(|channel| (f64::from(channel) / 255.0).powf(2.2));
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    #[test]
    fn faster_is_always_lighter_and_never_pale() {
        let shades: Vec<f64> = (0..=100).map(|part| luminance(on_scale(f64::from(part) / 100.0))).collect();
        assert!(shades.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(shades[100] < 0.55, "the fastest feed is still seen on white");
    }

    #[test]
    fn few_feeds_take_the_whole_scale() {
        assert_eq!(of_few(0, 3), SCALE[0]);
        assert_eq!(of_few(2, 3), SCALE[8]);
        assert_eq!(of_few(0, 1), on_scale(ALONE));
        assert_eq!(hex([0, 255, 16]), "#00ff10");
    }
}
