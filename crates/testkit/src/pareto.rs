//! Pareto eigenvalue problems inside admissible mechanical systems, and solutions planted in
//! pencils.

use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{
    Body, ContactState, ModelError, Particle, Pencil, Problem, System, Unknown, Window,
};
use num_traits::{One, Signed, Zero};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A matrix P with a known number of Pareto eigenvalues: 0 <= x _|_ (P - lambda I) x >= 0, x != 0.
#[derive(Debug, Clone)]
pub struct Pareto {
    /// P.
    pub matrix: Sparse,
    /// Pareto eigenvalues there are (all simple, each with one eigenvector).
    pub count: usize,
}

/// Matrices with many Pareto eigenvalues for their order: 3, 9, 23 and 57 for orders 2 to 5.
///
/// Orders 3 to 5 are due to A. Pinto da Costa and A. Seeger ("Cone-constrained eigenvalue problems:
/// theory and algorithms", Comput. Optim. Appl. 45 (2010) 25-57), here with the sign that makes
/// (P - lambda I) x >= 0: the literature has both. The counts are what identifies them, and they
/// are recomputed in `tests/oracle/known_answers.rs`. Order 2 is any with p_12, p_21 >= 0 and
/// different diagonal entries.
pub fn pareto_matrices() -> Vec<Pareto> {
    let half = |sign: i64| rational(sign, 2);
    let three = [
        [whole(8), whole(-1), whole(4)],
        [whole(3), whole(4), half(1)],
        [whole(2), half(-1), whole(6)],
    ];

    let three = Sparse::from_entries(
        3,
        3,
        (0..9).map(|k| (k / 3, k % 3, three[k / 3][k % 3].clone())),
    );

    let four: &[&[i64]] = &[
        &[100, 106, -18, -81],
        &[92, 158, -24, -101],
        &[2, 44, 37, -7],
        &[21, 38, 0, 2],
    ];

    let five: &[&[i64]] = &[
        &[-788, 780, 256, -156, -191],
        &[548, -862, 190, -112, -143],
        &[456, 548, -1308, -110, -119],
        &[292, 374, 14, -1402, -28],
        &[304, 402, 66, -38, -1522],
    ];

    let two: &[&[i64]] = &[&[3, 1], &[2, 5]];
    [
        (Sparse::from_ints(two), 3),
        (three, 9),
        (Sparse::from_ints(four), 23),
        (Sparse::from_ints(five), 57),
    ]
    .map(|(matrix, count)| Pareto { matrix, count })
    .to_vec()
}

impl Pareto {
    /// As a raw pencil in t = lambda + shift: (P + shift I) x - t x = y. With a shift above every
    /// |lambda| all of them lie in the window [0, infinity).
    ///
    /// # Errors
    /// [`ModelError`] for an empty matrix.
    pub fn pencil(&self) -> Result<Problem, ModelError> {
        let n = self.matrix.rows();
        let a = self.matrix.add_scaled(&self.bound(), &Sparse::identity(n));
        let minus = Sparse::zeros(n, n).add_scaled(&whole(-1), &Sparse::identity(n));

        Problem::new(
            Body::Pencil(Pencil::new(a, minus, vec![])?),
            Unknown::Lambda2,
            Window::all(),
        )
    }

    /// A number above the absolute value of every eigenvalue of every principal block: 1 + the
    /// largest sum of absolute values in a row.
    pub fn bound(&self) -> Rational {
        let sum = |i: usize| {
            self.matrix
                .row(i)
                .iter()
                .map(|e| e.1.abs())
                .sum::<Rational>()
        };

        (0..self.matrix.rows()).map(sum).max().unwrap_or_default() + Rational::one()
    }

    /// As a mechanical system of n particles in impending slip (S = 1): K_TT = aI, K_NT = P - cI,
    /// K_NN = bI with c above every Pareto eigenvalue and b so large that K is positive definite.
    /// Each Pareto eigenvalue lambda is the solution mu = a / (c - lambda), with the same x.
    ///
    /// # Errors
    /// [`ModelError`] for a or c that break this.
    pub fn system(&self, a: &Rational, c: &Rational) -> Result<Problem, ModelError> {
        let n = self.matrix.rows();
        let coupling = self.matrix.add_scaled(&-c, &Sparse::identity(n));

        // a b > |K_NT|_F^2 makes the Schur complement bI - K_NT K_NT' / a definite.
        let frobenius: Rational = coupling.entries().map(|(_, _, v)| v * v).sum();
        let b = frobenius / a + Rational::one();
        let diagonal =
            (0..n).flat_map(|i| [(2 * i, 2 * i, a.clone()), (2 * i + 1, 2 * i + 1, b.clone())]);
        let crossed = coupling
            .entries()
            .flat_map(|(i, j, v)| [(2 * i + 1, 2 * j, v.clone()), (2 * j, 2 * i + 1, v.clone())]);
        let k = Sparse::from_entries(2 * n, 2 * n, diagonal.chain(crossed));
        let particles = (0..n)
            .map(|i| Particle::plain(2 * i, 2 * i + 1, ContactState::Slip { sign: 1 }))
            .collect();

        Problem::new(
            Body::System(System::new(k, None, None, particles)?),
            Unknown::Mu,
            Window::all(),
        )
    }
}

/// A random admissible pencil with a rational solution planted in it.
#[derive(Debug, Clone)]
pub struct Planted {
    /// The problem.
    pub problem: Problem,
    /// The planted value.
    pub value: Rational,
    /// The planted vector, over all variables.
    pub x: Vec<Rational>,
}

/// Plants t and x in a pencil of order `n` with `free` free variables and admissible for lambda^2:
/// the column of one slipping variable of A is bent until (A + tB) x = y >= 0.
///
/// # Errors
/// [`ModelError::Empty`] without complementarity variables.
pub fn planted(n: usize, free: usize, seed: u64) -> Result<Planted, ModelError> {
    if free >= n {
        return Err(ModelError::Empty {
            what: "the complementarity variables",
        });
    }

    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut small = |lo: i64, hi: i64| rng.random_range(lo..=hi);
    let value = rational(small(0, 30), small(1, 7));
    let slips = small(1, (n - free) as i64) as usize; // the first `slips` after the free ones

    let x: Vec<Rational> = (0..n)
        .map(|i| match i {
            i if i < free => rational(small(-9, 9), small(1, 4)),
            i if i < free + slips => rational(small(1, 9), small(1, 4)),
            _ => Rational::zero(),
        })
        .collect();

    let y: Vec<Rational> = (0..n)
        .map(|i| {
            if i < free + slips {
                Rational::zero()
            } else {
                whole(small(0, 5))
            }
        })
        .collect();

    let b = definite_block(n, free, &mut small);
    let mut a = definite_block(n, free, &mut small);
    let image = a.add_scaled(&value, &b).times(&x);
    let bend = |i: usize| (&y[i] - &image[i]) / &x[free];
    let column = Sparse::from_entries(n, n, (0..n).map(|i| (i, free, bend(i))));
    a = a.add_scaled(&Rational::one(), &column);

    let pencil = Pencil::new(a, b, (0..free).collect())?;
    Ok(Planted {
        problem: Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all())?,
        value,
        x,
    })
}

/// Small random integers, the leading block symmetric with a dominant diagonal.
fn definite_block(n: usize, free: usize, small: &mut impl FnMut(i64, i64) -> i64) -> Sparse {
    let mut m: Vec<Vec<i64>> = (0..n)
        .map(|_| (0..n).map(|_| small(-4, 4)).collect())
        .collect();

    for i in 0..free {
        for j in 0..i {
            m[i][j] = m[j][i];
        }

        m[i][i] = 4 * n as i64 + 1;
    }

    Sparse::from_entries(
        n,
        n,
        (0..n * n).map(|k| (k / n, k % n, whole(m[k / n][k % n]))),
    )
}
