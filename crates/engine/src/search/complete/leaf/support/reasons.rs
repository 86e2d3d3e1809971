//! What one support holds at a value or around one, in exact arithmetic: a solution, or a Farkas
//! vector.
//!
//! J is the support, R the complementarity variables off it (`inactive`), and *active* are J and
//! the free variables. With V a basis of the kernel of T on the active rows, G z holds the rows of
//! V z that must be positive (x_J) and those of y = T V z that must not be negative. Either some z
//! has them so, or some mu >= 0, not zero on J, has mu'G = 0 (Motzkin). The latter gives the Farkas
//! vector: w_R is mu_R, and w on the active rows solves w'T = -mu_J.
//!
//! Called by the leaf `support`, which puts the reasons together. Where the kernel is wider than a
//! line, `alone` proves that a solution is the only one.

use super::circuit::{
    Extended, circuit_at, coefficients, combined, constants, generic_circuit, generic_ray, negated,
    primitive, sum,
};
use mceip_check::certificate::{Alone, Exact, Member, Polynomials};
use mceip_exact::{
    Algebraic, Dense, Generators, Integer, Poly, Rational, Sign, cone_generators, determinant,
    first_row_cofactors, generic_kernel, kernel_at, submatrix,
};
use mceip_model::Pencil;

/// Bits of the longest integer of the pencil times the active variables, at most: a minor of the
/// active rows is about as long, and its roots take as many halvings. Doubles of one scale take 64
/// bits each, a mixture of 1e300 and 1e-300 takes 2,000.
const MAX_MINOR_BITS: u64 = 4_096;

/// The pencil in integers, and one support.
pub(super) struct Supported {
    a: Vec<Vec<Integer>>,
    b: Vec<Vec<Integer>>,
    /// The variables of the support.
    pub(super) support: Vec<usize>,
    /// Those of the support, then the free ones.
    pub(super) active: Vec<usize>,
    pub(super) inactive: Vec<usize>,
    regular: Option<RegularExclusion>,
}

/// Of a regular pencil: weights that exclude every solution but at the roots of a polynomial.
struct RegularExclusion {
    weights: Exact,
    critical: Poly,
}

/// A reason that holds around a value, between the nearest roots of `critical`.
pub(super) struct Around {
    pub(super) reason: Exact,
    pub(super) critical: Vec<Poly>,
}

/// The kernel on the active rows.
pub(super) struct Kernel {
    /// V.
    pub(super) basis: Vec<Vec<Poly>>,
    /// G.
    pub(super) rows: Vec<Vec<Poly>>,
}

/// Where polynomials are looked at: at an algebraic number, or at a rational number that stands for
/// all values around it.
pub(super) enum Where<'a> {
    At(&'a Algebraic),
    Around(&'a Rational),
}

impl Where<'_> {
    pub(super) fn sign(&self, p: &Poly) -> Sign {
        match self {
            Where::At(value) => (*value).clone().sign_of(p),
            Where::Around(t) => Sign::from(p.sign_at(t)),
        }
    }

    fn kernel(&self, matrix: Vec<Vec<Poly>>) -> Vec<Vec<Poly>> {
        match self {
            Where::At(value) => kernel_at(matrix, &mut (*value).clone()),
            Where::Around(_) => generic_kernel(matrix).0,
        }
    }

    /// The same numbers by polynomials of lower degree, where there are such.
    fn reduced(&self, v: &[Poly]) -> Vec<Poly> {
        match self {
            Where::At(value) => value.reduce(v),
            Where::Around(_) => v.to_vec(),
        }
    }
}

impl Supported {
    /// `None` where the integers of the pencil are too long to decide a support of this size.
    pub(super) fn new(pencil: &Pencil, support: &[usize]) -> Option<Supported> {
        let [a, b] = [pencil.a(), pencil.b()].map(|matrix| matrix.to_dense());
        let [a, b] = Dense::clear_rows([&a, &b]);
        let active: Vec<usize> = support.iter().chain(pencil.free()).copied().collect();

        let entries = a.iter().chain(&b).flatten();
        let longest = entries.map(Integer::bits).max().unwrap_or(0);
        if longest.saturating_mul(active.len() as u64) > MAX_MINOR_BITS {
            return None;
        }

        let inactive = (0..a.len()).filter(|i| !active.contains(i)).collect();
        let mut supported = Supported {
            a,
            b,
            support: support.to_vec(),
            active,
            inactive,
            regular: None,
        };

        supported.regular = supported.regular();
        Some(supported)
    }

    /// The weights of a regular pencil: w'T = det e_1 on the active columns, nothing elsewhere.
    fn regular(&self) -> Option<RegularExclusion> {
        let determinant = self.minor(&self.active, &self.active);
        if determinant.is_zero() {
            return None;
        }

        let divided = Extended {
            vector: self.left_cofactors(&self.active, &self.active),
            more: determinant,
        }
        .primitive();
        Some(RegularExclusion {
            weights: Exact::None(self.over_all(&self.active, &divided.vector)),
            critical: divided.more,
        })
    }

    /// What there is at a value. `None` if the reasons here do not decide it.
    pub(super) fn at(&self, value: &mut Algebraic) -> Option<Exact> {
        if let Some(regular) = &self.regular
            && value.sign_of(&regular.critical) != Sign::Zero
        {
            return Some(regular.weights.clone());
        }

        let basis = match self.null_vector_at(value) {
            Some(vector) => vec![vector],
            None => self.null_vectors_at(value),
        };

        // One scale for all: mu and the basis refer to it.
        let rows = self.signed_rows(&basis);
        let kernel = Kernel { basis, rows };
        let cone = cone_generators(&kernel.rows, kernel.basis.len(), value);

        let x = sum(cone.rays.iter().map(|z| combined(&kernel.basis, z)));
        match x.filter(|x| self.is_positive(x, &Where::At(value))) {
            Some(x) => self.member_at(&x, &kernel, &cone, value),
            None => self.weights_at(&kernel, value),
        }
    }

    /// The null vector of a regular pencil on the active rows at a root of its determinant, up to
    /// a factor: the cofactors of the first row. `None` if all of them vanish there, because the
    /// other rows are dependent.
    fn null_vector_at(&self, value: &mut Algebraic) -> Option<Vec<Poly>> {
        self.regular.as_ref()?;
        let active = &self.active;
        let blocks = [&self.a, &self.b].map(|matrix| submatrix(matrix, active, active));
        let cofactors = value.reduce(&first_row_cofactors(&blocks));
        let is_any = cofactors.iter().any(|c| value.sign_of(c) != Sign::Zero);
        is_any.then_some(cofactors)
    }

    /// A basis of the kernel on the active rows.
    fn null_vectors_at(&self, value: &mut Algebraic) -> Vec<Vec<Poly>> {
        let mut basis = kernel_at(self.block(&self.active, &self.active), value);
        for vector in &mut basis {
            *vector = value.reduce(vector);
        }

        basis
    }

    /// A solution at a value. `cone` holds all z with G z >= 0 there.
    fn member_at(
        &self,
        x: &[Poly],
        kernel: &Kernel,
        cone: &Generators,
        value: &mut Algebraic,
    ) -> Option<Exact> {
        let is_one_ray = cone.rays.len() == 1 && cone.lineality.is_empty();
        let alone = if kernel.basis.len() == 1 {
            Some(self.alone(&Where::At(value))?.proof)
        } else if is_one_ray {
            let reduced = value.reduce(x);
            Some(self.alone_in_wide(&reduced, kernel, &cone.rays[0], value)?)
        } else {
            None
        };

        Some(self.member(&value.reduce(x), alone))
    }

    /// The Farkas vector at a value without a solution.
    fn weights_at(&self, kernel: &Kernel, value: &mut Algebraic) -> Option<Exact> {
        let strict = self.support.len();
        let mu = circuit_at(&kernel.rows, strict, kernel.basis.len(), value)?;

        let place = Where::At(value);
        let weights = self.weights(mu.split_at(strict), &place)?;
        let reduced = place.reduced(&weights);
        Some(Exact::None(Polynomials(coefficients(&reduced))))
    }

    /// What there is around a rational value, and where that ends. `None` if it is not a general
    /// value.
    pub(super) fn around(&self, t: &Rational) -> Option<Around> {
        if let Some(regular) = &self.regular {
            return Some(Around {
                reason: regular.weights.clone(),
                critical: vec![regular.critical.clone()],
            });
        }

        let (basis, _, pivot) = generic_kernel(self.block(&self.active, &self.active));
        if pivot.sign_at(t) == 0 {
            return None;
        }

        let rows = self.signed_rows(&basis);
        let kernel = Kernel { basis, rows };
        let mut here = Vec::with_capacity(kernel.rows.len());
        for row in &kernel.rows {
            here.push(constants(row, t));
        }

        let mut value = Algebraic::rational(t.clone());
        let cone = cone_generators(&here, kernel.basis.len(), &mut value);
        let mut rays = Vec::with_capacity(cone.rays.len());
        for z in &cone.rays {
            rays.push(generic_ray(&kernel.rows, &here, z, t)?);
        }

        let x = sum(rays.iter().map(|z| combined(&kernel.basis, z)));
        if let Some(x) = x.filter(|x| self.is_positive(x, &Where::Around(t))) {
            let only_ray = match &rays[..] {
                [z] if cone.lineality.is_empty() => Some(&z[..]),
                _ => None,
            };

            return self.member_around(x, &kernel, only_ray, t);
        }

        let strict = self.support.len();
        let mu = circuit_at(&here, strict, kernel.basis.len(), &mut value)?;
        let mu = generic_circuit(&kernel.rows, &mu, t)?;
        self.weights_around(&mu, t)
    }

    /// The Farkas vector that a circuit gives, and the polynomials whose signs it needs.
    fn weights_around(&self, mu: &[Poly], t: &Rational) -> Option<Around> {
        let on_support_and_inactive = mu.split_at(self.support.len());
        let mut w = primitive(self.weights(on_support_and_inactive, &Where::Around(t))?);
        let products = self.products(&w);
        let strict = products.iter().find(|p| p.sign_at(t) != 0)?;
        if strict.sign_at(t) > 0 {
            // The common factor was negative here.
            w = negated(&w);
        }

        let mut critical: Vec<Poly> = self.inactive.iter().map(|&i| w[i].clone()).collect();
        critical.extend(self.products(&w));
        critical.retain(|p| !p.is_zero());
        Some(Around {
            reason: Exact::None(Polynomials(coefficients(&w))),
            critical,
        })
    }

    /// A solution around a value. `only_ray` is the ray of the cone over the basis, where there is
    /// one only.
    fn member_around(
        &self,
        x: Vec<Poly>,
        kernel: &Kernel,
        only_ray: Option<&[Poly]>,
        t: &Rational,
    ) -> Option<Around> {
        let mut x = primitive(x);
        if x[0].sign_at(t) < 0 {
            x = negated(&x);
        }

        let mut critical: Vec<Poly> = x[..self.support.len()].to_vec();
        critical.extend(self.inactive.iter().map(|&i| self.row(i, &x)));

        let mut alone = None;
        if kernel.basis.len() == 1 {
            let found = self.alone(&Where::Around(t))?;
            critical.extend(found.lead);
            alone = Some(found.proof);
        } else if let Some(z) = only_ray {
            let found = self.alone_in_wide_around(&x, kernel, z, t)?;
            critical.extend(found.signs);
            alone = Some(found.proof);
        }

        critical.retain(|p| !p.is_zero());
        Some(Around {
            reason: self.member(&x, alone),
            critical,
        })
    }

    /// Is x positive on the support?
    fn is_positive(&self, x: &[Poly], place: &Where<'_>) -> bool {
        let on_support = &x[..self.support.len()];
        for component in on_support {
            if place.sign(component) != Sign::Positive {
                return false;
            }
        }

        true
    }

    fn member(&self, x: &[Poly], alone: Option<Alone>) -> Exact {
        Exact::Some(Box::new(Member {
            x: self.over_all(&self.active, x),
            alone,
        }))
    }

    /// The proof that x is the only one of a kernel of dimension one: weights on all rows but one,
    /// for each active column but the first. They are the inverse of a regular minor, up to its
    /// determinant.
    fn alone(&self, place: &Where<'_>) -> Option<AloneOnLine> {
        let pivot = self.support[0];
        let mut columns = without(&self.active, pivot);
        columns.sort_unstable();
        if columns.is_empty() {
            let rows = Vec::new();
            return Some(AloneOnLine {
                proof: Alone { pivot, rows },
                lead: None,
            });
        }

        let left_out = self.active.iter().copied().find(|&row| {
            let minor = self.minor(&without(&self.active, row), &columns);
            place.sign(&minor) != Sign::Zero
        })?;
        let rows = without(&self.active, left_out);
        let mut weights = Vec::new();
        for &own in &columns {
            let mut own_first = without(&columns, own);
            own_first.insert(0, own);
            let cofactors = place.reduced(&self.left_cofactors(&rows, &own_first));
            weights.push((own, self.over_all(&rows, &cofactors)));
        }

        Some(AloneOnLine {
            proof: Alone {
                pivot,
                rows: weights,
            },
            lead: Some(self.minor(&rows, &columns)),
        })
    }

    /// w with w_R = mu_R and w'T = -mu on the active columns, up to a positive factor. `mu` is that
    /// of the first active variables (the others have 0) and that of the inactive ones.
    pub(super) fn weights(&self, mu: (&[Poly], &[Poly]), place: &Where<'_>) -> Option<Vec<Poly>> {
        let (on_active, on_inactive) = mu;
        // The unknowns are w on the active rows and a common factor of mu.
        let mut equations = Vec::with_capacity(self.active.len());
        for (p, &j) in self.active.iter().enumerate() {
            let mut given = Poly::default();
            for (&i, m) in self.inactive.iter().zip(on_inactive) {
                given = &given + &(&self.entry(i, j) * m);
            }

            if let Some(m) = on_active.get(p) {
                given = &given + m;
            }

            let mut equation: Vec<Poly> = self.active.iter().map(|&i| self.entry(i, j)).collect();
            equation.push(given);
            equations.push(equation);
        }

        let mut solution = place
            .kernel(equations)
            .into_iter()
            .find(|v| v.last().is_some_and(|s| place.sign(s) != Sign::Zero))?;
        if solution
            .last()
            .is_some_and(|s| place.sign(s) == Sign::Negative)
        {
            solution = negated(&solution);
        }

        let factor = solution.pop()?;
        let mut w = vec![Poly::default(); self.a.len()];
        for (&i, v) in self.active.iter().zip(solution) {
            w[i] = v;
        }

        for (&i, m) in self.inactive.iter().zip(on_inactive) {
            w[i] = m * &factor;
        }

        Some(w)
    }

    /// The rows of G: x_J, then y off the active set.
    fn signed_rows(&self, basis: &[Vec<Poly>]) -> Vec<Vec<Poly>> {
        let mut rows = Vec::new();
        for p in 0..self.support.len() {
            rows.push(basis.iter().map(|v| v[p].clone()).collect());
        }

        for &i in &self.inactive {
            rows.push(basis.iter().map(|v| self.row(i, v)).collect());
        }

        rows
    }

    /// Row i of T times x over the active columns.
    fn row(&self, i: usize, x: &[Poly]) -> Poly {
        let mut sum = Poly::default();
        for (&j, x_j) in self.active.iter().zip(x) {
            sum = &sum + &(&self.entry(i, j) * x_j);
        }

        sum
    }

    /// w'T in column j.
    pub(super) fn column(&self, w: &[Poly], j: usize) -> Poly {
        let mut sum = Poly::default();
        for (i, w_i) in w.iter().enumerate() {
            sum = &sum + &(&self.entry(i, j) * w_i);
        }

        sum
    }

    /// w'T on the support.
    fn products(&self, w: &[Poly]) -> Vec<Poly> {
        let mut products = Vec::with_capacity(self.support.len());
        for &j in &self.support {
            products.push(self.column(w, j));
        }

        products
    }

    fn entry(&self, i: usize, j: usize) -> Poly {
        let constant = self.a[i][j].clone();
        let slope = self.b[i][j].clone();
        Poly::new(vec![constant, slope])
    }

    fn block(&self, rows: &[usize], columns: &[usize]) -> Vec<Vec<Poly>> {
        rows.iter()
            .map(|&i| columns.iter().map(|&j| self.entry(i, j)).collect())
            .collect()
    }

    fn minor(&self, rows: &[usize], columns: &[usize]) -> Poly {
        determinant(&[&self.a, &self.b].map(|matrix| submatrix(matrix, rows, columns)))
    }

    /// w on `rows` with w'T = det e_1 on `columns`.
    fn left_cofactors(&self, rows: &[usize], columns: &[usize]) -> Vec<Poly> {
        let transposed = |matrix| transposed_block(matrix, rows, columns);
        first_row_cofactors(&[transposed(&self.a), transposed(&self.b)])
    }

    /// A vector over these indices, over all variables of the pencil.
    pub(super) fn over_all(&self, indices: &[usize], v: &[Poly]) -> Polynomials {
        let mut all = vec![Poly::default(); self.a.len()];
        for (&i, p) in indices.iter().zip(v) {
            all[i] = p.clone();
        }

        Polynomials(coefficients(&all))
    }
}

/// The proof that a kernel of dimension one has one solution, and the minor that must not vanish.
struct AloneOnLine {
    proof: Alone,
    lead: Option<Poly>,
}

fn without(list: &[usize], left_out: usize) -> Vec<usize> {
    let mut kept = list.to_vec();
    kept.retain(|&i| i != left_out);
    kept
}

fn transposed_block(m: &[Vec<Integer>], rows: &[usize], columns: &[usize]) -> Vec<Vec<Integer>> {
    columns
        .iter()
        .map(|&j| rows.iter().map(|&i| m[i][j].clone()).collect())
        .collect()
}
