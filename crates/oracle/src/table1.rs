//! Table 1 in closed form, re-derived from the 2x2 problem printed above it (`spec/errata.md`, X1).
//!
//! With t = lambda^2 m / k, p = c^2 + 1 and q = mu c s the problem of the two particles is
//!
//! ```text
//! [ t + p - q S1     -S1 S2     ]
//! [   -S1 S2      t + p + q S2  ] x = y / k,    0 <= x _|_ y >= 0,  x != 0.
//! ```
//!
//! Its three supports are solved by hand. The table as printed scrambles its rows; nothing here is
//! copied from it. The values lie in a quadratic field, so they are exact.
//!
//! Input: the data of Fig. 1. Output: all solutions of MCEIP-lambda2 ([`table1`]) or of MCEIP-mu
//! ([`thresholds`]). Called by tests, which hold it against the enumerator and the solver, and by
//! the picture of the table.

use mceip_exact::{Quadratic, Rational, Sign, whole};
use num_traits::{One, Signed, Zero};

/// The data of Fig. 1: springs at an angle with cosine c and sine s, both exact.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TwoParticles {
    /// cos(phi).
    pub c: Rational,
    /// sin(phi), c^2 + s^2 = 1.
    pub s: Rational,
    /// Spring stiffness k > 0.
    pub k: Rational,
    /// Particle mass m > 0.
    pub m: Rational,
    /// Coefficient of friction mu > 0.
    pub mu: Rational,
    /// S1, S2: signs of the tangential reactions.
    pub signs: (i8, i8),
}

impl TwoParticles {
    /// p = c^2 + 1.
    fn p(&self) -> Rational {
        &self.c * &self.c + Rational::one()
    }

    /// q = mu c s.
    fn q(&self) -> Rational {
        &self.mu * &self.c * &self.s
    }
}

/// A solution of Table 1: value and x in Q(sqrt d), x up to a positive factor.
#[derive(Debug, Clone)]
pub struct ClosedSolution {
    /// lambda^2 (or mu for [`thresholds`]).
    pub value: Quadratic,
    /// (x_T1, x_T2).
    pub x: [Quadratic; 2],
    /// Indices with x_i > 0.
    pub slip: Vec<usize>,
}

/// All solutions of MCEIP-lambda2 for the two particles; the value is lambda^2 = t k / m.
///
/// * S1 = S2: slip-slip with t = -p + sqrt(1 + q^2) if that is >= 0 (mu^2 s^2 >= c^2 + 2, or c = 0:
///   then t = 0 for every mu); x_2 / x_1 = sqrt(1 + q^2) - S q.
/// * (+1, -1): slip-stick and stick-slip with t = q - p if q >= p; slip-slip with x_1 = x_2 and
///   t = q - p - 1 if q >= p + 1.
/// * (-1, +1): none.
pub fn table1(data: &TwoParticles) -> Vec<ClosedSolution> {
    match data.signs {
        (s1, s2) if s1 == s2 => equal_signs(data, s1).into_iter().collect(),
        (1, _) => opposite_signs(data),
        _ => Vec::new(),
    }
}

/// S1 = S2 = S: the determinant (t + p)^2 - q^2 - 1 vanishes at t = -p + sqrt(1 + q^2), and there
/// the second row gives x_2 / x_1 = 1 / (t + p + q S) = sqrt(1 + q^2) - q S.
fn equal_signs(data: &TwoParticles, sign: i8) -> Option<ClosedSolution> {
    let q = data.q();
    let d = Rational::one() + &q * &q;
    let t = Quadratic::new(-data.p(), Rational::one(), d.clone())?;

    if t.sign() == Sign::Negative {
        return None;
    }

    let x1 = t.embed(Rational::one());
    let x2 = Quadratic::new(-(q * whole(sign.into())), Rational::one(), d)?;
    Some(ClosedSolution {
        value: t.scale(&(&data.k / &data.m)),
        x: [x1, x2],
        slip: vec![0, 1],
    })
}

/// S1 = +1, S2 = -1: both diagonal entries are t + p - q, both others 1.
fn opposite_signs(data: &TwoParticles) -> Vec<ClosedSolution> {
    let unit = &data.k / &data.m;
    let one_slips = data.q() - data.p();
    let both_slip = &one_slips - Rational::one();

    let mut solutions = Vec::new();

    if !one_slips.is_negative() {
        solutions.push(rational_solution(&one_slips * &unit, [1, 0]));
        solutions.push(rational_solution(&one_slips * &unit, [0, 1]));
    }

    if !both_slip.is_negative() {
        solutions.push(rational_solution(&both_slip * &unit, [1, 1]));
    }

    solutions
}

/// The values of mu at which a solution with lambda^2 = 0 exists (MCEIP-mu), for c > 0 and s > 0;
/// `None` for c = 0 with S1 = S2, where *every* mu is one.
///
/// S1 = S2: mu = sqrt(c^2 + 2) / s; (+1, -1): mu = (c^2 + 1)/(c s) twice, mu = (c^2 + 2)/(c s).
pub fn thresholds(data: &TwoParticles) -> Option<Vec<ClosedSolution>> {
    match data.signs {
        (s1, s2) if s1 == s2 => {
            if data.c.is_zero() {
                return None;
            }
            if data.s.is_zero() {
                return Some(Vec::new());
            }
            Some(vec![threshold_of_equal_signs(data, s1)?])
        }
        (1, _) => Some(thresholds_of_opposite_signs(data)),
        _ => Some(Vec::new()),
    }
}

/// S1 = S2 = S, t = 0: q^2 = p^2 - 1 = c^2 (c^2 + 2), hence mu = q / (c s) = sqrt(c^2 + 2) / s and
/// x_2 / x_1 = sqrt(1 + q^2) - S q = p - S c sqrt(c^2 + 2).
fn threshold_of_equal_signs(data: &TwoParticles, sign: i8) -> Option<ClosedSolution> {
    let d = data.p() + Rational::one();
    let value = Quadratic::new(Rational::zero(), data.s.recip(), d.clone())?;
    let x1 = value.embed(Rational::one());
    let x2 = Quadratic::new(data.p(), -&data.c * whole(sign.into()), d)?;
    Some(ClosedSolution {
        value,
        x: [x1, x2],
        slip: vec![0, 1],
    })
}

/// S1 = +1, S2 = -1, t = 0: q = p and q = p + 1; none if c s = 0.
fn thresholds_of_opposite_signs(data: &TwoParticles) -> Vec<ClosedSolution> {
    let cs = &data.c * &data.s;
    if cs.is_zero() {
        return Vec::new();
    }

    let one_slips = data.p() / &cs;
    let both_slip = (data.p() + Rational::one()) / &cs;
    vec![
        rational_solution(one_slips.clone(), [1, 0]),
        rational_solution(one_slips, [0, 1]),
        rational_solution(both_slip, [1, 1]),
    ]
}

fn rational_solution(value: Rational, x: [i64; 2]) -> ClosedSolution {
    ClosedSolution {
        value: Quadratic::embed_rational(value),
        x: x.map(|x_i| Quadratic::embed_rational(whole(x_i))),
        slip: (0..2).filter(|&i| x[i] > 0).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::rational;

    fn data(mu: Rational, signs: (i8, i8)) -> TwoParticles {
        TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(1),
            m: whole(1),
            mu,
            signs,
        }
    }

    fn count(mu: Rational, signs: (i8, i8)) -> usize {
        table1(&data(mu, signs)).len()
    }

    #[test]
    fn counts_around_the_rational_thresholds() {
        let p = rational(34, 25);
        let cs = rational(12, 25);
        let one_slips = &p / &cs;
        let both_slip = (&p + whole(1)) / &cs;
        let tiny = rational(1, 1_000_000);

        assert_eq!(count(&one_slips - &tiny, (1, -1)), 0);
        assert_eq!(count(one_slips, (1, -1)), 2);
        assert_eq!(count(&both_slip - &tiny, (1, -1)), 2);
        assert_eq!(count(both_slip, (1, -1)), 3);
        assert_eq!(count(whole(1000), (-1, 1)), 0);

        // sqrt(c^2 + 2) / s = 1.92.
        assert_eq!(count(rational(19, 10), (1, 1)), 0);
        assert_eq!(count(rational(21, 10), (1, 1)), 1);
        assert_eq!(count(rational(21, 10), (-1, -1)), 1);
    }

    #[test]
    fn vertical_springs_are_at_the_threshold_for_every_friction() {
        let vertical = TwoParticles {
            c: whole(0),
            s: whole(1),
            ..data(rational(1, 7), (1, 1))
        };

        let found = table1(&vertical);

        assert_eq!(found.len(), 1);
        assert_eq!(found[0].value.sign(), Sign::Zero);
        assert!(thresholds(&vertical).is_none());

        let horizontal = TwoParticles {
            c: whole(1),
            s: whole(0),
            ..data(whole(100), (1, 1))
        };

        assert!(table1(&horizontal).is_empty());
        assert_eq!(thresholds(&horizontal).map(|t| t.len()), Some(0));
    }

    /// The 2x2 problem of the heading with t = lambda^2 m / k and q = mu c s, exactly: is x a
    /// solution with support `slip`?
    fn assert_solves(data: &TwoParticles, t: &Quadratic, q: &Quadratic, s: &ClosedSolution) {
        let s1 = whole(data.signs.0.into());
        let s2 = whole(data.signs.1.into());
        let off_diagonal = -&s1 * &s2;
        let t_plus_p = t.add(&t.embed(&data.c * &data.c + whole(1)));
        let diagonal_1 = t_plus_p.add(&q.scale(&-s1));
        let diagonal_2 = t_plus_p.add(&q.scale(&s2));

        let [x_1, x_2] = &s.x;
        let y_1 = diagonal_1.mul(x_1).add(&x_2.scale(&off_diagonal));
        let y_2 = diagonal_2.mul(x_2).add(&x_1.scale(&off_diagonal));

        for (i, x_i, y_i) in [(0, x_1, y_1), (1, x_2, y_2)] {
            let (sign_x, sign_y) = (x_i.sign(), y_i.sign());
            let is_admissible = if s.slip.contains(&i) {
                sign_x == Sign::Positive && sign_y == Sign::Zero
            } else {
                sign_x == Sign::Zero && sign_y != Sign::Negative
            };
            assert!(is_admissible, "{data:?} {i} {sign_x:?} {sign_y:?}");
        }
    }

    #[test]
    fn every_solution_solves_the_problem_it_is_the_table_of() {
        let mut seen = 0;
        for mu in [rational(21, 10), whole(5), whole(9)] {
            for signs in [(1, 1), (-1, -1), (1, -1)] {
                let data = TwoParticles {
                    k: whole(7),
                    m: rational(5, 3),
                    ..data(mu.clone(), signs)
                };

                for solution in table1(&data) {
                    let t = solution.value.scale(&(&data.m / &data.k));
                    let q = t.embed(&data.mu * &data.c * &data.s);
                    assert_solves(&data, &t, &q, &solution);
                    seen += 1;
                }
            }
        }

        assert_eq!(seen, 2 * 3 + 3 + 3); // at mu = 21/10 none of (+1, -1)
    }

    /// At a threshold the solution has lambda^2 = 0.
    #[test]
    fn thresholds_are_where_the_value_is_zero() {
        for (signs, count) in [((1, 1), 1), ((-1, -1), 1), ((1, -1), 3), ((-1, 1), 0)] {
            let data = data(whole(1), signs);
            let list = thresholds(&data).unwrap();

            assert_eq!(list.len(), count);
            for solution in list {
                let t = solution.value.embed(whole(0));
                let q = solution.value.scale(&(&data.c * &data.s));
                assert_solves(&data, &t, &q, &solution);
            }
        }

        for (c, s) in [(whole(0), whole(1)), (whole(1), whole(0))] {
            let degenerate = TwoParticles {
                c,
                s,
                ..data(whole(1), (1, -1))
            };
            assert_eq!(thresholds(&degenerate).map(|t| t.len()), Some(0));
        }
    }
}
