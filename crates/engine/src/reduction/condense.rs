//! Exact condensation of MCEIP-mu to the slip particles.
//!
//! The f rows of K1 vanish (16), so the rows f of A + mu B are those of A for every mu, and x_f =
//! -A_ff^-1 A_fs x_s does not depend on mu. What remains is a pencil of order n_s without free
//! variables:
//!
//!   A' = A_ss - A_sf A_ff^-1 A_fs,   B' = B_ss - B_sf A_ff^-1 A_fs.
//!
//! Input: an admissible pencil of MCEIP-mu. Output: the condensed pencil over Q. Called by the
//! search for solutions (`multistart`) and by `mceip reduce`.

use super::CondensationError;
use mceip_exact::{Sparse, schur_complement};
use mceip_model::{Admissible, Pencil, Unknown};

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
    let free = pencil.free();
    let slip = pencil.slip();
    let count = slip.len();

    // One elimination for both, with the rows of B below those of A.
    let a_ff = pencil.a().submatrix(free, free);
    let a_fs = pencil.a().submatrix(free, &slip);
    let kept_times_free = a_above_b(pencil, &slip, free);
    let kept_times_slip = a_above_b(pencil, &slip, &slip);
    let both = schur_complement(&a_ff, &a_fs, &kept_times_free, &kept_times_slip)?;

    let upper: Vec<usize> = (0..count).collect();
    let lower: Vec<usize> = (count..2 * count).collect();

    Ok(Pencil::new(
        both.submatrix(&upper, &upper),
        both.submatrix(&lower, &upper),
        Vec::new(),
    )?)
}

/// The given rows and columns of A, and below them those of B.
fn a_above_b(pencil: &Pencil, rows: &[usize], columns: &[usize]) -> Sparse {
    let a = pencil.a().submatrix(rows, columns);
    let b = pencil.b().submatrix(rows, columns);

    let mut entries = Vec::new();
    for (i, j, v) in a.entries() {
        entries.push((i, j, v.clone()));
    }
    for (i, j, v) in b.entries() {
        entries.push((i + a.rows(), j, v.clone()));
    }
    Sparse::from_entries(a.rows() + b.rows(), columns.len(), entries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;
    use mceip_model::Window;
    use mceip_oracle::{Solution, enumerate};

    fn all_solutions(pencil: &Pencil) -> Vec<Solution> {
        enumerate(pencil, &Window::all()).unwrap().solutions
    }

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

        let of_full = all_solutions(&full);
        let of_small = all_solutions(&small);

        assert!(!of_full.is_empty());
        assert_eq!(of_full.len(), of_small.len());
        let slip_variables = [1, 3];
        for (solution, condensed) in of_full.iter().zip(&of_small) {
            assert_eq!(solution.decimal(30), condensed.decimal(30));
            let support: Vec<usize> = condensed.slip.iter().map(|&i| slip_variables[i]).collect();
            assert_eq!(solution.slip, support);
        }
    }

    #[test]
    fn lambda2_is_refused_by_name() {
        let pencil = Pencil::new(Sparse::identity(2), Sparse::identity(2), vec![0]).unwrap();
        let admissible = Admissible::new(&pencil, Unknown::Lambda2).unwrap();

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

        let four_times_a = Sparse::from_ints(&[&[19, -2, 1], &[-2, 20, 2], &[1, 2, 27]]);
        let expected_a = Sparse::zeros(3, 3).add_scaled(&rational(1, 4), &four_times_a);
        let expected_b = Sparse::from_ints(&[&[0, -2, 1], &[-2, -3, 2], &[3, 6, -2]]);
        assert_eq!(*small.a(), expected_a);
        assert_eq!(*small.b(), expected_b);
    }
}
