//! Condensation in doubles by one sparse Cholesky factorisation, and MCEIP-lambda2 on it.
//!
//! The truth is the exact condensation, the exact enumerator, and the checker, which accepts every
//! certificate; for 200,000 degrees of freedom it is SciPy's SuperLU. States with a wrong sign and
//! particles without their frame are shown to differ, so agreement is no accident.
#![cfg(feature = "testkit")]

use mceip_check::certificate::Certificate;
use mceip_check::check;
use mceip_engine::certify::propose;
use mceip_engine::multistart::{CondensedFound, CondensedSearch, all_slip, search_condensed};
use mceip_engine::reduction::{CondensationError, SparseCondensation, condense};
use mceip_engine::run::Watch;
use mceip_exact::{Sparse, parse, rational, to_f64};
use mceip_mcp::linear::Symmetric;
use mceip_model::reduction::reduce;
use mceip_model::{Admissible, Body, ContactState, Particle, Problem, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_paper::{Block, BlockModel, DoubleBlock, MassKind, MeshKind, Plane, PublishedState};
use std::time::Instant;

const RIGHT: ContactState = ContactState::Slip { sign: -1 };
const LEFT: ContactState = ContactState::Slip { sign: 1 };

/// K and M of an exact block in doubles.
fn doubles(block: &Block) -> [Symmetric; 2] {
    [&block.stiffness, &block.mass].map(|exact| {
        let entries = exact.entries().map(|(i, j, value)| (i, j, to_f64(value)));
        Symmetric::new(exact.rows(), entries).unwrap()
    })
}

/// K of a block that was assembled in doubles.
fn assembled_stiffness(block: &DoubleBlock) -> Symmetric {
    let entries = block.stiffness.entries.iter().copied();
    Symmetric::new(block.stiffness.order, entries).unwrap()
}

fn particles(block: &Block, states: &[ContactState]) -> Vec<Particle> {
    block.system(states, None).unwrap().particles().to_vec()
}

/// Largest difference of A and B to the exact condensation, relative to the largest entry of
/// either.
fn difference(block: &Block, states: &[ContactState], condensation: &SparseCondensation) -> f64 {
    let problem = block.problem(states, None).unwrap();
    let pencil = reduce(&problem).unwrap().pencil;
    let exact = condense(&Admissible::new(&pencil, Unknown::Mu).unwrap()).unwrap();
    let found = condensation.at(0.0).unwrap();

    let of_a = relative_difference(&found.a, exact.a());
    let of_b = relative_difference(&found.b, exact.b());
    of_a.max(of_b)
}

/// Largest difference of two matrices, relative to the largest entry of the first.
fn relative_difference(found: &[Vec<f64>], exact: &Sparse) -> f64 {
    let mut largest: f64 = 0.0;
    let mut error: f64 = 0.0;

    for i in 0..found.len() {
        for j in 0..found.len() {
            largest = largest.max(found[i][j].abs());
            error = error.max((found[i][j] - to_f64(&exact.get(i, j))).abs());
        }
    }
    error / largest
}

#[test]
fn the_sparse_schur_complement_is_the_exact_condensation() {
    let states = [
        LEFT,
        ContactState::Stick,
        RIGHT,
        LEFT,
        ContactState::Free,
        LEFT,
        ContactState::Free,
    ];

    for mesh in MeshKind::ALL {
        for plane in Plane::ALL {
            let model = BlockModel {
                mesh,
                plane,
                cell: (rational(10, 7), rational(4, 3)),
                cells: (6, 4),
                ..BlockModel::of_the_paper()
            };
            condensations_agree(&model, &states);
        }
    }
}

/// The sparse condensation of a block, with and without an ordering by the points of the mesh, and
/// of the block that was assembled in doubles, against the exact one.
fn condensations_agree(model: &BlockModel, states: &[ContactState]) {
    let block = Block::new(model).unwrap();
    let double = DoubleBlock::new(model).unwrap();
    let [k, _] = doubles(&block);

    for points in [None, Some(double.points.as_slice())] {
        let particles = particles(&block, states);
        let condensation = SparseCondensation::new(k.clone(), None, &particles, points).unwrap();
        let error = difference(&block, states, &condensation);

        assert!(error < 1e-14, "{model:?}: {error:e}");

        let residual = condensation.at(0.0).unwrap().residual(3);
        assert!(residual.balance < 1e-15, "{residual:?}");
        assert!(residual.change < 1e-13, "{residual:?}");
    }

    // The block assembled in doubles gives the same to its own rounding.
    let own_k = assembled_stiffness(&double);
    let own_particles = double.particles(states);
    let points = Some(double.points.as_slice());
    let own = SparseCondensation::new(own_k, None, &own_particles, points).unwrap();

    assert!(difference(&block, states, &own) < 1e-13);

    // With wrong signs the exact condensation is another one.
    let turned: Vec<ContactState> = states
        .iter()
        .map(|state| if *state == RIGHT { LEFT } else { *state })
        .collect();

    assert!(difference(&block, &turned, &own) > 1e-3);
}

/// The same body in coordinates turned by a 3-4-5 angle, with frames that turn back, condenses to
/// the same A and B.
#[test]
fn oblique_particles_are_condensed_along_their_directions() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(4, 2)).unwrap();
    let states = [LEFT, RIGHT, LEFT, ContactState::Stick, ContactState::Free];
    let [k, _] = doubles(&block);
    let turned = turned(&k);

    // The frame is Q'.
    let frame = [["0.6", "0.8"], ["-0.8", "0.6"]].map(|row| row.map(|v| parse(v).unwrap()));
    let straight = particles(&block, &states);
    let mut oblique = straight.clone();

    for particle in &mut oblique {
        particle.frame = Some(frame.clone());
    }

    let right = SparseCondensation::new(turned.clone(), None, &oblique, None).unwrap();
    let wrong = SparseCondensation::new(turned, None, &straight, None).unwrap();

    assert!(difference(&block, &states, &right) < 1e-13);
    assert!(difference(&block, &states, &wrong) > 1e-3);
}

/// K' = Q K Q' for u' = Q u at each node, with Q = [0.6 -0.8; 0.8 0.6].
fn turned(k: &Symmetric) -> Symmetric {
    let mut entries = Vec::new();
    for (i, j, value) in k.entries() {
        for (row, row_factor) in turned_dof(i) {
            for (column, column_factor) in turned_dof(j) {
                entries.push((row, column, row_factor * column_factor * value));
            }
        }
    }
    Symmetric::new(k.order(), entries).unwrap()
}

/// The column of Q that belongs to a degree of freedom: rows and entries.
fn turned_dof(i: usize) -> [(usize, f64); 2] {
    if i.is_multiple_of(2) {
        [(i, 0.6), (i + 1, 0.8)]
    } else {
        [(i - 1, -0.8), (i, 0.6)]
    }
}

#[test]
fn another_numbering_gives_the_same() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(8, 4)).unwrap();
    let states = [LEFT, LEFT, ContactState::Stick, RIGHT, LEFT, LEFT];
    let [k, m] = doubles(&block);

    assert_eq!(k.order(), 136);

    let all_states = [states.to_vec(), vec![ContactState::Free; 3]].concat();
    let particles = particles(&block, &all_states);

    let mut renumbered_particles = particles.clone();
    for particle in &mut renumbered_particles {
        particle.tangential = new_number(particle.tangential);
        particle.normal = new_number(particle.normal);
    }

    let new_k = renumbered(&k);
    let new_m = renumbered(&m);

    let one = SparseCondensation::new(k, Some(m), &particles, None).unwrap();
    let two = SparseCondensation::new(new_k, Some(new_m), &renumbered_particles, None).unwrap();

    for lambda2 in [0.0, 1e6, 1e9] {
        let first = one.at(lambda2).unwrap();
        let second = two.at(lambda2).unwrap();
        let scale = first.a[0][0];

        for (rows, new_rows) in [(&first.a, &second.a), (&first.b, &second.b)] {
            for (x, y) in rows.iter().flatten().zip(new_rows.iter().flatten()) {
                assert!((x - y).abs() < 1e-13 * scale, "{x} {y}");
            }
        }

        let rates = [1.0, 0.0, 2.0, 0.5, 0.0];
        let v = first.lift(&rates);
        let new_v = second.lift(&rates);

        for i in 0..136 {
            assert!((v[i] - new_v[new_number(i)]).abs() < 1e-12, "{i}");
        }
    }
}

/// Another numbering of 136 degrees of freedom: 37 and 136 have no common factor.
fn new_number(dof: usize) -> usize {
    (37 * dof + 11) % 136
}

fn renumbered(matrix: &Symmetric) -> Symmetric {
    let entries = matrix
        .entries()
        .map(|(i, j, value)| (new_number(i), new_number(j), value));
    Symmetric::new(matrix.order(), entries).unwrap()
}

#[test]
fn what_cannot_be_condensed_is_refused_by_name() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(3, 2)).unwrap();
    let [k, m] = doubles(&block);
    let slipping = Particle::plain(0, 1, LEFT);
    let sticking = Particle::plain(0, 1, ContactState::Stick);
    let outside = Particle::plain(0, 99, LEFT);
    let sharing = Particle::plain(2, 1, LEFT);
    let double_sign = Particle::plain(0, 1, ContactState::Slip { sign: 2 });

    assert_eq!(
        refusal(&k, &[]),
        "E10: expected at least one particle in impending slip, got none"
    );
    assert_eq!(
        refusal(&k, &[sticking]),
        "E10: expected at least one particle in impending slip, got none"
    );
    assert_eq!(
        refusal(&k, &[outside]),
        format!("E9: expected dofs of particle 0 < {}, got 99", k.order())
    );
    assert_eq!(
        refusal(&k, &[slipping.clone(), sharing]),
        "E9: expected each dof in one particle, got 1 again in particle 1"
    );
    assert_eq!(
        refusal(&k, &[double_sign]),
        "E7: expected the sign of particle 0 to be 1 or -1, got 2"
    );

    let small_mass = Symmetric::new(2, []).unwrap();
    let particles = [slipping];
    let other = SparseCondensation::new(k.clone(), Some(small_mass), &particles, None);

    assert!(matches!(other, Err(CondensationError::Mass { got: 2, .. })));

    // Three nodes without stiffness.
    let supported = k.entries().filter(|(i, j, _)| *i > 5 && *j > 5);
    let zeros = (0..6).map(|i| (i, i, 0.0));
    let loose = Symmetric::new(k.order(), supported.chain(zeros)).unwrap();
    let elsewhere = [Particle::plain(6, 7, LEFT)];
    let singular = SparseCondensation::new(loose, None, &elsewhere, None).unwrap();
    let error = singular.at(0.0).unwrap_err();

    assert!(
        matches!(error, CondensationError::NotDefinite { at: 0.0, .. }),
        "{error}"
    );

    // With a negative lambda^2 the mass outweighs the stiffness.
    let heavy = SparseCondensation::new(k, Some(m), &particles, None).unwrap();
    assert!(heavy.at(1e8).is_ok());
    assert!(heavy.at(-1e12).is_err());
}

/// Why a condensation without a mass is refused.
#[track_caller]
fn refusal(k: &Symmetric, particles: &[Particle]) -> String {
    let refused = SparseCondensation::new(k.clone(), None, particles, None);
    let slip_count = refused.map(|condensation| condensation.slip_count());
    slip_count.unwrap_err().to_string()
}

/// A solution that the checker has accepted.
#[derive(Debug)]
struct AcceptedSolution {
    support: Vec<usize>,
    value: f64,
}

/// What many starts found, and those solutions again after the checker has accepted them.
struct Searched {
    found: CondensedFound,
    accepted: Vec<AcceptedSolution>,
}

/// MCEIP-lambda2 of a block with friction `mu`.
fn lambda2_problem(block: &Block, states: &[ContactState], mu: &str) -> Problem {
    let system = block.system(states, Some(parse(mu).unwrap())).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}

/// MCEIP-lambda2 by many starts; every solution certified on the full pencil and accepted by the
/// checker.
fn certified(block: &Block, states: &[ContactState], mu: &str, starts: usize) -> Searched {
    let [k, m] = doubles(block);
    let particles = particles(block, states);
    let condensation = SparseCondensation::new(k, Some(m), &particles, None).unwrap();
    let search = CondensedSearch {
        starts,
        ..CondensedSearch::default()
    };
    let friction = to_f64(&parse(mu).unwrap());
    let found = search_condensed(&condensation, friction, &search, &Watch::nobody()).unwrap();

    let mut accepted = Vec::new();
    if !found.solutions.is_empty() {
        let problem = lambda2_problem(block, states, mu);
        for claim in check_solutions(&problem, &found).claims {
            accepted.push(AcceptedSolution {
                support: claim.support,
                value: to_f64(&claim.value.mid()),
            });
        }
    }
    Searched { found, accepted }
}

/// Makes a claim of each solution on the full pencil and has the checker judge them.
fn check_solutions(problem: &Problem, found: &CondensedFound) -> mceip_check::Accepted {
    let pencil = reduce(problem).unwrap().pencil;
    let mut claims = Vec::new();

    for solution in &found.solutions {
        claims.push(propose(&pencil, problem.window(), &solution.candidate).unwrap());
    }
    check(problem, &Certificate::of_claims(problem, claims)).unwrap()
}

/// Against the exact enumerator, on blocks it can take, with both masses.
#[test]
fn lambda2_of_small_blocks_is_that_of_the_enumerator() {
    let mut met = 0;

    for mass in [MassKind::Lumped, MassKind::Consistent] {
        let model = BlockModel {
            mass,
            ..BlockModel::of_the_paper().with_cells(2, 1)
        };
        let block = Block::new(&model).unwrap();

        for (mu, states) in [
            ("3", [LEFT, LEFT, ContactState::Free]),
            ("6", [LEFT, LEFT, LEFT]),
            ("4", [RIGHT, LEFT, RIGHT]),
            ("1/2", [LEFT; 3]),
        ] {
            let problem = lambda2_problem(&block, &states, mu);
            let pencil = reduce(&problem).unwrap().pencil;
            let truth = enumerate(&pencil, problem.window()).unwrap().solutions;

            let Searched { found, accepted } = certified(&block, &states, mu, 12);

            assert_eq!(
                accepted.len(),
                truth.len(),
                "{mass:?} {mu}: {:?}",
                found.terminations
            );
            for (ours, exact) in accepted.iter().zip(&truth) {
                let value: f64 = exact.decimal(17).parse().unwrap();
                assert_eq!(ours.support, exact.slip);
                approx::assert_relative_eq!(ours.value, value, max_relative = 1e-10);
            }
            for solution in &found.solutions {
                assert!(solution.slip.iter().all(|x| *x > -1e-9), "{solution:?}");
                assert!(solution.reaction.iter().all(|y| *y > -1e-8), "{solution:?}");
            }
            met += truth.len();
        }
    }

    assert!(met >= 4, "{met} solutions in all");
}

/// Beyond the size of exact claims: enclosed although lambda^2 is millions of times as large as x.
#[test]
fn lambda2_of_a_mesh_is_enclosed_and_accepted() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(6, 3)).unwrap();
    let states = block.sliding_states(0, 5).unwrap();

    for mu in ["2", "3"] {
        let Searched { found, accepted } = certified(&block, &states, mu, 6);
        assert_eq!(accepted.len(), 1, "{:?}", found.terminations);

        let value = accepted[0].value;
        let proposed = found.solutions[0].candidate.value;
        assert!(value > 1e5);
        approx::assert_relative_eq!(value, proposed, max_relative = 1e-10);
    }
}

/// `cargo test --release --test paper -- --ignored --nocapture scale::`: the certified values of
/// `complete_block.rs`.
#[test]
#[ignore = "a minute in the release profile, most of it certification"]
fn lambda2_of_the_17_slip_state_comes_out_and_is_certified() {
    let states = PublishedState::SeventeenSlip.states();
    let lumped = [
        ("1.8", 412358.9120),
        ("2", 1896714.8265),
        ("3", 301277635.12),
    ];
    let consistent = [
        ("1.8", 415207.9740),
        ("2", 1924752.8394),
        ("3", 825684809.39),
    ];

    for (mass, values) in [
        (MassKind::Lumped, lumped),
        (MassKind::Consistent, consistent),
    ] {
        let block = Block::of_the_paper(mass);

        for (mu, expected) in values {
            let clock = Instant::now();
            let Searched { found, accepted } = certified(&block, &states, mu, 22);
            let seconds = clock.elapsed().as_secs_f64();
            let successful: usize = found.solutions.iter().map(|s| s.runs).sum();
            println!(
                "{mass:?} {mu}: {accepted:?} in {seconds:.1} s, {successful} of {} runs, \
                 {} factorisations",
                found.runs, found.factorisations
            );

            assert_eq!(accepted.len(), 1);
            assert_eq!(accepted[0].support.len(), 17);
            approx::assert_relative_eq!(accepted[0].value, expected, max_relative = 1e-8);
        }
    }
}

/// The condensation of a block that was assembled in doubles.
fn condense_in_doubles(block: &DoubleBlock, states: &[ContactState]) -> SparseCondensation {
    let stiffness = assembled_stiffness(block);
    let particles = block.particles(states);
    let points = Some(block.points.as_slice());

    SparseCondensation::new(stiffness, None, &particles, points).unwrap()
}

/// `cargo test --release --test paper -- --ignored scale::`: the value that SciPy's SuperLU gives
/// too (`benches/condense_scipy.py`).
#[test]
#[ignore = "seconds in the release profile"]
fn two_hundred_thousand_degrees_of_freedom() {
    let block = DoubleBlock::new(&BlockModel::refined(272)).unwrap();
    let condensation = condense_in_doubles(&block, &[LEFT; 272]);
    let condensed = condensation.at(0.0).unwrap();

    let residual = condensed.residual(3);
    assert!(residual.balance < 1e-14, "{residual:?}");
    assert!(residual.change < 1e-10, "{residual:?}");

    let found = all_slip(&condensed.a, &condensed.b);
    assert_eq!(found.len(), 1);
    approx::assert_relative_eq!(found[0].mu, 1.70639639, max_relative = 1e-8);
}

/// The all-slip value in doubles against the certified one of the 17-slip state.
#[test]
fn the_all_slip_value_of_the_paper_s_mesh() {
    let block = DoubleBlock::new(&BlockModel::of_the_paper()).unwrap();
    let condensation = condense_in_doubles(&block, &PublishedState::SeventeenSlip.states());
    let condensed = condensation.at(0.0).unwrap();

    let found = all_slip(&condensed.a, &condensed.b);
    assert_eq!(found.len(), 1);
    approx::assert_relative_eq!(found[0].mu, 1.704804329580, max_relative = 1e-11);
}
