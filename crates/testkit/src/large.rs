//! Problems beyond 2^n: random mechanical pencils, refined blocks, condensed in doubles.
//!
//! No enumerator can answer them; they are for measurements of solver and complete search, and for
//! tests of large orders. Input: orders and seeds. Output: problems whose data, drawn in doubles,
//! are taken as exact numbers.

use crate::error::TestkitError;
use crate::generators::matrix;
use mceip_engine::run::{Cancel, Watch};
use mceip_engine::search::complete::{CompleteOptions, complete};
use mceip_exact::{Integer, Rational, Sparse, from_f64, to_f64};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ModelError, Pencil, Problem, Unknown, Window};
use mceip_paper::{Block, BlockModel};
use num_traits::One;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A random pencil without free variables: M and K0 = GG'/n + I/2, K1 = H / sqrt n with G and H
/// standard normal, mu = 3 where lambda^2 is unknown. Drawn in doubles, which are then the exact
/// data.
///
/// # Errors
/// [`ModelError`]; for n = 0 only.
pub fn mechanical_pencil(n: usize, unknown: Unknown, seed: u64) -> Result<Problem, ModelError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed.wrapping_mul(1_000_003).wrapping_add(n as u64));
    let mass = definite(&mut rng, n);
    let k0 = definite(&mut rng, n);
    let k1 = square(n, |_, _| normal(&mut rng) / (n as f64).sqrt());

    let pencil = match unknown {
        Unknown::Mu => Pencil::new(exact(&k0), exact(&k1), Vec::new())?,
        Unknown::Lambda2 | Unknown::Eigenvalue => {
            let stiffness = square(n, |i, j| k0[i][j] + 3.0 * k1[i][j]);
            Pencil::new(exact(&stiffness), exact(&mass), Vec::new())?
        }
    };

    let word = unknown.word();
    let problem = Problem::new(Body::Pencil(pencil), unknown, Window::all())?;
    Ok(problem.named(format!("random mechanical pencil n={n} {word} seed {seed}")))
}

/// The paper's block refined until `slip` nodes touch the cone, MCEIP-mu; with a tenth of the
/// contact nodes stuck where asked ([`Block::sliding_states_with_tenth_stuck`]).
///
/// # Errors
/// [`TestkitError`].
pub fn refined_block(slip: usize, tenth_stuck: bool) -> Result<Problem, TestkitError> {
    let block = Block::new(&BlockModel::refined(slip))?;
    let states = if tenth_stuck {
        block.sliding_states_with_tenth_stuck(slip)?
    } else {
        block.sliding_states(0, slip)?
    };

    let system = block.system(&states, None)?;
    let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all())?;
    Ok(problem.named(format!("refined block, {slip} slip")))
}

/// The plane-strain block of `\` cells with 17 slip nodes, MCEIP-mu: 1719 solutions.
///
/// # Errors
/// [`TestkitError`]; none for the block as given.
pub fn backslash_block() -> Result<Problem, TestkitError> {
    let block = Block::new(&BlockModel::backslash_strain())?;
    let states = block.sliding_states(0, 17)?;
    let system = block.system(&states, None)?;
    let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all())?;
    Ok(problem.named("backslash block, plane strain, 17 slip"))
}

/// An MCEIP-mu problem with its free variables eliminated in doubles, the result taken as exact
/// data: another problem, close to the given one, for measuring the search alone. (Its certificate
/// proves nothing about the given problem; the route from the mesh does.)
///
/// # Errors
/// [`TestkitError`]; also where the unknown multiplies free rows or columns, as in MCEIP-lambda2.
pub fn condensed_in_doubles(problem: &Problem) -> Result<Problem, TestkitError> {
    let pencil = reduce(problem)?.without_zero()?.pencil;
    let Some(elimination) = elimination_in_doubles(problem)? else {
        return Ok(problem.clone());
    };

    let a = condensed(pencil.a(), &pencil, &elimination);
    let b = condensed(pencil.b(), &pencil, &elimination);
    let small = Pencil::new(a, b, Vec::new())?;
    let window = problem.window().clone();
    Ok(Problem::new(
        Body::Pencil(small),
        problem.unknown(),
        window,
    )?)
}

/// T_ff^-1 T_fs in doubles, rows over the free variables; `None` without free variables.
///
/// A complete search that is stopped at once leaves the condensation, and this matrix in it.
fn elimination_in_doubles(problem: &Problem) -> Result<Option<Vec<Vec<f64>>>, TestkitError> {
    let options = CompleteOptions {
        threads: Some(1),
        ..CompleteOptions::default()
    };
    let stopped = complete(problem, &options, &Watch::silent(&Cancel::requested()))?;
    let set = stopped.proved.into_certificate().complete_set;
    let Some(condensation) = set.and_then(|s| s.condensation) else {
        return Ok(None);
    };

    let first_anchor = condensation.anchors.first();
    let Some(elimination) = first_anchor.and_then(|anchor| anchor.right.first()) else {
        return Ok(None);
    };

    // The matrix is held as integers times 2^-exponent.
    let unit = Rational::new(One::one(), Integer::one() << elimination.exponent);
    let mut rows = Vec::new();
    for row in elimination.rows.iter() {
        let mut doubles = Vec::new();
        for v in row.iter() {
            doubles.push(to_f64(&(Rational::from_integer(v.into_owned()) * &unit)));
        }
        rows.push(doubles);
    }
    Ok(Some(rows))
}

/// M_ss - M_sf W in doubles, with W the elimination of the free variables.
fn condensed(matrix: &Sparse, pencil: &Pencil, elimination: &[Vec<f64>]) -> Sparse {
    let slip = pencil.slip();
    let m_ss = matrix.submatrix(&slip, &slip);
    let m_sf = matrix.submatrix(&slip, pencil.free());
    let mut out = square(slip.len(), |i, j| to_f64(&m_ss.get(i, j)));

    for (i, k, v) in m_sf.entries() {
        let v = to_f64(v);
        for (entry, w) in out[i].iter_mut().zip(&elimination[k]) {
            *entry -= v * w;
        }
    }

    exact(&out)
}

/// A matrix of order n by its rows; its entries are formed row by row.
fn square(n: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..n {
            rows[i][j] = entry(i, j);
        }
    }
    rows
}

/// Every finite double is a rational number; those that are not finite (none here) would be zero.
fn exact(m: &[Vec<f64>]) -> Sparse {
    matrix(m.len(), |i, j| from_f64(m[i][j]).unwrap_or_default())
}

/// GG'/n + I/2, G standard normal.
fn definite(rng: &mut ChaCha8Rng, n: usize) -> Vec<Vec<f64>> {
    let g = square(n, |_, _| normal(rng));
    square(n, |i, j| {
        let dot: f64 = g[i].iter().zip(&g[j]).map(|(a, b)| a * b).sum();
        let diagonal = if i == j { 0.5 } else { 0.0 };
        dot / n as f64 + diagonal
    })
}

/// Standard normal (Box and Muller 1958).
fn normal(rng: &mut ChaCha8Rng) -> f64 {
    let u = 1.0 - rng.random::<f64>();
    let v: f64 = rng.random();
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_check::check;
    use mceip_model::Admissible;

    #[test]
    fn a_seed_gives_one_admissible_pencil() {
        for unknown in [Unknown::Mu, Unknown::Lambda2] {
            let [one, same, other] =
                [1, 1, 2].map(|seed| mechanical_pencil(7, unknown, seed).unwrap());
            assert_eq!(one.sha256(), same.sha256());
            assert_ne!(one.sha256(), other.sha256());

            let Body::Pencil(pencil) = one.body() else {
                unreachable!()
            };

            assert!(Admissible::new(pencil, unknown).is_ok());
            assert_eq!(pencil.slip().len(), 7);
        }
    }

    #[test]
    fn condensing_in_doubles_keeps_the_value() {
        let states = mceip_paper::PublishedState::SeventeenSlip;
        let problem = states
            .problem(&Block::of_the_paper(mceip_paper::MassKind::Consistent))
            .unwrap();
        let small = condensed_in_doubles(&problem).unwrap();
        let found = complete(&small, &CompleteOptions::default(), &Watch::nobody()).unwrap();

        assert_eq!(found.cover.solutions.len(), 1);
        assert!((to_f64(&found.cover.solutions[0].value.mid()) - 1.71).abs() < 0.01);

        // The near problem's certificate is none for the given one.
        assert!(check(&problem, found.proved.certificate()).is_err());
    }
}
