//! Pictures and reports: SVG without anything from outside, one HTML file; PNG of the same with the
//! feature `png`.
//!
//! Everything is legible in black and white: states differ in the shape of their marker, lines in
//! their dashes, regions by a number. Charts draw doubles; what is exact or certified stands in the
//! numbers beside them.
//!
//! `markup` a tree of elements, `scale` and `chart` axes, `marker` the contact states; then a file
//! for each picture: [`mode_picture`], [`path_picture`], [`threshold_picture`], [`branch_picture`],
//! [`table1_picture`], [`cost_picture`]; [`Report`] puts them into a page.

mod branch;
mod chart;
mod cost;
mod marker;
mod markup;
mod mode;
mod path;
#[cfg(feature = "png")]
mod png;
mod report;
mod scale;
mod table1;
mod threshold;

pub use branch::{BranchPoint, Branches, branch_picture};
pub use cost::{CostSeries, cost_picture};
pub use marker::Mark;
pub use markup::Element;
pub use mode::{Mode, mode_picture};
pub use path::path_picture;
#[cfg(feature = "png")]
pub use png::PngError;
pub use report::{Content, Report, Section};
pub use scale::{Scale, Spread};
pub use table1::table1_picture;
pub use threshold::{Threshold, ThresholdColumn, threshold_picture};

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
    fn new(title: impl Into<String>, width: f64, height: f64) -> Picture {
        Picture {
            title: title.into(),
            width,
            height,
            content: Vec::new(),
        }
    }

    fn push(&mut self, element: Element) {
        self.content.push(element);
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
        png::png_of(&self.to_svg(), zoom)
    }

    fn element(&self, name_space: Option<&str>) -> Element {
        let mut root = Element::new("svg");
        if let Some(name) = name_space {
            root = root.with("xmlns", name);
        }
        let view = format!(
            "0 0 {} {}",
            markup::short(self.width),
            markup::short(self.height)
        );
        root = root
            .at("width", self.width)
            .at("height", self.height)
            .with("viewBox", view)
            .with("role", "img");
        root = root.with("font-family", FONTS).at("font-size", chart::TEXT);
        let paper = Element::new("rect")
            .at("width", self.width)
            .at("height", self.height)
            .with("fill", "#fff");
        root.child(Element::new("title").text(self.title.as_str()))
            .child(paper)
            .children(self.content.iter().cloned())
    }
}

/// Markers with their words in a row, from (x, y) on; only those that occur.
fn legend(marks: &[Mark], x: f64, y: f64) -> Element {
    let mut group = Element::new("g").with("class", "legend");
    let mut at = x;
    for mark in Mark::ALL.into_iter().filter(|m| marks.contains(m)) {
        group.push(mark.draw(at + 6.0, y - 4.5, 6.5).unclassed());
        group.push(chart::text(at + 18.0, y, "start", mark.word()));
        at += 18.0 + 0.6 * chart::TEXT * mark.word().chars().count() as f64 + 18.0;
    }
    group
}
