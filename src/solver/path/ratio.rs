//! The ratio test: which unknown stops the moving one. Ties are decided lexicographically, or, as in
//! PATH itself, for the largest pivot within bounds that widen a little with every pivot.

use super::super::RatioTest;
use super::super::tolerance::{EXPAND_STEP, EXPAND_WIDTH, LEXICOGRAPHIC, PIVOT, TIE};
use super::number::{Number, largest};
use super::tableau::Tableau;
use super::variable::Variable;
use nalgebra::DVector;
use std::cmp::Ordering;

/// What stops the moving unknown.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Block<T> {
    /// How far it gets.
    pub(super) step: T,
    /// Place of the basic unknown that stops it; `None` if it reaches its own bound.
    pub(super) place: Option<usize>,
    /// Is the bound reached an upper one?
    pub(super) at_upper: bool,
}

/// The first bound met when basic values change at `rates`, or `None` on a ray; `pivots` were made
/// before. Only places whose pivot is large enough can block. t reaching 1 goes before artificials,
/// artificials before all others.
pub(super) fn ratio_test<T: Number>(tableau: &Tableau<'_, T>, rates: &DVector<T>, rule: RatioTest, pivots: usize) -> Option<Block<T>> {
    match rule {
        RatioTest::Lexicographic => lexicographic_test(tableau, rates),
        RatioTest::Expand => expand_test(tableau, rates, pivots),
    }
}

/// Among ties, the least in the lexicographic order of the perturbed steps (Dantzig, Orden and Wolfe).
fn lexicographic_test<T: Number>(tableau: &Tableau<'_, T>, rates: &DVector<T>) -> Option<Block<T>> {
    let blocks = all_blocks(tableau, rates);
    let least = blocks.iter().map(|b| b.step.clone()).reduce(T::smaller)?;
    let tie = least.clone() + T::tolerance(TIE) * (T::one() + least);
    let tied = blocks.into_iter().filter(|b| b.step <= tie);
    tied.min_by(|a, b| rank(tableau, a).cmp(&rank(tableau, b)).then_with(|| compare(tableau, rates, a, b)))
}

/// EXPAND-like (Gill, Murray, Saunders and Wright 1989): of the bounds met before the first one
/// widened, the one with the largest pivot, and always a step forward. Bounds widen with each pivot
/// of the path, so that no step is undone by the next; the values are made consistent after it.
fn expand_test<T: Number>(tableau: &Tableau<'_, T>, rates: &DVector<T>, pivots: usize) -> Option<Block<T>> {
    let width = T::tolerance(EXPAND_WIDTH + EXPAND_STEP * pivots as f64);
    let speed = |block: &Block<T>| block.place.map_or(T::one(), |place| rates[place].magnitude());
    let blocks = all_blocks(tableau, rates);
    let reach = blocks.iter().map(|b| b.step.clone() + width.clone() / speed(b)).reduce(T::smaller)?;
    let met = blocks.into_iter().filter(|b| b.step <= reach);
    let mut best = met.min_by(|a, b| rank(tableau, a).cmp(&rank(tableau, b)).then_with(|| speed(b).order(&speed(a))))?;
    // t stops at 1 exactly; everything else moves on a little beyond its bound.
    if best.place.is_some() && rank(tableau, &best) == 2 {
        best.step = best.step.clone().larger(T::tolerance(EXPAND_STEP) / speed(&best));
    }
    Some(best)
}

fn all_blocks<T: Number>(tableau: &Tableau<'_, T>, rates: &DVector<T>) -> Vec<Block<T>> {
    let threshold = T::tolerance(PIVOT) * largest(rates).larger(T::one());
    let mut blocks = Vec::new();
    for (place, rate) in rates.iter().enumerate().filter(|(_, rate)| rate.magnitude() > threshold) {
        let (lower, upper) = tableau.bounds(tableau.basis.variables[place]);
        let rises = *rate > T::zero();
        let bound = if rises { upper } else { lower };
        if bound.is_finite() {
            let step = T::zero().larger((bound - tableau.values[place].clone()) / rate.clone());
            blocks.push(Block { step, place: Some(place), at_upper: rises });
        }
    }
    let step = tableau.own_room();
    if step.is_finite() {
        blocks.push(Block { step, place: None, at_upper: tableau.sign > T::zero() });
    }
    blocks
}

/// 0 if the path is complete, 1 for artificials, 2 for all others.
fn rank<T: Number>(tableau: &Tableau<'_, T>, block: &Block<T>) -> u8 {
    match block.place.map_or(tableau.entering, |place| tableau.basis.variables[place]) {
        Variable::T => 0,
        Variable::Artificial(_) => 1,
        _ => 2,
    }
}

/// Lexicographic order of the perturbed steps (bound - value - P eps) / rate; the own bound of the
/// moving unknown is not perturbed.
fn compare<T: Number>(tableau: &Tableau<'_, T>, rates: &DVector<T>, a: &Block<T>, b: &Block<T>) -> Ordering {
    let perturbed = |block: &Block<T>| match block.place {
        Some(place) => tableau.basis.perturbation(place) / -rates[place].clone(),
        None => DVector::zeros(rates.len()),
    };
    lexicographic(&perturbed(a), &perturbed(b))
}

/// The first component in which two rows differ decides; components within rounding are equal.
fn lexicographic<T: Number>(a: &DVector<T>, b: &DVector<T>) -> Ordering {
    let scale = largest(a).larger(largest(b)).larger(T::tolerance(f64::MIN_POSITIVE));
    let equal = T::tolerance(LEXICOGRAPHIC) * scale;
    let differs = a.iter().zip(b.iter()).find(|(x, y)| ((*x).clone() - (*y).clone()).magnitude() > equal);
    differs.map_or(Ordering::Equal, |(x, y)| x.order(y))
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
