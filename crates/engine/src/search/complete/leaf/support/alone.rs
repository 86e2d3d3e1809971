//! A solution that is alone though the kernel is wide: the inequalities y >= 0 single it out.

use crate::search::complete::leaf::support::circuit::{
    coefficients, constants, generic_circuit, impossible,
};
use crate::search::complete::leaf::support::reasons::Supported;
use mceip_check::certificate::{Alone, Polynomials};
use mceip_exact::{
    Algebraic, Poly, Rational, Sign, cone_generators, dot, generic_kernel, kernel_at,
};

impl Supported {
    /// Where the inequalities y >= 0 make x the only one of a wide kernel: +-(x_k e_j - x_j e_k) is
    /// on the kernel a combination with mu >= 0 of rows of G that vanish at x.
    pub(crate) fn alone_in_wide(
        &self,
        x: &[Poly],
        basis: &[Vec<Poly>],
        rows: &[Vec<Poly>],
        z: &[Poly],
        value: &mut Algebraic,
    ) -> Option<Alone> {
        let mut out = Vec::new();
        let tight: Vec<usize> = (0..rows.len())
            .filter(|&r| value.sign_of(&dot(&rows[r], z)) == Sign::Zero)
            .collect();
        for (p, sign) in (1..self.active.len()).flat_map(|p| [(p, 1), (p, -1)]) {
            let signed = |v: Poly| if sign > 0 { v } else { -&v };
            let target = |v: &[Poly]| signed(&(&x[0] * &v[p]) - &(&x[p] * &v[0]));
            // Unknowns mu and s: mu'G = s target.
            let mut conditions: Vec<Vec<Poly>> = Vec::new();
            for (k, v) in basis.iter().enumerate() {
                let mut column: Vec<Poly> = tight.iter().map(|&r| rows[r][k].clone()).collect();
                column.push(-&target(v));
                let column = value.reduce(&column);
                conditions.push(column.iter().map(|c| -c).collect());
                conditions.push(column);
            }
            let n = tight.len() + 1;
            conditions.extend((0..n).map(|k| {
                (0..n)
                    .map(|i| Poly::from_ints(&[i64::from(i == k)]))
                    .collect()
            }));
            let rays = cone_generators(&conditions, n, value).rays;
            let ray = rays
                .into_iter()
                .find(|r| value.sign_of(&r[n - 1]) == Sign::Positive)?;
            // w'T = -mu on the active columns is what `weights` solves.
            let mut mu = vec![Poly::default(); self.active.len() + self.rest.len()];
            mu[0] = signed(&ray[n - 1] * &x[p]);
            mu[p] = signed(-&(&ray[n - 1] * &x[0]));
            for (&r, m) in tight.iter().zip(&ray) {
                mu[self.active.len() + r - self.moving.len()] = m.clone();
            }
            let solve = |m: Vec<Vec<Poly>>| kernel_at(m, &mut value.clone());
            let l = self.weights_for(mu.split_at(self.active.len()), &solve, &|s| {
                value.clone().sign_of(s)
            })?;
            out.push((self.active[p], Polynomials(coefficients(&value.reduce(&l)))));
        }
        Some(Alone {
            pivot: self.moving[0],
            rows: out,
        })
    }

    /// The same around a rational value, and the polynomials whose signs it needs. z: the ray x
    /// belongs to, over the basis.
    pub(crate) fn alone_in_wide_around(
        &self,
        x: &[Poly],
        basis: &[Vec<Poly>],
        rows: &[Vec<Poly>],
        z: &[Poly],
        t: &Rational,
    ) -> Option<(Alone, Vec<Poly>)> {
        let (mut out, mut signs) = (Vec::new(), Vec::new());
        let tight: Vec<usize> = (0..rows.len())
            .filter(|&r| dot(&rows[r], z).is_zero())
            .collect();
        for (p, sign) in (1..self.active.len()).flat_map(|p| [(p, 1), (p, -1)]) {
            let signed = |v: Poly| if sign > 0 { v } else { -&v };
            // Rows with mu'rows = 0, mu >= 0: minus the target first, then what vanishes at x.
            let target = basis
                .iter()
                .map(|v| signed(&(&x[p] * &v[0]) - &(&x[0] * &v[p])))
                .collect();
            let all: Vec<Vec<Poly>> = std::iter::once(target)
                .chain(tight.iter().map(|&r| rows[r].clone()))
                .collect();
            let here: Vec<Vec<Poly>> = all.iter().map(|r| constants(r, t)).collect();
            let circuit = impossible(&here, 1, basis.len(), &mut Algebraic::rational(t.clone()))?;
            let circuit = generic_circuit(&all, &circuit, t)?;
            let mut mu = vec![Poly::default(); self.active.len() + self.rest.len()];
            mu[0] = signed(&circuit[0] * &x[p]);
            mu[p] = signed(-&(&circuit[0] * &x[0]));
            for (&r, m) in tight.iter().zip(&circuit[1..]) {
                mu[self.active.len() + r - self.moving.len()] = m.clone();
            }
            let solve = |m: Vec<Vec<Poly>>| generic_kernel(m).0;
            let l = self.weights_for(mu.split_at(self.active.len()), &solve, &|s| {
                Sign::from(s.sign_at(t))
            })?;
            signs.extend(
                self.rest
                    .iter()
                    .map(|&i| l[i].clone())
                    .chain([self.column(&l, self.active[p])]),
            );
            out.push((self.active[p], Polynomials(coefficients(&l))));
        }
        Some((
            Alone {
                pivot: self.moving[0],
                rows: out,
            },
            signs,
        ))
    }
}
