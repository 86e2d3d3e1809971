//! The plain enumerator: the definition (24)-(26) turned into Rust, support by support.

use super::enumeration::{Enumeration, WideKernel};
use super::integral::{Integral, multiplicity};
use super::solution::Solution;
use mceip_exact::{Algebraic, Poly, Sign, roots_in};
use mceip_model::{Pencil, Window};
use std::ops::ControlFlow;

/// Largest number of complementarity variables: each one more doubles the supports.
pub const MAX_SLIP: usize = 16;
/// Largest number of free variables: every support's pencil contains them all.
pub const MAX_FREE: usize = 16;
/// Largest bound of the coefficients of a determinant, in bits: time grows with the square of it.
pub const MAX_BITS: u64 = 8192;

/// Why the enumerator refuses to start.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OracleError {
    /// Too many supports or too large pencils for plain exact arithmetic.
    #[error("the plain enumerator takes at most {limit} {what}, got {got}")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// The bound.
        limit: u64,
        /// What the problem has.
        got: u64,
    },
}

/// All solutions of the mixed complementarity eigenproblem with value in the window.
///
/// # Errors
/// [`OracleError::TooLarge`] beyond [`MAX_SLIP`], [`MAX_FREE`] or [`MAX_BITS`].
///
/// ```
/// use mceip_exact::{whole, Sparse};
/// use mceip_model::{Pencil, Window};
/// use mceip_oracle::enumerate;
/// // x = (1): (-2 + t) x = y has the one solution t = 2.
/// let a = Sparse::from_entries(1, 1, [(0, 0, whole(-2))]);
/// let pencil = Pencil::new(a, Sparse::identity(1), vec![]).unwrap();
/// let found = enumerate(&pencil, &Window::all()).unwrap();
/// assert_eq!(found.solutions[0].decimal(17), "2");
/// ```
pub fn enumerate(pencil: &Pencil, window: &Window) -> Result<Enumeration, OracleError> {
    enumerate_with(pencil, window, |_, _| ControlFlow::Continue(()))
}

/// [`enumerate`] with a callback (supports done, supports in all) after each support; breaking
/// ends the run and keeps what was found. Supports are counted in binary, the empty one first.
///
/// # Errors
/// As [`enumerate`].
pub fn enumerate_with(
    pencil: &Pencil,
    window: &Window,
    mut progress: impl FnMut(u64, u64) -> ControlFlow<()>,
) -> Result<Enumeration, OracleError> {
    let slip = pencil.slip();
    let at_most = |what, limit, got| {
        if got > limit {
            Err(OracleError::TooLarge { what, limit, got })
        } else {
            Ok(())
        }
    };
    at_most("slip variables", MAX_SLIP as u64, slip.len() as u64)?;
    at_most(
        "free variables",
        MAX_FREE as u64,
        pencil.free().len() as u64,
    )?;
    let integral = Integral::of(pencil);
    at_most(
        "bits of a determinant's coefficients",
        MAX_BITS,
        integral.coefficient_bits(),
    )?;
    let total = 1u64 << slip.len();
    let mut found = Enumeration {
        supports_total: total,
        ..Enumeration::default()
    };
    for subset in 0..total {
        let support: Vec<usize> = slip
            .iter()
            .enumerate()
            .filter(|(k, _)| subset >> k & 1 == 1)
            .map(|(_, &i)| i)
            .collect();
        examine(&integral, &support, window, &mut found);
        found.describe_new(&integral, window); // wide kernels and singular pencils, if any were met
        found.supports_done += 1;
        if progress(found.supports_done, total).is_break() {
            break;
        }
    }
    found.finish();
    Ok(found)
}

/// log2 of a bound of every coefficient of every support's determinant; [`enumerate`] takes at most
/// [`MAX_BITS`].
pub fn coefficient_bits(pencil: &Pencil) -> u64 {
    Integral::of(pencil).coefficient_bits()
}

/// One support by the definition: appends what [`enumerate`] finds on it. For callers that go
/// through supports in their own way; nothing is sorted, no limit is checked.
///
/// `support` lists complementarity variables, ascending.
pub fn examine_support(
    pencil: &Pencil,
    support: &[usize],
    window: &Window,
    found: &mut Enumeration,
) {
    examine(&Integral::of(pencil), support, window, found);
}

/// One support: the linear eigenproblem (25) on free and slip variables, then (26).
fn examine(pencil: &Integral<'_>, support: &[usize], window: &Window, found: &mut Enumeration) {
    let active = pencil.active(support);
    if active.is_empty() {
        return; // x = 0
    }
    let det = pencil.determinant(&active);
    if det.is_zero() {
        found.continua.push(support.to_vec());
        return;
    }
    for (mut value, kernel) in pencil.kernels(&active, roots_in(&det, window.min(), window.max())) {
        match &kernel[..] {
            [vector] => {
                let multiplicity = multiplicity(&det, &mut value);
                found.solutions.extend(admissible(
                    pencil,
                    support,
                    &active,
                    vector,
                    value,
                    multiplicity,
                ));
            }
            wide => found.wide.push(WideKernel {
                value,
                support: support.to_vec(),
                dimension: wide.len(),
            }),
        }
    }
}

/// (26) with the support taken literally: x > 0 on all of it, y >= 0 off it. So a solution with
/// x_i = y_i = 0 is accepted for one support only, and listed once.
fn admissible(
    pencil: &Integral<'_>,
    support: &[usize],
    active: &[usize],
    vector: &[Poly],
    mut value: Algebraic,
    multiplicity: usize,
) -> Vec<Solution> {
    let x = pencil.extend(active, vector);
    // The kernel is a line: orient it. Without slip variables both orientations may do, and then
    // x and -x are two solutions.
    let orientations = match support.first().map(|&i| value.sign_of(&x[i])) {
        Some(Sign::Zero) => return Vec::new(),
        Some(Sign::Positive) => vec![1],
        Some(Sign::Negative) => vec![-1],
        None => vec![1, -1],
    };
    let oriented = orientations.into_iter().filter_map(|sign| {
        let x: Vec<Poly> = x
            .iter()
            .map(|p| if sign == 1 { p.clone() } else { -p })
            .collect();
        let mut value = value.clone();
        if support
            .iter()
            .any(|&i| value.sign_of(&x[i]) != Sign::Positive)
        {
            return None;
        }
        let y = pencil.times(&x);
        let mut biactive = Vec::new();
        for i in (0..pencil.order()).filter(|i| !active.contains(i)) {
            match value.sign_of(&y[i]) {
                Sign::Negative => return None,
                Sign::Zero => biactive.push(i),
                Sign::Positive => {}
            }
        }
        Some(Solution {
            value,
            multiplicity,
            slip: support.to_vec(),
            biactive,
            x,
            y,
        })
    });
    oriented.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, rational, whole};

    fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
        Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
    }

    fn summary(p: &Pencil) -> Vec<(String, Vec<usize>, Vec<usize>)> {
        let found = enumerate(p, &Window::all()).unwrap();
        found
            .solutions
            .iter()
            .map(|s| (s.decimal(8), s.slip.clone(), s.biactive.clone()))
            .collect()
    }

    /// The fold of `spec/errata.md`: no MCEIP-mu solution, yet two MCEIP-lambda2 solutions at mu =
    /// 2.
    #[test]
    fn the_fold_counterexample() {
        let mu = pencil(&[&[1, 0], &[0, 2]], &[&[0, -3], &[1, -4]], &[]);
        assert!(summary(&mu).is_empty());
        let lambda2 = pencil(&[&[1, -6], &[2, -6]], &[&[1, 0], &[0, 1]], &[]);
        assert_eq!(
            summary(&lambda2),
            vec![
                ("2".into(), vec![0, 1], vec![]),
                ("3".into(), vec![0, 1], vec![])
            ]
        );
    }

    #[test]
    fn biactive_solutions_are_listed_once_and_named() {
        // t = 1, x = (1, 0): y_2 = 0 as well.
        let p = pencil(&[&[-1, 5], &[0, 7]], &[&[1, 0], &[0, 1]], &[]);
        assert_eq!(summary(&p), vec![("1".into(), vec![0], vec![1])]);
    }

    #[test]
    fn a_near_miss_in_the_sign_of_y_is_no_solution() {
        let found = |y_1: i64| summary(&pencil(&[&[-1, 0], &[y_1, -3]], &[&[1, 0], &[0, 1]], &[]));
        let only_the_other = vec![("3".into(), vec![1], vec![0])];
        assert_eq!(found(-1), only_the_other);
        assert_eq!(
            found(1)[..2],
            [
                ("1".into(), vec![0], vec![]),
                ("1".into(), vec![0, 1], vec![])
            ]
        );
    }

    #[test]
    fn degenerate_cases_are_reported_as_such() {
        // A = -I, B = I: at t = 1 every vector is in the kernel.
        let wide = enumerate(
            &pencil(&[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, 1]], &[]),
            &Window::all(),
        )
        .unwrap();
        assert_eq!(
            wide.wide
                .iter()
                .map(|w| (w.support.clone(), w.dimension))
                .collect::<Vec<_>>(),
            vec![(vec![0, 1], 2)]
        );
        assert_eq!(wide.solutions.len(), 2); // the two edges, each biactive in the other
        assert!(wide.is_complete_list() && !wide.is_plain_list());
        assert_eq!(
            wide.cones
                .iter()
                .map(|c| (c.slip.clone(), c.dimension, c.rays.len()))
                .collect::<Vec<_>>(),
            vec![(vec![0, 1], 2, 2)]
        );
        let singular = enumerate(
            &pencil(&[&[1, -1], &[-1, 1]], &[&[0, 0], &[0, 0]], &[]),
            &Window::all(),
        )
        .unwrap();
        assert_eq!(singular.continua, vec![vec![0, 1]]);
    }

    #[test]
    fn repeated_roots_carry_their_multiplicity() {
        // A Jordan block: (t-1)^2, kernel of dimension 1.
        let found = enumerate(
            &pencil(&[&[-1, -1], &[0, -1]], &[&[1, 0], &[0, 1]], &[]),
            &Window::all(),
        )
        .unwrap();
        assert_eq!(found.solutions.len(), 1);
        assert_eq!(
            (
                found.solutions[0].slip.clone(),
                found.solutions[0].multiplicity
            ),
            (vec![0], 1)
        );
        let free = enumerate(
            &pencil(&[&[-1, 1], &[0, -1]], &[&[1, 0], &[0, 1]], &[0, 1]),
            &Window::all(),
        )
        .unwrap();
        assert_eq!(
            (free.solutions.len(), free.solutions[0].multiplicity),
            (2, 2)
        ); // x and -x
    }

    #[test]
    fn free_only_solutions_try_both_orientations() {
        // Free variable 0 with value 1; y_1 = -x_0 >= 0 needs x_0 < 0.
        let p = pencil(&[&[-1, 0], &[-1, 1]], &[&[1, 0], &[0, 1]], &[0]);
        let found = enumerate(&p, &Window::all()).unwrap();
        let found = found
            .solutions
            .iter()
            .map(|s| s.x_decimals(&[1], 5))
            .collect::<Vec<_>>();
        assert_eq!(found, vec![vec!["-1", "0"], vec!["2", "1"]]); // l1 norm 1; e'x_s = 1
        // Nothing depends on the sign: two rays, x and -x.
        let p = pencil(&[&[-1, 0], &[0, -5]], &[&[1, 0], &[0, 1]], &[0]);
        let x: Vec<_> = enumerate(&p, &Window::all())
            .unwrap()
            .solutions
            .iter()
            .map(|s| s.x_decimals(&[1], 5))
            .collect();
        assert_eq!(x, vec![vec!["1", "0"], vec!["-1", "0"], vec!["0", "1"]]);
    }

    #[test]
    fn the_window_is_closed_and_limits_are_said() {
        let p = pencil(&[&[-2]], &[&[1]], &[]);
        let count = |a: i64, b: i64| {
            enumerate(&p, &Window::new(whole(a), Some(whole(b))).unwrap())
                .unwrap()
                .solutions
                .len()
        };
        assert_eq!((count(0, 2), count(2, 9), count(0, 1)), (1, 1, 0));
        let window = Window::new(rational(21, 10), None).unwrap();
        assert!(enumerate(&p, &window).unwrap().solutions.is_empty());
        let large = Pencil::new(Sparse::identity(17), Sparse::identity(17), vec![]).unwrap();
        assert!(matches!(
            enumerate(&large, &Window::all()),
            Err(OracleError::TooLarge {
                limit: 16,
                got: 17,
                ..
            })
        ));
    }

    #[test]
    fn an_interrupted_run_says_how_far_it_came() {
        let p = pencil(&[&[-2, 0], &[0, -3]], &[&[1, 0], &[0, 1]], &[]);
        let found = enumerate_with(&p, &Window::all(), |done, _| {
            if done == 2 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        let found = found.unwrap();
        assert_eq!(
            (
                found.supports_done,
                found.is_finished(),
                found.solutions.len()
            ),
            (2, false, 1)
        );
    }
}
