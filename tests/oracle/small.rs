//! Small pencils and vectors of integers, for pencils that are worked by hand.

use mceip_exact::{Algebraic, Poly, Sparse, whole};
use mceip_model::Pencil;

pub(crate) fn pencil(a: &[&[i64]], b: &[&[i64]], free: &[usize]) -> Pencil {
    let a = Sparse::from_ints(a);
    let b = Sparse::from_ints(b);
    Pencil::new(a, b, free.to_vec()).unwrap()
}

pub(crate) fn sparse(rows: &[Vec<i64>]) -> Sparse {
    let rows: Vec<&[i64]> = rows.iter().map(Vec::as_slice).collect();
    Sparse::from_ints(&rows)
}

pub(crate) fn integer(value: i64) -> Algebraic {
    Algebraic::rational(whole(value))
}

pub(crate) fn constants(values: &[i64]) -> Vec<Poly> {
    values.iter().map(|c| Poly::from_ints(&[*c])).collect()
}
