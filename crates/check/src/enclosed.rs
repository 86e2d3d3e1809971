//! Enclosed solutions: a box that contains exactly one solution, by Krawczyk's test.
//!
//! Unknowns z = (x on the active variables, t), where the active variables are the free ones and
//! the support. Equations F(z) = 0, with
//!
//! ```text
//!     F(z) = ( (A + tB) x on the active rows,  e'x_s - 1 ).                  // (13), (25)
//! ```
//!
//! Let Z be the box |z - c| <= r, and Y any matrix. If in every component
//!
//! ```text
//!     |Y F(c)| + max over z in Z of |I - Y F'(z)| r  <  r,
//! ```
//!
//! then z -> z - Y F(z) maps Z into its interior, so that it has a fixed point there; Y and every
//! F'(z) are regular, so that F has a zero in Z, and only one (Krawczyk 1969, Moore 1977). Here F
//! is quadratic: F'(z) - F'(c) is linear in z - c, and |F'(z) - F'(c)| r <= d with d_i = 2 r_t
//! sum_j |B_ij| r_j. So it suffices that
//!
//! ```text
//!     |Y F(c)| + |I - Y F'(c)| r + |Y| d  <  r.
//! ```
//!
//! The zero is a solution of (12)-(14) if t lies in the window, x > 0 on the support and y > 0 on
//! the other rows; these are demanded of the whole box.
//!
//! With particles in contact with zero reaction the pencil is the split form
//! (`spec/zero-reaction.md`, Z.3). The support has at most one half of v_T of each, so that x != 0
//! says v != 0. Where it has the gap and one half, the row of the other half vanishes with theirs
//! ([`Rows::vanishing`]), and no sign of it is asked for.
//!
//! Input: the integral rows of the pencil, the window and the claim. The rows of F that belong to
//! the pencil are the integral ones, multiples of the given rows; their zeros are the same. All
//! numbers are integers over one common unit, so nothing is rounded.

use super::AcceptedClaim;
use super::exact_solution::{index_set, one_half, within};
use super::pencil::{Row, Rows};
use super::reason::Reason;
use crate::certificate::EnclosedSolution;
use mceip_exact::{Integer, Interval, Rational, cleared, common_denominator};
use mceip_model::Window;
use mceip_model::file::Number;
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

    one_half(rows, &claim.support)?;
    Reason::at_most("exponent", MAX_EXPONENT.into(), claim.exponent.into())?;

    let is_in_support = |i: &usize| claim.support.binary_search(i).is_ok();
    let active: Vec<usize> = (0..rows.order())
        .filter(|i| rows.is_free[*i] || is_in_support(i))
        .collect();
    check_shape(claim, active.len() + 1)?;

    let system = Krawczyk::new(rows, claim, &active);
    system.contracts(claim)?;

    let value = system.component(active.len());
    within(window, &value)?;
    for (k, &index) in active.iter().enumerate() {
        if is_in_support(&index) {
            Reason::x_positive(index, &system.component(k))?;
        }
    }

    let vanishing = rows.vanishing(&claim.support);
    for (index, row) in rows.rows.iter().enumerate() {
        let is_zero = active.binary_search(&index).is_ok() || vanishing.contains(&index);
        if !is_zero {
            Reason::y_positive(index, &system.row_over_box(row))?;
        }
    }

    Ok(AcceptedClaim {
        support: claim.support.clone(),
        value,
    })
}

/// Demands `unknowns` entries in every list, and positive radii.
fn check_shape(claim: &EnclosedSolution, unknowns: usize) -> Result<(), Reason> {
    Reason::length("center", unknowns, claim.center.len())?;
    Reason::length("radius", unknowns, claim.radius.len())?;
    Reason::length("preconditioner", unknowns, claim.preconditioner.len())?;
    for row in &claim.preconditioner {
        Reason::length("preconditioner row", unknowns, row.len())?;
    }

    for (index, radius) in claim.radius.iter().enumerate() {
        if !radius.0.is_positive() {
            return Err(Reason::Radius {
                index,
                got: radius.0.clone(),
            });
        }
    }

    Ok(())
}

/// The numbers times `unit`, a common multiple of their denominators.
fn in_units(unit: &Integer, numbers: &[Number]) -> Vec<Integer> {
    numbers.iter().map(|n| cleared(&n.0, unit)).collect()
}

/// [center - radius, center + radius]. All radii here are sums of absolute values or have been
/// found positive, so the ends are in order.
fn ball(center: &Rational, radius: &Rational) -> Interval {
    Interval::new(center - radius, center + radius)
        .unwrap_or_else(|| Interval::point(center.clone()))
}

/// The box, F(c), F'(c) and d in integers. One `unit` is the number 1 in the units of c and r.
struct Krawczyk {
    /// Common denominator of centre and radius.
    unit: Integer,
    /// unit c; the last entry is that of t.
    center: Vec<Integer>,
    /// unit r.
    radius: Vec<Integer>,
    /// Where a variable of the pencil stands among the unknowns, if it is active.
    place: Vec<Option<usize>>,
    /// unit^2 F(c).
    f: Vec<Integer>,
    /// unit F'(c), sparse rows (unknown, value).
    jacobian: Vec<Vec<(usize, Integer)>>,
    /// unit^2 d.
    d: Vec<Integer>,
}

impl Krawczyk {
    fn new(rows: &Rows, claim: &EnclosedSolution, active: &[usize]) -> Krawczyk {
        let numbers = claim.center.iter().chain(&claim.radius);
        let unit = common_denominator(numbers.map(|n| &n.0));
        let mut place = vec![None; rows.order()];
        for (k, &i) in active.iter().enumerate() {
            place[i] = Some(k);
        }

        let mut system = Krawczyk {
            center: in_units(&unit, &claim.center),
            radius: in_units(&unit, &claim.radius),
            unit,
            place,
            f: Vec::new(),
            jacobian: Vec::new(),
            d: Vec::new(),
        };
        for &i in active {
            system.push_row(&rows.rows[i]);
        }

        system.push_normalisation(rows, active);
        system
    }

    /// The position of t, after the active variables.
    fn t(&self) -> usize {
        self.center.len() - 1
    }

    /// Appends the equation sum_j (A_ij + t B_ij) x_j = 0.
    fn push_row(&mut self, row: &Row) {
        let t = self.t();
        let mut f_i = Integer::zero();
        let mut d_i = Integer::zero();
        let mut b_x = Integer::zero(); // unit (B c_x)_i, the derivative with respect to t
        let mut jacobian_row = Vec::new();

        for (j, a, b) in row {
            let Some(k) = self.place[*j] else { continue }; // x_j = 0
            let coefficient = a * &self.unit + b * &self.center[t]; // unit (A + c_t B)_ij

            f_i += &coefficient * &self.center[k];
            d_i += b.abs() * &self.radius[k] * &self.radius[t] * 2;
            b_x += b * &self.center[k];
            jacobian_row.push((k, coefficient));
        }

        jacobian_row.push((t, b_x));

        self.f.push(f_i);
        self.jacobian.push(jacobian_row);
        self.d.push(d_i);
    }

    /// Appends the equation e'x_s - 1 = 0, which is linear.
    fn push_normalisation(&mut self, rows: &Rows, active: &[usize]) {
        let mut sum = Integer::zero(); // unit e'c_s
        let mut jacobian_row = Vec::new();

        for (k, &i) in active.iter().enumerate() {
            if !rows.is_free[i] {
                sum += &self.center[k];
                jacobian_row.push((k, self.unit.clone()));
            }
        }

        self.f.push((sum - &self.unit) * &self.unit);
        self.jacobian.push(jacobian_row);
        self.d.push(Integer::zero());
    }

    /// The interval of one unknown.
    fn component(&self, unknown: usize) -> Interval {
        let center = Rational::new(self.center[unknown].clone(), self.unit.clone());
        let radius = Rational::new(self.radius[unknown].clone(), self.unit.clone());
        ball(&center, &radius)
    }

    /// Encloses a row of (A + tB) x over the box, by the centred form.
    ///
    /// With e_j = A_ij + c_t B_ij the row at z is
    ///
    /// ```text
    ///     sum e_j c_j + sum e_j (x_j - c_j)
    ///         + (t - c_t) sum B_ij c_j + (t - c_t) sum B_ij (x_j - c_j).
    /// ```
    fn row_over_box(&self, row: &Row) -> Interval {
        let center_t = &self.center[self.t()];
        let radius_t = &self.radius[self.t()];

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
        ball(
            &Rational::new(middle, unit.clone()),
            &Rational::new(slack, unit),
        )
    }

    /// Demands |Y F(c)| + |I - Y F'(c)| r + |Y| d < r, in units of 1 / (2^exponent unit^2).
    fn contracts(&self, claim: &EnclosedSolution) -> Result<(), Reason> {
        let one = (Integer::one() << claim.exponent) * &self.unit; // 1 in units of Y F'

        for (index, y) in claim.preconditioner.iter().enumerate() {
            let mut y_f = Integer::zero();
            let mut y_d = Integer::zero();
            let mut defect = vec![Integer::zero(); self.f.len()]; // row of I - Y F'(c)
            defect[index] = one.clone();

            for (i, y_i) in y.iter().enumerate() {
                if y_i.is_zero() {
                    continue;
                }

                y_f += y_i * &self.f[i];
                y_d += y_i.abs() * &self.d[i];
                for (k, value) in &self.jacobian[i] {
                    defect[*k] -= y_i * value;
                }
            }

            let mut left = y_f.abs() + y_d;
            for (k, entry) in defect.iter().enumerate() {
                left += entry.abs() * &self.radius[k];
            }

            let right = &self.radius[index] * &one;

            if left >= right {
                let scale = &one * &self.unit;
                return Err(Reason::NotContracting {
                    index,
                    got: Rational::new(left, scale.clone()),
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

    /// Two active variables, and a third at rest whose row is (1 + 2t) x_0 + (-1 + t) x_1.
    fn resting_row() -> Rows {
        let of = |v: [[i64; 2]; 2]| -> Row {
            v.iter()
                .enumerate()
                .map(|(j, [a, b])| (j, (*a).into(), (*b).into()))
                .collect()
        };
        Rows {
            halves: vec![],
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

    /// The box |x_0 - 1/2| <= 3/8, |x_1 - 1/2| <= 1/8, |t - 1| <= 1/4 for two active variables.
    fn box_of_two() -> EnclosedSolution {
        EnclosedSolution {
            support: vec![0, 1],
            center: numbers([rational(1, 2), rational(1, 2), rational(1, 1)]),
            radius: numbers([rational(3, 8), rational(1, 8), rational(1, 4)]),
            preconditioner: vec![],
            exponent: 0,
        }
    }

    fn integers<const N: usize>(list: [i64; N]) -> Vec<Integer> {
        list.map(Integer::from).to_vec()
    }

    /// At c, t = 1: e = (3, 0), sum e c = 3/2 and sum B c = 3/2. The slack is 3 3/8 + 3/2 1/4 +
    /// (2 3/8 + 1 1/8) 1/4 = 55/32.
    #[test]
    fn a_row_over_the_box_by_hand() {
        let rows = resting_row();
        let claim = box_of_two();

        let image = Krawczyk::new(&rows, &claim, &[0, 1]).row_over_box(&rows.rows[2]);

        assert_eq!(*image.lo(), rational(48 - 55, 32));
        assert_eq!(*image.hi(), rational(48 + 55, 32));
    }

    /// Row 2 as an active one, in units of 1/8, where c = (4, 4, 8) and r = (3, 1, 2). Its
    /// coefficients at c are (3, 0) and its derivative by t is 2/2 + 1/2, so unit^2 F = 3 8 4 and
    /// unit^2 d = 2 (2 3 2 + 1 1 2).
    #[test]
    fn the_row_of_an_equation_by_hand() {
        let rows = resting_row();
        let mut system = Krawczyk::new(&rows, &box_of_two(), &[0, 1]);

        system.push_row(&rows.rows[2]);

        assert_eq!(system.f.last(), Some(&Integer::from(96)));
        assert_eq!(system.d.last(), Some(&Integer::from(28)));
        let expected: Vec<(usize, Integer)> = (0..3).zip(integers([24, 0, 12])).collect();
        assert_eq!(system.jacobian.last(), Some(&expected));
    }

    /// e'c - 1 = 1/4 at c = (3/4, 1/2): 16 in units of 1/64, with the unit 8 as its coefficients.
    #[test]
    fn the_normalisation_by_hand() {
        let rows = resting_row();
        let mut claim = box_of_two();
        claim.center = numbers([rational(3, 4), rational(1, 2), rational(1, 1)]);

        let system = Krawczyk::new(&rows, &claim, &[0, 1]);

        assert_eq!(system.unit, Integer::from(8));
        assert_eq!(system.f.last(), Some(&Integer::from(16)));
        assert_eq!(system.d.last(), Some(&Integer::zero()));
        let expected: Vec<(usize, Integer)> = (0..2).zip(integers([8, 8])).collect();
        assert_eq!(system.jacobian.last(), Some(&expected));
    }
}
