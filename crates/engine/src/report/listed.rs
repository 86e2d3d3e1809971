//! A solution ready to be printed: decimals of value, x, y, v and w, each correctly rounded.
//!
//! Input: a solution of the enumerator, a claim of a certificate, or a solution that a cover has
//! proved. All of them become a [`Solution`] with a value (an algebraic number t) and x, y
//! (polynomials in t), scaled to e'x_s = 1. Output: [`Listed`]. Called by `mceip solve`,
//! `enumerate` and `complete`, by the front door, and by `solutions.rs` beside this file.

use crate::candidate::Candidate;
use crate::certify::rows::{active, center_of};
use crate::certify::{Certifier, flattened};
use crate::multistart::{exact_value, integer_x, is_about};
use crate::search::complete::Completed;
use mceip_check::AcceptedClaim;
use mceip_check::certificate::{Claim, EnclosedSolution, ExactSolution};
use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sparse, cleared, common_denominator, enclosing_decimals,
    from_f64, ratio_to_decimal, to_decimal, to_f64,
};
use mceip_model::reduction::lift;
use mceip_model::{Body, Problem, Reduced};
use mceip_oracle::{Cone, Enumeration, Solution};
use std::cmp::Ordering;

/// Significant digits printed in reports.
pub(super) const DIGITS: usize = 17;

/// One solution in decimals.
#[derive(Debug, Clone)]
pub struct Listed {
    /// Value of the unknown.
    pub value: String,
    /// Decimals that enclose the value, where a cover has proved it.
    pub enclosure: Option<[String; 2]>,
    /// Polynomial and isolating interval, where the solution is exact.
    pub exact: Option<(Vec<Integer>, [Rational; 2])>,
    /// Indices with x_i > 0.
    pub slip: Vec<usize>,
    /// Indices with x_i = y_i = 0.
    pub biactive: Vec<usize>,
    /// x with e'x_s = 1; empty where it is not known.
    pub x: Vec<String>,
    /// y = (A + tB) x.
    pub y: Vec<String>,
    /// v and w over all degrees of freedom, for a system.
    pub lifted: Option<(Vec<String>, Vec<String>)>,
    /// Dimension of the kernel on the support, where it was computed.
    pub kernel_dimension: Option<usize>,
    /// The cone of solutions that `x` lies inside of, where `x` is not the only one.
    pub cone: Option<ListedCone>,
}

/// A cone of solutions in decimals.
#[derive(Debug, Clone)]
pub struct ListedCone {
    /// Its dimension.
    pub dimension: usize,
    /// Its extreme rays.
    pub rays: Vec<Listed>,
    /// Directions that may be added with either sign, l1 norm 1.
    pub lineality: Vec<Vec<String>>,
}

impl Listed {
    /// From a solution of the enumerator. The decimals refine the enclosure of the value one after
    /// the other; `exact` has the enclosure after those of x.
    pub fn of_solution(problem: &Problem, reduced: &Reduced, s: &Solution) -> Listed {
        let mut digits = Digits {
            value: s.value.clone(),
            norm: s.normaliser(&reduced.normalised()),
        };

        // z of the linear form of a quadratic pencil, after x, is not listed.
        let (coefficients, x) = match problem.body() {
            Body::Quadratic(quadratic) => {
                let x = &s.x[..quadratic.order()];
                (quadratic.coefficients().to_vec(), x)
            }
            Body::Pencil(_) | Body::System(_) => {
                (vec![reduced.pencil.a(), reduced.pencil.b()], &s.x[..])
            }
        };
        let y = digits.of_rows(&coefficients, x);
        let lifted = match problem.body() {
            Body::Pencil(_) | Body::Quadratic(_) => None,
            Body::System(system) => {
                let lifted = lift(system, problem.unknown(), &reduced.variables, &s.x);
                let v = digits.of_all(&lifted.v, &lifted.v_scale);
                let w = digits.of_all(&lifted.w, &lifted.w_scale);
                Some((v, w))
            }
        };

        let x = digits.of_all(x, &Integer::from(1));
        let mut value = digits.value;
        let interval = [value.interval().lo().clone(), value.interval().hi().clone()];
        let polynomial = value.poly().coeffs().to_vec();

        Listed {
            value: to_decimal(&mut value, &Poly::from_ints(&[0, 1]), DIGITS),
            enclosure: None,
            exact: Some((polynomial, interval)),
            slip: s.slip.clone(),
            biactive: s.biactive.clone(),
            x,
            y,
            lifted,
            kernel_dimension: Some(1),
            cone: None,
        }
    }

    /// Solutions and cones of the enumerator in one list, by value, then by slip set.
    pub fn of_enumeration(
        problem: &Problem,
        reduced: &Reduced,
        found: &Enumeration,
    ) -> Vec<Listed> {
        let mut entries = Vec::new();
        for solution in &found.solutions {
            let listed = Listed {
                kernel_dimension: Some(found.kernel_dimension(solution)),
                ..Listed::of_solution(problem, reduced, solution)
            };
            entries.push(ListEntry {
                value: &solution.value,
                slip: &solution.slip,
                listed,
            });
        }

        for cone in &found.cones {
            entries.push(ListEntry {
                value: &cone.value,
                slip: &cone.slip,
                listed: Listed::of_cone(problem, reduced, cone),
            });
        }

        entries.sort_by(ListEntry::by_value_and_slip);
        entries.into_iter().map(|entry| entry.listed).collect()
    }

    /// A solution of the reflected pencil (A, -B) as one of (A, B): the value changes its sign.
    #[must_use]
    pub fn reflected(self) -> Listed {
        let exact = self.exact.map(|(polynomial, [lo, hi])| {
            let reflected = Poly::new(polynomial).reflected();
            (reflected.coeffs().to_vec(), [-hi, -lo])
        });

        Listed {
            value: negated(&self.value),
            enclosure: self.enclosure.map(|[lo, hi]| [negated(&hi), negated(&lo)]),
            exact,
            ..self
        }
    }

    /// From a cone of the enumerator: `x` is the mean of its rays.
    pub fn of_cone(problem: &Problem, reduced: &Reduced, cone: &Cone) -> Listed {
        let center = cone.center(&reduced.pencil.slip());

        let mut lineality = Vec::new();
        for x in &cone.lineality {
            // No slip variable: the normaliser is the l1 norm.
            let direction = Solution {
                slip: Vec::new(),
                x: x.clone(),
                ..center.clone()
            };
            lineality.push(direction.x_decimals(&[], DIGITS));
        }

        let rays = cone.rays.iter();
        let listed_cone = ListedCone {
            dimension: cone.dimension,
            rays: rays
                .map(|ray| Listed::of_solution(problem, reduced, ray))
                .collect(),
            lineality,
        };

        Listed {
            kernel_dimension: Some(cone.kernel_dimension),
            cone: Some(listed_cone),
            ..Listed::of_solution(problem, reduced, &center)
        }
    }

    /// From a claim: exact where it is, the centre of the box otherwise.
    pub fn of_claim(problem: &Problem, reduced: &Reduced, claim: &Claim) -> Listed {
        match claim {
            Claim::ExactSolution(exact) => of_exact(problem, reduced, claim, exact),
            Claim::LiftedSolution(lifted) => {
                let exact = match problem.body() {
                    Body::System(system) => flattened(system, lifted),
                    // The checker accepts no such claim; it is listed by what it says of itself.
                    Body::Pencil(_) | Body::Quadratic(_) => ExactSolution {
                        support: lifted.support.clone(),
                        biactive: lifted.biactive.clone(),
                        polynomial: lifted.polynomial.clone(),
                        interval: lifted.interval.clone(),
                        x: vec![Vec::new(); reduced.pencil.order()],
                    },
                };
                of_exact(problem, reduced, claim, &exact)
            }
            Claim::EnclosedSolution(enclosed) => of_enclosed(problem, reduced, enclosed),
        }
    }

    /// The solutions of a complete set, each with what the checker has read off it: digits of the
    /// exact claim about it, which the certificate has or `certify` makes, or else of an enclosed
    /// one; those of the doubles where there is no claim.
    pub fn of_cover<'a>(
        problem: &'a Problem,
        reduced: &'a Reduced,
        found: &'a Completed,
    ) -> impl Iterator<Item = (&'a AcceptedClaim, Listed)> {
        let list = ProvedList {
            problem,
            reduced,
            certifier: Certifier::new(problem, &reduced.pencil),
        };
        found.solutions().map(move |(proved, x)| {
            let listed = list.listed(proved, x, found.claim_about(proved));
            (proved, listed)
        })
    }
}

/// The decimal of -t, where `decimal` is one of t.
pub(crate) fn negated(decimal: &str) -> String {
    match decimal.strip_prefix('-') {
        Some(positive) => positive.into(),
        None if decimal == "0" => decimal.into(),
        None => format!("-{decimal}"),
    }
}

/// What lists the solutions of a cover.
struct ProvedList<'a> {
    problem: &'a Problem,
    reduced: &'a Reduced,
    certifier: Certifier<'a>,
}

impl ProvedList<'_> {
    /// A solution with x in doubles, and the claim of the certificate about it.
    fn listed(&self, proved: &AcceptedClaim, x: &[f64], claim: Option<&Claim>) -> Listed {
        let listed = match self.claim_about(proved, x, claim) {
            Some(claim) => Listed::of_claim(self.problem, self.reduced, &claim),
            None => {
                let x: Result<Vec<Rational>, _> = x.iter().map(|v| from_f64(*v)).collect();
                let value = proved.value.mid();
                match x {
                    Ok(x) => of_point(self.problem, self.reduced, &proved.support, value, &x),
                    Err(_) => without_x(&proved.support, value),
                }
            }
        };

        Listed {
            enclosure: Some(enclosing_decimals(&proved.value, DIGITS).into()),
            ..listed
        }
    }

    /// An exact claim about the solution if there is one, or else an enclosed one.
    fn claim_about(
        &self,
        proved: &AcceptedClaim,
        x: &[f64],
        claim: Option<&Claim>,
    ) -> Option<Claim> {
        if let Some(exact) = claim.filter(|claim| exact_value(claim).is_some()) {
            return Some(exact.clone());
        }

        let candidate = Candidate {
            value: to_f64(&proved.value.mid()),
            x: x.to_vec(),
        };
        let certified = self.certifier.certify_with_verdict(&candidate).ok();
        let made =
            certified.filter(|(claim, verdict)| is_about(verdict, exact_value(claim), proved));
        let made = made.map(|(claim, _)| claim);
        made.or_else(|| claim.cloned())
    }
}

/// A solution or cone of the enumerator with the keys of its place in the list.
struct ListEntry<'a> {
    value: &'a Algebraic,
    slip: &'a [usize],
    listed: Listed,
}

impl ListEntry<'_> {
    fn by_value_and_slip(&self, other: &ListEntry<'_>) -> Ordering {
        let mut value = self.value.clone();
        let by_value = value.cmp_exact(&mut other.value.clone());
        by_value.then_with(|| self.slip.cmp(other.slip))
    }
}

/// Decimals of polynomials at one value, divided by the normaliser.
struct Digits {
    value: Algebraic,
    norm: Poly,
}

impl Digits {
    /// p / (norm scale) at the value.
    fn of(&mut self, p: &Poly, scale: &Integer) -> String {
        ratio_to_decimal(&mut self.value, p, &self.norm.scale(scale), DIGITS)
    }

    fn of_all(&mut self, list: &[Poly], scale: &Integer) -> Vec<String> {
        list.iter().map(|p| self.of(p, scale)).collect()
    }

    /// The rows of (A + tB + ...) x.
    fn of_rows(&mut self, coefficients: &[&Sparse], x: &[Poly]) -> Vec<String> {
        let mut rows = Vec::with_capacity(x.len());
        for i in 0..x.len() {
            let (row, scale) = row_times(coefficients, i, x);
            rows.push(self.of(&row, &scale));
        }
        rows
    }
}

/// The centre of the box of an enclosed solution: x over the free variables and the support, then
/// the value.
fn of_enclosed(problem: &Problem, reduced: &Reduced, enclosed: &EnclosedSolution) -> Listed {
    let x = center_of(&reduced.pencil, enclosed);
    let value = match enclosed.center.last() {
        Some(number) => number.0.clone(),
        None => Rational::default(),
    };

    of_point(problem, reduced, &enclosed.support, value, &x)
}

/// A solution whose x is not known.
fn without_x(support: &[usize], value: Rational) -> Listed {
    let mut value = Algebraic::rational(value);
    Listed {
        value: to_decimal(&mut value, &Poly::from_ints(&[0, 1]), DIGITS),
        enclosure: None,
        exact: None,
        slip: support.to_vec(),
        biactive: Vec::new(),
        x: Vec::new(),
        y: Vec::new(),
        lifted: None,
        kernel_dimension: None,
        cone: None,
    }
}

/// A solution known in rounded numbers only, x in any positive scale, with y = 0 on the free rows
/// and those of the support. Biactive are the halves of v_T of which y vanishes with these.
fn of_point(
    problem: &Problem,
    reduced: &Reduced,
    support: &[usize],
    value: Rational,
    x: &[Rational],
) -> Listed {
    let denominator = common_denominator(x);
    let integers = x.iter().map(|v| cleared(v, &denominator));
    let solution = Solution {
        value: Algebraic::rational(value),
        multiplicity: 1,
        slip: support.to_vec(),
        biactive: Vec::new(),
        x: integers.map(Poly::constant).collect(),
        y: Vec::new(),
    };

    let zero = &reduced.zero;
    let vanishing = zero.iter().filter_map(|places| places.vanishing(support));
    let biactive: Vec<usize> = vanishing.collect();

    // y of the solution is 0 there; that of the rounded numbers is not.
    let listed = Listed::of_solution(problem, reduced, &solution);
    let mut y = listed.y;
    let active = active(&reduced.pencil, support);
    for i in active.into_iter().chain(biactive.iter().copied()) {
        if let Some(y_i) = y.get_mut(i) {
            *y_i = "0".into();
        }
    }

    Listed {
        exact: None,
        biactive,
        y,
        kernel_dimension: None,
        ..listed
    }
}

/// An exact solution; `claim` is the claim that says it.
fn of_exact(problem: &Problem, reduced: &Reduced, claim: &Claim, exact: &ExactSolution) -> Listed {
    // A claim made by `certify` has a valid interval; a foreign one prints its lower end.
    let value =
        exact_value(claim).unwrap_or_else(|| Algebraic::rational(exact.interval[0].0.clone()));
    let solution = Solution {
        value,
        multiplicity: 1,
        slip: exact.support.clone(),
        biactive: exact.biactive.clone(),
        x: integer_x(exact),
        y: Vec::new(),
    };

    Listed {
        kernel_dimension: None,
        ..Listed::of_solution(problem, reduced, &solution)
    }
}

/// Row i of (A + tB + ...) x, the coefficients in ascending order, as an integer polynomial and the
/// positive integer it was multiplied by.
pub(crate) fn row_times(coefficients: &[&Sparse], i: usize, x: &[Poly]) -> (Poly, Integer) {
    let entries = coefficients.iter().flat_map(|matrix| matrix.row(i));
    let scale = common_denominator(entries.map(|(_, v)| v));

    let mut sum = Poly::default();
    for (power, matrix) in coefficients.iter().enumerate() {
        for (j, v) in matrix.row(i) {
            sum += &x[*j].scale(&cleared(v, &scale)).shift(power);
        }
    }

    (sum, scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Interval, rational, whole};
    use mceip_model::reduction::reduce;
    use mceip_model::{Pencil, Unknown, Window};

    /// [[1, -6], [2, -6]] + t I: t = 2 with x = (2, 1).
    fn listed(x: &[f64]) -> Listed {
        let a = Sparse::from_ints(&[&[1, -6], &[2, -6]]);
        let pencil = Pencil::new(a, Sparse::identity(2), vec![]).unwrap();
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
        let reduced = reduce(&problem).unwrap();
        let list = ProvedList {
            problem: &problem,
            reduced: &reduced,
            certifier: Certifier::new(&problem, &reduced.pencil),
        };

        let radius = rational(1, 1 << 20);
        let value = Interval::new(whole(2) - &radius, whole(2) + &radius).unwrap();
        let proved = AcceptedClaim {
            support: vec![0, 1],
            value,
        };

        list.listed(&proved, x, None)
    }

    #[test]
    fn a_proved_solution_is_listed_by_its_claim() {
        let listed = listed(&[0.666667, 0.333333]);

        assert_eq!((listed.value.as_str(), listed.exact.is_some()), ("2", true));
        assert_eq!(listed.x, ["0.66666666666666667", "0.33333333333333333"]);
        assert_eq!(
            listed.enclosure,
            Some(["1.9999990463256835".into(), "2.0000009536743165".into()])
        );
    }

    fn accepted(support: &[usize], from: i64, to: i64) -> AcceptedClaim {
        AcceptedClaim {
            support: support.to_vec(),
            value: Interval::new(whole(from), whole(to)).unwrap(),
        }
    }

    /// A claim whose values reach out of the enclosure may be about a neighbour, and so may one
    /// with another support.
    #[test]
    fn a_claim_that_only_overlaps_is_not_taken() {
        let proved = accepted(&[0, 1], 4, 6);

        assert!(is_about(&accepted(&[0, 1], 4, 6), None, &proved));
        assert!(is_about(&accepted(&[0, 1], 5, 5), None, &proved));
        for other in [
            accepted(&[0, 1], 3, 5),
            accepted(&[0, 1], 5, 7),
            accepted(&[0, 1], 3, 7),
            accepted(&[0], 5, 5),
        ] {
            assert!(!is_about(&other, None, &proved), "{other:?}");
        }

        // The value of an exact claim counts, not the interval that isolates it.
        let wide = accepted(&[0, 1], 3, 7);
        let five = Some(Algebraic::rational(whole(5)));
        let seven = Some(Algebraic::rational(whole(7)));
        assert!(is_about(&wide, five, &proved));
        assert!(!is_about(&wide, seven, &proved));
    }

    /// x from which no claim comes: the digits of the doubles, and nothing that looks exact.
    #[test]
    fn a_solution_without_a_claim_has_the_digits_of_its_doubles() {
        let listed = listed(&[0.75, 0.25]);

        assert_eq!(
            (listed.value.as_str(), listed.exact.is_some()),
            ("2", false)
        );
        assert_eq!(listed.x, ["0.75", "0.25"]);
        assert_eq!(listed.slip, [0, 1]);
        assert!(listed.enclosure.is_some());
    }
}
