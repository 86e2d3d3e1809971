//! The groups of tier 2: n = 10 to 200, made from seeds.
//!
//! Small and degenerate problems are answered by the plain oracle, larger ones by the complete
//! search ([`Completeness::Proved`]), the largest by what many starts find
//! ([`Completeness::BestKnown`]). Entries are integers, or doubles as exact numbers where a mesh is
//! condensed. Called by `mceip conform --write DIR --tier 2`, which takes minutes.

use super::case::{Draft, Group};
use super::certified::Completeness::{self, BestKnown, Proved};
use super::flag::Flag;
use super::groups::{draft, group};
use crate::error::TestkitError;
use crate::families::{PencilShape, system_of_size};
use crate::generators::{Seed, gram, permuted, sparse, unknown};
use crate::large::{condensed_in_doubles, refined_block};
use crate::{known, pareto};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Body, ContactState, ModelError, Particle, Pencil, Problem, System};
use mceip_model::{Unknown, Window};
use num_traits::One;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Seed of every random case.
const SEED: u64 = 20_261_127;

/// All groups of tier 2, in order.
///
/// # Errors
/// [`TestkitError`]; none for the data as given.
pub fn tier2() -> Result<Vec<Group>, TestkitError> {
    Ok(vec![
        random("random-lambda2", 1, Unknown::Lambda2)?,
        random("random-mu", 2, Unknown::Mu)?,
        mechanical()?,
        graphs()?,
        degenerate()?,
        near_thresholds()?,
        eigenvalue_problems()?,
    ])
}

/// The draft, answered by a search.
fn searched(completeness: Completeness, draft: Draft) -> Draft {
    Draft {
        completeness: Some(completeness),
        ..draft
    }
}

/// The source of numbers for a case of a group.
fn rng(group: u64, index: usize) -> ChaCha8Rng {
    Seed {
        family: group,
        seed: SEED,
        index: index as u64,
    }
    .rng()
}

/// A pencil over [0, infinity).
fn of_pencil(pencil: Pencil, unknown: Unknown) -> Result<Problem, ModelError> {
    Problem::new(Body::Pencil(pencil), unknown, Window::all())
}

/// n_s, n_f and what is known of the answers, of MCEIP-lambda2 and of MCEIP-mu.
const RANDOM: [(usize, usize, [Completeness; 2]); 10] = [
    (10, 0, [Proved, Proved]),
    (10, 0, [Proved, Proved]),
    (10, 5, [Proved, Proved]),
    (15, 0, [Proved, Proved]),
    (20, 0, [Proved, Proved]),
    (20, 0, [Proved, Proved]),
    (14, 6, [Proved, Proved]),
    (30, 0, [Proved, Proved]),
    (50, 0, [Proved, BestKnown]),
    (100, 0, [BestKnown, BestKnown]),
];

/// Random admissible pencils: K0 and M are GG' + nI, so that their eigenvalues are of one order,
/// and the entries of K1 are below sqrt(12 n), so that K1 is of that order too.
fn random(name: &str, number: u64, unknown: Unknown) -> Result<Group, ModelError> {
    let mut drafts = Vec::new();
    for (k, (n_s, n_f, [of_lambda2, of_mu])) in RANDOM.into_iter().enumerate() {
        let completeness = match unknown {
            Unknown::Lambda2 | Unknown::Eigenvalue => of_lambda2,
            Unknown::Mu => of_mu,
        };
        let n = n_s + n_f;
        let shape = PencilShape {
            n_s,
            n_f,
            identity: n as i64,
            coupling: (12 * n as i64).isqrt(),
        };
        let pencil = shape.pencil(&mut rng(number, k), unknown)?;

        let word = unknown.word();
        let case = draft(
            format!("{name}-{k}"),
            format!("random admissible pencil, n_s {n_s}, n_f {n_f}, {word}"),
            &[Flag::Random],
            of_pencil(pencil, unknown)?,
        );
        drafts.push(searched(completeness, case));
    }

    let comment = format!("random admissible pencils, {}", unknown.word());
    Ok(group(name, &comment, drafts))
}

/// Random systems, blocks condensed in doubles, chains.
fn mechanical() -> Result<Group, TestkitError> {
    let mut drafts = Vec::new();
    for (k, (contact, inner)) in [(8, 4), (10, 0), (12, 6), (16, 8)].into_iter().enumerate() {
        let system = system_of_size(&mut rng(3, k), contact, inner, &mut Vec::new())?;
        let unknown = unknown(k as u64);
        let problem = Problem::new(Body::System(system), unknown, Window::all())?;
        let case = draft(
            format!("system-{k}"),
            format!("random system, {contact} particles with a candidate, {inner} inner dofs"),
            &[Flag::Random],
            problem,
        );
        drafts.push(searched(Proved, case));
    }

    for slip in [10, 17, 25] {
        let problem = condensed_in_doubles(&refined_block(slip, false)?)?;
        let case = draft(
            format!("block-{slip}"),
            format!("the block of section 5, {slip} slip nodes, condensed in doubles"),
            &[],
            problem,
        );
        drafts.push(searched(Proved, case));
    }

    for (k, count) in [50, 100].into_iter().enumerate() {
        let system = chain(&mut rng(4, k), count)?;
        let case = draft(
            format!("chain-{count}"),
            format!("a chain of {count} particles, all slipping, each coupled to its neighbours"),
            &[Flag::Random],
            Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?,
        );
        drafts.push(searched(BestKnown, case));
    }

    Ok(group(
        "mechanical",
        "systems: random ones, blocks, chains",
        drafts,
    ))
}

/// Particles in a row, each tangent coupled to the normal and tangent of the next one by random
/// integers; K is diagonally dominant, M = I, mu = 3.
fn chain(rng: &mut ChaCha8Rng, count: usize) -> Result<System, ModelError> {
    let mut entries = Vec::new();
    let mut row_sums = vec![1; 2 * count];
    let mut couple = |i: usize, j: usize, value: i64| {
        entries.push((i, j, whole(value)));
        entries.push((j, i, whole(value)));
        row_sums[i] += value.abs();
        row_sums[j] += value.abs();
    };

    for particle in 0..count {
        let tangent = 2 * particle;
        let normal = tangent + 1;
        couple(tangent, normal, rng.random_range(-5..=5));
        if particle + 1 < count {
            couple(tangent, tangent + 2, rng.random_range(-2..=2));
            couple(tangent, tangent + 3, rng.random_range(-3..=3));
            couple(normal, normal + 2, rng.random_range(-2..=2));
        }
    }
    for (i, sum) in row_sums.into_iter().enumerate() {
        entries.push((i, i, whole(sum)));
    }

    let particles = (0..count).map(|k| {
        let sign = if rng.random_range(0..2) == 0 { 1 } else { -1 };
        Particle::plain(2 * k, 2 * k + 1, ContactState::Slip { sign })
    });
    System::new(
        Sparse::from_entries(2 * count, 2 * count, entries),
        Some(Sparse::identity(2 * count)),
        Some(whole(3)),
        particles.collect(),
    )
}

/// Graphs with closed forms.
fn graphs() -> Result<Group, ModelError> {
    let exact = [known::path(10)?, known::cycle(10)?, known::star(9)?];
    let mut drafts = Vec::new();
    for (k, graph) in exact.into_iter().enumerate() {
        let comment = format!("{}: {}", graph.name, graph.closed_form);
        drafts.push(draft(format!("graph-{k}"), comment, &[], graph.problem));
    }

    for (n, completeness) in [
        (20, Proved),
        (50, Proved),
        (100, BestKnown),
        (200, BestKnown),
    ] {
        let problem = of_pencil(known::z_matrix_pencil(n)?, Unknown::Lambda2)?;
        let comment = format!("irreducible Z-matrix {n}: 2 cos(pi/(n+1)), all slip");
        let case = draft(format!("z-matrix-{n}"), comment, &[], problem);
        drafts.push(searched(completeness, case));
    }

    Ok(group("graphs", "graphs with closed forms", drafts))
}

/// Cones, wide kernels, biactive indices: what only exact arithmetic describes.
fn degenerate() -> Result<Group, ModelError> {
    let mut drafts = Vec::new();

    let diagonals = [
        vec![2, 2, 2, 1, 1, 0, -1, 3, 3, 5],
        vec![1, 1, 1, 1, 1, 1, 2, 2, 2, 2],
    ];
    for (k, entries) in diagonals.into_iter().enumerate() {
        let entries: Vec<Rational> = entries.into_iter().map(whole).collect();
        let graph = known::diagonal(&entries)?;
        let comment = "a diagonal with equal entries: cones";
        drafts.push(draft(format!("diagonal-{k}"), comment, &[], graph.problem));
    }

    let jordan = known::jordan(10, 2, false)?;
    let comment = "a Jordan block: one solution, every other index biactive";
    drafts.push(draft("jordan-10", comment, &[], jordan.problem));

    for (k, (n, free)) in [(10, 0), (10, 3), (12, 2)].into_iter().enumerate() {
        let mut rng = rng(5, k);
        let planted = pareto::planted(n, free, rng.random_range(0..u64::MAX))?;
        drafts.push(draft(
            format!("planted-{k}"),
            format!("a planted solution with biactive indices, n {n}, {free} free"),
            &[Flag::Random],
            planted.problem,
        ));
    }

    Ok(group(
        "degenerate",
        "cones, wide kernels and biactive indices of order 10 to 12",
        drafts,
    ))
}

/// The fold of two variables, A_F + tI with a double root t = 1 for d = 0, above a chain P that
/// cannot move:
///
/// ```text
/// A = [F 0; C P],  F = [1 -4; 1 -3 + d],  C >= 0,  P + P' positive definite,  B = I
/// ```
///
/// A support J that meets the chain would need x_J' (C x_F + (P + tI) x_J) = 0, which is positive.
/// So the solutions are those of the fold: a pair for d < 0, one for d = 0, none for d > 0.
fn near_thresholds() -> Result<Group, ModelError> {
    let billionth = rational(1, 1_000_000_000);
    let distances = [
        ("pair", rational(-1, 10_000), "a pair at distance 0.03"),
        ("close", -billionth.clone(), "a pair at distance 9e-5"),
        ("past", billionth, "past the fold by 10^-9: nothing"),
    ];

    let mut drafts = Vec::new();
    for (n, completeness) in [
        (10, Proved),
        (13, Proved),
        (50, BestKnown),
        (150, BestKnown),
    ] {
        // Nothing is only an answer where it is proved.
        let count = if completeness == Proved { 3 } else { 2 };
        for (name, d, comment) in &distances[..count] {
            let mut rng = rng(6, drafts.len());
            let ordered = fold_above_a_chain(&mut rng, n, d)?;
            let pencil = permuted(&mut rng, &ordered);
            let case = draft(
                format!("fold-{n}-{name}"),
                format!("the fold of two variables above a chain, n {n}: {comment}"),
                &[Flag::Fold, Flag::NearThreshold],
                of_pencil(pencil, Unknown::Lambda2)?,
            );
            drafts.push(searched(completeness, case));
        }
    }

    Ok(group(
        "near-thresholds",
        "a fold in order 10 to 150, on both sides of its threshold",
        drafts,
    ))
}

fn fold_above_a_chain(rng: &mut ChaCha8Rng, n: usize, d: &Rational) -> Result<Pencil, ModelError> {
    let mut entries = vec![
        (0, 0, whole(1)),
        (0, 1, whole(-4)),
        (1, 0, whole(1)),
        (1, 1, whole(-3) + d),
    ];
    for i in 2..n {
        entries.push((i, i, whole(4)));
        entries.push((i, rng.random_range(0..2), whole(rng.random_range(1..=3))));
        if i + 1 < n {
            // Row and column sums of what is beside the diagonal stay below 4.
            entries.push((i, i + 1, whole(rng.random_range(-1..=1))));
            entries.push((i + 1, i, whole(rng.random_range(-2..=0))));
        }
    }
    Pencil::new(
        Sparse::from_entries(n, n, entries),
        Sparse::identity(n),
        Vec::new(),
    )
}

/// Order, symmetric or not, and what is known, for each eigenvalue complementarity problem.
const EICP: [(usize, bool, Completeness); 10] = [
    (10, true, Proved),
    (10, false, Proved),
    (15, true, Proved),
    (15, false, BestKnown),
    (20, true, Proved),
    (20, false, BestKnown),
    (30, true, BestKnown),
    (30, false, BestKnown),
    (60, true, BestKnown),
    (60, false, BestKnown),
];

/// Eigenvalue complementarity problems, lambda B x - A x = w with 0 <= x _|_ w >= 0 and B positive
/// definite, shifted so that the window [0, infinity) holds every eigenvalue:
///
/// ```text
/// (-A - sB + tB) x = w,  t = lambda + s,  s >= |x'Ax| / x'Bx
/// ```
///
/// B = GG' + nI, so x'Bx >= n x'x; and |x'Ax| is at most the largest row sum of |A + A'| / 2.
fn eigenvalue_problems() -> Result<Group, ModelError> {
    let mut drafts = Vec::new();
    for (k, (n, is_symmetric, completeness)) in EICP.into_iter().enumerate() {
        let mut rng = rng(7, k);
        let b = gram(&mut rng, n, n as i64);
        let mut a = vec![vec![0; n]; n];
        for i in 0..n {
            for j in 0..n {
                a[i][j] = if is_symmetric && j < i {
                    a[j][i]
                } else {
                    rng.random_range(-9..=9)
                };
            }
        }

        let shift = shift(&a);
        let b = sparse(&b);
        let minus_a = Sparse::zeros(n, n).add_scaled(&-Rational::one(), &sparse(&a));
        let pencil = Pencil::new(minus_a.add_scaled(&whole(-shift), &b), b, Vec::new())?;

        let word = if is_symmetric {
            "symmetric"
        } else {
            "not symmetric"
        };
        let case = draft(
            format!("eicp-{k}"),
            format!("eigenvalue complementarity problem, n {n}, A {word}, t = lambda + {shift}"),
            &[Flag::Random],
            of_pencil(pencil, Unknown::Lambda2)?,
        );
        drafts.push(searched(completeness, case));
    }

    Ok(group(
        "eicp",
        "eigenvalue complementarity problems, B positive definite, shifted into the window",
        drafts,
    ))
}

/// A whole number above |x'Ax| / (n x'x) for every x.
fn shift(a: &[Vec<i64>]) -> i64 {
    let n = a.len();
    let mut largest = 0;
    for i in 0..n {
        let row_sum: i64 = (0..n).map(|j| (a[i][j] + a[j][i]).abs()).sum();
        largest = largest.max(row_sum);
    }
    largest / (2 * n as i64) + 1
}
