//! A solution ready to be printed: decimals of value, x, y, v and w, each correctly rounded.

use crate::certificate::{Claim, ExactSolution};
use crate::certify::flattened;
use crate::exact::{Algebraic, Integer, Poly, Rational, common_denominator, ratio_to_decimal, to_decimal};
use crate::model::{Body, Pencil, Problem};
use crate::multistart::exact_value;
use crate::oracle::{Cone, Enumeration, Solution};
use crate::reduction::{Reduced, lift};

/// Significant digits printed in reports.
pub(super) const DIGITS: usize = 17;

/// One solution in decimals.
#[derive(Debug, Clone)]
pub struct Listed {
    /// Value of the unknown.
    pub value: String,
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
        of_polynomials(problem, reduced, s.value.clone(), &s.slip, &s.biactive, &s.x, &norm)
    }

    /// Solutions and cones of the enumerator in one list, by value, then by slip set.
    pub fn of_enumeration(problem: &Problem, reduced: &Reduced, found: &Enumeration) -> Vec<Listed> {
        let solutions = found.solutions.iter().map(|s| {
            let kernel_dimension = found.kernel_dimension(s);
            (&s.value, &s.slip, Listed { kernel_dimension, ..Listed::of_solution(problem, reduced, s) })
        });
        let cones = found.cones.iter().map(|c| (&c.value, &c.slip, Listed::of_cone(problem, reduced, c)));
        let mut all: Vec<_> = solutions.chain(cones).collect();
        all.sort_by(|a, b| a.0.clone().cmp_exact(&mut b.0.clone()).then_with(|| a.1.cmp(b.1)));
        all.into_iter().map(|entry| entry.2).collect()
    }

    /// From a cone of the enumerator: `x` is the mean of its rays.
    pub fn of_cone(problem: &Problem, reduced: &Reduced, cone: &Cone) -> Listed {
        let center = cone.center(&reduced.pencil.slip());
        let lineality = cone.lineality.iter().map(|x| {
            // No slip variable: the normaliser is the l1 norm.
            let direction = Solution { slip: Vec::new(), x: x.clone(), ..center.clone() };
            direction.x_decimals(&[], DIGITS)
        });
        let listed = ListedCone {
            dimension: cone.dimension,
            rays: cone.rays.iter().map(|r| Listed::of_solution(problem, reduced, r)).collect(),
            lineality: lineality.collect(),
        };
        let entry = Listed::of_solution(problem, reduced, &center);
        Listed { kernel_dimension: cone.kernel_dimension, cone: Some(listed), ..entry }
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
                let active = (0..pencil.order()).filter(|i| pencil.free().binary_search(i).is_ok() || c.support.contains(i));
                active.zip(&c.center).for_each(|(i, n)| x[i] = n.0.clone());
                let value = c.center.last().map_or_else(Rational::default, |n| n.0.clone());
                let clear = common_denominator(&x);
                let polys: Vec<Poly> = x.iter().map(|v| Poly::constant(v.numer() * (&clear / v.denom()))).collect();
                let norm = Poly::constant(clear);
                let mut listed = of_polynomials(problem, reduced, Algebraic::rational(value), &c.support, &[], &polys, &norm);
                listed.exact = None;
                listed
            }
        }
    }
}

fn of_exact(problem: &Problem, reduced: &Reduced, claim: &Claim, c: &ExactSolution) -> Listed {
    // A claim made by `certify` has a valid interval; a foreign one prints its lower end.
    let value = exact_value(claim).unwrap_or_else(|| Algebraic::rational(c.interval[0].0.clone()));
    let clear = common_denominator(c.x.iter().flatten().map(|n| &n.0));
    let x: Vec<Poly> = c.x.iter().map(|p| Poly::new(p.iter().map(|n| n.0.numer() * (&clear / n.0.denom())).collect())).collect();
    let slip = reduced.pencil.slip();
    let solution = Solution { value, multiplicity: 1, slip: c.support.clone(), biactive: c.biactive.clone(), x, y: Vec::new() };
    let norm = solution.normaliser(&slip);
    of_polynomials(problem, reduced, solution.value, &c.support, &c.biactive, &solution.x, &norm)
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
    let ratio = |value: &mut Algebraic, p: &Poly, scale: &Integer| ratio_to_decimal(value, p, &norm.scale(scale), DIGITS);
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
            let v = l.v.iter().map(|p| ratio(&mut value, p, &l.v_scale)).collect();
            let w = l.w.iter().map(|p| ratio(&mut value, p, &l.w_scale)).collect();
            Some((v, w))
        }
    };
    let x = x.iter().map(|p| ratio(&mut value, p, &one)).collect();
    let interval = [value.interval().lo().clone(), value.interval().hi().clone()];
    let exact = Some((value.poly().coeffs().to_vec(), interval));
    let decimal = to_decimal(&mut value, &Poly::from_ints(&[0, 1]), DIGITS);
    Listed { value: decimal, exact, slip: slip.to_vec(), biactive: biactive.to_vec(), x, y, lifted, kernel_dimension: 1, cone: None }
}

/// Row i of (A + tB) x as an integer polynomial and the positive integer it was multiplied by.
fn row_times(pencil: &Pencil, i: usize, x: &[Poly]) -> (Poly, Integer) {
    let (a, b) = (pencil.a().row(i), pencil.b().row(i));
    let clear = common_denominator(a.iter().chain(b).map(|e| &e.1));
    let mut sum = Poly::default();
    for (m, power) in [(a, 0), (b, 1)] {
        for (j, v) in m {
            sum = &sum + &x[*j].scale(&(v.numer() * (&clear / v.denom()))).shift(power);
        }
    }
    (sum, clear)
}
