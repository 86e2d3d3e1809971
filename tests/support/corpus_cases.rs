//! What the generators of `spec/corpus` share: the list of files, the pencils and systems that the
//! files are about, and certificates for them.
//!
//! `tests/checker/corpus.rs` writes the files and reads them back, and so can the author of any
//! other checker. Each file holds a problem, a certificate, the verdict, for a rejection the
//! obligation that fails, and a note that names the bug for which the file stands.
//!
//! Forgeries are data: something accepted, a change of it, the obligation that must fail. As the
//! unchanged certificate is a file of the corpus too, a checker that rejects everything is noticed
//! as well as one that has lost an obligation.
#![allow(dead_code, missing_docs, unreachable_pub)]

use mceip_check::certificate::{
    Certificate, Claim, CompleteSet, EnclosedSolution, ExactSolution, Ldl, LdlFactor,
    LiftedSolution, Node, Piece, Root, RootOutcome,
};
use mceip_engine::certify::{certificate, lifted};
use mceip_engine::run::Watch;
use mceip_engine::search::complete::{Options, complete};
use mceip_exact::{Integer, Rational, Sparse, parse, rational, whole};
use mceip_model::file::{Number, write_problem};
use mceip_model::{Body, ContactState, Particle, Pencil, Problem, System, Unknown, Window};
use serde_json::{Value, json};

/// One file of the corpus.
pub struct Case {
    pub folder: &'static str,
    pub name: String,
    pub file: Value,
}

#[derive(Default)]
pub struct Cases(pub Vec<Case>);

/// A text with one mark `@`, to be replaced by copies of a unit.
pub struct Repeated<'a> {
    pub text: String,
    pub unit: &'a str,
    pub count: usize,
}

/// A change of something that is accepted, and the obligation of the checker that it breaks.
pub struct Forgery<Subject> {
    pub name: &'static str,
    /// The obligation, as the checker names it.
    pub reason: &'static str,
    /// The bug for which the file stands.
    pub note: &'static str,
    pub change: fn(&mut Subject),
}

impl<Subject: Clone> Forgery<Subject> {
    pub fn of(&self, good: &Subject) -> Subject {
        let mut forged = good.clone();
        (self.change)(&mut forged);
        forged
    }
}

/// A change of a certificate's text after which the text is no certificate.
pub struct Misspelling {
    pub name: &'static str,
    /// What the text now says.
    pub note: &'static str,
    pub from: &'static str,
    pub to: &'static str,
}

impl Cases {
    /// Adds a file; no two files of a folder have the same name.
    pub fn push(&mut self, folder: &'static str, name: &str, mut file: Value, note: &str) {
        file["format"] = json!("mceip-corpus/1");
        file["note"] = json!(note);

        let is_taken = self
            .0
            .iter()
            .any(|case| case.folder == folder && case.name == name);
        assert!(!is_taken, "{name} twice");

        self.0.push(Case {
            folder,
            name: name.into(),
            file,
        });
    }

    /// A small file that asks for much: rejected, with the limit named.
    pub fn too_large(
        &mut self,
        [name, reason, note]: [&str; 3],
        problem: &Problem,
        certificate: &Repeated<'_>,
    ) {
        let file = json!({
            "verdict": "rejected",
            "reason": reason,
            "problem": problem_json(problem),
            "certificate_text": certificate.text,
            "repeat": { "mark": "@", "unit": certificate.unit, "count": certificate.count },
        });
        self.push("reject", name, file, note);
    }

    pub fn accept(&mut self, name: &str, note: &str, problem: &Problem, good: &Certificate) {
        let file = json!({
            "verdict": "accepted",
            "problem": problem_json(problem),
            "certificate": certificate_json(good),
        });
        self.push("accept", name, file, note);
    }

    /// Nothing in the certificate is wrong, but a region stays open (exit 3).
    pub fn undecided(&mut self, name: &str, note: &str, problem: &Problem, open: &Certificate) {
        let file = json!({
            "verdict": "undecided",
            "problem": problem_json(problem),
            "certificate": certificate_json(open),
        });
        self.push("accept", name, file, note);
    }

    pub fn reject(
        &mut self,
        name: &str,
        reason: &str,
        note: &str,
        problem: &Problem,
        forged: &Certificate,
    ) {
        let file = json!({
            "verdict": "rejected",
            "reason": reason,
            "problem": problem_json(problem),
            "certificate": certificate_json(forged),
        });
        self.push("reject", name, file, note);
    }

    /// A text that is no certificate (exit 2).
    pub fn malformed(&mut self, name: &str, note: &str, problem: &Problem, text: &str) {
        let file = json!({
            "verdict": "malformed",
            "problem": problem_json(problem),
            "certificate_text": text,
        });
        self.push("malformed", name, file, note);
    }

    /// One malformed file for each misspelling of the text of a certificate.
    pub fn misspelt(&mut self, prefix: &str, problem: &Problem, text: &str, list: &[Misspelling]) {
        for misspelling in list {
            let name = format!("{prefix}{}", misspelling.name);
            let changed = replaced(text, misspelling.from, misspelling.to);
            self.malformed(&name, misspelling.note, problem, &changed);
        }
    }
}

/// The text with the first occurrence of `from`, of which there is one at least, replaced.
pub fn replaced(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from} not in {text}");
    text.replacen(from, to, 1)
}

pub fn problem_json(problem: &Problem) -> Value {
    serde_json::from_str(&write_problem(problem)).unwrap()
}

pub fn certificate_json(certificate: &Certificate) -> Value {
    serde_json::from_str(&certificate.to_json()).unwrap()
}

/// The square matrix with these rows.
pub fn sparse(rows: &[&[&str]]) -> Sparse {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            entries.push((i, j, parse(entry).unwrap()));
        }
    }

    Sparse::from_entries(rows.len(), rows.len(), entries)
}

/// The eigenproblem of A + t B for t = lambda^2 in [0, infinity).
pub fn pencil(a: &[&[&str]], b: &[&[&str]], free: &[usize]) -> Problem {
    let a = sparse(a);
    let b = sparse(b);
    let pencil = Pencil::new(a, b, free.to_vec()).unwrap();

    Problem::new(Body::Pencil(pencil), Unknown::Lambda2, Window::all()).unwrap()
}

pub const I2: &[&[&str]] = &[&["1", "0"], &["0", "1"]];
pub const I3: &[&[&str]] = &[&["1", "0", "0"], &["0", "1", "0"], &["0", "0", "1"]];
pub const ZERO2: &[&[&str]] = &[&["0", "0"], &["0", "0"]];

pub fn q(text: &str) -> Number {
    Number(parse(text).unwrap())
}

pub fn numbers(list: &[&str]) -> Vec<Number> {
    list.iter().map(|text| q(text)).collect()
}

/// An exact claim without biactive variables: t is the root of `polynomial` in `interval`, and x is
/// given by a polynomial in t for each variable.
pub fn exact(
    support: &[usize],
    polynomial: &[i64],
    interval: [&str; 2],
    x: &[&[&str]],
) -> ExactSolution {
    ExactSolution {
        support: support.to_vec(),
        biactive: vec![],
        polynomial: polynomial.iter().map(|&c| c.into()).collect(),
        interval: interval.map(q),
        x: x.iter().map(|component| numbers(component)).collect(),
    }
}

pub fn claims(problem: &Problem, claim: Claim) -> Certificate {
    certificate(problem, vec![claim])
}

pub fn exact_certificate(problem: &Problem, claim: &ExactSolution) -> Certificate {
    claims(problem, Claim::ExactSolution(claim.clone()))
}

/// t = sqrt 2 - 1, x = (1, t + 1), the third variable sticks.
pub fn root_two() -> (Problem, ExactSolution) {
    let a: &[&[&str]] = &[&["1", "-1", "0"], &["-2", "1", "0"], &["1", "0", "9"]];
    let problem = pencil(a, I3, &[]);

    let x: &[&[&str]] = &[&["1"], &["1", "1"], &[]];
    let claim = exact(&[0, 1], &[-1, 2, 1], ["2/5", "1/2"], x);
    (problem, claim)
}

/// x = (1/2, 1/2), t = 3 of [[-1, -2], [-2, -1]] + t I, exact inverse as preconditioner.
pub fn boxed() -> (Problem, EnclosedSolution) {
    let problem = pencil(&[&["-1", "-2"], &["-2", "-1"]], I2, &[]);

    let sixteen_times_inverse = [[2, -2, 8], [-2, 2, 8], [16, 16, 0]];
    let claim = EnclosedSolution {
        support: vec![0, 1],
        center: numbers(&["0.5", "0.5", "3"]),
        radius: vec![Number(rational(1, 1 << 20)); 3],
        preconditioner: sixteen_times_inverse
            .map(|row| row.map(Integer::from).to_vec())
            .to_vec(),
        exponent: 4,
    };
    (problem, claim)
}

/// Free dof 0, slip particle (1, 2) with S = 1, stick particle (3, 4), a second slip particle (5,
/// 6) that rests.
pub fn mechanical(unknown: Unknown) -> Problem {
    let couplings = [
        (0, 1, 1),
        (1, 0, 1),
        (1, 2, -9),
        (2, 1, -9),
        (1, 5, 1),
        (5, 1, 1),
    ];
    let mut entries: Vec<_> = couplings.map(|(i, j, k)| (i, j, whole(k))).to_vec();
    entries.extend((0..7).map(|i| (i, i, whole(4))));
    let stiffness = Sparse::from_entries(7, 7, entries);
    let mass = Sparse::identity(7);
    let friction = whole(2);

    let slip = ContactState::Slip { sign: 1 };
    let particles = vec![
        Particle::plain(1, 2, slip),
        Particle::plain(3, 4, ContactState::Stick),
        Particle::plain(5, 6, slip),
    ];
    let system = System::new(stiffness, Some(mass), Some(friction), particles).unwrap();
    Problem::new(Body::System(system), unknown, Window::all()).unwrap()
}

pub fn system(problem: &Problem) -> &System {
    match problem.body() {
        Body::System(system) => system,
        Body::Pencil(_) => unreachable!("a system"),
    }
}

/// The certificate of the complete set, as `complete` writes it.
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

/// The complete set of a certificate that has one.
pub fn set(certificate: &mut Certificate) -> &mut CompleteSet {
    certificate.complete_set.as_mut().unwrap()
}

/// The problem on another window; without an upper end to infinity.
pub fn window(problem: Problem, min: &str, max: Option<&str>) -> Problem {
    let min = parse(min).unwrap();
    let max = max.map(|text| parse(text).unwrap());
    problem.with_window(Window::new(min, max).unwrap())
}

/// lambda^2 = 2 with x = (2, 1) and 3 with (3, 2).
pub fn fold(min: &str, max: Option<&str>) -> Problem {
    window(pencil(&[&["1", "-6"], &["2", "-6"]], I2, &[]), min, max)
}

/// An interval in which lambda^2 = 2 is the only value of `fold`.
pub const AROUND_TWO: [&str; 2] = ["31/16", "33/16"];

/// The witness of lambda^2 = 2: v = (1, 1/2), u = (1, -3/2), Y = -2, all exact there.
pub fn fold_root(interval: [&str; 2], outcome: RootOutcome) -> Root {
    let left: i64 = -3 << 19;
    let right: i64 = 1 << 19;
    Root {
        pivot: 0,
        interval: interval.map(q),
        inverse: vec![vec![Integer::from(-2)]],
        inverse_exponent: 0,
        left: vec![Integer::from(left)],
        right: vec![Integer::from(right)],
        exponent: 20,
        outcome,
    }
}

pub fn farkas(weights: &[i64]) -> Node {
    Node::Farkas(weights.to_vec())
}

/// Every support but {0, 1} closed by Farkas vectors (for values below 6), that one by `leaf`.
pub fn fold_tree(leaf: Node) -> Vec<Node> {
    vec![
        Node::Branch(0),
        Node::Branch(1),
        farkas(&[0, 0]),
        farkas(&[0, 1]),
        Node::Branch(1),
        farkas(&[-1, 0]),
        leaf,
    ]
}

pub fn root_node(interval: [&str; 2], outcome: RootOutcome) -> Node {
    Node::Root(Box::new(fold_root(interval, outcome)))
}

pub fn factor(rows: &[&[&str]], diagonal: &[&str]) -> LdlFactor {
    LdlFactor {
        rows: rows.iter().map(|row| numbers(row)).collect(),
        diagonal: numbers(diagonal),
    }
}

pub fn ldl(lower: LdlFactor, upper: LdlFactor) -> Node {
    Node::Ldl(Box::new(Ldl { lower, upper }))
}

pub fn tiny() -> Rational {
    rational(1, 1_000_000_000_000)
}
