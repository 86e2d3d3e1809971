//! The groups of the pack: which problems, and what only their maker knows about them.
//!
//! Output: drafts, each with a comment and the flags that cannot be read off the problem. Nothing
//! is random but for the last two groups and the end of the one before, with a fixed seed.
//! Called by `mceip conform` and by the test that writes the pack; [`random_draft`] makes further
//! cases for `run`.

use super::case::{Draft, Group};
use super::eigenvalues::{eigenvalues, random_eigenvalue_problem};
use super::flag::Flag;
use crate::error::TestkitError;
use crate::families::{AngleFriction, Corner, I2, I3, Instance, SIGNS, SmallRows};
use crate::families::{frictions, mechanical, mechanical_system};
use crate::families::{random_pencil, random_pencils, small_problem};
use crate::{known, pareto};
use mceip_engine::reduction::condense;
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Body, ModelError, Pencil, Problem, Unknown, Window};
use mceip_oracle::TwoParticles;
use mceip_paper::{Block, BlockModel, pythagorean_angles, two_particles};
use num_traits::One;

/// Seed of the random groups of the pack.
const SEED: u64 = 20_260_101;

/// All groups of the pack, in order.
///
/// # Errors
/// [`TestkitError`]; none for the data as given.
pub fn groups() -> Result<Vec<Group>, TestkitError> {
    Ok(vec![
        table1()?,
        static_thresholds()?,
        degenerate()?,
        singular()?,
        windows()?,
        thresholds_of_folds()?,
        graphs()?,
        block()?,
        eigenvalues(SEED)?,
        random(
            "random-pencils",
            "random admissible pencils, n_s 1 to 6, n_f 0 to 3",
            random_pencils(48, SEED)?,
        ),
        random(
            "mechanical",
            "random systems: free, stick and slip particles, frames, both normals, both masses",
            mechanical(48, SEED)?,
        ),
    ])
}

/// Random case `k` of a seed: three pencils to one mechanical system and one eigenvalue problem, as
/// the random groups have them.
///
/// # Errors
/// [`ModelError`]; none, the generators make admissible problems.
pub fn random_draft(k: usize, seed: u64) -> Result<Draft, ModelError> {
    // Each case has a seed of its own.
    let seed_of = seed
        .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        .wrapping_add(k as u64);

    let instance = match k % 5 {
        3 => mechanical_system(k / 5, seed_of)?,
        4 => random_eigenvalue_problem(k / 5, seed_of)?,
        _ => random_pencil(k, seed_of)?,
    };

    Ok(draft(
        format!("random-{seed}-{k}"),
        instance.label,
        &[Flag::Random],
        instance.problem,
    ))
}

/// A problem of the pack, named by its id; the plain oracle answers it.
pub(super) fn draft(
    id: impl Into<String>,
    comment: impl Into<String>,
    flags: &[Flag],
    problem: Problem,
) -> Draft {
    let id = id.into();
    Draft {
        comment: comment.into(),
        flags: flags.to_vec(),
        problem: problem.named(id.clone()),
        id,
        completeness: None,
        listed: None,
        difficulty: None,
    }
}

/// A file of the pack.
pub(super) fn group(name: &str, comment: &str, drafts: Vec<Draft>) -> Group {
    Group {
        name: name.into(),
        comment: comment.into(),
        drafts,
    }
}

/// A group of random instances.
fn random(name: &str, comment: &str, list: Vec<Instance>) -> Group {
    let mut drafts = Vec::new();
    for (k, instance) in list.into_iter().enumerate() {
        drafts.push(draft(
            format!("{name}-{k}"),
            instance.label,
            &[Flag::Random],
            instance.problem,
        ));
    }
    group(name, comment, drafts)
}

/// MCEIP-lambda2 of Fig. 1: every sign pattern at four angles; frictions below, on and above each
/// rational threshold, and well away from them.
fn table1() -> Result<Group, ModelError> {
    let mut drafts = Vec::new();
    let angles = pythagorean_angles();
    let chosen = [&angles[0], &angles[2], &angles[6], &angles[7]];
    let plain = [rational(1, 2), whole(5), whole(20)];

    for (number, (c, s)) in chosen.into_iter().enumerate() {
        let has_units = number % 2 == 0;
        let k = if has_units { whole(1) } else { rational(7, 3) };
        let m = if has_units { whole(1) } else { rational(5, 2) };

        for AngleFriction { mu, place } in frictions(&plain, c, s) {
            let flag = place.map(|corner| match corner {
                Corner::Threshold => Flag::Threshold,
                _ => Flag::NearThreshold,
            });
            for signs in SIGNS {
                let data = TwoParticles {
                    c: c.clone(),
                    s: s.clone(),
                    k: k.clone(),
                    m: m.clone(),
                    mu: mu.clone(),
                    signs,
                };

                // The thresholds are those of S = (+1, -1).
                let flags: Vec<Flag> = flag.filter(|_| signs == (1, -1)).into_iter().collect();

                drafts.push(draft(
                    format!("table1-{:03}", drafts.len()),
                    format!("Table 1: cos {c}, sin {s}, k {k}, m {m}, mu {mu}, S {signs:?}"),
                    &flags,
                    of_two_particles(&data, Unknown::Lambda2)?,
                ));
            }
        }
    }

    Ok(group(
        "table1",
        "the two particles of Fig. 1, MCEIP-lambda2",
        drafts,
    ))
}

/// The two particles of Fig. 1 with these data, over [0, infinity).
fn of_two_particles(data: &TwoParticles, unknown: Unknown) -> Result<Problem, ModelError> {
    let system = two_particles(data)?;
    Problem::new(Body::System(system), unknown, Window::all())
}

/// MCEIP-mu of Fig. 1.
fn static_thresholds() -> Result<Group, ModelError> {
    let mut drafts = Vec::new();
    let angles = pythagorean_angles();

    for (c, s) in [&angles[0], &angles[3], &angles[5], &angles[7]] {
        for signs in SIGNS {
            let data = TwoParticles {
                c: c.clone(),
                s: s.clone(),
                k: whole(2),
                m: whole(1),
                mu: whole(1),
                signs,
            };

            drafts.push(draft(
                format!("mu-{:02}", drafts.len()),
                format!("static thresholds: cos {c}, sin {s}, S {signs:?}"),
                &[],
                of_two_particles(&data, Unknown::Mu)?,
            ));
        }
    }

    Ok(group(
        "static-thresholds",
        "the two particles of Fig. 1, MCEIP-mu",
        drafts,
    ))
}

/// Comment, A, B and the free variables of a pencil of small integers.
type SmallPencil<'a> = (&'a str, SmallRows<'a>, SmallRows<'a>, &'a [usize]);

/// The corners of `testkit`, and more: order 1, repeated roots, biactive indices, zero values, wide
/// kernels.
fn degenerate() -> Result<Group, ModelError> {
    let mut drafts = Vec::new();
    for (k, instance) in crate::families::degenerate()?.into_iter().enumerate() {
        let id = format!("degenerate-{k:02}");
        drafts.push(draft(id, instance.label, &[], instance.problem));
    }

    #[rustfmt::skip]
    let cases: [SmallPencil<'_>; 17] = [
        ("order 1, t = 0", &[&[0]], &[&[1]], &[]),
        ("order 1, free only", &[&[-3]], &[&[2]], &[0]),
        ("order 1, value 1/3", &[&[-1]], &[&[3]], &[]),
        ("triple root, Jordan block of order 3",
            &[&[-2, -1, 0], &[0, -2, -1], &[0, 0, -2]], I3, &[]),
        ("scalar matrix of order 3: a cone of dimension 3",
            &[&[-2, 0, 0], &[0, -2, 0], &[0, 0, -2]], I3, &[]),
        ("two equal entries: a cone of dimension 2 beside a solution",
            &[&[-2, 0, 0], &[0, -1, 0], &[0, 0, -2]], I3, &[]),
        ("wide kernel with a single ray", &[&[-1, 1, 1], &[1, -1, 1], &[0, 0, -1]], I3, &[]),
        ("value 0 on every support", &[&[0, 0], &[0, 0]], I2, &[]),
        ("two biactive indices", &[&[-1, 0, 0], &[0, 5, 0], &[0, 0, 7]], I3, &[]),
        ("biactive at one of two equal values", &[&[-1, 1], &[0, -1]], I2, &[]),
        ("double root 2 on (1, 1)", &[&[-1, -1], &[1, -3]], I2, &[]),
        ("double root 6 on (3, 1)", &[&[-3, -9], &[1, -9]], I2, &[]),
        ("triple root 2 on (1, 1, 1)", &[&[-1, -1, 0], &[2, -3, -1], &[1, -1, -2]], I3, &[]),
        ("double root 2 on (1, 1) beside two single ones",
            &[&[-1, -1, 0], &[1, -3, 0], &[0, 0, -5]], I3, &[]),
        ("positive definite: nothing", &[&[2, 1], &[1, 2]], I2, &[]),
        ("free variable with a zero pivot", &[&[0, 1], &[-1, 1]], I2, &[0]),
        ("complex eigenvalues only", &[&[1, 3], &[-3, 1]], I2, &[]),
    ];

    for (k, (comment, a, b, free)) in cases.into_iter().enumerate() {
        drafts.push(draft(
            format!("corner-{k:02}"),
            comment,
            &[],
            small_problem(a, b, free, Unknown::Lambda2)?,
        ));
    }

    Ok(group(
        "degenerate",
        "degenerate corners built on purpose",
        drafts,
    ))
}

/// Pencils with det(A + tB) = 0 for all t on some support: continua, whole and in parts.
fn singular() -> Result<Group, ModelError> {
    #[rustfmt::skip]
    let cases: [SmallPencil<'_>; 7] = [
        ("every value from 0", &[&[0]], &[&[0]], &[]),
        ("from 0 to 3: y = 3 - t beside it", &[&[0, 0], &[3, 1]], &[&[0, 0], &[-1, 0]], &[]),
        ("from 2 on: y = t - 2 beside it", &[&[0, 0], &[-2, 1]], &[&[0, 0], &[1, 0]], &[]),
        ("one value only: two rows against each other",
            &[&[0, 0, 0], &[-2, 1, 0], &[2, 0, 1]], &[&[0, 0, 0], &[1, 0, 0], &[-1, 0, 0]], &[]),
        ("between 1 and 2",
            &[&[0, 0, 0], &[-1, 1, 0], &[2, 0, 1]], &[&[0, 0, 0], &[1, 0, 0], &[-1, 0, 0]], &[]),
        ("the kernel turns with t", &[&[-1, 0], &[-1, 0]], &[&[0, 1], &[0, 1]], &[]),
        ("a singular free block", &[&[0, 0], &[0, -1]], &[&[0, 0], &[0, 1]], &[0]),
    ];

    let mut drafts = Vec::new();
    for (k, (comment, a, b, free)) in cases.into_iter().enumerate() {
        drafts.push(draft(
            format!("singular-{k:02}"),
            comment,
            &[],
            small_problem(a, b, free, Unknown::Mu)?,
        ));
    }

    let cut = drafts[2]
        .problem
        .clone()
        .with_window(Window::new(whole(1), Some(whole(4)))?);

    drafts.push(draft(
        "singular-07",
        "from 2 on, cut to the window [1, 4]",
        &[],
        cut,
    ));

    Ok(group(
        "singular",
        "pencils that are singular for every value",
        drafts,
    ))
}

/// The fold 2 and 3 and the path graph in windows that cut, touch and miss their values.
fn windows() -> Result<Group, ModelError> {
    let fold = small_problem(FOLD, I2, &[], Unknown::Lambda2)?;
    let path = known::path(4)?.problem;
    let tiny = rational(1, 1_000_000);

    // Comment, problem, lower and upper end of the window.
    #[rustfmt::skip]
    let list = [
        ("both ends are values", &fold, whole(2), Some(whole(3))),
        ("a point that is a value", &fold, whole(2), Some(whole(2))),
        ("a point that is none", &fold, rational(5, 2), Some(rational(5, 2))),
        ("between the values", &fold, rational(21, 10), Some(rational(29, 10))),
        ("just without both", &fold, whole(2) + &tiny, Some(whole(3) - &tiny)),
        ("just with both", &fold, whole(2) - &tiny, Some(whole(3) + &tiny)),
        ("from 3 on", &fold, whole(3), None),
        ("above everything", &fold, whole(4), None),
        ("up to 1, with cones at 0 and 1", &path, whole(0), Some(whole(1))),
        ("irrational values only", &path, rational(11, 10), None),
        ("the point 1", &path, whole(1), Some(whole(1))),
    ];

    let mut drafts = Vec::new();
    for (k, (comment, base, min, max)) in list.into_iter().enumerate() {
        drafts.push(draft(
            format!("window-{k:02}"),
            comment,
            &[],
            base.clone().with_window(Window::new(min, max)?),
        ));
    }

    Ok(group(
        "windows",
        "bounded windows: closed ends, points, nothing inside",
        drafts,
    ))
}

/// Folds on both sides, tiny components, entries of all sizes.
fn thresholds_of_folds() -> Result<Group, ModelError> {
    let mut drafts = folds()?;
    drafts.extend(tiny_components()?);
    drafts.push(scaled_fold("large", &whole(10_000_000))?);
    drafts.push(scaled_fold("small", &rational(1, 10_000_000))?);
    drafts.push(fold_with_scaled_rows()?);

    Ok(group("folds", "folds, tiny components, scales", drafts))
}

/// (1 + t) x1 - 4 x2 = 0, x1 + (-3 + d + t) x2 = 0: double root t = 1 at d = 0, a pair below, none
/// above.
fn folds() -> Result<Vec<Draft>, ModelError> {
    let cases = [
        (rational(-1, 100), "a pair at distance 0.2"),
        (rational(-1, 100_000_000), "a pair at distance 2e-4"),
        (
            rational(1, 1_000_000_000),
            "past the fold by 10^-9: nothing on the full support",
        ),
        (rational(1, 100), "past the fold"),
    ];

    let mut drafts = Vec::new();
    for (k, (d, comment)) in cases.into_iter().enumerate() {
        let at_the_fold = Sparse::from_ints(&[&[1, -4], &[1, -3]]);
        let moved = Sparse::from_entries(2, 2, [(1, 1, d)]);
        let a = at_the_fold.add_scaled(&Rational::one(), &moved);
        drafts.push(pencil_draft(
            format!("fold-{k:02}"),
            comment,
            &[Flag::Fold],
            a,
        )?);
    }
    Ok(drafts)
}

/// x = (1, e) at t = 1 with e = 10^-3, 10^-5, 10^-8.
fn tiny_components() -> Result<Vec<Draft>, ModelError> {
    let mut drafts = Vec::new();
    for exponent in [3u32, 5, 8] {
        let power = num_bigint::BigInt::from(10).pow(exponent);
        let e = Rational::new(One::one(), power);
        let a = Sparse::from_entries(2, 2, [(0, 0, -whole(1) - &e), (0, 1, whole(1)), (1, 0, -e)]);

        drafts.push(pencil_draft(
            format!("tiny-{exponent}"),
            format!("x = (1, 10^-{exponent}) at t = 1"),
            &[],
            a,
        )?);
    }
    Ok(drafts)
}

/// A of the fold with the solutions 2 and 3; its B is the identity.
const FOLD: SmallRows<'_> = &[&[1, -6], &[2, -6]];

/// The fold with all entries times one factor: the same solutions.
fn scaled_fold(name: &str, factor: &Rational) -> Result<Draft, ModelError> {
    let zero = Sparse::zeros(2, 2);
    let a = zero.add_scaled(factor, &Sparse::from_ints(FOLD));
    let b = zero.add_scaled(factor, &Sparse::identity(2));
    let pencil = Pencil::new(a, b, vec![])?;

    Ok(draft(
        format!("scaled-{name}"),
        format!("the fold with all entries times {factor}"),
        &[Flag::Fold],
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())?,
    ))
}

/// Row scaling changes y alone; column scaling would change x.
fn fold_with_scaled_rows() -> Result<Draft, ModelError> {
    let factors = [(0, 0, whole(1_000_000)), (1, 1, rational(1, 1_000_000))];
    let mut entries = Vec::new();
    for (i, j, v) in Sparse::from_ints(FOLD).entries() {
        entries.push((i, j, v * &factors[i].2));
    }
    let a = Sparse::from_entries(2, 2, entries);
    let b = Sparse::from_entries(2, 2, factors);
    let pencil = Pencil::new(a, b, vec![])?;

    Ok(draft(
        "scaled-rows",
        "the fold with its rows times 1e6 and 10^-6",
        &[Flag::Fold],
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())?,
    ))
}

/// A draft of A + tI, of order 2.
fn pencil_draft(
    id: String,
    comment: impl Into<String>,
    flags: &[Flag],
    a: Sparse,
) -> Result<Draft, ModelError> {
    let pencil = Pencil::new(a, Sparse::identity(2), vec![])?;
    Ok(draft(
        id,
        comment,
        flags,
        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())?,
    ))
}

/// Graphs with closed forms, and the Pareto matrices of the literature.
fn graphs() -> Result<Group, ModelError> {
    let known = [
        known::path(3)?,
        known::path(5)?,
        known::cycle(4)?,
        known::star(3)?,
        known::complete_graph(4)?,
        known::complete_graph(5)?,
        known::z_matrix(5)?,
        known::diagonal(&[whole(2), whole(2), rational(1, 3), whole(-1)])?,
    ];

    let mut drafts = Vec::new();
    for (k, graph) in known.into_iter().enumerate() {
        drafts.push(draft(
            format!("graph-{k:02}"),
            format!("{}: {}", graph.name, graph.closed_form),
            &[],
            graph.problem,
        ));
    }

    for (k, p) in pareto::pareto_matrices().into_iter().enumerate() {
        let comment = format!(
            "Pareto eigenvalue problem of order {} with {} solutions",
            p.matrix.rows(),
            p.count
        );

        drafts.push(draft(format!("pareto-{k:02}"), comment, &[], p.pencil()?));
    }

    Ok(group(
        "graphs",
        "graphs with closed forms, and Pareto eigenvalue problems of the literature",
        drafts,
    ))
}

/// The block of section 5 on coarse meshes, free dofs eliminated exactly: fractions of hundreds of
/// bits. (On the paper's own mesh the condensed pencil has 3,147 bits: `mceip block --write` gives
/// it.)
fn block() -> Result<Group, TestkitError> {
    let mut drafts = Vec::new();
    for (slip, stick) in [(2, 0), (3, 1), (5, 0)] {
        let block = Block::new(&BlockModel::refined(slip + stick))?;
        let system = block.system(&block.sliding_states(stick, slip)?, None)?;

        let full = Problem::new(Body::System(system), Unknown::Mu, Window::all())?;
        let reduced = reduce(&full)?;
        let pencil = condense(&Admissible::new(&reduced.pencil, Unknown::Mu)?)?;
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Mu, Window::all())?;
        let comment = format!(
            "the block on a coarse mesh, {slip} slip and {stick} stick nodes, condensed exactly"
        );
        drafts.push(draft(format!("block-{slip}"), comment, &[], problem));
    }

    Ok(group(
        "block",
        "the polyurethane block of section 5 on coarse meshes, MCEIP-mu, condensed",
        drafts,
    ))
}
