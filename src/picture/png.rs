//! The same drawing in pixels. The font is built in, so that the result does not depend on what is
//! installed: DejaVu Sans, free to embed (its licence: `dejavu` crate, Bitstream Vera terms).

use resvg::{tiny_skia, usvg};
use std::sync::{Arc, LazyLock};

/// Why there is no PNG.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PngError {
    /// The drawing was not understood: a defect of this library.
    #[error("PNG: the drawing was refused: {reason}")]
    Drawing {
        /// What the renderer says.
        reason: String,
    },
    /// Too many pixels, or none.
    #[error("PNG: expected 1 to {MAX_SIDE} pixels a side, got {width} x {height}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
}

/// Longest side of a PNG.
const MAX_SIDE: u32 = 20_000;

/// The only font of the renderer.
static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

/// Draws an SVG with `zoom` pixels for each px.
///
/// # Errors
/// [`PngError::Size`] where a side has no pixels or more than [`MAX_SIDE`]; [`PngError::Drawing`]
/// where the renderer refuses the SVG.
pub(super) fn png_of(svg: &str, zoom: f32) -> Result<Vec<u8>, PngError> {
    let options = usvg::Options {
        fontdb: FONTS.clone(),
        font_family: "DejaVu Sans".into(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options).map_err(refused)?;

    let width = pixels(tree.size().width(), zoom);
    let height = pixels(tree.size().height(), zoom);
    let sides = 1..=MAX_SIDE;
    let fits = sides.contains(&width) && sides.contains(&height);
    let map = if fits {
        tiny_skia::Pixmap::new(width, height)
    } else {
        None
    };

    let mut map = map.ok_or(PngError::Size { width, height })?;

    let transform = tiny_skia::Transform::from_scale(zoom, zoom);
    resvg::render(&tree, transform, &mut map.as_mut());
    map.encode_png().map_err(refused)
}

/// Pixels for a length in px: at most the largest number, and 0 for NaN.
fn pixels(length: f32, zoom: f32) -> u32 {
    (length * zoom).ceil() as u32
}

fn refused(error: impl std::fmt::Display) -> PngError {
    PngError::Drawing {
        reason: error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"20\" \
                        font-family=\"Verdana, sans-serif\">";

    /// The number of dark pixels of a drawing of 60 x 20 px, drawn twice as large.
    fn dark_pixels(svg: &str) -> usize {
        let png = png_of(svg, 2.0).unwrap();
        let map = tiny_skia::Pixmap::decode_png(&png).unwrap();
        assert_eq!((map.width(), map.height()), (120, 40));

        map.pixels().iter().filter(|p| p.alpha() > 128).count()
    }

    /// Text appears, Greek and superscripts too, whatever fonts the machine has.
    #[test]
    fn text_appears() {
        assert_eq!(dark_pixels(&format!("{HEAD}</svg>")), 0);

        for text in ["mu = 1.7", "\u{3bb}\u{b2} \u{3bc}", "10\u{207b}\u{2075}"] {
            let drawn = dark_pixels(&format!("{HEAD}<text x=\"2\" y=\"14\">{text}</text></svg>"));
            assert!(drawn > 50, "{text}: {drawn} pixels");
        }
    }

    #[test]
    fn sizes_that_cannot_be_are_refused() {
        let svg = format!("{HEAD}</svg>");
        for zoom in [0.0, -1.0, f32::NAN, 1e9] {
            let refused = png_of(&svg, zoom);
            assert!(matches!(refused, Err(PngError::Size { .. })), "{zoom}");
        }

        let broken = png_of("<svg", 1.0);
        assert!(matches!(broken, Err(PngError::Drawing { .. })));
    }
}
