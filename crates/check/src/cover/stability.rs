//! Stability on an interval of friction (`mceip-stability/1`).
//!
//! At lambda^2 = 0 the pencil of the admissible motions is A0 + mu [0; R] with the mass
//! M0 + mu [0; M1], where R and M1 stand in the slip rows. With K_ff, K_fs, K_sf, K_ss the blocks
//! of A0 and T(mu) the Schur complement on the slip variables, the theorem of `spec/stability.md`
//! asks for a symmetric Q and for b >= 0 with
//!
//! ```text
//!     Q_ij <= T(mu)_ij - theta_i,    b_i >= mu a_i + rho_i,    Q - b b' / 4 strictly copositive.
//! ```
//!
//! a_i^2 = C_i K_ff^-1 C_i' with C = R_f - G K_ff bounds what the vibration of the free degrees of
//! freedom does to the friction of particle i. G is any matrix: G M_ff close to (M1)_f keeps
//! E = M1 - G M_f small, the part of the accelerations that is left, and theta and rho with it.
//! Here Q - b b' / 4 has to be positive definite.
//!
//! The certificate shows this at both ends of an interval. Between them the same combinations of
//! both Q and of both b will do: T - theta and the bounds of b are linear in mu, and b b' is
//! convex.
//!
//! Input: the parts of the pencil, with the mass and without. T at both ends is the enclosure that
//! all leaves use (`context`), with one anchor at 0.

use super::condensed::{self, AnchorPolynomials, FreeBounds, PencilParts};
use super::context::Context;
use super::ends::{EndMatrix, largest_bits};
use super::fault::CoverFault;
use super::psd::{SymmetricRows, semidefinite};
use super::region::Region;
use super::{check_size, family::row_bits};
use crate::certificate::{
    IntegerMatrix, IntegerRow, StabilityCertificate, StabilityCondensation, StabilityEnd,
};
use crate::pencil::{FrictionParts, Row};
use crate::reason::Reason;
use mceip_exact::{Integer, Rational};
use mceip_model::Window;
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Largest binary exponent of a matrix.
const MAX_EXPONENT: u32 = 1 << 12;
/// Bits that the entries of the pencil, brought to one denominator, may take together; and so those
/// of the rows of friction less G times the free rows.
const MAX_LIFTED_BITS: u64 = 1 << 31;

/// The ends of the interval of friction, as messages name them.
const ENDS: [&str; 2] = ["lower", "upper"];

/// Checks the obligations of a certificate of this problem, whose interval is one.
///
/// `parts` are those of the pencil with its mass, `massless` those with a mass of zero.
pub(crate) fn check(
    parts: &FrictionParts,
    massless: &FrictionParts,
    certificate: &StabilityCertificate,
) -> Result<(), Reason> {
    let zero = Rational::zero();
    let both = [&massless.plain, &massless.friction];
    let massless_parts = PencilParts::exact(&both);
    let slip = massless.plain.complementarity_variables().len();
    let free = massless.plain.order() - slip;
    check_size(slip, both.len())?;

    let condensation = certificate.condensation.as_ref();
    let expected = free > 0;
    if condensation.is_some() != expected {
        return Err(CoverFault::Condensation { expected }.into());
    }

    let anchors = match condensation {
        None => None,
        Some(condensation) => {
            let (bounds, anchor) = at_zero(condensation, &zero);
            Some(condensed::with_anchors(
                massless_parts,
                bounds,
                vec![anchor],
            )?)
        }
    };

    let pencil = MotionPencil::of(parts, free)?;
    pencil.check_mass(certificate)?;
    let work = FreeWork::of(&pencil, certificate)?;

    let window = Window::all();
    let mut context = Context::new(massless_parts, anchors.as_ref(), &window, 1);
    context.use_anchor(anchors.as_ref(), anchors.as_ref().map(|_| 0))?;
    let friction = [&certificate.from, &certificate.to];
    let at_rest = Rc::new(Rational::zero());
    let region = Region::new(
        Rc::clone(&at_rest),
        Some(at_rest),
        Some(friction.map(|mu| Rc::new(mu.clone()))),
        slip,
    );
    context.affordable(&region)?;
    let of_friction = context.ends(&region)?;

    let scaled_by = row_bits(&both).into_iter().zip(&massless.plain.factor);
    let row_units: Vec<Rational> = scaled_by
        .skip(free)
        .map(|(bits, factor)| Rational::new(Integer::one() << bits, factor.clone()))
        .collect();

    for (number, end) in [&certificate.lower, &certificate.upper].iter().enumerate() {
        let mu = friction[number];
        let [at_mu, _] = of_friction[number].corners([ENDS[number]; 2]);
        check_shape(end, slip)?;
        check_below(end, &at_mu, &row_units, &work.lost(mu))?;
        check_bounds(end, ENDS[number], mu, &work)?;
        check_definite(end)?;
    }

    Ok(())
}

/// The hypotheses and the one anchor of a condensation at t = 0, for the plain part and for that of
/// friction.
fn at_zero<'a>(
    condensation: &'a StabilityCondensation,
    zero: &'a Rational,
) -> (FreeBounds<'a>, Vec<AnchorPolynomials<'a>>) {
    let bounds = FreeBounds {
        sigma: &condensation.sigma.0,
        stiffness_factor: &condensation.stiffness_factor,
        tau: zero,
        mass_factor: None,
    };
    let anchor = |left: Option<&'a IntegerMatrix>| AnchorPolynomials {
        center: zero,
        reversed: false,
        right: std::slice::from_ref(&condensation.right),
        left: left.map(std::slice::from_ref),
    };

    let parts = vec![anchor(None), anchor(Some(&condensation.left_friction))];
    (bounds, parts)
}

/// The pencil of the admissible motions, all rows in units of 1 / `common`; the free variables come
/// first.
struct MotionPencil {
    free: usize,
    common: Integer,
    /// Bits of an entry, at most.
    entry_bits: u64,
    /// A0 and M0.
    plain: Vec<Row>,
    /// R and M1, by slip variables.
    friction: Vec<Row>,
}

impl MotionPencil {
    fn of(parts: &FrictionParts, free: usize) -> Result<MotionPencil, CoverFault> {
        let rows = [&parts.plain.rows, &parts.friction.rows];
        let is_some = |(_, a, b): &&(usize, Integer, Integer)| !(a.is_zero() && b.is_zero());
        let entries = || rows.into_iter().flatten().flatten().filter(is_some);
        let count = 2 * entries().count() as u64;
        let longest = largest_bits(entries().flat_map(|(_, a, b)| [a, b]));

        let mut common = Integer::one();
        for factor in &parts.plain.factor {
            common = common.lcm(factor);
            let all_bits = count.saturating_mul(longest + common.bits());
            CoverFault::at_most("bits of the pencil", MAX_LIFTED_BITS, all_bits)?;
        }

        let lifted = |rows: &[Row], first: usize| {
            let factors = parts.plain.factor[first..].iter();
            let rows = rows[first..].iter().zip(factors);
            let row = |(row, factor): (&Row, &Integer)| {
                let lift = &common / factor;
                row.iter()
                    .map(|(j, a, b)| (*j, a * &lift, b * &lift))
                    .collect()
            };
            rows.map(row).collect()
        };

        Ok(MotionPencil {
            free,
            plain: lifted(&parts.plain.rows, 0),
            friction: lifted(&parts.friction.rows, free),
            entry_bits: longest + common.bits(),
            common,
        })
    }

    /// Demands that M0 - m I is positive semidefinite, and m > 0.
    fn check_mass(&self, certificate: &StabilityCertificate) -> Result<(), CoverFault> {
        let m = &certificate.mass_sigma;
        if !m.is_positive() {
            return Err(CoverFault::hypothesis("mass_sigma > 0", 0));
        }

        let shift = &self.common * m.numer();
        let mut shifted = SymmetricRows::with_capacity(self.plain.len());
        for (i, row) in self.plain.iter().enumerate() {
            let mut entries: BTreeMap<usize, Integer> = BTreeMap::new();
            for (j, _, mass) in row {
                // K and M are symmetric in every problem (`System`), and A0 = T'KT, M0 = T'MT
                // with them.
                entries.insert(*j, mass * m.denom());
            }

            *entries.entry(i).or_default() -= &shift;
            shifted.push(entries);
        }

        semidefinite(
            &shifted,
            &(&self.common * m.denom()),
            certificate.mass_factor.as_ref(),
            false,
            "M0 - mass_sigma I positive semidefinite",
        )
    }
}

/// What the free degrees of freedom can do to the friction of each slip particle.
struct FreeWork {
    /// a_i^2, at least.
    squares: Vec<Rational>,
    /// theta_i / mu.
    lost: Vec<Rational>,
    /// rho_i / mu.
    added: Vec<Rational>,
}

impl FreeWork {
    /// With the numbers of the certificate. Refuses accelerations that are too large.
    fn of(pencil: &MotionPencil, certificate: &StabilityCertificate) -> Result<FreeWork, Reason> {
        let condensation = certificate.condensation.as_ref();
        let inertia = condensation.and_then(|c| c.inertia.as_ref());
        let slip = pencil.friction.len();
        let reduced = ReducedFriction::of(pencil, inertia)?;

        // e_i, and what all of them may be.
        let to = &certificate.to;
        let accelerations: Vec<Rational> = reduced.masses().collect();
        let all: Rational = accelerations.iter().sum();
        let got = Rational::from_integer(2.into()) * to * all;
        if got > certificate.mass_sigma {
            let allowed = certificate.mass_sigma.clone();
            return Err(Reason::Inertia { allowed, got });
        }

        // |q''| <= omega |q|.
        let kappa = pencil.stiffness_norm() + to * reduced.stiffness_norm();
        let omega = kappa * Rational::from_integer(2.into()) / &certificate.mass_sigma;

        let (of_slip, of_free) = match condensation {
            None => (Rational::one(), Rational::zero()),
            Some(condensation) => (
                pencil.elimination_norm(condensation) + Rational::one(),
                condensation.sigma.0.recip() + Rational::one(),
            ),
        };
        let times = |factor: &Rational| {
            let weight = &omega * factor;
            accelerations.iter().map(|e| e * &weight).collect()
        };

        let squares = match condensation {
            None => vec![Rational::zero(); slip],
            Some(condensation) => reduced.squares(pencil, condensation),
        };
        Ok(FreeWork {
            squares,
            lost: times(&of_slip),
            added: times(&of_free),
        })
    }

    /// theta at a friction.
    fn lost(&self, mu: &Rational) -> Vec<Rational> {
        self.lost.iter().map(|lost| mu * lost).collect()
    }
}

/// R - G K_f and M1 - G M_f, row by row, in units of 1 / (common 2^`exponent`).
struct ReducedFriction<'a> {
    /// G', by free variables.
    inertia: Option<&'a IntegerMatrix>,
    unit: Integer,
    exponent: u32,
    /// Dense rows: stiffness and mass.
    rows: Vec<[Vec<Integer>; 2]>,
}

impl<'a> ReducedFriction<'a> {
    fn of(
        pencil: &MotionPencil,
        inertia: Option<&'a IntegerMatrix>,
    ) -> Result<ReducedFriction<'a>, Reason> {
        let slip = pencil.friction.len();
        let exponent = inertia.map_or(0, |matrix| matrix.exponent);
        if let Some(matrix) = inertia {
            check_matrix("inertia", matrix, pencil.free, slip)?;
        }

        let order = pencil.plain.len();
        let longest = inertia.and_then(|matrix| matrix.rows.iter().map(IntegerRow::bits).max());
        let entry_bits = pencil.entry_bits + u64::from(exponent) + longest.unwrap_or(0);
        let all_bits = (2 * slip * order) as u64 * entry_bits;
        CoverFault::at_most(
            "bits of R - G K_f and M1 - G M_f",
            MAX_LIFTED_BITS,
            all_bits,
        )?;

        let mut rows = Vec::with_capacity(slip);
        for (i, friction) in pencil.friction.iter().enumerate() {
            let mut stiffness = vec![Integer::zero(); order];
            let mut mass = vec![Integer::zero(); order];
            for (j, a, b) in friction {
                stiffness[*j] += a << exponent;
                mass[*j] += b << exponent;
            }

            for (g, row) in pencil.plain[..pencil.free].iter().enumerate() {
                let Some(matrix) = inertia else { break };
                let factor = matrix.rows[g].at(i);
                for (j, a, b) in row {
                    stiffness[*j] -= &*factor * a;
                    mass[*j] -= &*factor * b;
                }
            }

            rows.push([stiffness, mass]);
        }

        Ok(ReducedFriction {
            inertia,
            unit: &pencil.common << exponent,
            exponent,
            rows,
        })
    }

    /// The sum of |E_ij| over j, for each slip particle i.
    fn masses(&self) -> impl Iterator<Item = Rational> {
        let sums = self.rows.iter().map(|[_, mass]| sum_of_sizes(mass));
        sums.map(|sum| Rational::new(sum, self.unit.clone()))
    }

    /// The sum of the |c_ij|.
    fn stiffness_norm(&self) -> Rational {
        let sums = self
            .rows
            .iter()
            .map(|[stiffness, _]| sum_of_sizes(stiffness));
        Rational::new(sums.sum(), self.unit.clone())
    }

    /// Upper bounds of C_i K_ff^-1 C_i'.
    ///
    /// With u_i = V_i - G_i' and l = C_i' - K_ff u_i it is u'(C_i' + l) + l' K_ff^-1 l.
    fn squares(
        &self,
        pencil: &MotionPencil,
        condensation: &StabilityCondensation,
    ) -> Vec<Rational> {
        let v = &condensation.left_friction;
        let exponent = v.exponent.max(self.exponent);
        let sigma = &condensation.sigma.0;
        let unit = &pencil.common << exponent;

        let mut squares = Vec::with_capacity(self.rows.len());
        for (i, [stiffness, _]) in self.rows.iter().enumerate() {
            let u: Vec<Integer> = (0..pencil.free)
                .map(|g| {
                    let of_inertia = self.inertia.map(|matrix| matrix.rows[g].at(i).into_owned());
                    let of_inertia = of_inertia.unwrap_or_default() << (exponent - self.exponent);
                    (v.rows[g].at(i).into_owned() << (exponent - v.exponent)) - of_inertia
                })
                .collect();

            // In units of 1 / (common 2^(2 exponent)), and squares of 1 / (common 2^exponent).
            let mut product = Integer::zero();
            let mut square = Integer::zero();
            for (g, row) in pencil.plain[..pencil.free].iter().enumerate() {
                let c = &stiffness[g] << (exponent - self.exponent);
                let mut residual = c.clone();
                for (j, a, _) in row.iter().take_while(|(j, ..)| *j < pencil.free) {
                    residual -= a * &u[*j];
                }

                product += &u[g] * (c + &residual);
                square += &residual * &residual;
            }

            let by_sigma = Rational::new(square, &unit * &unit) / sigma;
            squares.push(Rational::new(product, &unit << exponent) + by_sigma);
        }

        squares
    }
}

impl MotionPencil {
    /// The sum of the absolute values of A0.
    fn stiffness_norm(&self) -> Rational {
        let entries = self.plain.iter().flatten().map(|(_, a, _)| a.abs());
        Rational::new(entries.sum(), self.common.clone())
    }

    /// At least the norm of K_ff^-1 K_fs, which is W + K_ff^-1 r with r = K_fs - K_ff W.
    ///
    /// Soundness needs r: W is whatever the file says.
    fn elimination_norm(&self, condensation: &StabilityCondensation) -> Rational {
        let w = &condensation.right;
        let slip = self.friction.len();
        let mut residuals = Integer::zero();
        for row in &self.plain[..self.free] {
            let mut residual = vec![Integer::zero(); slip];
            for (j, a, _) in row {
                match j.checked_sub(self.free) {
                    Some(s) => residual[s] += a << w.exponent,
                    None => {
                        for (r, entry) in residual.iter_mut().zip(w.rows[*j].iter()) {
                            *r -= a * &*entry;
                        }
                    }
                }
            }

            residuals += sum_of_sizes(&residual);
        }

        let residuals = Rational::new(residuals, &self.common << w.exponent);
        norm(w) + residuals / &condensation.sigma.0
    }
}

fn sum_of_sizes(row: &[Integer]) -> Integer {
    row.iter().map(Integer::abs).sum()
}

/// The sum of the absolute values of a matrix.
fn norm(matrix: &IntegerMatrix) -> Rational {
    let entries = matrix.rows.iter().flat_map(|row| row.iter());
    let sum: Integer = entries.map(|entry| entry.abs()).sum();
    Rational::new(sum, Integer::one() << matrix.exponent)
}

fn check_matrix(
    what: &'static str,
    matrix: &IntegerMatrix,
    rows: usize,
    columns: usize,
) -> Result<(), Reason> {
    CoverFault::at_most("exponent", MAX_EXPONENT.into(), matrix.exponent.into())?;
    Reason::length(what, rows, matrix.rows.len())?;
    for row in matrix.rows.iter() {
        Reason::length(what, columns, row.len())?;
    }

    Ok(())
}

/// Demands that Q is square and b has an entry per slip particle.
fn check_shape(end: &StabilityEnd, slip: usize) -> Result<(), Reason> {
    CoverFault::at_most("exponent", MAX_EXPONENT.into(), end.exponent.into())?;
    Reason::length("symmetric", slip, end.symmetric.len())?;
    for row in &end.symmetric {
        Reason::length("symmetric", slip, row.len())?;
    }

    Reason::length("bounds", slip, end.bounds.len())
}

/// Demands that Q is symmetric and Q_ij <= T_ij - theta_i.
///
/// A row of the enclosure is the row of T divided by its unit.
fn check_below(
    end: &StabilityEnd,
    at_mu: &EndMatrix<'_>,
    row_units: &[Rational],
    theta: &[Rational],
) -> Result<(), Reason> {
    let q = &end.symmetric;
    let unit_of_q = Integer::one() << end.exponent;
    for (i, row) in q.iter().enumerate() {
        let unit = &row_units[i] / at_mu.scale;
        for (j, entry) in row.iter().enumerate() {
            if *entry != q[j][i] {
                return Err(Reason::NotSymmetric {
                    end: at_mu.name,
                    row: i,
                    column: j,
                });
            }

            // Soundness rests on this comparison: the least that T_ij can be.
            let least = &at_mu.matrix.m[i][j] - &at_mu.matrix.r[i][j];
            let limit = &unit * least - &theta[i];
            let got = Rational::new(entry.clone(), unit_of_q.clone());
            if got > limit {
                return Err(Reason::NotBelow {
                    end: at_mu.name,
                    row: i,
                    column: j,
                    limit,
                    got,
                });
            }
        }
    }

    Ok(())
}

/// Demands that b_i >= mu a_i + rho_i.
fn check_bounds(
    end: &StabilityEnd,
    name: &'static str,
    mu: &Rational,
    work: &FreeWork,
) -> Result<(), Reason> {
    let unit = Integer::one() << end.exponent;
    for (index, bound) in end.bounds.iter().enumerate() {
        let got = Rational::new(bound.clone(), unit.clone());
        let rest = &got - mu * &work.added[index];
        let is_enough = !rest.is_negative() && &rest * &rest >= mu * mu * &work.squares[index];
        if !is_enough {
            return Err(Reason::Bound {
                end: name,
                index,
                got,
            });
        }
    }

    Ok(())
}

/// Demands that 4 Q - b b' is positive definite.
fn check_definite(end: &StabilityEnd) -> Result<(), CoverFault> {
    let exponent = end.exponent;
    let mut rows = SymmetricRows::with_capacity(end.bounds.len());
    for (row, b_i) in end.symmetric.iter().zip(&end.bounds) {
        let mut entries = BTreeMap::new();
        for (j, (q, b_j)) in row.iter().zip(&end.bounds).enumerate() {
            entries.insert(j, (q << (exponent + 2)) - b_i * b_j);
        }

        rows.push(entries);
    }

    let scale = Integer::one() << (2 * exponent);
    let what = "4 Q - b b' positive definite";
    semidefinite(&rows, &scale, Some(&end.factor), true, what)
}
