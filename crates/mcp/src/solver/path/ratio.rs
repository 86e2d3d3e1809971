//! The ratio test: which unknown stops the moving one.
//!
//! While the moving unknown grows by s, the basic values change to value + s rate. The first of
//! them to reach a bound, at s = (bound - value) / rate, leaves the basis; or the moving unknown
//! reaches its own other bound; or nothing stops it and the path ends on a ray. Ties are decided
//! lexicographically, or, as in PATH itself, for the largest pivot within bounds that widen a
//! little with every pivot.
//!
//! Input: a tableau whose rates are set. Output: a [`BlockingVariable`]. Called by `walk`.

use super::super::number::PathNumber;
use super::super::options::RatioTest;
use super::super::tolerance::{EXPAND_STEP, EXPAND_WIDTH, LEXICOGRAPHIC, PIVOT, TIE};
use super::block::BlockingVariable;
use super::tableau::PathTableau;
use super::variable::Variable;
use std::cmp::Ordering;
use std::mem::{swap, take};

/// The first bound met when basic values change at the state's rates, or `None` on a ray; `pivots`
/// were made before. Only places whose pivot is large enough can block. t reaching 1 goes before
/// artificials, artificials before all others.
pub(super) fn ratio_test<T: PathNumber>(
    tableau: &mut PathTableau<'_, T>,
    rule: RatioTest,
    pivots: usize,
) -> Option<BlockingVariable<T>> {
    let mut blocks = take(&mut tableau.state.blocks);
    list_blocks(tableau, &mut blocks);
    let first = match rule {
        RatioTest::Lexicographic => lexicographic_test(tableau, &blocks),
        RatioTest::Expand => expand_test(tableau, &blocks, pivots),
    };
    tableau.state.blocks = blocks;

    first
}

/// Among ties, the least in the lexicographic order of the perturbed steps (Dantzig, Orden and
/// Wolfe).
fn lexicographic_test<T: PathNumber>(
    tableau: &mut PathTableau<'_, T>,
    blocks: &[BlockingVariable<T>],
) -> Option<BlockingVariable<T>> {
    let least = blocks.iter().map(|b| b.step.clone()).reduce(T::smaller)?;
    let tie = least.clone() + T::tolerance(TIE) * (T::one() + least);
    let mut tied = blocks.iter().filter(|b| b.step <= tie);

    let mut best = tied.next()?;
    let [mut best_row, mut other_row] = take(&mut tableau.state.rows);
    let mut best_row_is_known = false;

    for block in tied {
        match rank(tableau, block).cmp(&rank(tableau, best)) {
            Ordering::Less => {
                best = block;
                best_row_is_known = false;
                continue;
            }
            Ordering::Greater => continue,
            Ordering::Equal => {}
        }

        if !best_row_is_known {
            perturbed_step(tableau, best, &mut best_row);
            best_row_is_known = true;
        }

        perturbed_step(tableau, block, &mut other_row);
        if lexicographic(&other_row, &best_row) == Ordering::Less {
            best = block;
            swap(&mut best_row, &mut other_row);
        }
    }

    tableau.state.rows = [best_row, other_row];
    Some(best.clone())
}

/// EXPAND-like (Gill, Murray, Saunders and Wright 1989): of the bounds met before the first one
/// widened, the one with the largest pivot, and always a step forward. Bounds widen with each pivot
/// of the path, so that no step is undone by the next; the values are made consistent after it.
fn expand_test<T: PathNumber>(
    tableau: &PathTableau<'_, T>,
    blocks: &[BlockingVariable<T>],
    pivots: usize,
) -> Option<BlockingVariable<T>> {
    let width = T::tolerance(EXPAND_WIDTH + EXPAND_STEP * pivots as f64);
    let widened = blocks
        .iter()
        .map(|b| b.step.clone() + width.clone() / speed(tableau, b));
    let reach = widened.reduce(T::smaller)?;

    let met = blocks.iter().filter(|b| b.step <= reach);
    let first = met.min_by(|a, b| {
        let by_rank = rank(tableau, a).cmp(&rank(tableau, b));
        by_rank.then_with(|| speed(tableau, b).order(&speed(tableau, a)))
    })?;

    // t stops at 1 exactly; everything else moves on a little beyond its bound.
    let mut best = first.clone();
    if best.place.is_some() && rank(tableau, &best) == OTHER_RANK {
        let least = T::tolerance(EXPAND_STEP) / speed(tableau, &best);
        best.step = best.step.larger(least);
    }
    Some(best)
}

/// How fast the unknown that blocks moves; 1 for the moving one itself.
fn speed<T: PathNumber>(tableau: &PathTableau<'_, T>, block: &BlockingVariable<T>) -> T {
    match block.place {
        Some(place) => tableau.state.rates[place].magnitude(),
        None => T::one(),
    }
}

/// Lists the bounds that basic unknowns meet, and that of the moving one.
fn list_blocks<T: PathNumber>(tableau: &PathTableau<'_, T>, blocks: &mut Vec<BlockingVariable<T>>) {
    blocks.clear();
    let rates = &tableau.state.rates;
    let threshold = T::tolerance(PIVOT) * T::largest(rates).larger(T::one());

    for (place, rate) in rates.iter().enumerate() {
        let is_pivot = rate.magnitude() > threshold;
        if !is_pivot {
            continue;
        }

        let (lower, upper) = tableau.bounds(tableau.basis.variables[place]);
        let rises = *rate > T::zero();
        let bound = if rises { upper } else { lower };

        if bound.is_finite() {
            let room = bound - tableau.state.values[place].clone();
            blocks.push(BlockingVariable {
                step: T::zero().larger(room / rate.clone()),
                place: Some(place),
                at_upper: rises,
            });
        }
    }

    let step = tableau.own_room();
    if step.is_finite() {
        blocks.push(BlockingVariable {
            step,
            place: None,
            at_upper: tableau.sign > T::zero(),
        });
    }
}

/// The rank of all blocks but t and artificials.
const OTHER_RANK: u8 = 2;

/// 0 if the path is complete, 1 for artificials, 2 for all others.
fn rank<T: PathNumber>(tableau: &PathTableau<'_, T>, block: &BlockingVariable<T>) -> u8 {
    let blocking = match block.place {
        Some(place) => tableau.basis.variables[place],
        None => tableau.entering,
    };

    match blocking {
        Variable::T => 0,
        Variable::Artificial(_) => 1,
        _ => OTHER_RANK,
    }
}

/// The perturbed step (bound - value - P eps) / rate as a row; the own bound of the moving unknown
/// is not perturbed.
fn perturbed_step<T: PathNumber>(
    tableau: &mut PathTableau<'_, T>,
    block: &BlockingVariable<T>,
    row: &mut Vec<T>,
) {
    match block.place {
        Some(place) => {
            tableau.basis.perturbation(&tableau.columns, place, row);
            let rate = -tableau.state.rates[place].clone();
            for entry in row.iter_mut() {
                *entry /= rate.clone();
            }
        }
        None => {
            row.clear();
            row.resize(tableau.state.rates.len(), T::zero());
        }
    }
}

/// The first component in which two rows differ decides; components within rounding are equal.
fn lexicographic<T: PathNumber>(a: &[T], b: &[T]) -> Ordering {
    let scale = T::largest(a)
        .larger(T::largest(b))
        .larger(T::tolerance(f64::MIN_POSITIVE));
    let equal = T::tolerance(LEXICOGRAPHIC) * scale;

    for (x, y) in a.iter().zip(b) {
        let difference = x.clone() - y.clone();
        if difference.magnitude() > equal {
            return x.order(y);
        }
    }

    Ordering::Equal
}

#[cfg(test)]
mod tests;
