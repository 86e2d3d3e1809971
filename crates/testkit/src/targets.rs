//! Bodies of the fuzz targets, each with an oracle or a law behind it. A panic is a finding.

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

use super::compare::{Treatment, compare_by};
use super::disagreement::Disagreement;
use super::families::Instance;
use super::forge::forgeries;
use mceip_check::certificate::Certificate;
use mceip_check::check;
use mceip_exact::{Sparse, whole};
use mceip_model::file::{read_problem, write_problem};
use mceip_model::{Body, Pencil, Problem, Unknown, Window};
use std::path::Path;

/// Problem reader: what is read is written and read again as the same problem with the same digest;
/// what is refused is refused in one line.
pub fn problem_reader(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };

    match read_problem(text, Path::new("/nonexistent")) {
        Ok(problem) => {
            let again = read_problem(&write_problem(&problem), Path::new("/nonexistent"));
            let again = again.unwrap_or_else(|e| panic!("written problem is refused: {e}"));
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

    let instance = Instance {
        label: format!("fuzz {data:?}"),
        problem,
        closed_form: None,
        corners: Vec::new(),
    };

    let report = compare_by(&instance, treatment);
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

    let instance = Instance {
        label: "fuzz".into(),
        problem,
        closed_form: None,
        corners: Vec::new(),
    };

    for certificate in certificates(&instance.problem) {
        assert!(check(&instance.problem, &certificate).is_ok());

        let again = Certificate::from_json(&certificate.to_json())
            .unwrap_or_else(|e| panic!("written certificate is refused: {e}"));
        assert_eq!(again, certificate);

        let list = forgeries(&certificate);
        let forgery = &list[usize::from(pick) % list.len()];

        match check(&instance.problem, &forgery.certificate) {
            Ok(_) => panic!(
                "{}",
                Disagreement::Forgery {
                    name: forgery.name,
                    got: "accepted".into()
                }
            ),
            Err(e) => assert!((forgery.expected)(&e.reason), "{}: {e}", forgery.name),
        }
    }
}

/// A certificate for each solution the enumerator lists.
fn certificates(problem: &Problem) -> Vec<Certificate> {
    use mceip_engine::candidate::Candidate;
    use mceip_engine::certify::{certificate, propose};

    let Ok(reduced) = mceip_engine::reduction::reduce(problem) else {
        return Vec::new();
    };

    let Ok(oracle) = mceip_oracle::enumerate(&reduced.pencil, problem.window()) else {
        return Vec::new();
    };

    let slip = reduced.pencil.slip();
    let candidates = oracle.solutions.iter().map(|s| Candidate {
        value: s.decimal(17).parse().unwrap_or(f64::NAN), // our own decimals parse
        x: s.x_decimals(&slip, 17)
            .iter()
            .map(|t| t.parse().unwrap_or(f64::NAN))
            .collect(),
    });

    let claims = candidates.map(|c| {
        propose(&reduced.pencil, problem.window(), &c)
            .unwrap_or_else(|e| panic!("oracle's solution not certified: {e}"))
    });

    claims
        .map(|claim| certificate(problem, vec![claim]))
        .collect()
}

/// A pencil of order 1 to 4 with entries from -4 to 4, free variables by a bit mask.
fn small_problem(data: &[u8]) -> Option<Problem> {
    let (&head, &mask) = (data.first()?, data.get(1)?);
    let n = usize::from(head % 4) + 1;

    let unknown = if head & 0x10 == 0 {
        Unknown::Mu
    } else {
        Unknown::Lambda2
    };

    let matrix = |offset: usize| {
        let entries = (0..n * n).map(|k| {
            let byte = data.get(2 + offset + k).copied().unwrap_or(0);
            (k / n, k % n, whole(i64::from(byte % 9) - 4))
        });

        Sparse::from_entries(n, n, entries)
    };

    let free = (0..n).filter(|i| mask >> i & 1 == 1).collect();
    let pencil = Pencil::new(matrix(0), matrix(n * n), free).ok()?;
    Problem::new(Body::Pencil(pencil), unknown, Window::all()).ok()
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
