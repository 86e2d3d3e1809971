//! A drawing with its title and size, as SVG, as a part of an HTML page, or as PNG.

use super::markup::Element;
#[cfg(feature = "png")]
use super::png::{PngError, png_of};
use super::{chart, markup};

/// A drawing with its title; what it is drawn on is `width` x `height` px.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    title: String,
    width: f64,
    height: f64,
    content: Vec<Element>,
}

/// First the font that the PNG is drawn with; the same shapes are at hand nearly everywhere.
const FONTS: &str = "DejaVu Sans, Verdana, Arial, sans-serif";

impl Picture {
    /// An empty picture; width and height in px.
    pub(super) fn new(title: impl Into<String>, width: f64, height: f64) -> Picture {
        Picture {
            title: title.into(),
            width,
            height,
            content: Vec::new(),
        }
    }

    /// Draws an element over those before it.
    pub(super) fn push(&mut self, element: Element) {
        self.content.push(element);
    }

    /// Writes the title in bold, from (x, y) on.
    pub(super) fn push_heading(&mut self, x: f64, y: f64) {
        let heading = chart::text(x, y, "start", self.title.as_str());
        self.push(heading.with("font-weight", "bold"));
    }

    /// What it shows, in one line.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Width and height, px.
    pub fn size(&self) -> (f64, f64) {
        (self.width, self.height)
    }

    /// A file of its own.
    pub fn to_svg(&self) -> String {
        format!("{}\n", self.element(Some("http://www.w3.org/2000/svg")))
    }

    /// The same as a part of an HTML page, which needs no name space.
    pub fn inline(&self) -> Element {
        self.element(None)
    }

    /// The drawing as PNG, `zoom` pixels for each px of the SVG.
    ///
    /// # Errors
    /// [`PngError`]: a size that cannot be.
    #[cfg(feature = "png")]
    pub fn to_png(&self, zoom: f32) -> Result<Vec<u8>, PngError> {
        png_of(&self.to_svg(), zoom)
    }

    /// The root element, with the name space where it stands alone.
    fn element(&self, name_space: Option<&str>) -> Element {
        let mut root = Element::new("svg");
        if let Some(name) = name_space {
            root = root.with("xmlns", name);
        }

        let width = markup::short(self.width);
        let height = markup::short(self.height);
        root = root
            .at("width", self.width)
            .at("height", self.height)
            .with("viewBox", format!("0 0 {width} {height}"))
            .with("role", "img")
            .with("font-family", FONTS)
            .at("font-size", chart::TEXT);

        let title = Element::new("title").text(self.title.as_str());
        let paper = Element::new("rect")
            .at("width", self.width)
            .at("height", self.height)
            .with("fill", "#fff");

        root.child(title)
            .child(paper)
            .children(self.content.iter().cloned())
    }
}
