//! Bodies of the fuzz targets, each with an oracle or a law behind it. A panic is a finding.
//!
//! Input: any bytes. Each body makes an object of them (a text, a pencil, a system), runs what it
//! tests, and asserts what must hold. Called by the glue in `fuzz/fuzz_targets/`, by `fuzz/hour`,
//! and by the replay of the corpus in `tests/campaign/fuzz_replay.rs`.

mod arithmetic;
mod certificates;
mod coverage;
mod enumerators;
mod naive;
mod systems;

pub use arithmetic::exact_against_naive;
pub use certificates::{certificate_reader, certificate_seeds, hostile_report};
pub use coverage::{Counter, Seen};
pub use enumerators::complete_against_plain;
pub use systems::{
    SYSTEMS, TWO_PARTICLES, fuzz_treatment, mechanical_systems, mechanical_systems_by,
};
pub use systems::{two_particle_problems, two_particle_problems_by};

use super::compare::{Treatment, compare_by, in_doubles};
use super::disagreement::Disagreement;
use super::families::Instance;
use super::forge::forgeries;
use super::generators::matrix;
use mceip_check::certificate::Certificate;
use mceip_check::check;
use mceip_engine::certify::propose;
use mceip_exact::{Rational, Sparse, whole};
use mceip_model::file::{read_problem, write_problem};
use mceip_model::reduction::reduce;
use mceip_model::{Body, Pencil, Problem, QuadraticPencil, Reduced, Unknown, Window};
use mceip_oracle::enumerate;
use std::path::Path;

/// Problem reader: what is read is written and read again as the same problem with the same digest;
/// what is refused is refused in one line.
pub fn problem_reader(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };

    let nowhere = Path::new("/nonexistent");
    match read_problem(text, nowhere) {
        Ok(problem) => {
            let again = read_problem(&write_problem(&problem), nowhere)
                .unwrap_or_else(|e| panic!("written problem is refused: {e}"));

            assert_eq!(again, problem);
            assert_eq!(again.sha256(), problem.sha256());
        }
        Err(e) => assert_eq!(e.to_string().lines().count(), 1, "{e:?}"),
    }

    certificates::report_reader(text);
}

/// Process-wide counts of [`solver_against_oracle`].
pub static SMALL_PENCILS: Counter = Counter::new("fuzz: solver_against_oracle");

/// Solver, certificate and checker against the enumerator on a small integer pencil; what the
/// solver finds is counted over the process and held against its floor.
pub fn solver_against_oracle(data: &[u8]) {
    solver_against_oracle_by(data, &fuzz_treatment(), &SMALL_PENCILS);
}

/// [`solver_against_oracle`] with a solver and a counter of one's own.
pub fn solver_against_oracle_by(data: &[u8], treatment: &Treatment, counter: &Counter) {
    let Some(problem) = small_problem(data) else {
        return;
    };

    let instance = Instance::new(format!("fuzz {data:?}"), problem, Vec::new());
    engines_agree(&instance, treatment, counter);
}

/// Every engine on an instance, and a count of what the solver found.
fn engines_agree(instance: &Instance, treatment: &Treatment, counter: &Counter) {
    let report = compare_by(instance, treatment);
    assert!(
        report.disagreements.is_empty(),
        "{}: {:?}\n{}",
        report.label,
        report.disagreements,
        write_problem(&instance.problem)
    );

    counter.add(&report);
}

/// Checker against forgeries: the first byte picks one, the rest makes the problem; and the file
/// form of every certificate round-trips.
pub fn checker_against_forgeries(data: &[u8]) {
    let Some((&pick, rest)) = data.split_first() else {
        return;
    };

    let Some(problem) = small_problem(rest) else {
        return;
    };

    for certificate in certificates(&problem) {
        assert!(check(&problem, &certificate).is_ok());

        let again = Certificate::from_json(&certificate.to_json())
            .unwrap_or_else(|e| panic!("written certificate is refused: {e}"));
        assert_eq!(again, certificate);

        let list = forgeries(&certificate);
        let forgery = &list[usize::from(pick) % list.len()];
        match check(&problem, &forgery.certificate) {
            Ok(_) => {
                let accepted = Disagreement::Forgery {
                    name: forgery.name,
                    got: "accepted".into(),
                };
                panic!("{accepted}");
            }
            Err(e) => assert!((forgery.expected)(&e.reason), "{}: {e}", forgery.name),
        }
    }
}

/// A certificate for each solution the enumerator lists.
fn certificates(problem: &Problem) -> Vec<Certificate> {
    let Ok(reduced) = reduce(problem).and_then(Reduced::without_zero) else {
        return Vec::new();
    };
    let Ok(oracle) = enumerate(&reduced.pencil, problem.window()) else {
        return Vec::new();
    };

    let slip = reduced.pencil.slip();
    let mut out = Vec::new();
    for solution in &oracle.solutions {
        let candidate = in_doubles(solution, &slip);
        let claim = propose(&reduced.pencil, problem.window(), &candidate)
            .unwrap_or_else(|e| panic!("oracle's solution not certified: {e}"));
        out.push(Certificate::of_claims(problem, vec![claim]));
    }
    out
}

/// A pencil of order 1 to 4 with entries from -4 to 4, free variables by a bit mask.
fn small_problem(data: &[u8]) -> Option<Problem> {
    let head = *data.first()?;
    let mask = *data.get(1)?;
    let entries = &data[2..];

    let n = order(head);
    let digit = |byte: u8| whole(i64::from(byte % 9) - 4);
    let matrix = |power: usize| matrix_of(entries, n, power * n * n, digit);
    problem_of([0, 1, 2].map(matrix), head, mask, Window::all())
}

/// Bits of the first byte: lambda^2 is sought, not mu; an eigenvalue is; of a quadratic pencil.
const LAMBDA2: u8 = 0x10;
const EIGENVALUE: u8 = 0x04;
const QUADRATIC: u8 = EIGENVALUE | 0x08;

/// Is it about a quadratic pencil?
fn is_quadratic(head: u8) -> bool {
    head & QUADRATIC == QUADRATIC
}

/// The order of the matrices by the first byte: 1 to 4, to 3 for quadratic pencils, whose linear
/// forms are twice as large.
fn order(head: u8) -> usize {
    let most = if is_quadratic(head) { 3 } else { 4 };
    usize::from(head % most) + 1
}

/// The problem of A + tB, or A + tB + t^2 C: the first byte says which number is sought, the bit
/// mask which variables are free, of which there are none where it is an eigenvalue.
fn problem_of([a, b, c]: [Sparse; 3], head: u8, mask: u8, window: Window) -> Option<Problem> {
    if is_quadratic(head) {
        let quadratic = QuadraticPencil::new(a, b, c).ok()?;
        return Problem::new(Body::Quadratic(quadratic), Unknown::Eigenvalue, window).ok();
    }

    let (unknown, mask) = if head & EIGENVALUE != 0 {
        (Unknown::Eigenvalue, 0)
    } else if head & LAMBDA2 != 0 {
        (Unknown::Lambda2, mask)
    } else {
        (Unknown::Mu, mask)
    };
    let free = (0..a.rows()).filter(|i| mask >> i & 1 == 1).collect();
    let pencil = Pencil::new(a, b, free).ok()?;
    Problem::new(Body::Pencil(pencil), unknown, window).ok()
}

/// The matrix of order n whose first entry is made of the byte at `offset`, row by row.
fn matrix_of(data: &[u8], n: usize, offset: usize, number: impl Fn(u8) -> Rational) -> Sparse {
    matrix(n, |i, j| {
        let byte = data.get(offset + i * n + j);
        number(byte.copied().unwrap_or(0))
    })
}

/// A target's name and body.
pub type Target = (&'static str, fn(&[u8]));

/// All targets, for the fuzzer's glue, `fuzz/hour` and the replay of the corpus.
pub const TARGETS: [Target; 9] = [
    ("problem_reader", problem_reader),
    ("certificate_reader", certificate_reader),
    ("hostile_report", hostile_report),
    ("checker_against_forgeries", checker_against_forgeries),
    ("solver_against_oracle", solver_against_oracle),
    ("mechanical_systems", mechanical_systems),
    ("two_particle_problems", two_particle_problems),
    ("complete_against_plain", complete_against_plain),
    ("exact_against_naive", exact_against_naive),
];
