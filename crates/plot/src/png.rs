//! The sheet as PNG: the SVG, drawn by resvg with the embedded font. No font, file or setting of the computer is used.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

/// The widest picture that is made, in pixels.
pub const WIDEST_PX: u32 = 16_384;

/// Why there is no PNG.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The width asked for is 0 or above [`WIDEST_PX`].
    #[error("a picture of {0} pixels width cannot be made; 1 to {WIDEST_PX} can")]
    Width(u32),
    /// The picture could not be drawn or encoded: a fault of this program.
    #[error("the picture could not be drawn: {0}")]
    Drawing(String),
}

/// The SVG as PNG bytes, as wide as asked and as high as its shape makes it.
///
/// # Errors
/// The width is 0 or above [`WIDEST_PX`], or the SVG is not one of this crate's.
pub fn png(svg: &str, width_px: u32) -> Result<Vec<u8>, PngError> {
    if width_px == 0 || width_px > WIDEST_PX {
        return Err(PngError::Width(width_px));
    }
    let tree = tree(svg)?;
    let scale = width_px as f32 / tree.size().width();
    let height_px = (tree.size().height() * scale).round().max(1.0) as u32;
    let mut pixmap =
        Pixmap::new(width_px, height_px).ok_or_else(|| PngError::Drawing("no memory for it".to_owned()))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| PngError::Drawing(error.to_string()))
}

/// The SVG read, its text laid out with the embedded font.
pub(crate) fn tree(svg: &str) -> Result<Tree, PngError> {
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_source(fontdb::Source::Binary(Arc::new(dejavu::sans::regular())));
    fonts.set_sans_serif_family("DejaVu Sans");
    Tree::from_str(svg, &options).map_err(|error| PngError::Drawing(error.to_string()))
}
