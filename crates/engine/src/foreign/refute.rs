//! The proof that no solution is near a reported one, by exact enumeration.
//!
//! All solutions with a value within [`VALUE_RADIUS`] of the reported one are enumerated (24)-(26)
//! over all supports. If none has x within [`X_RADIUS`], the report is refuted. The cost grows as
//! 2^n, so only small pencils are treated, and a report as a whole has a limited [`Effort`].
//!
//! Called by [`judge`](super::judge) for a point that could not be certified.

use super::singular::has_singular_support;
use super::verdict::Refutation;
use crate::candidate::Candidate;
use crate::reduction::Reduced;
use crate::tolerance::{VALUE_RADIUS, X_RADIUS};
use mceip_exact::{Rational, from_f64, to_f64};
use mceip_model::reduction::split_form;
use mceip_model::{Body, Pencil, Problem, Window};
use mceip_oracle::{Enumeration, MAX_FREE, Solution, coefficient_bits, enumerate, enumerate_modes};

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
                 were needed (see mceip complete)",
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

/// Proves that nothing is near a candidate, or says why that was not proved.
pub(super) fn refute(
    problem: &Problem,
    reduced: &Reduced,
    candidate: &Candidate,
    effort: &mut Effort,
) -> Result<Refutation, String> {
    let (lo, hi) = values_near(problem.window(), candidate.value)?;
    let Ok(near) = Window::new(lo.clone(), Some(hi.clone())) else {
        return Ok(Refutation::OutsideWindow {
            value: candidate.value,
            window: problem.window().to_string(),
        });
    };
    let slip = reduced.pencil.slip();
    if slip.len() > REFUTE_SLIP || reduced.pencil.free().len() > MAX_FREE {
        return Err(format!(
            "absence is proved for at most {REFUTE_SLIP} slip and {MAX_FREE} free variables"
        ));
    }

    let normalised = reduced.normalised();
    let scaled = ScaledX::of(candidate, &normalised);
    let others = if normalised == slip {
        effort.spend(&reduced.pencil)?;
        others_by_supports(&reduced.pencil, &near, &scaled)?
    } else {
        effort.spend_on_modes(&reduced.pencil)?;
        others_by_modes(problem, &near, &scaled)?
    };

    let others_text = match others.count {
        0 => "there is none at all".to_string(),
        n => format!("{n} found with another x"),
    };
    Ok(Refutation::NothingNear {
        lo: to_f64(&lo),
        hi: to_f64(&hi),
        x_radius: X_RADIUS,
        supports: others.supports,
        others: others_text,
    })
}

/// What there is in a window, none of it near a candidate.
struct Others {
    count: usize,
    /// Supports, or choices of modes, examined.
    supports: u64,
}

/// Not all that there is in the window is described.
const NOT_DESCRIBED: &str = "the answer near the value has parts that are not described";
/// There is a solution that the candidate could stand for.
const NOT_TOLD_APART: &str = "a solution is near, but not near enough to be told from others";

/// All solutions in a window by the enumeration of supports (24)-(26).
fn others_by_supports(
    pencil: &Pencil,
    near: &Window,
    scaled: &ScaledX<'_>,
) -> Result<Others, String> {
    let found = enumerate(pencil, near).map_err(|e| e.to_string())?;
    if !found.is_complete_list() {
        return Err(NOT_DESCRIBED.into());
    }
    if scaled.is_near_any(&found) {
        return Err(NOT_TOLD_APART.into());
    }

    Ok(Others {
        count: found.solutions.len() + found.cones.len() + found.ranges.len(),
        supports: found.supports_total,
    })
}

/// The same for a system with particles in contact with zero reaction, by the enumeration of modes
/// (`spec/zero-reaction.md`, Z.3).
fn others_by_modes(
    problem: &Problem,
    near: &Window,
    scaled: &ScaledX<'_>,
) -> Result<Others, String> {
    let Body::System(system) = problem.body() else {
        return Err("only a system has particles".into());
    };

    let split = split_form(system, problem.unknown()).map_err(|e| e.to_string())?;
    let found = enumerate_modes(&split, near);
    if !found.degenerate.is_empty() {
        return Err(NOT_DESCRIBED.into());
    }
    if found.solutions.iter().any(|one| scaled.is_near(one)) {
        return Err(NOT_TOLD_APART.into());
    }

    Ok(Others {
        count: found.solutions.len(),
        supports: found.choices,
    })
}

/// The ends of the values near a reported one that lie in the window; the lower end is above the
/// upper one where there are none.
fn values_near(window: &Window, value: f64) -> Result<(Rational, Rational), String> {
    let radius = VALUE_RADIUS * (1.0 + value.abs());
    let lo = exact(value - radius)?.max(window.min().clone());
    let mut hi = exact(value + radius)?;
    if let Some(max) = window.max() {
        hi = hi.min(max.clone());
    }

    Ok((lo, hi))
}

fn exact(v: f64) -> Result<Rational, String> {
    from_f64(v).map_err(|_| "its value is no finite number".to_string())
}

/// The x of a candidate in the two scales of enumerated solutions.
struct ScaledX<'a> {
    slip: &'a [usize],
    /// e'x_s = 1 where that sum is positive, else l1 norm 1.
    by_slip: Vec<f64>,
    /// l1 norm 1.
    by_l1: Vec<f64>,
}

impl<'a> ScaledX<'a> {
    fn of(candidate: &Candidate, slip: &'a [usize]) -> ScaledX<'a> {
        let l1_norm: f64 = candidate.x.iter().map(|v| v.abs()).sum();
        let slip_sum: f64 = slip.iter().map(|&i| candidate.x[i]).sum();
        let slip_scale = if slip_sum > 0.0 { slip_sum } else { l1_norm };

        let mut scaled = ScaledX {
            slip,
            by_slip: Vec::new(),
            by_l1: Vec::new(),
        };
        for component in &candidate.x {
            scaled.by_slip.push(component / slip_scale);
            scaled.by_l1.push(component / l1_norm);
        }

        scaled
    }

    /// Could one of these solutions be the candidate, by its x? Cones and ranges: wherever their
    /// supports allow it.
    fn is_near_any(&self, found: &Enumeration) -> bool {
        found.solutions.iter().any(|one| self.is_near(one))
            || found.cones.iter().any(|cone| self.is_allowed(&cone.slip))
            || found
                .ranges
                .iter()
                .any(|range| self.is_allowed(&range.support))
    }

    /// Does every component agree with that of the solution up to [`X_RADIUS`]?
    fn is_near(&self, solution: &Solution) -> bool {
        let ours = if solution.is_free_only() {
            &self.by_l1
        } else {
            &self.by_slip
        };
        let theirs = solution.x_decimals(self.slip, 17);
        for (decimal, our) in theirs.iter().zip(ours) {
            // A decimal that is printed by the oracle can be read.
            let their = decimal.parse::<f64>().unwrap_or(f64::NAN);
            let is_close = (their - our).abs() <= X_RADIUS;
            if !is_close {
                return false;
            }
        }

        true
    }

    /// Is x >= 0 on the support and x = 0 off it, up to [`X_RADIUS`] in the scale in which a
    /// component is smaller?
    fn is_allowed(&self, support: &[usize]) -> bool {
        for &i in self.slip {
            let modulus = self.by_slip[i].abs().min(self.by_l1[i].abs());
            let x = modulus.copysign(self.by_slip[i]);
            let is_allowed = if support.contains(&i) {
                x >= -X_RADIUS
            } else {
                modulus <= X_RADIUS
            };
            if !is_allowed {
                return false;
            }
        }

        true
    }
}
