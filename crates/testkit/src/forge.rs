//! Forgeries: certificates spoilt on purpose, each with the reason it must be rejected for.
//!
//! A forgery is an accepted certificate with one change. The changes are data: a name, what is
//! changed, and which reason of the checker names the obligation that the change breaks. Some make
//! the statement false (a support without one of its indices), others only its proof (a
//! preconditioner of zeros): both must be rejected, whatever the problem.
//!
//! Input: an accepted certificate. Output: one forgery of each change that applies to it.
//! Called by `compare`, `block` and the fuzz target `checker_against_forgeries`: a forgery that is
//! accepted, or rejected for another reason, shows an error of the checker.

use mceip_check::Reason;
use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_exact::{Integer, Rational, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Unknown, Window};

/// A certificate that does not prove what it says, and what the checker must say of it.
pub struct Forgery {
    /// The bug it stands for.
    pub name: &'static str,
    /// The certificate.
    pub certificate: Certificate,
    /// Does this reason name the obligation that was broken?
    pub expected: fn(&Reason) -> bool,
}

/// A change that breaks one obligation of an accepted `T` (a certificate or a claim).
struct Change<T> {
    /// The bug it stands for.
    name: &'static str,
    /// What is changed.
    apply: fn(&mut T),
    /// Does this reason name the obligation that was broken?
    expected: fn(&Reason) -> bool,
}

/// Forgeries of a certificate: of its frame once, of each claim as far as they apply to it.
/// Each breaks an obligation, whatever the problem, given that `certificate` is accepted.
pub fn forgeries(certificate: &Certificate) -> Vec<Forgery> {
    let mut out = Vec::new();
    for change in &OF_THE_FRAME {
        let mut forged = certificate.clone();
        (change.apply)(&mut forged);
        out.push(Forgery {
            name: change.name,
            certificate: forged,
            expected: change.expected,
        });
    }
    out.extend(window_above_all_claims(certificate));

    for claim in &certificate.claims {
        match claim {
            Claim::ExactSolution(c) => {
                for change in changes_of_exact(c) {
                    let forged = Claim::ExactSolution(changed(c, change));
                    out.push(forgery(certificate, change, forged));
                }
            }
            Claim::LiftedSolution(c) => {
                for change in changes_of_lifted(c) {
                    let forged = Claim::LiftedSolution(changed(c, change));
                    out.push(forgery(certificate, change, forged));
                }
            }
            Claim::EnclosedSolution(c) => {
                for change in &OF_ENCLOSED {
                    let forged = Claim::EnclosedSolution(changed(c, change));
                    out.push(forgery(certificate, change, forged));
                }
            }
        }
    }

    out
}

/// The claim with the change.
fn changed<T: Clone>(claim: &T, change: &Change<T>) -> T {
    let mut forged = claim.clone();
    (change.apply)(&mut forged);
    forged
}

/// The certificate with the forged claim as its only one.
fn forgery<T>(certificate: &Certificate, change: &Change<T>, claim: Claim) -> Forgery {
    Forgery {
        name: change.name,
        certificate: Certificate {
            claims: vec![claim],
            ..certificate.clone()
        },
        expected: change.expected,
    }
}

/// A window above every claimed value. `None` for a certificate without claims.
fn window_above_all_claims(certificate: &Certificate) -> Option<Forgery> {
    let top = certificate.claims.iter().map(upper_bound).max()?;
    let window = Window::new(top + whole(1), None).ok()?;

    Some(Forgery {
        name: "value outside the window",
        certificate: Certificate {
            window,
            ..certificate.clone()
        },
        expected: |r| matches!(r, Reason::OutsideWindow { .. }),
    })
}

/// A number that is not below the claimed value.
fn upper_bound(claim: &Claim) -> Rational {
    match claim {
        Claim::ExactSolution(c) => c.interval[1].0.clone(),
        Claim::LiftedSolution(c) => c.interval[1].0.clone(),
        // The value is the last unknown of the box; the box is narrower than 1.
        Claim::EnclosedSolution(c) => {
            let center = c.center.last().map_or_else(|| whole(0), |n| n.0.clone());
            center + whole(1)
        }
    }
}

/// Changes of what stands around the claims.
static OF_THE_FRAME: [Change<Certificate>; 3] = [
    Change {
        name: "another problem's digest",
        apply: |c| c.problem_sha256 = c.problem_sha256.chars().rev().collect(),
        expected: |r| matches!(r, Reason::Digest { .. }),
    },
    Change {
        name: "the other unknown",
        apply: |c| {
            c.unknown = match c.unknown {
                Unknown::Mu => Unknown::Lambda2,
                Unknown::Lambda2 => Unknown::Mu,
            }
        },
        expected: |r| matches!(r, Reason::Unknown { .. }),
    },
    Change {
        name: "nothing claimed",
        apply: |c| c.claims = Vec::new(),
        expected: |r| matches!(r, Reason::NoClaims),
    },
];

/// The changes that apply to an exact claim.
fn changes_of_exact(claim: &ExactSolution) -> Vec<&'static Change<ExactSolution>> {
    let mut out: Vec<&Change<ExactSolution>> = OF_EXACT.iter().collect();
    if !claim.support.is_empty() {
        out.extend(&OF_EXACT_WITH_A_SUPPORT);
    }

    if !claim.biactive.is_empty() {
        out.extend(&OF_EXACT_WITH_BIACTIVE);
    }

    let is_irrational_or_wide = claim.interval[0] != claim.interval[1];
    if is_irrational_or_wide {
        out.extend(&OF_EXACT_WITH_AN_INTERVAL);
    }

    out
}

/// Changes of any exact claim.
static OF_EXACT: [Change<ExactSolution>; 5] = [
    Change {
        name: "constant polynomial",
        apply: |c| c.polynomial.truncate(1),
        expected: |r| matches!(r, Reason::ConstantPolynomial { .. }),
    },
    Change {
        name: "x one variable short",
        apply: |c| drop(c.x.pop()),
        expected: |r| matches!(r, Reason::Length { what: "x", .. }),
    },
    Change {
        name: "x = 0",
        apply: |c| c.x.iter_mut().for_each(Vec::clear),
        expected: |r| matches!(r, Reason::XNotPositive { .. } | Reason::XZero),
    },
    Change {
        name: "support out of range",
        apply: |c| c.support.push(c.x.len()),
        expected: |r| matches!(r, Reason::IndexSet { set: "support", .. }),
    },
    // The polynomial 1 + t^2, which has no real root.
    Change {
        name: "point that is no root",
        apply: |c| {
            let beside = &c.interval[1].0 + whole(1);
            c.polynomial = vec![Integer::from(1), Integer::from(0), Integer::from(1)];
            c.interval = [Number(beside.clone()), Number(beside)];
        },
        expected: |r| matches!(r, Reason::NotARoot { .. }),
    },
];

/// Changes of an exact claim whose support is not empty.
static OF_EXACT_WITH_A_SUPPORT: [Change<ExactSolution>; 4] = [
    Change {
        name: "x negative",
        apply: |c| c.x.iter_mut().flatten().for_each(|v| v.0 = -v.0.clone()),
        expected: |r| matches!(r, Reason::XNotPositive { .. }),
    },
    Change {
        name: "support one short",
        apply: |c| c.support.truncate(c.support.len() - 1),
        expected: |r| matches!(r, Reason::XOffSupport { .. }),
    },
    Change {
        name: "support listed twice",
        apply: |c| c.support.push(c.support[0]),
        expected: |r| matches!(r, Reason::IndexSet { set: "support", .. }),
    },
    Change {
        name: "slipping variable called biactive",
        apply: |c| {
            c.biactive.push(c.support[0]);
            c.biactive.sort_unstable();
        },
        expected: |r| {
            matches!(
                r,
                Reason::Biactive {
                    expected: false,
                    ..
                }
            )
        },
    },
];

/// Changes of an exact claim with biactive indices.
static OF_EXACT_WITH_BIACTIVE: [Change<ExactSolution>; 1] = [Change {
    name: "biactive index hidden",
    apply: |c| c.biactive.truncate(c.biactive.len() - 1),
    expected: |r| matches!(r, Reason::Biactive { expected: true, .. }),
}];

/// Changes of an exact claim whose value is enclosed by an interval of positive width.
static OF_EXACT_WITH_AN_INTERVAL: [Change<ExactSolution>; 4] = [
    Change {
        name: "interval reversed",
        apply: |c| c.interval.swap(0, 1),
        expected: |r| matches!(r, Reason::ReversedInterval { .. }),
    },
    Change {
        name: "end of the interval as the value",
        apply: |c| c.interval[1] = c.interval[0].clone(),
        expected: |r| matches!(r, Reason::NotARoot { .. }),
    },
    Change {
        name: "polynomial squared",
        apply: |c| c.polynomial = product(&c.polynomial, &c.polynomial),
        expected: |r| matches!(r, Reason::NoSignChange { .. }),
    },
    Change {
        name: "polynomial cubed",
        apply: |c| {
            let square = product(&c.polynomial, &c.polynomial);
            c.polynomial = product(&square, &c.polynomial);
        },
        expected: |r| matches!(r, Reason::NotIsolated { .. }),
    },
];

/// The product of two polynomials that are not zero, coefficients from the constant term up.
fn product(p: &[Integer], q: &[Integer]) -> Vec<Integer> {
    let mut out = vec![Integer::default(); p.len() + q.len() - 1];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            out[i + j] += a * b;
        }
    }
    out
}

/// The changes that apply to a lifted claim.
fn changes_of_lifted(claim: &LiftedSolution) -> Vec<&'static Change<LiftedSolution>> {
    let mut out: Vec<&Change<LiftedSolution>> = OF_LIFTED.iter().collect();
    if !claim.support.is_empty() {
        out.extend(&OF_LIFTED_WITH_A_SUPPORT);
    }
    out
}

/// Changes of any lifted claim.
static OF_LIFTED: [Change<LiftedSolution>; 4] = [
    Change {
        name: "v = w = 0",
        apply: |c| c.v.iter_mut().chain(&mut c.w).for_each(Vec::clear),
        expected: |r| matches!(r, Reason::Line { .. } | Reason::XZero),
    },
    Change {
        name: "v one dof short",
        apply: |c| drop(c.v.pop()),
        expected: |r| matches!(r, Reason::Length { what: "v", .. }),
    },
    Change {
        name: "w one dof long",
        apply: |c| c.w.push(Vec::new()),
        expected: |r| matches!(r, Reason::Length { what: "w", .. }),
    },
    Change {
        name: "w off by a billionth at one dof",
        apply: |c| match c.w[0].first_mut() {
            Some(n) => n.0 += rational(1, 1_000_000_000),
            None => c.w[0].push(Number(rational(1, 1_000_000_000))),
        },
        expected: |r| {
            matches!(
                r,
                Reason::Line {
                    line: "(lambda^2 M + K) v = w",
                    index: 0,
                    ..
                }
            )
        },
    },
];

/// Changes of a lifted claim whose support is not empty.
static OF_LIFTED_WITH_A_SUPPORT: [Change<LiftedSolution>; 2] = [
    Change {
        name: "everything moves backwards",
        apply: |c| {
            let components = c.v.iter_mut().chain(&mut c.w);
            components.flatten().for_each(|n| n.0 = -n.0.clone());
        },
        expected: |r| {
            matches!(
                r,
                Reason::Line {
                    place: "particle",
                    ..
                }
            )
        },
    },
    Change {
        name: "support one short",
        apply: |c| c.support.truncate(c.support.len() - 1),
        expected: |r| {
            matches!(
                r,
                Reason::Line {
                    line: "S v_T = 0 off the support",
                    ..
                }
            )
        },
    },
];

/// Changes of an enclosed claim: its box, its centre, its preconditioner Y.
static OF_ENCLOSED: [Change<EnclosedSolution>; 5] = [
    Change {
        name: "zero row in the preconditioner",
        apply: |c| c.preconditioner[0].fill(Integer::default()),
        expected: |r| matches!(r, Reason::NotContracting { .. }),
    },
    Change {
        name: "box without width",
        apply: |c| c.radius[0] = Number(whole(0)),
        expected: |r| matches!(r, Reason::Radius { .. }),
    },
    Change {
        name: "one unknown missing",
        apply: |c| drop(c.center.pop()),
        expected: |r| matches!(r, Reason::Length { what: "center", .. }),
    },
    Change {
        name: "centre beside the solution",
        apply: |c| {
            let shift = &c.radius[0].0 * whole(4);
            c.center[0].0 += shift;
        },
        expected: |r| matches!(r, Reason::NotContracting { .. }),
    },
    // Half of Y would still contract; four times Y makes I - YJ about -3I, which does not.
    Change {
        name: "preconditioner of four times the size",
        apply: |c| {
            for entry in c.preconditioner.iter_mut().flatten() {
                *entry *= 4;
            }
        },
        expected: |r| matches!(r, Reason::NotContracting { .. }),
    },
];
