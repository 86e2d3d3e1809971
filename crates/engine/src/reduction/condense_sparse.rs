//! Condensation to the slip particles in doubles, for meshes of any size.
//!
//! Let Z(t) be the Schur complement of K + t M on the dofs of the slip particles, all other dofs
//! eliminated or held. It is what remains of a sparse Cholesky factorisation in which the dofs of
//! the slip particles come last. With the unit tangents t_p, the unit normals n_p into the
//! obstacle and the signs S_p of (10),
//!
//!   A_pq(t) = S_p t_p' Z(t) t_q S_q,   B_pq(t) = n_p' Z(t) t_q S_q,
//!
//! which is (16) with x_f eliminated. So T(t) = A(t) + mu B(t) is MCEIP-lambda2 condensed to order
//! n_s, and A(0), B(0) are the pencil of MCEIP-mu.
//!
//! In general a variable x_p moves its particle along d_p and is paired with the row of d_p' w +
//! mu e_p' w, where d_p = -S_p t_p and e_p = -c_p n_p for a slip particle: A_pq = d_p' Z d_q,
//! B_pq = e_p' Z d_q. A particle with zero reaction has three variables (`spec/zero-reaction.md`,
//! Z.3): d = -n, t, -t and e = 0, -c n, -c n. [`SparseCondensation::with_zero`] admits them.
//!
//! Input: K and M as sparse symmetric matrices, the particles with their contact states. K + t M
//! must be positive definite on f, or [`SparseCondensation::at`] says that it is not. Output: A and
//! B in doubles, the lift of x to all dofs, and a measurement of the error. Called by
//! [`CondensedEmbedding`](super::CondensedEmbedding), which `multistart` solves, and by `mceip
//! block` for large meshes. All results are proposals: exact arithmetic decides later.
#![allow(clippy::float_arithmetic)]

use super::CondensationError;
use crate::search::complete::pieces::matrix::combined;
use mceip_exact::{Sparse, to_f64};
use mceip_mcp::linear::{SchurFactor, SymbolicAnalysis, Symmetric};
use mceip_model::{ContactState, Direction, ModelError, Particle, System};
use std::borrow::Cow;
use std::collections::BTreeSet;

/// A system ready to be condensed at any t >= 0: order of elimination and fronts are found once.
#[derive(Debug, Clone)]
pub struct SparseCondensation {
    stiffness: Symmetric,
    mass: Option<Symmetric>,
    analysis: SymbolicAnalysis,
    /// One for each slip particle, then three for each particle with zero reaction.
    variables: Vec<ContactVariable>,
    /// f, ascending.
    free: Vec<usize>,
}

/// What a variable does at its particle, over the two dofs of that, which are kept side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ContactVariable {
    /// The number of its particle among those kept.
    block: usize,
    /// d_p: the motion that belongs to x = 1.
    column: [f64; 2],
    /// e_p: what mu is multiplied by in its row.
    friction: [f64; 2],
}

impl ContactVariable {
    fn of_slip(block: usize, particle: &Particle, sign: i8) -> ContactVariable {
        let tangent = on_dofs(particle, &particle.tangent());
        let normal = on_dofs(particle, &particle.friction_direction());
        ContactVariable {
            block,
            column: tangent.map(|c| -f64::from(sign) * c),
            friction: normal.map(|c| -c),
        }
    }

    /// Gap, right and left.
    fn of_zero(block: usize, particle: &Particle) -> [ContactVariable; 3] {
        let tangent = on_dofs(particle, &particle.tangent());
        let opening = on_dofs(particle, &particle.into_obstacle()).map(|c| -c);
        let friction = on_dofs(particle, &particle.friction_direction()).map(|c| -c);
        let variable = |column, friction| ContactVariable {
            block,
            column,
            friction,
        };

        [
            variable(opening, [0.0; 2]),
            variable(tangent, friction),
            variable(tangent.map(|c| -c), friction),
        ]
    }
}

/// The dofs by what becomes of them: those of stick particles are held, those of slip particles
/// kept, all others (f) eliminated.
struct DofRoles {
    is_free: Vec<bool>,
    held: Vec<usize>,
    /// Two dofs for each particle that is kept, in the order of the blocks.
    kept: Vec<usize>,
    slip: Vec<ContactVariable>,
    zero: Vec<ContactVariable>,
}

impl DofRoles {
    /// The roles of `dofs` dofs, after a check that each dof of a particle exists and has no other
    /// owner, and that each sign is 1 or -1.
    fn new(dofs: usize, particles: &[Particle]) -> Result<DofRoles, CondensationError> {
        let mut roles = DofRoles {
            is_free: vec![true; dofs],
            held: Vec::new(),
            kept: Vec::new(),
            slip: Vec::new(),
            zero: Vec::new(),
        };

        let mut claimed = BTreeSet::new();

        for (index, particle) in particles.iter().enumerate() {
            for dof in [particle.tangential, particle.normal] {
                if dof >= dofs {
                    return Err(CondensationError::Dof {
                        particle: index,
                        got: dof,
                        dofs,
                    });
                }
                if !claimed.insert(dof) {
                    return Err(CondensationError::DofTwice {
                        particle: index,
                        dof,
                    });
                }
            }
            roles.add(index, particle)?;
        }

        Ok(roles)
    }

    fn add(&mut self, index: usize, particle: &Particle) -> Result<(), CondensationError> {
        let dofs = [particle.tangential, particle.normal];
        for dof in dofs {
            self.is_free[dof] = particle.state == ContactState::Free;
        }

        match particle.state {
            ContactState::Free => {}
            ContactState::Zero => {
                let block = self.kept.len() / 2;
                self.kept.extend(dofs);
                self.zero.extend(ContactVariable::of_zero(block, particle));
            }
            ContactState::Stick => self.held.extend(dofs),
            ContactState::Slip { sign } if sign.abs() != 1 => {
                return Err(CondensationError::Sign {
                    particle: index,
                    got: sign,
                });
            }
            ContactState::Slip { sign } => {
                let block = self.kept.len() / 2;
                self.kept.extend(dofs);
                let variable = ContactVariable::of_slip(block, particle, sign);
                self.slip.push(variable);
            }
        }

        Ok(())
    }
}

/// A condensed system at one t, with the factorisation that condensed it.
#[derive(Debug, Clone)]
pub struct SparseCondensed<'a> {
    system: &'a SparseCondensation,
    /// The value of t.
    pub t: f64,
    /// A, n_s x n_s by rows, symmetric.
    pub a: Vec<Vec<f64>>,
    /// B, n_s x n_s by rows.
    pub b: Vec<Vec<f64>>,
    factor: SchurFactor<'a>,
}

/// How well a condensation in doubles holds, measured on a few probes. Relative, largest of all
/// probes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CondensationResidual {
    /// Load left on f by a lifted probe, relative to the largest sum of moduli it is made of.
    pub balance: f64,
    /// What one step of iterative refinement changes of Z times the probe, relative to its largest
    /// entry: an estimate of the error of A and B.
    pub change: f64,
}

impl SparseCondensation {
    /// Stick particles are held (v = 0), slip particles kept, all other dofs are f and eliminated.
    ///
    /// `points` is the position of every dof in the plane; where it is known, elimination is
    /// cheaper.
    ///
    /// # Errors
    /// [`CondensationError`] naming the particle.
    pub fn new(
        stiffness: Symmetric,
        mass: Option<Symmetric>,
        particles: &[Particle],
        points: Option<&[[f64; 2]]>,
    ) -> Result<SparseCondensation, CondensationError> {
        let is_zero = |particle: &Particle| particle.state == ContactState::Zero;
        if let Some(particle) = particles.iter().position(is_zero) {
            return Err(CondensationError::ZeroReaction { particle });
        }

        SparseCondensation::with_zero(stiffness, mass, particles, points)
    }

    /// The same with particles of zero reaction, whose variables come after those of the slip
    /// particles. T then has null vectors that are no solutions, so that the result is not for what
    /// treats all variables alike.
    ///
    /// # Errors
    /// As [`SparseCondensation::new`].
    pub fn with_zero(
        stiffness: Symmetric,
        mass: Option<Symmetric>,
        particles: &[Particle],
        points: Option<&[[f64; 2]]>,
    ) -> Result<SparseCondensation, CondensationError> {
        let is_curved = |particle: &Particle| particle.curvature.is_some();
        if let Some(particle) = particles.iter().position(is_curved) {
            return Err(ModelError::Curved { particle }.into());
        }

        let dofs = stiffness.order();
        if let Some(m) = &mass
            && m.order() != dofs
        {
            return Err(CondensationError::Mass {
                expected: dofs,
                got: m.order(),
            });
        }

        let roles = DofRoles::new(dofs, particles)?;
        if roles.slip.is_empty() {
            return Err(CondensationError::NoSlip);
        }

        // Every matrix K + t M has the pattern of K + M, or less where entries cancel.
        let pattern = match &mass {
            Some(m) => Cow::Owned(stiffness.add_scaled(1.0, m)),
            None => Cow::Borrowed(&stiffness),
        };

        let analysis = SymbolicAnalysis::new(&pattern, &roles.kept, &roles.held, points);
        drop(pattern);

        Ok(SparseCondensation {
            stiffness,
            mass,
            analysis,
            variables: [roles.slip, roles.zero].concat(),
            free: (0..dofs).filter(|&dof| roles.is_free[dof]).collect(),
        })
    }

    /// A system rounded to doubles, as [`SparseCondensation::with_zero`] takes it.
    ///
    /// # Errors
    /// As [`SparseCondensation::new`], and for entries beyond doubles.
    pub fn of_system(system: &System) -> Result<SparseCondensation, CondensationError> {
        let rounded = |matrix: &Sparse| {
            let entries = matrix.entries().map(|(i, j, v)| (i, j, to_f64(v)));
            Symmetric::new(matrix.rows(), entries)
        };
        let stiffness = rounded(system.stiffness())?;
        let mass = system.mass().map(rounded).transpose()?;
        SparseCondensation::with_zero(stiffness, mass, system.particles(), None)
    }

    /// n_s, the number of slip particles, or of variables where there is zero reaction.
    pub fn slip_count(&self) -> usize {
        self.variables.len()
    }

    /// Order of K.
    pub fn dofs(&self) -> usize {
        self.stiffness.order()
    }

    /// K.
    pub fn stiffness(&self) -> &Symmetric {
        &self.stiffness
    }

    /// M, where given.
    pub fn mass(&self) -> Option<&Symmetric> {
        self.mass.as_ref()
    }

    /// The fronts of the factorisation.
    pub fn analysis(&self) -> &SymbolicAnalysis {
        &self.analysis
    }

    /// K + t M; without M it is K for every t.
    fn matrix(&self, t: f64) -> Cow<'_, Symmetric> {
        match &self.mass {
            Some(m) if t != 0.0 => Cow::Owned(self.stiffness.add_scaled(t, m)),
            _ => Cow::Borrowed(&self.stiffness),
        }
    }

    /// A(t) and B(t), each n_s x n_s; without M those of t = 0.
    ///
    /// # Errors
    /// [`CondensationError::NotDefinite`]: K + t M is not positive definite on f, within
    /// doubles.
    pub fn at(&self, t: f64) -> Result<SparseCondensed<'_>, CondensationError> {
        let factor = self
            .analysis
            .factor(&self.matrix(t))
            .map_err(|source| CondensationError::NotDefinite { at: t, source })?;
        let a = self.tangential_block(factor.schur());
        let b = self.normal_block(factor.schur());

        Ok(SparseCondensed {
            system: self,
            t,
            a,
            b,
            factor,
        })
    }

    /// A_pq = d_p' Z d_q. // (16)
    ///
    /// The lower triangle and its mirror image: A is symmetric to the last bit.
    fn tangential_block(&self, z: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let n = self.variables.len();
        let mut a = vec![vec![0.0; n]; n];
        for p in 0..n {
            for q in 0..=p {
                let entry = self.entry(z, &self.variables[p].column, p, q);
                a[p][q] = entry;
                a[q][p] = entry;
            }
        }

        a
    }

    /// B_pq = e_p' Z d_q. // (16)
    fn normal_block(&self, z: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let n = self.variables.len();
        let mut b = vec![vec![0.0; n]; n];
        for (p, row) in b.iter_mut().enumerate() {
            for (q, entry) in row.iter_mut().enumerate() {
                *entry = self.entry(z, &self.variables[p].friction, p, q);
            }
        }

        b
    }

    /// left' Z_pq d_q, with Z_pq the 2 x 2 block of Z in the dofs of the particles of p and q.
    fn entry(&self, z: &[Vec<f64>], left: &[f64; 2], p: usize, q: usize) -> f64 {
        let column = &self.variables[q].column;
        let [p, q] = [p, q].map(|variable| self.variables[variable].block);
        let block_times_column = [2 * p, 2 * p + 1].map(|row| {
            let first = z[row][2 * q];
            let second = z[row][2 * q + 1];
            first * column[0] + second * column[1]
        });
        left[0] * block_times_column[0] + left[1] * block_times_column[1]
    }
}

impl SparseCondensed<'_> {
    /// T = A + mu B, n_s x n_s by rows.
    pub fn pencil(&self, mu: f64) -> Vec<Vec<f64>> {
        combined(&self.a, mu, &self.b)
    }

    /// v over all dofs of K for x of the slip particles: v_T = -S x, v_N = 0, f in balance. // (10)
    pub fn lift(&self, x: &[f64]) -> Vec<f64> {
        let mut kept = vec![0.0; self.system.analysis.kept().len()];
        for (variable, x_p) in self.system.variables.iter().zip(x) {
            for (i, c) in variable.column.iter().enumerate() {
                kept[2 * variable.block + i] += c * x_p;
            }
        }
        self.factor.extend(&kept)
    }

    /// x over the variables of the reduced pencil: f ascending, then the slip particles.
    pub fn reduced(&self, x: &[f64]) -> Vec<f64> {
        let v = self.lift(x);
        let free_dofs = self.system.free.iter();
        let mut reduced: Vec<f64> = free_dofs.map(|&dof| v[dof]).collect();
        reduced.extend(x);
        reduced
    }

    /// T'(t) x = A'(t) x + mu B'(t) x of length n_s; `None` without M.
    ///
    /// The derivative of the Schur complement is Z'(t) = E' M E, with E the extension from the kept
    /// dofs to all dofs that leaves f in balance.
    pub fn slope(&self, mu: f64, x: &[f64]) -> Option<Vec<f64>> {
        let mass = self.system.mass.as_ref()?;
        let derivative = self.factor.restrict(&mass.times(&self.lift(x)));

        let mut slope = Vec::with_capacity(x.len());
        for variable in &self.system.variables {
            let row = [0, 1].map(|i| variable.column[i] + mu * variable.friction[i]);
            let of_block = &derivative[2 * variable.block..][..2];
            slope.push(dot(&row, of_block));
        }

        Some(slope)
    }

    /// Twice the kinetic energy of a lifted x at unit rate, v' M v; `None` without M.
    pub fn kinetic(&self, x: &[f64]) -> Option<f64> {
        let v = self.lift(x);
        let mass = self.system.mass.as_ref()?;
        let momentum = mass.times(&v);
        Some(dot(&momentum, &v))
    }

    /// Measures the condensation on all slip particles moved alike, and on `probes` patterns of
    /// signs. Both numbers are relative, and the largest of all probes.
    pub fn residual(&self, probes: usize) -> CondensationResidual {
        let matrix = self.system.matrix(self.t);
        let kept_count = self.system.analysis.kept().len();
        let mut worst = CondensationResidual {
            balance: 0.0,
            change: 0.0,
        };

        for probe in 0..=probes {
            let residual = self.residual_of(&probe_vector(probe, kept_count), &matrix);
            worst.balance = worst.balance.max(residual.balance);
            worst.change = worst.change.max(residual.change);
        }

        worst
    }

    /// The residual for one vector c over the kept dofs; `matrix` is K + t M.
    fn residual_of(&self, c: &[f64], matrix: &Symmetric) -> CondensationResidual {
        let free = &self.system.free;
        let kept = self.system.analysis.kept();

        // The load on f of the extended c should vanish.
        let mut u = self.factor.extend(c);
        let load = matrix.times(&u);
        let sizes = free.iter().map(|&dof| sum_of_moduli(matrix, dof, &u));
        let largest_size = largest(sizes);
        let mut balance: f64 = 0.0;
        for &dof in free {
            balance = balance.max(load[dof].abs() / largest_size);
        }

        // One step of iterative refinement on f. Then the load on the kept dofs should be Z c.
        for (u_i, correction) in u.iter_mut().zip(self.factor.solve(&load)) {
            *u_i -= correction;
        }

        let refined = matrix.times(&u);
        let largest_load = largest(kept.iter().map(|&dof| refined[dof].abs()));
        let mut change: f64 = 0.0;
        for (&dof, z_row) in kept.iter().zip(self.factor.schur()) {
            let difference = (refined[dof] - dot(z_row, c)).abs();
            change = change.max(difference / largest_load);
        }

        CondensationResidual { balance, change }
    }
}

/// a' b.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let products = a.iter().zip(b).map(|(a_i, b_i)| a_i * b_i);
    products.sum()
}

/// The sum of |m_ij u_j| over a row i of the matrix.
fn sum_of_moduli(matrix: &Symmetric, row: usize, u: &[f64]) -> f64 {
    let products = matrix.row(row).map(|(j, m_ij)| m_ij * u[j]);
    products.map(f64::abs).sum()
}

/// The largest of some numbers, positive in any case so that one can divide by it.
fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(f64::MIN_POSITIVE, f64::max)
}

/// The vector over the kept dofs on which a condensation is measured: probe 0 moves the first dof
/// of all slip particles by one, each other probe is a pattern of signs.
fn probe_vector(probe: usize, length: usize) -> Vec<f64> {
    let mut c = vec![0.0; length];
    for (i, entry) in c.iter_mut().enumerate() {
        if probe > 0 {
            *entry = sign(probe, i);
        } else if i % 2 == 0 {
            *entry = 1.0;
        }
    }

    c
}

/// 1 or -1, by the bits of a fixed hash (Knuth's multiplicative one).
fn sign(probe: usize, i: usize) -> f64 {
    let spread = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = spread ^ ((probe as u64) << 17);
    let hash = mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    if hash >> 40 & 1 == 0 { 1.0 } else { -1.0 }
}

/// Coefficients of a direction on the two dofs of its particle.
fn on_dofs(particle: &Particle, direction: &Direction) -> [f64; 2] {
    [particle.tangential, particle.normal].map(|dof| {
        let on_dof = direction.iter().filter(|(d, _)| *d == dof);
        on_dof.map(|(_, coefficient)| to_f64(coefficient)).sum()
    })
}

#[cfg(test)]
mod tests;
