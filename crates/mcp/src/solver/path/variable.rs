//! Names of the unknowns of the linear subproblem, and the record of a pivot.
//!
//! Each index i has the unknowns z_i, w_i and v_i, of which one is basic (or i's artificial in
//! place of z_i); t is one more. A pivot names the unknown that was moving and the one that stopped
//! it.

/// An unknown of M z - w + v + D a + (1 - t) r + q = 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Variable {
    /// z_i; basic strictly between its bounds.
    Z(usize),
    /// w_i >= 0, complementary to z_i at its lower bound; free where the two bounds are equal.
    W(usize),
    /// v_i >= 0, complementary to z_i at its upper bound.
    V(usize),
    /// The artificial that stands for the column of z_i in a singular starting basis; held at 0.
    Artificial(usize),
    /// The path parameter t.
    T,
}

/// What happened at a pivot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PivotKind {
    /// `entering` took the place of `leaving`, which reached a bound.
    Exchange,
    /// `entering` took the place of an artificial, which never returns.
    ArtificialLeaves,
    /// `entering` is a doubly bounded z_i that crossed to its other bound; the basis is unchanged.
    Flip,
    /// t reached 1: the path is complete.
    Complete,
}

/// One pivot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pivot {
    /// Path parameter at the pivot, at most 1. A path may turn back, also below 0.
    pub t: f64,
    /// The unknown that was moving.
    pub entering: Variable,
    /// The unknown that stopped it: itself at a flip.
    pub leaving: Variable,
    /// What happened.
    pub kind: PivotKind,
}

impl Pivot {
    /// The same pivot with its unknowns named by `indices` of a larger problem, which holds for
    /// every index of the smaller one its own.
    pub fn renamed(&self, indices: &[usize]) -> Pivot {
        Pivot {
            entering: self.entering.renamed(indices),
            leaving: self.leaving.renamed(indices),
            ..*self
        }
    }
}

impl Variable {
    fn renamed(self, indices: &[usize]) -> Variable {
        match self {
            Variable::Z(i) => Variable::Z(indices[i]),
            Variable::W(i) => Variable::W(indices[i]),
            Variable::V(i) => Variable::V(indices[i]),
            Variable::Artificial(i) => Variable::Artificial(indices[i]),
            Variable::T => Variable::T,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_unknowns_of_a_pivot_are_renamed() {
        let pivot = Pivot {
            t: 0.5,
            entering: Variable::W(1),
            leaving: Variable::Z(0),
            kind: PivotKind::Exchange,
        };
        let expected = Pivot {
            entering: Variable::W(7),
            leaving: Variable::Z(4),
            ..pivot
        };

        assert_eq!(pivot.renamed(&[4, 7]), expected);

        let list =
            [Variable::V(0), Variable::Artificial(1), Variable::T].map(|v| v.renamed(&[4, 7]));
        assert_eq!(list, [Variable::V(4), Variable::Artificial(7), Variable::T]);
    }
}
