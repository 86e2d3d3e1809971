//! Claims about a system with a particle in contact with zero reaction: one solution for each of
//! its modes and corners, and a forgery of each condition on it (`spec/zero-reaction.md`).
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
    Certificate, Claim, CompleteSet, EnclosedSolution, ExactSolution, LiftedSolution, Node, Piece,
};
use mceip_exact::{Rational, Sparse, parse, rational, whole};
use mceip_model::file::Number;
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};

/// The problem with these couplings, and the friction factor of particle 1.
fn problem(unknown: Unknown, a: &str, b: &str, friction_factor: Rational) -> Problem {
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
struct Motion {
    support: &'static [usize],
    biactive: &'static [usize],
    /// v_2.
    sliding: &'static str,
    /// v_3.
    normal: &'static str,
}

impl Motion {
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
    unsupported(cases);
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

/// Evidence that is not defined for particles with zero reaction.
fn unsupported(cases: &mut Cases) {
    let stick = &GOOD[1];
    let problem = problem(Unknown::Lambda2, stick.a, stick.b, whole(1));

    let enclosed = EnclosedSolution {
        support: vec![0],
        center: numbers(&["1", "2"]),
        radius: numbers(&["1/8", "1/8"]),
        preconditioner: vec![vec![0.into(), 1.into()], vec![1.into(), 0.into()]],
        exponent: 0,
    };
    cases.reject(
        "zero-enclosed",
        "ZeroReaction",
        "an enclosed claim of a true solution: not defined with zero reaction",
        &problem,
        &claims(&problem, Claim::EnclosedSolution(enclosed)),
    );

    let open = Certificate {
        complete_set: Some(CompleteSet {
            condensation: None,
            pieces: vec![Piece {
                max: None,
                anchor: None,
                tree: vec![Node::Open],
            }],
        }),
        ..exact_certificate(&problem, &stick.motion.exact())
    };
    cases.reject(
        "zero-cover",
        "ZeroReaction",
        "a cover that proves nothing: not defined with zero reaction",
        &problem,
        &open,
    );
}
