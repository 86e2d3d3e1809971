//! Divides a region where the game of both ends gains most.
//!
//! The candidates are the variables whose complementarity the mix of the game breaks most, and a
//! cut of the interval at its middle. The games of both parts of each candidate are solved from the
//! game of the region (`ends_game`). A variable with a part that is proved empty is decided at
//! once. Else the candidate is taken that has the largest product of both gains, a gain being the
//! value of the part less that of the region, at most up to the value that proves.
//!
//! Regions with decided variables only, with radii or without an upper end are divided by the test
//! at the middle (`tree`). Called by `tree` for all others.

use super::dyadic::short_near;
use super::ends_game::EndsGame;
use super::leaf::farkas::FarkasColumns;
use super::pieces::expansion::ChordEnds;
use super::region::{self, SearchRegion};
use super::solutions::Solutions;
use super::tree::{Aim, MAX_CUTS, SLACK_OF_HALF, TreeSearch};
use crate::tolerance::{LEAST_GAIN, NARROW, WITNESS_MARGIN};
use mceip_check::certificate::{Node, VariableState};
use mceip_exact::{Rational, to_f64};
use std::rc::Rc;

/// Variables from which on a game is kept: below, solving it from nothing costs little.
const KEPT_FROM: usize = 16;

/// Variables whose parts are tried. Four make no fewer nodes of random pencils of order 40.
const TRIED: usize = 2;

/// Width in theta above which an interval is cut before anything is decided: the games of wide
/// intervals gain little, whatever is decided.
const WIDE: f64 = 1.0 / 24.0;

/// A game that belongs to a region, and what is known besides.
pub(crate) struct KeptGame {
    game: EndsGame,
    /// Is the symmetric part known to be indefinite?
    is_indefinite: bool,
}

/// A way to divide a region: the games of its parts, in the order of the tree.
struct Division {
    divided_by: DividedBy,
    games: [EndsGame; 2],
}

enum DividedBy {
    Variable(usize),
    Cut(Rational),
}

impl Division {
    fn is_proof(&self) -> bool {
        self.games.iter().any(|game| game.value() > WITNESS_MARGIN)
    }

    /// The product of both gains.
    fn gain(&self, value: f64) -> f64 {
        let [first, second] = &self.games;
        gain(value, first) * gain(value, second)
    }
}

fn gain(value: f64, part: &EndsGame) -> f64 {
    let gain = part.value().min(WITNESS_MARGIN) - value;
    gain.max(LEAST_GAIN)
}

impl TreeSearch<'_, Solutions<'_>> {
    /// Are games kept over such an interval? T has to be linear there.
    pub(super) fn keeps_games(&self, ends: &ChordEnds) -> bool {
        self.view.order() >= KEPT_FROM && ends.r.is_none() && !ends.is_half_line()
    }

    /// Covers a region by the game of its ends. Returns false, and covers nothing, where that
    /// cannot be done.
    pub(super) fn by_gains(
        &mut self,
        region: &SearchRegion,
        parts: &Rc<[ChordEnds]>,
        kept: Option<KeptGame>,
        share: f64,
    ) -> bool {
        let ends = &parts[0];
        if !self.keeps_games(ends) || region.is_decided() {
            return false;
        }

        let is_indefinite = kept.as_ref().is_some_and(|kept| kept.is_indefinite);
        let is_known_empty = kept
            .as_ref()
            .is_some_and(|kept| kept.game.value() > WITNESS_MARGIN);
        if !is_indefinite
            && !is_known_empty
            && let Some(leaf) = Solutions::definite_leaf(self, region, parts)
        {
            self.leaf(leaf, share);
            return true;
        }

        if kept.is_none()
            && self.width(ends) > WIDE
            && let Some(cut) = self.middle_cut(region, ends)
        {
            let games = [None, None];
            self.divide_at(&cut, region, games, share);
            return true;
        }

        let game = match kept {
            Some(kept) => kept.game,
            None => match EndsGame::new(ends, &region.states) {
                Some(game) => game,
                None => return false,
            },
        };

        if game.value() > WITNESS_MARGIN {
            let columns = FarkasColumns::of(parts, &region.states);
            return match columns.rounded(&game.weights()) {
                Some(weights) => {
                    self.leaf(Node::Farkas(weights), share);
                    true
                }
                None => false,
            };
        }

        let Some(division) = self.division(region, ends, &game) else {
            return false;
        };

        // The games of the path take room.
        drop(game);
        match division.divided_by {
            DividedBy::Variable(position) => {
                self.decide(position, region, parts, division.games, share);
            }
            DividedBy::Cut(cut) => {
                let games = division.games.map(Some);
                self.divide_at(&cut, region, games, share);
            }
        }

        true
    }

    /// The best division of a region that is not proved empty; `None` if there is none.
    fn division(
        &self,
        region: &SearchRegion,
        ends: &ChordEnds,
        game: &EndsGame,
    ) -> Option<Division> {
        let mut best: Option<Division> = None;
        let mut best_gain = 0.0;
        for position in most_violated(&region.states, game) {
            let Some(division) = self.by_variable(position, region, game) else {
                continue;
            };

            if division.is_proof() {
                return Some(division);
            }

            let gain = division.gain(game.value());
            if gain > best_gain {
                best_gain = gain;
                best = Some(division);
            }
        }

        match self.by_cut(region, ends, game) {
            Some(cut) if cut.gain(game.value()) > best_gain => Some(cut),
            _ => best,
        }
    }

    fn by_variable(
        &self,
        position: usize,
        region: &SearchRegion,
        game: &EndsGame,
    ) -> Option<Division> {
        let at_zero = self.view.part(region, position, VariableState::AtZero);
        let in_support = self.view.part(region, position, VariableState::InSupport);
        let games = [
            game.decided(&region.states, &at_zero.states)?,
            game.decided(&region.states, &in_support.states)?,
        ];
        Some(Division {
            divided_by: DividedBy::Variable(position),
            games,
        })
    }

    fn by_cut(&self, region: &SearchRegion, ends: &ChordEnds, game: &EndsGame) -> Option<Division> {
        if self.width(ends) < NARROW || region.cuts >= MAX_CUTS {
            return None;
        }

        let cut = self.middle_cut(region, ends)?;
        let place = (to_f64(&cut) - ends.lo) / (ends.hi - ends.lo);
        let games = [
            game.cut(1, place, &region.states)?,
            game.cut(0, place, &region.states)?,
        ];
        Some(Division {
            divided_by: DividedBy::Cut(cut),
            games,
        })
    }

    /// A short number near the middle of an interval.
    fn middle_cut(&self, region: &SearchRegion, ends: &ChordEnds) -> Option<Rational> {
        let slack = SLACK_OF_HALF * (ends.hi - ends.lo);
        let cut = short_near(self.middle(region), slack)?;
        region.has_inside(&cut).then_some(cut)
    }

    fn decide(
        &mut self,
        position: usize,
        region: &SearchRegion,
        ends: &Rc<[ChordEnds]>,
        games: [EndsGame; 2],
        share: f64,
    ) {
        self.branch_on(position);
        for (state, game) in [VariableState::AtZero, VariableState::InSupport]
            .into_iter()
            .zip(games)
        {
            let mut part = self.view.part(region, position, state);
            part.cuts = 0;
            // With x_i > 0 the same variables may move as before.
            let has_same_block = part.states.iter().zip(&region.states).all(|(new, old)| {
                (*new == VariableState::AtZero) == (*old == VariableState::AtZero)
            });
            let kept = KeptGame {
                game,
                is_indefinite: has_same_block,
            };
            self.node(&part, ends, Some(kept), 0.5 * share);
        }
    }

    fn divide_at(
        &mut self,
        cut: &Rational,
        region: &SearchRegion,
        games: [Option<EndsGame>; 2],
        share: f64,
    ) {
        self.split_at(cut);
        let parts = [region.below(cut), region.above(cut)];
        for (mut part, game) in parts.into_iter().zip(games) {
            part.cuts += 1;
            let kept = game.map(|game| KeptGame {
                game,
                is_indefinite: false,
            });
            let ends = self.ends_of(&part);
            self.node(&part, &ends, kept, 0.5 * share);
        }
    }
}

/// The undecided positions whose complementarity the mix of the game breaks most, worst first.
fn most_violated(states: &[VariableState], game: &EndsGame) -> Vec<usize> {
    let mut violations = Vec::new();
    for position in region::undecided(states) {
        violations.push((game.violation(position), position));
    }

    violations.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    violations.truncate(TRIED);
    violations
        .into_iter()
        .map(|(_, position)| position)
        .collect()
}
