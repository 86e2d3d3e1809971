//! The ratio test: which unknown stops the moving one. Ties are decided lexicographically, or, as
//! in PATH itself, for the largest pivot within bounds that widen a little with every pivot.

use super::super::number::Number;
use super::super::options::RatioTest;
use super::super::tolerance::{EXPAND_STEP, EXPAND_WIDTH, LEXICOGRAPHIC, PIVOT, TIE};
use super::block::Block;
use super::tableau::Tableau;
use super::variable::Variable;
use std::cmp::Ordering;

/// The first bound met when basic values change at the state's rates, or `None` on a ray; `pivots`
/// were made before. Only places whose pivot is large enough can block. t reaching 1 goes before
/// artificials, artificials before all others.
pub(super) fn ratio_test<T: Number>(
    tableau: &mut Tableau<'_, T>,
    rule: RatioTest,
    pivots: usize,
) -> Option<Block<T>> {
    let mut blocks = std::mem::take(&mut tableau.state.blocks);
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
fn lexicographic_test<T: Number>(
    tableau: &mut Tableau<'_, T>,
    blocks: &[Block<T>],
) -> Option<Block<T>> {
    let least = blocks.iter().map(|b| b.step.clone()).reduce(T::smaller)?;
    let tie = least.clone() + T::tolerance(TIE) * (T::one() + least);
    let mut tied = blocks.iter().filter(|b| b.step <= tie);
    let mut best = tied.next()?;
    let [mut row, mut other] = std::mem::take(&mut tableau.state.rows);
    let mut is_known = false; // is `row` that of `best`?
    for block in tied {
        let mut compared = false;
        let order = rank(tableau, block)
            .cmp(&rank(tableau, best))
            .then_with(|| {
                if !is_known {
                    perturbed_step(tableau, best, &mut row);
                }
                (is_known, compared) = (true, true);
                perturbed_step(tableau, block, &mut other);
                lexicographic(&other, &row)
            });
        if order == Ordering::Less {
            is_known = compared;
            best = block;
            std::mem::swap(&mut row, &mut other);
        }
    }
    tableau.state.rows = [row, other];
    Some(best.clone())
}

/// EXPAND-like (Gill, Murray, Saunders and Wright 1989): of the bounds met before the first one
/// widened, the one with the largest pivot, and always a step forward. Bounds widen with each pivot
/// of the path, so that no step is undone by the next; the values are made consistent after it.
fn expand_test<T: Number>(
    tableau: &Tableau<'_, T>,
    blocks: &[Block<T>],
    pivots: usize,
) -> Option<Block<T>> {
    let width = T::tolerance(EXPAND_WIDTH + EXPAND_STEP * pivots as f64);
    let speed = |block: &Block<T>| {
        block
            .place
            .map_or(T::one(), |place| tableau.state.rates[place].magnitude())
    };
    let reach = blocks
        .iter()
        .map(|b| b.step.clone() + width.clone() / speed(b))
        .reduce(T::smaller)?;
    let met = blocks.iter().filter(|b| b.step <= reach);
    let mut best = met
        .min_by(|a, b| {
            rank(tableau, a)
                .cmp(&rank(tableau, b))
                .then_with(|| speed(b).order(&speed(a)))
        })?
        .clone();
    // t stops at 1 exactly; everything else moves on a little beyond its bound.
    if best.place.is_some() && rank(tableau, &best) == 2 {
        best.step = best
            .step
            .clone()
            .larger(T::tolerance(EXPAND_STEP) / speed(&best));
    }
    Some(best)
}

fn list_blocks<T: Number>(tableau: &Tableau<'_, T>, blocks: &mut Vec<Block<T>>) {
    blocks.clear();
    let rates = &tableau.state.rates;
    let threshold = T::tolerance(PIVOT) * T::largest(rates).larger(T::one());
    for (place, rate) in rates
        .iter()
        .enumerate()
        .filter(|(_, rate)| rate.magnitude() > threshold)
    {
        let (lower, upper) = tableau.bounds(tableau.basis.variables[place]);
        let rises = *rate > T::zero();
        let bound = if rises { upper } else { lower };
        if bound.is_finite() {
            let step =
                T::zero().larger((bound - tableau.state.values[place].clone()) / rate.clone());
            blocks.push(Block {
                step,
                place: Some(place),
                at_upper: rises,
            });
        }
    }
    let step = tableau.own_room();
    if step.is_finite() {
        blocks.push(Block {
            step,
            place: None,
            at_upper: tableau.sign > T::zero(),
        });
    }
}

/// 0 if the path is complete, 1 for artificials, 2 for all others.
fn rank<T: Number>(tableau: &Tableau<'_, T>, block: &Block<T>) -> u8 {
    match block
        .place
        .map_or(tableau.entering, |place| tableau.basis.variables[place])
    {
        Variable::T => 0,
        Variable::Artificial(_) => 1,
        _ => 2,
    }
}

/// The perturbed step (bound - value - P eps) / rate as a row; the own bound of the moving unknown
/// is not perturbed.
fn perturbed_step<T: Number>(tableau: &mut Tableau<'_, T>, block: &Block<T>, row: &mut Vec<T>) {
    match block.place {
        Some(place) => {
            tableau.basis.perturbation(&tableau.columns, place, row);
            let rate = -tableau.state.rates[place].clone();
            row.iter_mut().for_each(|entry| *entry /= rate.clone());
        }
        None => {
            row.clear();
            row.resize(tableau.state.rates.len(), T::zero());
        }
    }
}

/// The first component in which two rows differ decides; components within rounding are equal.
fn lexicographic<T: Number>(a: &[T], b: &[T]) -> Ordering {
    let scale = T::largest(a)
        .larger(T::largest(b))
        .larger(T::tolerance(f64::MIN_POSITIVE));
    let equal = T::tolerance(LEXICOGRAPHIC) * scale;
    let differs = a
        .iter()
        .zip(b)
        .find(|(x, y)| ((*x).clone() - (*y).clone()).magnitude() > equal);
    differs.map_or(Ordering::Equal, |(x, y)| x.order(y))
}

#[cfg(test)]
mod tests;
