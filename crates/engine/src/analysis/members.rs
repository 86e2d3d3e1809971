//! What holds of every body within the radii of the data: a lower and an upper bound of the
//! critical mu of all members.
//!
//! With w the first-order width of what the members' critical mu may be off that in the middle,
//!
//! ```text
//!     w = max |u'(T - T')x| / |u'T1 x|
//! ```
//!
//! at the solution of smallest mu, with u and x its null vectors, absence is tried below mu - k w
//! for growing k, and presence from mu + w on. The same formula says which entry and which factor
//! costs most ([`MemberCost`]). Nothing is proved by it: the checker decides about certificates.
//!
//! Input: a system with radii, and what `critical` has found of the body in the middle. Output:
//! [`Members`]. Called by [`analyse`](super::analyse).

use super::absence::{AbsenceBound, CoverOutcome, HalfLineFamily, LastFamily, Quadrant};
use super::critical::{BranchStart, CriticalFound, short_bound};
use super::error::AnalysisError;
use super::evidence::{Evidence, Proof, ProofCertificate};
use super::families::Families;
use super::model::AnalysisModel;
use super::presence::{PresenceGround, Prover};
use crate::branch::BranchPoint;
use crate::run::Progress;
use crate::tolerance::CRITICAL_GAPS;
use mceip_check::AcceptedPresence;
use mceip_exact::{Rational, Sparse, from_f64, to_f64, whole};
use mceip_model::{Body, Problem, System, Unknown, Window};
use num_traits::Zero as _;
use std::cell::RefCell;

/// What is proved of every member of a system with radii.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Members {
    /// No member has a solution with mu in (0, this], and why; `None` where that is proved of no
    /// mu.
    pub absent_below: Option<(Rational, Evidence)>,
    /// Each member has a solution for every mu from the first number to the second, and why.
    pub present: Option<([Rational; 2], Evidence)>,
    /// How far the critical mu of a member may be from that in the middle, to first order, and that
    /// mu; `None` where no solution is known.
    pub first_order: Option<FirstOrder>,
    /// Why the search ended early: the radii may leave undecided what it supposes.
    pub obstacle: Option<String>,
}

impl Members {
    /// Nothing is proved, for this reason.
    pub(super) fn hindered(error: &AnalysisError) -> Members {
        Members {
            obstacle: Some(error.to_string()),
            ..Members::default()
        }
    }
}

/// The critical mu in the middle of all members, and the first-order width about it.
#[derive(Debug, Clone, PartialEq)]
pub struct FirstOrder {
    /// mu, in doubles.
    pub middle: f64,
    /// The members lie within this of it.
    pub width: f64,
    /// What it is made of, the largest first.
    pub costs: Vec<MemberCost>,
}

/// What the radius of one number costs: so much of the width.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberCost {
    /// The number.
    pub of: UncertainNumber,
    /// Its part of the width.
    pub width: f64,
}

/// A number of the data with a radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UncertainNumber {
    /// An entry of K and its mirror.
    Stiffness(usize, usize),
    /// An entry of M and its mirror.
    Mass(usize, usize),
    /// The friction factor of a particle.
    FrictionFactor(usize),
}

impl UncertainNumber {
    /// As sentences name it, with the names of the particles.
    pub fn text(self, particles: &[String]) -> String {
        match self {
            UncertainNumber::Stiffness(i, j) => format!("K[{i}][{j}]"),
            UncertainNumber::Mass(i, j) => format!("M[{i}][{j}]"),
            UncertainNumber::FrictionFactor(particle) => {
                format!("the friction factor of particle {}", particles[particle])
            }
        }
    }
}

/// Multiples of the first-order width at which bounds are tried, each this much larger than the one
/// before, and halvings of the gap between the last one in vain and the first that holds.
const FIRST_MULTIPLE: f64 = 1.05;
const LARGER_MULTIPLE: f64 = 1.5;
const MULTIPLES: i32 = 12;
const HALVINGS: usize = 4;

/// Bounds of absence tried where no solution is known: multiples of the mu of the analysis.
const UNITS: [f64; 3] = [1024.0, 16.0, 1.0];

/// Where presence is proved the curve is followed up to this multiple of the bound, as far as it
/// goes.
const ABOVE: f64 = 1.25;

/// Costs that are kept.
const COSTS: usize = 10;

/// Bounds the critical mu of all members. `found` is what is known of the body in the middle.
pub(super) fn members(
    model: &AnalysisModel<'_>,
    system: &System,
    friction: &Rational,
    found: &CriticalFound,
    proofs: &mut Vec<Proof>,
) -> Members {
    let mut members = Members::default();
    let searched = bound_members(model, system, friction, found, proofs, &mut members);
    if let Err(error) = searched {
        members.obstacle = Some(error.to_string());
    }

    members
}

/// What is found goes into `members`, what proves it into `proofs`.
fn bound_members(
    model: &AnalysisModel<'_>,
    system: &System,
    friction: &Rational,
    found: &CriticalFound,
    proofs: &mut Vec<Proof>,
    members: &mut Members,
) -> Result<(), AnalysisError> {
    let stage = "every member: condensing";
    model.watch.report(&Progress::stage(stage));

    let states: Vec<_> = system.particles().iter().map(|p| p.state).collect();
    let friction = if friction.is_zero() {
        &whole(1)
    } else {
        friction
    };
    let posed = system.with_states(&states, Some(friction.clone()))?;
    let problem = Problem::new(Body::System(posed), Unknown::Lambda2, Window::all())?;
    let families = Families::of(system)?;
    let search = MembersSearch {
        model,
        problem: &problem,
        families: &families,
        found,
        last: RefCell::default(),
    };

    let mut prover = match &found.start {
        Some(start) => Some((start, search.prover(start)?)),
        None => None,
    };
    if let Some((start, prover)) = &prover
        && let Some(point) = prover.smallest(start)
    {
        members.first_order = Some(first_order(system, prover.family(), &point));
    }

    // The radii may cost nothing to first order.
    let place = members.first_order.as_ref().map(|found| {
        let width = found.width.max(CRITICAL_GAPS[0] * found.middle);
        (found.middle, width)
    });
    let absence = match place {
        Some((middle, width)) => search.absence_near(middle, width)?,
        None => search.absence_far(friction)?,
    };
    if let Some((below, proof)) = absence {
        proofs.push(proof);
        members.absent_below = Some((below, Evidence::Certificate(proofs.len() - 1)));
    }

    if let (Some((start, prover)), Some((middle, width))) = (&mut prover, place)
        && let Some((range, proof)) = search.presence(start, prover, middle + width)
    {
        proofs.push(proof);
        members.present = Some((range, Evidence::Certificate(proofs.len() - 1)));
    }

    Ok(())
}

/// The search for both bounds.
struct MembersSearch<'a> {
    model: &'a AnalysisModel<'a>,
    problem: &'a Problem,
    families: &'a Families,
    found: &'a CriticalFound,
    /// The condensation of the last cover.
    last: RefCell<LastFamily>,
}

impl<'a> MembersSearch<'a> {
    /// Absence below a bound.
    fn absence(&self, below: &Rational) -> Result<Option<(Rational, Proof)>, AnalysisError> {
        if self.model.stopped() {
            return Ok(None);
        }

        let stage = format!("every member: proving absence below {:.7}", to_f64(below));
        let relay = |progress: &Progress<'_>| self.model.relay(&stage, progress);
        let quadrant = Quadrant {
            families: self.families,
            problem: self.problem,
            limits: self.model.options.limits,
            threads: self.model.options.threads,
            watch: self.model.watch,
        };
        let bound = AbsenceBound {
            from: Rational::zero(),
            below: below.clone(),
            at_most: below.clone(),
            places: &self.found.places,
        };
        let mut last = self.last.borrow_mut();
        let outcome = quadrant.heard_by(&relay).cover(&bound, &mut last)?;
        let CoverOutcome::Absent(proved) = outcome else {
            return Ok(None);
        };

        let certificate = ProofCertificate::Absence(*proved);
        self.model
            .keep("members-absence", self.problem, &certificate);
        let proof = Proof::new("members-absence", self.problem.clone(), certificate);
        Ok(Some((below.clone(), proof)))
    }

    /// Absence below a bound near the solution in the middle: at the smallest multiple of the width
    /// below it that is found.
    fn absence_near(
        &self,
        middle: f64,
        width: f64,
    ) -> Result<Option<(Rational, Proof)>, AnalysisError> {
        let absence_at = |multiple: f64| {
            // middle - off for a small one, and never negative.
            let off = multiple * width;
            match short_bound(middle, off / (middle + off)) {
                Some(below) => self.absence(&below),
                None => Ok(None),
            }
        };

        let mut in_vain = 1.0;
        for k in 0..MULTIPLES {
            let mut holds = FIRST_MULTIPLE * LARGER_MULTIPLE.powi(k);
            let Some(mut proved) = absence_at(holds)? else {
                in_vain = holds;
                continue;
            };

            for _ in 0..HALVINGS {
                let between = 0.5 * (in_vain + holds);
                match absence_at(between)? {
                    Some(sharper) => {
                        proved = sharper;
                        holds = between;
                    }
                    None => in_vain = between,
                }
            }
            return Ok(Some(proved));
        }

        Ok(None)
    }

    /// Absence below a bound that no solution suggests.
    fn absence_far(&self, friction: &Rational) -> Result<Option<(Rational, Proof)>, AnalysisError> {
        for factor in UNITS {
            let below = from_f64(factor * to_f64(friction)).unwrap_or_default();
            if let Some(proved) = self.absence(&below)? {
                return Ok(Some(proved));
            }
        }

        Ok(None)
    }

    /// The prover of presence up to twice the smallest solution.
    fn prover(&self, start: &BranchStart) -> Result<Prover<'a>, AnalysisError> {
        let top = from_f64(2.0 * start.mu).unwrap_or_default();
        let family = HalfLineFamily::new(self.families, &top, &self.found.places)?;
        let ground = PresenceGround {
            problem: self.problem,
            watch: self.model.watch,
        };
        Ok(Prover::new(ground, family))
    }

    /// The interval of presence with the smallest lower end that is found about a mu.
    fn presence(
        &self,
        start: &BranchStart,
        prover: &mut Prover<'a>,
        from: f64,
    ) -> Option<([Rational; 2], Proof)> {
        if self.model.stopped() {
            return None;
        }

        let stage = format!("every member: proving presence from {from:.7}");
        self.model.watch.report(&Progress::stage(&stage));
        prover.climb_about(start, from, ABOVE * from);
        let proved = prover.certified().into_iter();
        let proved = proved.min_by(|p, q| p.accepted().from.cmp(&q.accepted().from))?;

        let AcceptedPresence { from, to, .. } = proved.accepted().clone();
        let certificate = ProofCertificate::Presence(proved);
        self.model
            .keep("members-presence", self.problem, &certificate);
        let proof = Proof::new("members-presence", self.problem.clone(), certificate);
        Some(([from, to], proof))
    }
}

/// The first-order width at the solution of smallest mu, and what it is made of.
fn first_order(system: &System, family: &HalfLineFamily, point: &BranchPoint) -> FirstOrder {
    let per_mu = point.of_mu.abs();
    let modes = family.modes(system, point);
    let of_matrix = |radius: Option<&Sparse>, factor: f64, number: NumberOf| {
        let entries = radius.into_iter().flat_map(Sparse::entries);
        let of_upper = entries.filter(|(i, j, _)| i <= j);
        let cost = |(i, j, radius): (usize, usize, &Rational)| {
            let mirrored = if i == j {
                0.0
            } else {
                modes.left[j] * modes.right[i]
            };
            let both = modes.left[i] * modes.right[j] + mirrored;
            MemberCost {
                of: number(i, j),
                width: factor * to_f64(radius) * both.abs() / per_mu,
            }
        };
        of_upper.map(cost).collect::<Vec<_>>()
    };

    let radii = system.radii();
    let mut costs = of_matrix(radii.stiffness.as_ref(), 1.0, UncertainNumber::Stiffness);
    costs.extend(of_matrix(
        radii.mass.as_ref(),
        point.t,
        UncertainNumber::Mass,
    ));
    costs.extend(
        modes
            .of_factors
            .iter()
            .map(|&(particle, of_factor)| MemberCost {
                of: UncertainNumber::FrictionFactor(particle),
                width: point.mu * of_factor.abs() / per_mu,
            }),
    );

    let width = costs.iter().map(|cost| cost.width).sum();
    costs.retain(|cost| cost.width > 0.0);
    costs.sort_by(|p, q| q.width.total_cmp(&p.width));
    costs.truncate(COSTS);
    FirstOrder {
        middle: point.mu,
        width,
        costs,
    }
}

/// An entry of one of the matrices.
type NumberOf = fn(usize, usize) -> UncertainNumber;
