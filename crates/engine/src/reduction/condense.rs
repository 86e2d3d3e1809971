//! Exact condensation of MCEIP-mu to the slip particles: the f rows of K1 vanish (16), so x_f is
//! eliminated by K_ff independently of mu.

use mceip_exact::{CondenseError, schur_complement};
use mceip_model::{Admissible, ModelError, Pencil, Unknown};

/// Why a pencil is not condensed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CondensationError {
    /// Only MCEIP-mu has f rows that do not depend on the unknown.
    #[error("E16: expected unknown mu for condensation, got {got}")]
    Unknown {
        /// The unknown.
        got: &'static str,
    },
    /// The elimination failed.
    #[error(transparent)]
    Elimination(#[from] CondenseError),
    /// The condensed pencil is refused.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// The pencil A' + mu B' of order n_s with A' = A_ss - A_sf A_ff^-1 A_fs and
/// B' = B_ss - B_sf A_ff^-1 A_fs, exactly. Variables: the slip variables, ascending.
///
/// # Errors
/// [`CondensationError`]; for an admissible MCEIP-mu pencil of definite A_ff, none.
pub fn condense(admissible: &Admissible<'_>) -> Result<Pencil, CondensationError> {
    if admissible.unknown() != Unknown::Mu {
        return Err(CondensationError::Unknown {
            got: admissible.unknown().word(),
        });
    }
    let pencil = admissible.pencil();
    let (f, s) = (pencil.free(), pencil.slip());
    let n = s.len();
    // One elimination with the rows of A and of B below each other.
    let a_fs = pencil.a().submatrix(f, &s);
    let below = |cols: &[usize]| {
        stack(
            &pencil.a().submatrix(&s, cols),
            &pencil.b().submatrix(&s, cols),
        )
    };
    let both = schur_complement(&pencil.a().submatrix(f, f), &a_fs, &below(f), &below(&s))?;
    let all: Vec<usize> = (0..n).collect();
    let lower: Vec<usize> = (n..2 * n).collect();
    Ok(Pencil::new(
        both.submatrix(&all, &all),
        both.submatrix(&lower, &all),
        Vec::new(),
    )?)
}

fn stack(a: &mceip_exact::Sparse, b: &mceip_exact::Sparse) -> mceip_exact::Sparse {
    let top = a.entries().map(|(i, j, v)| (i, j, v.clone()));
    let bottom = b.entries().map(|(i, j, v)| (i + a.rows(), j, v.clone()));
    mceip_exact::Sparse::from_entries(a.rows() + b.rows(), a.cols(), top.chain(bottom))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;
    use mceip_model::Window;
    use mceip_oracle::enumerate;

    #[test]
    fn solutions_are_those_of_the_full_pencil() {
        let a = Sparse::from_ints(&[&[4, 1, 0, -1], &[1, 5, 2, 0], &[0, 2, 6, 1], &[-1, 0, 1, 3]]);
        let b = Sparse::from_ints(&[
            &[0, 0, 0, 0],
            &[-3, -2, 1, -4],
            &[0, 0, 0, 0],
            &[2, -5, 3, -1],
        ]);
        let full = Pencil::new(a, b, vec![0, 2]).unwrap();
        let small = condense(&Admissible::new(&full, Unknown::Mu).unwrap()).unwrap();
        let list = |p: &Pencil| enumerate(p, &Window::all()).unwrap().solutions;
        let (of_full, of_small) = (list(&full), list(&small));
        assert!(!of_full.is_empty());
        let back = [1, 3];
        for (x, y) in of_full.iter().zip(&of_small) {
            assert_eq!(x.decimal(30), y.decimal(30));
            assert_eq!(x.slip, y.slip.iter().map(|&i| back[i]).collect::<Vec<_>>());
        }
        assert_eq!(of_full.len(), of_small.len());
    }

    #[test]
    fn lambda2_is_refused_by_name() {
        let p = Pencil::new(Sparse::identity(2), Sparse::identity(2), vec![0]).unwrap();
        let admissible = Admissible::new(&p, Unknown::Lambda2).unwrap();
        assert!(matches!(
            condense(&admissible),
            Err(CondensationError::Unknown { got: "lambda2" })
        ));
    }

    /// Three slip variables, one free: x_0 = -(x_1 + 2 x_2 - x_3) / 4 put into the other rows by
    /// hand.
    #[test]
    fn each_row_of_a_and_of_b_gets_its_share() {
        let a = Sparse::from_ints(&[&[4, 1, 2, -1], &[1, 5, 0, 0], &[2, 0, 6, 0], &[-1, 0, 0, 7]]);
        let b = Sparse::from_ints(&[&[0, 0, 0, 0], &[4, 1, 0, 0], &[8, 0, 1, 0], &[-12, 0, 0, 1]]);
        let full = Pencil::new(a, b, vec![0]).unwrap();
        let small = condense(&Admissible::new(&full, Unknown::Mu).unwrap()).unwrap();
        let quarters = Sparse::from_ints(&[&[19, -2, 1], &[-2, 20, 2], &[1, 2, 27]]);
        let fourth = mceip_exact::rational(1, 4);
        assert_eq!(
            *small.a(),
            Sparse::from_entries(3, 3, []).add_scaled(&fourth, &quarters)
        );
        assert_eq!(
            *small.b(),
            Sparse::from_ints(&[&[0, -2, 1], &[-2, -3, 2], &[3, 6, -2]])
        );
    }
}
