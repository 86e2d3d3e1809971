//! The ratio test: which unknown stops the moving one, with ties decided lexicographically.

use super::super::tolerance::{LEXICOGRAPHIC, PIVOT, TIE};
use super::tableau::Tableau;
use super::variable::Variable;
use nalgebra::DVector;
use std::cmp::Ordering;

/// What stops the moving unknown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Block {
    /// How far it gets.
    pub(super) step: f64,
    /// Place of the basic unknown that stops it; `None` if it reaches its own bound.
    pub(super) place: Option<usize>,
    /// Is the bound reached an upper one?
    pub(super) at_upper: bool,
}

/// The first bound met when basic values change at `rates`, or `None` on a ray.
///
/// Among ties: t reaching 1, then artificials, then the least in the lexicographic order of the
/// perturbed steps. Only places whose pivot is large enough can block.
pub(super) fn ratio_test(tableau: &Tableau<'_>, rates: &DVector<f64>) -> Option<Block> {
    let blocks = all_blocks(tableau, rates);
    let least = blocks.iter().map(|b| b.step).fold(f64::INFINITY, f64::min);
    let tied = blocks.into_iter().filter(|b| b.step <= least + TIE * (1.0 + least.abs()));
    tied.min_by(|a, b| rank(tableau, a).cmp(&rank(tableau, b)).then_with(|| compare(tableau, rates, a, b)))
}

fn all_blocks(tableau: &Tableau<'_>, rates: &DVector<f64>) -> Vec<Block> {
    let threshold = PIVOT * rates.amax().max(1.0);
    let mut blocks = Vec::new();
    for (place, &rate) in rates.iter().enumerate().filter(|(_, rate)| rate.abs() > threshold) {
        let (lower, upper) = tableau.bounds(tableau.basis.variables[place]);
        let bound = if rate > 0.0 { upper } else { lower };
        if bound.is_finite() {
            let step = ((bound - tableau.values[place]) / rate).max(0.0);
            blocks.push(Block { step, place: Some(place), at_upper: rate > 0.0 });
        }
    }
    let step = tableau.own_room();
    if step.is_finite() {
        blocks.push(Block { step, place: None, at_upper: tableau.sign > 0.0 });
    }
    blocks
}

/// 0 if the path is complete, 1 for artificials, 2 for all others.
fn rank(tableau: &Tableau<'_>, block: &Block) -> u8 {
    match block.place.map_or(tableau.entering, |place| tableau.basis.variables[place]) {
        Variable::T => 0,
        Variable::Artificial(_) => 1,
        _ => 2,
    }
}

/// Lexicographic order of the perturbed steps (bound - value - P eps) / rate; the own bound of the
/// moving unknown is not perturbed.
fn compare(tableau: &Tableau<'_>, rates: &DVector<f64>, a: &Block, b: &Block) -> Ordering {
    let perturbed = |block: &Block| match block.place {
        Some(place) => tableau.basis.perturbation(place) / -rates[place],
        None => DVector::zeros(rates.len()),
    };
    lexicographic(&perturbed(a), &perturbed(b))
}

/// The first component in which two rows differ decides; components within rounding are equal.
fn lexicographic(a: &DVector<f64>, b: &DVector<f64>) -> Ordering {
    let scale = a.amax().max(b.amax()).max(f64::MIN_POSITIVE);
    let differs = a.iter().zip(b.iter()).find(|(x, y)| (*x - *y).abs() > LEXICOGRAPHIC * scale);
    differs.map_or(Ordering::Equal, |(x, y)| x.total_cmp(y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    #[test]
    fn first_difference_decides_and_rounding_does_not() {
        assert_eq!(lexicographic(&dvector![1.0, 2.0], &dvector![1.0, 3.0]), Ordering::Less);
        assert_eq!(lexicographic(&dvector![1.0 + 1e-15, 4.0], &dvector![1.0, 3.0]), Ordering::Greater);
        assert_eq!(lexicographic(&dvector![1.0, 3.0], &dvector![1.0, 3.0]), Ordering::Equal);
    }
}
