//! The plain enumerator: the definition (24)-(26) turned into Rust, one support after the other.
//!
//! A support J is the set of complementarity variables that are positive; the others are zero. For
//! each of the 2^n_s supports:
//!
//! 1. the block of A + tB on the free variables and J has the determinant det(t);
//! 2. each root t of det in the window is an eigenvalue of the block, (25), with its kernel;
//! 3. a kernel vector x, zero elsewhere, is a solution where x_J > 0 and y = (A + tB) x is >= 0 off
//!    the block, (26). On the block y = 0 already.
//!
//! A solution with x_i = y_i = 0 belongs to one support only, because x_J > 0 is strict; so nothing
//! is listed twice. Two things are not decided here: kernels of more than one dimension (`cone`)
//! and blocks whose determinant vanishes identically (`range`).
//!
//! Input: any pencil or quadratic pencil, no hypothesis, and a closed [`RealWindow`]. Every
//! decision is exact.

use super::enumeration::{Enumeration, WideKernel};
use super::integer_pencil::{Eigenspace, IntegerPencil};
use super::solution::Solution;
use mceip_exact::{Algebraic, Poly, Sign, roots_in};
use mceip_model::RealWindow;
use std::ops::ControlFlow;

/// Largest number of complementarity variables: each one more doubles the supports.
pub const MAX_SLIP: usize = 16;
/// Largest number of free variables: every support's block contains them all.
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
/// use mceip_exact::{Sparse, whole};
/// use mceip_model::{Pencil, Window};
/// use mceip_oracle::enumerate;
///
/// // x = (1): (-2 + t) x = y has the one solution t = 2.
/// let a = Sparse::from_entries(1, 1, [(0, 0, whole(-2))]);
/// let pencil = Pencil::new(a, Sparse::identity(1), vec![]).unwrap();
///
/// let found = enumerate(&pencil, &Window::all()).unwrap();
/// assert_eq!(found.solutions[0].decimal(17), "2");
/// ```
pub fn enumerate<'a>(
    pencil: impl Into<IntegerPencil<'a>>,
    window: impl Into<RealWindow>,
) -> Result<Enumeration, OracleError> {
    enumerate_with(pencil, window, |_, _| ControlFlow::Continue(()))
}

/// [`enumerate`] with a callback (supports done, supports in all) after each support; breaking
/// ends the run and keeps what was found. Supports are counted in binary, the empty one first.
///
/// # Errors
/// As [`enumerate`].
pub fn enumerate_with<'a>(
    pencil: impl Into<IntegerPencil<'a>>,
    window: impl Into<RealWindow>,
    mut progress: impl FnMut(u64, u64) -> ControlFlow<()>,
) -> Result<Enumeration, OracleError> {
    let pencil = &pencil.into();
    let slip = pencil.complementarity_variables();
    require_size(pencil, "slip variables", slip.len())?;

    let window = &window.into();
    let total = 1u64 << slip.len();
    let mut found = Enumeration {
        supports_total: total,
        ..Enumeration::default()
    };

    for number in 0..total {
        let support = support_of_number(&slip, number);
        examine(pencil, &support, window, &mut found);
        found.describe_new(pencil, window);

        found.supports_done += 1;
        if progress(found.supports_done, total).is_break() {
            break;
        }
    }

    found.finish();

    Ok(found)
}

/// Demands that an enumeration of 2^count parts ends; `what` is counted.
pub(super) fn require_size(
    pencil: &IntegerPencil<'_>,
    what: &'static str,
    count: usize,
) -> Result<(), OracleError> {
    require_at_most(MAX_SLIP as u64, what, count as u64)?;
    require_at_most(MAX_FREE as u64, "free variables", pencil.free() as u64)?;

    let bits = pencil.coefficient_bits();
    require_at_most(MAX_BITS, "bits of a determinant's coefficients", bits)
}

fn require_at_most(limit: u64, what: &'static str, got: u64) -> Result<(), OracleError> {
    if got > limit {
        return Err(OracleError::TooLarge { what, limit, got });
    }
    Ok(())
}

/// The variables whose bits are set in `number`.
fn support_of_number(slip: &[usize], number: u64) -> Vec<usize> {
    slip.iter()
        .enumerate()
        .filter(|(bit, _)| number >> bit & 1 == 1)
        .map(|(_, &variable)| variable)
        .collect()
}

/// log2 of a bound of every coefficient of every support's determinant; [`enumerate`] takes at most
/// [`MAX_BITS`].
pub fn coefficient_bits<'a>(pencil: impl Into<IntegerPencil<'a>>) -> u64 {
    pencil.into().coefficient_bits()
}

/// One support by the definition: appends what [`enumerate`] finds on it. For callers that go
/// through supports in their own way; nothing is sorted, no limit is checked.
///
/// `support` lists complementarity variables, ascending.
pub fn examine_support<'a>(
    pencil: impl Into<IntegerPencil<'a>>,
    support: &[usize],
    window: impl Into<RealWindow>,
    found: &mut Enumeration,
) {
    examine(&pencil.into(), support, &window.into(), found);
}

/// One support: the linear eigenproblem (25) on free and slip variables, then (26).
fn examine(
    pencil: &IntegerPencil<'_>,
    support: &[usize],
    window: &RealWindow,
    found: &mut Enumeration,
) {
    let active = pencil.active(support);
    if active.is_empty() {
        return; // x = 0
    }

    let det = pencil.determinant(&active);
    if det.is_zero() {
        found.continua.push(support.to_vec());
        return;
    }

    let roots = roots_in(&det, window.min(), window.max());
    for eigenspace in pencil.eigenspaces(&active, roots) {
        let Eigenspace { mut value, basis } = eigenspace;

        if let [vector] = &basis[..] {
            let multiplicity = multiplicity(&det, &mut value);
            let line = KernelLine {
                x: pencil.extend(&active, vector),
                value,
                multiplicity,
            };
            found.solutions.extend(line.solutions(pencil, support));
        } else {
            found.wide.push(WideKernel {
                value,
                support: support.to_vec(),
                dimension: basis.len(),
            });
        }
    }
}

/// Multiplicity of a root: the order of the first derivative that does not vanish there.
pub(super) fn multiplicity(det: &Poly, value: &mut Algebraic) -> usize {
    let mut derivative = det.derivative();
    let mut order = 1;

    while !derivative.is_zero() && value.sign_of(&derivative) == Sign::Zero {
        derivative = derivative.derivative();
        order += 1;
    }

    order
}

/// A kernel of one dimension: the multiples of x, a vector over all variables.
struct KernelLine {
    x: Vec<Poly>,
    value: Algebraic,
    multiplicity: usize,
}

impl KernelLine {
    /// The rays of the line that satisfy (26): at most one, but without slip variables both x and
    /// -x may.
    fn solutions(mut self, pencil: &IntegerPencil<'_>, support: &[usize]) -> Vec<Solution> {
        let opposite: Vec<Poly> = self.x.iter().map(|x_i| -x_i).collect();
        let rays = match support.first().map(|&i| self.value.sign_of(&self.x[i])) {
            Some(Sign::Zero) => vec![],
            Some(Sign::Positive) => vec![self.x],
            Some(Sign::Negative) => vec![opposite],
            None => vec![self.x, opposite],
        };

        let mut solutions = Vec::new();
        for x in rays {
            let mut value = self.value.clone();
            if let Some(ray) = admissible(pencil, support, x, &mut value) {
                solutions.push(Solution {
                    value,
                    multiplicity: self.multiplicity,
                    slip: support.to_vec(),
                    biactive: ray.biactive,
                    x: ray.x,
                    y: ray.y,
                });
            }
        }

        solutions
    }
}

/// A kernel vector that satisfies (26).
struct AdmissibleRay {
    x: Vec<Poly>,
    y: Vec<Poly>,
    /// Variables off the block with y_i = 0.
    biactive: Vec<usize>,
}

/// (26) with the support taken literally: x > 0 on all of it, y >= 0 off it.
fn admissible(
    pencil: &IntegerPencil<'_>,
    support: &[usize],
    x: Vec<Poly>,
    value: &mut Algebraic,
) -> Option<AdmissibleRay> {
    for &i in support {
        if value.sign_of(&x[i]) != Sign::Positive {
            return None;
        }
    }

    let y = pencil.times(&x);
    let active = pencil.active(support);
    let mut biactive = Vec::new();

    for i in (0..pencil.order()).filter(|i| !active.contains(i)) {
        match value.sign_of(&y[i]) {
            Sign::Negative => return None,
            Sign::Zero => biactive.push(i),
            Sign::Positive => {}
        }
    }

    Some(AdmissibleRay { x, y, biactive })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Rational, Sparse, rational, whole};
    use mceip_model::{Pencil, Window};

    const IDENTITY: &[&[i64]] = &[&[1, 0], &[0, 1]];

    fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
        Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap()
    }

    fn enumerate_all(pencil: &Pencil) -> Enumeration {
        enumerate(pencil, &Window::all()).unwrap()
    }

    /// Value, slip set and biactive set of each solution.
    fn summary(pencil: &Pencil) -> Vec<(String, Vec<usize>, Vec<usize>)> {
        enumerate_all(pencil)
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
        let lambda2 = pencil(&[&[1, -6], &[2, -6]], IDENTITY, &[]);

        assert!(summary(&mu).is_empty());
        let expected = [
            ("2".into(), vec![0, 1], vec![]),
            ("3".into(), vec![0, 1], vec![]),
        ];

        assert_eq!(summary(&lambda2), expected);
    }

    #[test]
    fn biactive_solutions_are_listed_once_and_named() {
        // t = 1, x = (1, 0): y_2 = 0 as well.
        let biactive = pencil(&[&[-1, 5], &[0, 7]], IDENTITY, &[]);

        assert_eq!(summary(&biactive), [("1".into(), vec![0], vec![1])]);
    }

    #[test]
    fn a_near_miss_in_the_sign_of_y_is_no_solution() {
        let negative = pencil(&[&[-1, 0], &[-1, -3]], IDENTITY, &[]);
        let positive = pencil(&[&[-1, 0], &[1, -3]], IDENTITY, &[]);

        assert_eq!(summary(&negative), [("3".into(), vec![1], vec![0])]);
        let expected = [
            ("1".into(), vec![0], vec![]),
            ("1".into(), vec![0, 1], vec![]),
        ];

        assert_eq!(summary(&positive)[..2], expected);
    }

    #[test]
    fn degenerate_cases_are_reported_as_such() {
        // A = -I, B = I: at t = 1 every vector is in the kernel.
        let wide = enumerate_all(&pencil(&[&[-1, 0], &[0, -1]], IDENTITY, &[]));

        let [kernel] = &wide.wide[..] else {
            panic!("{:?}", wide.wide)
        };

        assert_eq!((&kernel.support[..], kernel.dimension), (&[0, 1][..], 2));
        assert_eq!(wide.solutions.len(), 2); // the two edges, each biactive in the other
        assert!(wide.is_complete_list() && !wide.is_plain_list());
        let [cone] = &wide.cones[..] else {
            panic!("{:?}", wide.cones)
        };

        assert_eq!(cone.slip, [0, 1]);
        assert_eq!((cone.dimension, cone.rays.len()), (2, 2));

        let singular = enumerate_all(&pencil(&[&[1, -1], &[-1, 1]], &[&[0, 0], &[0, 0]], &[]));

        assert_eq!(singular.continua, [[0, 1]]);
    }

    #[test]
    fn repeated_roots_carry_their_multiplicity() {
        // A Jordan block: (t-1)^2, kernel of dimension 1.
        let slip = enumerate_all(&pencil(&[&[-1, -1], &[0, -1]], IDENTITY, &[]));

        assert_eq!(slip.solutions.len(), 1);
        assert_eq!(slip.solutions[0].slip, [0]);
        assert_eq!(slip.solutions[0].multiplicity, 1);

        let free = enumerate_all(&pencil(&[&[-1, 1], &[0, -1]], IDENTITY, &[0, 1]));

        assert_eq!(free.solutions.len(), 2); // x and -x
        assert_eq!(free.solutions[0].multiplicity, 2);
    }

    /// x of each solution where variable 1 is the only complementarity variable.
    fn x_of_solutions(pencil: &Pencil) -> Vec<Vec<String>> {
        enumerate_all(pencil)
            .solutions
            .iter()
            .map(|s| s.x_decimals(&[1], 5))
            .collect()
    }

    #[test]
    fn free_only_solutions_try_both_orientations() {
        // Free variable 0 with value 1; y_1 = -x_0 >= 0 needs x_0 < 0.
        let one_orientation = pencil(&[&[-1, 0], &[-1, 1]], IDENTITY, &[0]);
        // Nothing depends on the sign: two rays, x and -x.
        let both_orientations = pencil(&[&[-1, 0], &[0, -5]], IDENTITY, &[0]);

        // l1 norm 1; e'x_s = 1.
        assert_eq!(x_of_solutions(&one_orientation), [["-1", "0"], ["2", "1"]]);
        assert_eq!(
            x_of_solutions(&both_orientations),
            [["1", "0"], ["-1", "0"], ["0", "1"]]
        );
    }

    /// Solutions of (t - 2) x = y in a window.
    fn count_in_window(min: Rational, max: Option<Rational>) -> usize {
        let window = Window::new(min, max).unwrap();
        let found = enumerate(&pencil(&[&[-2]], &[&[1]], &[]), &window).unwrap();
        found.solutions.len()
    }

    #[test]
    fn the_window_is_closed_and_limits_are_said() {
        assert_eq!(count_in_window(whole(0), Some(whole(2))), 1);
        assert_eq!(count_in_window(whole(2), Some(whole(9))), 1);
        assert_eq!(count_in_window(whole(0), Some(whole(1))), 0);
        assert_eq!(count_in_window(rational(21, 10), None), 0);

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
        let two_solutions = pencil(&[&[-2, 0], &[0, -3]], IDENTITY, &[]);

        let found = enumerate_with(&two_solutions, &Window::all(), |done, _| {
            if done == 2 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .unwrap();

        assert_eq!(found.supports_done, 2);
        assert!(!found.is_finished());
        assert_eq!(found.solutions.len(), 1);
    }
}
