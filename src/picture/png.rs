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

static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    Arc::new(fonts)
});

pub(super) fn png_of(svg: &str, zoom: f32) -> Result<Vec<u8>, PngError> {
    let options = usvg::Options {
        fontdb: FONTS.clone(),
        font_family: "DejaVu Sans".into(),
        ..usvg::Options::default()
    };
    let refused = |reason: String| PngError::Drawing { reason };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|e| refused(e.to_string()))?;
    let pixels = |length: f32| (length * zoom).ceil() as u32; // saturates; NaN is 0
    let (width, height) = (pixels(tree.size().width()), pixels(tree.size().height()));
    let fits = |side: u32| (1..=MAX_SIDE).contains(&side);
    let map = if fits(width) && fits(height) {
        tiny_skia::Pixmap::new(width, height)
    } else {
        None
    };
    let mut map = map.ok_or(PngError::Size { width, height })?;
    resvg::render(
        &tree,
        tiny_skia::Transform::from_scale(zoom, zoom),
        &mut map.as_mut(),
    );
    map.encode_png().map_err(|e| refused(e.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"20\" \
                        font-family=\"Verdana, sans-serif\">";

    fn dark(svg: &str) -> usize {
        let png = png_of(svg, 2.0).unwrap();
        let map = tiny_skia::Pixmap::decode_png(&png).unwrap();
        assert_eq!((map.width(), map.height()), (120, 40));
        map.pixels().iter().filter(|p| p.alpha() > 128).count()
    }

    /// Text appears, Greek and superscripts too, whatever fonts the machine has.
    #[test]
    fn text_appears() {
        assert_eq!(dark(&format!("{HEAD}</svg>")), 0);
        for text in ["mu = 1.7", "\u{3bb}\u{b2} \u{3bc}", "10\u{207b}\u{2075}"] {
            let drawn = dark(&format!("{HEAD}<text x=\"2\" y=\"14\">{text}</text></svg>"));
            assert!(drawn > 50, "{text}: {drawn} pixels");
        }
    }

    #[test]
    fn sizes_that_cannot_be_are_refused() {
        let svg = format!("{HEAD}</svg>");
        for zoom in [0.0, -1.0, f32::NAN, 1e9] {
            assert!(
                matches!(png_of(&svg, zoom), Err(PngError::Size { .. })),
                "{zoom}"
            );
        }
        assert!(matches!(png_of("<svg", 1.0), Err(PngError::Drawing { .. })));
    }
}
