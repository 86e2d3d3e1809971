//! The cases of `spec/corpus`: written by `tests/checker/corpus.rs`, read by it and by anybody's
//! checker.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip::certificate::{
    Certificate, Claim, CompleteSet, EnclosedSolution, ExactSolution, Ldl, LdlFactor,
    LiftedSolution, Node, Piece, Root, RootOutcome,
};
use mceip::certify::{certificate, lifted};
use mceip::exact::{Integer, Rational, Sparse, parse, rational, whole};
use mceip::model::file::{Number, write_problem};
use mceip::model::{Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window};
use mceip::run::Watch;
use mceip::search::complete::{Options, complete};
use serde_json::{Value, json};

/// One file of the corpus.
pub struct Case {
    pub folder: &'static str,
    pub name: String,
    pub file: Value,
}

#[derive(Default)]
pub struct Cases(pub Vec<Case>);

impl Cases {
    pub fn push(&mut self, folder: &'static str, name: &str, mut file: Value, note: &str) {
        file["format"] = json!("mceip-corpus/1");
        file["note"] = json!(note);
        assert!(
            self.0
                .iter()
                .all(|c| (c.folder, c.name.as_str()) != (folder, name)),
            "{name} twice"
        );
        self.0.push(Case {
            folder,
            name: name.into(),
            file,
        });
    }

    pub fn accept(&mut self, name: &str, note: &str, problem: &Problem, c: &Certificate) {
        self.push(
            "accept",
            name,
            json!({ "verdict": "accepted", "problem": of(problem), "certificate": text(c) }),
            note,
        );
    }

    pub fn undecided(&mut self, name: &str, note: &str, problem: &Problem, c: &Certificate) {
        let file =
            json!({ "verdict": "undecided", "problem": of(problem), "certificate": text(c) });
        self.push("accept", name, file, note);
    }

    pub fn reject(
        &mut self,
        name: &str,
        reason: &str,
        note: &str,
        problem: &Problem,
        c: &Certificate,
    ) {
        let file = json!({ "verdict": "rejected", "reason": reason, "problem": of(problem), "certificate": text(c) });
        self.push("reject", name, file, note);
    }
}

fn of(problem: &Problem) -> Value {
    serde_json::from_str(&write_problem(problem)).unwrap()
}

fn text(c: &Certificate) -> Value {
    serde_json::from_str(&c.to_json()).unwrap()
}

pub fn sparse(rows: &[&[&str]]) -> Sparse {
    let entries = rows.iter().enumerate().flat_map(|(i, r)| {
        r.iter()
            .enumerate()
            .map(move |(j, v)| (i, j, parse(v).unwrap()))
    });
    Sparse::from_entries(rows.len(), rows.len(), entries.collect::<Vec<_>>())
}

pub fn pencil(a: &[&[&str]], b: &[&[&str]], free: &[usize]) -> Problem {
    let pencil = Pencil::new(sparse(a), sparse(b), free.to_vec()).unwrap();
    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

pub const I2: &[&[&str]] = &[&["1", "0"], &["0", "1"]];
pub const ZERO2: &[&[&str]] = &[&["0", "0"], &["0", "0"]];

pub fn q(text: &str) -> Number {
    Number(parse(text).unwrap())
}

pub fn numbers(list: &[&str]) -> Vec<Number> {
    list.iter().map(|t| q(t)).collect()
}

pub fn exact(support: &[usize], p: &[i64], interval: (&str, &str), x: &[&[&str]]) -> ExactSolution {
    ExactSolution {
        support: support.to_vec(),
        biactive: vec![],
        polynomial: p.iter().map(|&c| c.into()).collect(),
        interval: [q(interval.0), q(interval.1)],
        x: x.iter().map(|p| numbers(p)).collect(),
    }
}

pub fn claims(problem: &Problem, claim: Claim) -> Certificate {
    certificate(problem, vec![claim])
}

/// t = sqrt 2 - 1, x = (1, t + 1), the third variable sticks.
pub fn root_two() -> (Problem, ExactSolution) {
    let a: &[&[&str]] = &[&["1", "-1", "0"], &["-2", "1", "0"], &["1", "0", "9"]];
    let p = pencil(
        a,
        &[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]],
        &[],
    );
    (
        p,
        exact(
            &[0, 1],
            &[-1, 2, 1],
            ("2/5", "1/2"),
            &[&["1"], &["1", "1"], &[]],
        ),
    )
}

/// x = (1/2, 1/2), t = 3 of [[-1, -2], [-2, -1]] + t I, exact inverse as preconditioner.
pub fn boxed() -> (Problem, EnclosedSolution) {
    let p = pencil(&[&["-1", "-2"], &["-2", "-1"]], I2, &[]);
    let preconditioner = [[2, -2, 8], [-2, 2, 8], [16, 16, 0]]
        .map(|r| r.map(Integer::from).to_vec())
        .to_vec();
    let radius = vec![Number(rational(1, 1 << 20)); 3];
    (
        p,
        EnclosedSolution {
            support: vec![0, 1],
            center: numbers(&["0.5", "0.5", "3"]),
            radius,
            preconditioner,
            exponent: 4,
        },
    )
}

/// Free dof 0, slip particle (1, 2) with S = 1, stick particle (3, 4), a second slip particle (5,
/// 6) that rests.
pub fn mechanical(unknown: Unknown) -> Problem {
    let mut k = vec![
        (0, 1, 1),
        (1, 0, 1),
        (1, 2, -9),
        (2, 1, -9),
        (1, 5, 1),
        (5, 1, 1),
    ];
    k.extend((0..7).map(|i| (i, i, 4)));
    let k = Sparse::from_entries(7, 7, k.into_iter().map(|(i, j, v)| (i, j, whole(v))));
    let slip = ContactState::Slip { sign: 1 };
    let particles = vec![
        Particle::plain(1, 2, slip),
        Particle::plain(3, 4, ContactState::Stick),
        Particle::plain(5, 6, slip),
    ];
    let system = System::new(k, Some(Sparse::identity(7)), Some(whole(2)), particles).unwrap();
    Problem::new(Body::System(system), unknown, Window::all()).unwrap()
}

pub fn system(problem: &Problem) -> &System {
    match problem.body() {
        Body::System(s) => s,
        Body::Pencil(_) => unreachable!("a system"),
    }
}

pub fn completed(problem: &Problem) -> Certificate {
    let options = Options {
        pieces: 2,
        threads: Some(1),
        ..Options::default()
    };
    complete(problem, &options, &Watch::nobody())
        .unwrap()
        .certificate
}

pub fn lift(problem: &Problem, claim: &ExactSolution) -> LiftedSolution {
    lifted(system(problem), problem.unknown(), claim)
}

/// A certificate of a complete set over one piece.
pub fn cover(problem: &Problem, tree: Vec<Node>) -> Certificate {
    let piece = Piece {
        max: problem.window().max().cloned().map(Number),
        anchor: None,
        tree,
    };
    Certificate {
        complete_set: Some(CompleteSet {
            condensation: None,
            pieces: vec![piece],
        }),
        ..certificate(problem, Vec::new())
    }
}

pub fn window(problem: Problem, lo: &str, hi: Option<&str>) -> Problem {
    let window = Window::new(parse(lo).unwrap(), hi.map(|h| parse(h).unwrap())).unwrap();
    problem.with_window(window)
}

/// lambda^2 = 2 with x = (2, 1) and 3 with (3, 2).
pub fn fold(lo: &str, hi: Option<&str>) -> Problem {
    window(pencil(&[&["1", "-6"], &["2", "-6"]], I2, &[]), lo, hi)
}

/// The witness of lambda^2 = 2: v = (1, 1/2), u = (1, -3/2), Y = -2, all exact there.
pub fn fold_root(interval: (&str, &str), outcome: RootOutcome) -> Root {
    let int = |v: i64| vec![Integer::from(v)];
    Root {
        pivot: 0,
        interval: [q(interval.0), q(interval.1)],
        inverse: vec![int(-2)],
        inverse_exponent: 0,
        left: int(-3 << 19),
        right: int(1 << 19),
        exponent: 20,
        outcome,
    }
}

/// Every support but {0, 1} closed by Farkas vectors (for values below 6), that one by `leaf`.
pub fn fold_tree(leaf: Node) -> Vec<Node> {
    let farkas = |w: [i64; 2]| Node::Farkas(w.to_vec());
    vec![
        Node::Branch(0),
        Node::Branch(1),
        farkas([0, 0]),
        farkas([0, 1]),
        Node::Branch(1),
        farkas([-1, 0]),
        leaf,
    ]
}

pub fn root_node(interval: (&str, &str), outcome: RootOutcome) -> Node {
    Node::Root(Box::new(fold_root(interval, outcome)))
}

pub fn factor(rows: &[&[&str]], diagonal: &[&str]) -> LdlFactor {
    LdlFactor {
        rows: rows.iter().map(|r| numbers(r)).collect(),
        diagonal: numbers(diagonal),
    }
}

pub fn ldl(lower: LdlFactor, upper: LdlFactor) -> Node {
    Node::Ldl(Box::new(Ldl { lower, upper }))
}

pub fn tiny() -> Rational {
    rational(1, 1_000_000_000_000)
}
