//! Polynomials that keep their sign between two algebraic numbers.
//!
//! Descartes' rule of signs: p has no root in (a, b) if (1 + x)^n p((a + bx) / (1 + x)) has coefficients of one
//! sign. Where that is not so the interval is halved, a few times.

use crate::exact::{Integer, Interval, Poly, Rational};
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

/// Halvings in a row and in all before the answer is no.
const MAX_DEPTH: u32 = 24;
const MAX_HALVINGS: usize = 200;

/// The only root of `poly` in `value`.
pub(super) struct Root {
    pub(super) poly: Poly,
    pub(super) value: Interval,
}

impl Root {
    /// The sign of g here, if it can be told.
    pub(super) fn sign(&self, g: &Poly) -> Option<i8> {
        let rest = g.pseudo_rem(&self.poly);
        if rest.is_zero() {
            return Some(0);
        }
        Some(self.value.horner(&rest).certain_sign()).filter(|s| *s != 0)
    }

    /// Has g no root in the isolating interval but possibly this one?
    fn is_only_root_of(&self, g: &Poly) -> bool {
        let rest = stripped(g, &self.poly);
        let (a, b) = (self.value.lo(), self.value.hi());
        self.value.is_point() || (rest.sign_at(a) != 0 && rest.sign_at(b) != 0 && has_no_root(&rest, a, Some(b)))
    }
}

/// The sign of g strictly between two roots (`None`: infinity), if it has one there and it can be told.
pub(super) fn sign_between(g: &Poly, left: &Root, right: Option<&Root>) -> Option<i8> {
    if g.is_zero() {
        return Some(0);
    }
    let (a, b) = (left.value.hi(), right.map(|r| r.value.lo()));
    let sample = b.map_or_else(|| a + Rational::one(), |b| (a + b) / Rational::from_integer(2.into()));
    let near = left.is_only_root_of(g) && right.is_none_or(|r| r.is_only_root_of(g));
    (near && has_no_root(g, a, b)).then(|| g.sign_at(&sample))
}

/// Is it certain that p has no root in the open interval?
pub(super) fn has_no_root(p: &Poly, a: &Rational, b: Option<&Rational>) -> bool {
    let mut halvings = MAX_HALVINGS;
    has_none(p, a, b, MAX_DEPTH, &mut halvings)
}

fn has_none(p: &Poly, a: &Rational, b: Option<&Rational>, depth: u32, halvings: &mut usize) -> bool {
    match sign_changes(p, a, b) {
        0 => true,
        1 => false,
        _ if depth == 0 || *halvings == 0 => false,
        _ => {
            *halvings -= 1;
            let middle = b.map_or_else(|| a + a.abs() + Rational::one(), |b| (a + b) / Rational::from_integer(2.into()));
            p.sign_at(&middle) != 0 && has_none(p, a, Some(&middle), depth - 1, halvings) && has_none(p, &middle, b, depth - 1, halvings)
        }
    }
}

/// Descartes' bound of the number of roots in the open interval.
fn sign_changes(p: &Poly, a: &Rational, b: Option<&Rational>) -> usize {
    let width = b.map(|b| b - a);
    let unit = width.as_ref().map_or(a.denom().clone(), |w| a.denom().lcm(w.denom()));
    let in_units = |v: &Rational| v.numer() * (&unit / v.denom());
    // p(y / unit) unit^n, shifted to begin at a.
    let mut power = Integer::one();
    let mut c: Vec<Integer> = p.coeffs().to_vec();
    for c_k in c.iter_mut().rev() {
        *c_k *= &power;
        power *= &unit;
    }
    shift(&mut c, &in_units(a));
    if let Some(width) = width {
        // y = width s with s = 1 / (1 + x).
        let (width, mut power) = (in_units(&width), Integer::one());
        for c_k in &mut c {
            *c_k *= &power;
            power *= &width;
        }
        c.reverse();
        shift(&mut c, &Integer::one());
    }
    let signs: Vec<bool> = c.iter().filter(|v| !v.is_zero()).map(Signed::is_positive).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

/// p(y) to p(y + a).
fn shift(c: &mut [Integer], a: &Integer) {
    for i in 0..c.len() {
        for k in (i..c.len().saturating_sub(1)).rev() {
            let step = &c[k + 1] * a;
            c[k] += step;
        }
    }
}

/// g without its factors q.
fn stripped(g: &Poly, q: &Poly) -> Poly {
    let mut rest = g.clone();
    while rest.degree() >= q.degree() && rest.pseudo_rem(q).is_zero() {
        rest = quotient(&rest, q);
    }
    rest
}

/// A multiple of g / q, which q divides over the rationals.
fn quotient(g: &Poly, q: &Poly) -> Poly {
    let lead = q.leading();
    let (mut rest, mut out) = (g.clone(), Poly::default());
    while let (Some(n), Some(m)) = (rest.degree(), q.degree()) {
        if n < m {
            break;
        }
        let top = Poly::constant(rest.leading()).shift(n - m);
        rest = &rest.scale(&lead) - &(&top * q);
        out = &out.scale(&lead) + &top;
    }
    out.primitive()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{rational, whole};

    fn root(c: &[i64], a: (i64, i64), b: (i64, i64)) -> Root {
        Root { poly: Poly::from_ints(c), value: Interval::new(rational(a.0, a.1), rational(b.0, b.1)).unwrap() }
    }

    #[test]
    fn roots_are_not_overlooked() {
        let p = Poly::from_ints(&[2, -3, 1]); // 1 and 2
        assert!(!has_no_root(&p, &whole(0), Some(&whole(3))));
        assert!(!has_no_root(&p, &rational(3, 2), None));
        // Ends do not count.
        assert!(has_no_root(&p, &whole(1), Some(&whole(2))));
        assert!(has_no_root(&p, &whole(2), None));
        // A double root does not change the sign and is one.
        assert!(!has_no_root(&Poly::from_ints(&[1, -2, 1]), &whole(0), Some(&whole(3))));
        assert!(!has_no_root(&Poly::from_ints(&[1, -2, 1]), &whole(0), None));
    }

    #[test]
    fn complex_roots_near_the_interval_take_halvings() {
        // (t - 1)^2 + 1/100
        let p = Poly::from_ints(&[101, -200, 100]);
        assert!(sign_changes(&p, &whole(0), Some(&whole(2))) > 0);
        assert!(has_no_root(&p, &whole(0), Some(&whole(2))) && has_no_root(&p, &whole(0), None));
    }

    #[test]
    fn signs_between_roots() {
        let (one, sqrt2) = (root(&[-1, 1], (1, 1), (1, 1)), root(&[-2, 0, 1], (7, 5), (3, 2)));
        let g = &Poly::from_ints(&[-2, 0, 1]) * &Poly::from_ints(&[-1, 1]);
        assert_eq!(sign_between(&g, &one, Some(&sqrt2)), Some(-1));
        assert_eq!(sign_between(&g, &sqrt2, None), Some(1));
        assert_eq!(sign_between(&(&g * &g), &sqrt2, None), Some(1));
        assert_eq!(sign_between(&Poly::from_ints(&[-3, 2]), &one, None), None);
        // A root within the isolating interval, on either side of the isolated one.
        assert_eq!(sign_between(&Poly::from_ints(&[-29, 20]), &sqrt2, None), None);
        assert_eq!(sign_between(&Poly::from_ints(&[-141, 100]), &one, Some(&sqrt2)), None);
        assert_eq!(sign_between(&Poly::default(), &one, None), Some(0));
        assert_eq!([sqrt2.sign(&g), sqrt2.sign(&Poly::from_ints(&[-1, 1]))], [Some(0), Some(1)]);
    }

    /// The sample lies above the last point: a root just below it does not count.
    #[test]
    fn the_sign_to_infinity_is_taken_above() {
        let three = root(&[-3, 1], (3, 1), (3, 1));
        assert_eq!(sign_between(&Poly::from_ints(&[-5, 2]), &three, None), Some(1));
        assert_eq!(sign_between(&Poly::from_ints(&[5, -2]), &three, None), Some(-1));
        let half = root(&[-1, 2], (1, 2), (1, 2));
        assert_eq!(sign_between(&Poly::from_ints(&[1, 4]), &half, Some(&three)), Some(1));
    }

    /// sqrt 2 in [7/5, 3/2], with another root of g, 29/20, beside it: told whether or not sqrt 2 is one as well.
    #[test]
    fn another_root_in_the_isolating_interval_is_seen() {
        let (sqrt2, nine) = (root(&[-2, 0, 1], (7, 5), (3, 2)), root(&[-9, 1], (9, 1), (9, 1)));
        let (beside, far) = (Poly::from_ints(&[-29, 20]), Poly::from_ints(&[-10, 1]));
        let square = &sqrt2.poly * &sqrt2.poly;
        for g in [&beside * &far, &(&beside * &far) * &sqrt2.poly, &(&beside * &far) * &square] {
            assert_eq!(sign_between(&g, &sqrt2, Some(&nine)), None);
        }
        assert_eq!(sign_between(&(&far * &square), &sqrt2, Some(&nine)), Some(-1));
        assert_eq!(sign_between(&(&far * &Poly::from_ints(&[-10, 3])), &sqrt2, Some(&nine)), None);
        assert_eq!(sign_between(&(&far * &Poly::from_ints(&[-1, 3])), &sqrt2, Some(&nine)), Some(-1));
    }

    /// A half line from `a` is halved above `a`, also where that is negative.
    #[test]
    fn half_lines_are_halved_above_their_end() {
        // Complex roots about `at` and a real one.
        let p = |at: i64, real: i64| &Poly::from_ints(&[100 * at * at + 1, -200 * at, 100]) * &Poly::from_ints(&[-real, 1]);
        assert!(has_no_root(&p(8, 2), &whole(3), None)); // 2 is below
        assert!(has_no_root(&p(1, -5), &whole(-3), None) && has_no_root(&p(-1, -5), &whole(-3), None));
        assert!(!has_no_root(&p(8, 5), &whole(3), None) && !has_no_root(&p(8, 30), &whole(3), None));
    }

    /// (t - c)^2 + 1/10^4 takes about seven halvings on the way to c, on either side of the middle.
    #[test]
    fn the_answer_is_no_when_the_halvings_are_used_up() {
        let near = |c: i64| Poly::from_ints(&[c * c * 100 + 1, -2000 * c, 10_000]); // c in tenths
        for c in [1, 19] {
            let of = |depth: u32, mut halvings: usize| {
                let verdict = has_none(&near(c), &whole(0), Some(&whole(2)), depth, &mut halvings);
                (verdict, halvings)
            };
            let (verdict, left) = of(24, 200);
            let used = 200 - left;
            assert!(verdict && (4..20).contains(&used), "{c}: {used}");
            assert_eq!([of(24, used), of(24, used - 1)], [(true, 0), (false, 0)]);
            let depth = (0..24).find(|&d| of(d, 200).0).unwrap();
            assert!((4..20).contains(&depth), "{c}: {depth}");
            assert!(!of(depth - 1, 200).0 && of(0, 200) == (false, 200));
        }
    }
}
