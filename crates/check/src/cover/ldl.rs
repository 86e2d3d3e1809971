//! Leaf `ldl`: sym(A + tB) of the pencil as given is definite on what may move, by an exact LDL' at
//! each end. The conditions (19) and (20) themselves, over an interval of any length, with no
//! margin lost.
//!
//! x'T(t)x = x'y = 0 for a solution. If sym T is definite at the lower end and at the upper one, it
//! is so between; at an infinite end the direction B may be semidefinite.

use super::{CoverFault, Region, State};
use crate::certificate::{Ldl, LdlFactor};
use crate::pencil::Rows;
use mceip_exact::{Integer, Rational};
use num_traits::{Signed, Zero};

const ENDS: [&str; 2] = ["lower", "upper"];
/// Largest order, and order^2 times bits of the longest number: bounds the work on a small file.
const MAX_ORDER: u64 = 128;
const MAX_SIZE: u64 = 1 << 22;

pub(super) fn check(
    rows: &Rows,
    region: &Region,
    index: &[usize],
    ldl: &Ldl,
) -> Result<(), CoverFault> {
    let at_rest = |i: &usize| {
        index
            .binary_search(i)
            .is_ok_and(|p| region.states[p] == State::Rest)
    };
    let active: Vec<usize> = (0..rows.order()).filter(|i| !at_rest(i)).collect();
    let one = Rational::from_integer(Integer::from(1));
    // T(t) = A + tB at the ends, the direction B at infinity.
    let upper = region.hi.as_ref().map_or_else(
        || (Rational::zero(), one.clone()),
        |hi| (one.clone(), hi.clone()),
    );
    let weights = [(one.clone(), region.lo.clone()), upper];
    let sign = ldl
        .lower
        .diagonal
        .first()
        .map_or(1, |d| if d.0.is_negative() { -1 } else { 1 });
    for (end, (factor, (a, b))) in [&ldl.lower, &ldl.upper]
        .into_iter()
        .zip(&weights)
        .enumerate()
    {
        lengths(factor, active.len())?;
        let weak = end == 1 && region.hi.is_none();
        let wrong = |d: &Rational| {
            if d.is_zero() {
                !weak
            } else {
                d.is_negative() != (sign < 0)
            }
        };
        if let Some(k) = factor.diagonal.iter().position(|d| wrong(&d.0)) {
            return Err(CoverFault::NotDefinite {
                index: active[k],
                end: ENDS[end],
            });
        }
        let symmetric = symmetric_part(rows, &active, a, b);
        for i in 0..active.len() {
            for j in 0..=i {
                if product(factor, i, j) != symmetric[i][j] {
                    return Err(CoverFault::Factor {
                        row: active[i],
                        column: active[j],
                        end: ENDS[end],
                    });
                }
            }
        }
    }
    Ok(())
}

fn lengths(factor: &LdlFactor, order: usize) -> Result<(), CoverFault> {
    let length = |what, expected, got| {
        if expected == got {
            Ok(())
        } else {
            Err(CoverFault::Length {
                what,
                expected,
                got,
            })
        }
    };
    length("ldl diagonal", order, factor.diagonal.len())?;
    length("ldl rows", order, factor.rows.len())?;
    factor
        .rows
        .iter()
        .enumerate()
        .try_for_each(|(i, row)| length("ldl row", i, row.len()))?;
    let at_most = |what, limit, got| {
        if got > limit {
            Err(CoverFault::TooLarge { what, limit, got })
        } else {
            Ok(())
        }
    };
    at_most("ldl order", MAX_ORDER, order as u64)?;
    let numbers = factor.rows.iter().flatten().chain(&factor.diagonal);
    let bits = numbers
        .map(|n| n.0.numer().bits() + n.0.denom().bits())
        .max()
        .unwrap_or(0);
    at_most(
        "ldl size (order squared times bits)",
        MAX_SIZE,
        bits.saturating_mul((order * order) as u64),
    )
}

/// (L D L')_ij for j <= i.
fn product(f: &LdlFactor, i: usize, j: usize) -> Rational {
    let entry = |r: usize, k: usize| if k == r { None } else { Some(&f.rows[r][k].0) };
    let mut sum = Rational::zero();
    for k in 0..=j {
        let mut term = f.diagonal[k].0.clone();
        for l in [entry(i, k), entry(j, k)].into_iter().flatten() {
            term *= l;
        }
        sum += term;
    }
    sum
}

/// sym(a A + b B) on the active variables, lower triangle.
fn symmetric_part(rows: &Rows, active: &[usize], a: &Rational, b: &Rational) -> Vec<Vec<Rational>> {
    let mut out: Vec<Vec<Rational>> = (0..active.len())
        .map(|i| vec![Rational::zero(); i + 1])
        .collect();
    for (i, &row) in active.iter().enumerate() {
        let half = Rational::new(Integer::from(1), &rows.factor[row] * 2);
        for (column, c, l) in &rows.rows[row] {
            let Ok(j) = active.binary_search(column) else {
                continue;
            };
            let value = (a * Rational::from_integer(c.clone())
                + b * Rational::from_integer(l.clone()))
                * &half;
            // The diagonal entry is met once, halved.
            out[i.max(j)][i.min(j)] += if i == j {
                value * Rational::from_integer(Integer::from(2))
            } else {
                value
            };
        }
    }
    out
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
        let states = vec![State::Open, State::Moving];
        let region = Region {
            lo: whole(1),
            hi: hi.map(whole),
            states,
            matrices: Default::default(),
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
        let not = |index, end| Err(CoverFault::NotDefinite { index, end });
        let mixed = Ldl {
            upper: negative.upper.clone(),
            ..positive.clone()
        };
        assert_eq!(verdict(1, Some(3), &mixed), not(0, "upper"));
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
        assert_eq!(verdict(-1, Some(3), &turned), not(1, "lower"));
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
                index: 1,
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
                index: 1,
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
        let of = |order: usize, entry: Rational| {
            let rows = (0..order).map(|i| vec![Number(whole(0)); i]).collect();
            let diagonal = (0..order).map(|_| Number(entry.clone())).collect();
            lengths(&LdlFactor { rows, diagonal }, order)
        };
        let large = |what, limit, got| Err(CoverFault::TooLarge { what, limit, got });
        assert_eq!(
            [of(128, whole(1)), of(129, whole(1))],
            [Ok(()), large("ldl order", 128, 129)]
        );
        // Numerator and denominator count: 2^k has k + 1 bits.
        let power = |up: u64, down: u64| {
            Rational::new(Integer::from(1) << up, (Integer::from(1) << down) + 1)
        };
        let size = "ldl size (order squared times bits)";
        assert_eq!(of(4, power((1 << 18) - 3, 1)), Ok(()));
        assert_eq!(
            of(4, power((1 << 18) - 2, 1)),
            large(size, 1 << 22, (1 << 22) + 16)
        );
        assert_eq!(
            of(4, power(1 << 17, 1 << 17)),
            large(size, 1 << 22, (1 << 22) + 32)
        );
    }
}
