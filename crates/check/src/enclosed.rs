//! Enclosed solutions: Krawczyk's test (Krawczyk 1969, Moore 1977) in exact arithmetic.
//!
//! Unknowns z = (x on active variables, t); F(z) = ((A + tB) x on active rows, e'x_s - 1).
//! With Z the box c +- r and any matrix Y: if |Y F(c)| + max_{z in Z} |I - Y F'(z)| r < r in every
//! component, then F has exactly one zero in Z (and Y is regular). F' is linear in z:
//! |F'(z) - F'(c)| r <= d with d_i = 2 r_t sum_j |B_ij| r_j, so the bound used is
//! |Y F(c)| + |I - Y F'(c)| r + |Y| d < r. Everything is an integer over a power of two.

use super::AcceptedClaim;
use super::exact_solution::{index_set, within};
use super::pencil::{Row, Rows};
use super::reason::Reason;
use crate::certificate::EnclosedSolution;
use mceip_exact::{Integer, Interval, Rational, common_denominator};
use mceip_model::Window;
use num_traits::{One, Signed, Zero};

/// Largest binary exponent of a preconditioner: 8 kB per entry, far beyond any use.
const MAX_EXPONENT: u32 = 1 << 16;

pub(super) fn check(
    rows: &Rows,
    window: &Window,
    claim: &EnclosedSolution,
) -> Result<AcceptedClaim, Reason> {
    index_set(rows, "support", &claim.support)?;
    if claim.support.is_empty() {
        return Err(Reason::XZero); // e'x_s = 1 needs a slip variable
    }
    if claim.exponent > MAX_EXPONENT {
        return Err(Reason::TooLarge {
            what: "exponent",
            limit: MAX_EXPONENT.into(),
            got: claim.exponent.into(),
        });
    }
    let active: Vec<usize> = (0..rows.order())
        .filter(|&i| rows.is_free[i] || claim.support.binary_search(&i).is_ok())
        .collect();
    let n = active.len() + 1;
    for (what, got) in [
        ("center", claim.center.len()),
        ("radius", claim.radius.len()),
        ("preconditioner", claim.preconditioner.len()),
    ] {
        if got != n {
            return Err(Reason::Length {
                what,
                expected: n,
                got,
            });
        }
    }
    if let Some(row) = claim.preconditioner.iter().find(|r| r.len() != n) {
        return Err(Reason::Length {
            what: "preconditioner row",
            expected: n,
            got: row.len(),
        });
    }
    if let Some(index) = claim.radius.iter().position(|r| !r.0.is_positive()) {
        return Err(Reason::Radius {
            index,
            got: claim.radius[index].0.clone(),
        });
    }
    let system = Newton::new(rows, claim, &active);
    system.contracts(claim)?;
    let boxed = |k: usize| ball(&claim.center[k].0, &claim.radius[k].0);
    let value = boxed(n - 1);
    within(window, &value)?;
    for (k, &index) in active
        .iter()
        .enumerate()
        .filter(|(_, i)| claim.support.binary_search(i).is_ok())
    {
        let image = boxed(k);
        if image.certain_sign() != 1 {
            return Err(Reason::XNotPositive {
                index,
                lo: image.lo().clone(),
                hi: image.hi().clone(),
            });
        }
    }
    for index in (0..rows.order()).filter(|i| active.binary_search(i).is_err()) {
        let image = system.row_over_box(&rows.rows[index]);
        if image.certain_sign() != 1 {
            return Err(Reason::YNotPositive {
                index,
                lo: image.lo().clone(),
                hi: image.hi().clone(),
            });
        }
    }
    Ok(AcceptedClaim {
        support: claim.support.clone(),
        value,
    })
}

fn ball(c: &Rational, r: &Rational) -> Interval {
    // r > 0 has been checked, so the ends are in order; a point otherwise.
    Interval::new(c - r, c + r).unwrap_or_else(|| Interval::point(c.clone()))
}

fn place<T: Clone>(order: usize, active: &[usize], at: impl Fn(usize) -> T) -> Vec<Option<T>> {
    let mut out = vec![None; order];
    for (k, &i) in active.iter().enumerate() {
        out[i] = Some(at(k));
    }
    out
}

/// F(c), F'(c) and d, all integers: F in units of 1/unit^2, F' and d in units given beside them.
struct Newton {
    /// Common denominator of centre and radius.
    unit: Integer,
    /// unit c and unit r; the last entry is that of t.
    center: Vec<Integer>,
    radius: Vec<Integer>,
    /// Where a variable stands among the unknowns, if it is active.
    place: Vec<Option<usize>>,
    /// unit^2 F(c).
    f: Vec<Integer>,
    /// unit F'(c), sparse rows (unknown, value).
    jacobian: Vec<Vec<(usize, Integer)>>,
    /// unit^2 d.
    d: Vec<Integer>,
}

impl Newton {
    fn new(rows: &Rows, claim: &EnclosedSolution, active: &[usize]) -> Newton {
        let unit = common_denominator(claim.center.iter().chain(&claim.radius).map(|n| &n.0));
        let scaled = |v: &Rational| v.numer() * (&unit / v.denom());
        let c: Vec<Integer> = claim.center.iter().map(|n| scaled(&n.0)).collect();
        let r: Vec<Integer> = claim.radius.iter().map(|n| scaled(&n.0)).collect();
        let last = active.len();
        let place: Vec<Option<usize>> = place(rows.order(), active, |k| k);
        let (mut f, mut jacobian, mut d) = (Vec::new(), Vec::new(), Vec::new());
        for &i in active {
            let (mut f_i, mut d_i, mut column_t) =
                (Integer::zero(), Integer::zero(), Integer::zero());
            let mut row = Vec::new();
            for (j, a, b) in &rows.rows[i] {
                let Some(k) = place[*j] else { continue }; // x_j = 0
                let coefficient = a * &unit + b * &c[last]; // unit (A + tB)_ij
                f_i += &coefficient * &c[k];
                column_t += b * &c[k]; // unit (B x)_i
                d_i += b.abs() * &r[k] * &r[last] * 2;
                row.push((k, coefficient));
            }
            row.push((last, column_t));
            f.push(f_i);
            jacobian.push(row);
            d.push(d_i);
        }
        let slip = |k: &usize| !rows.is_free[active[*k]];
        let norm: Integer = (0..last).filter(slip).map(|k| &c[k]).sum();
        f.push((norm - &unit) * &unit);
        jacobian.push((0..last).filter(slip).map(|k| (k, unit.clone())).collect());
        d.push(Integer::zero());
        Newton {
            unit,
            center: c,
            radius: r,
            place,
            f,
            jacobian,
            d,
        }
    }

    /// Encloses a row of (A + tB) x over the box. With e_j = A_ij + c_t B_ij the row at z is
    /// sum e_j c_j + sum e_j (x_j - c_j) + (t - c_t) sum B_ij c_j + (t - c_t) sum B_ij (x_j - c_j).
    fn row_over_box(&self, row: &Row) -> Interval {
        let last = self.center.len() - 1;
        let (center_t, radius_t) = (&self.center[last], &self.radius[last]);

        // All in units of 1 / unit^2.
        let mut middle = Integer::zero();
        let mut slack = Integer::zero();
        let mut slope = Integer::zero(); // sum B_ij c_j
        for (j, a, b) in row {
            let Some(k) = self.place[*j] else { continue }; // x_j = 0
            let e = a * &self.unit + b * center_t;
            middle += &e * &self.center[k];
            slack += e.abs() * &self.radius[k];
            slack += b.abs() * &self.radius[k] * radius_t;
            slope += b * &self.center[k];
        }
        slack += slope.abs() * radius_t;

        let unit = &self.unit * &self.unit;
        let end = |v: Integer| Rational::new(v, unit.clone());
        ball(&end(middle), &end(slack))
    }

    /// |Y F(c)| + |I - Y F'(c)| r + |Y| d < r, in units of 1 / (2^exponent unit^2).
    fn contracts(&self, claim: &EnclosedSolution) -> Result<(), Reason> {
        let n = self.f.len();
        let one = (Integer::one() << claim.exponent) * &self.unit; // 1 in units of Y F'
        for (index, y) in claim.preconditioner.iter().enumerate() {
            let mut g = vec![Integer::zero(); n]; // row of I - Y F'(c)
            g[index] = one.clone();
            let (mut y_f, mut y_d) = (Integer::zero(), Integer::zero());
            for (i, y_i) in y.iter().enumerate().filter(|(_, v)| !v.is_zero()) {
                y_f += y_i * &self.f[i];
                y_d += y_i.abs() * &self.d[i];
                for (k, value) in &self.jacobian[i] {
                    g[*k] -= y_i * value;
                }
            }
            let g_r: Integer = g.iter().zip(&self.radius).map(|(g, r)| g.abs() * r).sum();
            let left = y_f.abs() + g_r + y_d;
            let right = &self.radius[index] * &one;
            if left >= right {
                let scale = &one * &self.unit;
                let got = Rational::new(left, scale.clone());
                return Err(Reason::NotContracting {
                    index,
                    got,
                    radius: Rational::new(right, scale),
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;
    use mceip_exact::rational;
    use mceip_model::file::Number;

    /// Two active variables, and a third at rest whose row is (1 + 2t) x_0 + (-1 + t) x_1.
    fn resting_row() -> Rows {
        let of = |v: [[i64; 2]; 2]| -> Row {
            v.iter()
                .enumerate()
                .map(|(j, [a, b])| (j, (*a).into(), (*b).into()))
                .collect()
        };
        Rows {
            rows: vec![
                of([[1, 0], [0, 0]]),
                of([[0, 0], [1, 0]]),
                of([[1, 2], [-1, 1]]),
            ],
            factor: vec![Integer::one(); 3],
            is_free: vec![false; 3],
        }
    }

    fn numbers(list: [Rational; 3]) -> Vec<Number> {
        list.map(Number).to_vec()
    }

    /// At c = (1/2, 1/2), t = 1: e = (3, 0), sum e c = 3/2 and sum B c = 3/2. With radii 1/8 and
    /// r_t = 1/4 the slack is 3/8 + 3/2 1/4 + 3 1/8 1/4 = 27/32.
    #[test]
    fn a_row_over_the_box_by_hand() {
        let rows = resting_row();
        let claim = EnclosedSolution {
            support: vec![0, 1],
            center: numbers([rational(1, 2), rational(1, 2), rational(1, 1)]),
            radius: numbers([rational(1, 8), rational(1, 8), rational(1, 4)]),
            preconditioner: vec![],
            exponent: 0,
        };
        let image = Newton::new(&rows, &claim, &[0, 1]).row_over_box(&rows.rows[2]);
        assert_eq!(
            (image.lo().clone(), image.hi().clone()),
            (rational(21, 32), rational(75, 32))
        );
    }
}
