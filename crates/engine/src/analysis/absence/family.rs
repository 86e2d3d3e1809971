//! The two parts of T(t, mu) = T0(t) + mu T1(t), condensed about common anchors.
//!
//! With t = lambda^2 the pencil of a mechanical system is affine in mu: the pencil P0(t) has the
//! rows of mu = 0, and P1(t) the same free rows and the coefficients of mu in the slip rows. So
//! both have the same F(t) = T_ff and T_fs, and their Schur complements are T0(t) and T1(t). Each
//! is expanded as a pencil of its own (`search::complete::pieces`), about the same anchors and with
//! the same W; only V differs.
//!
//! Input: K* and M* as functions of mu, and a friction up to which a tail is to hold. Output: the
//! pieces of [0, infinity), and for each the expansions of both parts. Called by `mod.rs`.

use super::super::families::Families;
use super::members::FamilyRadii;
use crate::branch::BranchPoint;
use crate::search::complete::CompleteError;
use crate::search::complete::leaf::tail::{definite_at, semidefinite};
use crate::search::complete::pieces::blocks::PencilBlocks;
use crate::search::complete::pieces::condense::{DefinitePencils, beside};
use crate::search::complete::pieces::expansion::Expansion;
use crate::search::complete::pieces::matrix::times;
use crate::search::complete::pieces::prepared::Prepared;
use crate::search::complete::pieces::reverse::exchanged;
use crate::search::complete::pieces::view::{View, common_row_factor, row_factor};
use crate::tolerance::{FIRST_NEAR, NEARER};
use mceip_check::certificate::{Condensation, CriticalAnchor, CriticalCondensation, CriticalTail};
use mceip_exact::{Rational, Sparse, to_f64};
use mceip_model::file::Number;
use mceip_model::{Body, ModelError, MuFamily, Pencil, Problem, Unknown, Window};
use num_traits::{One, Zero};

/// Values of lambda^2 at or below this share of (lambda^2 + lowest frequency) are served by an
/// anchor at 0.
const NEAR_ZERO: f64 = 0.02;

/// Pieces of [0, infinity), at least.
const PIECES: usize = 16;

/// T0 and T1 over [0, infinity).
pub(in crate::analysis) struct HalfLineFamily {
    /// P0 and P1.
    pencils: [Pencil; 2],
    /// The same of the system in which particles with zero reaction are free, if there are such.
    tail_pencils: Option<[Pencil; 2]>,
    /// The radii of the data, where there are some.
    radii: Option<FamilyRadii>,
    /// The condensation of P0, its anchors moved to `left_friction`, and the pieces.
    prepared: Prepared,
    /// Of each anchor the expansions of T0 and T1; one pair where there are no free variables.
    expansions: Vec<[Expansion; 2]>,
    /// The anchors, each with V for P1.
    pub(super) left_friction: Vec<CriticalAnchor>,
    scales: RowScales,
    pub(in crate::analysis) pieces: Vec<PieceOfHalfLine>,
}

/// A value of lambda^2 about which condensation is to be precise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::analysis) struct PrecisePlace {
    pub(in crate::analysis) lambda2: f64,
    /// Its anchor is used within this share of lambda^2 + the lowest frequency.
    pub(in crate::analysis) near: f64,
}

impl PrecisePlace {
    /// The place about a value at which condensation was not precise enough with these places:
    /// nearer than each of them that reaches it. `scale` is [`unit_of_lambda2`].
    pub(in crate::analysis) fn sharper(
        places: &[PrecisePlace],
        lambda2: f64,
        scale: f64,
    ) -> PrecisePlace {
        let mut near = FIRST_NEAR;
        for place in places {
            if (place.lambda2 - lambda2).abs() <= place.near * (lambda2 + scale) {
                near = near.min(NEARER * place.near);
            }
        }

        PrecisePlace { lambda2, near }
    }
}

/// An interval of lambda^2 and the anchor that serves it.
pub(in crate::analysis) struct PieceOfHalfLine {
    pub(in crate::analysis) lo: Rational,
    /// `None` for infinity.
    pub(in crate::analysis) hi: Option<Rational>,
    pub(in crate::analysis) anchor: Option<usize>,
}

impl HalfLineFamily {
    /// Condenses both parts. `places` are values of lambda^2 about which the enclosure is to be
    /// tight; `friction` is at least the friction below which absence is to be proved.
    ///
    /// # Errors
    /// [`CompleteError`]: free variables that cannot be eliminated, too many slip variables.
    pub(in crate::analysis) fn new(
        families: &Families,
        friction: &Rational,
        places: &[PrecisePlace],
    ) -> Result<HalfLineFamily, CompleteError> {
        let pencils = parts_of(&families.own)?;
        let [without_friction, of_friction] = &pencils;
        let tail_pencils = if families.zero.is_empty() {
            None
        } else {
            Some(parts_of(families.of_condition())?)
        };
        let radii = families.radii.clone();
        let mut at_friction = at(tail_pencils.as_ref().unwrap_or(&pencils), friction)?;
        let least_free;
        let mut free = without_friction;
        if let Some(radii) = &radii {
            at_friction = radii.least_at(&pencils, &at_friction, friction)?;
            least_free = radii.least_free(without_friction)?;
            free = &least_free;
        }
        let definite = DefinitePencils {
            free,
            whole: &at_friction,
        };

        let body = Body::Pencil(without_friction.clone());
        let window = Window::all();
        let problem = Problem::new(body, Unknown::Lambda2, window.clone())?;
        let mut prepared = Prepared::of_family(&problem, without_friction, definite, PIECES)?;
        prepared.view.zero.clone_from(&families.zero);

        if prepared.is_expanded() {
            let near_zero = near_zero(&prepared);
            if places.iter().any(|place| place.lambda2 <= near_zero)
                && let Some(graded) = prepared
                    .clone()
                    .with_lower_anchor(&window, without_friction)
            {
                prepared = graded;
            }

            // Those that reach far first: the others are cut out of their pieces.
            let mut others: Vec<&PrecisePlace> =
                places.iter().filter(|p| p.lambda2 > near_zero).collect();
            others.sort_by(|p, q| q.near.total_cmp(&p.near));
            for place in others {
                let values = [place.lambda2];
                prepared.refine_within(place.near, &window, without_friction, &values);
            }
        }
        let scales = RowScales::of(&pencils, radii.as_ref())?;

        let mut expansions = Vec::new();
        let mut left_friction = Vec::new();
        match &mut prepared.condensation {
            None => {
                let view = View::of(of_friction);
                expansions.push([
                    prepared.view.expansion(None).clone(),
                    view.expansion(None).clone(),
                ]);
            }
            Some(condensation) => {
                let first = &prepared.view.expansions;
                for (anchor, pair) in with_friction_part(of_friction, condensation, first)? {
                    expansions.push(pair);
                    left_friction.push(anchor);
                }
            }
        }

        let mut expansions: Vec<[Expansion; 2]> = expansions
            .into_iter()
            .map(|pair| scales.applied_to(pair))
            .collect();

        let pieces = pieces_of(&prepared);
        if let Some(radii) = &radii {
            for (number, pair) in expansions.iter_mut().enumerate() {
                let factors = scales.factors(pair[0].reversed);
                let Some(anchor) = left_friction.get(number) else {
                    radii.spread_linear(pair, factors);
                    continue;
                };
                let names_it = |piece: &&PieceOfHalfLine| piece.anchor == Some(number);
                let served: Vec<&PieceOfHalfLine> = pieces.iter().filter(names_it).collect();
                radii.spread_about(pair, anchor, &served, factors);
            }
        }
        Ok(HalfLineFamily {
            pencils,
            tail_pencils,
            radii,
            prepared,
            expansions,
            left_friction,
            scales,
            pieces,
        })
    }

    /// Can an anchor about this place be added to those there are? Not where one at 0 serves it, or
    /// where the radii of the data count, which are those of what each anchor serves.
    pub(super) fn can_add(&self, place: &PrecisePlace) -> bool {
        let is_served_at_zero = place.lambda2 <= near_zero(&self.prepared);
        self.radii.is_none() && (!self.prepared.is_expanded() || !is_served_at_zero)
    }

    /// Adds an anchor about a place, and cuts its piece out of those there are.
    ///
    /// # Errors
    /// As [`HalfLineFamily::new`].
    pub(super) fn add(&mut self, place: &PrecisePlace) -> Result<(), CompleteError> {
        if !self.prepared.is_expanded() {
            return Ok(());
        }

        let [without_friction, of_friction] = &self.pencils;
        let before = self.prepared.view.expansions.len();
        let window = Window::all();
        let values = [place.lambda2];
        self.prepared
            .refine_within(place.near, &window, without_friction, &values);

        let added = &self.prepared.view.expansions[before..];
        if let Some(condensation) = &mut self.prepared.condensation {
            for (anchor, pair) in with_friction_part(of_friction, condensation, added)? {
                self.expansions.push(self.scales.applied_to(pair));
                self.left_friction.push(anchor);
            }
        }

        self.pieces = pieces_of(&self.prepared);
        Ok(())
    }

    /// The measure of lambda^2: theta = t / (scale + t).
    pub(in crate::analysis) fn view(&self) -> &View {
        &self.prepared.view
    }

    /// The expansions of T0 and T1 for a piece with this anchor.
    pub(in crate::analysis) fn expansions(&self, anchor: Option<usize>) -> &[Expansion; 2] {
        let named = anchor.and_then(|k| self.expansions.get(k));
        named.unwrap_or(&self.expansions[0])
    }

    /// The anchor of the piece that holds a value of lambda^2.
    pub(in crate::analysis) fn anchor(&self, t: f64) -> Option<usize> {
        let holds = |hi: &Option<_>| hi.as_ref().is_none_or(|hi| t < to_f64(hi));
        let piece = self.pieces.iter().find(|piece| holds(&piece.hi));
        piece.and_then(|piece| piece.anchor)
    }

    /// What the slip rows of the pencils as given are multiplied by about a value.
    pub(super) fn row_factors(&self, t: f64) -> &[f64] {
        let [first, _] = self.expansions(self.anchor(t));
        self.scales.factors(first.reversed)
    }

    /// T1 x of a solution, rows scaled as those of the expansions.
    pub(super) fn friction_part_times(&self, point: &BranchPoint) -> Vec<f64> {
        let [_, second] = self.expansions(self.anchor(point.t));
        times(&second.at(point.t), &point.x)
    }

    /// Is the last piece closed by a tail?
    pub(super) fn has_tail(&self) -> bool {
        let condensation = self.prepared.condensation.as_ref();
        condensation.is_some_and(|c| c.tail.is_some())
    }

    /// T0 and T1 at a value, by solving with T_ff there, rows scaled as those of the expansions.
    #[cfg(test)]
    pub(super) fn direct(&self, value: f64) -> [Vec<Vec<f64>>; 2] {
        let exact = mceip_exact::from_f64(value).unwrap_or_default();
        self.pencils.each_ref().map(|pencil| {
            let at_value = pencil.a().add_scaled(&exact, pencil.b());
            let free = pencil.free();
            let slip = pencil.slip();
            let block = |rows: &[usize], columns: &[usize]| {
                crate::dense::rounded(&at_value.submatrix(rows, columns))
            };

            let columns = crate::dense::rounded(&at_value.submatrix(free, &slip).transpose());
            let solved = mceip_mcp::linear::solve(&block(free, free), &columns).unwrap_or_default();
            let rows = block(&slip, free);
            let mut condensed = block(&slip, &slip);
            for (i, row) in condensed.iter_mut().enumerate() {
                let constant = &self.pencils[0];
                let slope = &self.pencils[1];
                let factor = to_f64(&common_row_factor(&[constant, slope], &[], slip[i]));
                for (j, entry) in row.iter_mut().enumerate() {
                    let products = rows[i].iter().zip(&solved[j]);
                    let eliminated: f64 = products.map(|(a, b)| a * b).sum();
                    *entry = factor * (*entry - eliminated);
                }
            }

            condensed
        })
    }

    /// Multiplies all remainders by a factor, because rounding errors of their computation in
    /// doubles are not part of them.
    pub(super) fn enlarge_remainders(&mut self, factor: f64) {
        for expansion in self.expansions.iter_mut().flatten() {
            expansion.caution *= factor;
        }
    }

    /// The condensation of a certificate of absence for these frictions; `None` where there are no
    /// free variables, or the tail does not hold at both.
    pub(super) fn condensation(&self, frictions: [&Rational; 2]) -> Option<CriticalCondensation> {
        let condensation = self.prepared.condensation.as_ref()?;
        let tail = match &condensation.tail {
            Some(tail) => Some(self.tail(&tail.from.0, frictions)?),
            None => None,
        };

        self.condensation_with(self.left_friction.clone(), tail)
    }

    /// The condensation of a certificate that names these anchors only, without a tail.
    pub(in crate::analysis) fn condensation_about(
        &self,
        anchors: &[usize],
    ) -> Option<CriticalCondensation> {
        let anchors = anchors.iter().map(|&k| self.left_friction[k].clone());
        self.condensation_with(anchors.collect(), None)
    }

    fn condensation_with(
        &self,
        anchors: Vec<CriticalAnchor>,
        tail: Option<CriticalTail>,
    ) -> Option<CriticalCondensation> {
        let condensation = self.prepared.condensation.as_ref()?;
        Some(CriticalCondensation {
            sigma: condensation.sigma.clone(),
            stiffness_factor: condensation.stiffness_factor.clone(),
            mass_sigma: condensation.mass_sigma.clone(),
            mass_factor: condensation.mass_factor.clone(),
            anchors,
            tail,
        })
    }

    /// The evidence that the symmetric part is definite from a value on, at both frictions.
    fn tail(&self, value: &Rational, [from, below]: [&Rational; 2]) -> Option<CriticalTail> {
        let pencils = self.tail_pencils.as_ref().unwrap_or(&self.pencils);
        let at_from = self.least_at(pencils, from)?;
        let at_below = self.least_at(pencils, below)?;
        Some(CriticalTail {
            from: Number(value.clone()),
            factor: definite_at(&at_from, value)?,
            factor_below: definite_at(&at_below, value)?,
            mass_factor: semidefinite(at_from.b())?,
            mass_factor_below: semidefinite(at_below.b())?,
        })
    }

    /// A pencil whose symmetric part is at most that of each member at a friction.
    fn least_at(&self, pencils: &[Pencil; 2], friction: &Rational) -> Option<Pencil> {
        let given = at(pencils, friction).ok()?;
        match &self.radii {
            None => Some(given),
            Some(radii) => radii.least_at(pencils, &given, friction).ok(),
        }
    }
}

/// Values of lambda^2 up to this are served by an anchor at 0.
fn near_zero(prepared: &Prepared) -> f64 {
    NEAR_ZERO * prepared.lowest_frequency
}

/// Each anchor of a condensation of P0 with V for P1, and the expansions of both parts about it.
/// `first` are those of P0.
///
/// The matrices of a large body take most of the memory: they are moved.
fn with_friction_part(
    of_friction: &Pencil,
    condensation: &mut Condensation,
    first: &[Expansion],
) -> Result<Vec<(CriticalAnchor, [Expansion; 2])>, CompleteError> {
    let beside = beside(of_friction, condensation).ok_or(CompleteError::NotDefinite {
        what: "A_ff + t B_ff",
        index: of_friction.free()[0],
    })?;

    let anchors = std::mem::take(&mut condensation.anchors).into_iter();
    let mut pairs = Vec::with_capacity(first.len());
    for ((anchor, first), second) in anchors.zip(first).zip(beside) {
        let anchor = CriticalAnchor {
            center: anchor.center,
            reversed: anchor.reversed,
            right: anchor.right,
            // In the pencil of mu = 0 T_sf' is T_fs.
            left: None,
            left_friction: second.left,
        };
        pairs.push((anchor, [first.clone(), second.expansion]));
    }

    Ok(pairs)
}

/// A value of lambda^2 on whose scale T changes: the lowest frequency of the free variables, or
/// without any the ratio of K* and M*.
pub(in crate::analysis) fn unit_of_lambda2(family: &MuFamily) -> Result<f64, CompleteError> {
    let [constant, _] = parts_of(family)?;
    if constant.free().is_empty() {
        return Ok(View::of(&constant).scale);
    }

    let blocks = PencilBlocks::of(&constant);
    let factor = blocks.factor_at(0.0);
    let factor = factor.ok_or(CompleteError::NotDefinite {
        what: "A_ff",
        index: constant.free()[0],
    })?;

    Ok(blocks.lowest_frequency(&factor))
}

/// The pencils in t of mu = 0 and of the coefficients of mu; the second one has the free rows of
/// the first.
pub(in crate::analysis) fn parts_of(family: &MuFamily) -> Result<[Pencil; 2], ModelError> {
    let stiffness = &family.stiffness;
    let mass = family.mass.as_ref().ok_or(ModelError::Missing {
        equation: "E12",
        what: "mass",
        unknown: Unknown::Lambda2.word(),
    })?;
    let free = stiffness.free().to_vec();
    let constant = Pencil::new(stiffness.a().clone(), mass.a().clone(), free.clone())?;

    let one = Rational::one();
    let of_stiffness = stiffness
        .b()
        .add_scaled(&one, &only_rows(stiffness.a(), &free));
    let of_mass = mass.b().add_scaled(&one, &only_rows(mass.a(), &free));
    let slope = Pencil::new(of_stiffness, of_mass, free)?;
    Ok([constant, slope])
}

/// A matrix with all rows zero but these.
fn only_rows(matrix: &Sparse, rows: &[usize]) -> Sparse {
    let mut entries = Vec::new();
    for &i in rows {
        for (j, v) in matrix.row(i) {
            entries.push((i, *j, v.clone()));
        }
    }

    Sparse::from_entries(matrix.rows(), matrix.cols(), entries)
}

/// The pencil in t at a friction.
fn at([constant, slope]: &[Pencil; 2], friction: &Rational) -> Result<Pencil, ModelError> {
    let free = constant.free().to_vec();
    let slip = slope.slip();
    let stiffness = only_rows(slope.a(), &slip);
    let mass = only_rows(slope.b(), &slip);
    let a = constant.a().add_scaled(friction, &stiffness);
    let b = constant.b().add_scaled(friction, &mass);
    Pencil::new(a, b, free)
}

/// What turns the rows of the expansions, each scaled by its own pencil, into rows with one common
/// scale.
struct RowScales {
    direct: PartScales,
    reversed: PartScales,
}

/// Factors of rows by position.
struct PartScales {
    /// What the rows of T0 and T1 are multiplied by, which have a scale of their own.
    of_parts: [Vec<f64>; 2],
    /// What the rows of the pencils as given are multiplied by.
    common: Vec<f64>,
}

impl RowScales {
    /// `radii` count where denominators are cleared.
    fn of(pencils: &[Pencil; 2], radii: Option<&FamilyRadii>) -> Result<RowScales, CompleteError> {
        let [constant, slope] = pencils;
        let reversed = [exchanged(constant)?, exchanged(slope)?];

        let radii: Vec<&Pencil> = radii.into_iter().flat_map(|r| &r.pencils).collect();
        Ok(RowScales {
            direct: PartScales::of(&[constant, slope], &radii),
            reversed: PartScales::of(&[&reversed[0], &reversed[1]], &radii),
        })
    }

    /// What the rows of the pencils as given are multiplied by.
    fn factors(&self, reversed: bool) -> &[f64] {
        if reversed {
            &self.reversed.common
        } else {
            &self.direct.common
        }
    }

    fn applied_to(&self, [first, second]: [Expansion; 2]) -> [Expansion; 2] {
        let scales = if first.reversed {
            &self.reversed.of_parts
        } else {
            &self.direct.of_parts
        };

        [
            first.with_rows_times(&scales[0]),
            second.with_rows_times(&scales[1]),
        ]
    }
}

impl PartScales {
    fn of(pencils: &[&Pencil; 2], radii: &[&Pencil]) -> PartScales {
        let slip = pencils[0].slip().into_iter();
        let common: Vec<Rational> = slip.map(|i| common_row_factor(pencils, radii, i)).collect();
        let of_part = |pencil: &Pencil| {
            let slip = pencil.slip().into_iter().zip(&common);
            slip.map(|(i, common)| to_f64(&(common / row_factor(pencil, i))))
                .collect()
        };

        PartScales {
            of_parts: pencils.map(of_part),
            common: common.iter().map(to_f64).collect(),
        }
    }
}

fn pieces_of(prepared: &Prepared) -> Vec<PieceOfHalfLine> {
    let mut pieces = Vec::new();
    let mut lo = Rational::zero();
    for interval in &prepared.intervals {
        pieces.push(PieceOfHalfLine {
            lo: lo.clone(),
            hi: interval.max.clone(),
            anchor: interval.anchor,
        });
        lo = interval.max.clone().unwrap_or(lo);
    }

    pieces
}
