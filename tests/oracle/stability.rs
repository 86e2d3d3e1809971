//! Laws of the mechanics on random problems, decided in exact numbers.
//!
//! The truth is theorems: condition (19) is necessary for divergence, (17)-(18) suffice, the
//! symmetric part bounds the real spectrum, little friction is silent. Then changes that must leave
//! the answer as it is, or multiply its values by a known number: scale, mass, coordinates,
//! numbering. Each test also counts how often its law had something to say.
#![cfg(feature = "testkit")]

use mceip_engine::analysis::conditions::{DefiniteUntil, condensed};
use mceip_exact::{
    Algebraic, Integer, Interval, Poly, Rational, Sparse, common_denominator, determinant,
    positive_definite, rational, roots_in, schur_complement, whole,
};
use mceip_model::reduction::mu_family;
use mceip_model::{Particle, Pencil, System, Unknown, Window};
use mceip_oracle::{Enumeration, Solution, constants, enumerate, is_rational_solution};
use mceip_testkit::generators::{self, gram, permuted, raw, sparse, states, with_scaled_rows};
use mceip_testkit::solutions_of;
use num_traits::Zero;
use proptest::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

fn rng(index: u64) -> ChaCha8Rng {
    generators::rng(1000, index)
}

/// A random system whose particles have the states of this number.
fn random_system(rng: &mut ChaCha8Rng, index: u64) -> System {
    let states = states::mixture(index);
    let mut corners = Vec::new();
    states::system(rng, &states, &mut corners).unwrap()
}

fn solve(pencil: &Pencil) -> Enumeration {
    enumerate(pencil, &Window::all()).unwrap()
}

fn solve_system(system: System, unknown: Unknown) -> Enumeration {
    solutions_of(system, unknown, &Window::all())
}

fn scaled(matrix: &Sparse, factor: &Rational) -> Sparse {
    Sparse::zeros(matrix.rows(), matrix.cols()).add_scaled(factor, matrix)
}

/// (M + M') / 2.
fn symmetric_part(matrix: &Sparse) -> Sparse {
    let sum = matrix.add_scaled(&whole(1), &matrix.transpose());
    scaled(&sum, &rational(1, 2))
}

fn has_definite_symmetric_part(matrix: &Sparse) -> bool {
    positive_definite(&symmetric_part(matrix)).is_ok()
}

/// `factor` times the number, as a root of the polynomial with its roots multiplied by the factor.
///
/// If p(t) = sum of c_k t^k of degree d, that polynomial is the sum of c_k factor^(d - k) t^k.
fn times(factor: &Rational, value: &Algebraic) -> Algebraic {
    let mut power = whole(1);
    let mut coefficients = Vec::new();
    for c in value.poly().coeffs().iter().rev() {
        coefficients.push(Rational::from_integer(c.clone()) * &power);
        power *= factor;
    }
    coefficients.reverse();

    let lo = value.interval().lo() * factor;
    let hi = value.interval().hi() * factor;
    let interval = Interval::new(lo, hi).unwrap();
    Algebraic::from_claim(Poly::from_rationals(&coefficients), interval)
}

/// Has `second` the supports of `first` in the same order, and its values multiplied by the factor?
fn is_scaled_by(factor: &Rational, first: &Enumeration, second: &Enumeration) -> bool {
    let same_solutions = first.solutions.len() == second.solutions.len();
    let same_cones = first.cones.len() == second.cones.len();
    if !same_solutions || !same_cones {
        return false;
    }

    let mut pairs = first.solutions.iter().zip(&second.solutions);
    pairs.all(|(s, t)| is_scaled_solution(factor, s, t))
}

fn is_scaled_solution(factor: &Rational, first: &Solution, second: &Solution) -> bool {
    let same_slip = first.slip == second.slip;
    let same_biactive = first.biactive == second.biactive;
    let same_value = times(factor, &first.value).equals(&mut second.value.clone());
    same_slip && same_biactive && same_value
}

/// GG' + I for index = 1 modulo 3, otherwise GG' - 2 I, which may be indefinite; with a random skew
/// part, so that the symmetric part is not the whole.
fn skewed_stiffness(rng: &mut ChaCha8Rng, index: u64, order: usize) -> Vec<Vec<i64>> {
    let shift = if index % 3 == 1 { 1 } else { -2 };
    let mut stiffness = gram(rng, order, shift);

    for i in 0..order {
        for j in 0..i {
            let skew = rng.random_range(-4..=4);
            stiffness[i][j] += skew;
            stiffness[j][i] -= skew;
        }
    }
    stiffness
}

/// (19): with M* positive semidefinite and K* positive definite nothing diverges. Both sides of the
/// condition occur.
#[test]
fn condition_19_is_necessary() {
    let mut silent = 0;
    let mut diverging = 0;

    for index in 0..300 {
        let mut rng = rng(index);
        let slip_count = rng.random_range(1..=3);
        let free_count = rng.random_range(0..=1);
        let pencil = if index % 3 == 0 {
            raw::elements(Unknown::Lambda2, &mut rng, slip_count, free_count)
        } else {
            let order = slip_count + free_count;
            let stiffness = skewed_stiffness(&mut rng, index, order);
            let mass = gram(&mut rng, order, 1);
            let free = (0..free_count).collect();
            Pencil::new(sparse(&stiffness), sparse(&mass), free)
        };
        let pencil = pencil.unwrap();

        let definite_mass = has_definite_symmetric_part(pencil.b());
        let definite_stiffness = has_definite_symmetric_part(pencil.a());
        let is_silent = definite_mass && definite_stiffness;

        let found = solve(&pencil);
        let diverges = !found.solutions.is_empty() || !found.cones.is_empty();

        assert!(
            !(is_silent && diverges),
            "{pencil:?}: (19) fails and {:?} diverges",
            found.solutions
        );
        silent += usize::from(is_silent);
        diverging += usize::from(diverges);
    }

    assert!(silent > 60, "{silent} {diverging}");
    assert!(diverging > 30, "{silent} {diverging}");
}

/// The Schur complement of the free variables, which come first in the pencil of a system.
fn over_slip_variables(matrix: &Sparse, free_count: usize) -> Sparse {
    let free: Vec<usize> = (0..free_count).collect();
    let slip: Vec<usize> = (free_count..matrix.rows()).collect();
    let block = |rows: &[usize], columns: &[usize]| matrix.submatrix(rows, columns);

    let corner = block(&slip, &slip);
    if free.is_empty() {
        return corner;
    }
    let of_free = block(&free, &free);
    schur_complement(
        &of_free,
        &block(&free, &slip),
        &block(&slip, &free),
        &corner,
    )
    .unwrap()
}

/// Chapter 2.3: where the condensed matrix has a definite symmetric part, MCEIP-mu has no solution
/// up to this mu. It has one wherever K* has one, and beyond.
#[test]
fn the_condensed_condition_excludes_lambda_zero() {
    let mut beyond = 0;
    let mut diverging = 0;

    for index in 0..140 {
        let mut rng = rng(6000 + index);
        let system = random_system(&mut rng, index);
        let family = mu_family(&system).unwrap().stiffness;
        let free_count = family.free().len();

        for mu in [rational(1, 8), rational(1, 2), whole(1), whole(2), whole(8)] {
            let whole_matrix = at_friction(&family, &mu);
            let is_definite = has_definite_symmetric_part(&whole_matrix);
            let matrix = over_slip_variables(&whole_matrix, free_count);

            if !has_definite_symmetric_part(&matrix) {
                assert!(!is_definite, "{index}: mu = {mu}");
                continue;
            }

            let window = Window::new(whole(0), Some(mu.clone())).unwrap();
            let found = enumerate(&family, &window).unwrap();
            assert!(found.solutions.is_empty() && found.cones.is_empty());
            beyond += usize::from(!is_definite);
        }

        diverging += usize::from(!solve(&family).solutions.is_empty());
    }

    assert!(beyond > 20, "{beyond} {diverging}");
    assert!(diverging > 20, "{beyond} {diverging}");
}

/// The end of the condensed condition as the program computes it: no solution of MCEIP-mu lies
/// below, and the end of (19) itself does not lie beyond.
#[test]
fn no_static_threshold_lies_below_the_end_of_the_condensed_condition() {
    let mut beyond = 0;
    let mut bounded = 0;

    for index in 0..300 {
        let mut rng = rng(3000 + index);
        let system = random_system(&mut rng, index);
        let pencil = mu_family(&system).unwrap().stiffness;
        let of_k = DefiniteUntil::of("K*", pencil.a(), pencil.b()).unwrap();
        let Some(of_t) = condensed(&pencil, &of_k) else {
            continue;
        };

        let found = solve(&pencil);
        let (Some(end_of_k), Some(end)) = (of_k.end(), of_t.end()) else {
            let is_always = matches!(of_t, DefiniteUntil::Always);
            assert!(!is_always || found.solutions.is_empty(), "{index}");
            continue;
        };

        assert!(end_of_k.lo() <= end.hi(), "{index}");
        beyond += usize::from(end_of_k.hi() < end.lo());
        for solution in found.solutions {
            let mut value = solution.value;
            assert!(value.cmp_rational(end.lo()).is_ge(), "{index}: {end:?}");
            bounded += 1;
        }
    }

    assert!(beyond > 20 && bounded > 20, "{beyond} {bounded}");
}

/// (17)-(18): a null vector with x_s >= 0 at lambda^2 >= 0 is a solution, and the enumerator has
/// it; the same vector with one sign turned is none.
#[test]
fn conditions_17_and_18_suffice() {
    for index in 0..60 {
        let mut rng = rng(1000 + index);

        // Given a value, a vector x >= 0 with x_0 = 1 and B, A is made to fit: the image of x under
        // a random A + value B is taken off its first column.
        let n = rng.random_range(2..=4);
        let value = rational(rng.random_range(0..=20), rng.random_range(1..=5));
        let mut x = Vec::new();
        for _ in 0..n {
            x.push(rational(rng.random_range(0..=5), rng.random_range(1..=3)));
        }
        x[0] = whole(1);
        let b = sparse(&gram(&mut rng, n, 1));
        let any = raw::digits(&mut rng, n, 0).unwrap();

        let image = any.a().add_scaled(&value, &b).times(&x);
        let mut first_column = Vec::new();
        for (i, component) in image.into_iter().enumerate() {
            first_column.push((i, 0, component));
        }
        let correction = Sparse::from_entries(n, n, first_column);
        let a = any.a().add_scaled(&whole(-1), &correction);
        let pencil = Pencil::new(a, b, vec![]).unwrap();

        assert!(is_rational_solution(&pencil, &value, &x));
        let value = Algebraic::rational(value);
        let found = solve(&pencil);
        assert!(found.contains(&pencil, &value, &constants(&x)), "{index}");

        x[0] = whole(-1);
        assert!(!found.contains(&pencil, &value, &constants(&x)), "{index}");
    }
}

/// det(A - t I) for a matrix of integers.
fn characteristic_polynomial(rows: &[Vec<i64>]) -> Poly {
    let order = rows.len();
    let mut a = Vec::new();
    let mut minus_identity = Vec::new();

    for (i, row) in rows.iter().enumerate() {
        a.push(row.iter().map(|v| Integer::from(*v)).collect());

        let mut entries = vec![Integer::from(0); order];
        entries[i] = Integer::from(-1);
        minus_identity.push(entries);
    }
    determinant(&[a, minus_identity])
}

/// The least eigenvalue of the symmetric part is no larger than any real eigenvalue: sym(A) - r I
/// is not positive definite for any r at or above one. And below all of them it may be.
#[test]
fn symmetric_parts_bound_the_real_spectrum() {
    let mut eigenvalues = 0;

    for index in 0..120 {
        let mut rng = rng(2000 + index);
        let n = rng.random_range(1..=4);
        let mut rows = vec![vec![0; n]; n];
        for row in &mut rows {
            for entry in row {
                *entry = rng.random_range(-5..=5);
            }
        }
        let symmetric = symmetric_part(&sparse(&rows));
        let shifted_by = |r: &Rational| symmetric.add_scaled(&-r, &Sparse::identity(n));

        let polynomial = characteristic_polynomial(&rows);
        for mut root in roots_in(&polynomial, &whole(-100), Some(&whole(100))) {
            root.refine_to(&rational(1, 1 << 30));
            let above_root = shifted_by(root.interval().hi());
            assert!(positive_definite(&above_root).is_err(), "{rows:?}");
            eigenvalues += 1;
        }

        // Gershgorin: at -100 the symmetric part is definite, so the law above is not empty.
        assert!(positive_definite(&shifted_by(&whole(-100))).is_ok());
    }

    assert!(eigenvalues > 100);
}

/// The matrix A + mu B of a family.
fn at_friction(family: &Pencil, mu: &Rational) -> Sparse {
    family.a().add_scaled(mu, family.b())
}

/// The first mu of 1, 1/2, 1/4, ... at which K* and M* have definite symmetric parts.
fn small_friction(stiffness: &Pencil, mass: &Pencil) -> Rational {
    let mut mu = whole(1);
    loop {
        let definite_stiffness = has_definite_symmetric_part(&at_friction(stiffness, &mu));
        let definite_mass = has_definite_symmetric_part(&at_friction(mass, &mu));
        if definite_stiffness && definite_mass {
            return mu;
        }
        mu /= whole(2);
    }
}

/// K* + lambda^2 M* at a friction coefficient.
fn pencil_at_friction(stiffness: &Pencil, mass: &Pencil, mu: &Rational) -> Pencil {
    let k = at_friction(stiffness, mu);
    let m = at_friction(mass, mu);
    Pencil::new(k, m, stiffness.free().to_vec()).unwrap()
}

fn is_diagonal(matrix: &Sparse) -> bool {
    let mut entries = matrix.entries();
    entries.all(|(i, j, value)| i == j || value.is_zero())
}

fn is_zero(matrix: &Sparse) -> bool {
    let mut entries = matrix.entries();
    entries.all(|(_, _, value)| value.is_zero())
}

/// Section 3: K0 and M0 are definite, so are K* and M* for small mu, and then nothing diverges; a
/// lumped M gives M* = M0, diagonal. The first mu of 1, 1/2, 1/4, ... at which both are definite is
/// taken; larger ones are not always silent.
#[test]
fn small_friction_is_silent_and_a_lumped_mass_stays_diagonal() {
    let mut lumped = 0;
    let mut coupled = 0;
    let mut diverging = 0;

    for index in 0..140 {
        let mut rng = rng(5000 + index);
        let system = random_system(&mut rng, index);
        let family = mu_family(&system).unwrap();
        let stiffness = &family.stiffness;
        let mass = family.mass.as_ref().unwrap();

        assert!(positive_definite(stiffness.a()).is_ok(), "{index}");
        assert!(positive_definite(mass.a()).is_ok(), "{index}");

        let mut mass_entries = system.mass().unwrap().entries();
        let is_lumped = mass_entries.all(|(i, j, _)| i == j);
        if is_lumped {
            assert!(is_zero(mass.b()));
            assert!(is_diagonal(mass.a()));
            lumped += 1;
        } else {
            coupled += usize::from(!is_zero(mass.b()));
        }

        let mu = small_friction(stiffness, mass);
        let small = pencil_at_friction(stiffness, mass, &mu);
        assert!(solve(&small).solutions.is_empty(), "{index}: mu = {mu}");

        let large = pencil_at_friction(stiffness, mass, &whole(64));
        diverging += usize::from(!solve(&large).solutions.is_empty());
    }

    assert!(lumped > 40, "{lumped} {coupled} {diverging}");
    assert!(coupled > 20, "{lumped} {coupled} {diverging}");
    assert!(diverging > 20, "{lumped} {coupled} {diverging}");
}

/// The system with K and M multiplied by these factors.
fn scaled_system(system: &System, of_stiffness: &Rational, of_mass: &Rational) -> System {
    let stiffness = scaled(system.stiffness(), of_stiffness);
    let mass = system.mass().map(|mass| scaled(mass, of_mass));
    let friction = system.friction().cloned();
    System::new(stiffness, mass, friction, system.particles().to_vec()).unwrap()
}

/// M -> aM divides lambda^2 by a, K -> aK multiplies lambda^2 by a and leaves mu alone.
#[test]
fn mass_and_stiffness_may_be_scaled() {
    let one = whole(1);
    let mut solutions = 0;

    for index in 0..140 {
        let mut rng = rng(3000 + index);
        let system = random_system(&mut rng, index);
        let a = rational(rng.random_range(1..=9), rng.random_range(1..=9));
        let heavier = scaled_system(&system, &one, &a);
        let stiffer = scaled_system(&system, &a, &one);

        let lambda2 = solve_system(system.clone(), Unknown::Lambda2);
        let lambda2_heavier = solve_system(heavier, Unknown::Lambda2);
        let lambda2_stiffer = solve_system(stiffer.clone(), Unknown::Lambda2);
        let mu = solve_system(system, Unknown::Mu);
        let mu_stiffer = solve_system(stiffer, Unknown::Mu);

        let inverse = a.recip();
        assert!(
            is_scaled_by(&inverse, &lambda2, &lambda2_heavier),
            "{index}"
        );
        assert!(is_scaled_by(&a, &lambda2, &lambda2_stiffer), "{index}");
        assert!(is_scaled_by(&one, &mu, &mu_stiffer), "{index}");

        // The comparison tells factors apart.
        assert!(mu.solutions.is_empty() || !is_scaled_by(&whole(2), &mu, &mu));
        solutions += lambda2.solutions.len() + mu.solutions.len();
    }

    assert!(solutions > 50);
}

/// The matrix with row and column d moved to d + 1, and the last one to the front.
fn renumbered_matrix(matrix: &Sparse) -> Sparse {
    let n = matrix.rows();
    let mut old_numbers = vec![n - 1];
    old_numbers.extend(0..n - 1);
    matrix.submatrix(&old_numbers, &old_numbers)
}

/// The system with dof d renumbered to d + 1 modulo their number, and the particles in the opposite
/// order.
fn renumbered(system: &System) -> System {
    let n = system.dofs();
    let mut particles = Vec::new();
    for particle in system.particles().iter().rev() {
        particles.push(Particle {
            tangential: (particle.tangential + 1) % n,
            normal: (particle.normal + 1) % n,
            ..particle.clone()
        });
    }

    let stiffness = renumbered_matrix(system.stiffness());
    let mass = system.mass().map(renumbered_matrix);
    System::new(stiffness, mass, system.friction().cloned(), particles).unwrap()
}

/// Values and sizes of supports, sorted.
fn values_and_sizes(system: &System, unknown: Unknown) -> Vec<(String, usize)> {
    let mut list = Vec::new();
    for solution in solve_system(system.clone(), unknown).solutions {
        list.push((solution.decimal(20), solution.slip.len()));
    }
    list.sort();
    list
}

/// Other numbers for the dofs, another order of the particles: the same values.
#[test]
fn dofs_and_particles_may_be_renumbered() {
    for index in 0..70 {
        let mut rng = rng(4000 + index);
        let system = random_system(&mut rng, index);
        let other = renumbered(&system);

        for unknown in [Unknown::Lambda2, Unknown::Mu] {
            let expected = values_and_sizes(&system, unknown);
            assert_eq!(expected, values_and_sizes(&other, unknown), "{index}");
        }
    }
}

/// D M D for a diagonal D.
fn congruent(matrix: &Sparse, diagonal: &[Rational]) -> Sparse {
    let mut entries = Vec::new();
    for (i, j, value) in matrix.entries() {
        let factor = &diagonal[i] * &diagonal[j];
        entries.push((i, j, value * factor));
    }
    Sparse::from_entries(matrix.rows(), matrix.cols(), entries)
}

/// D^-1 x, times a number that makes its coefficients integers.
fn divided_by(x: &[Poly], diagonal: &[Rational]) -> Vec<Poly> {
    let inverses: Vec<Rational> = diagonal.iter().map(|d| d.recip()).collect();
    let denominator = Rational::from_integer(common_denominator(&inverses));

    let mut scaled = Vec::new();
    for (component, inverse) in x.iter().zip(&inverses) {
        let factor = (&denominator * inverse).to_integer();
        scaled.push(component.scale(&factor));
    }
    scaled
}

/// What a solution keeps when the variables change places and the rows their scale.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Shape {
    value: String,
    slip_count: usize,
    biactive_count: usize,
    multiplicity: usize,
}

/// The shapes of the solutions of a pencil, and how many other things its answer lists.
#[derive(Debug, PartialEq)]
struct AnswerShape {
    solutions: Vec<Shape>,
    cones: usize,
    ranges: usize,
    continua: usize,
}

fn shape_of_answer(pencil: &Pencil) -> AnswerShape {
    let found = solve(pencil);
    let mut solutions = Vec::new();
    for solution in &found.solutions {
        solutions.push(Shape {
            value: solution.decimal(20),
            slip_count: solution.slip.len(),
            biactive_count: solution.biactive.len(),
            multiplicity: solution.multiplicity,
        });
    }
    solutions.sort();

    AnswerShape {
        solutions,
        cones: found.cones.len(),
        ranges: found.ranges.len(),
        continua: found.continua.len(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]

    /// D A D and D B D with a positive diagonal D: the same values and supports, D^-1 x for x.
    #[test]
    fn positive_diagonal_congruence(
        index in 0u64..100_000,
        diagonal in prop::collection::vec((1i64..20, 1i64..20), 5),
    ) {
        let mut rng = rng(index);
        let n = rng.random_range(1..=4);
        let pencil = if index % 2 == 0 {
            raw::free_anywhere(&mut rng, n).unwrap()
        } else {
            raw::zeros(&mut rng, n).unwrap()
        };
        let diagonal: Vec<Rational> = diagonal.iter().map(|&(p, q)| rational(p, q)).collect();

        let a = congruent(pencil.a(), &diagonal);
        let b = congruent(pencil.b(), &diagonal);
        let other = Pencil::new(a, b, pencil.free().to_vec()).unwrap();

        let answer = solve(&pencil);
        let other_answer = solve(&other);

        prop_assert!(is_scaled_by(&whole(1), &answer, &other_answer));
        for solution in &answer.solutions {
            let x = divided_by(&solution.x, &diagonal);
            prop_assert!(other_answer.contains(&other, &solution.value, &x));
        }
    }

    /// Any order of the variables and any positive scale of the rows: the same values and as large
    /// supports.
    #[test]
    fn any_permutation_and_row_scaling(index in 0u64..100_000) {
        let mut rng = rng(index);
        let n = rng.random_range(1..=4);
        let pencil = if index % 2 == 0 {
            raw::free_anywhere(&mut rng, n).unwrap()
        } else {
            raw::identity(&mut rng, n).unwrap()
        };

        let turned = permuted(&mut rng, &pencil);
        let other = with_scaled_rows(&mut rng, &turned);

        prop_assert_eq!(shape_of_answer(&pencil), shape_of_answer(&other));
    }
}
