//! Claims about a system with a particle in contact with zero reaction: one solution for each of
//! its modes and corners, and a forgery of each condition on it (`spec/zero-reaction.md`), for
//! exact and lifted claims and for boxes.
//!
//! Two particles: 0 on the degrees of freedom (T, N) = (0, 1) in impending slip with S = 1, 1 on
//! (2, 3) with zero reaction. With mu = 3 and M = I (MCEIP-mu: mu = 2 and lambda = 0)
//!
//! ```text
//!     K = [   4    -2     b     a   ]      v_0 = -x,  v_1 = 0,      w_2 =  b v_0 + c v_2,
//!         [  -2    10  -b/mu  -a/mu ]                               w_3 =  a v_0 + c v_3,
//!         [   b  -b/mu   10     0   ]
//!         [   a  -a/mu    0    10   ]      c = 12 (MCEIP-mu: 10).
//! ```
//!
//! What particle 1 does cancels in w_0 + mu w_1, so that lambda^2 = 2 (mu = 2) is the only value,
//! and a, b choose the mode. The variables are x, the gap -v_3, right max(v_2, 0) and
//! left max(-v_2, 0).
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::*;
use mceip_check::certificate::{
    Certificate, Claim, EnclosedSolution, ExactSolution, LiftedSolution,
};
use mceip_exact::{Integer, Rational, Sparse, common_denominator, parse, rational, whole};
use mceip_model::file::Number;
use mceip_model::reduction::split_form;
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};

/// The problem with these couplings, and the friction factor of particle 1.
pub fn problem(unknown: Unknown, a: &str, b: &str, friction_factor: Rational) -> Problem {
    let a = parse(a).unwrap();
    let b = parse(b).unwrap();
    let mu = mu(unknown);
    let couplings = [
        (0, 1, whole(-2)),
        (0, 2, b.clone()),
        (0, 3, a.clone()),
        (1, 2, -b / &mu),
        (1, 3, -a / &mu),
    ];

    let mut entries = vec![(0, 0, whole(4))];
    for dof in 1..4 {
        entries.push((dof, dof, whole(10)));
    }
    for (i, j, value) in couplings {
        entries.push((i, j, value.clone()));
        entries.push((j, i, value));
    }

    let zero = Particle {
        friction_factor,
        ..Particle::plain(2, 3, ContactState::Zero)
    };
    let particles = vec![Particle::plain(0, 1, ContactState::Slip { sign: 1 }), zero];
    let stiffness = Sparse::from_entries(4, 4, entries);
    let (mass, friction) = match unknown {
        Unknown::Lambda2 => (Some(Sparse::identity(4)), Some(mu)),
        Unknown::Mu => (None, None),
    };
    let system = System::new(stiffness, mass, friction, particles).unwrap();
    Problem::new(Body::System(system), unknown, Window::all()).unwrap()
}

fn mu(unknown: Unknown) -> Rational {
    whole(match unknown {
        Unknown::Lambda2 => 3,
        Unknown::Mu => 2,
    })
}

/// A claim by its sets and by the motion (-x, 0, v_2, v_3), at the value 2.
#[derive(Clone, Copy)]
struct Motion {
    support: &'static [usize],
    biactive: &'static [usize],
    /// v_2.
    sliding: &'static str,
    /// v_3.
    normal: &'static str,
}

impl Motion {
    /// x, with v_T at the half that the support names, where it names one.
    fn components(&self) -> [Rational; 4] {
        let v_t = parse(self.sliding).unwrap();
        let v_n = parse(self.normal).unwrap();
        let mut x = [whole(1), -v_n, whole(0), whole(0)];
        if self.support.contains(&3) {
            x[3] = -v_t;
        } else {
            x[2] = v_t;
        }
        x
    }

    fn exact(&self) -> ExactSolution {
        let v_t = parse(self.sliding).unwrap();
        let v_n = parse(self.normal).unwrap();
        let zero = whole(0);
        let x = [
            whole(1),
            -v_n,
            v_t.clone().max(zero.clone()),
            (-v_t).max(zero),
        ];

        ExactSolution {
            support: self.support.to_vec(),
            biactive: self.biactive.to_vec(),
            polynomial: vec![(-2).into(), 1.into()],
            interval: [q("2"), q("2")],
            x: x.map(|x_i| vec![Number(x_i)]).to_vec(),
        }
    }

    /// v and w = (K + 2 M) v, or w = K v.
    fn lifted(&self, problem: &Problem) -> LiftedSolution {
        let system = system(problem);
        let v = [
            whole(-1),
            whole(0),
            parse(self.sliding).unwrap(),
            parse(self.normal).unwrap(),
        ];

        let mut w = vec![whole(0); 4];
        for (i, j, entry) in system.stiffness().entries() {
            w[i] += entry * &v[j];
        }
        if let Some(mass) = system.mass() {
            for (i, j, entry) in mass.entries() {
                w[i] += entry * &v[j] * whole(2);
            }
        }

        let exact = self.exact();
        LiftedSolution {
            support: exact.support,
            biactive: exact.biactive,
            polynomial: exact.polynomial,
            interval: exact.interval,
            v: v.map(|v_i| vec![Number(v_i)]).to_vec(),
            w: w.into_iter().map(|w_i| vec![Number(w_i)]).collect(),
        }
    }
}

/// A solution for the couplings a and b.
struct Good {
    name: &'static str,
    note: &'static str,
    a: &'static str,
    b: &'static str,
    motion: Motion,
}

const GOOD: [Good; 7] = [
    Good {
        name: "open",
        note: "the particle leaves the obstacle and slides to the right: both cone lines are 0",
        a: "-3",
        b: "3",
        motion: Motion {
            support: &[0, 1, 2],
            biactive: &[3],
            sliding: "1/4",
            normal: "-1/4",
        },
    },
    Good {
        name: "stick",
        note: "the particle is pressed and rests inside its cone",
        a: "3",
        b: "3",
        motion: Motion {
            support: &[0],
            biactive: &[],
            sliding: "0",
            normal: "0",
        },
    },
    Good {
        name: "right",
        note: "the particle is pressed and slides along its tangent",
        a: "1",
        b: "6",
        motion: Motion {
            support: &[0, 2],
            biactive: &[],
            sliding: "1/4",
            normal: "0",
        },
    },
    Good {
        name: "left",
        note: "the particle is pressed and slides against its tangent",
        a: "1",
        b: "-6",
        motion: Motion {
            support: &[0, 3],
            biactive: &[],
            sliding: "-1/4",
            normal: "0",
        },
    },
    Good {
        name: "grazing",
        note: "the particle slides along the obstacle and is not pressed: v_N = w_N = 0",
        a: "0",
        b: "6",
        motion: Motion {
            support: &[0, 2],
            biactive: &[1, 3],
            sliding: "1/2",
            normal: "0",
        },
    },
    Good {
        name: "on-the-cone",
        note: "the particle rests on the boundary of its cone",
        a: "1",
        b: "3",
        motion: Motion {
            support: &[0],
            biactive: &[2],
            sliding: "0",
            normal: "0",
        },
    },
    Good {
        name: "decoupled",
        note: "nothing happens at the particle: all of its variables are biactive",
        a: "0",
        b: "0",
        motion: Motion {
            support: &[0],
            biactive: &[1, 2, 3],
            sliding: "0",
            normal: "0",
        },
    },
];

/// A claim that is false for the couplings a and b.
struct Wrong {
    name: &'static str,
    /// The obligation that an exact claim breaks; a lifted one breaks a line of (9), if `line`.
    reason: &'static str,
    line: bool,
    note: &'static str,
    a: &'static str,
    b: &'static str,
    motion: Motion,
}

const AT_REST: Motion = Motion {
    support: &[0],
    biactive: &[],
    sliding: "0",
    normal: "0",
};

const WRONG: [Wrong; 11] = [
    Wrong {
        name: "pulled",
        reason: "YNotPositive",
        line: true,
        note: "w_N <= 0: the obstacle would have to pull",
        a: "-3",
        b: "3",
        motion: AT_REST,
    },
    Wrong {
        name: "pulled-by-a-little",
        reason: "YNotPositive",
        line: true,
        note: "w_N = 1e-12 > 0",
        a: "-0.000000000001",
        b: "0",
        motion: AT_REST,
    },
    Wrong {
        name: "penetrates",
        reason: "XNotPositive",
        line: true,
        note: "v_N <= 0: an open particle that moves into the obstacle",
        a: "3",
        b: "3",
        motion: Motion {
            support: &[0, 1, 2],
            biactive: &[3],
            sliding: "1/4",
            normal: "1/4",
        },
    },
    Wrong {
        name: "open-and-pressed",
        reason: "YNotZero",
        line: true,
        note: "v_N w_N = 0: the particle opens although it is pressed",
        a: "3",
        b: "0",
        motion: Motion {
            support: &[0, 1],
            biactive: &[2, 3],
            sliding: "0",
            normal: "-1/8",
        },
    },
    Wrong {
        name: "outside-the-cone",
        reason: "YNotPositive",
        line: true,
        note: "|w_T| + mu w_N <= 0: at rest outside the cone",
        a: "1",
        b: "6",
        motion: AT_REST,
    },
    Wrong {
        name: "outside-the-cone-by-a-little",
        reason: "YNotPositive",
        line: true,
        note: "|w_T| + mu w_N = 1e-12",
        a: "1",
        b: "3.000000000001",
        motion: AT_REST,
    },
    Wrong {
        name: "slides-with-friction",
        reason: "XOffSupport",
        line: true,
        note: "the reaction of a particle that slides to the left, but it slides to the right",
        a: "1",
        b: "6",
        motion: Motion {
            support: &[0, 3],
            biactive: &[],
            sliding: "3/4",
            normal: "0",
        },
    },
    Wrong {
        name: "slides-off-the-cone",
        reason: "YNotZero",
        line: true,
        note: "the particle slides with a reaction inside its cone",
        a: "3",
        b: "3",
        motion: Motion {
            support: &[0, 2],
            biactive: &[],
            sliding: "1/4",
            normal: "0",
        },
    },
    Wrong {
        name: "grazing-not-listed",
        reason: "Biactive",
        line: true,
        note: "v_N = w_N = 0 that is not listed as biactive",
        a: "0",
        b: "6",
        motion: Motion {
            support: &[0, 2],
            biactive: &[3],
            sliding: "1/2",
            normal: "0",
        },
    },
    Wrong {
        name: "biactive-inside-the-cone",
        reason: "Biactive",
        line: true,
        note: "a reaction inside the cone that is listed as on its boundary",
        a: "3",
        b: "3",
        motion: Motion {
            support: &[0],
            biactive: &[2],
            sliding: "0",
            normal: "0",
        },
    },
    Wrong {
        name: "biactive-pressed",
        reason: "Biactive",
        line: true,
        note: "a particle that is pressed and listed as grazing",
        a: "3",
        b: "3",
        motion: Motion {
            support: &[0],
            biactive: &[1],
            sliding: "0",
            normal: "0",
        },
    },
];

/// Changes of the solution `right` that only an exact claim can say.
const HALVES: [Forgery<ExactSolution>; 2] = [
    Forgery {
        name: "both-ways",
        reason: "BothHalves",
        note: "v+ and v- both larger by 1: v and w stay what they are",
        change: |claim| {
            claim.support = vec![0, 2, 3];
            claim.x[2] = numbers(&["5/4"]);
            claim.x[3] = numbers(&["1"]);
        },
    },
    Forgery {
        name: "no-motion",
        reason: "BothHalves",
        note: "v+ = v- = 1 alone: x is not zero, y is zero, v is zero",
        change: |claim| {
            claim.support = vec![2, 3];
            claim.biactive = vec![0, 1];
            claim.x = [&[][..], &[], &["1"], &["1"]].map(numbers).to_vec();
        },
    },
];

pub fn zero_reaction(cases: &mut Cases) {
    for good in GOOD {
        accept(cases, &good, "", Unknown::Lambda2, whole(1));
    }

    let [open, _, _, _, grazing, ..] = &GOOD;
    let of_mu = [(open, "3/10", "-3/10"), (grazing, "3/5", "0")];
    for (good, sliding, normal) in of_mu {
        let motion = Motion {
            sliding,
            normal,
            ..good.motion
        };
        accept(
            cases,
            &Good { motion, ..*good },
            "-mu",
            Unknown::Mu,
            whole(1),
        );
    }
    factors(cases);

    for wrong in WRONG {
        reject(cases, &wrong);
    }
    halves(cases);
    boxes(cases);
}

fn accept(cases: &mut Cases, good: &Good, suffix: &str, unknown: Unknown, factor: Rational) {
    let problem = problem(unknown, good.a, good.b, factor);
    let name = format!("zero-{}{suffix}", good.name);
    let exact = exact_certificate(&problem, &good.motion.exact());
    cases.accept(&name, good.note, &problem, &exact);

    let lifted = claims(
        &problem,
        Claim::LiftedSolution(good.motion.lifted(&problem)),
    );
    cases.accept(&format!("{name}-lifted"), good.note, &problem, &lifted);
}

/// With half the friction a particle slides that would rest, w_T = mu w_N / 2; the motion of the
/// full friction is none.
fn factors(cases: &mut Cases) {
    let slides = Good {
        name: "factor",
        note: "friction factor 1/2: w_T = mu w_N / 2",
        a: "1",
        b: "6",
        motion: Motion {
            support: &[0, 2],
            biactive: &[],
            sliding: "3/8",
            normal: "0",
        },
    };
    accept(cases, &slides, "", Unknown::Lambda2, rational(1, 2));

    let of_full_friction = &GOOD[2].motion;
    let problem = problem(Unknown::Lambda2, "1", "6", rational(1, 2));
    cases.reject(
        "zero-factor-left-out",
        "YNotZero",
        "the motion without the friction factor of the particle",
        &problem,
        &exact_certificate(&problem, &of_full_friction.exact()),
    );
}

fn reject(cases: &mut Cases, wrong: &Wrong) {
    let problem = problem(Unknown::Lambda2, wrong.a, wrong.b, whole(1));
    let name = format!("zero-{}", wrong.name);
    let exact = exact_certificate(&problem, &wrong.motion.exact());
    cases.reject(&name, wrong.reason, wrong.note, &problem, &exact);

    if wrong.line {
        let name = format!("{name}-lifted");
        let lifted = claims(
            &problem,
            Claim::LiftedSolution(wrong.motion.lifted(&problem)),
        );
        cases.reject(&name, "Line", wrong.note, &problem, &lifted);
    }
}

fn halves(cases: &mut Cases) {
    let right = &GOOD[2];
    let problem = problem(Unknown::Lambda2, right.a, right.b, whole(1));
    for forgery in HALVES {
        let forged = exact_certificate(&problem, &forgery.of(&right.motion.exact()));
        let name = format!("zero-{}", forgery.name);
        cases.reject(&name, forgery.reason, forgery.note, &problem, &forged);
    }
}

/// Claims by boxes about motions whose lines hold with equality on the support. In the first four
/// each condition on the particle is strict, or vanishes with the support.
fn boxes(cases: &mut Cases) {
    for good in &GOOD[..4] {
        accept_box(cases, good, "", Unknown::Lambda2, whole(1));
    }

    let open = &GOOD[0];
    let motion = Motion {
        sliding: "3/10",
        normal: "-3/10",
        ..open.motion
    };
    accept_box(
        cases,
        &Good { motion, ..*open },
        "-mu",
        Unknown::Mu,
        whole(1),
    );

    let slides = Good {
        name: "factor",
        note: "friction factor 1/2: w_T = mu w_N / 2",
        motion: Motion {
            sliding: "3/8",
            ..GOOD[2].motion
        },
        ..GOOD[2]
    };
    accept_box(cases, &slides, "", Unknown::Lambda2, rational(1, 2));
    reject_box(cases, &FACTOR_LEFT_OUT, rational(1, 2));

    for wrong in WRONG_BOXES {
        reject_box(cases, &wrong, whole(1));
    }
    box_of_both_halves(cases);
}

fn accept_box(cases: &mut Cases, good: &Good, suffix: &str, unknown: Unknown, factor: Rational) {
    let problem = problem(unknown, good.a, good.b, factor);
    let name = format!("zero-{}{suffix}-box", good.name);
    cases.accept(
        &name,
        good.note,
        &problem,
        &box_around(&problem, &good.motion),
    );
}

fn reject_box(cases: &mut Cases, wrong: &Wrong, factor: Rational) {
    let problem = problem(Unknown::Lambda2, wrong.a, wrong.b, factor);
    let name = format!("zero-{}-box", wrong.name);
    let forged = box_around(&problem, &wrong.motion);
    cases.reject(&name, wrong.reason, wrong.note, &problem, &forged);
}

/// The box around the solution `right` with v+ and v- both in its support.
fn box_of_both_halves(cases: &mut Cases) {
    let right = &GOOD[2];
    let problem = problem(Unknown::Lambda2, right.a, right.b, whole(1));
    let mut forged = enclosed(&problem, &right.motion);
    forged.support = vec![0, 2, 3];

    cases.reject(
        "zero-both-ways-box",
        "BothHalves",
        "v+ and v- in the support: x is not zero, v may be",
        &problem,
        &claims(&problem, Claim::EnclosedSolution(forged)),
    );
}

/// The motion without the friction factor of the particle: no zero of the equations.
const FACTOR_LEFT_OUT: Wrong = Wrong {
    name: "factor-left-out",
    reason: "NotContracting",
    line: false,
    note: "the motion without the friction factor of the particle",
    a: "1",
    b: "6",
    motion: GOOD[2].motion,
};

const WRONG_BOXES: [Wrong; 12] = [
    Wrong {
        name: "pulled",
        reason: "YNotPositive",
        line: false,
        note: "w_N <= 0: the obstacle would have to pull a particle at rest",
        a: "-1",
        b: "0",
        motion: AT_REST,
    },
    Wrong {
        name: "pulled-and-slides",
        reason: "YNotPositive",
        line: false,
        note: "w_N <= 0: the obstacle would have to pull a particle that slides",
        a: "-1",
        b: "0",
        motion: Motion {
            support: &[0, 2],
            biactive: &[],
            sliding: "1/4",
            normal: "0",
        },
    },
    Wrong {
        name: "outside-the-cone-to-the-right",
        reason: "YNotPositive",
        line: false,
        note: "-w_T + mu w_N <= 0: at rest outside the cone, it would slide to the right",
        a: "1",
        b: "6",
        motion: AT_REST,
    },
    Wrong {
        name: "outside-the-cone-to-the-left",
        reason: "YNotPositive",
        line: false,
        note: "w_T + mu w_N <= 0: at rest outside the cone, it would slide to the left",
        a: "1",
        b: "-6",
        motion: AT_REST,
    },
    Wrong {
        name: "penetrates",
        reason: "XNotPositive",
        line: false,
        note: "v_N <= 0: an open particle that moves into the obstacle",
        a: "3",
        b: "3",
        motion: Motion {
            support: &[0, 1, 2],
            biactive: &[],
            sliding: "1/4",
            normal: "1/4",
        },
    },
    Wrong {
        name: "right-with-friction",
        reason: "XNotPositive",
        line: false,
        note: "the reaction of a particle that slides to the right, but it slides to the left",
        a: "1",
        b: "-6",
        motion: Motion {
            support: &[0, 2],
            biactive: &[],
            sliding: "-3/4",
            normal: "0",
        },
    },
    Wrong {
        name: "left-with-friction",
        reason: "XNotPositive",
        line: false,
        note: "the reaction of a particle that slides to the left, but it slides to the right",
        a: "1",
        b: "6",
        motion: Motion {
            support: &[0, 3],
            biactive: &[],
            sliding: "3/4",
            normal: "0",
        },
    },
    Wrong {
        name: "open-to-the-wrong-side",
        reason: "XNotPositive",
        line: false,
        note: "an open particle said to slide to the left that slides to the right",
        a: "-3",
        b: "3",
        motion: Motion {
            support: &[0, 1, 3],
            biactive: &[],
            sliding: "1/4",
            normal: "-1/4",
        },
    },
    Wrong {
        name: "open-with-friction",
        reason: "YNotPositive",
        line: false,
        note: "an open particle that does not slide: w_T is not 0; no half is in the support, so \
               none of their rows vanishes",
        a: "-3",
        b: "3",
        motion: Motion {
            support: &[0, 1],
            biactive: &[],
            sliding: "0",
            normal: "-1/4",
        },
    },
    Wrong {
        name: "open-at-rest",
        reason: "YNotPositive",
        line: false,
        note: "a true solution: the particle opens and v_T = w_T = 0, which no box shows",
        a: "-3",
        b: "0",
        motion: Motion {
            support: &[0, 1],
            biactive: &[],
            sliding: "0",
            normal: "-1/4",
        },
    },
    Wrong {
        name: "grazing",
        reason: "YNotPositive",
        line: false,
        note: "a true solution: v_N = w_N = 0, which no box shows",
        a: "0",
        b: "6",
        motion: Motion {
            support: &[0, 2],
            biactive: &[],
            sliding: "1/2",
            normal: "0",
        },
    },
    Wrong {
        name: "open-and-pressed",
        reason: "NotContracting",
        line: false,
        note: "v_N w_N = 0: the particle opens although it is pressed",
        a: "3",
        b: "0",
        motion: Motion {
            support: &[0, 1],
            biactive: &[],
            sliding: "0",
            normal: "-1/8",
        },
    },
];

/// The certificate of the box.
fn box_around(problem: &Problem, motion: &Motion) -> Certificate {
    claims(problem, Claim::EnclosedSolution(enclosed(problem, motion)))
}

/// Binary exponents of the radii and of the preconditioner.
const RADIUS_BITS: usize = 12;
const INVERSE_BITS: u32 = 24;

/// A box around the motion at the value 2, its preconditioner the inverse of F' rounded down. All
/// degrees of freedom belong to particles, so the active variables are those of the support.
fn enclosed(problem: &Problem, motion: &Motion) -> EnclosedSolution {
    enclosed_x(problem, motion.support, &motion.components())
}

/// The same around x.
pub fn enclosed_x(problem: &Problem, support: &[usize], x: &[Rational]) -> EnclosedSolution {
    let sum: Rational = support.iter().map(|&i| &x[i]).sum();
    let mut center: Vec<Rational> = support.iter().map(|&i| &x[i] / &sum).collect();
    let jacobian = jacobian(problem, support, &center);
    center.push(whole(2));

    let unit = Rational::from_integer(Integer::from(1) << INVERSE_BITS);
    let mut preconditioner = Vec::new();
    for row in inverse(jacobian) {
        let rounded = row.iter().map(|entry| (entry * &unit).floor().to_integer());
        preconditioner.push(rounded.collect());
    }

    let radius = Rational::new(1.into(), Integer::from(1) << RADIUS_BITS);
    EnclosedSolution {
        support: support.to_vec(),
        radius: vec![Number(radius); center.len()],
        center: center.into_iter().map(Number).collect(),
        preconditioner,
        exponent: INVERSE_BITS,
    }
}

/// F' at t = 2: for each variable of the support its row f_i (A + 2 B) and f_i (B x)_i, then the
/// sum of the support.
fn jacobian(problem: &Problem, support: &[usize], x: &[Rational]) -> Vec<Vec<Rational>> {
    let split = split_form(system(problem), problem.unknown()).unwrap();
    let a = split.pencil.a();
    let b = split.pencil.b();
    let mut jacobian = Vec::new();
    for &i in support {
        let entries = a.row(i).iter().chain(b.row(i));
        let factor = Rational::from_integer(common_denominator(entries.map(|(_, value)| value)));

        let mut row = Vec::new();
        let mut of_t = whole(0);
        for (&j, x_j) in support.iter().zip(x) {
            let b_ij = entry(b.row(i), j);
            row.push((entry(a.row(i), j) + &b_ij * whole(2)) * &factor);
            of_t += b_ij * x_j * &factor;
        }
        row.push(of_t);
        jacobian.push(row);
    }

    let mut of_sum = vec![whole(1); support.len()];
    of_sum.push(whole(0));
    jacobian.push(of_sum);
    jacobian
}

fn entry(row: &[(usize, Rational)], column: usize) -> Rational {
    let found = row.iter().find(|(j, _)| *j == column);
    found.map_or(whole(0), |(_, value)| value.clone())
}

/// The inverse of a regular matrix, by Gauss and Jordan.
fn inverse(mut matrix: Vec<Vec<Rational>>) -> Vec<Vec<Rational>> {
    let n = matrix.len();
    for (i, row) in matrix.iter_mut().enumerate() {
        for k in 0..n {
            row.push(whole(i64::from(i == k)));
        }
    }

    for column in 0..n {
        let has_pivot = |&i: &usize| matrix[i][column] != whole(0);
        let pivot = (column..n).find(has_pivot).expect("a regular matrix");
        matrix.swap(column, pivot);
        let lead = matrix[column][column].clone();
        for entry in &mut matrix[column] {
            *entry /= &lead;
        }

        let pivot_row = matrix[column].clone();
        for (i, row) in matrix.iter_mut().enumerate() {
            if i == column {
                continue;
            }
            let factor = row[column].clone();
            for (entry, of_pivot) in row.iter_mut().zip(&pivot_row) {
                *entry -= &factor * of_pivot;
            }
        }
    }

    matrix.into_iter().map(|row| row[n..].to_vec()).collect()
}
