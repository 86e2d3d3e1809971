//! Complete answers of `mceip_oracle::enumerate` against an independent enumeration.
//!
//! The truth is `tests/oracle/third`, which shares no line with `mceip_exact` or `mceip_oracle` and
//! goes another way at every step, over the integers of another library. Compared are the rays and
//! cones at every value, the supports with solutions at a whole range of values, and the ends of
//! these ranges. Each side must confirm what the other lists, so a solution too many is noticed as
//! well as one too few.

use crate::small::sparse;
use crate::third::field::Alpha;
use crate::third::poly::{Bracket, Polynomial};
use crate::third::{Ray, Third, rational_value, same_ray};
use dashu_int::IBig;
use dashu_ratio::RBig;
use mceip_exact::{Algebraic, Poly, Rational, rational};
use mceip_model::{Pencil, Window};
use mceip_oracle::{Cone, End, Enumeration, Solution, SupportRange, ValueInterval, enumerate};
use num_bigint::BigInt;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Numerators and denominators of the values at which ranges are tested.
const RANGE_SAMPLES: [(i64, i64); 11] = [
    (0, 1),
    (1, 3),
    (1, 2),
    (1, 1),
    (4, 3),
    (3, 2),
    (2, 1),
    (5, 2),
    (3, 1),
    (9, 2),
    (100, 1),
];

fn converted_integer(value: &BigInt) -> IBig {
    value.to_string().parse().unwrap()
}

fn converted_rational(value: &Rational) -> RBig {
    let numerator = converted_integer(value.numer());
    let denominator = converted_integer(value.denom());
    RBig::from(numerator) / RBig::from(denominator)
}

fn converted_polynomial(p: &Poly) -> Polynomial {
    let mut converted = Polynomial::new();
    for coefficient in p.coeffs() {
        converted.push(RBig::from(converted_integer(coefficient)));
    }
    converted
}

fn converted_interval(value: &Algebraic) -> Bracket {
    Bracket {
        lo: converted_rational(value.interval().lo()),
        hi: converted_rational(value.interval().hi()),
    }
}

fn converted_value(value: &Algebraic) -> Alpha {
    let p = converted_polynomial(value.poly());
    Alpha::new(&p, converted_interval(value))
}

fn converted_vector(solution: &Solution) -> Vec<Polynomial> {
    solution.x.iter().map(converted_polynomial).collect()
}

/// Are the two values the same number?
fn is_same_value(alpha: &mut Alpha, value: &Algebraic) -> bool {
    let p = converted_polynomial(value.poly());
    let interval = converted_interval(value);
    alpha.is_root_in(&p, &interval.lo, &interval.hi)
}

fn are_equal(left: &Algebraic, right: &Algebraic) -> bool {
    left.clone().equals(&mut right.clone())
}

fn is_irrational(value: &Algebraic) -> bool {
    let mut value = value.clone();
    value.try_rational();
    value.as_rational().is_none()
}

/// What the comparisons met, so that a test can say that they met enough.
#[derive(Debug, Default)]
struct Seen {
    solutions: usize,
    irrational: usize,
    biactive: usize,
    free_only: usize,
    cones: usize,
    ranges: usize,
    isolated: usize,
    lines: usize,
}

impl Seen {
    fn count(&mut self, answer: &Enumeration) {
        self.solutions += answer.solutions.len();
        self.cones += answer.cones.len();
        self.ranges += answer.ranges.len();

        for solution in &answer.solutions {
            self.irrational += usize::from(is_irrational(&solution.value));
            self.biactive += usize::from(!solution.biactive.is_empty());
            self.free_only += usize::from(solution.is_free_only());
            self.isolated += usize::from(is_isolated(solution));
        }
    }
}

/// Is this what a singular support has at one value only? Such solutions have multiplicity 0.
fn is_isolated(solution: &Solution) -> bool {
    solution.multiplicity == 0
}

/// How many of our solutions and cones belong to some values.
#[derive(Debug, Default, PartialEq)]
struct Matched {
    solutions: usize,
    cones: usize,
}

/// A maximal cone by its support and the number of its rays.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct ConeShape {
    support: Vec<usize>,
    rays: usize,
}

/// Both enumerations of one pencil.
struct Comparison<'a> {
    theirs: &'a Third,
    singular: &'a [Vec<usize>],
    ours: &'a Enumeration,
    label: &'a str,
}

/// Compares everything for one pencil, and adds to `seen` what was there.
fn compare(a: Vec<Vec<i64>>, b: Vec<Vec<i64>>, free: Vec<usize>, seen: &mut Seen) {
    let label = format!("A = {a:?}, B = {b:?}, free {free:?}");

    let pencil = Pencil::new(sparse(&a), sparse(&b), free.clone()).unwrap();
    let ours = enumerate(&pencil, &Window::all()).unwrap();
    assert!(ours.is_complete_list(), "{label}");

    let theirs = Third { a, b, free };
    let spectrum = theirs.spectrum();
    assert_eq!(
        sorted(&ours.continua),
        sorted(&spectrum.singular),
        "{label}"
    );

    let comparison = Comparison {
        theirs: &theirs,
        singular: &spectrum.singular,
        ours: &ours,
        label: &label,
    };
    let mut matched = Matched::default();
    for alpha in &mut values_to_compare(spectrum.values, &ours) {
        let here = comparison.compare_at(alpha, seen);
        matched.solutions += here.solutions;
        matched.cones += here.cones;
    }
    let listed = Matched {
        solutions: ours.solutions.len(),
        cones: ours.cones.len(),
    };
    assert_eq!(matched, listed, "{label}");

    comparison.compare_ranges();
    comparison.compare_ends();
    seen.count(&ours);
}

fn sorted(supports: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut supports = supports.to_vec();
    supports.sort();
    supports
}

/// Their roots, and the values at which a singular support has something: it may be at none of
/// these roots.
fn values_to_compare(roots: Vec<Alpha>, ours: &Enumeration) -> Vec<Alpha> {
    let isolated = ours.solutions.iter().filter(|s| is_isolated(s));
    let values_of_isolated = isolated.map(|solution| &solution.value);
    let values_of_cones = ours.cones.iter().map(|cone| &cone.value);

    let mut values = roots;
    for value in values_of_isolated.chain(values_of_cones) {
        let mut known = values.iter_mut();
        if !known.any(|alpha| is_same_value(alpha, value)) {
            values.push(converted_value(value));
        }
    }
    values
}

impl Comparison<'_> {
    /// Does a singular support have solutions in a whole range of values around alpha? Nobody lists
    /// these one by one.
    fn is_in_range(&self, support: &[usize], alpha: &mut Alpha) -> bool {
        if !self.singular.iter().any(|s| s == support) {
            return false;
        }
        let mut ranges = self.ours.ranges.iter().filter(|r| r.support == support);
        ranges.any(|range| range_holds(range, alpha))
    }

    /// Compares rays and cones at one value; returns how many of our solutions and cones belong to
    /// it.
    fn compare_at(&self, alpha: &mut Alpha, seen: &mut Seen) -> Matched {
        let mut solutions = Vec::new();
        for solution in &self.ours.solutions {
            if is_same_value(alpha, &solution.value) {
                solutions.push(solution);
            }
        }
        let mut cones = Vec::new();
        for cone in &self.ours.cones {
            if is_same_value(alpha, &cone.value) {
                cones.push(cone);
            }
        }
        let matched = Matched {
            solutions: solutions.len(),
            cones: cones.len(),
        };

        if cones.iter().any(|cone| !cone.lineality.is_empty()) {
            // Extreme rays modulo a subspace: compared by hand in
            // tests/oracle/oracle_degenerate.rs.
            seen.lines += 1;
            return matched;
        }
        self.compare_rays(alpha, &solutions, &cones);
        self.compare_cones(alpha, &cones);
        matched
    }

    /// Our solutions and the rays of our cones are their rays, one for one.
    fn compare_rays(&self, alpha: &mut Alpha, solutions: &[&Solution], cones: &[&Cone]) {
        let label = self.label;

        let mut rays: Vec<Ray> = Vec::new();
        for ray in self.theirs.rays(alpha) {
            if !self.is_in_range(&ray.slip, alpha) {
                rays.push(ray);
            }
        }

        let mut generators: Vec<&Solution> = solutions.to_vec();
        for ray in cones.iter().flat_map(|cone| &cone.rays) {
            let is_listed = generators.contains(&ray);
            if !self.is_in_range(&ray.slip, alpha) && !is_listed {
                generators.push(ray);
            }
        }
        assert_eq!(generators.len(), rays.len(), "{label}: at {alpha:?}");

        for generator in &generators {
            let x = converted_vector(generator);
            let mut same_support = rays.iter().filter(|ray| ray.slip == generator.slip);
            let twin = same_support.find(|ray| same_ray(alpha, &ray.x, &x));

            let Some(twin) = twin else {
                let value = generator.decimal(9);
                panic!("{label}: {value:?} {:?} is not confirmed", generator.slip)
            };
            assert_eq!(twin.biactive(), generator.biactive, "{label}");
        }
    }

    /// Our cones are their maximal cones.
    fn compare_cones(&self, alpha: &mut Alpha, cones: &[&Cone]) {
        let mut regular = Vec::new();
        for support in self.theirs.supports() {
            if !self.is_in_range(&support, alpha) {
                regular.push(support);
            }
        }

        let rays = self.theirs.rays(alpha);
        let mut maximal = Vec::new();
        for cone in self.theirs.cones(alpha, &rays, &regular) {
            maximal.push(ConeShape {
                support: cone.support,
                rays: cone.rays.len(),
            });
        }
        let mut listed = Vec::new();
        for cone in cones {
            listed.push(ConeShape {
                support: cone.slip.clone(),
                rays: cone.rays.len(),
            });
        }

        maximal.sort();
        listed.sort();
        assert_eq!(maximal, listed, "{}: cones at {alpha:?}", self.label);
    }

    /// Both ends of every range: does their existence test say what `included` says?
    fn compare_ends(&self) {
        let label = self.label;
        for range in &self.ours.ranges {
            for end in ends(range) {
                let mut alpha = converted_value(&end.value);
                assert_eq!(
                    self.theirs.exists(&mut alpha, &range.support),
                    range.contains(&end.value),
                    "{label}: end of {:?} at {:?}",
                    range.support,
                    end.value
                );
            }
        }
    }

    /// Singular supports at rational samples: inside or outside their ranges, as their existence
    /// test says.
    fn compare_ranges(&self) {
        let label = self.label;
        for support in self.singular {
            for (numerator, denominator) in RANGE_SAMPLES {
                let mut alpha = rational_value(numerator, denominator);
                let exists = self.theirs.exists(&mut alpha, support);

                let value = Algebraic::rational(rational(numerator, denominator));
                let in_range = self.is_in_our_range(support, &value);
                // A solution may also lie in a face of a listed cone.
                let in_face = exists && self.is_in_face(support, &value);
                assert_eq!(
                    exists,
                    in_range || self.is_listed_at(support, &value) || in_face,
                    "{label}: support {support:?} at {numerator}/{denominator}"
                );
            }
        }
    }

    fn is_in_our_range(&self, support: &[usize], value: &Algebraic) -> bool {
        let ranges = self.ours.ranges.iter();
        let mut of_support = ranges.filter(|range| range.support == support);
        of_support.any(|range| range.contains(value))
    }

    /// Is a solution or a cone of this support listed at the value?
    fn is_listed_at(&self, support: &[usize], value: &Algebraic) -> bool {
        for solution in &self.ours.solutions {
            if solution.slip == support && are_equal(&solution.value, value) {
                return true;
            }
        }
        for cone in &self.ours.cones {
            if cone.slip == support && are_equal(&cone.value, value) {
                return true;
            }
        }
        false
    }

    /// Is the support part of the support of a cone at the value?
    fn is_in_face(&self, support: &[usize], value: &Algebraic) -> bool {
        let mut cones = self.ours.cones.iter();
        cones.any(|cone| {
            let is_part = support.iter().all(|i| cone.slip.contains(i));
            is_part && are_equal(&cone.value, value)
        })
    }
}

/// All ends of all pieces of a range.
fn ends(range: &SupportRange) -> Vec<&End> {
    let mut list = Vec::new();
    for piece in &range.pieces {
        list.extend(&piece.from);
        list.extend(&piece.to);
    }
    list
}

/// Does one of the pieces of the range hold alpha?
fn range_holds(range: &SupportRange, alpha: &mut Alpha) -> bool {
    range.pieces.iter().any(|piece| piece_holds(piece, alpha))
}

fn piece_holds(piece: &ValueInterval, alpha: &mut Alpha) -> bool {
    let mut is_beyond = |end: &Option<End>, side: i8| {
        end.as_ref()
            .is_some_and(|end| match compare_with_end(alpha, end) {
                0 => !end.included,
                place => place.signum() == side,
            })
    };
    !is_beyond(&piece.from, -1) && !is_beyond(&piece.to, 1)
}

/// 1 if alpha is larger than the end, 0 if equal, -1 if smaller.
fn compare_with_end(alpha: &mut Alpha, end: &End) -> i8 {
    if is_same_value(alpha, &end.value) {
        return 0;
    }

    // Another number: narrow the end until alpha lies on one side of its interval.
    let mut end = converted_value(&end.value);
    loop {
        if alpha.compare_to(&end.lo) <= 0 {
            return -1;
        }
        if alpha.compare_to(&end.hi) >= 0 {
            return 1;
        }
        end.halve();
    }
}

/// A matrix of order n with entries up to `largest`, of which a part `zeros` is zero.
fn random_matrix(rng: &mut ChaCha8Rng, n: usize, largest: i64, zeros: f64) -> Vec<Vec<i64>> {
    let mut matrix = vec![vec![0; n]; n];
    for row in &mut matrix {
        for entry in row {
            let is_zero = rng.random::<f64>() < zeros;
            if !is_zero {
                *entry = rng.random_range(-largest..=largest);
            }
        }
    }
    matrix
}

/// `diagonal` times the identity of order n.
fn scalar_matrix(n: usize, diagonal: i64) -> Vec<Vec<i64>> {
    let mut matrix = vec![vec![0; n]; n];
    for i in 0..n {
        matrix[i][i] = diagonal;
    }
    matrix
}

#[test]
fn random_pencils_regular_and_degenerate() {
    // From dense and generic to sparse, small and singular: largest entry and part of zeros.
    let kinds = [(9, 0.0), (3, 0.2), (1, 0.3), (1, 0.5), (2, 0.6)];
    let mut rng = ChaCha8Rng::seed_from_u64(20_261_121);
    let mut seen = Seen::default();

    for k in 0..400 {
        let n = 1 + k % 4;
        let (largest, zeros) = kinds[k / 4 % 5];
        let a = random_matrix(&mut rng, n, largest, zeros);
        let b = random_matrix(&mut rng, n, largest, zeros);
        let may_be_free = k % 3 == 2;
        let free = (0..n)
            .filter(|_| may_be_free && rng.random_range(0..3) == 0)
            .collect();

        compare(a, b, free, &mut seen);
    }

    eprintln!("{seen:?}");
    assert!(seen.solutions > 200, "{seen:?}");
    assert!(seen.irrational > 20, "{seen:?}");
    assert!(seen.biactive > 20, "{seen:?}");
    assert!(seen.free_only > 5, "{seen:?}");
    assert!(seen.ranges > 20, "{seen:?}");
    assert!(seen.isolated > 0, "{seen:?}");
}

/// Scalar-like and symmetric pencils: wide kernels with cones of all shapes.
#[test]
fn wide_kernels() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut seen = Seen::default();

    for k in 0..90 {
        let n = 3 + k % 2;

        // A = -I with up to four coupling entries.
        let mut a = scalar_matrix(n, -1);
        for _ in 0..k % 5 {
            let i = rng.random_range(0..n);
            let j = rng.random_range(0..n);
            a[i][j] += rng.random_range(-1..=1);
        }

        // B = I, in every seventh pencil with one entry more.
        let mut b = scalar_matrix(n, 1);
        if k % 7 == 0 {
            let i = rng.random_range(0..n);
            let j = rng.random_range(0..n);
            b[i][j] += 1;
        }

        let mut free = Vec::new();
        if k % 6 == 5 {
            free.push(rng.random_range(0..n));
        }
        compare(a, b, free, &mut seen);
    }

    eprintln!("{seen:?}");
    assert!(seen.cones > 60, "{seen:?}");
}
