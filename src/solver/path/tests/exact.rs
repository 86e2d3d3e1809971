//! Rationals with infinities, so that the very code of the path can be run without rounding.

use super::super::number::Number;
use nalgebra::{DMatrix, DVector};
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A rational, or a bound that is none. Arithmetic on infinities is not defined beyond inf - finite.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Exact {
    Finite(BigRational),
    PlusInfinity,
    MinusInfinity,
}

use Exact::{Finite, MinusInfinity, PlusInfinity};

impl Exact {
    pub(super) fn integer(value: i64) -> Exact {
        Finite(BigRational::from_integer(value.into()))
    }

    fn rational(&self) -> &BigRational {
        match self {
            Finite(value) => value,
            infinite => panic!("arithmetic on {infinite:?}: the path must ask is_finite first"),
        }
    }
}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Exact) -> Option<Ordering> {
        Some(match (self, other) {
            (Finite(a), Finite(b)) => a.cmp(b),
            (a, b) if a == b => Ordering::Equal,
            (MinusInfinity, _) | (_, PlusInfinity) => Ordering::Less,
            _ => Ordering::Greater,
        })
    }
}

/// inf - finite and inf + finite are needed for the room of a moving unknown; all else is finite.
impl Add for Exact {
    type Output = Exact;
    fn add(self, other: Exact) -> Exact {
        match (&self, &other) {
            (Finite(a), Finite(b)) => Finite(a + b),
            (Finite(_), infinite) | (infinite, Finite(_)) => (*infinite).clone(),
            _ => panic!("{self:?} + {other:?}"),
        }
    }
}

impl Neg for Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        match self {
            Finite(a) => Finite(-a),
            PlusInfinity => MinusInfinity,
            MinusInfinity => PlusInfinity,
        }
    }
}

impl Sub for Exact {
    type Output = Exact;
    fn sub(self, other: Exact) -> Exact {
        self + -other
    }
}

impl Mul for Exact {
    type Output = Exact;
    fn mul(self, other: Exact) -> Exact {
        Finite(self.rational() * other.rational())
    }
}

impl Div for Exact {
    type Output = Exact;
    fn div(self, other: Exact) -> Exact {
        Finite(self.rational() / other.rational())
    }
}

macro_rules! assigned {
    ($($name:ident $method:ident $op:tt),*) => {$(
        impl $name for Exact {
            fn $method(&mut self, other: Exact) {
                *self = self.clone() $op other;
            }
        }
    )*};
}
assigned!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

impl Zero for Exact {
    fn zero() -> Exact {
        Exact::integer(0)
    }
    fn is_zero(&self) -> bool {
        *self == Exact::zero()
    }
}

impl One for Exact {
    fn one() -> Exact {
        Exact::integer(1)
    }
}

impl Number for Exact {
    fn infinity() -> Exact {
        PlusInfinity
    }
    fn is_finite(&self) -> bool {
        matches!(self, Finite(_))
    }
    fn from_double(value: f64) -> Exact {
        Finite(BigRational::from_float(value).expect("a finite step"))
    }
    fn tolerance(_: f64) -> Exact {
        Exact::zero()
    }
    fn to_double(&self) -> f64 {
        self.rational().to_f64().unwrap_or(f64::NAN)
    }
    fn order(&self, other: &Exact) -> Ordering {
        self.partial_cmp(other).expect("a total order")
    }
    fn invert(matrix: &DMatrix<Exact>) -> Option<DMatrix<Exact>> {
        let n = matrix.nrows();
        let mut work = matrix.clone().resize_horizontally(2 * n, Exact::zero());
        (0..n).for_each(|i| work[(i, n + i)] = Exact::one());
        for column in 0..n {
            let pivot = (column..n).find(|&row| !work[(row, column)].is_zero())?;
            work.swap_rows(column, pivot);
            let scaled = work.row(column) / work[(column, column)].clone();
            work.set_row(column, &scaled);
            for row in (0..n).filter(|&row| row != column) {
                let factor = work[(row, column)].clone();
                let cleared = work.row(row) - &scaled * factor;
                work.set_row(row, &cleared);
            }
        }
        Some(work.columns(n, n).into_owned())
    }
    fn solve(a: DMatrix<Exact>, b: &DVector<Exact>) -> Option<DVector<Exact>> {
        Some(Exact::invert(&a)? * b)
    }
    fn magnitude(&self) -> Exact {
        match self {
            Finite(a) => Finite(a.abs()),
            _ => PlusInfinity,
        }
    }
}

#[test]
fn inverses_are_exact_and_singular_matrices_have_none() {
    let of = |entries: [i64; 4]| DMatrix::from_row_slice(2, 2, &entries.map(Exact::integer));
    let hilbert_like = of([0, 3, 2, 5]);
    assert_eq!(&hilbert_like * Exact::invert(&hilbert_like).unwrap(), of([1, 0, 0, 1]));
    assert!(Exact::invert(&of([1, 2, 2, 4])).is_none());
    assert!(PlusInfinity > Exact::integer(9) && MinusInfinity < Exact::integer(-9));
}
