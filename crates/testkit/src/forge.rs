//! Forgeries: certificates made false on purpose, each with the reason it must be rejected for.

use mceip_check::Reason;
use mceip_check::certificate::{Certificate, Claim, ExactSolution, LiftedSolution};
use mceip_exact::{Integer, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Unknown, Window};

/// A false certificate and what the checker must say.
pub struct Forgery {
    /// The bug it stands for.
    pub name: &'static str,
    /// The certificate.
    pub certificate: Certificate,
    /// Does this reason name the obligation that was broken?
    pub expected: fn(&Reason) -> bool,
}

/// Forgeries of a certificate: of its frame once, of each claim as far as they apply to it.
/// All are false by construction, whatever the problem, given that `certificate` is true.
pub fn forgeries(certificate: &Certificate) -> Vec<Forgery> {
    let mut out = frame(certificate);
    for (index, claim) in certificate.claims.iter().enumerate() {
        let with = |claim: Claim| Certificate {
            claims: vec![claim],
            ..certificate.clone()
        };

        match claim {
            Claim::ExactSolution(c) => {
                out.extend(exact(c).into_iter().map(|(name, c, expected)| Forgery {
                    name,
                    certificate: with(Claim::ExactSolution(c)),
                    expected,
                }))
            }
            Claim::LiftedSolution(c) => {
                out.extend(lifted(c).into_iter().map(|(name, c, expected)| Forgery {
                    name,
                    certificate: with(Claim::LiftedSolution(c)),
                    expected,
                }))
            }
            Claim::EnclosedSolution(_) => out.extend(enclosed(certificate, index)),
        }
    }

    out
}

fn frame(certificate: &Certificate) -> Vec<Forgery> {
    let mut digest = certificate.clone();
    digest.problem_sha256 = digest.problem_sha256.chars().rev().collect();

    let mut unknown = certificate.clone();
    unknown.unknown = if unknown.unknown == Unknown::Mu {
        Unknown::Lambda2
    } else {
        Unknown::Mu
    };

    let empty = Certificate {
        claims: Vec::new(),
        ..certificate.clone()
    };

    vec![
        Forgery {
            name: "another problem's digest",
            certificate: digest,
            expected: |r| matches!(r, Reason::Digest { .. }),
        },
        Forgery {
            name: "the other unknown",
            certificate: unknown,
            expected: |r| matches!(r, Reason::Unknown { .. }),
        },
        Forgery {
            name: "nothing claimed",
            certificate: empty,
            expected: |r| matches!(r, Reason::NoClaims),
        },
    ]
    .into_iter()
    .chain(narrow_window(certificate))
    .collect()
}

/// A window above every claimed value.
fn narrow_window(certificate: &Certificate) -> Option<Forgery> {
    let top = certificate.claims.iter().map(|c| match c {
        Claim::ExactSolution(c) => c.interval[1].0.clone(),
        Claim::LiftedSolution(c) => c.interval[1].0.clone(),
        Claim::EnclosedSolution(c) => {
            c.center.last().map_or_else(|| whole(0), |n| n.0.clone()) + whole(1)
        }
    });

    let window = Window::new(top.max()? + whole(1), None).ok()?;
    let certificate = Certificate {
        window,
        ..certificate.clone()
    };

    Some(Forgery {
        name: "value outside the window",
        certificate,
        expected: |r| matches!(r, Reason::OutsideWindow { .. }),
    })
}

type Broken = (&'static str, ExactSolution, fn(&Reason) -> bool);

fn exact(c: &ExactSolution) -> Vec<Broken> {
    let mut out: Vec<Broken> = Vec::new();
    let mut push = |name, change: &dyn Fn(&mut ExactSolution), expected| {
        let mut forged = c.clone();
        change(&mut forged);
        out.push((name, forged, expected));
    };

    push("constant polynomial", &|c| c.polynomial.truncate(1), |r| {
        matches!(r, Reason::ConstantPolynomial { .. })
    });
    push("x one variable short", &|c| drop(c.x.pop()), |r| {
        matches!(r, Reason::Length { what: "x", .. })
    });
    push("x = 0", &|c| c.x.iter_mut().for_each(Vec::clear), |r| {
        matches!(r, Reason::XNotPositive { .. } | Reason::XZero)
    });

    push(
        "support out of range",
        &|c| c.support.push(c.x.len()),
        |r| matches!(r, Reason::IndexSet { set: "support", .. }),
    );

    push(
        "point that is no root",
        &|c| {
            let off = &c.interval[1].0 + Number(whole(1)).0;
            c.polynomial = vec![Integer::from(1), Integer::from(0), Integer::from(1)];
            c.interval = [Number(off.clone()), Number(off)];
        },
        |r| matches!(r, Reason::NotARoot { .. }),
    );

    if !c.support.is_empty() {
        push("x negative", &|c| negate(c), |r| {
            matches!(r, Reason::XNotPositive { .. })
        });
        push(
            "support one short",
            &|c| c.support.truncate(c.support.len() - 1),
            |r| matches!(r, Reason::XOffSupport { .. }),
        );

        push(
            "support listed twice",
            &|c| c.support.push(c.support[0]),
            |r| matches!(r, Reason::IndexSet { set: "support", .. }),
        );

        push(
            "slipping variable called biactive",
            &|c| {
                c.biactive.push(c.support[0]);
                c.biactive.sort_unstable();
            },
            |r| {
                matches!(
                    r,
                    Reason::Biactive {
                        expected: false,
                        ..
                    }
                )
            },
        );
    }

    if !c.biactive.is_empty() {
        push(
            "biactive index hidden",
            &|c| c.biactive.truncate(c.biactive.len() - 1),
            |r| matches!(r, Reason::Biactive { expected: true, .. }),
        );
    }

    if c.interval[0] != c.interval[1] {
        push("interval reversed", &|c| c.interval.swap(0, 1), |r| {
            matches!(r, Reason::ReversedInterval { .. })
        });
        push(
            "end of the interval as the value",
            &|c| c.interval[1] = c.interval[0].clone(),
            |r| matches!(r, Reason::NotARoot { .. }),
        );

        push(
            "polynomial squared",
            &|c| c.polynomial = square(&c.polynomial),
            |r| matches!(r, Reason::NoSignChange { .. }),
        );

        push(
            "polynomial cubed",
            &|c| c.polynomial = times(&square(&c.polynomial), &c.polynomial),
            |r| matches!(r, Reason::NotIsolated { .. }),
        );
    }

    out
}

type BrokenLift = (&'static str, LiftedSolution, fn(&Reason) -> bool);

/// Forgeries of a lifted claim that are false for every problem.
fn lifted(c: &LiftedSolution) -> Vec<BrokenLift> {
    let mut out: Vec<BrokenLift> = Vec::new();
    let mut push = |name, change: &dyn Fn(&mut LiftedSolution), expected| {
        let mut forged = c.clone();
        change(&mut forged);
        out.push((name, forged, expected));
    };

    push(
        "v = w = 0",
        &|c| c.v.iter_mut().chain(&mut c.w).for_each(Vec::clear),
        |r| matches!(r, Reason::Line { .. } | Reason::XZero),
    );

    push("v one dof short", &|c| drop(c.v.pop()), |r| {
        matches!(r, Reason::Length { what: "v", .. })
    });
    push("w one dof long", &|c| c.w.push(Vec::new()), |r| {
        matches!(r, Reason::Length { what: "w", .. })
    });

    push(
        "w off by a billionth at one dof",
        &|c| match c.w[0].first_mut() {
            Some(n) => n.0 += rational(1, 1_000_000_000),
            None => c.w[0].push(Number(rational(1, 1_000_000_000))),
        },
        |r| {
            matches!(
                r,
                Reason::Line {
                    line: "(lambda^2 M + K) v = w",
                    index: 0,
                    ..
                }
            )
        },
    );

    if !c.support.is_empty() {
        push(
            "everything moves backwards",
            &|c| {
                c.v.iter_mut()
                    .chain(&mut c.w)
                    .flatten()
                    .for_each(|n| n.0 = -n.0.clone())
            },
            |r| {
                matches!(
                    r,
                    Reason::Line {
                        place: "particle",
                        ..
                    }
                )
            },
        );

        push(
            "support one short",
            &|c| c.support.truncate(c.support.len() - 1),
            |r| {
                matches!(
                    r,
                    Reason::Line {
                        line: "S v_T = 0 off the support",
                        ..
                    }
                )
            },
        );
    }

    out
}

fn negate(c: &mut ExactSolution) {
    c.x.iter_mut().flatten().for_each(|v| v.0 = -v.0.clone());
}

fn square(p: &[Integer]) -> Vec<Integer> {
    times(p, p)
}

fn times(p: &[Integer], q: &[Integer]) -> Vec<Integer> {
    let mut out = vec![Integer::default(); p.len() + q.len() - 1];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in q.iter().enumerate() {
            out[i + j] += a * b;
        }
    }

    out
}

/// Forgeries of an enclosed claim: a singular preconditioner, a box of no width, a missing unknown,
/// a centre that is shifted by more than the box.
fn enclosed(certificate: &Certificate, index: usize) -> Vec<Forgery> {
    let Claim::EnclosedSolution(c) = &certificate.claims[index] else {
        return Vec::new();
    };

    let forged =
        |name, expected, change: &dyn Fn(&mut mceip_check::certificate::EnclosedSolution)| {
            let mut c = c.clone();
            change(&mut c);
            Forgery {
                name,
                certificate: Certificate {
                    claims: vec![Claim::EnclosedSolution(c)],
                    ..certificate.clone()
                },
                expected,
            }
        };

    vec![
        forged(
            "zero row in the preconditioner",
            |r| matches!(r, Reason::NotContracting { .. }),
            &|c| {
                c.preconditioner[0]
                    .iter_mut()
                    .for_each(|v| *v = Integer::default());
            },
        ),
        forged(
            "box without width",
            |r| matches!(r, Reason::Radius { .. }),
            &|c| c.radius[0] = Number(whole(0)),
        ),
        forged(
            "one unknown missing",
            |r| matches!(r, Reason::Length { what: "center", .. }),
            &|c| drop(c.center.pop()),
        ),
        forged(
            "centre beside the solution",
            |r| matches!(r, Reason::NotContracting { .. }),
            &|c| {
                let shift = &c.radius[0].0 * whole(4);
                c.center[0].0 += shift;
            },
        ),
        // Half of Y would still contract; twice Y makes I - YJ about -I, which just does not.
        forged(
            "preconditioner of twice the size",
            |r| matches!(r, Reason::NotContracting { .. }),
            &|c| {
                c.exponent = c.exponent.saturating_sub(1);
            },
        ),
    ]
}
