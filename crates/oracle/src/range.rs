//! Supports whose pencil is singular: for which values a solution with that support exists.
//!
//! Let V(t) span the kernel of the pencil on f and J over Q(t), and let G(t) hold the rows of V
//! that must be positive (x_J) and those of y = (A + tB) V that must be nonnegative. A solution
//! with support J exists at t exactly if some z has (G z)_J > 0 and G z >= 0 (and V z != 0). Which
//! sign vectors G z takes depends only on the signs of the maximal minors of r independent columns
//! of G, r its rank (the covectors of an oriented matroid are determined by its chirotope;
//! Bjoerner, Las Vergnas, Sturmfels, White and Ziegler 1993, chapter 3). So between the roots of
//! these minors, and of the minors that say V is a basis and r the rank, nothing changes: one
//! rational sample decides each open cell, and each root is decided exactly by its own cone.

use super::cone::cone_at;
use super::degenerate::{End, Piece, SupportRange, Undescribed};
use super::enumeration::{Enumeration, WideKernel};
use super::integral::Integral;
use mceip_exact::{Algebraic, Poly, Rational, generic_kernel, minors, nonnegative_roots};
use mceip_model::Window;
use num_traits::{One, Signed};
use std::cmp::Ordering;

/// Most minors formed for one support: beyond it the support is named as undescribed.
pub const MAX_MINORS: usize = 4096;

/// Describes one singular support: its range of values, and what exists at isolated values only.
pub(super) fn describe(
    pencil: &Integral<'_>,
    support: &[usize],
    window: &Window,
    found: &mut Enumeration,
) {
    let active = pencil.active(support);
    let (kernel, _, pivot) = generic_kernel(pencil.block(&active));
    let kernel: Vec<Vec<Poly>> = kernel.iter().map(|v| pencil.extend(&active, v)).collect();
    let critical = match critical(pencil, support, &active, &kernel, pivot) {
        Ok(poly) => poly,
        Err(undescribed) => {
            found.undescribed.push(undescribed);
            return;
        }
    };
    let exists = |t: &Algebraic| {
        let cone = cone_at(pencil, support, t);
        cone.slip == support && cone.dimension > 0
    };
    let below_zero = exists(&Algebraic::rational(sample_below_zero(&critical)));
    let (pieces, points) = pieces(nonnegative_roots(&critical), below_zero, exists);
    for value in points
        .into_iter()
        .filter(|v| within(&mut v.clone(), window))
    {
        let dimension = cone_at(pencil, support, &value).kernel_dimension;
        let kernel = WideKernel {
            value,
            support: support.to_vec(),
            dimension,
        };
        super::cone::describe(pencil, &kernel, found);
        if dimension > 1 {
            found.wide.push(kernel);
        }
    }
    let pieces: Vec<Piece> = pieces.into_iter().filter_map(|p| clip(p, window)).collect();
    if !pieces.is_empty() {
        found.ranges.push(SupportRange {
            support: support.to_vec(),
            pieces,
            kernel,
        });
    }
}

/// A polynomial that vanishes at 0 and wherever the existence of solutions may change.
fn critical(
    pencil: &Integral<'_>,
    support: &[usize],
    active: &[usize],
    kernel: &[Vec<Poly>],
    pivot: Poly,
) -> Result<Poly, Undescribed> {
    let images: Vec<Vec<Poly>> = kernel.iter().map(|x| pencil.times(x)).collect();
    let x_rows = support
        .iter()
        .map(|&i| kernel.iter().map(|x| x[i].clone()).collect::<Vec<_>>());
    let off = (0..pencil.order()).filter(|i| !active.contains(i));
    let y_rows = off.map(|i| images.iter().map(|y| y[i].clone()).collect());
    let rows: Vec<Vec<Poly>> = x_rows
        .chain(y_rows)
        .filter(|row: &Vec<Poly>| row.iter().any(|p| !p.is_zero()))
        .collect();
    let (_, columns, rank_minor) = generic_kernel(rows.clone());
    let count = (0..columns.len()).fold(1usize, |c, k| c.saturating_mul(rows.len() - k) / (k + 1));
    if count > MAX_MINORS {
        return Err(Undescribed {
            support: support.to_vec(),
            minors: count,
            limit: MAX_MINORS,
        });
    }
    let all = [Poly::from_ints(&[0, 1]), pivot, rank_minor]
        .into_iter()
        .chain(minors(&rows, &columns));
    // The least common multiple of the squarefree parts.
    Ok(all
        .map(|p| p.squarefree())
        .fold(Poly::from_ints(&[1]), |product, p| {
            let shared = product.gcd(&p);
            &product * &p.exact_div(&shared).unwrap_or(p) // exact: the gcd divides
        }))
}

/// The maximal intervals of values at which something exists, cut to [0, infinity), and the values
/// isolated on the real line (so that no window decides what is isolated). `critical` begins with
/// 0; between neighbours nothing changes; `below_zero`: does something exist just below 0?
fn pieces(
    mut critical: Vec<Algebraic>,
    below_zero: bool,
    exists: impl Fn(&Algebraic) -> bool,
) -> (Vec<Piece>, Vec<Algebraic>) {
    let (mut pieces, mut points) = (Vec::new(), Vec::new());
    // Where the interval under way began.
    let mut open: Option<End> = critical
        .first()
        .filter(|zero| below_zero && exists(zero))
        .map(|zero| End {
            value: zero.clone(),
            included: true,
        });
    for k in 0..critical.len() {
        let here = critical[k].clone();
        let at = exists(&here);
        let cell = exists(&Algebraic::rational(sample(&mut critical, k)));
        match (open.take(), at) {
            (Some(from), true) if cell => open = Some(from),
            (Some(from), _) => {
                pieces.push(Piece {
                    from,
                    to: Some(End {
                        value: here.clone(),
                        included: at,
                    }),
                });
                open = cell.then_some(End {
                    value: here,
                    included: false,
                });
            }
            (None, _) if cell => {
                open = Some(End {
                    value: here,
                    included: at,
                })
            }
            (None, true) => points.push(here),
            (None, false) => {}
        }
    }
    pieces.extend(open.map(|from| Piece { from, to: None }));
    (pieces, points)
}

/// A rational number strictly between the k-th critical value and the next (or infinity).
fn sample(critical: &mut [Algebraic], k: usize) -> Rational {
    if k + 1 == critical.len() {
        return critical[k].interval().hi() + Rational::one();
    }
    // Ends: the two numbers differ.
    while critical[k].interval().hi() >= critical[k + 1].interval().lo() {
        critical[k].refine();
        critical[k + 1].refine();
    }
    (critical[k].interval().hi() + critical[k + 1].interval().lo())
        / Rational::from_integer(2.into())
}

/// A negative rational above all negative roots of a polynomial that vanishes at 0.
fn sample_below_zero(critical: &Poly) -> Rational {
    let mirrored = critical
        .coeffs()
        .iter()
        .enumerate()
        .map(|(k, c)| if k % 2 == 1 { -c } else { c.clone() })
        .collect();
    let Some(mut nearest) = nonnegative_roots(&Poly::new(mirrored)).into_iter().nth(1) else {
        return -Rational::one();
    };
    // Ends: the number is not 0, which is the root before it.
    while !nearest.interval().lo().is_positive() {
        nearest.refine();
    }
    -nearest.interval().lo() / Rational::from_integer(2.into())
}

fn within(value: &mut Algebraic, window: &Window) -> bool {
    value.cmp_rational(window.min()) != Ordering::Less
        && window
            .max()
            .is_none_or(|m| value.cmp_rational(m) != Ordering::Greater)
}

/// The part of a piece in the closed window; a single number may remain.
fn clip(piece: Piece, window: &Window) -> Option<Piece> {
    let closed = |v: &Rational| End {
        value: Algebraic::rational(v.clone()),
        included: true,
    };
    let mut piece = piece;
    if piece.from.value.cmp_rational(window.min()) == Ordering::Less {
        piece.from = closed(window.min());
    }
    if let Some(max) = window.max()
        && piece
            .to
            .as_mut()
            .is_none_or(|to| to.value.cmp_rational(max) == Ordering::Greater)
    {
        piece.to = Some(closed(max));
    }
    let Some(to) = &mut piece.to else {
        return Some(piece);
    };
    match piece.from.value.cmp_exact(&mut to.value) {
        Ordering::Less => Some(piece),
        Ordering::Equal if piece.from.included && to.included => Some(piece),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{rational, whole};

    /// Between zero and the negative root nearest to it, wherever the positive ones are.
    #[test]
    fn the_sample_below_zero_is_above_all_negative_roots() {
        let linear = |root: (i64, i64)| Poly::from_ints(&[-root.0, root.1]);
        let t = Poly::from_ints(&[0, 1]);
        for (near, others) in [
            ((-1, 10), vec![(5, 1)]),
            ((-4, 1), vec![(1, 100), (-9, 1)]),
            ((-3, 1), vec![(-7, 2), (1, 3), (8, 1)]),
        ] {
            let poly = others
                .iter()
                .fold(&t * &linear(near), |p, r| &p * &linear(*r));
            let sample = sample_below_zero(&poly);
            assert!(
                sample > rational(near.0, near.1) && sample < whole(0),
                "{near:?}: {sample}"
            );
        }
        // Irrational: t (t^2 + 3 t + 1) has -0.381966.
        let sample = sample_below_zero(&(&t * &Poly::from_ints(&[1, 3, 1])));
        assert!(sample > rational(-38, 100) && sample < whole(0), "{sample}");
        assert_eq!(sample_below_zero(&(&t * &linear((2, 1)))), whole(-1));
    }
}
