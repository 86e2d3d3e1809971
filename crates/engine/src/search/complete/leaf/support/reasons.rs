//! What one support holds at a value or around one, in exact arithmetic: a solution, or a Farkas
//! vector.
//!
//! With V a basis of the kernel on the active rows, G z holds the rows of V z that must be positive
//! (x_J) and those of y = T V z that must not be negative. Either some z has them so, or some mu >=
//! 0, not zero on J, has mu'G = 0 (Motzkin); the latter is w_R, and w on the active rows solves w'T
//! = -mu_J.

use crate::search::complete::leaf::support::circuit::{
    coefficients, combined, constants, divided, extended, generic_circuit, impossible,
};
use mceip_check::certificate::{Alone, Exact, Member, Polynomials};
use mceip_exact::{
    Algebraic, Integer, Poly, Rational, Sign, cone_generators, determinant, first_row_cofactors,
    generic_kernel, kernel_at,
};
use mceip_model::Pencil;

/// The pencil in integers, and one support.
pub(crate) struct Supported {
    pub(super) a: Vec<Vec<Integer>>,
    pub(super) b: Vec<Vec<Integer>>,
    pub(super) moving: Vec<usize>,
    /// Moving, then free.
    pub(super) active: Vec<usize>,
    pub(super) rest: Vec<usize>,
    /// If the pencil is regular: a vector that excludes all but the roots of a polynomial.
    pub(super) regular: Option<(Exact, Poly)>,
}

/// A reason that holds around a value, between the nearest roots of `critical`.
pub(crate) struct Around {
    pub(crate) reason: Exact,
    pub(crate) critical: Vec<Poly>,
}

/// Bits of the longest integer of the pencil times the active variables, at most: a minor of the
/// active rows is about as long, and its roots take as many halvings. Doubles of one scale take 64
/// bits each, a mixture of 1e300 and 1e-300 takes 2,000.
const MAX_MINOR_BITS: u64 = 4_096;

impl Supported {
    /// `None` where the integers of the pencil are too long to decide a support of this size.
    pub(crate) fn new(pencil: &Pencil, moving: &[usize]) -> Option<Supported> {
        let (a, b) = pencil.a().to_dense().clear_rows(&pencil.b().to_dense());
        let active: Vec<usize> = moving.iter().chain(pencil.free()).copied().collect();

        let longest = a
            .iter()
            .chain(&b)
            .flatten()
            .map(Integer::bits)
            .max()
            .unwrap_or(0);
        if longest.saturating_mul(active.len() as u64) > MAX_MINOR_BITS {
            return None;
        }

        let rest = (0..a.len()).filter(|i| !active.contains(i)).collect();
        let mut new = Supported {
            a,
            b,
            moving: moving.to_vec(),
            active,
            rest,
            regular: None,
        };
        let det = new.minor(&new.active, &new.active);
        if !det.is_zero() {
            let w = new.left_cofactors(&new.active, &new.active);
            let (w, critical) = divided(w, det);
            new.regular = Some((Exact::None(new.over_all(&new.active, &w)), critical));
        }
        Some(new)
    }

    /// What there is at a value. `None` if the reasons here do not decide it.
    pub(crate) fn at(&self, value: &mut Algebraic) -> Option<Exact> {
        if let Some((reason, critical)) = &self.regular
            && value.sign_of(critical) != Sign::Zero
        {
            return Some(reason.clone());
        }
        let basis: Vec<Vec<Poly>> = kernel_at(self.block(&self.active, &self.active), value)
            .iter()
            .map(|v| value.reduce(v))
            .collect();
        let rows = self.signed_rows(&basis); // one scale for all: mu and the basis refer to it
        let cone = cone_generators(&rows, basis.len(), value);
        let sum = cone
            .rays
            .iter()
            .map(|z| combined(&basis, z))
            .reduce(|s, x| s.iter().zip(&x).map(|(a, b)| a + b).collect());
        let positive = |x: &Vec<Poly>| {
            (0..self.moving.len()).all(|p| value.clone().sign_of(&x[p]) == Sign::Positive)
        };
        if let Some(x) = sum.filter(positive) {
            let is_line = basis.len() == 1;
            let mut probe = value.clone();
            let alone = if is_line {
                Some(
                    self.alone(&mut |p| probe.sign_of(p) != Sign::Zero, &|v| {
                        value.reduce(v)
                    })?
                    .0,
                )
            } else if cone.rays.len() == 1 && cone.lineality.is_empty() {
                Some(self.alone_in_wide(&value.reduce(&x), &basis, &rows, &cone.rays[0], value)?)
            } else {
                None
            };
            return Some(self.member(&value.reduce(&x), alone));
        }
        let mu = impossible(&rows, self.moving.len(), basis.len(), value)?;
        let solve = |m: Vec<Vec<Poly>>| kernel_at(m, &mut value.clone());
        let w = self.weights(&mu, &solve, &|s| value.clone().sign_of(s))?;
        Some(Exact::None(Polynomials(coefficients(&value.reduce(&w)))))
    }

    /// What there is around a rational value, and where that ends. `None` if it is not a general
    /// value.
    pub(crate) fn around(&self, t: &Rational) -> Option<Around> {
        if let Some((reason, critical)) = &self.regular {
            return Some(Around {
                reason: reason.clone(),
                critical: vec![critical.clone()],
            });
        }
        let (basis, _, pivot) = generic_kernel(self.block(&self.active, &self.active));
        if pivot.sign_at(t) == 0 {
            return None;
        }
        let rows = self.signed_rows(&basis);
        let here: Vec<Vec<Poly>> = rows.iter().map(|r| constants(r, t)).collect();
        let mut value = Algebraic::rational(t.clone());
        let cone = cone_generators(&here, basis.len(), &mut value);
        let all: Option<Vec<Vec<Poly>>> = cone
            .rays
            .iter()
            .map(|z| extended(&rows, &here, z, t))
            .collect();
        let all = all?;
        let sum = all
            .iter()
            .map(|z| combined(&basis, z))
            .reduce(|s, x| s.iter().zip(&x).map(|(a, b)| a + b).collect());
        if let Some(x) = sum.filter(|x| (0..self.moving.len()).all(|p| x[p].sign_at(t) > 0)) {
            let only = if let [z] = &all[..] {
                Some(&z[..]).filter(|_| cone.lineality.is_empty())
            } else {
                None
            };
            return self.member_around(x, &basis, &rows, only, t);
        }
        let mu = impossible(&here, self.moving.len(), basis.len(), &mut value)?;
        let mu = generic_circuit(&rows, &mu, t)?;
        let solve = |m: Vec<Vec<Poly>>| generic_kernel(m).0;
        let sign = |s: &Poly| Sign::from(s.sign_at(t));
        let w = self.weights(&mu, &solve, &sign)?;
        let (mut w, _) = divided(w, Poly::default());
        let products =
            |w: &[Poly]| -> Vec<Poly> { self.moving.iter().map(|&j| self.column(w, j)).collect() };
        let strict = products(&w).into_iter().find(|p| p.sign_at(t) != 0)?;
        if strict.sign_at(t) > 0 {
            w = w.iter().map(|p| -p).collect(); // the common factor was negative here
        }
        let critical = self
            .rest
            .iter()
            .map(|&i| w[i].clone())
            .chain(products(&w))
            .filter(|p| !p.is_zero())
            .collect();
        Some(Around {
            reason: Exact::None(Polynomials(coefficients(&w))),
            critical,
        })
    }

    /// `only`: the ray of the cone over the basis, where it is the only one.
    fn member_around(
        &self,
        x: Vec<Poly>,
        basis: &[Vec<Poly>],
        rows: &[Vec<Poly>],
        only: Option<&[Poly]>,
        t: &Rational,
    ) -> Option<Around> {
        let (mut x, _) = divided(x, Poly::default());
        if x[0].sign_at(t) < 0 {
            x = x.iter().map(|p| -p).collect();
        }
        let mut critical: Vec<Poly> = x[..self.moving.len()].to_vec();
        critical.extend(self.rest.iter().map(|&i| self.row(i, &x)));
        let mut alone = None;
        if basis.len() == 1 {
            let (proof, lead) = self.alone(&mut |p| p.sign_at(t) != 0, &|v| v.to_vec())?;
            critical.extend(lead);
            alone = Some(proof);
        } else if let Some(z) = only {
            let (proof, signs) = self.alone_in_wide_around(&x, basis, rows, z, t)?;
            critical.extend(signs);
            alone = Some(proof);
        }
        critical.retain(|p| !p.is_zero());
        Some(Around {
            reason: self.member(&x, alone),
            critical,
        })
    }

    fn member(&self, x: &[Poly], alone: Option<Alone>) -> Exact {
        Exact::Some(Box::new(Member {
            x: self.over_all(&self.active, x),
            alone,
        }))
    }

    /// Weights on all rows but one, for each active column but the first: the inverse of a regular
    /// minor, up to its determinant, which is given too.
    fn alone(
        &self,
        is_nonzero: &mut dyn FnMut(&Poly) -> bool,
        reduce: &dyn Fn(&[Poly]) -> Vec<Poly>,
    ) -> Option<(Alone, Option<Poly>)> {
        let without = |list: &[usize], k: usize| -> Vec<usize> {
            list.iter().copied().filter(|&i| i != k).collect()
        };
        let pivot = self.moving[0];
        let mut columns = without(&self.active, pivot);
        columns.sort_unstable();
        if columns.is_empty() {
            return Some((
                Alone {
                    pivot,
                    rows: Vec::new(),
                },
                None,
            ));
        }
        let fit = |&left: &usize| is_nonzero(&self.minor(&without(&self.active, left), &columns));
        let left = self.active.iter().copied().find(fit)?;
        let rows = without(&self.active, left);
        let weights = columns.iter().map(|&own| {
            let mut order = without(&columns, own);
            order.insert(0, own);
            (
                own,
                self.over_all(&rows, &reduce(&self.left_cofactors(&rows, &order))),
            )
        });
        Some((
            Alone {
                pivot,
                rows: weights.collect(),
            },
            Some(self.minor(&rows, &columns)),
        ))
    }

    /// w with w_R = mu_R and w'T = -mu_J on the active columns, up to a positive factor.
    fn weights(
        &self,
        mu: &[Poly],
        solve: &dyn Fn(Vec<Vec<Poly>>) -> Vec<Vec<Poly>>,
        sign: &dyn Fn(&Poly) -> Sign,
    ) -> Option<Vec<Poly>> {
        self.weights_for(mu.split_at(self.moving.len()), solve, sign)
    }

    pub(super) fn weights_for(
        &self,
        (on_moving, on_rest): (&[Poly], &[Poly]),
        solve: &dyn Fn(Vec<Vec<Poly>>) -> Vec<Vec<Poly>>,
        sign: &dyn Fn(&Poly) -> Sign,
    ) -> Option<Vec<Poly>> {
        let equation = |(p, &j): (usize, &usize)| {
            let mut row: Vec<Poly> = self.active.iter().map(|&i| self.entry(i, j)).collect();
            let given = self
                .rest
                .iter()
                .zip(on_rest)
                .fold(Poly::default(), |s, (&i, m)| &s + &(&self.entry(i, j) * m));
            row.push(on_moving.get(p).map_or(given.clone(), |m| &given + m));
            row
        };
        let solutions = solve(self.active.iter().enumerate().map(equation).collect());
        let mut solution = solutions
            .into_iter()
            .find(|v| v.last().is_some_and(|s| sign(s) != Sign::Zero))?;
        if solution.last().is_some_and(|s| sign(s) == Sign::Negative) {
            solution = solution.iter().map(|p| -p).collect();
        }
        let scale = solution.pop()?;
        let mut w = vec![Poly::default(); self.a.len()];
        self.active
            .iter()
            .zip(solution)
            .for_each(|(&i, v)| w[i] = v);
        self.rest
            .iter()
            .zip(on_rest)
            .for_each(|(&i, m)| w[i] = m * &scale);
        Some(w)
    }

    /// The rows of G: x_J, then y off the active set.
    fn signed_rows(&self, basis: &[Vec<Poly>]) -> Vec<Vec<Poly>> {
        let x = (0..self.moving.len()).map(|p| basis.iter().map(|v| v[p].clone()).collect());
        x.chain(
            self.rest
                .iter()
                .map(|&i| basis.iter().map(|v| self.row(i, v)).collect()),
        )
        .collect()
    }

    /// Row i of T times x over the active columns.
    pub(super) fn row(&self, i: usize, x: &[Poly]) -> Poly {
        self.active
            .iter()
            .zip(x)
            .fold(Poly::default(), |s, (&j, x_j)| {
                &s + &(&self.entry(i, j) * x_j)
            })
    }

    /// w'T in column j.
    pub(super) fn column(&self, w: &[Poly], j: usize) -> Poly {
        w.iter().enumerate().fold(Poly::default(), |s, (i, w_i)| {
            &s + &(&self.entry(i, j) * w_i)
        })
    }

    fn entry(&self, i: usize, j: usize) -> Poly {
        Poly::new(vec![self.a[i][j].clone(), self.b[i][j].clone()])
    }

    fn block(&self, rows: &[usize], columns: &[usize]) -> Vec<Vec<Poly>> {
        rows.iter()
            .map(|&i| columns.iter().map(|&j| self.entry(i, j)).collect())
            .collect()
    }

    fn minor(&self, rows: &[usize], columns: &[usize]) -> Poly {
        let of = |m: &[Vec<Integer>]| -> Vec<Vec<Integer>> {
            rows.iter()
                .map(|&i| columns.iter().map(|&j| m[i][j].clone()).collect())
                .collect()
        };
        determinant(&of(&self.a), &of(&self.b))
    }

    /// w on `rows` with w'T = det e_1 on `columns`.
    fn left_cofactors(&self, rows: &[usize], columns: &[usize]) -> Vec<Poly> {
        let of = |m: &[Vec<Integer>]| -> Vec<Vec<Integer>> {
            columns
                .iter()
                .map(|&j| rows.iter().map(|&i| m[i][j].clone()).collect())
                .collect()
        };
        first_row_cofactors(&of(&self.a), &of(&self.b))
    }

    fn over_all(&self, indices: &[usize], v: &[Poly]) -> Polynomials {
        let mut all = vec![Poly::default(); self.a.len()];
        indices.iter().zip(v).for_each(|(&i, p)| all[i] = p.clone());
        Polynomials(coefficients(&all))
    }
}
