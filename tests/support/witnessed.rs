//! Covers of small pencils in which one leaf has an honest witness and a random claim.
//!
//! The inverse and the null vectors of the leaf are computed from the pencil, so that steps 1 to 3
//! of a `root` leaf hold as a rule; what the leaf says (outcome, interval) is drawn. Window ends
//! are rationals with denominators other than one. All other leaves are open, hence the verdict is
//! that of the one leaf.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip_check::certificate::{Certificate, CompleteSet, Node, Piece, Root, RootOutcome};
use mceip_exact::{Integer, Poly, Rational, determinant, rational, roots_in, whole};
use mceip_model::file::Number;
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use mceip_testkit::generators::sparse;
use num_traits::{One, Zero};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Binary exponents of the witness.
const EXPONENT: u32 = 40;

pub struct Case {
    pub problem: Problem,
    pub certificate: Certificate,
}

/// A pencil of order 1 to 3 without free variables, a window, and a cover with one leaf that is not
/// open.
pub fn case(rng: &mut ChaCha8Rng) -> Case {
    let order = rng.random_range(1..=3);
    let entries = Entries::draw(rng, order);
    let (lo, hi) = draw_window(rng);
    let problem = entries.problem(&lo, hi.as_ref());

    let support = draw_support(rng, order);
    let region = Region::draw(rng, &lo, hi.as_ref());
    let weights = (0..order).map(|_| rng.random_range(-3..=3)).collect();
    let leaf = match rng.random_range(0..11) {
        0 => Node::Farkas(weights),
        1 => Node::PositiveDefinite,
        2 => Node::NegativeDefinite,
        3 => Node::WeightedDefinite(weights),
        _ => Node::Root(Box::new(root(rng, &entries, &support, &region))),
    };

    let tree = tree(order, &support, &region, leaf);
    let max = hi.clone().map(Number);
    let pieces = vec![Piece {
        max,
        anchor: None,
        tree,
    }];
    let certificate = Certificate {
        problem_sha256: problem.sha256(),
        unknown: problem.unknown(),
        window: problem.window().clone(),
        claims: Vec::new(),
        negative: None,
        complete_set: Some(CompleteSet {
            condensation: None,
            pieces,
        }),
    };

    Case {
        problem,
        certificate,
    }
}

/// A and B by rows.
struct Entries {
    a: Vec<Vec<i64>>,
    b: Vec<Vec<i64>>,
}

impl Entries {
    fn draw(rng: &mut ChaCha8Rng, order: usize) -> Self {
        let a = draw_rows(rng, order, 9);
        let mut b = draw_rows(rng, order, 2);

        // A third with B = I, as in the worked examples.
        if rng.random_range(0..3) == 0 {
            for (i, row) in b.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry = i64::from(i == j);
                }
            }
        }

        Entries { a, b }
    }

    fn problem(&self, lo: &Rational, hi: Option<&Rational>) -> Problem {
        let a = sparse(&self.a);
        let b = sparse(&self.b);
        let pencil = Pencil::new(a, b, Vec::new()).unwrap();
        let window = Window::new(lo.clone(), hi.cloned()).unwrap();

        Problem::new(Body::Pencil(pencil), Unknown::Lambda2, window).unwrap()
    }

    /// Entry of A + tB with its row divided by the power of two above the row's largest entry of A.
    fn scaled(&self, i: usize, j: usize, t: &Rational) -> Rational {
        let sizes = self.a[i].iter().map(|entry| entry.unsigned_abs());
        let largest = sizes.max().unwrap_or(0);
        let bits = (u64::BITS - largest.leading_zeros()).max(1);

        let a = whole(self.a[i][j]);
        let b = whole(self.b[i][j]);
        let scale = whole(1 << bits);
        (a + t * b) / scale
    }

    /// det(A + tB) on a support.
    fn determinant(&self, support: &[usize]) -> Poly {
        determinant(&[&self.a, &self.b].map(|matrix| block(matrix, support)))
    }
}

/// A square matrix with entries between -largest and largest, by rows.
fn draw_rows(rng: &mut ChaCha8Rng, order: usize, largest: i64) -> Vec<Vec<i64>> {
    let mut rows = vec![vec![0; order]; order];
    for entry in rows.iter_mut().flatten() {
        *entry = rng.random_range(-largest..=largest);
    }
    rows
}

/// The rows and columns of a support.
fn block(rows: &[Vec<i64>], support: &[usize]) -> Vec<Vec<Integer>> {
    let mut block = Vec::new();
    for &i in support {
        block.push(support.iter().map(|&j| rows[i][j].into()).collect());
    }
    block
}

fn draw_end(rng: &mut ChaCha8Rng) -> Rational {
    let denominators = [1, 2, 3, 7, 10, 1000, 1024];
    let denominator = denominators[rng.random_range(0..7)];

    let largest = 6 * denominator;
    rational(rng.random_range(1..=largest), denominator)
}

fn draw_window(rng: &mut ChaCha8Rng) -> (Rational, Option<Rational>) {
    let lo = if rng.random_range(0..8) == 0 {
        Rational::zero()
    } else {
        draw_end(rng)
    };
    let is_half_line = rng.random_range(0..2) == 0;
    let hi = if is_half_line {
        None
    } else {
        Some(&lo + draw_end(rng))
    };
    (lo, hi)
}

/// A set of variables that is not empty, ascending.
fn draw_support(rng: &mut ChaCha8Rng, order: usize) -> Vec<usize> {
    let subsets = 1u32 << order;
    let subset = rng.random_range(1..subsets);

    let mut support: Vec<usize> = (0..order).collect();
    support.retain(|i| subset >> i & 1 == 1);
    support
}

/// The interval of the leaf, and where the window was cut for it.
struct Region {
    lo: Rational,
    hi: Option<Rational>,
    cut: Option<Cut>,
}

/// The leaf lies on one side of a cut.
struct Cut {
    at: Rational,
    is_leaf_above: bool,
}

impl Region {
    fn draw(rng: &mut ChaCha8Rng, lo: &Rational, hi: Option<&Rational>) -> Self {
        let at = match hi {
            Some(hi) => lo + (hi - lo) * rational(rng.random_range(1..=6), 7),
            None => lo + draw_end(rng),
        };

        match rng.random_range(0..3) {
            0 => Region {
                lo: lo.clone(),
                hi: hi.cloned(),
                cut: None,
            },
            1 => Region {
                lo: lo.clone(),
                hi: Some(at.clone()),
                cut: Some(Cut {
                    at,
                    is_leaf_above: false,
                }),
            },
            _ => Region {
                lo: at.clone(),
                hi: hi.cloned(),
                cut: Some(Cut {
                    at,
                    is_leaf_above: true,
                }),
            },
        }
    }
}

/// A value near which the leaf's witness is computed: a zero of the determinant, or any.
fn draw_value(rng: &mut ChaCha8Rng, determinant: &Poly, region: &Region) -> Rational {
    let mut roots = if determinant.is_zero() {
        Vec::new()
    } else {
        roots_in(determinant, &whole(0), None)
    };

    if roots.is_empty() || rng.random_range(0..5) == 0 {
        return &region.lo + draw_end(rng) - rational(rng.random_range(0..=1), 3);
    }

    let mut root = roots.swap_remove(rng.random_range(0..roots.len()));
    root.refine_to(&rational(1, 1 << 30));
    root.interval().mid()
}

fn root(rng: &mut ChaCha8Rng, entries: &Entries, support: &[usize], region: &Region) -> Root {
    let value = draw_value(rng, &entries.determinant(support), region);
    let pivot = support[rng.random_range(0..support.len())];
    let others: Vec<usize> = support.iter().copied().filter(|&i| i != pivot).collect();
    let inverse = inverse(entries, &others, &value);

    // T' v = -T_'k and u' T' = -T_k'.
    let size = others.len();
    let mut right = vec![Rational::zero(); size];
    let mut left = vec![Rational::zero(); size];

    for i in 0..size {
        for j in 0..size {
            right[i] -= &inverse[i][j] * entries.scaled(others[j], pivot, &value);
            left[i] -= entries.scaled(pivot, others[j], &value) * &inverse[j][i];
        }
    }

    let outcome = draw_outcome(rng, entries, support);
    let needs_width = !matches!(outcome, RootOutcome::Absent | RootOutcome::Infinity(_));
    let interval = draw_interval(rng, &value, region, needs_width);

    Root {
        pivot,
        interval: interval.map(Number),
        inverse: inverse.iter().map(|row| in_units(row)).collect(),
        inverse_exponent: EXPONENT,
        left: in_units(&left),
        right: in_units(&right),
        exponent: EXPONENT,
        outcome,
    }
}

/// The numbers in units of 2^-EXPONENT, rounded.
fn in_units(list: &[Rational]) -> Vec<Integer> {
    let unit = Rational::from_integer(Integer::one() << EXPONENT);
    list.iter()
        .map(|number| (number * &unit).round().to_integer())
        .collect()
}

/// The inverse of the scaled block of order at most 2; zero where it is singular.
fn inverse(entries: &Entries, block: &[usize], t: &Rational) -> Vec<Vec<Rational>> {
    match *block {
        [] => Vec::new(),
        [i] => vec![vec![reciprocal(entries.scaled(i, i, t))]],
        [i, j] => {
            let a = entries.scaled(i, i, t);
            let b = entries.scaled(i, j, t);
            let c = entries.scaled(j, i, t);
            let d = entries.scaled(j, j, t);

            let factor = reciprocal(&a * &d - &b * &c);
            vec![
                vec![&d * &factor, -&b * &factor],
                vec![-&c * &factor, &a * &factor],
            ]
        }
        _ => unreachable!("order 3 less the pivot"),
    }
}

/// 1 / number, and zero for zero.
fn reciprocal(number: Rational) -> Rational {
    if number.is_zero() {
        number
    } else {
        number.recip()
    }
}

/// An interval about the value, or where it lies if a scale is forgotten: too far by the
/// denominator of an end. As a rule within the leaf's interval.
fn draw_interval(
    rng: &mut ChaCha8Rng,
    value: &Rational,
    region: &Region,
    needs_width: bool,
) -> [Rational; 2] {
    let denominator = Rational::from_integer(region.lo.denom().clone());
    let center = match rng.random_range(0..6) {
        0 => value * &denominator,
        1 => value / &denominator,
        2 => value * rational(rng.random_range(1..=5), rng.random_range(1..=5)),
        _ => value.clone(),
    };

    let first_width = usize::from(needs_width);
    let thousandths = [0, 1, 50, 300][rng.random_range(first_width..4)];
    let width = &center * rational(thousandths, 1000);
    let [mut a, mut b] = [&center - &width, &center + &width];

    let is_clamped = rng.random_range(0..5) != 0;
    if is_clamped {
        a = a.max(region.lo.clone());
        b = b.max(region.lo.clone());
        if let Some(hi) = &region.hi {
            a = a.min(hi.clone());
            b = b.min(hi.clone());
        }
    }
    [a, b]
}

fn draw_outcome(rng: &mut ChaCha8Rng, entries: &Entries, support: &[usize]) -> RootOutcome {
    let order = entries.a.len();
    match rng.random_range(0..8) {
        0..=2 => RootOutcome::Solution,
        3 | 4 => RootOutcome::Absent,
        5 => RootOutcome::NegativeX(rng.random_range(0..order)),
        6 => RootOutcome::NegativeY(rng.random_range(0..order)),
        _ => RootOutcome::Infinity(draw_vector(rng, order, support)),
    }
}

/// Small integers on the support.
fn draw_vector(rng: &mut ChaCha8Rng, order: usize, support: &[usize]) -> Vec<Integer> {
    let mut vector = vec![Integer::zero(); order];
    for &i in support {
        vector[i] = rng.random_range(-2..=2).into();
    }
    vector
}

/// Every support in a leaf of its own, in preorder: all open but the one with the given support and
/// region.
fn tree(order: usize, support: &[usize], region: &Region, leaf: Node) -> Vec<Node> {
    let mut writer = TreeWriter {
        order,
        support,
        region,
        leaf,
        moving: Vec::new(),
        tree: Vec::new(),
    };
    writer.branch(0);
    writer.tree
}

struct TreeWriter<'a> {
    order: usize,
    support: &'a [usize],
    region: &'a Region,
    leaf: Node,
    /// Variables that move where the writer is.
    moving: Vec<usize>,
    tree: Vec<Node>,
}

impl TreeWriter<'_> {
    fn branch(&mut self, variable: usize) {
        if variable == self.order {
            return self.write_leaf();
        }

        self.tree.push(Node::Branch(variable));
        self.branch(variable + 1);

        self.moving.push(variable);
        self.branch(variable + 1);
        self.moving.pop();
    }

    fn write_leaf(&mut self) {
        if self.moving != self.support {
            self.tree.push(Node::Open);
            return;
        }

        let leaf = self.leaf.clone();

        let Some(cut) = &self.region.cut else {
            self.tree.push(leaf);
            return;
        };
        let sides = if cut.is_leaf_above {
            [Node::Open, leaf]
        } else {
            [leaf, Node::Open]
        };
        self.tree.push(Node::Split(Number(cut.at.clone())));
        self.tree.extend(sides);
    }
}
