//! The legend of the contact states: markers with their words in a row.

use super::chart;
use super::marker::Mark;
use super::markup::Element;

/// Markers with their words in a row, from (x, y) on; only those that occur.
pub(super) fn legend(marks: &[Mark], x: f64, y: f64) -> Element {
    let mut group = Element::new("g").with("class", "legend");
    let mut at = x;
    for mark in Mark::ALL.into_iter().filter(|m| marks.contains(m)) {
        group.push(mark.draw(at + 6.0, y - 4.5, 6.5).unclassed());
        group.push(chart::text(at + 18.0, y, "start", mark.word()));
        at += 18.0 + 0.6 * chart::TEXT * mark.word().chars().count() as f64 + 18.0;
    }
    group
}
