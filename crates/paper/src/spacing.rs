//! Where a contact node seems to be missing: two neighbours about twice as far apart as the nodes
//! beside them.
//!
//! Of a contact node a, b is the nearest contact node on the side away from its nearest one, that
//! is at more than 120 degrees from it. The pair is a wide gap where its distance is about twice
//! that of a and its nearest one, and, where there is a node beyond b, about twice that of b and
//! the nearest one there. A step from small elements to large ones is none: beyond b the distance
//! is that of the pair. Input: the particles of a system, those out of contact too, and the places
//! of their nodes. All in doubles; `plausibility` says it in words.
#![allow(clippy::float_arithmetic)]

use crate::tolerance::{IN_THE_MIDDLE, ONE_MISSING};
use mceip_exact::to_f64;
use mceip_model::{Coordinates, System};

/// Two neighbouring contact nodes that are too far apart.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WideGap {
    /// Their particles, the lower index first.
    pub(crate) particles: [usize; 2],
    /// (x, y) in the middle between them.
    pub(crate) middle: [f64; 2],
    /// The node of the body in the middle, if there is one.
    pub(crate) node: Option<usize>,
}

impl WideGap {
    /// Every wide gap, by the indices of the particles.
    pub(crate) fn all_of(system: &System, coordinates: &Coordinates) -> Vec<WideGap> {
        let mut contact = Vec::new();
        for (particle, given) in system.particles().iter().enumerate() {
            if let Some(node) = coordinates.node_of(given.tangential) {
                let place = coordinates.nodes()[node].place.each_ref().map(to_f64);
                contact.push(ContactPlace { particle, place });
            }
        }

        let mut gaps: Vec<WideGap> = Vec::new();
        for (a, b) in wide_pairs(&contact) {
            let particles = [a.particle, b.particle];
            let particles = [
                particles[0].min(particles[1]),
                particles[0].max(particles[1]),
            ];
            if gaps.iter().any(|gap| gap.particles == particles) {
                continue; // seen from the other end
            }

            let middle = [0, 1].map(|axis| (a.place[axis] + b.place[axis]) / 2.0);
            let reach = IN_THE_MIDDLE * distance(a.place, b.place);
            gaps.push(WideGap {
                particles,
                middle,
                node: node_near(coordinates, middle, reach),
            });
        }

        gaps.sort_by_key(|gap| gap.particles);
        gaps
    }
}

/// A particle and where its node is.
struct ContactPlace {
    particle: usize,
    place: [f64; 2],
}

/// The pairs that are too far apart, some of them from both ends.
fn wide_pairs(contact: &[ContactPlace]) -> Vec<(&ContactPlace, &ContactPlace)> {
    let is_wide = |gap: f64, beside: f64| {
        let [least, most] = ONE_MISSING;
        gap >= least * beside && gap <= most * beside
    };

    let mut pairs = Vec::new();
    for a in contact {
        let Some(nearest) = nearest(contact, a, |_| true) else {
            continue;
        };
        let Some(b) = nearest_away_from(contact, a, nearest) else {
            continue;
        };
        let gap = distance(a.place, b.place);
        if !is_wide(gap, distance(a.place, nearest.place)) {
            continue;
        }

        let beyond = nearest_away_from(contact, b, a);
        let is_wide_there = |beyond: &ContactPlace| is_wide(gap, distance(b.place, beyond.place));
        if beyond.is_none_or(is_wide_there) {
            pairs.push((a, b));
        }
    }
    pairs
}

/// The nearest contact node to this one, at another place, of those that are wanted.
fn nearest<'a>(
    contact: &'a [ContactPlace],
    from: &ContactPlace,
    is_wanted: impl Fn(&ContactPlace) -> bool,
) -> Option<&'a ContactPlace> {
    let at = |other: &ContactPlace| distance(from.place, other.place);
    let others = contact.iter().filter(|other| at(other) > 0.0);
    let wanted = others.filter(|other| is_wanted(other));
    wanted.min_by(|p, q| at(p).total_cmp(&at(q)))
}

/// The nearest contact node at more than 120 degrees from another one.
fn nearest_away_from<'a>(
    contact: &'a [ContactPlace],
    from: &ContactPlace,
    other: &ContactPlace,
) -> Option<&'a ContactPlace> {
    let to_other = offset(from.place, other.place);
    nearest(contact, from, |candidate| {
        let to_candidate = offset(from.place, candidate.place);
        let product = to_other[0] * to_candidate[0] + to_other[1] * to_candidate[1];
        product < -0.5 * length(to_other) * length(to_candidate)
    })
}

/// The node nearest to a place, within this reach.
fn node_near(coordinates: &Coordinates, place: [f64; 2], reach: f64) -> Option<usize> {
    let mut found: Option<(f64, usize)> = None;
    for (node, given) in coordinates.nodes().iter().enumerate() {
        let apart = distance(given.place.each_ref().map(to_f64), place);
        if apart <= reach && found.is_none_or(|(least, _)| apart < least) {
            found = Some((apart, node));
        }
    }
    found.map(|(_, node)| node)
}

fn offset(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    [to[0] - from[0], to[1] - from[1]]
}

fn length(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    length(offset(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pairs at these places along a line that are too far apart.
    fn pairs(places: &[f64]) -> Vec<(usize, usize)> {
        let mut contact = Vec::new();
        for (particle, x) in places.iter().enumerate() {
            let place = [*x, 0.1 * x];
            contact.push(ContactPlace { particle, place });
        }

        let mut pairs = Vec::new();
        for (a, b) in wide_pairs(&contact) {
            pairs.push((a.particle.min(b.particle), a.particle.max(b.particle)));
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    #[test]
    fn a_missing_node_is_seen_inside_and_before_the_last_one() {
        assert_eq!(pairs(&[0.0, 1.0, 2.0, 4.0, 5.0, 6.0]), [(2, 3)]);
        assert_eq!(pairs(&[5.0, 0.0, 4.0, 1.0, 2.0]), [(2, 4)]);
        assert_eq!(pairs(&[0.0, 1.0, 2.0, 4.0]), [(2, 3)]);
        assert_eq!(
            pairs(&[0.0, 1.0, 2.0, 4.0, 5.0, 7.0, 8.0]),
            [(2, 3), (4, 5)]
        );
    }

    /// Even and graded meshes, a step from small elements to large ones, two parts of a contact.
    #[test]
    fn other_spacings_are_not_named() {
        for places in [
            &[0.0, 1.0, 2.0, 3.0][..],
            &[0.0, 1.0, 2.4, 4.4, 7.0],
            &[0.0, 1.0, 2.0, 4.0, 6.0, 8.0],
            &[0.0, 1.0, 2.0, 6.0, 7.0, 8.0],
            &[0.0, 1.0],
            &[0.0],
            &[0.0, 0.0, 1.0, 2.0],
        ] {
            assert_eq!(pairs(places), [], "{places:?}");
        }
    }
}
