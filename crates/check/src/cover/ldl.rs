//! Leaf `ldl`: sym(A + tB) is definite on the interval, by exact factors at both ends.
//!
//! Here A and B are the matrices as given, with the free variables: rows are not scaled, nothing is
//! condensed. Let P be the free variables and those that may be in the support. A solution is zero
//! outside P, so x'(A + tB)x = x'y = 0. If S(t) = sym(A + tB), restricted to P, is positive
//! definite for every t of the interval, or negative definite for every t, then x = 0, and there is
//! no solution.
//!
//! The leaf gives a unit lower triangular L and a diagonal D at each end with L D L' = S exactly. S
//! is definite if all d_i have one sign. S between two ends is a convex combination, so it is
//! definite with them if the sign is the same. On a half line S(t) = S(lo) + (t - lo) sym(B): there
//! the second factors are those of sym(B), and d_i = 0 is allowed.
//!
//! These are conditions (19) and (20) over an interval of any length, with no margin lost. Called
//! by the walk through the trees.

use super::context::Context;
use super::fault::CoverFault;
use super::leaf::{Leaf, Yield};
use super::region::Region;
use crate::certificate::{Ldl, LdlFactor, VariableState};
use crate::pencil::Rows;
use mceip_exact::{Integer, Rational};
use num_traits::{One, Signed, Zero};

/// Largest order.
const MAX_ORDER: u64 = 128;
/// Largest product of order^2 and the bits of the longest number: bounds the work on a small file.
const MAX_SIZE: u64 = 1 << 22;

/// The matrix a A + b B at one end of the interval.
struct LdlEnd {
    name: &'static str,
    a: Rational,
    b: Rational,
    /// Is this the direction B, at infinity, so that semidefinite suffices?
    is_infinite: bool,
}

impl LdlEnd {
    /// A + tB, at infinity B.
    fn at(name: &'static str, t: Option<&Rational>) -> LdlEnd {
        let [a, b] = match t {
            Some(t) => [Rational::one(), t.clone()],
            None => [Rational::zero(), Rational::one()],
        };
        LdlEnd {
            name,
            a,
            b,
            is_infinite: t.is_none(),
        }
    }

    /// What is expected of the entries of D here.
    fn expected_sign(&self, is_negative: bool) -> &'static str {
        match (is_negative, self.is_infinite) {
            (false, false) => "> 0",
            (true, false) => "< 0",
            (false, true) => ">= 0",
            (true, true) => "<= 0",
        }
    }
}

impl Leaf for Ldl {
    fn check(&self, at: &Region, context: &Context<'_>) -> Result<Yield, CoverFault> {
        check(context.rows, at, &context.index, self)?;
        Ok(Yield::default())
    }
}

fn check(rows: &Rows, region: &Region, index: &[usize], ldl: &Ldl) -> Result<(), CoverFault> {
    let at_zero = region.positions(|state| state == VariableState::AtZero);
    let at_zero: Vec<usize> = at_zero.into_iter().map(|p| index[p]).collect();
    let possible: Vec<usize> = (0..rows.order())
        .filter(|i| at_zero.binary_search(i).is_err())
        .collect();

    let lower = LdlEnd::at("lower", Some(&region.lo));
    let upper = LdlEnd::at("upper", region.hi.as_deref());

    let first = ldl.lower.diagonal.first();
    let is_negative = first.is_some_and(|d| d.0.is_negative());
    check_end(rows, &possible, &lower, &ldl.lower, is_negative)?;
    check_end(rows, &possible, &upper, &ldl.upper, is_negative)
}

/// Demands that the factors are those of the symmetric part at this end, and that D has the sign.
fn check_end(
    rows: &Rows,
    variables: &[usize],
    end: &LdlEnd,
    factor: &LdlFactor,
    is_negative: bool,
) -> Result<(), CoverFault> {
    check_shape(factor, variables.len())?;

    for (k, d) in factor.diagonal.iter().enumerate() {
        let has_sign = if d.0.is_zero() {
            end.is_infinite
        } else {
            d.0.is_negative() == is_negative
        };
        if !has_sign {
            return Err(CoverFault::NotDefinite {
                leaf: "ldl",
                index: variables[k],
                expected: end.expected_sign(is_negative),
                end: end.name,
            });
        }
    }

    let symmetric = symmetric_part(rows, variables, end);
    for i in 0..variables.len() {
        for j in 0..=i {
            if product(factor, i, j) != symmetric[i][j] {
                return Err(CoverFault::Factor {
                    row: variables[i],
                    column: variables[j],
                    end: end.name,
                });
            }
        }
    }

    Ok(())
}

/// Demands the shape of a triangle and a diagonal of this order, within the limits.
fn check_shape(factor: &LdlFactor, order: usize) -> Result<(), CoverFault> {
    CoverFault::length("ldl diagonal", order, factor.diagonal.len())?;
    CoverFault::length("ldl rows", order, factor.rows.len())?;
    for (i, row) in factor.rows.iter().enumerate() {
        CoverFault::length("ldl row", i, row.len())?;
    }

    CoverFault::at_most("ldl order", MAX_ORDER, order as u64)?;

    let mut bits = 0;
    for n in factor.rows.iter().flatten().chain(&factor.diagonal) {
        bits = bits.max(n.0.numer().bits() + n.0.denom().bits());
    }

    let size = bits.saturating_mul((order * order) as u64);
    CoverFault::at_most("ldl size (order squared times bits)", MAX_SIZE, size)
}

/// (L D L')_ij for j <= i.
fn product(factor: &LdlFactor, i: usize, j: usize) -> Rational {
    let mut sum = Rational::zero();
    for k in 0..=j {
        let mut term = factor.diagonal[k].0.clone();
        // L_kk = 1.
        if k < i {
            term *= &factor.rows[i][k].0;
        }

        if k < j {
            term *= &factor.rows[j][k].0;
        }

        sum += term;
    }

    sum
}

/// sym(a A + b B) on these variables, lower triangle.
fn symmetric_part(rows: &Rows, variables: &[usize], end: &LdlEnd) -> Vec<Vec<Rational>> {
    let mut sum: Vec<Vec<Rational>> = Vec::with_capacity(variables.len());
    for i in 0..variables.len() {
        sum.push(vec![Rational::zero(); i + 1]);
    }

    for (i, &row) in variables.iter().enumerate() {
        // Rows are integral multiples of the given ones.
        let factor = Rational::new(Integer::one(), rows.factor[row].clone());
        let half = Rational::new(Integer::one(), &rows.factor[row] * 2);

        for (column, a, b) in &rows.rows[row] {
            let Ok(j) = variables.binary_search(column) else {
                continue;
            };
            let a = Rational::from_integer(a.clone());
            let b = Rational::from_integer(b.clone());
            let entry = &end.a * a + &end.b * b;

            // An entry off the diagonal is half of the symmetric one; the other half is its mirror.
            let share = if i == j { &factor } else { &half };
            sum[i.max(j)][i.min(j)] += entry * share;
        }
    }

    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, parse, whole};
    use mceip_model::file::Number;
    use mceip_model::{Body, Pencil, Problem, Unknown, Window};

    fn number(v: &str) -> Number {
        Number(parse(v).unwrap())
    }

    fn factor(diagonal: [&str; 2], below: &str) -> LdlFactor {
        LdlFactor {
            rows: vec![vec![], vec![number(below)]],
            diagonal: diagonal.map(number).to_vec(),
        }
    }

    /// sign ([[2, 3], [-1, 4]] + t [[1, 0], [0, 0]]) from 1 to 3 or to infinity: sym is [[2 + t,
    /// 1], [1, 4]].
    fn verdict(sign: i64, hi: Option<i64>, ldl: &Ldl) -> Result<(), CoverFault> {
        let sparse = |rows: [[i64; 2]; 2]| {
            let entries =
                [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| (i, j, whole(sign * rows[i][j])));
            Sparse::from_entries(2, 2, entries)
        };
        let pencil =
            Pencil::new(sparse([[2, 3], [-1, 4]]), sparse([[1, 0], [0, 0]]), vec![]).unwrap();
        let rows =
            Rows::of(&Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap());
        let states = vec![VariableState::Undecided, VariableState::InSupport];
        let region = Region {
            states,
            ..Region::new(whole(1).into(), hi.map(|hi| whole(hi).into()), None, 0)
        };
        check(&rows, &region, &[0, 1], ldl)
    }

    #[test]
    fn definite_of_either_sign_at_both_ends() {
        let positive = Ldl {
            lower: factor(["3", "11/3"], "1/3"),
            upper: factor(["5", "19/5"], "1/5"),
        };
        let negative = Ldl {
            lower: factor(["-3", "-11/3"], "1/3"),
            upper: factor(["-5", "-19/5"], "1/5"),
        };
        assert_eq!(
            [
                verdict(1, Some(3), &positive),
                verdict(-1, Some(3), &negative)
            ],
            [Ok(()), Ok(())]
        );
        let not = |index, expected, end| {
            Err(CoverFault::NotDefinite {
                leaf: "ldl",
                index,
                expected,
                end,
            })
        };
        let mixed = Ldl {
            upper: negative.upper.clone(),
            ..positive.clone()
        };
        assert_eq!(verdict(1, Some(3), &mixed), not(0, "> 0", "upper"));
        let mixed = Ldl {
            lower: negative.lower.clone(),
            ..positive.clone()
        };
        assert_eq!(
            verdict(1, Some(3), &mixed),
            Err(CoverFault::Factor {
                row: 0,
                column: 0,
                end: "lower"
            })
        );
        let mut turned = negative;
        turned.lower.diagonal[1] = number("1");
        assert_eq!(verdict(-1, Some(3), &turned), not(1, "< 0", "lower"));
    }

    /// At infinity, which is no value of the window, B may be semidefinite; at an end it may not.
    #[test]
    fn zero_will_do_at_infinity_only() {
        let lower = factor(["3", "11/3"], "1/3");
        let at_infinity = Ldl {
            lower: lower.clone(),
            upper: factor(["1", "0"], "0"),
        };
        assert_eq!(verdict(1, None, &at_infinity), Ok(()));
        assert_eq!(
            verdict(1, Some(3), &at_infinity),
            Err(CoverFault::NotDefinite {
                leaf: "ldl",
                index: 1,
                expected: "> 0",
                end: "upper"
            })
        );
        let singular = Ldl {
            lower: factor(["3", "0"], "1/3"),
            upper: at_infinity.upper,
        };
        assert_eq!(
            verdict(1, None, &singular),
            Err(CoverFault::NotDefinite {
                leaf: "ldl",
                index: 1,
                expected: "> 0",
                end: "lower"
            })
        );
    }

    #[test]
    fn lists_have_the_length_of_the_block() {
        let length = |what, expected, got| {
            Err(CoverFault::Length {
                what,
                expected,
                got,
            })
        };
        let with = |change: &dyn Fn(&mut LdlFactor)| {
            let mut ldl = Ldl {
                lower: factor(["3", "11/3"], "1/3"),
                upper: factor(["5", "19/5"], "1/5"),
            };
            change(&mut ldl.upper);
            verdict(1, Some(3), &ldl)
        };
        assert_eq!(
            with(&|f| f.diagonal.truncate(1)),
            length("ldl diagonal", 2, 1)
        );
        assert_eq!(with(&|f| f.rows.truncate(1)), length("ldl rows", 2, 1));
        assert_eq!(with(&|f| f.rows[1].clear()), length("ldl row", 1, 0));
        assert_eq!(
            with(&|f| f.rows[0].push(number("0"))),
            length("ldl row", 0, 1)
        );
        assert_eq!(
            with(&|f| f.rows[1][0] = number("1/4")),
            Err(CoverFault::Factor {
                row: 1,
                column: 0,
                end: "upper"
            })
        );
        assert_eq!(
            with(&|f| f.diagonal[1] = number("4")),
            Err(CoverFault::Factor {
                row: 1,
                column: 1,
                end: "upper"
            })
        );
    }

    /// Order 128 and 2^22 bits in all are the largest that are multiplied out.
    #[test]
    fn what_is_multiplied_out_has_a_limit() {
        let shape_of = |order: usize, entry: Rational| {
            let rows = (0..order).map(|i| vec![Number(whole(0)); i]).collect();
            let diagonal = (0..order).map(|_| Number(entry.clone())).collect();
            check_shape(&LdlFactor { rows, diagonal }, order)
        };
        let large = |what, limit, got| Err(CoverFault::TooLarge { what, limit, got });
        assert_eq!(
            [shape_of(128, whole(1)), shape_of(129, whole(1))],
            [Ok(()), large("ldl order", 128, 129)]
        );
        // Numerator and denominator count: 2^k has k + 1 bits.
        let power = |up: u64, down: u64| {
            Rational::new(Integer::from(1) << up, (Integer::from(1) << down) + 1)
        };
        let size = "ldl size (order squared times bits)";
        assert_eq!(shape_of(4, power((1 << 18) - 3, 1)), Ok(()));
        assert_eq!(
            shape_of(4, power((1 << 18) - 2, 1)),
            large(size, 1 << 22, (1 << 22) + 16)
        );
        assert_eq!(
            shape_of(4, power(1 << 17, 1 << 17)),
            large(size, 1 << 22, (1 << 22) + 32)
        );
    }
}
