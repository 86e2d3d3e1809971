//! Elements of SVG and HTML as a tree: what is written is well-formed, and text cannot become
//! markup.
//!
//! An [`Element`] is built by its methods and written by its [`Display`]. Pictures and reports are
//! made of nothing else.

use mceip_exact::without_zeros;
use std::fmt::{self, Display, Formatter};

/// An element with attributes and children, in the order given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Child>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Child {
    Element(Element),
    Text(String),
}

impl Element {
    /// An element without attributes and children. Names come from the program, never from input.
    ///
    /// ```
    /// use mceip::picture::Element;
    /// let p = Element::new("p").with("title", "a \"b\"").text("x < y & z");
    /// assert_eq!(p.to_string(), "<p title=\"a &quot;b&quot;\">x &lt; y &amp; z</p>");
    /// ```
    pub fn new(name: &'static str) -> Element {
        Element {
            name,
            attributes: Vec::new(),
            children: Vec::new(),
        }
    }

    /// With an attribute.
    pub fn with(mut self, name: &'static str, value: impl Display) -> Element {
        let value = value.to_string();
        self.attributes.push((name, value));
        self
    }

    /// With a length or coordinate, to a hundredth of a unit.
    pub fn at(self, name: &'static str, value: f64) -> Element {
        self.with(name, short(value))
    }

    /// With a text child.
    pub fn text(mut self, text: impl Into<String>) -> Element {
        self.children.push(Child::Text(text.into()));
        self
    }

    /// With a child.
    pub fn child(mut self, child: Element) -> Element {
        self.push(child);
        self
    }

    /// With children.
    pub fn children(mut self, children: impl IntoIterator<Item = Element>) -> Element {
        let children = children.into_iter().map(Child::Element);
        self.children.extend(children);
        self
    }

    /// Without its class: a copy that stands for no data, as in a legend.
    pub(super) fn unclassed(mut self) -> Element {
        self.attributes.retain(|(name, _)| *name != "class");
        self
    }

    /// Turned about a place on paper, clockwise.
    pub(super) fn turned(self, degrees: f64, (x, y): (f64, f64)) -> Element {
        let turn = format!("rotate({} {} {})", short(degrees), short(x), short(y));
        self.with("transform", turn)
    }

    /// Adds a child.
    pub fn push(&mut self, child: Element) {
        self.children.push(Child::Element(child));
    }
}

/// A coordinate in a picture: two decimals, without needless zeros.
pub(super) fn short(value: f64) -> String {
    short_to(value, 2)
}

/// A number with at most this many decimals.
pub(super) fn short_to(value: f64, decimals: usize) -> String {
    let rounded = format!("{value:.decimals$}");
    match without_zeros(&rounded) {
        "-0" => "0".into(),
        number => number.into(),
    }
}

/// Places as SVG lists them: "x,y x,y".
pub(super) fn point_list(places: &[(f64, f64)]) -> String {
    let mut pairs = Vec::new();
    for (x, y) in places {
        pairs.push(format!("{},{}", short(*x), short(*y)));
    }

    pairs.join(" ")
}

/// A straight line as a part of an SVG path.
pub(super) fn segment(from: (f64, f64), to: (f64, f64)) -> String {
    format!(
        "M{} {}L{} {}",
        short(from.0),
        short(from.1),
        short(to.0),
        short(to.1)
    )
}

impl Display for Element {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(f, " {name}=\"{}\"", Escaped(value))?;
        }

        if self.children.is_empty() {
            return f.write_str("/>");
        }

        f.write_str(">")?;
        for child in &self.children {
            match child {
                Child::Element(e) => e.fmt(f)?,
                Child::Text(t) => Escaped(t).fmt(f)?,
            }
        }

        write!(f, "</{}>", self.name)
    }
}

/// Text with the five characters of markup replaced, and what XML 1.0 does not admit left out.
struct Escaped<'a>(&'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\'' => f.write_str("&#39;")?,
                '\n' | '\t' => write!(f, "{c}")?,
                '\u{fffe}' | '\u{ffff}' => {}
                c if c.is_control() => {}
                c => write!(f, "{c}")?,
            }
        }

        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whatever_the_text_it_comes_back_and_nothing_else() {
        let hostile = "</p><script>alert('x')</script> & \" \u{1F600} mu \u{3bc} ]]> <!--";
        let text = Element::new("p")
            .with("title", hostile)
            .text(hostile)
            .child(Element::new("br"))
            .to_string();

        let parsed = roxmltree::Document::parse(&text).unwrap();
        let root = parsed.root_element();
        assert_eq!(root.attribute("title"), Some(hostile));
        assert_eq!(root.text(), Some(hostile));
        assert_eq!(root.children().filter(|c| c.is_element()).count(), 1);

        let not_xml = "a\u{0}\u{8}\u{fffe}b";
        let text = Element::new("p").text(not_xml).to_string();
        let parsed = roxmltree::Document::parse(&text).unwrap();
        assert_eq!(parsed.root_element().text(), Some("ab"));
    }

    #[test]
    fn coordinates_are_short() {
        let coordinates = [1.0, -0.001, 2.345, 10.5, 100.0].map(short);

        assert_eq!(coordinates, ["1", "0", "2.35", "10.5", "100"]);
    }
}
