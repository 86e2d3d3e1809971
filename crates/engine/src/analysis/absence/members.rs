//! What the radii of the data add to the two parts of T(t, mu) = T0(t) + mu T1(t).
//!
//! `spec/certificates.md`, 5.22, has the formulas, which the checker computes exactly. Here they
//! are in doubles: the pencils whose definiteness has to be proved, and the [`ExpansionSpread`] of
//! each expansion over what its anchor serves.
//!
//! Input: the radii of (K0, K1) and (M0, M1), and the pieces. Called by `family`.

use super::family::{HalfLineFamily, PieceOfHalfLine, parts_of};
use crate::branch::BranchPoint;
use crate::search::complete::pieces::anchor::columns_of_all;
use crate::search::complete::pieces::expansion::{Expansion, ExpansionSpread};
use crate::search::complete::pieces::matrix::zeros;
use crate::tolerance::ROUNDING;
use mceip_check::certificate::{CriticalAnchor, IntegerMatrix};
use mceip_exact::{Rational, Sparse, to_f64, whole};
use mceip_model::reduction::radii_family;
use mceip_model::{ContactState, ModelError, Pencil, System};
use num_traits::{One as _, Signed as _};

/// How far the parts of a member may be from those in the middle: the radii of T0 and T1 as two
/// pencils, each with the free rows.
#[derive(Clone)]
pub(in crate::analysis) struct FamilyRadii {
    pub(super) pencils: [Pencil; 2],
    /// By slip variable: the share by which a friction row may be off.
    shares: Vec<Rational>,
}

impl FamilyRadii {
    /// Those of a system; `None` for one body.
    ///
    /// # Errors
    /// As [`radii_family`].
    pub(in crate::analysis) fn of(system: &System) -> Result<Option<FamilyRadii>, ModelError> {
        if system.is_exact() {
            return Ok(None);
        }

        let slip = system.slip_particles().into_iter();
        Ok(Some(FamilyRadii {
            pencils: parts_of(&radii_family(system)?)?,
            shares: slip.map(|(p, _)| p.friction_factor_ball().1).collect(),
        }))
    }

    /// The pencil with the row sums of the radii of its free block taken off the diagonal: what is
    /// at most each member there.
    pub(super) fn least_free(&self, pencil: &Pencil) -> Result<Pencil, ModelError> {
        let [radii, _] = &self.pencils;
        let free = pencil.free();
        let in_free_block = |radius: &Sparse| {
            let entries = radius.entries();
            let inside = entries.filter(|(i, j, _)| free.contains(i) && free.contains(j));
            let entries = inside.map(|(i, j, r)| (i, j, r.clone()));
            Sparse::from_entries(radius.rows(), radius.cols(), entries)
        };

        less(
            pencil,
            [&in_free_block(radii.a()), &in_free_block(radii.b())],
        )
    }

    /// The pencil T0 + mu T1 of the parts `middle` with the row sums of the symmetric radii taken
    /// off its diagonal: its symmetric part is at most that of each member.
    pub(super) fn least_at(
        &self,
        middle: &[Pencil; 2],
        at_friction: &Pencil,
        mu: &Rational,
    ) -> Result<Pencil, ModelError> {
        let [plain, friction] = &self.pencils;
        let slip = at_friction.slip();
        let of = |radius: [&Sparse; 2], of_friction: &Sparse| {
            let mut more = Vec::new();
            for (&i, share) in slip.iter().zip(&self.shares) {
                for (j, r) in radius[1].row(i) {
                    more.push((i, *j, r * (Rational::one() + share) * mu));
                }
                for (j, entry) in of_friction.row(i) {
                    more.push((i, *j, entry.abs() * share * mu));
                }
            }
            let more = Sparse::from_entries(radius[0].rows(), radius[0].cols(), more);
            let half = whole(1) / whole(2);
            let sum = radius[0].add_scaled(&Rational::one(), &more);
            let none = Sparse::zeros(sum.rows(), sum.cols());
            none.add_scaled(&half, &sum)
                .add_scaled(&half, &sum.transpose())
        };
        let of_a = of([plain.a(), friction.a()], middle[1].a());
        let of_b = of([plain.b(), friction.b()], middle[1].b());

        less(at_friction, [&of_a, &of_b])
    }

    /// The spread of both expansions where there are no free variables. `factors` are those of the
    /// rows.
    pub(super) fn spread_linear(&self, pair: &mut [Expansion; 2], factors: &[f64]) {
        for (part, expansion) in pair.iter_mut().enumerate() {
            let scaled = |radius: &Sparse| {
                let mut matrix = zeros(factors.len());
                for (i, j, r) in radius.entries() {
                    matrix[i][j] = (1.0 + ROUNDING) * factors[i] * to_f64(r);
                }
                matrix
            };
            let radii = &self.pencils[part];
            expansion.spread = Some(ExpansionSpread {
                constant: scaled(radii.a()),
                slope: scaled(radii.b()),
                shares: self.shares_of(part),
            });
        }
    }

    /// The spread of both expansions about an anchor, over the pieces that name it. Its friction
    /// rows have the radii of the second part.
    pub(super) fn spread_about(
        &self,
        pair: &mut [Expansion; 2],
        anchor: &CriticalAnchor,
        served: &[&PieceOfHalfLine],
        factors: &[f64],
    ) {
        let reach = ServedReach::of(&pair[0], served);
        let width = factors.len();
        let left_of_plain = anchor.left.as_deref().unwrap_or(&anchor.right);
        let w = largest_values(&anchor.right, reach.distance, width);
        for (part, expansion) in pair.iter_mut().enumerate() {
            let left = [left_of_plain, &anchor.left_friction][part];
            let mut v = largest_values(left, reach.distance, width);
            for (column, factor) in v.iter_mut().zip(factors) {
                column.iter_mut().for_each(|entry| *entry *= factor);
            }

            let radii = LargestRadii::of(&self.pencils[part], &reach, expansion.reversed, factors);
            radii.spread(expansion, &w, &v, self.shares_of(part));
        }
    }

    /// Rows of the second part may be off by their shares as well.
    fn shares_of(&self, part: usize) -> Vec<f64> {
        let share = |share: &Rational| if part == 1 { to_f64(share) } else { 0.0 };
        self.shares.iter().map(share).collect()
    }
}

/// The null vectors of a solution over all degrees of freedom: u from the left, x from the right.
pub(in crate::analysis) struct FullModes {
    pub(in crate::analysis) left: Vec<f64>,
    pub(in crate::analysis) right: Vec<f64>,
    /// For each slip particle whose factor has an interval: its number, and what the row of T1 does
    /// at this solution, times the share by which it may be off.
    pub(in crate::analysis) of_factors: Vec<(usize, f64)>,
}

impl HalfLineFamily {
    /// Those of a solution, in doubles.
    pub(in crate::analysis) fn modes(&self, system: &System, point: &BranchPoint) -> FullModes {
        let middle = system.middle();
        let order = point.x.len();
        let mut u = vec![0.0; order];
        for (&i, value) in point.support.iter().zip(&point.left) {
            u[i] = value * self.row_factors(point.t)[i];
        }

        let [w, plain, friction] = self.free_columns(point.t);
        let mut left = vec![0.0; system.dofs()];
        let mut right = vec![0.0; system.dofs()];
        for (k, dof) in middle.free_dofs().into_iter().enumerate() {
            for j in 0..order {
                let of = |columns: &FreeColumns| columns[j].get(k).copied().unwrap_or(0.0);
                right[dof] -= of(&w) * point.x[j];
                left[dof] -= (of(&plain) + point.mu * of(&friction)) * u[j];
            }
        }

        let of_mu = self.friction_part_times(point);
        let mut of_factors = Vec::new();
        let numbers = middle.particles().iter().enumerate();
        let slip = numbers.filter(|(_, p)| matches!(p.state, ContactState::Slip { .. }));
        for (j, ((number, particle), (_, sign))) in slip.zip(middle.slip_particles()).enumerate() {
            let minus_s = -f64::from(sign);
            for (dof, t) in particle.tangent() {
                right[dof] += minus_s * to_f64(&t) * point.x[j];
                left[dof] += minus_s * to_f64(&t) * u[j];
            }
            for (dof, n) in particle.friction_direction() {
                left[dof] -= point.mu * to_f64(&n) * u[j];
            }

            let share = to_f64(&system.particles()[number].friction_factor_ball().1);
            if share > 0.0 {
                of_factors.push((
                    number,
                    share * u[j] / self.row_factors(point.t)[j] * of_mu[j],
                ));
            }
        }

        FullModes {
            left,
            right,
            of_factors,
        }
    }

    /// W at a value and V of both parts, by columns.
    fn free_columns(&self, t: f64) -> [FreeColumns; 3] {
        let number = self.anchor(t);
        let [first, _] = self.expansions(number);
        let width = first.order();
        let Some(anchor) = number.and_then(|k| self.left_friction.get(k)) else {
            return [const { Vec::new() }; 3].map(|_: FreeColumns| vec![Vec::new(); width]);
        };

        let argument = if first.reversed { t.recip() } else { t };
        let d = argument - first.center;
        let plain = anchor.left.as_deref().unwrap_or(&anchor.right);
        [&anchor.right[..], plain, &anchor.left_friction].map(|w| values(w, d, width, |v| v))
    }
}

/// The pencil with the row sums of two matrices taken off the diagonals of A and B.
fn less(pencil: &Pencil, [of_a, of_b]: [&Sparse; 2]) -> Result<Pencil, ModelError> {
    let reduced = |matrix: &Sparse, radius: &Sparse| {
        let order = matrix.rows();
        let sum_of_row = |i: usize| radius.row(i).iter().map(|(_, r)| r.clone()).sum();
        let sums = (0..order).map(|i| (i, i, sum_of_row(i)));
        let diagonal = Sparse::from_entries(order, order, sums);
        matrix.add_scaled(&-Rational::one(), &diagonal)
    };
    let a = reduced(pencil.a(), of_a);
    let b = reduced(pencil.b(), of_b);
    Pencil::new(a, b, pencil.free().to_vec())
}

/// What an anchor serves, in its own variable.
struct ServedReach {
    distance: f64,
    top: f64,
}

impl ServedReach {
    fn of(expansion: &Expansion, served: &[&PieceOfHalfLine]) -> ServedReach {
        let mut reach = ServedReach {
            distance: 0.0,
            top: 0.0,
        };
        for piece in served {
            let hi = piece.hi.as_ref().map_or(f64::INFINITY, to_f64);
            for end in [to_f64(&piece.lo), hi] {
                let own = if expansion.reversed { end.recip() } else { end };
                reach.distance = reach.distance.max((own - expansion.center).abs());
                reach.top = reach.top.max(own);
            }
        }

        reach
    }
}

/// Columns over the free variables, one for each slip variable.
type FreeColumns = Vec<Vec<f64>>;

/// sum |W_k| distance^k by columns.
fn largest_values(coefficients: &[IntegerMatrix], distance: f64, width: usize) -> FreeColumns {
    values(coefficients, distance, width, f64::abs)
}

/// sum f(W_k) d^k by columns.
fn values(
    coefficients: &[IntegerMatrix],
    d: f64,
    width: usize,
    of_entry: impl Fn(f64) -> f64,
) -> FreeColumns {
    let mut sum: FreeColumns = vec![Vec::new(); width];
    for (k, columns) in columns_of_all(coefficients, width).iter().enumerate() {
        let power = d.powi(k as i32);
        for (target, column) in sum.iter_mut().zip(columns) {
            target.resize(column.len(), 0.0);
            for (target, entry) in target.iter_mut().zip(column) {
                *target += of_entry(*entry) * power;
            }
        }
    }

    sum
}

/// The blocks of the radii at the largest value, slip rows times their factors.
struct LargestRadii {
    /// (row, column, value), rows and columns by position among their kind.
    ff: Vec<(usize, usize, f64)>,
    fs: Vec<(usize, usize, f64)>,
    sf: Vec<(usize, usize, f64)>,
    ss: Vec<(usize, usize, f64)>,
    free: usize,
}

impl LargestRadii {
    fn of(radii: &Pencil, reach: &ServedReach, reversed: bool, factors: &[f64]) -> LargestRadii {
        let free = radii.free();
        let slip = radii.slip();
        let mut blocks = LargestRadii {
            ff: Vec::new(),
            fs: Vec::new(),
            sf: Vec::new(),
            ss: Vec::new(),
            free: free.len(),
        };

        let [constant, slope] = if reversed {
            [radii.b(), radii.a()]
        } else {
            [radii.a(), radii.b()]
        };
        for (matrix, value) in [(constant, 1.0), (slope, reach.top)] {
            for (i, j, r) in matrix.entries() {
                let r = (1.0 + ROUNDING) * value * to_f64(r);
                match (free.binary_search(&i), free.binary_search(&j)) {
                    (Ok(i), Ok(j)) => blocks.ff.push((i, j, r)),
                    (Ok(i), Err(_)) => blocks.fs.push((i, position(&slip, j), r)),
                    (Err(_), Ok(j)) => {
                        let i = position(&slip, i);
                        blocks.sf.push((i, j, factors[i] * r));
                    }
                    (Err(_), Err(_)) => {
                        let i = position(&slip, i);
                        blocks.ss.push((i, position(&slip, j), factors[i] * r));
                    }
                }
            }
        }

        blocks
    }

    /// P, Q and E into the expansion.
    fn spread(
        &self,
        expansion: &mut Expansion,
        w: &FreeColumns,
        v: &FreeColumns,
        shares: Vec<f64>,
    ) {
        let order = shares.len();
        let fs = self.fs.iter().map(|&(i, j, r)| (j, i, r));
        let p = self.residual_bound(fs, w);
        let q = self.residual_bound(self.sf.iter().copied(), v);
        for (norms, columns) in [
            (&mut expansion.left_residual, &q),
            (&mut expansion.right_residual, &p),
        ] {
            for (norm, column) in norms[0].iter_mut().zip(columns) {
                *norm += column.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
            }
        }

        let mut e = zeros(order);
        for &(i, j, r) in &self.ss {
            e[i][j] += r;
        }
        for &(i, k, r) in &self.sf {
            for (entry, column) in e[i].iter_mut().zip(w) {
                *entry += r * column.get(k).copied().unwrap_or(0.0);
            }
        }
        for (row, v) in e.iter_mut().zip(v) {
            for (entry, p) in row.iter_mut().zip(&p) {
                *entry += v.iter().zip(p).map(|(v, p)| v * p).sum::<f64>();
            }
        }

        expansion.spread = Some(ExpansionSpread {
            constant: e,
            slope: zeros(order),
            shares,
        });
    }

    /// The columns of R_fs + R_ff W_max; `coupling` are (slip, free, radius).
    fn residual_bound(
        &self,
        coupling: impl Iterator<Item = (usize, usize, f64)>,
        largest: &FreeColumns,
    ) -> FreeColumns {
        let mut bound = vec![vec![0.0; self.free]; largest.len()];
        for (j, i, r) in coupling {
            bound[j][i] += r;
        }
        for (bound, largest) in bound.iter_mut().zip(largest) {
            for &(i, k, r) in &self.ff {
                bound[i] += r * largest.get(k).copied().unwrap_or(0.0);
            }
        }

        bound
    }
}

fn position(slip: &[usize], variable: usize) -> usize {
    slip.partition_point(|&i| i < variable)
}
