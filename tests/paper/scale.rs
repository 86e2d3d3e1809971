//! Condensation in doubles by one sparse Cholesky, and MCEIP-lambda2 on it, against exact
//! arithmetic.
#![cfg(feature = "testkit")]

use mceip_check::check;
use mceip_engine::certify::{certificate, propose};
use mceip_engine::multistart::{CondensedFound, CondensedSearch, all_slip, search_condensed};
use mceip_engine::reduction::{CondensationError, SparseCondensation, condense, reduce};
use mceip_engine::run::Watch;
use mceip_exact::{parse, rational, to_f64};
use mceip_mcp::linear::Symmetric;
use mceip_model::{Admissible, Body, ContactState, Particle, Problem, Unknown, Window};
use mceip_oracle::enumerate;
use mceip_paper::{Block, BlockModel, DoubleBlock, MassKind, MeshKind, Plane, PublishedState};

const RIGHT: ContactState = ContactState::Slip { sign: -1 };
const LEFT: ContactState = ContactState::Slip { sign: 1 };

/// K and M of an exact block in doubles.
fn doubles(block: &Block) -> [Symmetric; 2] {
    [&block.stiffness, &block.mass]
        .map(|m| Symmetric::new(m.rows(), m.entries().map(|(i, j, v)| (i, j, to_f64(v)))).unwrap())
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
    let mut worst: f64 = 0.0;
    for (m, exact) in [(&found.a, exact.a()), (&found.b, exact.b())] {
        let all = || (0..m.len()).flat_map(|i| (0..m.len()).map(move |j| (i, j)));
        let largest = all().map(|(i, j)| m[i][j].abs()).fold(0.0, f64::max);
        worst = all()
            .map(|(i, j)| (m[i][j] - to_f64(&exact.get(i, j))).abs() / largest)
            .fold(worst, f64::max);
    }
    worst
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
    for (mesh, plane) in MeshKind::ALL
        .into_iter()
        .flat_map(|m| Plane::ALL.map(|p| (m, p)))
    {
        let model = BlockModel {
            mesh,
            plane,
            cell: (rational(10, 7), rational(4, 3)),
            cells: (6, 4),
            ..BlockModel::of_the_paper()
        };
        let (block, double) = (
            Block::new(&model).unwrap(),
            DoubleBlock::new(&model).unwrap(),
        );
        let [k, _] = doubles(&block);
        for points in [None, Some(double.points.as_slice())] {
            let condensation =
                SparseCondensation::new(k.clone(), None, &particles(&block, &states), points)
                    .unwrap();
            let error = difference(&block, &states, &condensation);
            assert!(error < 1e-14, "{mesh:?} {plane:?}: {error:e}");
            let residual = condensation.at(0.0).unwrap().residual(3);
            assert!(
                residual.balance < 1e-15 && residual.change < 1e-13,
                "{residual:?}"
            );
        }
        // The block assembled in doubles gives the same to its own rounding; the wrong states do
        // not.
        let own = Symmetric::new(
            double.stiffness.order,
            double.stiffness.entries.iter().copied(),
        )
        .unwrap();
        let own =
            SparseCondensation::new(own, None, &double.particles(&states), Some(&double.points))
                .unwrap();
        assert!(difference(&block, &states, &own) < 1e-13);
        let turned: Vec<ContactState> = states
            .iter()
            .map(|s| if *s == RIGHT { LEFT } else { *s })
            .collect();
        assert!(difference(&block, &turned, &own) > 1e-3);
    }
}

/// The same body in coordinates turned by a 3-4-5 angle, with frames that turn back, condenses to
/// the same A and B.
#[test]
fn oblique_particles_are_condensed_along_their_directions() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(4, 2)).unwrap();
    let states = [LEFT, RIGHT, LEFT, ContactState::Stick, ContactState::Free];
    let [k, _] = doubles(&block);
    // u' = Q u at each node, Q = [0.6 -0.8; 0.8 0.6], K' = Q K Q'.
    let turn = |i: usize| {
        if i.is_multiple_of(2) {
            [(i, 0.6), (i + 1, 0.8)]
        } else {
            [(i - 1, -0.8), (i, 0.6)]
        }
    };
    let places = |(i, j, v): (usize, usize, f64)| {
        turn(i).map(|(a, p)| turn(j).map(|(b, q)| (a, b, p * q * v)))
    };
    let turned = Symmetric::new(k.order(), k.entries().flat_map(places).flatten()).unwrap();
    let frame = [["0.6", "0.8"], ["-0.8", "0.6"]].map(|r| r.map(|v| parse(v).unwrap())); // Q'
    let straight = particles(&block, &states);
    let oblique: Vec<Particle> = straight
        .iter()
        .map(|p| Particle {
            frame: Some(frame.clone()),
            ..p.clone()
        })
        .collect();
    let condensed =
        |p: &[Particle]| SparseCondensation::new(turned.clone(), None, p, None).unwrap();
    assert!(difference(&block, &states, &condensed(&oblique)) < 1e-13);
    assert!(difference(&block, &states, &condensed(&straight)) > 1e-3);
}

#[test]
fn another_numbering_gives_the_same() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(8, 4)).unwrap();
    let states = [LEFT, LEFT, ContactState::Stick, RIGHT, LEFT, LEFT];
    let [k, m] = doubles(&block);
    let n = k.order();
    let new = |i: usize| (37 * i + 11) % n; // 37 and n = 2 * 68 have no common factor
    assert_eq!(n, 136);
    let moved = |m: &Symmetric| {
        Symmetric::new(n, m.entries().map(|(i, j, v)| (new(i), new(j), v))).unwrap()
    };
    let given = particles(
        &block,
        &[states.to_vec(), vec![ContactState::Free; 3]].concat(),
    );
    let numbered: Vec<Particle> = given
        .iter()
        .map(|p| Particle {
            tangential: new(p.tangential),
            normal: new(p.normal),
            ..p.clone()
        })
        .collect();
    let one = SparseCondensation::new(k.clone(), Some(m.clone()), &given, None).unwrap();
    let two = SparseCondensation::new(moved(&k), Some(moved(&m)), &numbered, None).unwrap();
    for t in [0.0, 1e6, 1e9] {
        let (p, q) = (one.at(t).unwrap(), two.at(t).unwrap());
        for (x, y) in
            p.a.iter()
                .chain(&p.b)
                .flatten()
                .zip(q.a.iter().chain(&q.b).flatten())
        {
            assert!((x - y).abs() < 1e-13 * p.a[0][0], "{x} {y}");
        }
        let (v, w) = (
            p.lift(&[1.0, 0.0, 2.0, 0.5, 0.0]),
            q.lift(&[1.0, 0.0, 2.0, 0.5, 0.0]),
        );
        assert!((0..n).all(|i| (v[i] - w[new(i)]).abs() < 1e-12));
    }
}

#[test]
fn what_cannot_be_condensed_is_refused_by_name() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(3, 2)).unwrap();
    let [k, m] = doubles(&block);
    let with =
        |p: &[Particle]| SparseCondensation::new(k.clone(), None, p, None).map(|c| c.slip_count());
    let slip = |t, n, state| Particle::plain(t, n, state);
    let refused = |p: &[Particle]| with(p).unwrap_err().to_string();
    assert_eq!(
        refused(&[]),
        "E10: expected at least one particle in impending slip, got none"
    );
    assert_eq!(
        refused(&[slip(0, 1, ContactState::Stick)]),
        "E10: expected at least one particle in impending slip, got none"
    );
    assert_eq!(
        refused(&[slip(0, 99, LEFT)]),
        format!("E9: expected dofs of particle 0 < {}, got 99", k.order())
    );
    assert_eq!(
        refused(&[slip(0, 1, LEFT), slip(2, 1, LEFT)]),
        "E9: expected each dof in one particle, got 1 again in particle 1"
    );
    assert_eq!(
        refused(&[slip(0, 1, ContactState::Slip { sign: 2 })]),
        "E7: expected the sign of particle 0 to be 1 or -1, got 2"
    );
    let other = SparseCondensation::new(
        k.clone(),
        Some(Symmetric::new(2, []).unwrap()),
        &[slip(0, 1, LEFT)],
        None,
    );
    assert!(matches!(other, Err(CondensationError::Mass { got: 2, .. })));
    // Nodes without stiffness.
    let loose = k
        .entries()
        .filter(|(i, j, _)| *i > 5 && *j > 5)
        .chain((0..6).map(|i| (i, i, 0.0)));
    let loose = Symmetric::new(k.order(), loose).unwrap();
    let singular = SparseCondensation::new(loose, None, &[slip(6, 7, LEFT)], None).unwrap();
    let error = singular.at(0.0).unwrap_err();
    assert!(
        matches!(error, CondensationError::NotDefinite { at: 0.0, .. }),
        "{error}"
    );
    // With a negative t the mass outweighs the stiffness.
    let heavy = SparseCondensation::new(k.clone(), Some(m), &[slip(0, 1, LEFT)], None).unwrap();
    assert!(heavy.at(1e8).is_ok() && heavy.at(-1e12).is_err());
}

/// MCEIP-lambda2 by many starts; every solution certified on the full pencil and accepted by the
/// checker.
fn certified(
    block: &Block,
    states: &[ContactState],
    mu: &str,
    starts: usize,
) -> (CondensedFound, Vec<(Vec<usize>, f64)>) {
    let friction = parse(mu).unwrap();
    let [k, m] = doubles(block);
    let condensation =
        SparseCondensation::new(k, Some(m), &particles(block, states), None).unwrap();
    let search = CondensedSearch {
        starts,
        ..CondensedSearch::default()
    };
    let found =
        search_condensed(&condensation, to_f64(&friction), &search, &Watch::nobody()).unwrap();
    let system = block.system(states, Some(friction)).unwrap();
    let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap();
    let pencil = reduce(&problem).unwrap().pencil;
    if found.solutions.is_empty() {
        return (found, Vec::new());
    }
    let claims = found
        .solutions
        .iter()
        .map(|s| propose(&pencil, problem.window(), &s.candidate).unwrap())
        .collect();
    let accepted = check(&problem, &certificate(&problem, claims)).unwrap();
    let values = accepted
        .claims
        .iter()
        .map(|c| (c.support.clone(), to_f64(&c.value.mid())))
        .collect();
    (found, values)
}

/// Against the exact enumerator, on blocks it can take, with both masses.
#[test]
fn lambda2_of_small_blocks_is_that_of_the_enumerator() {
    let mut met = 0;
    for mass in [MassKind::Lumped, MassKind::Consistent] {
        let block = Block::new(&BlockModel {
            mass,
            ..BlockModel::of_the_paper().with_cells(2, 1)
        })
        .unwrap();
        for (mu, states) in [
            ("3", [LEFT, LEFT, ContactState::Free]),
            ("6", [LEFT, LEFT, LEFT]),
            ("4", [RIGHT, LEFT, RIGHT]),
            ("1/2", [LEFT; 3]),
        ] {
            let system = block.system(&states, Some(parse(mu).unwrap())).unwrap();
            let problem =
                Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap();
            let truth = enumerate(&reduce(&problem).unwrap().pencil, problem.window())
                .unwrap()
                .solutions;
            let (found, values) = certified(&block, &states, mu, 12);
            assert_eq!(
                values.len(),
                truth.len(),
                "{mass:?} {mu}: {:?}",
                found.terminations
            );
            for ((support, value), t) in values.iter().zip(&truth) {
                assert_eq!(*support, t.slip);
                approx::assert_relative_eq!(
                    *value,
                    t.decimal(17).parse::<f64>().unwrap(),
                    max_relative = 1e-10
                );
            }
            for s in &found.solutions {
                assert!(
                    s.slip
                        .iter()
                        .zip(&s.reaction)
                        .all(|(x, y)| *x > -1e-9 && *y > -1e-8),
                    "{s:?}"
                );
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
        let (found, values) = certified(&block, &states, mu, 6);
        assert_eq!(values.len(), 1, "{:?}", found.terminations);
        assert!(values[0].1 > 1e5);
        approx::assert_relative_eq!(
            values[0].1,
            found.solutions[0].candidate.value,
            max_relative = 1e-10
        );
    }
}

/// `cargo test --release --test paper -- --ignored --nocapture scale::`: the certified values of
/// `complete_block.rs`.
#[test]
#[ignore = "a minute in the release profile, most of it certification"]
fn lambda2_of_the_17_slip_state_comes_out_and_is_certified() {
    for (mass, k) in [(MassKind::Lumped, 0), (MassKind::Consistent, 1)] {
        let block = Block::of_the_paper(mass);
        for (mu, expected) in [
            ("1.8", [412358.9120, 415207.9740]),
            ("2", [1896714.8265, 1924752.8394]),
            ("3", [301277635.12, 825684809.39]),
        ] {
            let clock = std::time::Instant::now();
            let (found, values) =
                certified(&block, &PublishedState::SeventeenSlip.states(), mu, 22);
            println!(
                "{mass:?} {mu}: {values:?} in {:.1} s, {} of {} runs, {} factorisations",
                clock.elapsed().as_secs_f64(),
                found.solutions.iter().map(|s| s.runs).sum::<usize>(),
                found.runs,
                found.factorisations
            );
            assert_eq!(values.len(), 1);
            assert_eq!(values[0].0.len(), 17);
            approx::assert_relative_eq!(values[0].1, expected[k], max_relative = 1e-8);
        }
    }
}

/// `cargo test --release --test paper -- --ignored scale::`: the value that SciPy's SuperLU gives
/// too (`benches/condense_scipy.py`).
#[test]
#[ignore = "seconds in the release profile"]
fn two_hundred_thousand_degrees_of_freedom() {
    let block = DoubleBlock::new(&BlockModel::refined(272)).unwrap();
    let stiffness = Symmetric::new(
        block.stiffness.order,
        block.stiffness.entries.iter().copied(),
    )
    .unwrap();
    let condensation = SparseCondensation::new(
        stiffness,
        None,
        &block.particles(&[LEFT; 272]),
        Some(&block.points),
    )
    .unwrap();
    let condensed = condensation.at(0.0).unwrap();
    let residual = condensed.residual(3);
    assert!(
        residual.balance < 1e-14 && residual.change < 1e-10,
        "{residual:?}"
    );
    let found = all_slip(&condensed.a, &condensed.b);
    assert_eq!(found.len(), 1);
    approx::assert_relative_eq!(found[0].mu, 1.70639639, max_relative = 1e-8);
}

/// The all-slip value in doubles against the certified one of the 17-slip state.
#[test]
fn the_all_slip_value_of_the_paper_s_mesh() {
    let block = DoubleBlock::new(&BlockModel::of_the_paper()).unwrap();
    let stiffness = Symmetric::new(
        block.stiffness.order,
        block.stiffness.entries.iter().copied(),
    )
    .unwrap();
    let particles = block.particles(&PublishedState::SeventeenSlip.states());
    let condensed =
        SparseCondensation::new(stiffness, None, &particles, Some(&block.points)).unwrap();
    let condensed = condensed.at(0.0).unwrap();
    let found = all_slip(&condensed.a, &condensed.b);
    assert_eq!(found.len(), 1);
    approx::assert_relative_eq!(found[0].mu, 1.704804329580, max_relative = 1e-11);
}
