//! The legend of the contact states: markers with their words in a row.

use super::chart;
use super::marker::Mark;
use super::markup::Element;

/// Radius of the markers, px.
const RADIUS: f64 = 6.5;

/// Mean width of a letter, as a part of the height of the text.
const LETTER: f64 = 0.6;

/// Markers with their words in a row, from (x, y) on; only those that occur.
pub(super) fn legend(
    marks: &[Mark],
    x: f64,
    y: f64,
    word_of: impl Fn(Mark) -> &'static str,
) -> Element {
    let mut group = Element::new("g").with("class", "legend");
    let mut left = x;

    for mark in Mark::ALL.into_iter().filter(|m| marks.contains(m)) {
        let word = word_of(mark);
        group.push(mark.draw(left + 6.0, y - 4.5, RADIUS).unclassed());
        group.push(chart::text(left + 18.0, y, "start", word));

        let letters = word.chars().count() as f64;
        left += 18.0 + LETTER * chart::TEXT * letters + 18.0;
    }

    group
}
