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
use mceip_exact::{Integer, Poly, Rational, rational, whole};
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
struct Tampering<T> {
    /// The bug it stands for.
    name: &'static str,
    /// What is changed.
    apply: fn(&mut T),
    /// Does this reason name the obligation that was broken?
    expected: fn(&Reason) -> bool,
}

impl<T: Clone> Tampering<T> {
    /// The change of an accepted `T`, of which `wrap` makes a certificate.
    fn forged(&self, good: &T, wrap: impl Fn(T) -> Certificate) -> Forgery {
        let mut forged = good.clone();
        (self.apply)(&mut forged);
        Forgery {
            name: self.name,
            certificate: wrap(forged),
            expected: self.expected,
        }
    }
}

/// A table of changes: name, change, reason.
macro_rules! changes {
    ($($name:literal: $apply:expr => $($reason:pat_param)|+,)+) => {
        &[$(Tampering { name: $name, apply: $apply, expected: |r| matches!(r, $($reason)|+) }),+]
    };
}

/// Forgeries of a certificate: of its frame once, of each claim as far as they apply to it.
/// Each breaks an obligation, whatever the problem, given that `certificate` is accepted.
pub fn forgeries(certificate: &Certificate) -> Vec<Forgery> {
    let of_the_frame = OF_THE_FRAME
        .iter()
        .map(|change| change.forged(certificate, |c| c));
    let mut out: Vec<Forgery> = of_the_frame.collect();
    out.extend(window_above_all_claims(certificate));

    let alone = |claim| Certificate {
        claims: vec![claim],
        ..certificate.clone()
    };
    for claim in &certificate.claims {
        match claim {
            Claim::ExactSolution(c) => {
                for change in changes_of_exact(c) {
                    out.push(change.forged(c, |c| alone(Claim::ExactSolution(c))));
                }
            }
            Claim::LiftedSolution(c) => {
                for change in changes_of_lifted(c) {
                    out.push(change.forged(c, |c| alone(Claim::LiftedSolution(c))));
                }
            }
            Claim::EnclosedSolution(c) => {
                for change in OF_ENCLOSED {
                    out.push(change.forged(c, |c| alone(Claim::EnclosedSolution(c))));
                }
            }
        }
    }

    out
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
static OF_THE_FRAME: &[Tampering<Certificate>] = changes! {
    "another problem's digest":
        |c| c.problem_sha256 = c.problem_sha256.chars().rev().collect() => Reason::Digest { .. },
    "the other unknown": |c| c.unknown = other(c.unknown) => Reason::Unknown { .. },
    "nothing claimed": |c| c.claims = Vec::new() => Reason::NoClaims,
};

fn other(unknown: Unknown) -> Unknown {
    match unknown {
        Unknown::Mu => Unknown::Lambda2,
        Unknown::Lambda2 => Unknown::Eigenvalue,
        Unknown::Eigenvalue => Unknown::Mu,
    }
}

/// The changes that apply to an exact claim.
fn changes_of_exact(claim: &ExactSolution) -> Vec<&'static Tampering<ExactSolution>> {
    let mut out: Vec<&Tampering<ExactSolution>> = OF_EXACT.iter().collect();
    if !claim.support.is_empty() {
        out.extend(OF_EXACT_WITH_A_SUPPORT);
    }

    if !claim.biactive.is_empty() {
        out.extend(OF_EXACT_WITH_BIACTIVE);
    }

    let is_irrational_or_wide = claim.interval[0] != claim.interval[1];
    if is_irrational_or_wide {
        out.extend(OF_EXACT_WITH_AN_INTERVAL);
    }

    out
}

/// Changes of any exact claim. The point that is no root is one of 1 + t^2, which has none.
static OF_EXACT: &[Tampering<ExactSolution>] = changes! {
    "constant polynomial": |c| c.polynomial.truncate(1) => Reason::ConstantPolynomial { .. },
    "x one variable short": |c| drop(c.x.pop()) => Reason::Length { what: "x", .. },
    "x = 0": |c| c.x.iter_mut().for_each(Vec::clear) => Reason::XNotPositive { .. } | Reason::XZero,
    "support out of range":
        |c| c.support.push(c.x.len()) => Reason::IndexSet { set: "support", .. },
    "point that is no root":
        |c| {
            let beside = &c.interval[1].0 + whole(1);
            c.polynomial = [1, 0, 1].map(Integer::from).to_vec();
            c.interval = [Number(beside.clone()), Number(beside)];
        } => Reason::NotARoot { .. },
};

/// Changes of an exact claim whose support is not empty.
static OF_EXACT_WITH_A_SUPPORT: &[Tampering<ExactSolution>] = changes! {
    "x negative":
        |c| c.x.iter_mut().flatten().for_each(|v| v.0 = -v.0.clone())
            => Reason::XNotPositive { .. },
    "support one short": |c| c.support.truncate(c.support.len() - 1) => Reason::XOffSupport { .. },
    "support listed twice":
        |c| c.support.push(c.support[0]) => Reason::IndexSet { set: "support", .. },
    "slipping variable called biactive":
        |c| {
            c.biactive.push(c.support[0]);
            c.biactive.sort_unstable();
        } => Reason::Biactive { expected: false, .. },
};

/// Changes of an exact claim with biactive indices.
static OF_EXACT_WITH_BIACTIVE: &[Tampering<ExactSolution>] = changes! {
    "biactive index hidden":
        |c| c.biactive.truncate(c.biactive.len() - 1) => Reason::Biactive { expected: true, .. },
};

/// Changes of an exact claim whose value is enclosed by an interval of positive width.
static OF_EXACT_WITH_AN_INTERVAL: &[Tampering<ExactSolution>] = changes! {
    "interval reversed": |c| c.interval.swap(0, 1) => Reason::ReversedInterval { .. },
    "end of the interval as the value":
        |c| c.interval[1] = c.interval[0].clone() => Reason::NotARoot { .. },
    "polynomial squared":
        |c| c.polynomial = power(&c.polynomial, 2) => Reason::NoSignChange { .. },
    "polynomial cubed": |c| c.polynomial = power(&c.polynomial, 3) => Reason::NotIsolated { .. },
};

/// A power of a polynomial, coefficients from the constant term up.
fn power(p: &[Integer], exponent: u32) -> Vec<Integer> {
    let p = Poly::new(p.to_vec());
    let one = Poly::from_ints(&[1]);
    let power = (0..exponent).fold(one, |product, _| &product * &p);
    power.coeffs().to_vec()
}

/// The changes that apply to a lifted claim.
fn changes_of_lifted(claim: &LiftedSolution) -> Vec<&'static Tampering<LiftedSolution>> {
    let mut out: Vec<&Tampering<LiftedSolution>> = OF_LIFTED.iter().collect();
    if !claim.support.is_empty() {
        out.extend(OF_LIFTED_WITH_A_SUPPORT);
    }
    out
}

/// Changes of any lifted claim.
static OF_LIFTED: &[Tampering<LiftedSolution>] = changes! {
    "v = w = 0":
        |c| c.v.iter_mut().chain(&mut c.w).for_each(Vec::clear)
            => Reason::Line { .. } | Reason::XZero,
    "v one dof short": |c| drop(c.v.pop()) => Reason::Length { what: "v", .. },
    "w one dof long": |c| c.w.push(Vec::new()) => Reason::Length { what: "w", .. },
    "w off by a billionth at one dof":
        |c| match c.w[0].first_mut() {
            Some(n) => n.0 += rational(1, 1_000_000_000),
            None => c.w[0].push(Number(rational(1, 1_000_000_000))),
        } => Reason::Line { line: "(lambda^2 M + K) v = w", index: 0, .. },
};

/// Changes of a lifted claim whose support is not empty.
static OF_LIFTED_WITH_A_SUPPORT: &[Tampering<LiftedSolution>] = changes! {
    "everything moves backwards":
        |c| {
            let components = c.v.iter_mut().chain(&mut c.w);
            components.flatten().for_each(|n| n.0 = -n.0.clone());
        } => Reason::Line { place: "particle", .. },
    "support one short":
        |c| c.support.truncate(c.support.len() - 1)
            => Reason::Line { line: "S v_T = 0 off the support", .. },
};

/// Changes of an enclosed claim: its box, its centre, its preconditioner Y. Half of Y would still
/// contract; four times Y makes I - YJ about -3I, which does not.
static OF_ENCLOSED: &[Tampering<EnclosedSolution>] = changes! {
    "zero row in the preconditioner":
        |c| c.preconditioner[0].fill(Integer::default()) => Reason::NotContracting { .. },
    "box without width": |c| c.radius[0] = Number(whole(0)) => Reason::Radius { .. },
    "one unknown missing": |c| drop(c.center.pop()) => Reason::Length { what: "center", .. },
    "centre beside the solution":
        |c| c.center[0].0 += &c.radius[0].0 * whole(4) => Reason::NotContracting { .. },
    "preconditioner of four times the size":
        |c| c.preconditioner.iter_mut().flatten().for_each(|entry| *entry *= 4)
            => Reason::NotContracting { .. },
};
