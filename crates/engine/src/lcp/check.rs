//! Is a rational point a solution of a plain problem? Exact: it multiplies and compares.
//!
//! z is a solution if l <= z <= u and F = M z + q has F_i >= 0 where z_i = l_i, F_i <= 0 where z_i
//! = u_i, and F_i = 0 between the bounds. z is written over one denominator first, and each row of
//! F is multiplied by a positive integer, so that only integers are added. Called by `certify`, and
//! by `verdict` for the points of a file.

use super::exact::ExactMcp;
use mceip_exact::{Integer, Rational, cleared, common_denominator};
use num_traits::{Signed, Zero};

/// (Unknowns) x (bits of a point over its common denominator) at most, so that a small file cannot
/// buy much time. Unit: bits.
pub const POINT_BITS: u64 = 1 << 24;
/// Bits of a point over its common denominator, at most. Unit: bits.
pub const NUMBER_BITS: u64 = 1 << 19;

/// The first line of the definition that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Violated {
    /// The point has the wrong length.
    #[error("expected {expected} components, got {got}")]
    Length {
        /// Unknowns of the problem.
        expected: usize,
        /// Components given.
        got: usize,
    },
    /// Larger than the checker will multiply out.
    #[error("expected at most {expected} bits over the common denominator, got {got}")]
    TooLarge {
        /// Bits allowed for this number of unknowns.
        expected: u64,
        /// Bits of the common denominator (as far as it was formed) and the longest numerator.
        got: u64,
    },
    /// z_i is outside its bounds.
    #[error("z[{index}]: expected between its bounds, got {got}")]
    Bounds {
        /// The unknown.
        index: usize,
        /// Its value.
        got: Rational,
    },
    /// F_i has the wrong sign for where z_i stands.
    #[error("F[{index}]: expected {expected}, got {got}")]
    Sign {
        /// The row.
        index: usize,
        /// What the place of z_i asks for.
        expected: &'static str,
        /// Its value.
        got: Rational,
    },
}

/// Checks l <= z <= u, F_i >= 0 at the lower bound, <= 0 at the upper one, = 0 between.
///
/// # Errors
/// [`Violated`], the first line that fails.
pub fn check(problem: &ExactMcp, z: &[Rational]) -> Result<(), Violated> {
    if z.len() != problem.dimension() {
        return Err(Violated::Length {
            expected: problem.dimension(),
            got: z.len(),
        });
    }

    let point = IntegerPoint::new(z)?;
    for (index, z_i) in z.iter().enumerate() {
        let (lower, upper) = problem.bounds(index);
        if lower.is_some_and(|l| z_i < l) || upper.is_some_and(|u| z_i > u) {
            return Err(Violated::Bounds {
                index,
                got: z_i.clone(),
            });
        }

        let f_i = ScaledComponent::new(problem, index, &point);
        let is_at_lower = lower == Some(z_i);
        let is_at_upper = upper == Some(z_i);
        let (holds, expected) = match (is_at_lower, is_at_upper) {
            (true, true) => (true, "anything"),
            (true, false) => (!f_i.multiple.is_negative(), ">= 0 at the lower bound"),
            (false, true) => (!f_i.multiple.is_positive(), "<= 0 at the upper bound"),
            (false, false) => (f_i.multiple.is_zero(), "0 between the bounds"),
        };
        if !holds {
            return Err(Violated::Sign {
                index,
                expected,
                got: Rational::new(f_i.multiple, f_i.factor),
            });
        }
    }

    Ok(())
}

/// A point as integers over one denominator.
struct IntegerPoint {
    numerators: Vec<Integer>,
    denominator: Integer,
}

impl IntegerPoint {
    /// Fails where the numbers are longer than a file of that length may ask for. The length is
    /// checked at each step, before longer numbers are formed.
    fn new(z: &[Rational]) -> Result<IntegerPoint, Violated> {
        let allowed = (POINT_BITS / (z.len() as u64).max(1)).min(NUMBER_BITS);

        let mut denominator = Integer::from(1);
        for z_i in z {
            require_bits(z_i.denom().bits().max(z_i.numer().bits()), allowed)?;
            let so_far = Rational::new_raw(1.into(), denominator);
            denominator = common_denominator([&so_far, z_i]);
            require_bits(denominator.bits(), allowed)?;
        }

        let numerators = z.iter().map(|v| cleared(v, &denominator));
        let numerators: Vec<Integer> = numerators.collect();
        let longest = numerators.iter().map(Integer::bits).max().unwrap_or(0);
        require_bits(denominator.bits() + longest, allowed)?;

        Ok(IntegerPoint {
            numerators,
            denominator,
        })
    }
}

fn require_bits(bits: u64, allowed: u64) -> Result<(), Violated> {
    if bits <= allowed {
        Ok(())
    } else {
        Err(Violated::TooLarge {
            expected: allowed,
            got: bits,
        })
    }
}

/// F_i times a positive integer, and that integer.
struct ScaledComponent {
    multiple: Integer,
    factor: Integer,
}

impl ScaledComponent {
    fn new(problem: &ExactMcp, i: usize, z: &IntegerPoint) -> ScaledComponent {
        let (row, q) = problem.row(i);
        let scale = common_denominator(row.iter().chain([q]));

        let mut multiple = cleared(q, &scale) * &z.denominator;
        for (m, z_j) in row.iter().zip(&z.numerators) {
            if !m.is_zero() {
                multiple += cleared(m, &scale) * z_j;
            }
        }

        ScaledComponent {
            multiple,
            factor: scale * &z.denominator,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lcp::read_mcp;
    use mceip_exact::{rational, whole};

    /// z0 in [0, 3/2] with F0 = 1 - z0 (solutions 0, 1, 3/2 once z1 is free and F1 = z1 / 3 + z0 /
    /// 7 vanishes).
    fn problem() -> ExactMcp {
        read_mcp(
            r#"{"format":"mceip-mcp/1","m":[[-1,0],["1/7","1/3"]],"q":[1,0],
                "lower":[0,null],"upper":["3/2",null]}"#,
        )
        .unwrap()
    }

    #[test]
    fn every_place_and_its_near_misses() {
        let problem = problem();
        for z0 in [whole(0), whole(1), rational(3, 2)] {
            let z1 = -&z0 * rational(3, 7);
            assert_eq!(check(&problem, &[z0.clone(), z1.clone()]), Ok(()));

            // The scaled row is F itself, and a thousandth of it off is seen.
            let off = &z1 + rational(1, 1000);
            let got = problem.function(&[z0.clone(), off.clone()])[1].clone();
            assert_eq!(
                check(&problem, &[z0, off]),
                Err(Violated::Sign {
                    index: 1,
                    expected: "0 between the bounds",
                    got
                })
            );
        }

        assert!(matches!(
            check(&problem, &[rational(1, 2), whole(0)]),
            Err(Violated::Sign { index: 0, .. })
        ));
        assert!(matches!(
            check(&problem, &[whole(2), whole(0)]),
            Err(Violated::Bounds { index: 0, .. })
        ));

        let narrow =
            read_mcp(r#"{"format":"mceip-mcp/1","m":[[1]],"q":[-2],"upper":[1]}"#).unwrap();
        assert_eq!(check(&narrow, &[whole(1)]), Ok(()));

        let wrong =
            read_mcp(r#"{"format":"mceip-mcp/1","m":[[1]],"q":[2],"lower":[-1],"upper":[1]}"#)
                .unwrap();
        assert!(matches!(
            check(&wrong, &[whole(1)]),
            Err(Violated::Sign {
                expected: "<= 0 at the upper bound",
                ..
            })
        ));

        let fixed =
            read_mcp(r#"{"format":"mceip-mcp/1","m":[[1]],"q":[-9],"lower":[1],"upper":[1]}"#)
                .unwrap();
        assert_eq!(check(&fixed, &[whole(1)]), Ok(()));
        assert!(matches!(
            check(&fixed, &[whole(2)]),
            Err(Violated::Bounds { .. })
        ));
    }

    /// 1 / d with a denominator d of 16,001 bits that depends on i.
    fn long(i: usize) -> Rational {
        Rational::new(1.into(), (Integer::from(1) << 16_000) + 2 * i + 1)
    }

    /// Long numbers with denominators of their own are refused before they are multiplied.
    #[test]
    fn size_is_bounded() {
        let n = 64usize;
        let m = vec![vec![whole(0); n]; n];
        let problem = ExactMcp::new(m, vec![whole(0); n], vec![None; n], vec![None; n]).unwrap();

        let different: Vec<Rational> = (0..n).map(long).collect();
        assert!(matches!(
            check(&problem, &different),
            Err(Violated::TooLarge {
                expected: 262_144,
                ..
            })
        ));

        assert_eq!(check(&problem, &vec![long(1); n]), Ok(()));

        let too_long = Rational::from_integer(Integer::from(1) << 300_000);
        assert!(matches!(
            check(&problem, &vec![too_long; n]),
            Err(Violated::TooLarge { .. })
        ));
    }
}
