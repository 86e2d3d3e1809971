//! The verdict on `mceip-equilibrium/1`: a body under loads has an equilibrium in given contact
//! states.
//!
//! With the held dofs eliminated, u are the displacements, f = sum a_l f_l the loads and
//! r = K u - f the reactions (5). The states demand of each candidate, with its unit tangent and
//! normal, its gap g and its friction factor c,
//!
//! ```text
//!     free:    u_N < g,                     r = 0                                       // (1)
//!     stick:   u_N = g,  u_T as stated,     r_N < 0,  |r_T| < -mu c r_N                 // (7)
//!     slip S:  u_N = g,                     r_N < 0,  S r_T + mu c r_N = 0              // (7)
//!     zero:    u_N = g,                     r_N = 0,  r_T = 0
//! ```
//!
//! and r = 0 of all other dofs. One variable s > 0 makes this a problem (12)-(14). Let u_0 have the
//! normal displacement g of the candidates in contact and the stated tangential one of those that
//! stick, and let T be the directions in which u is left open, so that u = T x + s u_0. Then
//!
//! ```text
//!     p' (K (T x + s u_0) - s f) = 0    for each equation p' r = 0,
//!     (t - 1) s = 0,
//!     y = q' (K (T x + s u_0) - s f)  or  y = s g - n' T x    for each inequality
//! ```
//!
//! is a pencil with free variables x, the slip variable s, and a slip variable at rest for each
//! inequality. A solution with support {s} has t = 1, and x / s is an equilibrium in these states:
//! the inequalities are strict where y is not listed as zero. So the evidence is a claim like any
//! other, an exact one or a box.
//!
//! Input: a [`LoadedBody`], whose constructor has checked its shape and eliminated the held dofs,
//! and the certificate. The obligations are those of `spec/certificates.md`, 5.20.

use crate::certificate::{EquilibriumCertificate, StatedEquilibrium, StatedState};
use crate::pencil::{RationalRow, Trial, scale};
use crate::reason::{Reason, Rejected};
use crate::{ClaimChecker, biactive_set};
use mceip_exact::{Rational, Sparse};
use mceip_model::{
    Body, ContactState, Direction, LoadedBody, Particle, Pencil, Problem, Unknown, Window,
};
use num_traits::{One, Signed, Zero};

/// What an accepted certificate has proved: the body has an equilibrium in these states.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AcceptedEquilibrium {
    /// The friction.
    pub friction: Rational,
    /// How much of each load is applied.
    pub amounts: Vec<Rational>,
    /// The state of each candidate.
    pub states: Vec<ContactState>,
}

/// Checks a certificate of contact states, exactly.
///
/// # Errors
/// [`Rejected`] with the first obligation that fails.
pub fn check_equilibrium(
    body: &LoadedBody,
    certificate: &EquilibriumCertificate,
) -> Result<AcceptedEquilibrium, Rejected> {
    let digest = body.sha256();
    if certificate.loads_sha256 != digest {
        let got = certificate.loads_sha256.clone();
        return Err(Reason::Digest {
            expected: digest,
            got,
        }
        .into());
    }

    let stated = &certificate.stated;
    let pencil = EquilibriumPencil::of(body, stated)?;
    let problem = &pencil.problem;
    let claim = &certificate.claim;
    let accepted = ClaimChecker::new(problem).verdict(problem.window(), claim)?;

    // Soundness hangs on "alone": the column of an inequality is zero, so that its variable could
    // be in the support as well, and its row would vanish there where it has to be positive.
    if accepted.support != [pencil.load] {
        return Err(Reason::NotTheLoad {
            expected: pencil.load,
            got: accepted.support,
        }
        .into());
    }

    // A zero that is listed elsewhere is another contact state; one that is not listed is positive.
    pencil.require_zeros(biactive_set(claim))?;

    let candidates = stated.candidates.iter();
    Ok(AcceptedEquilibrium {
        friction: stated.friction.clone(),
        amounts: stated.amounts.clone(),
        states: candidates.map(StatedState::contact_state).collect(),
    })
}

/// The pencil of which a stated equilibrium is a solution.
///
/// Its variables are, in turn: the dofs of no candidate in contact, ascending; u_T of the
/// candidates in slip and in state zero; s; one for each inequality, candidate by candidate.
#[derive(Debug, Clone)]
pub struct EquilibriumPencil {
    /// The pencil, with every t >= 0.
    pub problem: Problem,
    /// The variable s.
    pub load: usize,
    /// The variables whose y vanishes: -r_N of the candidates in state zero.
    pub zeros: Vec<usize>,
}

impl EquilibriumPencil {
    /// The pencil of a statement about a body.
    ///
    /// # Errors
    /// [`Reason`]: a friction that is not positive, amounts or states that are not those of the
    /// loads and candidates.
    pub fn of(body: &LoadedBody, stated: &StatedEquilibrium) -> Result<EquilibriumPencil, Reason> {
        if !stated.friction.is_positive() {
            let got = stated.friction.clone();
            return Err(Reason::FrictionNotPositive { got });
        }
        let system = body.system();
        Reason::length("amounts", body.loads().len(), stated.amounts.len())?;
        Reason::length("candidates", body.gaps().len(), stated.candidates.len())?;

        let conditions = Conditions::of(body, stated);
        let load = conditions.open.len();
        let order = load + 1 + conditions.inequalities.len();

        // u = T x + s u_0: s is the last of these columns.
        let mut columns = conditions.open;
        columns.push(conditions.given);
        let trial = Trial::of(&columns, system.dofs());
        let force = force(body, &stated.amounts);
        let identity = Sparse::identity(system.dofs());
        let reaction = |p: &Direction| {
            let mut row = trial.reduced(p, system.stiffness());
            row.push((load, -along(p, &force)));
            row
        };

        let mut rows: Vec<RationalRow> = conditions.equations.iter().map(reaction).collect();
        rows.push(vec![(load, -Rational::one())]); // (t - 1) s
        for inequality in &conditions.inequalities {
            rows.push(match inequality {
                Inequality::Reaction(q) => reaction(q),
                Inequality::Gap { normal, gap } => {
                    let mut row = trial.reduced(&minus(normal), &identity);
                    row.push((load, gap.clone()));
                    row
                }
            });
        }

        let mut entries = Vec::new();
        for (i, row) in rows.into_iter().enumerate() {
            entries.extend(row.into_iter().map(|(j, value)| (i, j, value)));
        }
        let a = Sparse::from_entries(order, order, entries);
        let b = Sparse::from_entries(order, order, [(load, load, Rational::one())]); // (t - 1) s
        let problem = Pencil::new(a, b, (0..load).collect())
            .and_then(|pencil| Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()))
            .map_err(|e| Reason::NoPencil {
                what: e.to_string(),
            })?;

        Ok(EquilibriumPencil {
            problem,
            load,
            zeros: conditions.zeros.iter().map(|k| load + 1 + k).collect(),
        })
    }

    /// Demands that y vanishes where it should and nowhere else.
    fn require_zeros(&self, listed: &[usize]) -> Result<(), Reason> {
        let differs = |index: &&usize| !(self.zeros.contains(index) && listed.contains(index));
        match self.zeros.iter().chain(listed).find(differs) {
            None => Ok(()),
            Some(&index) => Err(Reason::Biactive {
                index,
                expected: self.zeros.contains(&index),
            }),
        }
    }
}

/// What the states demand of u and of the reactions r.
struct Conditions {
    /// Columns of T: directions in which u is left open.
    open: Vec<Direction>,
    /// u_0: what is given of u.
    given: Direction,
    /// p with p' r = 0, as many as `open`.
    equations: Vec<Direction>,
    inequalities: Vec<Inequality>,
    /// The inequalities that hold with equality: their numbers.
    zeros: Vec<usize>,
}

enum Inequality {
    /// q' r > 0.
    Reaction(Direction),
    /// u_N < gap, along this normal.
    Gap { normal: Direction, gap: Rational },
}

impl Conditions {
    /// Of as many states as candidates.
    fn of(body: &LoadedBody, stated: &StatedEquilibrium) -> Conditions {
        let particles = body.system().particles();
        let mut is_in_contact = vec![false; body.system().dofs()];
        for (particle, state) in particles.iter().zip(&stated.candidates) {
            if *state != (StatedState::Free {}) {
                is_in_contact[particle.tangential] = true;
                is_in_contact[particle.normal] = true;
            }
        }

        let mut conditions = Conditions {
            open: Vec::new(),
            given: Vec::new(),
            equations: Vec::new(),
            inequalities: Vec::new(),
            zeros: Vec::new(),
        };
        for (dof, is_in_contact) in is_in_contact.iter().enumerate() {
            if !is_in_contact {
                let unit = vec![(dof, Rational::one())];
                conditions.leave_open(unit.clone(), unit);
            }
        }

        for (k, particle) in particles.iter().enumerate() {
            let gap = &body.gaps()[k];
            conditions.add(particle, gap, &stated.candidates[k], &stated.friction);
        }

        conditions
    }

    /// Leaves u open along a direction, and demands p' r = 0.
    fn leave_open(&mut self, direction: Direction, p: Direction) {
        self.open.push(direction);
        self.equations.push(p);
    }

    /// The line of the table for one candidate.
    fn add(&mut self, particle: &Particle, gap: &Rational, state: &StatedState, mu: &Rational) {
        let tangent = particle.tangent();
        let normal = particle.into_obstacle();
        let friction = scale(&particle.friction_direction(), mu); // mu c n
        let pressure = Inequality::Reaction(minus(&normal)); // -r_N

        if let StatedState::Free {} = state {
            let gap = gap.clone();
            self.inequalities.push(Inequality::Gap { normal, gap });
            return;
        }
        self.given.extend(scale(&normal, gap));

        match state {
            StatedState::Free {} => {}
            StatedState::Stick { tangential } => {
                self.given.extend(scale(&tangent, &tangential.0));
                // -mu c r_N - r_T and -mu c r_N + r_T.
                let right = minus(&sum(&friction, &tangent));
                let left = minus(&sum(&friction, &minus(&tangent)));
                let inside = [right, left].map(Inequality::Reaction);
                self.inequalities.push(pressure);
                self.inequalities.extend(inside);
            }
            StatedState::Slip { sign } => {
                let sign = Rational::from_integer(i8::from(*sign).into());
                let on_cone = sum(&scale(&tangent, &sign), &friction); // S r_T + mu c r_N
                self.leave_open(tangent, on_cone);
                self.inequalities.push(pressure);
            }
            StatedState::Zero {} => {
                self.leave_open(tangent.clone(), tangent);
                self.zeros.push(self.inequalities.len());
                self.inequalities.push(pressure);
            }
        }
    }
}

/// f = sum a_l f_l.
fn force(body: &LoadedBody, amounts: &[Rational]) -> Vec<Rational> {
    let mut force = vec![Rational::zero(); body.system().dofs()];
    for (load, amount) in body.loads().iter().zip(amounts) {
        for (sum, value) in force.iter_mut().zip(load) {
            *sum += amount * value;
        }
    }

    force
}

/// p' f.
fn along(p: &Direction, force: &[Rational]) -> Rational {
    p.iter().map(|(dof, c)| c * &force[*dof]).sum()
}

fn minus(direction: &Direction) -> Direction {
    scale(direction, &-Rational::one())
}

/// The sum, with a dof as often as it is in both.
fn sum(a: &Direction, b: &Direction) -> Direction {
    a.iter().chain(b).cloned().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::SlipSign;
    use mceip_exact::{rational, whole};
    use mceip_model::file::Number;
    use mceip_model::{ContactCandidate, LoadStep, LoadedParts};

    /// K = [[2, -1, 0], [-1, 2, 0], [0, 0, 1]]; dof 1 is the tangential and dof 2 the normal one of
    /// a candidate with the gap 5 and the friction factor 2; loads 3 on dof 2 and 1 on dof 0.
    fn body() -> LoadedBody {
        let step = |dof, value| LoadStep {
            name: String::new(),
            forces: vec![(dof, whole(value))],
            displacements: Vec::new(),
            is_endless: false,
        };
        let particle = Particle {
            friction_factor: whole(2),
            ..Particle::plain(1, 2, ContactState::Free)
        };
        let parts = LoadedParts {
            stiffness: Sparse::from_ints(&[&[2, -1, 0], &[-1, 2, 0], &[0, 0, 1]]),
            mass: None,
            friction: None,
            candidates: vec![ContactCandidate {
                particle,
                gap: whole(5),
            }],
            held: Vec::new(),
            steps: vec![step(2, 3), step(0, 1)],
        };
        LoadedBody::new(parts).unwrap()
    }

    fn stated(state: StatedState) -> StatedEquilibrium {
        StatedEquilibrium {
            friction: rational(1, 2),
            amounts: vec![whole(2), whole(7)],
            candidates: vec![state],
        }
    }

    /// The rows of A, the free variables first, then s, then the inequalities.
    fn rows(state: StatedState) -> Vec<Vec<Rational>> {
        let pencil = EquilibriumPencil::of(&body(), &stated(state)).unwrap();
        let Body::Pencil(made) = pencil.problem.body() else {
            panic!("a pencil")
        };
        assert_eq!(made.free(), (0..pencil.load).collect::<Vec<_>>());
        assert_eq!(made.b().entries().count(), 1);
        assert_eq!(made.b().get(pencil.load, pencil.load), whole(1));

        let used = 0..pencil.load + 1;
        let a = made.a();
        let row = |i| used.clone().map(|j| a.get(i, j)).collect();
        assert!(a.entries().all(|(_, j, _)| j <= pencil.load));
        (0..a.rows()).map(row).collect()
    }

    fn expected(rows: &[&[i64]]) -> Vec<Vec<Rational>> {
        let row = |row: &&[i64]| row.iter().map(|v| whole(*v)).collect();
        rows.iter().map(row).collect()
    }

    /// Each line of the table, with the loads (7, 0, 6): by hand.
    #[test]
    fn each_state_has_its_equations_and_inequalities() {
        // Variables u_0, u_1, u_2, s; y = 5 - u_N.
        assert_eq!(
            rows(StatedState::Free {}),
            expected(&[
                &[2, -1, 0, -7],
                &[-1, 2, 0, 0],
                &[0, 0, 1, -6],
                &[0, 0, 0, -1],
                &[0, 0, -1, 5]
            ])
        );

        // u_0, s with u_T = 4, u_N = 5: r_T = 8 - u_0, r_N = 5 - 6, mu c = 1.
        let stuck = StatedState::Stick {
            tangential: Number(whole(4)),
        };
        assert_eq!(
            rows(stuck),
            expected(&[&[2, -11], &[0, -1], &[0, 1], &[1, -7], &[-1, 9]])
        );

        // u_0, u_T, s: -(2 u_T - u_0) + (5 - 6) s = 0 for S = -1.
        assert_eq!(
            rows(StatedState::Slip {
                sign: SlipSign::Minus
            }),
            expected(&[&[2, -1, -7], &[1, -2, -1], &[0, 0, -1], &[0, 0, 1]])
        );
        assert_eq!(
            rows(StatedState::Slip {
                sign: SlipSign::Plus
            }),
            expected(&[&[2, -1, -7], &[-1, 2, -1], &[0, 0, -1], &[0, 0, 1]])
        );

        // u_0, u_T, s: r_T = 0, and -r_N vanishes.
        assert_eq!(
            rows(StatedState::Zero {}),
            expected(&[&[2, -1, -7], &[-1, 2, 0], &[0, 0, -1], &[0, 0, 1]])
        );
        let zero = stated(StatedState::Zero {});
        let pencil = EquilibriumPencil::of(&body(), &zero).unwrap();
        assert_eq!((pencil.load, pencil.zeros), (2, vec![3]));
    }

    #[test]
    fn statements_of_another_shape_are_refused() {
        let refused = |change: fn(&mut StatedEquilibrium)| {
            let mut stated = stated(StatedState::Free {});
            change(&mut stated);
            EquilibriumPencil::of(&body(), &stated).unwrap_err().name()
        };
        assert_eq!(refused(|s| s.friction = whole(0)), "FrictionNotPositive");
        assert_eq!(refused(|s| s.friction = whole(-1)), "FrictionNotPositive");
        assert_eq!(refused(|s| s.amounts.push(whole(1))), "Length");
        assert_eq!(refused(|s| s.candidates.clear()), "Length");
    }

    /// The zeros that are demanded and those that are listed have to be the same.
    #[test]
    fn zeros_are_those_of_the_states() {
        let zero = stated(StatedState::Zero {});
        let zero = EquilibriumPencil::of(&body(), &zero).unwrap();
        assert_eq!(zero.require_zeros(&[3]), Ok(()));
        let missing = Reason::Biactive {
            index: 3,
            expected: true,
        };
        assert_eq!(zero.require_zeros(&[]), Err(missing));

        let free = stated(StatedState::Free {});
        let free = EquilibriumPencil::of(&body(), &free).unwrap();
        assert_eq!(free.require_zeros(&[]), Ok(()));
        let more = Reason::Biactive {
            index: 4,
            expected: false,
        };
        assert_eq!(free.require_zeros(&[4]), Err(more));
    }
}
