//! Two particles on a slope (Table 1 of the paper) by three routes.
//!
//! The truth is the closed form of Table 1, in exact numbers. The enumerator must list the same
//! solutions, the solver must find them, and each one it finds must be certified and accepted. The
//! thresholds of the friction coefficient are compared as exact algebraic numbers. At the end the
//! same body is modelled in other axes: a direction taken wrongly would mean -mu instead of mu.
#![cfg(feature = "testkit")]

use mceip_engine::multistart::Search;
use mceip_exact::{Poly, Quadratic, Rational, Sign, Sparse, rational, whole};
use mceip_model::{ContactState, Particle, System, Unknown, Window};
use mceip_oracle::{Enumeration, Solution, TwoParticles, table1, thresholds};
use mceip_paper::{pythagorean_angles, two_particles};
use mceip_testkit::{compare, solutions_of, table1_grid};

const SIGNS: [(i8, i8); 4] = [(1, 1), (1, -1), (-1, 1), (-1, -1)];

/// All solutions of the system for this unknown.
fn all_solutions(system: System, unknown: Unknown) -> Enumeration {
    solutions_of(system, unknown, &Window::all())
}

/// Every seventh instance of the grid; `mceip verify` and tests/campaign/verify.rs run all of it.
#[test]
fn the_solver_finds_every_solution_and_all_engines_agree() {
    let mut solutions = 0;

    for instance in table1_grid().unwrap().iter().step_by(7) {
        let report = compare(instance, &Search::default());

        let label = &report.label;
        let disagreements = &report.disagreements;
        assert!(disagreements.is_empty(), "{label}: {disagreements:?}");
        assert_eq!(report.found, report.oracle, "{label}");
        solutions += report.oracle;
    }
    assert!(solutions > 30);
}

/// Is the number p + q sqrt(d) the value of the solution?
fn is_value_of(number: &Quadratic, solution: &Solution) -> bool {
    let interval = solution.value.interval();
    let is_in_interval = number.within(interval.lo(), interval.hi());
    let is_root = number.eval(solution.value.poly()).sign() == Sign::Zero;
    is_in_interval && is_root
}

/// The irrational thresholds cannot be put into a rational grid (erratum O1), so they are compared
/// as exact MCEIP-mu values; the rational ones as well.
#[test]
fn thresholds_are_the_values_of_mceip_mu() {
    for (c, s) in pythagorean_angles() {
        for signs in SIGNS {
            let data = TwoParticles {
                c: c.clone(),
                s: s.clone(),
                k: rational(7, 3),
                m: whole(1),
                mu: whole(1),
                signs,
            };
            let found = all_solutions(two_particles(&data).unwrap(), Unknown::Mu);
            let closed_form = thresholds(&data);

            if c == whole(0) {
                // K is singular: every mu is an eigenvalue of the full support. For S1 = S2 its
                // kernel (1, 1) is a solution for every mu, otherwise it is (1, -1) and there is
                // none.
                let expected_count = if signs.0 == signs.1 { None } else { Some(0) };
                assert_eq!(found.continua, vec![vec![0, 1]]);
                assert_eq!(closed_form.map(|list| list.len()), expected_count);
                continue;
            }

            let closed_form = closed_form.unwrap();
            let label = format!("c = {c}, S = {signs:?}");
            assert!(found.is_complete_list());
            assert_eq!(found.solutions.len(), closed_form.len(), "{label}");
            for threshold in closed_form {
                let mut count = 0;
                for solution in &found.solutions {
                    let same_support = solution.slip == threshold.slip;
                    let same_value = is_value_of(&threshold.value, solution);
                    count += usize::from(same_support && same_value);
                }
                assert_eq!(count, 1);
            }
        }
    }
}

/// A slope of 4/5 with k = m = 1 and opposite signs of slip.
fn steep_slope(mu: Rational) -> TwoParticles {
    TwoParticles {
        c: rational(3, 5),
        s: rational(4, 5),
        k: whole(1),
        m: whole(1),
        mu,
        signs: (1, -1),
    }
}

/// The number of solutions, of which every value must be lambda^2 = 0.
fn count_of_solutions_at_zero(mu: Rational) -> usize {
    let data = steep_slope(mu);
    let closed_form = table1(&data);
    let mut found = all_solutions(two_particles(&data).unwrap(), Unknown::Lambda2).solutions;

    assert_eq!(found.len(), closed_form.len());
    let identity = Poly::from_ints(&[0, 1]);
    for solution in &mut found {
        assert_eq!(solution.value.sign_of(&identity), Sign::Zero);
    }
    found.len()
}

/// At the threshold mu = (c^2 + 1) / (c s) lambda^2 = 0 is a root; 10^-12 below it the solution is
/// gone.
#[test]
fn thresholds_hold_with_equality() {
    let c = rational(3, 5);
    let s = rational(4, 5);
    let threshold = (&c * &c + whole(1)) / (&c * &s);
    let just_below = &threshold - rational(1, 1_000_000_000_000);

    assert_eq!(count_of_solutions_at_zero(threshold), 2);
    assert_eq!(count_of_solutions_at_zero(just_below), 0);
}

/// A value of lambda^2 in decimals, and its support.
#[derive(Debug, PartialEq)]
struct Row {
    value: String,
    slip: Vec<usize>,
}

fn rows_of(system: System) -> Vec<Row> {
    let mut rows = Vec::new();
    for solution in all_solutions(system, Unknown::Lambda2).solutions {
        rows.push(Row {
            value: solution.decimal(17),
            slip: solution.slip.clone(),
        });
    }
    rows
}

/// Particle 0 or 1, which slips with this sign on the dofs 2 index and 2 index + 1.
fn slipping_particle(index: usize, sign: i8) -> Particle {
    let tangential = 2 * index;
    let normal = 2 * index + 1;
    Particle::plain(tangential, normal, ContactState::Slip { sign })
}

/// The body with the normal dofs 1 and 3 mirrored: their rows and columns of K change sign, so that
/// the entries between a normal and a tangential dof do.
fn mirrored_system(plain: &System, normal_direction: i8) -> System {
    let mut entries = Vec::new();
    for (i, j, value) in plain.stiffness().entries() {
        let is_between_directions = (i + j) % 2 == 1;
        let mirrored = if is_between_directions {
            -value
        } else {
            value.clone()
        };
        entries.push((i, j, mirrored));
    }
    let stiffness = Sparse::from_entries(4, 4, entries);

    let mut first = slipping_particle(0, 1);
    let mut second = slipping_particle(1, -1);
    first.normal_direction = normal_direction;
    second.normal_direction = normal_direction;

    let mass = plain.mass().cloned();
    System::new(stiffness, mass, Some(whole(8)), vec![first, second]).unwrap()
}

/// Q' K Q.
fn congruent(k: &Sparse, q: &Sparse) -> Sparse {
    let order = k.rows();
    let mut entries = Vec::new();

    for i in 0..order {
        for j in 0..order {
            let mut sum = whole(0);
            for (row, column, value) in k.entries() {
                sum += value * q.get(row, i) * q.get(column, j);
            }
            entries.push((i, j, sum));
        }
    }
    Sparse::from_entries(order, order, entries)
}

/// Both particles in axes turned by (3/5, 4/5): K' = Q' K Q with (T, N) = frame (first, second).
fn turned_system(plain: &System) -> System {
    let tangential = [rational(3, 5), rational(4, 5)];
    let normal = [rational(-4, 5), rational(3, 5)];
    let frame = [tangential, normal];

    let mut rotation = Vec::new();
    for particle in 0..2 {
        for i in 0..2 {
            for j in 0..2 {
                let start = 2 * particle;
                rotation.push((start + i, start + j, frame[i][j].clone()));
            }
        }
    }
    let rotation = Sparse::from_entries(4, 4, rotation);
    let stiffness = congruent(plain.stiffness(), &rotation);

    let mut first = slipping_particle(0, 1);
    let mut second = slipping_particle(1, -1);
    first.frame = Some(frame.clone());
    second.frame = Some(frame);

    let mass = plain.mass().cloned();
    System::new(stiffness, mass, Some(whole(8)), vec![first, second]).unwrap()
}

/// The same body with the normals pointing up and down, and turned by a rotation: same solutions.
/// A wrong direction would mean mu -> -mu, silently.
#[test]
fn modelling_up_or_down_or_oblique_is_the_same() {
    let plain = two_particles(&steep_slope(whole(8))).unwrap();
    let expected = rows_of(plain.clone());
    assert_eq!(expected.len(), 3);

    // The mirrored normals point down; to call them upward is visible.
    assert_eq!(rows_of(mirrored_system(&plain, -1)), expected);
    assert_ne!(rows_of(mirrored_system(&plain, 1)), expected);

    assert_eq!(rows_of(turned_system(&plain)), expected);
}
