//! A solution ready to be printed: decimals of value, x, y, v and w, each correctly rounded.

use crate::candidate::Candidate;
use crate::certify::{Certifier, flattened};
use crate::multistart::{exact_value, integer_x};
use crate::reduction::{Reduced, lift};
use mceip_check::AcceptedClaim;
use mceip_check::certificate::{Claim, ExactSolution};
use mceip_exact::{
    Algebraic, Integer, Poly, Rational, common_denominator, enclosing_decimals, from_f64,
    ratio_to_decimal, to_decimal, to_f64,
};
use mceip_model::{Body, Pencil, Problem};
use mceip_oracle::{Cone, Enumeration, Solution};

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
    /// x with e'x_s = 1.
    pub x: Vec<String>,
    /// y = (A + tB) x.
    pub y: Vec<String>,
    /// v and w over all degrees of freedom, for a system.
    pub lifted: Option<(Vec<String>, Vec<String>)>,
    /// Dimension of the kernel on the support; 1 where it was not computed.
    pub kernel_dimension: usize,
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
    /// From a solution of the enumerator.
    pub fn of_solution(problem: &Problem, reduced: &Reduced, s: &Solution) -> Listed {
        let norm = s.normaliser(&reduced.pencil.slip());
        of_polynomials(
            problem,
            reduced,
            s.value.clone(),
            &s.slip,
            &s.biactive,
            &s.x,
            &norm,
        )
    }

    /// Solutions and cones of the enumerator in one list, by value, then by slip set.
    pub fn of_enumeration(
        problem: &Problem,
        reduced: &Reduced,
        found: &Enumeration,
    ) -> Vec<Listed> {
        let solutions = found.solutions.iter().map(|s| {
            let kernel_dimension = found.kernel_dimension(s);
            (
                &s.value,
                &s.slip,
                Listed {
                    kernel_dimension,
                    ..Listed::of_solution(problem, reduced, s)
                },
            )
        });
        let cones = found
            .cones
            .iter()
            .map(|c| (&c.value, &c.slip, Listed::of_cone(problem, reduced, c)));
        let mut all: Vec<_> = solutions.chain(cones).collect();
        all.sort_by(|a, b| {
            a.0.clone()
                .cmp_exact(&mut b.0.clone())
                .then_with(|| a.1.cmp(b.1))
        });
        all.into_iter().map(|entry| entry.2).collect()
    }

    /// From a cone of the enumerator: `x` is the mean of its rays.
    pub fn of_cone(problem: &Problem, reduced: &Reduced, cone: &Cone) -> Listed {
        let center = cone.center(&reduced.pencil.slip());
        let lineality = cone.lineality.iter().map(|x| {
            // No slip variable: the normaliser is the l1 norm.
            let direction = Solution {
                slip: Vec::new(),
                x: x.clone(),
                ..center.clone()
            };
            direction.x_decimals(&[], DIGITS)
        });
        let listed = ListedCone {
            dimension: cone.dimension,
            rays: cone
                .rays
                .iter()
                .map(|r| Listed::of_solution(problem, reduced, r))
                .collect(),
            lineality: lineality.collect(),
        };
        let entry = Listed::of_solution(problem, reduced, &center);
        Listed {
            kernel_dimension: cone.kernel_dimension,
            cone: Some(listed),
            ..entry
        }
    }

    /// From a claim: exact where it is, the centre of the box otherwise.
    pub fn of_claim(problem: &Problem, reduced: &Reduced, claim: &Claim) -> Listed {
        match claim {
            Claim::ExactSolution(c) => of_exact(problem, reduced, claim, c),
            Claim::LiftedSolution(c) => match problem.body() {
                Body::System(system) => of_exact(problem, reduced, claim, &flattened(system, c)),
                // The checker accepts no such claim; it is listed by what it says of itself.
                Body::Pencil(p) => of_exact(
                    problem,
                    reduced,
                    claim,
                    &ExactSolution {
                        support: c.support.clone(),
                        biactive: c.biactive.clone(),
                        polynomial: c.polynomial.clone(),
                        interval: c.interval.clone(),
                        x: vec![Vec::new(); p.order()],
                    },
                ),
            },
            Claim::EnclosedSolution(c) => {
                let pencil = &reduced.pencil;
                let mut x = vec![Rational::default(); pencil.order()];
                let active = (0..pencil.order())
                    .filter(|i| pencil.free().binary_search(i).is_ok() || c.support.contains(i));
                active.zip(&c.center).for_each(|(i, n)| x[i] = n.0.clone());
                let value = c
                    .center
                    .last()
                    .map_or_else(Rational::default, |n| n.0.clone());
                of_point(problem, reduced, &c.support, value, &x)
            }
        }
    }

    /// From a solution that a cover has proved, with x in doubles: exact where `certify` makes an
    /// exact claim of it, digits of an enclosed claim else, and those of the doubles where there is
    /// no claim.
    pub fn of_cover(
        problem: &Problem,
        reduced: &Reduced,
        certifier: &Certifier<'_>,
        proved: &AcceptedClaim,
        x: &[f64],
    ) -> Listed {
        let candidate = Candidate {
            value: to_f64(&proved.value.mid()),
            x: x.to_vec(),
        };
        let claimed = certifier
            .certify_with_verdict(&candidate)
            .ok()
            .filter(|(_, verdict)| is_about(verdict, proved));

        let listed = match claimed {
            Some((claim, _)) => Listed::of_claim(problem, reduced, &claim),
            None => {
                let x: Vec<Rational> = x.iter().map(|v| from_f64(*v).unwrap_or_default()).collect();
                of_point(problem, reduced, &proved.support, proved.value.mid(), &x)
            }
        };
        Listed {
            enclosure: Some(enclosing_decimals(&proved.value, DIGITS).into()),
            ..listed
        }
    }
}

/// Is the claim about this solution of a cover, the only one with its support in its enclosure?
/// Surely so if the claim's values lie within it. Where they only overlap, the claim could be about
/// another solution near by.
fn is_about(claim: &AcceptedClaim, proved: &AcceptedClaim) -> bool {
    let is_within = proved.value.lo() <= claim.value.lo() && claim.value.hi() <= proved.value.hi();
    claim.support == proved.support && is_within
}

/// A solution known in rounded numbers only, x in any positive scale.
fn of_point(
    problem: &Problem,
    reduced: &Reduced,
    support: &[usize],
    value: Rational,
    x: &[Rational],
) -> Listed {
    let clear = common_denominator(x);
    let polys: Vec<Poly> = x
        .iter()
        .map(|v| Poly::constant(v.numer() * (&clear / v.denom())))
        .collect();

    let solution = Solution {
        value: Algebraic::rational(value),
        multiplicity: 1,
        slip: support.to_vec(),
        biactive: Vec::new(),
        x: polys,
        y: Vec::new(),
    };
    let norm = solution.normaliser(&reduced.pencil.slip());
    let listed = of_polynomials(
        problem,
        reduced,
        solution.value,
        support,
        &[],
        &solution.x,
        &norm,
    );
    Listed {
        exact: None,
        ..listed
    }
}

fn of_exact(problem: &Problem, reduced: &Reduced, claim: &Claim, c: &ExactSolution) -> Listed {
    // A claim made by `certify` has a valid interval; a foreign one prints its lower end.
    let value = exact_value(claim).unwrap_or_else(|| Algebraic::rational(c.interval[0].0.clone()));
    let x = integer_x(c);
    let slip = reduced.pencil.slip();
    let solution = Solution {
        value,
        multiplicity: 1,
        slip: c.support.clone(),
        biactive: c.biactive.clone(),
        x,
        y: Vec::new(),
    };
    let norm = solution.normaliser(&slip);
    of_polynomials(
        problem,
        reduced,
        solution.value,
        &c.support,
        &c.biactive,
        &solution.x,
        &norm,
    )
}

fn of_polynomials(
    problem: &Problem,
    reduced: &Reduced,
    mut value: Algebraic,
    slip: &[usize],
    biactive: &[usize],
    x: &[Poly],
    norm: &Poly,
) -> Listed {
    let ratio = |value: &mut Algebraic, p: &Poly, scale: &Integer| {
        ratio_to_decimal(value, p, &norm.scale(scale), DIGITS)
    };
    let one = Integer::from(1);
    let y = (0..reduced.pencil.order())
        .map(|i| {
            let (p, scale) = row_times(&reduced.pencil, i, x);
            ratio(&mut value, &p, &scale)
        })
        .collect();
    let lifted = match problem.body() {
        Body::Pencil(_) => None,
        Body::System(system) => {
            let l = lift(system, problem.unknown(), &reduced.variables, x);
            let v =
                l.v.iter()
                    .map(|p| ratio(&mut value, p, &l.v_scale))
                    .collect();
            let w =
                l.w.iter()
                    .map(|p| ratio(&mut value, p, &l.w_scale))
                    .collect();
            Some((v, w))
        }
    };
    let x = x.iter().map(|p| ratio(&mut value, p, &one)).collect();
    let interval = [value.interval().lo().clone(), value.interval().hi().clone()];
    let exact = Some((value.poly().coeffs().to_vec(), interval));
    let decimal = to_decimal(&mut value, &Poly::from_ints(&[0, 1]), DIGITS);
    Listed {
        value: decimal,
        enclosure: None,
        exact,
        slip: slip.to_vec(),
        biactive: biactive.to_vec(),
        x,
        y,
        lifted,
        kernel_dimension: 1,
        cone: None,
    }
}

/// Row i of (A + tB) x as an integer polynomial and the positive integer it was multiplied by.
fn row_times(pencil: &Pencil, i: usize, x: &[Poly]) -> (Poly, Integer) {
    let (a, b) = (pencil.a().row(i), pencil.b().row(i));
    let clear = common_denominator(a.iter().chain(b).map(|e| &e.1));
    let mut sum = Poly::default();
    for (m, power) in [(a, 0), (b, 1)] {
        for (j, v) in m {
            sum = &sum
                + &x[*j]
                    .scale(&(v.numer() * (&clear / v.denom())))
                    .shift(power);
        }
    }
    (sum, clear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reduction::reduce;
    use mceip_exact::{Interval, Sparse, rational, whole};
    use mceip_model::{Unknown, Window};

    /// [[1, -6], [2, -6]] + t I: t = 2 with x = (2, 1).
    fn listed(x: &[f64]) -> Listed {
        let pencil = Pencil::new(
            Sparse::from_ints(&[&[1, -6], &[2, -6]]),
            Sparse::identity(2),
            vec![],
        )
        .unwrap();
        let problem = Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap();
        let reduced = reduce(&problem).unwrap();
        let certifier = Certifier::new(&problem, &reduced.pencil);

        let value = Interval::new(
            whole(2) - rational(1, 1 << 20),
            whole(2) + rational(1, 1 << 20),
        )
        .unwrap();
        let proved = AcceptedClaim {
            support: vec![0, 1],
            value,
        };
        Listed::of_cover(&problem, &reduced, &certifier, &proved, x)
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

    /// A claim whose values reach out of the enclosure may be about a neighbour, and so may one
    /// with another support.
    #[test]
    fn a_claim_that_only_overlaps_is_not_taken() {
        let claim = |support: &[usize], a: i64, b: i64| AcceptedClaim {
            support: support.to_vec(),
            value: Interval::new(whole(a), whole(b)).unwrap(),
        };
        let proved = claim(&[0, 1], 4, 6);

        assert!(
            is_about(&claim(&[0, 1], 4, 6), &proved) && is_about(&claim(&[0, 1], 5, 5), &proved)
        );
        for other in [
            claim(&[0, 1], 3, 5),
            claim(&[0, 1], 5, 7),
            claim(&[0, 1], 3, 7),
            claim(&[0], 5, 5),
        ] {
            assert!(!is_about(&other, &proved), "{other:?}");
        }
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
