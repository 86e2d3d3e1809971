//! Eigenpairs of supports that are no solutions: what careless programs report.

use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sign, common_denominator, determinant, kernel_at, roots_in,
};
use mceip_model::Pencil;
use mceip_oracle::Solution;

/// What the eigenvector of a support looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// x > 0 on the support, y >= 0 elsewhere.
    Admissible,
    /// x > 0 on the support, y < 0 somewhere.
    NegativeY,
    /// x has both signs, or vanishes somewhere, on the support.
    MixedX,
}

/// Eigenpairs with one-dimensional kernels of all supports but the empty one, with values in [min,
/// max].
pub(super) fn eigenpairs(
    pencil: &Pencil,
    min: &Rational,
    max: Option<&Rational>,
) -> Vec<(Kind, Solution)> {
    let rows = integral(pencil);
    let slip = pencil.slip();

    let supports = (1..1u64 << slip.len()).map(|mask| {
        slip.iter()
            .enumerate()
            .filter(|(k, _)| mask >> k & 1 == 1)
            .map(|(_, &i)| i)
            .collect()
    });

    supports
        .flat_map(|support: Vec<usize>| of_support(pencil, &rows, &support, min, max))
        .collect()
}

/// Rows of A and B over a common positive factor, so that they are integers.
fn integral(pencil: &Pencil) -> Vec<(Vec<Integer>, Vec<Integer>)> {
    let row = |i: usize| {
        let (a, b) = (pencil.a().row(i), pencil.b().row(i));
        let clear = common_denominator(a.iter().chain(b).map(|e| &e.1));

        let dense = |list: &[(usize, Rational)]| {
            let mut out = vec![Integer::default(); pencil.order()];
            list.iter()
                .for_each(|(j, v)| out[*j] = v.numer() * (&clear / v.denom()));
            out
        };

        (dense(a), dense(b))
    };

    (0..pencil.order()).map(row).collect()
}

fn of_support(
    pencil: &Pencil,
    rows: &[(Vec<Integer>, Vec<Integer>)],
    support: &[usize],
    min: &Rational,
    max: Option<&Rational>,
) -> Vec<(Kind, Solution)> {
    let mut active: Vec<usize> = pencil.free().iter().chain(support).copied().collect();
    active.sort_unstable();

    let pick = |row: &[Integer]| active.iter().map(|&j| row[j].clone()).collect::<Vec<_>>();
    let a: Vec<Vec<Integer>> = active.iter().map(|&i| pick(&rows[i].0)).collect();
    let b: Vec<Vec<Integer>> = active.iter().map(|&i| pick(&rows[i].1)).collect();
    let det = determinant(&a, &b);

    if det.is_zero() {
        return Vec::new();
    }

    let entry = |i: usize, j: usize| Poly::new(vec![a[i][j].clone(), b[i][j].clone()]);
    let block = || {
        (0..active.len())
            .map(|i| (0..active.len()).map(|j| entry(i, j)).collect())
            .collect()
    };

    let roots = roots_in(&det, min, max).into_iter();
    roots
        .filter_map(|mut value| {
            pair(
                pencil,
                rows,
                support,
                &active,
                kernel_at(block(), &mut value),
                value,
            )
        })
        .collect()
}

fn pair(
    pencil: &Pencil,
    rows: &[(Vec<Integer>, Vec<Integer>)],
    support: &[usize],
    active: &[usize],
    kernel: Vec<Vec<Poly>>,
    mut value: Algebraic,
) -> Option<(Kind, Solution)> {
    let [vector] = &kernel[..] else { return None };
    let mut x = vec![Poly::default(); pencil.order()];

    active
        .iter()
        .zip(vector)
        .for_each(|(&i, p)| x[i] = p.clone());
    let first = support
        .iter()
        .map(|&i| value.sign_of(&x[i]))
        .find(|s| *s != Sign::Zero)?;

    if first == Sign::Negative {
        x.iter_mut().for_each(|p| *p = -&*p);
    }

    let positive = support
        .iter()
        .all(|&i| value.sign_of(&x[i]) == Sign::Positive);

    let y = |i: usize| {
        let (a, b) = &rows[i];
        x.iter().enumerate().fold(Poly::default(), |s, (j, p)| {
            &s + &(&Poly::new(vec![a[j].clone(), b[j].clone()]) * p)
        })
    };

    let off = (0..pencil.order()).filter(|i| !active.contains(i));
    let negative = off
        .into_iter()
        .any(|i| value.sign_of(&y(i)) == Sign::Negative);

    let kind = match (positive, negative) {
        (false, _) => Kind::MixedX,
        (true, true) => Kind::NegativeY,
        (true, false) => Kind::Admissible,
    };

    // e'x_s must not vanish: x is printed over it.
    let sum = support.iter().fold(Poly::default(), |s, &i| &s + &x[i]);
    (value.sign_of(&sum) != Sign::Zero).then(|| {
        (
            kind,
            Solution {
                value,
                multiplicity: 1,
                slip: support.to_vec(),
                biactive: Vec::new(),
                x,
                y: Vec::new(),
            },
        )
    })
}
