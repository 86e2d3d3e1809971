//! A report as one HTML file: text, tables and pictures, nothing from outside, no scripts.
//!
//! `mceip path --report` and `mceip analyze --report` fill a [`ReportPage`] with their answers.

use super::drawing::Picture;
use super::markup::Element;

/// A page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReportPage {
    /// Its heading.
    pub title: String,
    /// Its sections, in order.
    pub sections: Vec<Section>,
}

/// A part of a page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// What it says, in order.
    pub content: Vec<Content>,
}

/// What a section consists of.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// Text. Line breaks are kept.
    Paragraph(String),
    /// Sentences that must not be overlooked, such as what stays undecided.
    Warning(String),
    /// Rows under a header. Rows may be shorter.
    Table {
        /// What the table shows.
        caption: String,
        /// The first row; empty for none.
        header: Vec<String>,
        /// The others.
        rows: Vec<Vec<String>>,
    },
    /// A picture.
    Figure {
        /// The drawing.
        picture: Picture,
        /// What to read off it.
        caption: String,
    },
}

/// Rows up to which a table is shown at once.
const UNFOLDED: usize = 20;

/// The style sheet of the page.
const STYLE: &str = concat!(
    "body{font-family:DejaVu Sans,Verdana,Arial,sans-serif;line-height:1.45;",
    "color:#000;background:#fff;max-width:64em;margin:2em auto;padding:0 1em}",
    "h1{font-size:1.5em}",
    "h2{font-size:1.2em;margin-top:2em;border-bottom:1px solid #000}",
    "p{white-space:pre-line}",
    ".warning{border:2px solid #000;padding:.6em 1em;font-weight:bold}",
    ".wide{overflow-x:auto}",
    "table{border-collapse:collapse;font-size:.85em;margin:1em 0}",
    "caption{caption-side:top;text-align:left;padding-bottom:.4em;font-style:italic}",
    "th,td{border:1px solid #999;padding:.2em .6em;text-align:left;vertical-align:top}",
    "th{background:#eee}",
    "td{font-family:DejaVu Sans Mono,Consolas,monospace;font-size:.92em}",
    "figure{margin:1.5em 0;break-inside:avoid}",
    "figcaption{font-size:.9em}",
    "svg{width:100%;height:auto}",
    "summary{cursor:pointer;font-style:italic;font-size:.85em;margin:1em 0}",
);

/// What made the page.
const GENERATOR: &str = concat!("mceip ", env!("CARGO_PKG_VERSION"));

impl ReportPage {
    /// The page. Everything given is text: no markup in it comes through.
    ///
    /// ```
    /// use mceip::picture::{Content, ReportPage, Section};
    /// let section = Section {
    ///     title: "A & B".into(),
    ///     content: vec![Content::Paragraph("mu < 2".into())],
    /// };
    /// let page = ReportPage {
    ///     title: "Block".into(),
    ///     sections: vec![section],
    /// }
    /// .to_html();
    /// assert!(
    ///     page.starts_with("<!DOCTYPE html>")
    ///         && page.contains("<h2>A &amp; B</h2>")
    ///         && page.contains("mu &lt; 2")
    /// );
    /// ```
    pub fn to_html(&self) -> String {
        let title = self.title.as_str();
        let head = Element::new("head")
            .child(Element::new("meta").with("charset", "utf-8"))
            .child(meta("viewport", "width=device-width, initial-scale=1"))
            .child(meta("generator", GENERATOR))
            .child(Element::new("title").text(title))
            .child(Element::new("style").text(STYLE));

        let body = Element::new("body")
            .child(Element::new("h1").text(title))
            .children(self.sections.iter().map(Section::element));

        let page = Element::new("html")
            .with("lang", "en")
            .child(head)
            .child(body);

        format!("<!DOCTYPE html>\n{page}\n")
    }
}

fn meta(name: &str, content: &str) -> Element {
    Element::new("meta")
        .with("name", name)
        .with("content", content)
}

impl Section {
    fn element(&self) -> Element {
        let heading = Element::new("h2").text(self.title.as_str());
        Element::new("section")
            .child(heading)
            .children(self.content.iter().map(Content::element))
    }
}

impl Content {
    fn element(&self) -> Element {
        match self {
            Content::Paragraph(text) => Element::new("p").text(text.as_str()),
            Content::Warning(text) => Element::new("p")
                .with("class", "warning")
                .text(text.as_str()),
            Content::Table {
                caption,
                header,
                rows,
            } => table(caption, header, rows),
            Content::Figure { picture, caption } => Element::new("figure")
                .child(picture.inline())
                .child(Element::new("figcaption").text(caption.as_str())),
        }
    }
}

/// A table in a frame that scrolls where the page is too narrow; a long one is folded.
fn table(caption: &str, header: &[String], rows: &[Vec<String>]) -> Element {
    let is_long = rows.len() > UNFOLDED;
    let summary = Element::new("summary").text(format!("{caption} ({} rows)", rows.len()));
    let caption = Element::new("caption").text(caption);
    // The empty text keeps the element open where there are no rows.
    let body = Element::new("tbody")
        .text("")
        .children(rows.iter().map(|row| table_row("td", row)));

    let mut table = Element::new("table").child(caption);
    if !header.is_empty() {
        table.push(Element::new("thead").child(table_row("th", header)));
    }
    table.push(body);

    let frame = Element::new("div").with("class", "wide").child(table);

    if is_long {
        Element::new("details").child(summary).child(frame)
    } else {
        frame
    }
}

/// A row of cells of this kind, `th` or `td`.
fn table_row(kind: &'static str, cells: &[String]) -> Element {
    let mut row = Element::new("tr");
    for cell in cells {
        row.push(Element::new(kind).text(cell.as_str()));
    }

    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_text_whatever_it_says() {
        let hostile = "</p><script src='x'>&amp;\"";
        let content = vec![
            Content::Paragraph(hostile.into()),
            Content::Warning(hostile.into()),
            Content::Table {
                caption: hostile.into(),
                header: vec![hostile.into()],
                rows: vec![vec![hostile.into()], vec![]],
            },
            Content::Figure {
                picture: Picture::new(hostile, 10.0, 10.0),
                caption: hostile.into(),
            },
        ];
        let report = ReportPage {
            title: hostile.into(),
            sections: vec![Section {
                title: hostile.into(),
                content,
            }],
        };

        let page = report.to_html();

        let markup = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
        let tree = roxmltree::Document::parse(markup).unwrap();
        let texts = tree
            .descendants()
            .filter(|n| n.is_text() && n.text() == Some(hostile))
            .count();
        assert_eq!(texts, 10, "each of the ten comes back as it was");
        assert!(tree.descendants().all(|n| n.tag_name().name() != "script"));
        assert!(!page.contains("http:"));
        assert!(!page.contains("https:"));
    }
}
