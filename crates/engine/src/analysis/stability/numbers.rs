//! The system at lambda^2 = 0 in doubles: what a proof of stability is made of.
//!
//! With A0 + mu [0; R] the stiffness and M0 + mu [0; M1] the mass of the admissible motions, f the
//! free and s the slip variables, these are (`spec/certificates.md`, 5.21)
//!
//! ```text
//!     T(mu) = S + mu R_c,    S = K_ss - K_sf W,    R_c = R_s - R_f W,    W = K_ff^-1 K_fs,
//!     a_i^2 = C_i u_i,    C = R_f - G K_ff,    u_i = K_ff^-1 R_f,i' - G_i',    G M_ff = (M1)_f,
//!     theta_i = mu e_i Omega (1 + |W|),    rho_i = mu e_i Omega (1 + 1 / sigma),
//! ```
//!
//! with e_i the row sums of |E|, E = M1 - G M_f, and Omega = 2 kappa / m. G is rounded, and E is
//! what the rounding leaves: it is formed in exact arithmetic, once to correct G and once for e.
//!
//! Called by `mod.rs`. The checker computes all of this again, exactly.

use crate::dense::rounded;
use crate::search::complete::pieces::anchor::Rounded;
use crate::search::complete::pieces::blocks::PencilBlocks;
use crate::search::complete::pieces::condense::{mass_bound, stiffness_bound};
use crate::search::complete::pieces::matrix::SquareMatrix;
use crate::search::complete::pieces::skyline::{Skyline, dot};
use crate::search::complete::rounding::integer;
use mceip_check::certificate::{Factor, IntegerMatrix, StabilityCondensation};
use mceip_exact::{Integer, Rational, Sparse, cleared, common_denominator, to_f64};
use mceip_model::file::Number;
use mceip_model::{MuFamily, Pencil};
use num_traits::{One, Signed, Zero};
use std::sync::Arc;

/// Bits of the largest entry of W and V.
const BITS: i32 = 60;
/// Binary exponent of G, which has no unit.
const INERTIA_EXPONENT: u32 = 80;
/// What a sum in doubles may be off, as a share.
const CAUTION: f64 = 1.01;

/// The numbers of a system, and the parts of a certificate that do not depend on mu.
pub(super) struct RestingNumbers {
    /// S and R_c.
    pub(super) condensed: [SquareMatrix; 2],
    /// The largest entry of K_ss: sets the rounding of S.
    pub(super) largest: f64,
    /// a_i.
    pub(super) work: Vec<f64>,
    /// theta_i / mu.
    pub(super) lost: Vec<f64>,
    /// rho_i / mu.
    pub(super) added: Vec<f64>,
    /// The sum of the e_i, and m: 2 mu e <= m.
    pub(super) accelerations: f64,
    pub(super) mass_sigma: Rational,
    pub(super) mass_factor: Option<Factor>,
    pub(super) condensation: Option<StabilityCondensation>,
}

impl RestingNumbers {
    /// For every mu up to `most`. `None` where K_ff or M0 is not definite in doubles.
    pub(super) fn of(family: &MuFamily, most: f64) -> Option<RestingNumbers> {
        let stiffness = &family.stiffness;
        let mass = family.mass.as_ref()?;
        let slip = stiffness.slip();

        let bound = mass_bound(&Skyline::symmetric(mass.a()), mass.a())?;
        let m = to_f64(&bound.tau);
        if m <= 0.0 {
            return None;
        }

        let free = FreeNumbers::of(stiffness, mass)?;
        let [k_ss, r_ss] =
            [stiffness.a(), stiffness.b()].map(|m| rounded(&m.submatrix(&slip, &slip)));

        let kappa = sum_of_sizes(stiffness.a()) + most * free.friction_norm(stiffness);
        let omega = CAUTION * 2.0 * kappa / m;
        let accelerations = free.accelerations(mass);
        let times = |factor: f64| accelerations.iter().map(|e| e * omega * factor).collect();

        Some(RestingNumbers {
            largest: k_ss.iter().flatten().fold(0.0, |s, v| v.abs().max(s)),
            lost: times(1.0 + CAUTION * free.elimination_norm()),
            added: times(1.0 + 1.0 / free.sigma()),
            work: free.work(slip.len()),
            condensed: [
                free.eliminated_from(k_ss, |free| &free.coupling),
                free.eliminated_from(r_ss, |free| &free.friction),
            ],
            accelerations: accelerations.iter().sum(),
            mass_sigma: bound.tau,
            mass_factor: bound.factor,
            condensation: free.condensation(),
        })
    }
}

/// What belongs to the free variables; `None` inside where there are none. Columns are over the
/// free variables, one for each slip variable.
struct FreeNumbers(Option<FreeParts>);

struct FreeParts {
    sigma: Rational,
    stiffness_factor: Factor,
    /// K_fs and R_f'.
    coupling: Vec<Vec<f64>>,
    friction: Vec<Vec<f64>>,
    /// W and V.
    w: Vec<Vec<f64>>,
    v: Vec<Vec<f64>>,
    /// C = R_f - G K_ff, by rows.
    c: Vec<Vec<f64>>,
    inertia: Option<Inertia>,
}

impl FreeNumbers {
    fn of(stiffness: &Pencil, mass: &Pencil) -> Option<FreeNumbers> {
        if stiffness.free().is_empty() {
            return Some(FreeNumbers(None));
        }

        let blocks = PencilBlocks::of(stiffness);
        let bound = stiffness_bound(&blocks)?;
        let factor = blocks.factor_at(0.0)?;
        let solved = |columns: &[Vec<f64>]| {
            let mut columns = columns.to_vec();
            factor.solve_all(&mut columns, false);
            columns
        };

        let inertia = if mass.b().entries().next().is_some() {
            Some(Inertia::of(mass)?)
        } else {
            None
        };
        let mut c = blocks.left.given.slope.clone();
        if let Some(inertia) = &inertia {
            for (c_i, g_i) in c.iter_mut().zip(inertia.doubles()) {
                let product = blocks.right.stiffness.times(&g_i);
                c_i.iter_mut().zip(product).for_each(|(c, p)| *c -= p);
            }
        }

        Some(FreeNumbers(Some(FreeParts {
            w: solved(&blocks.right.given.constant),
            v: solved(&blocks.left.given.slope),
            coupling: blocks.right.given.constant,
            friction: blocks.left.given.slope,
            c,
            inertia,
            sigma: bound.sigma,
            stiffness_factor: bound.factor,
        })))
    }

    fn sigma(&self) -> f64 {
        self.0.as_ref().map_or(1.0, |free| to_f64(&free.sigma))
    }

    /// A block of the slip variables without the free ones: block - rows W.
    fn eliminated_from(
        &self,
        mut block: SquareMatrix,
        rows: impl Fn(&FreeParts) -> &Vec<Vec<f64>>,
    ) -> SquareMatrix {
        let Some(free) = &self.0 else { return block };
        for (block_row, row) in block.iter_mut().zip(rows(free)) {
            for (entry, w_j) in block_row.iter_mut().zip(&free.w) {
                *entry -= dot(row, w_j);
            }
        }

        block
    }

    /// a_i, from C_i u_i.
    fn work(&self, slip: usize) -> Vec<f64> {
        let Some(free) = &self.0 else {
            return vec![0.0; slip];
        };

        let inertia = free.inertia.as_ref().map(Inertia::doubles);
        let mut work = Vec::with_capacity(slip);
        for (i, (c, v)) in free.c.iter().zip(&free.v).enumerate() {
            let of_inertia = inertia.as_ref().map_or(0.0, |g| dot(c, &g[i]));
            let square = dot(c, v) - of_inertia;
            work.push(square.max(0.0).sqrt());
        }

        work
    }

    /// The sum of |W|.
    fn elimination_norm(&self) -> f64 {
        let columns = self.0.iter().flat_map(|free| &free.w);
        columns.flatten().map(|v| v.abs()).sum()
    }

    /// The sum of |R - G K_f|, from above.
    fn friction_norm(&self, stiffness: &Pencil) -> f64 {
        let of_inertia = self.0.iter().flat_map(|free| &free.inertia);
        let largest = of_inertia
            .flat_map(Inertia::doubles)
            .flatten()
            .fold(0.0, |s: f64, v| v.abs().max(s));
        let slip = stiffness.slip().len() as f64;

        sum_of_sizes(stiffness.b()) + slip * largest * sum_of_sizes(stiffness.a())
    }

    /// e_i, from above.
    fn accelerations(&self, mass: &Pencil) -> Vec<f64> {
        let inertia = self.0.as_ref().and_then(|free| free.inertia.as_ref());
        let rows = match inertia {
            Some(inertia) => inertia.residual(mass),
            None => InertiaRows::of(mass).friction(0),
        };

        let sum = |row: &Vec<Integer>| -> Integer { row.iter().map(Integer::abs).sum() };
        let sums = rows.rows.iter().map(sum);
        sums.map(|sum| CAUTION * to_f64(&Rational::new(sum, rows.unit.clone())))
            .collect()
    }

    fn condensation(self) -> Option<StabilityCondensation> {
        let free = self.0?;
        Some(StabilityCondensation {
            sigma: Number(free.sigma),
            stiffness_factor: free.stiffness_factor,
            right: Rounded::of(&free.w, BITS).integers,
            left_friction: Rounded::of(&free.v, BITS).integers,
            inertia: free.inertia.map(Inertia::into_matrix),
        })
    }
}

/// The sum of the absolute values of the entries.
fn sum_of_sizes(matrix: &Sparse) -> f64 {
    matrix.entries().map(|(_, _, v)| to_f64(v).abs()).sum()
}

/// G by rows, in units of 2^-[`INERTIA_EXPONENT`].
struct Inertia(Vec<Vec<Integer>>);

impl Inertia {
    /// `None` where M_ff is not definite in doubles.
    fn of(mass: &Pencil) -> Option<Inertia> {
        let blocks = PencilBlocks::of(mass);
        let factor = blocks.stiffness.cholesky()?; // of M_ff, the constant part of this pencil
        let mut columns = blocks.left.given.slope;
        factor.solve_all(&mut columns);
        let unit = f64::from(INERTIA_EXPONENT).exp2();
        let in_units = |columns: Vec<Vec<f64>>| -> Vec<Vec<Integer>> {
            let column = |column: Vec<f64>| column.iter().map(|v| integer(v * unit)).collect();
            columns.into_iter().map(column).collect()
        };
        let mut inertia = Inertia(in_units(columns));

        // What doubles leave of M1 - G M_f takes one more step.
        let residual = inertia.residual(mass);
        let free = mass.free().len();
        let in_doubles = |row: &Vec<Integer>| -> Vec<f64> {
            let entries = row[..free].iter();
            entries
                .map(|v| to_f64(&Rational::new(v.clone(), residual.unit.clone())))
                .collect()
        };
        let mut corrections: Vec<Vec<f64>> = residual.rows.iter().map(in_doubles).collect();
        factor.solve_all(&mut corrections);
        for (row, more) in inertia.0.iter_mut().zip(in_units(corrections)) {
            row.iter_mut().zip(more).for_each(|(g, more)| *g += more);
        }

        Some(inertia)
    }

    fn doubles(&self) -> Vec<Vec<f64>> {
        let unit = Integer::one() << INERTIA_EXPONENT;
        let double = |v: &Integer| to_f64(&Rational::new(v.clone(), unit.clone()));
        let rows = self.0.iter();
        rows.map(|row| row.iter().map(double).collect()).collect()
    }

    /// E = M1 - G M_f, exactly; the free columns come first.
    fn residual(&self, mass: &Pencil) -> InertiaResidual {
        let rows = InertiaRows::of(mass);
        let mut residual = rows.friction(INERTIA_EXPONENT);
        for (row, g_i) in residual.rows.iter_mut().zip(&self.0) {
            for (g, of_mass) in g_i.iter().zip(&rows.free) {
                for (j, m) in of_mass {
                    row[*j] -= g * m;
                }
            }
        }

        residual
    }

    /// G' as a certificate has it.
    fn into_matrix(self) -> IntegerMatrix {
        let free = self.0.first().map_or(0, Vec::len);
        let row = |g: usize| self.0.iter().map(|row| row[g].clone()).collect();
        IntegerMatrix {
            exponent: INERTIA_EXPONENT,
            rows: Arc::new((0..free).map(row).collect()),
        }
    }
}

/// Dense rows in units of 1 / `unit`.
struct InertiaResidual {
    rows: Vec<Vec<Integer>>,
    unit: Integer,
}

/// M_f and M1 in units of 1 / `common`; the free columns come first.
struct InertiaRows {
    common: Integer,
    order: usize,
    free: Vec<Vec<(usize, Integer)>>,
    slip: Vec<Vec<(usize, Integer)>>,
}

impl InertiaRows {
    fn of(mass: &Pencil) -> InertiaRows {
        let entries = mass.a().entries().chain(mass.b().entries());
        let common = common_denominator(entries.map(|(_, _, v)| v));

        let slip = mass.slip();
        let order = mass.order();
        let mut place = vec![0; order];
        for (position, &index) in mass.free().iter().chain(&slip).enumerate() {
            place[index] = position;
        }

        let rows_of = |matrix: &Sparse, rows: &[usize]| {
            let row = |i: &usize| {
                let entries = matrix.row(*i).iter();
                entries
                    .map(|(j, v)| (place[*j], cleared(v, &common)))
                    .collect()
            };
            rows.iter().map(row).collect()
        };
        InertiaRows {
            free: rows_of(mass.a(), mass.free()),
            slip: rows_of(mass.b(), &slip),
            order,
            common,
        }
    }

    /// M1 in units of 1 / (common 2^`exponent`).
    fn friction(&self, exponent: u32) -> InertiaResidual {
        let mut rows = vec![vec![Integer::zero(); self.order]; self.slip.len()];
        for (row, entries) in rows.iter_mut().zip(&self.slip) {
            for (j, m) in entries {
                row[*j] += m << exponent;
            }
        }

        InertiaResidual {
            rows,
            unit: &self.common << exponent,
        }
    }
}
