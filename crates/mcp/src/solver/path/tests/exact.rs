//! Rationals with infinities, so that the very code of the path can be run without rounding.

use super::super::super::dense::Lu;
use super::super::super::number::PathNumber;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A rational, or a bound that is none. Arithmetic on infinities is not defined beyond inf -
/// finite.
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

impl PathNumber for Exact {
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
    fn magnitude(&self) -> Exact {
        match self {
            Finite(a) => Finite(a.abs()),
            _ => PlusInfinity,
        }
    }
}

#[test]
fn factors_are_exact_and_singular_matrices_have_none() {
    /// The factors of a 2 x 2 matrix, entries by rows.
    fn factored(entries: [i64; 4]) -> Option<Lu<Exact>> {
        let mut lu = Lu::default();
        let gather = |col: usize, rows: &[usize], out: &mut [Exact]| {
            for (&row, entry) in rows.iter().zip(out) {
                *entry = Exact::integer(entries[2 * row + col]);
            }
        };
        lu.factor(2, gather, |_| Exact::zero()).then_some(lu)
    }

    let lu = factored([0, 3, 2, 5]).unwrap();
    let mut x: Vec<Exact> = lu
        .rows()
        .iter()
        .map(|&i| Exact::integer([1, 0][i]))
        .collect();
    lu.solve(&mut x);

    assert_eq!(
        x,
        [(-5, 6), (1, 3)].map(|(p, q)| Exact::integer(p) / Exact::integer(q))
    );
    assert!(factored([1, 2, 2, 4]).is_none());
    assert!(PlusInfinity > Exact::integer(9));
    assert!(MinusInfinity < Exact::integer(-9));
}
