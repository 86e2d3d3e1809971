//! The proof that no solution is near a reported one, or the one that is, by exact enumeration.
//!
//! All solutions with a value near the reported one ([`Candidate::near`]) are enumerated (24)-(26)
//! over all supports. If none has x within [`X_RADIUS`] at largest |x_i| = 1 ([`distance`]), the
//! report is refuted. The cost grows as 2^n, so only small pencils are treated, and a report as a
//! whole has a limited [`Effort`].
//!
//! Called by [`judge`](super::judge) for a point that could not be certified.

use super::singular::has_singular_support;
use super::verdict::{Examined, Refutation};
use crate::candidate::{Candidate, distance, scaled};
use crate::tolerance::{DISTANCE_ROUNDING, X_RADIUS};
use mceip_exact::to_f64;
use mceip_model::reduction::reduce_system;
use mceip_model::{Body, Pencil, Problem, Reduced, Window};
use mceip_oracle::{
    Enumeration, MAX_FREE, ModeList, Solution, coefficient_bits, enumerate, enumerate_modes,
};

/// Most complementarity variables for which absence near a candidate is proved by enumeration.
pub const REFUTE_SLIP: usize = 10;

/// What a support whose determinant vanishes identically holds is described by its minors, of which
/// there are up to 2^order: with such supports an enumeration costs 2^(order + 4) times as much.
const SINGULAR_SHIFT: u64 = 4;

/// What may still be enumerated for the points of one report, in products of words
/// (spec/formats.md, mceip-solutions/1).
#[derive(Debug)]
pub struct Effort {
    left: u64,
}

impl Default for Effort {
    /// That of a report: a few seconds.
    fn default() -> Effort {
        Effort { left: 1 << 30 }
    }
}

impl Effort {
    /// Takes the cost of one enumeration of a pencil from what is left.
    fn spend(&mut self, pencil: &Pencil) -> Result<(), String> {
        let indices = pencil.slip();
        let slip = indices.len() as u64;
        let free = pencil.free().len() as u64;
        let mut cost = enumeration_cost(slip, free, coefficient_bits(pencil));
        if has_singular_support(pencil, &indices) {
            cost = cost.saturating_mul(1 << (slip + SINGULAR_SHIFT));
        }

        self.take(cost)
    }

    /// The same for the enumeration of modes of a split form: each choice of modes is a support,
    /// and those that are singular are not described.
    fn spend_on_modes(&mut self, pencil: &Pencil) -> Result<(), String> {
        let slip = pencil.slip().len() as u64;
        let free = pencil.free().len() as u64;
        self.take(enumeration_cost(slip, free, coefficient_bits(pencil)))
    }

    fn take(&mut self, cost: u64) -> Result<(), String> {
        let Some(left) = self.left.checked_sub(cost) else {
            return Err(format!(
                "absence is proved with at most {} products of words more in this report, {cost} \
                 were needed (`mceip certify` goes further)",
                self.left
            ));
        };
        self.left = left;
        Ok(())
    }
}

/// Sum over all supports of m^5 (words^2 + 3), m the order of the block: Bareiss's elimination
/// takes m^3 products of polynomials with up to m coefficients, each of so many words, and a
/// product of short numbers costs as much as three products of words besides. A determinant of
/// order m has its share of the `bits` of the largest.
fn enumeration_cost(slip: u64, free: u64, bits: u64) -> u64 {
    let order = (slip + free).max(1);
    let mut supports: u64 = 1; // of k variables
    let mut cost: u64 = 0;

    for k in 0..=slip {
        let m = free + k;
        let words = 1 + bits.saturating_mul(m) / (64 * order);
        let cost_of_product = words.saturating_mul(words).saturating_add(3);
        let cost_of_support = m.saturating_pow(5).saturating_mul(cost_of_product);

        cost = cost.saturating_add(supports.saturating_mul(cost_of_support));
        supports = supports.saturating_mul(slip - k) / (k + 1);
    }

    cost
}

/// What an enumeration says of a candidate.
pub(super) enum EnumerationAnswer {
    /// Nothing is near.
    Refuted(Refutation),
    /// The nearest solution, in doubles.
    Near(Candidate),
}

/// Proves that nothing is near a candidate, or finds what is, or says why neither was done.
pub(super) fn refute(
    problem: &Problem,
    reduced: &Reduced,
    candidate: &Candidate,
    effort: &mut Effort,
) -> Result<EnumerationAnswer, String> {
    let near = candidate.values_near(problem.window());
    let [lo, hi] = near.ok_or("its value is no finite number")?;
    let Ok(near) = Window::new(lo.clone(), Some(hi.clone())) else {
        return Ok(EnumerationAnswer::Refuted(Refutation::OutsideWindow {
            value: candidate.value,
            window: problem.real_window(),
        }));
    };
    let slip = reduced.pencil.slip();
    if slip.len() > REFUTE_SLIP || reduced.pencil.free().len() > MAX_FREE {
        return Err(format!(
            "`mceip check` proves absence for at most {REFUTE_SLIP} slip and {MAX_FREE} free \
             variables (`mceip certify` for more)"
        ));
    }

    let normalised = reduced.normalised();
    let (found, supports) = if normalised == slip {
        effort.spend(&reduced.pencil)?;
        let found = enumerate(&reduced.pencil, &near).map_err(|e| e.to_string())?;
        let supports = found.supports_total;
        (Enumerations::Supports(found), supports)
    } else {
        effort.spend_on_modes(&reduced.pencil)?;
        let found = modes(problem, &near)?;
        let choices = found.choices;
        (Enumerations::Modes(found), choices)
    };

    if let Some((solution, nearest)) = nearest(found.solutions(), &normalised, candidate) {
        return if candidate.has_support(&slip, &solution.slip) {
            Ok(EnumerationAnswer::Near(nearest))
        } else {
            Err(OTHER_SUPPORT.into())
        };
    }
    let others = found.others(candidate, &normalised)?;
    let nothing = Refutation::NothingNear(Examined {
        lo: to_f64(&lo),
        hi: to_f64(&hi),
        supports,
        others,
    });
    Ok(EnumerationAnswer::Refuted(nothing))
}

/// All that an enumeration finds in a window.
enum Enumerations {
    /// By supports (24)-(26).
    Supports(Enumeration),
    /// By modes, for a system with particles in contact with zero reaction
    /// (`spec/zero-reaction.md`, Z.3).
    Modes(ModeList),
}

/// Not all that there is in the window is described.
const NOT_DESCRIBED: &str = "the answer near the value has parts that are not described";
/// A solution is near, and which components are positive tells it from the candidate.
const OTHER_SUPPORT: &str = "a solution is near, with other positive components";
/// There are solutions that the candidate could stand for.
const NOT_TOLD_APART: &str = "a cone of solutions is near, of which the report may be one";

impl Enumerations {
    fn solutions(&self) -> &[Solution] {
        match self {
            Enumerations::Supports(found) => &found.solutions,
            Enumerations::Modes(found) => &found.solutions,
        }
    }

    /// How many there are, if all are described and no cone or range of them may hold the
    /// candidate.
    fn others(&self, candidate: &Candidate, slip: &[usize]) -> Result<usize, String> {
        let found = match self {
            Enumerations::Modes(found) if found.degenerate.is_empty() => {
                return Ok(found.solutions.len());
            }
            Enumerations::Supports(found) if found.is_complete_list() => found,
            _ => return Err(NOT_DESCRIBED.into()),
        };

        let cones = found.cones.iter().map(|cone| &cone.slip);
        let ranges = found.ranges.iter().map(|range| &range.support);
        for support in cones.chain(ranges) {
            if is_allowed(candidate, slip, support) {
                return Err(NOT_TOLD_APART.into());
            }
        }

        Ok(found.solutions.len() + found.cones.len() + found.ranges.len())
    }
}

/// The enumeration of modes near a value.
fn modes(problem: &Problem, near: &Window) -> Result<ModeList, String> {
    let Body::System(system) = problem.body() else {
        return Err("only a system has particles".into());
    };

    let split = reduce_system(system, problem.unknown()).map_err(|e| e.to_string())?;
    Ok(enumerate_modes(&split, near))
}

/// The solution whose x is nearest to the candidate's, if it is within [`X_RADIUS`], and its
/// numbers in doubles.
fn nearest<'a>(
    solutions: &'a [Solution],
    slip: &[usize],
    candidate: &Candidate,
) -> Option<(&'a Solution, Candidate)> {
    let mut nearest = None;
    // Rounding must not make a refutation of a distance that is the radius itself.
    let mut least = X_RADIUS + DISTANCE_ROUNDING;
    for solution in solutions {
        // A decimal that is printed by the oracle can be read.
        let x = solution.x_decimals(slip, 17);
        let x: Vec<f64> = x
            .iter()
            .filter_map(|decimal| decimal.parse().ok())
            .collect();
        let distance = distance(&x, &candidate.x);
        if distance <= least
            && let Ok(value) = solution.decimal(17).parse()
        {
            least = distance;
            nearest = Some((solution, Candidate { value, x }));
        }
    }

    nearest
}

/// Is x >= 0 on the support and x = 0 off it among the slip variables, up to [`X_RADIUS`] at
/// largest |x_i| = 1?
fn is_allowed(candidate: &Candidate, slip: &[usize], support: &[usize]) -> bool {
    let Some(x) = scaled(&candidate.x) else {
        return false;
    };

    slip.iter().all(|i| {
        if support.contains(i) {
            x[*i] >= -X_RADIUS
        } else {
            x[*i].abs() <= X_RADIUS
        }
    })
}
