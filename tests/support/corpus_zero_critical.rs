//! Absence below a friction with a particle in contact with zero reaction: accepted files, and
//! forgeries of each rule that it adds (`spec/certificates.md`, 5.18).
//!
//! *Pressed.* Particle 0 on (T, N) = (0, 1) slips with S = 1, particle 1 on (2, 3) has zero
//! reaction and the friction factor c, M = I and
//!
//! ```text
//!     K = [  1   -1  1/2  1/4 ]     y_x     = (a - mu) x + gap/4 - (right - left)/2
//!         [ -1    3   0    0  ]     y_gap   = x/4 + a gap
//!         [ 1/2   0   1    0  ]     y_right = -(x/2 - a (right - left)) + c mu (x/4 + a gap)
//!         [ 1/4   0   0    1  ]     y_left  =  (x/2 - a (right - left)) + c mu (x/4 + a gap)
//! ```
//!
//! with a = 1 + t, the variables x = 0, gap = 1, right = 2 and left = 3, and all rows divided by 2.
//! Where x moves, y_gap > 0, so the particle does not open. It slides to the right while c mu < 2,
//! and then mu (a - c/8) = a^2 - 1/4: the critical friction is that at a = 1, namely 6/7 for c = 1
//! and 4/5 for c = 1/2. It would be 1 if the particle stuck, and 3/4 without friction on it.
#![allow(missing_docs, unreachable_pub)]

use super::corpus_cases::{Cases, q};
use super::corpus_critical::{accept, certificate, farkas, identity, no_factor, piece, reject};
use mceip_check::certificate::CriticalNode::{self, Branch, PositiveDefinite, Tail};
use mceip_check::certificate::{
    CriticalAnchor, CriticalCertificate, CriticalCondensation, CriticalPiece, CriticalTail,
    IntegerMatrix,
};
use mceip_exact::{Rational, Sparse, rational, whole};
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};

const X: usize = 0;
const GAP: usize = 1;
const RIGHT: usize = 2;
const LEFT: usize = 3;

pub fn absence(cases: &mut Cases) {
    accepted(cases);
    forged_trees(cases);
    tails(cases);
}

/// Particle 0 on these dofs slips with S = 1, the other one has zero reaction; M = I, and K has
/// these entries (row, column, value), given once.
fn system(
    dofs: usize,
    [slip, zero]: [Particle; 2],
    stiffness: &[(usize, usize, Rational)],
) -> Problem {
    let mut entries = Vec::new();
    for (i, j, value) in stiffness {
        entries.push((*i, *j, value.clone()));
        if i != j {
            entries.push((*j, *i, value.clone()));
        }
    }

    let stiffness = Sparse::from_entries(dofs, dofs, entries);
    let mass = Some(Sparse::from_entries(dofs, dofs, identity(dofs)));
    let system = System::new(stiffness, mass, Some(whole(3)), vec![slip, zero]).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}

fn slipping(tangential: usize, normal: usize) -> Particle {
    Particle::plain(tangential, normal, ContactState::Slip { sign: 1 })
}

fn zero(tangential: usize, normal: usize) -> Particle {
    Particle::plain(tangential, normal, ContactState::Zero)
}

fn pressed(friction_factor: Rational) -> Problem {
    let stiffness = [
        (0, 0, whole(1)),
        (0, 1, whole(-1)),
        (0, 2, rational(1, 2)),
        (0, 3, rational(1, 4)),
        (1, 1, whole(3)),
        (2, 2, whole(1)),
        (3, 3, whole(1)),
    ];
    let zero = Particle {
        friction_factor,
        ..zero(2, 3)
    };
    system(4, [slipping(0, 1), zero], &stiffness)
}

/// x at rest: definite with one half. x moves: y_gap > 0; y_x < 0 without right, up to a factor;
/// and with right moving -2 y_x - y_right has the columns -2 (a - mu) + 1/2 - c mu/4 and 1 - a.
fn tree() -> Vec<CriticalNode> {
    vec![
        Branch(X),
        Branch(RIGHT),
        PositiveDefinite,
        PositiveDefinite,
        Branch(GAP),
        Branch(RIGHT),
        farkas(&[-1, 0, 0, 0]),
        farkas(&[-2, 0, -1, 0]),
        farkas(&[0, -1, 0, 0]),
    ]
}

fn below(problem: &Problem, friction: &str, tree: Vec<CriticalNode>) -> CriticalCertificate {
    certificate(problem, friction, vec![piece(None, tree)])
}

fn accepted(cases: &mut Cases) {
    let problem = apart();
    let for_each_half = vec![Branch(RIGHT), PositiveDefinite, PositiveDefinite];
    let note = "definite with one half of v_T";
    let good = below(&problem, "3/4", for_each_half);
    accept(cases, "zero-apart", note, &problem, &good);

    let problem = pressed(whole(1));
    accept(
        cases,
        "zero",
        "between the thresholds without friction on the particle (3/4) and with it (6/7)",
        &problem,
        &below(&problem, "4/5", tree()),
    );

    let factor = pressed(rational(1, 2));
    accept(
        cases,
        "zero-factor",
        "the friction of the particle is mu/2, and the critical friction 4/5",
        &factor,
        &below(&factor, "0.799999", tree()),
    );
}

/// The system of the example `critical` beside a particle with zero reaction that it does not
/// touch.
fn apart() -> Problem {
    let stiffness = [
        (0, 0, whole(1)),
        (0, 1, whole(-1)),
        (1, 1, whole(3)),
        (2, 2, whole(1)),
        (3, 3, whole(1)),
    ];
    system(4, [slipping(0, 1), zero(2, 3)], &stiffness)
}

fn forged_trees(cases: &mut Cases) {
    let problem = apart();
    reject(
        cases,
        [
            "zero-reaction",
            "Cover.NotDefinite",
            "both halves of v_T may move: no symmetric part is definite",
        ],
        &problem,
        &below(&problem, "3/4", vec![PositiveDefinite]),
    );

    let problem = pressed(whole(1));
    let mut both_halves = tree();
    both_halves.splice(3..4, [Branch(LEFT), PositiveDefinite, PositiveDefinite]);
    reject(
        cases,
        [
            "zero-other-half",
            "Cover.Branch",
            "a branch on left where right moves: left is at rest there",
        ],
        &problem,
        &below(&problem, "4/5", both_halves),
    );

    let mut half_forgotten = tree();
    half_forgotten.splice(6..8, [farkas(&[-2, 0, -1, 0])]);
    half_forgotten.remove(5);
    reject(
        cases,
        [
            "zero-left-forgotten",
            "Cover.NegativeWeight",
            "the Farkas vector of right moving, where neither half is decided",
        ],
        &problem,
        &below(&problem, "4/5", half_forgotten),
    );

    reject(
        cases,
        [
            "zero-at-the-threshold",
            "Cover.NotStrict",
            "at mu = 6/7 there is a solution with lambda = 0",
        ],
        &problem,
        &below(&problem, "6/7", tree()),
    );
    reject(
        cases,
        [
            "zero-as-stick",
            "Cover.NotNegative",
            "true if the particle stuck",
        ],
        &problem,
        &below(&problem, "0.99", tree()),
    );

    let factor = pressed(rational(1, 2));
    reject(
        cases,
        [
            "zero-factor-forgotten",
            "Cover.NotStrict",
            "true if the friction of the particle were mu",
        ],
        &factor,
        &below(&factor, "4/5", tree()),
    );
}

/// The system of the example `critical-free` with a particle of zero reaction on (3, 4), the
/// tangent of which is coupled to that of the slip particle.
fn with_a_free_dof(coupling: Rational) -> Problem {
    let stiffness = [
        (0, 0, whole(4)),
        (0, 1, whole(2)),
        (0, 2, whole(2)),
        (1, 1, whole(3)),
        (1, 3, coupling),
        (2, 2, whole(4)),
        (3, 3, whole(1)),
        (4, 4, whole(1)),
    ];
    system(5, [slipping(1, 2), zero(3, 4)], &stiffness)
}

/// -1/2 at the slip particle, 0 at the variables of the other one.
fn expansion() -> Vec<IntegerMatrix> {
    let row = [-1, 0, 0, 0].map(mceip_exact::Integer::from);
    vec![IntegerMatrix {
        exponent: 1,
        rows: vec![row.into_iter().collect()],
    }]
}

/// Definite for each half over [0, 1], and a tail. Free in the tail are the dofs 0, 3 and 4.
fn with_tail(problem: &Problem) -> CriticalCertificate {
    let condensation = CriticalCondensation {
        sigma: q("4"),
        stiffness_factor: no_factor(1),
        mass_sigma: q("1"),
        mass_factor: None,
        anchors: vec![CriticalAnchor {
            center: q("0"),
            reversed: false,
            right: expansion(),
            left: Some(expansion()),
            left_friction: expansion(),
        }],
        tail: Some(CriticalTail {
            from: q("1"),
            factor: no_factor(4),
            factor_below: no_factor(4),
            mass_factor: None,
            mass_factor_below: None,
        }),
    };
    let right_of_slip = 3; // after the free variable, x and the gap
    let first = CriticalPiece {
        anchor: Some(0),
        ..piece(
            Some("1"),
            vec![Branch(right_of_slip), PositiveDefinite, PositiveDefinite],
        )
    };

    CriticalCertificate {
        condensation: Some(condensation),
        ..certificate(problem, "1", vec![first, piece(None, vec![Tail])])
    }
}

fn tails(cases: &mut Cases) {
    let problem = with_a_free_dof(rational(1, 2));
    let good = with_tail(&problem);
    let note = "the tail is one of the system in which the particle is free";
    accept(cases, "zero-tail", note, &problem, &good);

    for (name, order, note) in [
        (
            "stick",
            2,
            "a tail of the system in which the particle sticks",
        ),
        (
            "split",
            5,
            "a tail of the pencil of the cover, which has both halves",
        ),
    ] {
        let mut forged = good.clone();
        let condensation = forged.condensation.as_mut().unwrap();
        let tail = condensation.tail.as_mut().unwrap();
        tail.factor = no_factor(order);
        tail.factor_below = no_factor(order);
        let name = format!("zero-tail-{name}");
        reject(cases, [&name, "Cover.Length", note], &problem, &forged);
    }

    // 5 - 2 - 2 at the row of the slip particle, mu = 0: no dominance.
    let coupled = with_a_free_dof(whole(2));
    let note = "the coupling to the particle outweighs the diagonal at the beginning of the tail";
    let forged = with_tail(&coupled);
    reject(
        cases,
        ["zero-tail-coupled", "Cover.Hypothesis", note],
        &coupled,
        &forged,
    );
}
