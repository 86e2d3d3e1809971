//! Leaf `farkas`: weights w that leave no room for a solution.
//!
//! Let w_i >= 0 off the support and (w'T)_j < 0 for every j that may be in the support. A solution
//! would have 0 <= w'y = w'Tx < 0. The inequalities are linear in T, so they hold over an interval
//! if they hold at both ends, radius included. The largest margin with which some w satisfies them
//! is the value of a matrix game (`game`); its w is rounded to the fewest bits that still prove.
//!
//! Called by `tree` for every region; its test at the middle of an interval also tells the tree
//! whether to cut or to branch. The checker's side is `check::cover::farkas`.

use crate::search::complete::game::{self, Game};
use crate::search::complete::pieces::expansion::ChordEnds;
use crate::search::complete::pieces::matrix::SquareMatrix;
use crate::search::complete::pieces::skyline::dot;
use crate::search::complete::region::possible_support;
use crate::tolerance::{CONDENSED_MARGIN, THIN_MARGIN, WITNESS_MARGIN};
use mceip_check::certificate::VariableState;

/// Bits tried for the weights, shortest first.
const WEIGHT_BITS: [i32; 5] = [8, 14, 20, 30, 44];

/// Share of the margin of the game that rounded weights must keep.
const KEPT_MARGIN: f64 = 0.1;

/// The weights of a Farkas leaf for both ends of an interval, given the test at its middle. What
/// works at both ends works at the middle: where nothing does, the larger game is not played.
pub(crate) fn weights(
    columns: &FarkasColumns,
    middle: &MiddleTest,
    states: &[VariableState],
) -> Option<Vec<i64>> {
    if middle.game.value <= 0.0 {
        return None;
    }

    // The game of both ends does not know the radius; the middle's vector may stand it over all of
    // the interval.
    if middle.is_prunable
        && let Some(weights) = columns.rounded(&middle.game.w)
    {
        return Some(weights);
    }

    let game = columns.play(states);
    // Before a decided region is given to its null vectors a thin margin is worth trying.
    let is_decided = !states.contains(&VariableState::Undecided);
    let least = if is_decided {
        THIN_MARGIN
    } else {
        WITNESS_MARGIN
    };

    if game.value > least {
        columns.rounded(&game.w)
    } else {
        None
    }
}

/// The game at one value in the middle of an interval.
pub(crate) struct MiddleTest {
    pub(crate) value: f64,
    /// T there, with its radius.
    pub(crate) point: ChordEnds,
    pub(crate) columns: FarkasColumns,
    pub(crate) game: Game,
    /// Do the weights of the game exclude solutions there by a margin?
    pub(crate) is_prunable: bool,
}

impl MiddleTest {
    /// Plays the game at the one value of `point`.
    pub(crate) fn new(point: ChordEnds, states: &[VariableState]) -> MiddleTest {
        let columns = FarkasColumns::at_lower_end(&point, states);
        let game = columns.play(states);
        let is_prunable = columns.margin(&game) > WITNESS_MARGIN;
        MiddleTest {
            value: point.lo,
            point,
            columns,
            game,
            is_prunable,
        }
    }

    /// T in the middle.
    pub(crate) fn matrix(&self) -> &SquareMatrix {
        &self.point.m[0]
    }

    /// The x of the game over all positions: the closest to a solution, or zero.
    pub(crate) fn relaxed_solution(&self) -> Vec<f64> {
        let mut x = vec![0.0; self.matrix().len()];
        for (column, share) in self.columns.list.iter().zip(&self.game.mix) {
            x[column.variable] = *share;
        }

        x
    }
}

/// A column of T, divided by its largest entry.
struct FarkasColumn {
    entries: Vec<f64>,
    /// Position of its variable.
    variable: usize,
    /// Radius of each entry, divided likewise: w'T may be larger by |w|'radius.
    radius: Option<Vec<f64>>,
    /// What the column was multiplied by.
    unit: f64,
    /// Is it the direction at an infinite end, where <= 0 suffices?
    is_direction: bool,
}

impl FarkasColumn {
    fn new(
        m: &SquareMatrix,
        radius: Option<&SquareMatrix>,
        variable: usize,
        is_direction: bool,
    ) -> FarkasColumn {
        let entries: Vec<f64> = m.iter().map(|row| row[variable]).collect();
        let largest = entries.iter().fold(0.0f64, |s, v| s.max(v.abs()));
        let unit = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        FarkasColumn {
            entries: entries.into_iter().map(|v| v * unit).collect(),
            variable,
            radius: radius.map(|r| r.iter().map(|row| row[variable] * unit).collect()),
            unit,
            is_direction,
        }
    }

    /// |w|'radius
    fn around(&self, w: &[f64]) -> f64 {
        self.radius.as_ref().map_or(0.0, |radius| {
            radius.iter().zip(w).map(|(r, w)| r * w.abs()).sum()
        })
    }

    /// Are all products of entry and weight zero? Then w'T is an exact zero, whatever the rounding.
    fn is_exact_zero(&self, w: &[f64]) -> bool {
        self.entries
            .iter()
            .zip(w)
            .all(|(entry, weight)| entry * weight == 0.0)
    }

    /// The column as the game has it. At an infinite end it is lowered by twice the margin, so that
    /// an entry of zero does not stand in the way.
    fn for_the_game(&self) -> Vec<f64> {
        if !self.is_direction {
            return self.entries.clone();
        }

        self.entries
            .iter()
            .map(|v| v - 2.0 * WITNESS_MARGIN)
            .collect()
    }
}

/// The columns of T that may be in the support, at one or both ends.
pub(crate) struct FarkasColumns {
    list: Vec<FarkasColumn>,
}

impl FarkasColumns {
    /// Of one value, given as an interval of width zero.
    fn at_lower_end(point: &ChordEnds, states: &[VariableState]) -> FarkasColumns {
        let mut columns = FarkasColumns { list: Vec::new() };
        columns.add(&point.m[0], point.radius(0), states, false);
        columns
    }

    /// Of both ends of an interval, for each corner of mu: all columns of the lower, then all of
    /// the upper end.
    pub(crate) fn of(corners: &[ChordEnds], states: &[VariableState]) -> FarkasColumns {
        let mut columns = FarkasColumns { list: Vec::new() };
        for ends in corners {
            columns.add(&ends.m[0], ends.radius(0), states, false);
            columns.add(&ends.m[1], ends.radius(1), states, ends.is_half_line());
        }

        columns
    }

    fn add(
        &mut self,
        m: &SquareMatrix,
        radius: Option<&SquareMatrix>,
        states: &[VariableState],
        is_direction: bool,
    ) {
        for variable in possible_support(states) {
            let column = FarkasColumn::new(m, radius, variable, is_direction);
            self.list.push(column);
        }
    }

    fn has_no_radius(&self) -> bool {
        self.list.iter().all(|column| column.radius.is_none())
    }

    /// The game on these columns.
    fn play(&self, states: &[VariableState]) -> Game {
        let mut either_sign = Vec::with_capacity(states.len());
        for state in states {
            either_sign.push(*state == VariableState::InSupport);
        }

        let mut columns = Vec::with_capacity(self.list.len());
        for column in &self.list {
            columns.push(column.for_the_game());
        }

        game::solve(&either_sign, &columns)
    }

    /// What is left of the game's value once the radius has been taken off.
    fn margin(&self, game: &Game) -> f64 {
        if self.has_no_radius() {
            return game.value;
        }

        self.margin_of(&game.w)
    }

    /// The least amount by which w'T is negative in a column, its radius taken off.
    pub(crate) fn margin_of(&self, w: &[f64]) -> f64 {
        self.list
            .iter()
            .map(|column| -dot(&column.entries, w) - column.around(w))
            .fold(f64::INFINITY, f64::min)
    }

    /// Rounds the weights to short integers that still prove what they are to prove.
    pub(crate) fn rounded(&self, w: &[f64]) -> Option<Vec<i64>> {
        let largest = w.iter().fold(0.0f64, |s, v| s.max(v.abs()));
        if largest == 0.0 {
            return self.list.is_empty().then(|| vec![0; w.len()]);
        }

        for bits in WEIGHT_BITS {
            let unit = f64::from(bits).exp2() / largest;
            let rounded: Vec<f64> = w.iter().map(|v| (v * unit).round()).collect();
            if self.are_negative(&rounded) {
                return Some(rounded.iter().map(|v| *v as i64).collect());
            }
        }

        None
    }

    /// Is every entry of w'T negative by a margin (at an infinite end: not positive)?
    fn are_negative(&self, w: &[f64]) -> bool {
        let size: f64 = w.iter().map(|v| v.abs()).sum();
        // Doubles know a condensed pencil less well than a given one.
        let least = KEPT_MARGIN
            * if self.has_no_radius() {
                THIN_MARGIN
            } else {
                CONDENSED_MARGIN
            };

        self.list.iter().all(|column| {
            let around = column.around(w);
            let bound = dot(&column.entries, w) + around;
            let is_zero_at_infinity =
                column.is_direction && around == 0.0 && column.is_exact_zero(w);
            bound < -least * size || is_zero_at_infinity
        })
    }

    /// The part of [0, 1] around `from` on which w still works on the chord between the ends.
    pub(crate) fn range(&self, w: &[f64], from: f64) -> Option<UnitRange> {
        let size: f64 = w.iter().map(|v| v.abs()).sum();
        let (at_lower, at_upper) = self.list.split_at(self.list.len() / 2);
        let mut range = UnitRange {
            begin: 0.0,
            end: 1.0,
        };

        for (lower, upper) in at_lower.iter().zip(at_upper) {
            let first = value_with_margin(lower, w, size);
            let last = value_with_margin(upper, w, size);
            if first + from * (last - first) > 0.0 {
                return None;
            }

            if first > 0.0 {
                range.begin = range.begin.max(first / (first - last));
            }

            if last > 0.0 {
                range.end = range.end.min(first / (first - last));
            }
        }

        (range.begin < from && from < range.end).then_some(range)
    }
}

/// A part of the unit interval.
pub(crate) struct UnitRange {
    pub(crate) begin: f64,
    pub(crate) end: f64,
}

/// The upper bound of w'T in a column plus the margin, in the scale that both ends share.
fn value_with_margin(column: &FarkasColumn, w: &[f64], size: f64) -> f64 {
    let margin = WITNESS_MARGIN * size;
    let value = dot(&column.entries, w) + column.around(w) + margin;
    // The columns of both ends are divided by their own largest entries: that is undone.
    value / column.unit
}
