//! Is there a solution near a value that somebody claims?
//!
//! A complete set over [value - r, value + r] says: none, which is a proof of absence; or exactly
//! which; or what stays open. Without a radius several are tried, largest first, because a small
//! window closes more easily and proves less. Called by `mceip certify` for candidates that no
//! certificate could be made of.

use super::complete::{CompleteError, CompleteOptions, Completed, complete};
use crate::candidate::{Candidate, distance};
use crate::run::Watch;
use crate::tolerance::{ABSENCE_RADII, X_RADIUS};
use mceip_check::AcceptedClaim;
use mceip_exact::{Integer, Rational, from_f64, parse};
use mceip_model::{Problem, Window};
use num_traits::Signed;

/// Pieces of a small window: enough for all cores, few enough for short certificates.
const PIECES: usize = 4;
/// Nodes a piece may use: a window this small closes in hundreds or is degenerate.
const NODES_PER_PIECE: usize = 50_000;

/// What is proved about the solutions with a value near a candidate's.
#[derive(Debug, Clone)]
pub enum Near {
    /// Every value within the radius lies outside the problem's window: there is nothing to prove.
    OutsideWindow,
    /// No solution there. The certificate's cover yields nothing.
    Absent(Completed),
    /// The solutions there are these, and the candidate's x belongs to none of them.
    Others(Completed),
    /// The candidate's x belongs to one of the solutions there, this one.
    Present(Completed, AcceptedClaim),
    /// Regions stay open in the smallest window tried, or families of solutions lie in it, to which
    /// the candidate may belong; or it may be a solution there whose x is not known.
    Open(Completed),
}

/// Proves what lies within a radius of a candidate's value. Without a `radius` those of
/// [`ABSENCE_RADII`] are tried, largest first, until one closes.
///
/// # Errors
/// [`CompleteError`]: the problem is outside the hypotheses of the complete search.
///
/// ```
/// use mceip_engine::candidate::Candidate;
/// use mceip_exact::Sparse;
/// use mceip_model::{Body, Pencil, Problem, Unknown, Window};
/// use mceip_engine::run::Watch;
/// use mceip_engine::search::near::{Near, near};
/// let pencil = Pencil::new(
///     Sparse::from_ints(&[&[1, -6], &[2, -6]]),
///     Sparse::identity(2),
///     vec![],
/// )
/// .unwrap();
/// let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
/// let claimed = Candidate {
///     value: 2.5,
///     x: vec![0.6, 0.4],
/// };
/// assert!(matches!(
///     near(&problem, &claimed, None, &Watch::nobody()).unwrap(),
///     Near::Absent(_)
/// ));
/// ```
pub fn near(
    problem: &Problem,
    candidate: &Candidate,
    radius: Option<&Rational>,
    watch: &Watch<'_>,
) -> Result<Near, CompleteError> {
    let Ok(value) = from_f64(candidate.value) else {
        return Ok(Near::OutsideWindow);
    };

    let radii = match radius {
        Some(radius) => vec![radius.clone()],
        None => default_radii(&value),
    };

    let options = CompleteOptions {
        pieces: PIECES,
        nodes_per_piece: NODES_PER_PIECE,
        ..CompleteOptions::default()
    };

    let mut last = Near::OutsideWindow;
    for radius in radii {
        let Some(window) = around(problem.window(), &value, &radius) else {
            return Ok(Near::OutsideWindow);
        };

        let nearby = problem.clone().with_window(window);
        last = judge(complete(&nearby, &options, watch)?, candidate);
        if !matches!(last, Near::Open(_)) {
            break;
        }
    }

    Ok(last)
}

/// [`ABSENCE_RADII`] in units of 1 + |value|.
fn default_radii(value: &Rational) -> Vec<Rational> {
    let scale = Rational::from_integer(Integer::from(1)) + value.abs();
    ABSENCE_RADII
        .iter()
        .filter_map(|radius| parse(&format!("{radius:e}")).ok())
        .map(|radius| radius * &scale)
        .collect()
}

/// [value - r, value + r] within the window, rounded outwards to short decimals.
fn around(window: &Window, value: &Rational, radius: &Rational) -> Option<Window> {
    let grid = grid(radius);
    let below = (value - radius) / &grid;
    let below = below.floor() * &grid;
    let above = (value + radius) / &grid;
    let above = above.ceil() * &grid;

    let lo = below.max(window.min().clone());
    let hi = match window.max() {
        Some(max) => above.min(max.clone()),
        None => above,
    };

    Window::new(lo, Some(hi)).ok()
}

/// A power of ten between r / 1000 and r / 100.
fn grid(radius: &Rational) -> Rational {
    let ten = Rational::from_integer(Integer::from(10));
    let limit = radius / (&ten * &ten);

    let mut grid = Rational::from_integer(Integer::from(1));
    while grid > limit {
        grid /= &ten;
    }

    while &grid * &ten <= limit {
        grid *= &ten;
    }

    grid
}

/// What a complete set says of a candidate.
fn judge(completed: Completed, candidate: &Candidate) -> Near {
    let close = completed
        .solutions()
        .map(|(solution, x)| (distance(x, &candidate.x), solution))
        .filter(|(distance, _)| *distance <= X_RADIUS)
        .min_by(|p, q| p.0.total_cmp(&q.0));

    if let Some((_, solution)) = close {
        let solution = solution.clone();
        Near::Present(completed, solution)
    } else if !completed.cover.is_plain_list() || !completed.has_every_x() {
        Near::Open(completed)
    } else if completed.cover.proves_absence() {
        Near::Absent(completed)
    } else {
        Near::Others(completed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Sparse, rational, whole};
    use mceip_model::{Body, Pencil, Unknown};

    /// lambda^2 = 2 with x = (2, 1) and 3 with (3, 2).
    fn fold(window: Window) -> Problem {
        let pencil = Pencil::new(
            Sparse::from_ints(&[&[1, -6], &[2, -6]]),
            Sparse::identity(2),
            vec![],
        )
        .unwrap();
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
    }

    fn ask(problem: &Problem, value: f64, x: &[f64], radius: Option<Rational>) -> Near {
        let candidate = Candidate {
            value,
            x: x.to_vec(),
        };

        near(problem, &candidate, radius.as_ref(), &Watch::nobody()).unwrap()
    }

    #[test]
    fn the_four_answers() {
        let all = fold(Window::all());

        let between = ask(&all, 2.5, &[0.6, 0.4], None);
        assert!(matches!(between, Near::Absent(_)));

        let Near::Others(one) = ask(&all, 2.0, &[0.5, 0.5], None) else {
            panic!("another x")
        };

        assert_eq!(one.cover.solutions.len(), 1);

        let Near::Others(both) = ask(&all, 2.5, &[0.5, 0.5], Some(whole(1))) else {
            panic!("two other x")
        };

        assert_eq!(both.cover.solutions.len(), 2);

        let present = ask(&all, 2.0, &[4.0, 2.0], None);
        assert!(matches!(present, Near::Present(..)));

        let negative = ask(&all, -1.0, &[4.0, 2.0], None);
        assert!(matches!(negative, Near::OutsideWindow));

        let cut = fold(Window::new(whole(0), Some(rational(5, 2))).unwrap());
        let Near::Absent(at_end) = ask(&cut, 2.5, &[0.6, 0.4], Some(rational(1, 10))) else {
            panic!("absent")
        };

        assert_eq!(at_end.proved.certificate().window.min(), &rational(12, 5));
        assert_eq!(
            at_end.proved.certificate().window.max(),
            Some(&rational(5, 2))
        );
    }

    /// The pencil is singular on {0, 1}: a solution for every value. The cover closes, and is no
    /// absence.
    #[test]
    fn a_family_nearby_is_no_absence() {
        let a = Sparse::from_ints(&[&[1, -1], &[-1, 1]]);
        let pencil = Pencil::new(a, Sparse::zeros(2, 2), vec![]).unwrap();
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all()).unwrap();

        let Near::Open(found) = ask(&problem, 1.0, &[1.0, 0.0], None) else {
            panic!("undecided")
        };

        assert!(found.is_complete());
        assert!(found.cover.solutions.is_empty());
        assert!(!found.cover.families.is_empty());
        assert!(!found.cover.proves_absence());
    }

    /// A solution whose x is not known may be the candidate's: nothing is refuted.
    #[test]
    fn an_unknown_x_refutes_nothing() {
        let all = fold(Window::all());
        let Near::Others(mut one) = ask(&all, 2.0, &[0.5, 0.5], None) else {
            panic!("another x")
        };

        one.x[0].fill(f64::NAN);
        let candidate = Candidate {
            value: 2.0,
            x: vec![0.5, 0.5],
        };
        assert!(matches!(judge(one, &candidate), Near::Open(_)));
    }
}
