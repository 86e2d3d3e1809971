//! Condensation to the slip particles in doubles, for meshes of any size: one sparse Cholesky with
//! the contact dofs ordered last ends with a Schur complement, of which A and B are parts.
//!
//! With Z(t) the Schur complement of K + t M on the dofs of the slip particles, unit tangents t_p,
//! unit normals n_p into the obstacle and S_p as in (10): A_pq = S_p t_p' Z t_q S_q and B_pq = n_p'
//! Z t_q S_q, which is (16) with x_f eliminated. So T(t) = A(t) + mu B(t) is MCEIP-lambda2
//! condensed to order n_s, and A(0), B(0) are MCEIP-mu. Nothing here decides anything.
#![allow(clippy::float_arithmetic)]

use mceip_exact::to_f64;
use mceip_mcp::linear::{Analysis, NotDefinite, SchurFactor, Symmetric};
use mceip_model::{ContactState, Direction, Particle};

/// Why a system is not condensed in doubles.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SparseCondensationError {
    /// M of another order than K.
    #[error("E3: expected M of order {expected}, got {got}")]
    Mass {
        /// Order of K.
        expected: usize,
        /// Order of M.
        got: usize,
    },
    /// A dof that the matrix does not have.
    #[error("E9: expected dofs of particle {particle} < {dofs}, got {got}")]
    Dof {
        /// Index of the particle.
        particle: usize,
        /// The dof.
        got: usize,
        /// Order of K.
        dofs: usize,
    },
    /// A dof that two particles, or one of them twice, claim.
    #[error("E9: expected each dof in one particle, got {dof} again in particle {particle}")]
    DofTwice {
        /// Index of the second particle.
        particle: usize,
        /// The dof.
        dof: usize,
    },
    /// A sign that is not 1 or -1.
    #[error("E7: expected the sign of particle {particle} to be 1 or -1, got {got}")]
    Sign {
        /// Index of the particle.
        particle: usize,
        /// Its sign.
        got: i8,
    },
    /// Nothing slips.
    #[error("E10: expected at least one particle in impending slip, got none")]
    NoSlip,
    /// K + t M is not positive definite on f.
    #[error("P1: (K + t M)_ff at t = {at}: {source}")]
    NotDefinite {
        /// The value of t.
        at: f64,
        /// Where elimination ended.
        source: NotDefinite,
    },
}

/// A system ready to be condensed at any t >= 0: order of elimination and fronts are found once.
#[derive(Debug, Clone)]
pub struct SparseCondensation {
    stiffness: Symmetric,
    mass: Option<Symmetric>,
    analysis: Analysis,
    slip: Vec<SlipNode>,
    /// f, ascending.
    free: Vec<usize>,
}

/// S t_p and n_p over the two dofs of a slip particle, which are kept side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
struct SlipNode {
    tangent: [f64; 2],
    normal: [f64; 2],
}

/// A condensed system at one t.
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
    /// `points`: the position of every dof in the plane, where known, makes elimination cheaper.
    ///
    /// # Errors
    /// [`SparseCondensationError`] naming the particle.
    pub fn new(
        stiffness: Symmetric,
        mass: Option<Symmetric>,
        particles: &[Particle],
        points: Option<&[[f64; 2]]>,
    ) -> Result<SparseCondensation, SparseCondensationError> {
        let n = stiffness.order();
        if let Some(got) = mass.as_ref().map(Symmetric::order).filter(|&m| m != n) {
            return Err(SparseCondensationError::Mass { expected: n, got });
        }
        let mut is_free = vec![true; n];
        let (mut kept, mut held, mut slip) = (Vec::new(), Vec::new(), Vec::new());
        let mut claimed = std::collections::BTreeSet::new();
        for (particle, p) in particles.iter().enumerate() {
            for dof in [p.tangential, p.normal] {
                if dof >= n {
                    return Err(SparseCondensationError::Dof {
                        particle,
                        got: dof,
                        dofs: n,
                    });
                }
                if !claimed.insert(dof) {
                    return Err(SparseCondensationError::DofTwice { particle, dof });
                }
                is_free[dof] = p.state == ContactState::Free;
            }
            match p.state {
                ContactState::Free => {}
                ContactState::Stick => held.extend([p.tangential, p.normal]),
                ContactState::Slip { sign: got } if got.abs() != 1 => {
                    return Err(SparseCondensationError::Sign { particle, got });
                }
                ContactState::Slip { sign } => {
                    kept.extend([p.tangential, p.normal]);
                    let tangent = on_dofs(p, &p.tangent()).map(|c| f64::from(sign) * c);
                    slip.push(SlipNode {
                        tangent,
                        normal: on_dofs(p, &p.into_obstacle()),
                    });
                }
            }
        }
        if slip.is_empty() {
            return Err(SparseCondensationError::NoSlip);
        }
        // Every matrix K + t M has this pattern, or less where entries cancel.
        let analysis = match &mass {
            Some(m) => Analysis::new(&stiffness.add_scaled(1.0, m), &kept, &held, points),
            None => Analysis::new(&stiffness, &kept, &held, points),
        };
        let free = (0..n).filter(|&i| is_free[i]).collect();
        Ok(SparseCondensation {
            stiffness,
            mass,
            analysis,
            slip,
            free,
        })
    }

    /// n_s.
    pub fn slip_count(&self) -> usize {
        self.slip.len()
    }

    /// Order of K.
    pub fn dofs(&self) -> usize {
        self.stiffness.order()
    }

    /// The fronts of the factorisation.
    pub fn analysis(&self) -> &Analysis {
        &self.analysis
    }

    fn matrix(&self, t: f64) -> std::borrow::Cow<'_, Symmetric> {
        match &self.mass {
            Some(m) if t != 0.0 => std::borrow::Cow::Owned(self.stiffness.add_scaled(t, m)),
            _ => std::borrow::Cow::Borrowed(&self.stiffness),
        }
    }

    /// A(t) and B(t); without M those of t = 0.
    ///
    /// # Errors
    /// [`SparseCondensationError::NotDefinite`]: K + t M is not positive definite on f, within
    /// doubles.
    pub fn at(&self, t: f64) -> Result<SparseCondensed<'_>, SparseCondensationError> {
        let failed = |source| SparseCondensationError::NotDefinite { at: t, source };
        let factor = self.analysis.factor(&self.matrix(t)).map_err(failed)?;
        let z = factor.schur();
        // t_q S_q, then S_p t_p or n_p from the left. // E16
        let entry = |left: &[f64; 2], p: usize, q: usize| {
            let column = |i: usize| {
                z[2 * p + i][2 * q] * self.slip[q].tangent[0]
                    + z[2 * p + i][2 * q + 1] * self.slip[q].tangent[1]
            };
            left[0] * column(0) + left[1] * column(1)
        };
        let n = self.slip.len();
        // One triangle and its mirror image: A is symmetric to the last bit.
        let a = (0..n)
            .map(|p| {
                (0..n)
                    .map(|q| entry(&self.slip[p.max(q)].tangent, p.max(q), p.min(q)))
                    .collect()
            })
            .collect();
        let b = (0..n)
            .map(|p| (0..n).map(|q| entry(&self.slip[p].normal, p, q)).collect())
            .collect();
        Ok(SparseCondensed {
            system: self,
            t,
            a,
            b,
            factor,
        })
    }
}

impl SparseCondensed<'_> {
    /// T = A + mu B, by rows.
    pub fn pencil(&self, mu: f64) -> Vec<Vec<f64>> {
        let row =
            |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| a + mu * b).collect();
        self.a.iter().zip(&self.b).map(row).collect()
    }

    /// v over all dofs of K for x of the slip particles: v_T = -S x, v_N = 0, f in balance. // E10
    pub fn lift(&self, x: &[f64]) -> Vec<f64> {
        self.factor.extend(
            &self
                .system
                .slip
                .iter()
                .zip(x)
                .flat_map(|(s, x)| s.tangent.map(|c| -c * x))
                .collect::<Vec<_>>(),
        )
    }

    /// x over the variables of the reduced pencil: f ascending, then the slip particles.
    pub fn reduced(&self, x: &[f64]) -> Vec<f64> {
        let v = self.lift(x);
        self.system
            .free
            .iter()
            .map(|&i| v[i])
            .chain(x.iter().copied())
            .collect()
    }

    /// T'(t) x = A'(t) x + mu B'(t) x, by Z'(t) = E' M E with E the extension; `None` without M.
    pub fn slope(&self, mu: f64, x: &[f64]) -> Option<Vec<f64>> {
        let m = self.system.mass.as_ref()?;
        let z = self.factor.restrict(&m.times(&self.lift(x))); // of -S x: the sign turns below
        let row = |(s, z): (&SlipNode, &[f64])| {
            -(0..2)
                .map(|i| (s.tangent[i] + mu * s.normal[i]) * z[i])
                .sum::<f64>()
        };
        Some(
            self.system
                .slip
                .iter()
                .zip(z.chunks_exact(2))
                .map(row)
                .collect(),
        )
    }

    /// Twice the kinetic energy of a lifted x at unit rate, v' M v; `None` without M.
    pub fn kinetic(&self, x: &[f64]) -> Option<f64> {
        let v = self.lift(x);
        let m = self.system.mass.as_ref()?;
        Some(m.times(&v).iter().zip(&v).map(|(a, b)| a * b).sum())
    }

    /// Measures the condensation on all slip particles moved alike, and on `probes` patterns of
    /// signs.
    pub fn residual(&self, probes: usize) -> CondensationResidual {
        let matrix = self.system.matrix(self.t);
        let kept = self.system.analysis.kept();
        let mut worst = CondensationResidual {
            balance: 0.0,
            change: 0.0,
        };
        for probe in 0..=probes {
            let c: Vec<f64> = (0..kept.len())
                .map(|i| {
                    if probe == 0 {
                        f64::from(u8::from(i % 2 == 0))
                    } else {
                        sign(probe, i)
                    }
                })
                .collect();
            let mut u = self.factor.extend(&c);
            let load = matrix.times(&u);
            let size = |i: usize| matrix.row(i).map(|(j, v)| (v * u[j]).abs()).sum::<f64>();
            let f = &self.system.free;
            let largest = f.iter().map(|&i| size(i)).fold(f64::MIN_POSITIVE, f64::max);
            worst.balance = f
                .iter()
                .map(|&i| load[i].abs() / largest)
                .fold(worst.balance, f64::max);
            u.iter_mut()
                .zip(self.factor.solve(&load))
                .for_each(|(u, d)| *u -= d);
            let refined = matrix.times(&u);
            let z: Vec<f64> = self
                .factor
                .schur()
                .iter()
                .map(|r| r.iter().zip(&c).map(|(z, c)| z * c).sum())
                .collect();
            let largest = kept
                .iter()
                .map(|&i| refined[i].abs())
                .fold(f64::MIN_POSITIVE, f64::max);
            worst.change = kept
                .iter()
                .zip(&z)
                .map(|(&i, z)| (refined[i] - z).abs() / largest)
                .fold(worst.change, f64::max);
        }
        worst
    }
}

/// 1 or -1, by the bits of a fixed hash (Knuth's multiplicative one).
fn sign(probe: usize, i: usize) -> f64 {
    let h = ((i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (probe as u64) << 17)
        .wrapping_mul(0xbf58_476d_1ce4_e5b9);
    if h >> 40 & 1 == 0 { 1.0 } else { -1.0 }
}

/// Coefficients of a direction on the two dofs of its particle.
fn on_dofs(p: &Particle, d: &Direction) -> [f64; 2] {
    [p.tangential, p.normal].map(|dof| d.iter().filter(|e| e.0 == dof).map(|e| to_f64(&e.1)).sum())
}

#[cfg(test)]
mod tests;
