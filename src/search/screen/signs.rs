//! Rows of A + tB whose entries have one sign for every t >= 0: the cheapest refutation.

use super::integral::Integral;
use num_traits::Signed;

/// Sets of slip variables (bit k: the k-th) by the sign of one row's entries for all t >= 0.
#[derive(Debug, Clone, Copy, Default)]
struct Row {
    /// >= 0.
    not_negative: u64,
    /// > 0.
    positive: u64,
    /// <= 0.
    not_positive: u64,
    /// < 0.
    negative: u64,
}

/// The rows in which no free variable occurs.
#[derive(Debug)]
pub(super) struct Signs {
    /// Rows that are zero whatever the support: the free ones.
    free: Vec<Row>,
    /// By slip variable; all sets empty where a free variable occurs.
    slip: Vec<Row>,
}

impl Signs {
    pub(super) fn of(pencil: &Integral) -> Signs {
        let row = |i: usize| {
            let (a, b) = (&pencil.a[i], &pencil.b[i]);
            let mut row = Row::default();
            if (0..pencil.free).any(|j| a[j].is_positive() || a[j].is_negative() || b[j].is_positive() || b[j].is_negative()) {
                return row;
            }
            for k in 0..pencil.slip {
                let (a, b, bit) = (&a[pencil.free + k], &b[pencil.free + k], 1 << k);
                row.not_negative |= if a.is_negative() || b.is_negative() { 0 } else { bit };
                row.positive |= if a.is_positive() && !b.is_negative() { bit } else { 0 };
                row.not_positive |= if a.is_positive() || b.is_positive() { 0 } else { bit };
                row.negative |= if a.is_negative() && !b.is_positive() { bit } else { 0 };
            }
            row
        };
        Signs { free: (0..pencil.free).map(row).collect(), slip: (pencil.free..pencil.free + pencil.slip).map(row).collect() }
    }

    /// Is it proved that no x with x > 0 on the support solves a row of (24), or that some y_i < 0?
    pub(super) fn refute(&self, support: u64) -> bool {
        let up = |r: &Row| support & !r.not_negative == 0 && support & r.positive != 0;
        let down = |r: &Row| support & !r.not_positive == 0 && support & r.negative != 0;
        let slip = |(k, r): (usize, &Row)| down(r) || (support >> k & 1 == 1 && up(r));
        self.free.iter().any(|r| up(r) || down(r)) || self.slip.iter().enumerate().any(slip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Sparse;
    use crate::model::Pencil;

    #[test]
    fn one_sign_refutes_and_a_zero_entry_alone_does_not() {
        let signs = |a: &[&[i64]], b: &[&[i64]], free: &[usize]| {
            let p = Pencil::new(Sparse::from_ints(a), Sparse::from_ints(b), free.to_vec()).unwrap();
            let s = Signs::of(&Integral::of(&p));
            (1..1 << p.slip().len()).filter(|&m| s.refute(m)).collect::<Vec<u64>>()
        };
        // Row 0 positive on {0}, {0, 1}; off the support it proves nothing.
        assert_eq!(signs(&[&[1, 2], &[0, 0]], &[&[0, 1], &[0, 0]], &[]), vec![1, 3]);
        // Row 1 negative on {0}: y_1 < 0. On {1} it is zero at t = 0.
        assert_eq!(signs(&[&[0, 0], &[-1, 0]], &[&[0, 0], &[0, -1]], &[]), vec![1, 3]);
        assert!(signs(&[&[0, 0], &[0, 0]], &[&[1, 0], &[0, -1]], &[]).is_empty());
        // A free variable in the row: no sign is known.
        assert!(signs(&[&[0, 1], &[1, 1]], &[&[0, 0], &[0, 0]], &[0]) == vec![1]);
        assert!(signs(&[&[1, 1], &[1, 1]], &[&[0, 0], &[0, 0]], &[0]).is_empty());
    }
}
