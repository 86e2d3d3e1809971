//! A solution that is the only one though the kernel is wide: the inequalities y >= 0 single it
//! out.
//!
//! Let x be a solution with the pivot k in its support, and j another active variable. If
//! x_k e_j - x_j e_k and its negative are, on the kernel, combinations with mu >= 0 of rows of G
//! that vanish at x, then every solution has x_k x'_j = x_j x'_k. With one pair of weights for each
//! j the checker sees that (`certificate::Alone`). Called by `reasons`.

use super::circuit::{circuit_at, coefficients, constants, generic_circuit, negated, unit};
use super::reasons::{Kernel, Supported, Where};
use mceip_check::certificate::{Alone, Polynomials};
use mceip_exact::{Algebraic, Poly, Rational, Sign, cone_generators, dot};

/// The proof around a value, and the polynomials whose signs it needs.
pub(super) struct AloneAround {
    pub(super) proof: Alone,
    pub(super) signs: Vec<Poly>,
}

/// The direction x_k e_p - x_p e_k or its negative, k being the first active variable.
#[derive(Clone, Copy)]
struct SignedDirection {
    /// Place of p among the active variables.
    place: usize,
    is_negative: bool,
}

impl SignedDirection {
    /// Both directions for every active variable but the first.
    fn all(active: usize) -> Vec<SignedDirection> {
        let mut directions = Vec::new();
        for place in 1..active {
            for is_negative in [false, true] {
                directions.push(SignedDirection { place, is_negative });
            }
        }

        directions
    }

    fn signed(self, p: Poly) -> Poly {
        if self.is_negative { -&p } else { p }
    }

    /// The direction's product with v.
    fn product(self, x: &[Poly], v: &[Poly]) -> Poly {
        let p = self.place;
        let first = &x[0] * &v[p];
        let second = &x[p] * &v[0];
        self.signed(&first - &second)
    }
}

impl Supported {
    /// The proof at a value that x, which belongs to the ray z, is the only solution.
    pub(super) fn alone_in_wide(
        &self,
        x: &[Poly],
        kernel: &Kernel,
        z: &[Poly],
        value: &mut Algebraic,
    ) -> Option<Alone> {
        let mut tight = Vec::new();
        for (r, row) in kernel.rows.iter().enumerate() {
            if value.sign_of(&dot(row, z)) == Sign::Zero {
                tight.push(r);
            }
        }

        let mut weights = Vec::new();
        for direction in SignedDirection::all(self.active.len()) {
            let ray = combination_at(x, kernel, &tight, direction, value)?;
            let (of_tight_rows, factor) = ray.split_at(tight.len());
            let given = (&tight[..], of_tight_rows);
            let mu = self.multipliers(x, direction, &factor[0], given);

            let place = Where::At(value);
            let l = self.weights(mu.split_at(self.active.len()), &place)?;
            let l = value.reduce(&l);
            let variable = self.active[direction.place];
            weights.push((variable, Polynomials(coefficients(&l))));
        }

        Some(Alone {
            pivot: self.support[0],
            rows: weights,
        })
    }

    /// The same around a rational value.
    pub(super) fn alone_in_wide_around(
        &self,
        x: &[Poly],
        kernel: &Kernel,
        z: &[Poly],
        t: &Rational,
    ) -> Option<AloneAround> {
        let tight: Vec<usize> = (0..kernel.rows.len())
            .filter(|&r| dot(&kernel.rows[r], z).is_zero())
            .collect();

        let mut weights = Vec::new();
        let mut signs = Vec::new();
        for direction in SignedDirection::all(self.active.len()) {
            let circuit = combination_around(x, kernel, &tight, direction, t)?;
            let (factor, of_tight_rows) = circuit.split_at(1);
            let given = (&tight[..], of_tight_rows);
            let mu = self.multipliers(x, direction, &factor[0], given);

            let l = self.weights(mu.split_at(self.active.len()), &Where::Around(t))?;
            let variable = self.active[direction.place];
            signs.extend(self.inactive.iter().map(|&i| l[i].clone()));
            signs.push(self.column(&l, variable));
            weights.push((variable, Polynomials(coefficients(&l))));
        }

        Some(AloneAround {
            proof: Alone {
                pivot: self.support[0],
                rows: weights,
            },
            signs,
        })
    }

    /// The mu of [`Supported::weights`] that makes w'T `factor` times the direction on the active
    /// columns. `tight` are rows of G and their multipliers.
    fn multipliers(
        &self,
        x: &[Poly],
        direction: SignedDirection,
        factor: &Poly,
        tight: (&[usize], &[Poly]),
    ) -> Vec<Poly> {
        let p = direction.place;
        let length = self.active.len() + self.inactive.len();
        let mut mu = vec![Poly::default(); length];

        let at_first = factor * &x[p];
        let at_place = factor * &x[0];
        mu[0] = direction.signed(at_first);
        mu[p] = direction.signed(-&at_place);

        // Tight rows are rows of y: rows of x do not vanish on the support.
        let (rows, multipliers) = tight;
        for (&row, m) in rows.iter().zip(multipliers) {
            let place = self.active.len() + row - self.support.len();
            mu[place] = m.clone();
        }

        mu
    }
}

/// mu and s > 0 with mu'G = s direction on the kernel, G being the tight rows; s comes last.
fn combination_at(
    x: &[Poly],
    kernel: &Kernel,
    tight: &[usize],
    direction: SignedDirection,
    value: &mut Algebraic,
) -> Option<Vec<Poly>> {
    let unknowns = tight.len() + 1;
    let mut conditions: Vec<Vec<Poly>> = Vec::new();
    for (k, v) in kernel.basis.iter().enumerate() {
        let mut column: Vec<Poly> = tight.iter().map(|&r| kernel.rows[r][k].clone()).collect();
        column.push(-&direction.product(x, v));
        let column = value.reduce(&column);
        conditions.push(negated(&column));
        conditions.push(column);
    }

    for k in 0..unknowns {
        conditions.push(unit(unknowns, k));
    }

    let rays = cone_generators(&conditions, unknowns, value).rays;
    rays.into_iter()
        .find(|ray| value.sign_of(&ray[tight.len()]) == Sign::Positive)
}

/// The same around a value; s comes first.
fn combination_around(
    x: &[Poly],
    kernel: &Kernel,
    tight: &[usize],
    direction: SignedDirection,
    t: &Rational,
) -> Option<Vec<Poly>> {
    // Rows with mu'rows = 0, mu >= 0: minus the direction first, then what vanishes at x.
    let mut rows: Vec<Vec<Poly>> = Vec::new();
    rows.push(
        kernel
            .basis
            .iter()
            .map(|v| -&direction.product(x, v))
            .collect(),
    );
    rows.extend(tight.iter().map(|&r| kernel.rows[r].clone()));

    let here: Vec<Vec<Poly>> = rows.iter().map(|row| constants(row, t)).collect();
    let mut value = Algebraic::rational(t.clone());
    let circuit = circuit_at(&here, 1, kernel.basis.len(), &mut value)?;
    generic_circuit(&rows, &circuit, t)
}
