//! Presence on intervals of friction, as `analyze` proves it: against closed forms, the enumerator
//! and the checker.
//!
//! The truth is Table 1, the fold of `spec/fold.md` (two solutions for every mu above
//! 1 + sqrt(3) / 2), and for random systems all solutions at values of mu inside and outside the
//! proved intervals. A certificate with a piece taken out, or with a wider interval, is refused.
#![cfg(all(feature = "cli", feature = "testkit"))]

use crate::common::{example, exits, exits_with_json, two_particles_with};
use crate::corpus_reader::entry;
use crate::fold::fold_body;
use crate::program::Folder;
use mceip_check::certificate::PresenceCertificate;
use mceip_check::{Reason, check_critical, check_presence};
use mceip_engine::analysis::{
    Analysis, AnalysisOptions, Evidence, ProofCertificate, Sentence, Verdict, analyse,
};
use mceip_engine::run::Watch;
use mceip_exact::{Rational, rational, to_f64, whole};
use mceip_model::file::Number;
use mceip_model::{ContactState, Problem, System, Unknown, Window};
use mceip_oracle::table1;
use mceip_paper::two_particles;
use mceip_testkit::generators::{rng, states};
use mceip_testkit::{at_friction, solutions_of};
use num_traits::Zero as _;
use rand::RngExt;
use serde_json::json;
use std::path::Path;

/// Number of this family of random systems.
const FAMILY: u64 = 97;

/// Random systems.
const SYSTEMS: u64 = 30;

/// The random systems up to the 21st that have no solution on a range above their critical mu.
const ABSENT_ABOVE: [u64; 5] = [7, 9, 11, 13, 20];

/// How far above the smallest solution the first interval may begin: share of mu.
const NEAR_START: f64 = 1e-5;

fn analysis(system: &System, mu: &Rational) -> Analysis {
    let options = AnalysisOptions {
        samples: 0,
        threads: Some(1),
        ..AnalysisOptions::default()
    };
    analyse(system, mu, &options, &Watch::nobody()).unwrap()
}

/// The certificates of presence of an answer, each accepted once more, with their problem.
fn certificates(analysis: &Analysis) -> Vec<(&Problem, &PresenceCertificate)> {
    let mut found = Vec::new();
    for proof in &analysis.proofs {
        if let ProofCertificate::Presence(proved) = &proof.certificate {
            let certificate = proved.certificate();
            check_presence(&proof.problem, certificate).unwrap();
            found.push((&proof.problem, certificate));
        }
    }

    found
}

/// The only certificate of presence of an answer.
#[track_caller]
fn only_certificate(analysis: &Analysis) -> (&Problem, &PresenceCertificate) {
    let found = certificates(analysis);
    assert_eq!(found.len(), 1);
    found[0]
}

/// The interval begins just above a mu and ends at least at twice of it.
#[track_caller]
fn begins_at(certificate: &PresenceCertificate, critical: f64) {
    let from = to_f64(&certificate.from);
    assert!(from > critical, "{from}");
    assert!(from < critical * (1.0 + NEAR_START), "{from}");
    assert!(to_f64(&certificate.to) >= 2.0 * critical);
}

/// From the thresholds of Table 1 on there is a solution for every mu, and every box of a piece
/// holds one of the table at both ends of its mu; (-1, 1) has none.
#[test]
fn table_1_is_present_from_its_threshold_on() {
    for (signs, threshold) in [
        ((1, 1), Some(2.36f64.sqrt() / 0.8)),
        ((-1, -1), Some(2.36f64.sqrt() / 0.8)),
        ((1, -1), Some(1.36 / 0.48)),
        ((-1, 1), None),
    ] {
        let data = two_particles_with(signs, whole(3));
        let analysis = analysis(&two_particles(&data).unwrap(), &whole(3));
        let Some(threshold) = threshold else {
            assert!(certificates(&analysis).is_empty());
            continue;
        };

        let (_, certificate) = only_certificate(&analysis);
        begins_at(certificate, threshold);

        let mut low = &certificate.from;
        for piece in &certificate.pieces {
            let [t0, t1] = &piece.interval;
            for mu in [low, &piece.to.0] {
                let solutions = table1(&two_particles_with(signs, mu.clone()));
                assert!(solutions.iter().any(|s| s.value.within(&t0.0, &t1.0)));
            }
            low = &piece.to.0;
        }
    }
}

/// 4 mu^2 - 8 mu + 1, positive above the fold.
fn side_of_the_fold(mu: &Rational) -> Rational {
    whole(4) * mu * mu - whole(8) * mu + whole(1)
}

/// Just above the fold the boxes hold one of two solutions at a small distance.
#[test]
fn the_fold_is_present_from_its_least_mu_on() {
    let analysis = analysis(&fold_body(), &whole(2));
    let (problem, certificate) = only_certificate(&analysis);
    begins_at(certificate, 1.0 + 0.75f64.sqrt());
    assert!(side_of_the_fold(&certificate.from) > whole(0));

    forgeries_are_refused(problem, certificate);
}

/// A piece taken out, an interval that reaches below the fold, a later beginning that leaves the
/// first piece out, and another problem.
#[track_caller]
fn forgeries_are_refused(problem: &Problem, certificate: &PresenceCertificate) {
    assert!(certificate.pieces.len() > 2);
    for k in 0..certificate.pieces.len() {
        let mut without = certificate.clone();
        without.pieces.remove(k);
        let rejected = check_presence(problem, &without).unwrap_err();
        assert!(matches!(rejected.reason, Reason::Boxes { .. }), "{k}");
    }

    let mut below = certificate.clone();
    below.from = &below.from * rational(99, 100);
    assert!(check_presence(problem, &below).is_err());

    let mut above = certificate.clone();
    above.to = &above.to * whole(4);
    let last = above.pieces.last_mut().unwrap();
    last.to = Number(above.to.clone());
    assert!(check_presence(problem, &above).is_err());

    let mut of_another = certificate.clone();
    of_another.problem_sha256 = "0".repeat(64);
    assert!(check_presence(problem, &of_another).is_err());
}

/// What the intervals of random systems met.
#[derive(Debug, Default)]
struct Met {
    systems: u64,
    with_presence: u64,
    intervals: u64,
    pieces: usize,
    /// Values of mu inside intervals, each with a solution.
    inside: u64,
    /// Values of mu outside with a solution, and without.
    outside_present: u64,
    outside_absent: u64,
    /// Systems with a support that changes inside an interval.
    changing: u64,
}

/// Has MCEIP-lambda2 a solution at this mu? By the enumerator.
fn is_present(system: &System, mu: &Rational) -> bool {
    let system = at_friction(system, mu).unwrap();
    let all = solutions_of(system, Unknown::Lambda2, &Window::all());
    !all.is_empty()
}

fn random_system(index: u64) -> System {
    let mut rng = rng(FAMILY, index);
    let mut list = Vec::new();
    for _ in 0..rng.random_range(2..=4) {
        let sign = if rng.random_range(0..4) == 0 { -1 } else { 1 };
        list.push(ContactState::Slip { sign });
    }
    if rng.random_range(0..2) == 0 {
        list.push(ContactState::Free);
    }
    if rng.random_range(0..3) == 0 {
        list.push(ContactState::Stick);
    }

    states::system(&mut rng, &list, &mut Vec::new()).unwrap()
}

/// Shares of an interval of mu at which the list is made.
const SHARES: [(i64, i64); 6] = [(0, 1), (1, 1000), (1, 5), (1, 2), (6, 7), (1, 1)];

fn compare(index: u64, met: &mut Met) {
    let system = random_system(index);
    let analysis = analysis(&system, &whole(2));
    met.systems += 1;

    let found = certificates(&analysis);
    met.with_presence += u64::from(!found.is_empty());
    let mut largest = whole(4);
    for (_, certificate) in &found {
        met.intervals += 1;
        met.pieces += certificate.pieces.len();
        let first = &certificate.pieces[0].support;
        let is_other = certificate.pieces.iter().any(|p| p.support != *first);
        met.changing += u64::from(is_other);

        let width = &certificate.to - &certificate.from;
        for (part, whole) in SHARES {
            let mu = &certificate.from + &width * rational(part, whole);
            assert!(is_present(&system, &mu), "system {index} at mu = {mu}");
            met.inside += 1;
        }
        largest = largest.max(certificate.to.clone());
    }

    // What is said of values outside, at which certificates are silent.
    for part in 1..8 {
        let mu = &largest * rational(part, 7);
        let is_inside = found.iter().any(|(_, c)| c.from <= mu && mu <= c.to);
        if is_inside {
            continue;
        }

        let bound = analysis.critical.absent_below.as_ref();
        let is_absent = bound.is_none_or(|bound| mu < *bound);
        if is_present(&system, &mu) {
            assert!(!is_absent, "system {index} at mu = {mu}");
            met.outside_present += 1;
        } else {
            met.outside_absent += 1;
        }
    }
}

/// Every mu of a proved interval has a solution in the list of all; where there is one between mu
/// = 0 and the largest mu, it is nearly always in an interval.
#[test]
fn random_systems_agree_with_the_enumerator() {
    let mut met = Met::default();
    for index in 0..SYSTEMS {
        compare(index, &mut met);
    }

    println!("{met:?}");
    assert_eq!(met.systems, SYSTEMS);
    assert!(met.with_presence >= 20, "{met:?}");
    assert!(met.inside >= 120, "{met:?}");
    assert!(met.outside_absent >= 60, "{met:?}");
    assert!(met.changing >= 1, "{met:?}");
    assert!(10 * met.outside_present <= met.inside, "{met:?}");
}

/// Ranges of absence above the critical mu.
#[derive(Debug, Default)]
struct AbsentRanges {
    proved: u64,
    /// Known at more than one sample and not proved.
    sampled: u64,
}

/// Ranges that samples call absent are proved, and the enumerator finds no solution in them. With a
/// range that begins at the critical mu the certificate is refused.
fn compare_absent_ranges(index: u64, met: &mut AbsentRanges) {
    let system = random_system(index);
    let options = AnalysisOptions {
        samples: 5,
        threads: Some(1),
        ..AnalysisOptions::default()
    };
    let analysis = analyse(&system, &whole(2), &options, &Watch::nobody()).unwrap();

    for range in analysis.ranges.iter().skip(1) {
        let Evidence::Certificate(k) = range.evidence else {
            let is_longer = range.to.as_ref() > Some(&range.from);
            met.sampled += u64::from(range.verdict == Verdict::Absent && is_longer);
            continue;
        };
        let proof = &analysis.proofs[k];
        let ProofCertificate::Absence(proved) = &proof.certificate else {
            continue;
        };

        let certificate = proved.certificate();
        met.proved += 1;
        assert_eq!(range.verdict, Verdict::Absent);
        assert_eq!(range.from, certificate.from);
        assert_eq!(range.to.as_ref(), Some(&certificate.below));
        check_critical(&proof.problem, certificate).unwrap();

        let is_its = |said: &Sentence| said.topic == "absence" && said.evidence == range.evidence;
        assert!(analysis.sentences().iter().any(is_its));
        let summary = analysis.summary();
        assert!(
            summary.contains(", and absent for every mu from "),
            "{summary}"
        );

        let width = &certificate.below - &certificate.from;
        for (part, whole) in SHARES {
            let mu = &certificate.from + &width * rational(part, whole);
            assert!(!is_present(&system, &mu), "system {index} at mu = {mu}");
        }

        let solution = analysis.critical.solution.as_ref().unwrap();
        let mut wider = certificate.clone();
        wider.from = solution.mu.lo().clone();
        assert!(
            check_critical(&proof.problem, &wider).is_err(),
            "system {index}"
        );
    }
}

#[test]
fn absence_above_the_critical_mu_is_proved_on_ranges() {
    let mut met = AbsentRanges::default();
    for index in ABSENT_ABOVE {
        compare_absent_ranges(index, &mut met);
    }

    println!("{met:?}");
    assert!(met.proved >= 5, "{met:?}");
    assert_eq!(met.sampled, 0, "{met:?}");
}

/// What one part certifies every other part uses: sentences, JSON, summary and files agree, and
/// `check` accepts the file.
#[test]
fn the_program_says_what_is_proved_and_writes_it() {
    let folder = Folder::new();
    let proofs = folder.path("proofs");
    let report = exits_with_json(
        0,
        &format!(
            "analyze {} --json --samples 3 --certificates {proofs}",
            example("fold-body")
        ),
    );

    let ranges = report["ranges"].as_array().unwrap();
    assert_eq!(ranges.len(), 2, "{ranges:?}");
    let present = &ranges[1];
    assert_eq!(present["verdict"], "present");
    assert_eq!(present["proved"], true);
    assert_eq!(present["evidence"]["kind"], "certificate");

    let sentences = report["sentences"].as_array().unwrap();
    let said = sentences.iter().find(|s| s["topic"] == "presence").unwrap();
    let text = said["text"].as_str().unwrap();
    assert!(text.contains("present for every mu from"), "{text}");
    assert_eq!(said["evidence"], present["evidence"]);
    assert!(!sentences.iter().any(|s| s["topic"] == "ranges"));

    let summary = report["summary"].as_str().unwrap();
    assert!(
        summary.contains("Divergence is present for every mu from"),
        "{summary}"
    );

    let certificate = present["evidence"]["path"].as_str().unwrap();
    assert!(certificate.ends_with("presence-1.certificate.json"));
    let problem = Path::new(&proofs).join("presence-1.problem.json");
    let text = exits(
        0,
        &format!("check {} {certificate}", problem.to_str().unwrap()),
    );
    assert!(text.starts_with("PRESENT for every friction"), "{text}");
}

/// The smallest certified mu is the one that is printed: no interval begins below the solution.
#[test]
fn no_interval_begins_below_the_solution_that_is_printed() {
    for system in [
        fold_body(),
        two_particles(&two_particles_with((1, 1), whole(3))).unwrap(),
    ] {
        let analysis = analysis(&system, &whole(3));
        let solution = analysis.critical.solution.as_ref().unwrap();
        for range in &analysis.ranges[1..] {
            assert_eq!(range.verdict, Verdict::Present);
            assert!(matches!(range.evidence, Evidence::Certificate(_)));
            assert!(range.from >= *solution.mu.lo());
            assert!(!range.from.is_zero());
        }
    }
}

/// With a particle of zero reaction presence is sampled and absence proved, and the answer says
/// both and above which mu. The particle is not coupled to the system of a file of the corpus.
#[test]
fn absence_is_said_where_presence_is_sampled() {
    let mut problem = entry("accept/presence-mixed").file["problem"].take();

    for matrix in ["stiffness", "mass"] {
        let matrix = &mut problem["system"][matrix];
        matrix["rows"] = 6.into();
        matrix["cols"] = 6.into();
        let entries = matrix["entries"].as_array_mut().unwrap();
        entries.extend([json!([4, 4, "1"]), json!([5, 5, "1"])]);
    }
    let particles = problem["system"]["particles"].as_array_mut().unwrap();
    particles.push(json!({
        "tangential": 4,
        "normal": 5,
        "normal_direction": 1,
        "state": "zero",
    }));

    let folder = Folder::new();
    let file = folder.write("problem.json", &problem.to_string());
    let proofs = folder.path("proofs");
    let command = format!("analyze {file} --json --samples 4 --certificates {proofs}");
    let report = exits_with_json(0, &command);

    let bound = "There is no such motion below mu = 0.1291712,";
    let summary = report["summary"].as_str().unwrap();
    assert!(summary.contains(bound), "{summary}");
    assert!(
        summary.contains("Divergence is absent for every mu from 3.87"),
        "{summary}"
    );
    assert!(!summary.contains("present for every mu"), "{summary}");

    let sentences = report["sentences"].as_array().unwrap();
    let said = |topic: &str| sentences.iter().find(|s| s["topic"] == topic).unwrap();
    let sampled = said("ranges")["text"].as_str().unwrap();
    assert!(
        sampled.contains("elsewhere above mu = 0.1291712,"),
        "{sampled}"
    );

    let certificate = said("absence")["evidence"]["path"].as_str().unwrap();
    assert!(certificate.ends_with("absent-range-1.certificate.json"));
    let problem = certificate.replace(".certificate.json", ".problem.json");
    let text = exits(0, &format!("check {problem} {certificate}"));
    assert!(text.starts_with("ABSENT for friction in ["), "{text}");
}
