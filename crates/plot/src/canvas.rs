//! The SVG text as it grows: lines, rectangles, text, groups. Everything written goes through here, escaped.

use std::fmt::Write as _;

use crate::colour::PAPER;
use crate::label::{Anchor, Label};
use crate::rect::Rect;
use crate::text::escaped;

/// The font of all text; the same is embedded for PNG.
const FONT: &str = "'DejaVu Sans', sans-serif";

/// An SVG document being written.
pub(crate) struct Canvas {
    out: String,
    /// The rectangles to which something has been clipped; each has its number as its name.
    clips: Vec<Rect>,
}

impl Canvas {
    /// A sheet of paper, its size in sheet units.
    pub fn new(width: f64, height: f64) -> Canvas {
        let mut out = String::new();
        let _ = writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}\" fill=\"none\">"
        );
        Canvas { out, clips: Vec::new() }
    }

    /// The finished document.
    pub fn finish(mut self) -> String {
        self.out.push_str("</svg>\n");
        self.out
    }

    /// The document's title, which viewers and screen readers show.
    pub fn title(&mut self, title: &str) {
        let _ = writeln!(self.out, "<title>{}</title>", escaped(title));
    }

    /// Begins a group with these attributes.
    pub fn open(&mut self, attributes: &str) {
        let _ = writeln!(self.out, "<g {attributes}>");
    }

    /// Begins a group with these attributes of which nothing is seen outside a rectangle.
    pub fn open_clipped(&mut self, to: &Rect, attributes: &str) {
        let known = self.clips.iter().position(|clip| clip == to);
        let number = known.unwrap_or(self.clips.len());
        if known.is_none() {
            self.clips.push(*to);
            self.out.push_str(&format!("<clipPath id=\"clip{number}\">\n"));
            self.rect(to, "");
            self.out.push_str("</clipPath>\n");
        }
        self.open(&format!("clip-path=\"url(#clip{number})\" {attributes}"));
    }

    /// Ends the group.
    pub fn close(&mut self) {
        self.out.push_str("</g>\n");
    }

    /// A path, with further attributes or none.
    pub fn path(&mut self, d: &str, attributes: &str) {
        let space = if attributes.is_empty() { "" } else { " " };
        let _ = writeln!(self.out, "<path d=\"{d}\"{space}{attributes}/>");
    }

    /// A straight line in the group's stroke.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2]) {
        let d = format!("M{} {}L{} {}", short(from[0]), short(from[1]), short(to[0]), short(to[1]));
        self.path(&d, "");
    }

    /// A rectangle with these attributes.
    pub fn rect(&mut self, rect: &Rect, attributes: &str) {
        let [x, y, width, height] = [rect.x, rect.y, rect.width, rect.height].map(short);
        let _ = writeln!(self.out, "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {attributes}/>");
    }

    /// A circle in the group's stroke and fill.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64) {
        let _ = writeln!(self.out, "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>", short(x), short(y), short(radius));
    }

    /// A text in one colour on a patch of paper that keeps it readable over lines.
    pub fn text_over_lines(&mut self, label: &Label, colour: &str) {
        self.rect(&label.room().grown(2.0), &format!("rx=\"2\" fill=\"{PAPER}\" fill-opacity=\"0.85\""));
        self.text(label, colour);
    }

    /// A text in one colour.
    pub fn text(&mut self, label: &Label, colour: &str) {
        let anchor = match label.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let ([x, y], size) = (label.at.map(short), short(label.size));
        let _ = writeln!(
            self.out,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{colour}\"{anchor}>{}</text>",
            escaped(&label.text)
        );
    }
}

/// A number with two decimals, without those that are zero.
pub(crate) fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}
