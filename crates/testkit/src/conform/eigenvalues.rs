//! The eigenvalue complementarity problems of the pack: t of either sign, A, B and C of any kind.
//!
//! Output: one group of drafts. Each of its hand-made problems stands for a corner that programs
//! for t >= 0 or for regular B and C do not know: values of both signs, windows across 0, a pencil
//! that is singular for every t, roots that meet, and quadratic pencils. Called by `groups`.

use super::case::{Draft, Group};
use super::flag::Flag;
use super::groups::{draft, group};
use crate::families::{I2, I3, Instance, SmallRows, eigenvalue_problem};
use crate::pareto;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{
    Body, ModelError, Pencil, Problem, QuadraticPencil, RealWindow, Unknown, Window,
};

/// Random problems, linear and quadratic in turn.
const RANDOM: usize = 24;

/// The group, with random problems of this seed at its end.
///
/// # Errors
/// [`ModelError`]; none for the data as given.
pub(super) fn eigenvalues(seed: u64) -> Result<Group, ModelError> {
    let mut drafts = Vec::new();
    for described in [linear()?, pareto_matrices()?, windows()?, quadratic()?].concat() {
        drafts.push(numbered(&drafts, &[], described));
    }
    for k in 0..RANDOM {
        let Instance { label, problem, .. } = random_eigenvalue_problem(k, seed)?;
        drafts.push(numbered(&drafts, &[Flag::Random], (label, problem)));
    }

    Ok(group(
        "eigenvalues",
        "eigenvalue complementarity problems, linear and quadratic: values of both signs",
        drafts,
    ))
}

/// The `k`-th random problem of a seed, over the whole line: linear and quadratic ones in turn.
///
/// # Errors
/// None: the generator gives at least one variable.
pub(super) fn random_eigenvalue_problem(k: usize, seed: u64) -> Result<Instance, ModelError> {
    let mut instance = eigenvalue_problem(k, seed)?;
    instance.problem = instance.problem.with_real_window(&RealWindow::ALL);
    Ok(instance)
}

/// A problem and what it is about.
type Described = (String, Problem);

/// The next draft.
fn numbered(drafts: &[Draft], flags: &[Flag], (comment, problem): Described) -> Draft {
    let id = format!("eigenvalue-{:02}", drafts.len());
    draft(id, comment, flags, problem)
}

/// An eigenvalue problem in a window of real numbers.
fn posed(body: Body, window: &RealWindow) -> Result<Problem, ModelError> {
    let problem = Problem::new(body, Unknown::Eigenvalue, Window::all())?;
    Ok(problem.with_real_window(window))
}

fn pencil(a: Sparse, b: Sparse) -> Result<Body, ModelError> {
    Ok(Body::Pencil(Pencil::new(a, b, vec![])?))
}

/// Pencils of small integers over the whole line.
fn linear() -> Result<Vec<Described>, ModelError> {
    #[rustfmt::skip]
    let cases: [(&str, SmallRows<'_>, SmallRows<'_>); 13] = [
        ("values -2 and 3", &[&[2, 0], &[0, -3]], I2),
        ("-3, -2 and 1", &[&[1, -6], &[2, -6]], &[&[-1, 0], &[0, -1]]),
        ("the value 0, which either sign has", &[&[0, 1], &[0, 1]], I2),
        ("a double root -2 on (1, 1)", &[&[-1, -1], &[1, -3]], &[&[-1, 0], &[0, -1]]),
        ("a cone at -2", &[&[2, 0, 0], &[0, 2, 0], &[0, 0, 2]], I3),
        ("biactive at -1", &[&[1, 0], &[0, 1]], &[&[1, -1], &[0, 1]]),
        ("B indefinite: a value of each sign", &[&[-1, 0], &[0, -1]], &[&[1, 0], &[0, -1]]),
        ("B singular: infinity is no value", &[&[-1, 1], &[0, -1]], &[&[1, 0], &[0, 0]]),
        ("B = 0: nothing", &[&[1, 2], &[2, 1]], &[&[0, 0], &[0, 0]]),
        ("B skew: irrational values of both signs", &[&[1, -2], &[-2, 1]], &[&[0, 1], &[-1, 0]]),
        ("a support singular for every t: every value", &[&[0, 0], &[1, 1]], &[&[0, 0], &[0, 1]]),
        ("the same cut at -2 and 3",
            &[&[0, 0, 0], &[2, 1, 0], &[3, 0, 1]], &[&[0, 0, 0], &[1, 0, 0], &[-1, 0, 0]]),
        ("complex eigenvalues of both variables", &[&[1, 3], &[-3, 1]], &[&[1, 1], &[-1, 1]]),
    ];

    let mut list = Vec::new();
    for (comment, a, b) in cases {
        let body = pencil(Sparse::from_ints(a), Sparse::from_ints(b))?;
        list.push((comment.to_owned(), posed(body, &RealWindow::ALL)?));
    }
    Ok(list)
}

/// P - tI with many Pareto eigenvalues, and tI - P, which is the other sign convention.
fn pareto_matrices() -> Result<Vec<Described>, ModelError> {
    let mut list = Vec::new();
    for known in pareto::pareto_matrices().into_iter().take(3) {
        let n = known.matrix.rows();
        let zero = Sparse::zeros(n, n);
        let identity = Sparse::identity(n);
        let minus = |matrix: &Sparse| zero.add_scaled(&whole(-1), matrix);

        let count = known.count;
        let both = [
            (
                format!("Px - tx = y: {count} Pareto eigenvalues of order {n}"),
                pencil(known.matrix.clone(), minus(&identity))?,
            ),
            (
                format!("tx - Px = y: the other sign, order {n}"),
                pencil(minus(&known.matrix), identity)?,
            ),
        ];
        for (comment, body) in both {
            list.push((comment, posed(body, &RealWindow::ALL)?));
        }
    }
    Ok(list)
}

/// The values -1, 0 and 2 of a diagonal pencil in windows across 0.
fn windows() -> Result<Vec<Described>, ModelError> {
    let diagonal = Sparse::from_ints(&[&[1, 0, 0], &[0, 0, 0], &[0, 0, -2]]);
    #[rustfmt::skip]
    let cases: [(&str, Option<Rational>, Option<Rational>); 6] = [
        ("both ends are values", Some(whole(-1)), Some(whole(2))),
        ("just without the lower one", Some(rational(-999, 1000)), Some(whole(2))),
        ("the point 0", Some(whole(0)), Some(whole(0))),
        ("up to 0", None, Some(whole(0))),
        ("from 0 on", Some(whole(0)), None),
        ("about 0", Some(rational(-1, 2)), Some(rational(1, 2))),
    ];

    let mut list = Vec::new();
    for (comment, min, max) in cases {
        let body = pencil(diagonal.clone(), Sparse::identity(3))?;
        let window = RealWindow::new(min, max)?;
        list.push((format!("window: {comment}"), posed(body, &window)?));
    }
    Ok(list)
}

/// A, B and C of a quadratic pencil A + tB + t^2 C, and what it is about.
type SmallQuadratic<'a> = (&'a str, [SmallRows<'a>; 3]);

/// Quadratic pencils of small integers over the whole line.
fn quadratic() -> Result<Vec<Described>, ModelError> {
    const ZERO: SmallRows<'_> = &[&[0, 0], &[0, 0]];
    #[rustfmt::skip]
    let cases: [SmallQuadratic<'_>; 12] = [
        ("t^2 - 1: a value of each sign", [&[&[-1]], &[&[0]], &[&[1]]]),
        ("t^2 + 1: nothing", [&[&[1]], &[&[0]], &[&[1]]]),
        ("(t + 2)^2: a double value", [&[&[4]], &[&[4]], &[&[1]]]),
        ("t (t - 3): the value 0", [&[&[0]], &[&[-3]], &[&[1]]]),
        ("t^2 - 2: irrational", [&[&[-2]], &[&[0]], &[&[1]]]),
        ("C = 0: a linear problem", [&[&[1, -6], &[2, -6]], I2, ZERO]),
        ("A = 0: 0 for every x", [ZERO, &[&[-1, 0], &[0, 2]], I2]),
        ("C singular", [&[&[-1, 1], &[1, -1]], &[&[0, 1], &[0, 1]], &[&[1, 0], &[0, 0]]]),
        ("C indefinite", [&[&[-2, 1], &[0, 3]], I2, &[&[1, 0], &[0, -1]]]),
        ("a support singular for every t: t <= -1, t >= 1",
            [&[&[0, 0], &[-1, 1]], ZERO, &[&[0, 0], &[1, 0]]]),
        ("B large: six values", [I2, &[&[-5, 1], &[1, -5]], I2]),
        ("B skew", [&[&[-2, 0], &[0, -1]], &[&[0, 2], &[-2, 0]], I2]),
    ];

    let mut list = Vec::new();
    for (comment, coefficients) in cases {
        let [a, b, c] = coefficients.map(Sparse::from_ints);
        let body = Body::Quadratic(QuadraticPencil::new(a, b, c)?);
        let comment = format!("quadratic: {comment}");
        list.push((comment, posed(body, &RealWindow::ALL)?));
    }
    Ok(list)
}
