//! Is there a solution near a value that somebody claims? A complete set over [value - r, value +
//! r] says: none, which is a proof of absence; or exactly which; or what stays open.

use super::complete::{CompleteError, Completed, Options, complete};
use crate::candidate::Candidate;
use crate::exact::{Integer, Rational, from_f64, parse};
use crate::model::{Problem, Window};
use crate::run::Watch;
use crate::tolerance::{ABSENCE_RADII, X_RADIUS};
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
    /// The candidate's x belongs to one of the solutions there.
    Present(Completed),
    /// Regions stay open in the smallest window tried, or families of solutions lie in it, to which
    /// the candidate may belong.
    Open(Completed),
}

/// Proves what lies within a radius of a candidate's value. Without a `radius` those of
/// [`ABSENCE_RADII`] are tried, largest first, until one closes.
///
/// # Errors
/// [`CompleteError`]: the problem is outside the hypotheses of the complete search.
///
/// ```
/// use mceip_engine::{
///     candidate::Candidate,
///     exact::Sparse,
///     model::{Body, Pencil, Problem, Unknown, Window},
///     search::near::{Near, near},
/// };
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
    let scale = Rational::from_integer(Integer::from(1)) + value.abs();
    let radii = match radius {
        Some(r) => vec![r.clone()],
        None => ABSENCE_RADII
            .iter()
            .filter_map(|r| parse(&format!("{r:e}")).ok())
            .map(|r| r * &scale)
            .collect(),
    };
    let mut last = Near::OutsideWindow;
    for r in radii {
        let Some(window) = around(problem.window(), &value, &r) else {
            return Ok(Near::OutsideWindow);
        };
        let options = Options {
            pieces: PIECES,
            nodes_per_piece: NODES_PER_PIECE,
            ..Options::default()
        };
        last = judge(
            complete(&problem.clone().with_window(window), &options, watch)?,
            candidate,
        );
        if !matches!(last, Near::Open(_)) {
            break;
        }
    }
    Ok(last)
}

/// [value - r, value + r] within the window, rounded outwards to short decimals.
fn around(window: &Window, value: &Rational, radius: &Rational) -> Option<Window> {
    let grid = grid(radius);
    let lo = (((value - radius) / &grid).floor() * &grid).max(window.min().clone());
    let hi = ((value + radius) / &grid).ceil() * &grid;
    let hi = window.max().map_or(hi.clone(), |max| hi.min(max.clone()));
    Window::new(lo, Some(hi)).ok()
}

/// A power of ten between r / 1000 and r / 100.
fn grid(radius: &Rational) -> Rational {
    let ten = Rational::from_integer(Integer::from(10));
    let (mut grid, limit) = (
        Rational::from_integer(Integer::from(1)),
        radius / (&ten * &ten),
    );
    while grid > limit {
        grid /= &ten;
    }
    while &grid * &ten <= limit {
        grid *= &ten;
    }
    grid
}

fn judge(completed: Completed, candidate: &Candidate) -> Near {
    if completed
        .solutions()
        .any(|(s, x)| distance(x, candidate, &s.support) <= X_RADIUS)
    {
        Near::Present(completed)
    } else if !completed.cover.is_plain_list() {
        Near::Open(completed)
    } else if completed.cover.proves_absence() {
        Near::Absent(completed)
    } else {
        Near::Others(completed)
    }
}

/// Largest difference of components once the candidate has sum one on the solution's support too.
fn distance(x: &[f64], candidate: &Candidate, support: &[usize]) -> f64 {
    let sum = |x: &[f64]| support.iter().filter_map(|&i| x.get(i)).sum::<f64>();
    let (ours, theirs) = (sum(x), sum(&candidate.x));
    let difference = x
        .iter()
        .zip(&candidate.x)
        .map(|(a, b)| (a / ours - b / theirs).abs());
    // NaN (a candidate that is zero there) is no agreement.
    difference.fold(
        0.0,
        |m, d| if d.is_nan() { f64::INFINITY } else { d.max(m) },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Sparse, rational, whole};
    use crate::model::{Body, Pencil, Unknown};

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
        near(
            problem,
            &Candidate {
                value,
                x: x.to_vec(),
            },
            radius.as_ref(),
            &Watch::nobody(),
        )
        .unwrap()
    }

    #[test]
    fn the_four_answers() {
        let all = fold(Window::all());
        assert!(matches!(ask(&all, 2.5, &[0.6, 0.4], None), Near::Absent(_)));
        assert!(
            matches!(ask(&all, 2.0, &[0.5, 0.5], None), Near::Others(c) if c.cover.solutions.len() == 1)
        );
        assert!(
            matches!(ask(&all, 2.5, &[0.5, 0.5], Some(whole(1))), Near::Others(c) if c.cover.solutions.len() == 2)
        );
        assert!(matches!(
            ask(&all, 2.0, &[4.0, 2.0], None),
            Near::Present(_)
        ));
        assert!(matches!(
            ask(&all, -1.0, &[4.0, 2.0], None),
            Near::OutsideWindow
        ));
        let cut = fold(Window::new(whole(0), Some(rational(5, 2))).unwrap());
        let Near::Absent(c) = ask(&cut, 2.5, &[0.6, 0.4], Some(rational(1, 10))) else {
            panic!("absent")
        };
        assert_eq!(
            (c.certificate.window.min(), c.certificate.window.max()),
            (&rational(12, 5), Some(&rational(5, 2)))
        );
    }

    /// The pencil is singular on {0, 1}: a solution for every value. The cover closes, and is no
    /// absence.
    #[test]
    fn a_family_nearby_is_no_absence() {
        let a = Sparse::from_ints(&[&[1, -1], &[-1, 1]]);
        let pencil = Pencil::new(a, Sparse::zeros(2, 2), vec![]).unwrap();
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all()).unwrap();
        let Near::Open(c) = ask(&problem, 1.0, &[1.0, 0.0], None) else {
            panic!("undecided")
        };
        assert!(
            c.is_complete()
                && c.cover.solutions.is_empty()
                && !c.cover.families.is_empty()
                && !c.cover.proves_absence()
        );
    }
}
