//! Absence below a friction, on the system of X9 (`spec/errata.md`).
//!
//! T(t, mu) = diag(1, 2) + tI + mu [[0, -3], [1, -4]] has its critical friction 1 + sqrt(3)/2 =
//! 1.8660254... at a fold with lambda^2 = 1/2 + sqrt(3). The checker divides row 0 by 4 and row 1
//! by 8 (`spec/certificates.md`, 5.7), so a weight of row 1 counts half in its units. A naive
//! search in doubles finds a tree for frictions below that, and the checker decides exactly. No
//! tree may be accepted above it: random ones are tried, and those of the search, which is right
//! everywhere but at the fold.

use mceip_check::certificate::{CriticalCertificate, Node, Piece};
use mceip_check::{Reason, audit_critical, check_critical};
use mceip_exact::{Rational, Sparse, parse, rational, to_f64, whole};
use mceip_model::file::Number;
#[cfg(feature = "cli")]
use mceip_model::file::write_problem;
use mceip_model::{Body, ContactState, Particle, Problem, System, Unknown, Window};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::cell::Cell;
#[cfg(feature = "cli")]
use std::process::Command;

/// Where the boxes of the fold end and a definite matrix takes over.
const LAST: i64 = 16;

/// The dofs are (T1, T2, N1, N2); both particles slip with S = 1.
fn fold() -> Problem {
    let stiffness = Sparse::from_ints(&[
        &[1, 0, 0, 1],
        &[0, 2, -3, -4],
        &[0, -3, 14, 0],
        &[1, -4, 0, 14],
    ]);
    let slip = ContactState::Slip { sign: 1 };
    let particles = vec![Particle::plain(0, 2, slip), Particle::plain(1, 3, slip)];
    let mass = Some(Sparse::identity(4));
    let system = System::new(stiffness, mass, Some(whole(2)), particles).unwrap();
    Problem::new(Body::System(system), Unknown::Lambda2, Window::all()).unwrap()
}

fn matrix(t: f64, mu: f64) -> [[f64; 2]; 2] {
    [[1.0 + t, -3.0 * mu], [mu, 2.0 + t - 4.0 * mu]]
}

/// An interval of t and one of mu.
#[derive(Clone)]
struct Rectangle {
    t: [Rational; 2],
    mu: [Rational; 2],
}

impl Rectangle {
    fn corners(&self) -> Vec<[[f64; 2]; 2]> {
        let mut corners = Vec::new();
        for t in &self.t {
            for mu in &self.mu {
                corners.push(matrix(to_f64(t), to_f64(mu)));
            }
        }
        corners
    }

    /// w with w'T = -(1, 1) at the centre, in integers of at most 2^20, before the rows are scaled.
    fn weights(&self) -> Vec<i64> {
        let t = to_f64(&middle(&self.t));
        let mu = to_f64(&middle(&self.mu));
        let [[a, b], [c, d]] = matrix(t, mu);
        let sign = (a * d - b * c).signum();
        let w = [sign * (c - d), sign * (b - a)];

        let largest = w[0].abs().max(w[1].abs()).max(f64::MIN_POSITIVE);
        w.iter()
            .map(|w| (w / largest * f64::from(1 << 20)).round() as i64)
            .collect()
    }

    /// Is w'T < 0 at all corners?
    fn is_closed_by(&self, w: &[i64]) -> bool {
        self.corners().iter().all(|t| {
            let column = |j: usize| w[0] as f64 * t[0][j] + w[1] as f64 * t[1][j];
            column(0) < -1e-6 && column(1) < -1e-6
        })
    }

    /// Cuts the side that is longer in comparison with [0, LAST] x [0, 2].
    fn halves(&self) -> (Node, [Rectangle; 2]) {
        let width = |[lo, hi]: &[Rational; 2]| to_f64(&(hi - lo));
        let is_long = width(&self.t) / LAST as f64 > width(&self.mu) / 2.0;
        let side = if is_long { Side::T } else { Side::Mu };
        self.cut(side, middle(self.side(side)))
    }

    fn side(&self, side: Side) -> &[Rational; 2] {
        match side {
            Side::T => &self.t,
            Side::Mu => &self.mu,
        }
    }

    fn cut(&self, side: Side, at: Rational) -> (Node, [Rectangle; 2]) {
        let mut lower = self.clone();
        let mut upper = self.clone();
        let number = Number(at.clone());

        match side {
            Side::T => {
                lower.t[1] = at.clone();
                upper.t[0] = at;
                (Node::Split(number), [lower, upper])
            }
            Side::Mu => {
                lower.mu[1] = at.clone();
                upper.mu[0] = at;
                (Node::Friction(number), [lower, upper])
            }
        }
    }
}

#[derive(Clone, Copy)]
enum Side {
    T,
    Mu,
}

fn middle([lo, hi]: &[Rational; 2]) -> Rational {
    (lo + hi) / whole(2)
}

/// The leaf for weights of rows that are not scaled.
fn scaled(w: &[i64]) -> Node {
    Node::Farkas(vec![w[0], 2 * w[1]])
}

/// Closes a rectangle where both variables move; beyond `depth` cuts with a vector that may fail.
fn close(rectangle: &Rectangle, depth: usize, tree: &mut Vec<Node>) {
    let w = rectangle.weights();
    if depth == 0 || rectangle.is_closed_by(&w) {
        tree.push(scaled(&w));
        return;
    }

    let (cut, halves) = rectangle.halves();
    tree.push(cut);
    for half in &halves {
        close(half, depth - 1, tree);
    }
}

/// The certificate of the search for this friction.
fn searched(problem: &Problem, below: &Rational, depth: usize) -> CriticalCertificate {
    // Where both rest, 0; where 0 moves alone, -T_00 < 0; where 1 does, 2 T_01 - T_11 < 0.
    let mut tree = vec![
        Node::Branch(0),
        Node::Branch(1),
        scaled(&[0, 0]),
        scaled(&[2, -1]),
        Node::Branch(1),
        scaled(&[-1, 0]),
    ];
    let rectangle = Rectangle {
        t: [whole(0), whole(LAST)],
        mu: [whole(0), below.clone()],
    };
    close(&rectangle, depth, &mut tree);

    certificate(problem, below, tree)
}

/// A tree for [0, LAST], and a definite matrix beyond.
fn certificate(problem: &Problem, below: &Rational, tree: Vec<Node>) -> CriticalCertificate {
    let piece = |max: Option<i64>, tree: Vec<Node>| Piece {
        max: max.map(|max| Number(whole(max))),
        anchor: None,
        tree,
    };

    CriticalCertificate {
        problem_sha256: problem.sha256(),
        from: whole(0),
        below: below.clone(),
        condensation: None,
        pieces: vec![
            piece(Some(LAST), tree),
            piece(None, vec![Node::PositiveDefinite]),
        ],
    }
}

/// The leaves that fail.
fn audited(problem: &Problem, certificate: &CriticalCertificate) -> Vec<(usize, usize)> {
    let audited = audit_critical(problem, certificate, &|| true).unwrap();
    let refused = audited.map(|(_, refused)| refused);
    refused.unwrap()
}

/// Whichever leaf it is stopped at, an audit says nothing; and it is not asked again.
#[test]
fn a_stopped_audit_is_no_verdict() {
    let problem = fold();
    let below = parse("1.87").unwrap();
    let refusable = searched(&problem, &below, 18);
    let nodes: usize = refusable.pieces.iter().map(|piece| piece.tree.len()).sum();
    assert!(!audited(&problem, &refusable).is_empty());

    let asked = Cell::new(0);
    for stop_at in [1, 2, nodes / 2, nodes] {
        asked.set(0);
        let go_on = || {
            asked.set(asked.get() + 1);
            asked.get() < stop_at
        };

        let answer = audit_critical(&problem, &refusable, &go_on);
        assert_eq!(answer, Ok(None), "{stop_at}");
        assert_eq!(asked.get(), stop_at);
    }
}

/// Up to 1.8655, a relative distance of 3e-4 from the fold.
#[test]
fn absence_is_proved_below_the_fold() {
    let problem = fold();
    for below in ["1", "1.8", "1.86", "1.8655"] {
        let below = parse(below).unwrap();
        let certificate = searched(&problem, &below, 40);

        let accepted = check_critical(&problem, &certificate).unwrap();
        assert_eq!(accepted.below, below);
        assert_eq!(audited(&problem, &certificate), []);

        let read = CriticalCertificate::from_json(&certificate.to_json());
        assert_eq!(read, Ok(certificate));
    }
}

/// The same trees for frictions above the fold: exactly leaves with the curve of solutions fail.
#[test]
fn the_search_is_refused_above_the_fold() {
    let problem = fold();
    for below in ["1.86603", "1.8661", "1.87", "2", "3"] {
        let below = parse(below).unwrap();
        let certificate = searched(&problem, &below, 18);

        let rejected = check_critical(&problem, &certificate).unwrap_err();
        assert!(
            matches!(rejected.reason, Reason::Boxes { .. }),
            "{rejected}"
        );

        let refused = audited(&problem, &certificate);
        assert!(!refused.is_empty());
    }
}

/// A file that is accepted for 1.86 with a larger `below` is not accepted for it.
#[test]
fn a_certificate_is_not_accepted_for_a_larger_friction() {
    let problem = fold();
    let good = searched(&problem, &parse("1.86").unwrap(), 40);

    for below in ["1.86603", "1.867", "2"] {
        let mut forged = good.clone();
        forged.below = parse(below).unwrap();
        assert!(check_critical(&problem, &forged).is_err(), "{below}");
    }
}

/// A random tree of a box: cuts, branches, and leaves that are good guesses or none.
fn random_tree(
    rng: &mut ChaCha8Rng,
    rectangle: &Rectangle,
    open: &[usize],
    depth: usize,
    tree: &mut Vec<Node>,
) {
    let choice = if depth == 0 {
        3
    } else {
        rng.random_range(0..4)
    };
    let depth = depth.saturating_sub(1);

    match choice {
        0 | 1 => {
            let side = if choice == 0 { Side::T } else { Side::Mu };
            let [lo, hi] = rectangle.side(side);
            let share = rational(rng.random_range(1..63), 64);
            let (cut, halves) = rectangle.cut(side, lo + (hi - lo) * share);
            tree.push(cut);
            for half in &halves {
                random_tree(rng, half, open, depth, tree);
            }
        }
        2 if !open.is_empty() => {
            tree.push(Node::Branch(open[0]));
            for _ in 0..2 {
                random_tree(rng, rectangle, &open[1..], depth, tree);
            }
        }
        _ => tree.push(random_leaf(rng, rectangle)),
    }
}

fn random_leaf(rng: &mut ChaCha8Rng, rectangle: &Rectangle) -> Node {
    let weights = vec![rng.random_range(-4..=4), rng.random_range(-4..=4)];

    match rng.random_range(0..5) {
        0 => Node::PositiveDefinite,
        1 => Node::NegativeDefinite,
        2 => Node::Farkas(weights),
        3 => Node::WeightedDefinite(weights),
        _ => scaled(&rectangle.weights()),
    }
}

/// At mu = 2 there are solutions with lambda^2 = 2 and 3. Whatever the tree, some leaf of theirs is
/// refused.
#[test]
fn no_random_tree_is_accepted_above_the_fold() {
    let problem = fold();
    let mut rng = ChaCha8Rng::seed_from_u64(19);
    let mut refused_by_a_leaf = 0;

    for round in 0..3000u64 {
        let below = parse(["1.8661", "1.9", "2", "4"][(round % 4) as usize]).unwrap();
        let rectangle = Rectangle {
            t: [whole(0), whole(LAST)],
            mu: [whole(0), below.clone()],
        };
        let mut tree = Vec::new();
        let depth = rng.random_range(0..9);
        random_tree(&mut rng, &rectangle, &[0, 1], depth, &mut tree);

        let forged = certificate(&problem, &below, tree);
        assert!(
            check_critical(&problem, &forged).is_err(),
            "{}",
            forged.to_json()
        );
        let refused = audited(&problem, &forged);
        assert!(!refused.is_empty(), "{}", forged.to_json());
        refused_by_a_leaf += usize::from(refused.iter().any(|(piece, _)| *piece == 0));
    }

    assert_eq!(refused_by_a_leaf, 3000);
}

/// Boxes share the ends of their intervals: twenty thousand that wait beside a cut of a hundred
/// thousand digits would take more than 800 MB, were each to hold the cut.
#[cfg(all(unix, feature = "cli"))]
#[test]
fn pending_boxes_share_a_long_cut() {
    let problem = fold();
    let cut = format!("0.{}1", "0".repeat(99_990));
    let mut tree = vec![Node::Friction(Number(parse(&cut).unwrap()))];
    for t in (1..=20_000).rev() {
        tree.push(Node::Split(Number(rational(t, 2000))));
    }
    let certificate = certificate(&problem, &whole(1), tree);

    let folder = tempfile::tempdir().unwrap();
    let of_problem = folder.path().join("problem.json");
    let of_certificate = folder.path().join("certificate.json");
    std::fs::write(&of_problem, write_problem(&problem)).unwrap();
    std::fs::write(&of_certificate, certificate.to_json()).unwrap();
    let output = Command::new("sh")
        .arg("-c")
        .arg("ulimit -v 524288; ulimit -t 10; exec \"$0\" check \"$1\" \"$2\"")
        .arg(env!("CARGO_BIN_EXE_mceip"))
        .args([&of_problem, &of_certificate])
        .output()
        .unwrap();

    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("20002 more region(s) to be closed"), "{text}");
}
