//! `mceip analyze`: the engineer's answers against closed forms, the oracle and certificates;
//! refusals.
#![cfg(feature = "cli")]

use crate::program::{Folder, mceip, refused};
use mceip::analysis::{Analysis, Evidence, Options, Verdict, analyse};
use mceip::check::check;
use mceip::exact::{Rational, Sparse, enclosing_decimals, rational, to_f64, whole};
use mceip::model::{ContactState, Particle, System, Unknown, Window};
use mceip::oracle::{TwoParticles, enumerate, table1, thresholds};
use mceip::reduction::reduce;
use mceip::run::{Cancel, Watch};
use mceip::source::{Block, BlockModel, two_particles};
use serde_json::Value;

fn example(name: &str) -> String {
    format!("{}/spec/examples/{name}", env!("CARGO_MANIFEST_DIR"))
}

#[track_caller]
fn answer(system: &System, mu: &Rational, samples: usize) -> Analysis {
    let options = Options {
        samples,
        threads: Some(1),
        ..Options::default()
    };
    let analysis = analyse(None, system, mu, &options, &Watch::nobody()).unwrap();
    for proof in &analysis.proofs {
        check(&proof.problem, &proof.certificate).unwrap();
    }
    analysis
}

/// All answers for the two particles, against Table 1 in closed form.
#[test]
fn two_particles_as_in_the_table() {
    let mut counts = [0; 3];
    for (signs, mu) in [
        ((1, 1), rational(3, 2)),
        ((1, 1), whole(3)),
        ((-1, -1), whole(3)),
        ((1, -1), whole(2)),
        ((1, -1), whole(4)),
        ((1, -1), whole(8)),
        ((-1, 1), whole(8)),
    ] {
        let data = TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(5),
            m: rational(1, 7),
            mu: mu.clone(),
            signs,
        };
        let a = answer(&two_particles(&data).unwrap(), &mu, 0);
        let table = table1(&data);
        assert_eq!(a.divergence.modes.len(), table.len(), "{signs:?} {mu}");
        assert_eq!(
            a.divergence.verdict,
            if table.is_empty() {
                Verdict::Absent
            } else {
                Verdict::Present
            }
        );
        for mode in &a.divergence.modes {
            let closed = table
                .iter()
                .find(|t| {
                    t.slip == mode.slipping && t.value.within(mode.lambda2.lo(), mode.lambda2.hi())
                })
                .unwrap();
            assert!(
                (mode.v[0].abs() + mode.v[2].abs() - 1.0).abs() < 1e-12 && mode.v[1] == 0.0,
                "{:?}",
                mode.v
            );
            let lambda2 = mode.growth_rate * mode.growth_rate;
            assert!(
                lambda2 < to_f64(mode.lambda2.hi()) * (1.0 + 1e-12)
                    && closed.slip.len() + mode.sticking.len() == 2
            );
        }
        let all_slip = table.iter().any(|t| t.slip == [0, 1]);
        assert_eq!(a.sufficient, Some(all_slip));
        let known = thresholds(&data).unwrap();
        match (known.first(), a.threshold.smallest()) {
            (Some(t), Some(mu)) => assert!(t.value.within(mu.lo(), mu.hi())),
            (None, None) => assert!(a.threshold.open.is_empty()),
            other => panic!("{signs:?}: {other:?}"),
        }
        // No folds here: the critical mu is the static threshold.
        let below = a.critical.absent_below.as_ref();
        match known.first() {
            Some(t) => {
                let below = below.unwrap();
                assert!(
                    t.value.within(below, &(below * rational(10_001, 10_000))),
                    "{signs:?}: {below}"
                );
                assert_eq!(
                    a.critical.solution.as_ref().unwrap().evidence,
                    Evidence::Certificate(1)
                );
            }
            None => assert!(
                below.is_none_or(|b| *b > whole(1_000_000)) && a.critical.solution.is_none()
            ),
        }
        if a.necessary.holds_at(&mu) == Some(false) {
            assert!(table.is_empty());
        }
        counts[table.len().min(2)] += 1;
    }
    assert!(counts.iter().all(|c| *c > 0), "{counts:?}");
}

/// The modes are motions: u = u0 + alpha v with alpha = alpha0 cosh(lambda t) satisfies momentum
/// balance, contact and friction at all times while the reactions stay compressive. // E1, E2, E3,
/// E4, E8
#[test]
fn a_mode_is_a_motion_along_a_constant_direction() {
    let mut moved = [0, 0];
    for (signs, mu) in [((1, 1), 3), ((-1, -1), 3), ((1, -1), 8)] {
        let data = TwoParticles {
            c: rational(3, 5),
            s: rational(4, 5),
            k: whole(5),
            m: rational(1, 7),
            mu: whole(mu),
            signs,
        };
        let system = two_particles(&data).unwrap();
        let entry = |m: &Sparse, i: usize, j: usize| to_f64(&m.get(i, j));
        let mu = f64::from(mu as i32);
        for mode in answer(&system, &data.mu, 0).divergence.modes {
            let (lambda, v) = (mode.growth_rate, &mode.v);
            let row = |m: &Sparse, i: usize| (0..4).map(|j| entry(m, i, j) * v[j]).sum::<f64>();
            let w: Vec<f64> = (0..4)
                .map(|i| {
                    lambda * lambda * row(system.mass().unwrap(), i) + row(system.stiffness(), i)
                })
                .collect();
            for step in 0..20 {
                let t = 0.1 * f64::from(step) / lambda;
                let (alpha, rate) = (
                    1e-3 * (lambda * t).cosh(),
                    1e-3 * lambda * (lambda * t).sinh(),
                );
                for (p, s) in [(0, f64::from(signs.0)), (1, f64::from(signs.1))] {
                    // At equilibrium r_N = -100 and r_T = S mu 100, on the cone.
                    let (r_t, r_n) = (
                        s * mu * 100.0 + alpha * w[2 * p],
                        -100.0 + alpha * w[2 * p + 1],
                    );
                    let velocity = rate * v[2 * p];
                    assert!(v[2 * p + 1] == 0.0 && r_n < 0.0, "contact is kept");
                    assert!(r_t.abs() + mu * r_n <= 1e-9, "in the cone: {r_t} {r_n}");
                    assert!(
                        (velocity.abs() * r_t - mu * velocity * r_n).abs() <= 1e-6 * velocity.abs(),
                        "on it, and opposed to slip"
                    );
                    moved[usize::from(v[2 * p] != 0.0)] += 1;
                }
            }
        }
    }
    assert!(
        moved[0] > 0 && moved[1] > 0,
        "slipping and sticking were met: {moved:?}"
    );
    // Free dofs carry no reaction: w_f = 0 in the example with free variables.
    let problem =
        mceip::model::file::read_problem_file(std::path::Path::new(&example("oblique.json")))
            .unwrap();
    let mceip::model::Body::System(system) = problem.body() else {
        panic!("a system")
    };
    let mode = answer(system, &whole(9), 0).divergence.modes.remove(0);
    let lambda2 = mode.growth_rate * mode.growth_rate;
    for i in system.free_dofs() {
        let m = system.stiffness().add_scaled(
            &mceip::exact::from_f64(lambda2).unwrap(),
            system.mass().unwrap(),
        );
        let w: f64 = (0..6).map(|j| to_f64(&m.get(i, j)) * mode.v[j]).sum();
        assert!(w.abs() < 1e-12, "w[{i}] = {w}");
    }
}

/// The fold of errata.md as a mechanical system: K0 = diag(1, 2), K1 = [[0, -3], [1, -4]], M = I.
fn fold() -> System {
    let k = Sparse::from_ints(&[
        &[1, 0, 0, 1],
        &[0, 2, -3, -4],
        &[0, -3, 99, 0],
        &[1, -4, 0, 99],
    ]);
    let particle = |i: usize| Particle::plain(i, i + 2, ContactState::Slip { sign: 1 });
    System::new(
        k,
        Some(Sparse::identity(4)),
        None,
        vec![particle(0), particle(1)],
    )
    .unwrap()
}

#[test]
fn a_fold_lies_below_every_static_threshold() {
    let a = answer(&fold(), &whole(2), 8);
    assert_eq!(
        (a.divergence.verdict, a.divergence.modes.len()),
        (Verdict::Present, 2)
    );
    assert!(a.threshold.values.is_empty() && a.threshold.open.is_empty());
    let (below, solution) = (
        a.critical.absent_below.clone().unwrap(),
        a.critical.solution.clone().unwrap(),
    );
    // 3 mu^2 - 4 u mu + u (u + 1) = 0 with u = 1 + t: mu = (2u - sqrt(u (u - 3))) / 3 is least at u
    // = (3 + 2 sqrt 3) / 2, where mu = 1 + sqrt(3) / 2: the root of 4 mu^2 - 8 mu + 1 above 1.
    let side = |mu: &Rational| whole(4) * mu * mu - whole(8) * mu + whole(1);
    assert!(
        below > whole(1) && side(&below) < whole(0) && side(solution.mu.hi()) > whole(0),
        "{below} {solution:?}"
    );
    assert!(to_f64(&below) > 0.999 * to_f64(solution.mu.hi()));
    assert!(solution.lambda2.lo() > &whole(0));
    // Independent of the search: the oracle finds nothing below at many lambda^2, and something at
    // the solution's.
    let mass = Sparse::identity(4);
    for k in 0..60 {
        let k_t = fold().stiffness().add_scaled(&rational(k, 8), &mass);
        let system = System::new(k_t, None, None, fold().particles().to_vec()).unwrap();
        let problem = mceip::model::Problem::new(
            mceip::model::Body::System(system),
            Unknown::Mu,
            Window::all(),
        )
        .unwrap();
        let window = Window::new(whole(0), Some(below.clone())).unwrap();
        assert!(
            enumerate(&reduce(&problem).unwrap().pencil, &window)
                .unwrap()
                .solutions
                .is_empty()
        );
    }
    assert_eq!(a.ranges.first().unwrap().verdict, Verdict::Absent);
    assert!(a.ranges.iter().any(|r| r.verdict == Verdict::Present));
}

/// Between nothing and divergence the eigenvalues are complex: absence is not stability.
#[test]
fn flutter_is_a_warning_where_divergence_is_absent() {
    let a = answer(&fold(), &whole(1), 0);
    assert_eq!(a.divergence.verdict, Verdict::Absent);
    let flutter = a.flutter.as_ref().unwrap();
    // -K* = [[-1, 3], [-1, 2]], lambda^4 - lambda^2 + 1 = 0: lambda^2 = 1/2 + i sqrt(3)/2.
    assert_eq!(flutter.eigenvalues.len(), 1);
    assert!(
        (flutter.eigenvalues[0].0 - 0.5).abs() < 1e-9
            && (flutter.eigenvalues[0].1 - 0.75f64.sqrt()).abs() < 1e-9
    );
    assert!(
        (flutter.growth_rate - (std::f64::consts::PI / 6.0).cos()).abs() < 1e-9
            && (flutter.frequency - 0.5).abs() < 1e-9
    );
    let words: String = a.sentences().iter().map(|s| s.text.clone()).collect();
    assert!(words.contains("WARNING of flutter") && words.contains("not stability"));
    assert!(!words.contains("is stable") && !words.contains("is STABLE"));
}

/// A block with free variables: the cover works on the condensed family, and agrees with the
/// oracle.
#[test]
fn a_small_block_with_free_variables() {
    let block = Block::new(&BlockModel::of_the_paper().with_cells(2, 1)).unwrap();
    let slip = ContactState::Slip { sign: 1 };
    let system = block
        .system(&[slip, slip, ContactState::Free], None)
        .unwrap();
    assert!(!system.free_dofs().is_empty());
    let a = answer(&system, &whole(3), 0);
    let below = a.critical.absent_below.clone().unwrap();
    let mass = system.mass().unwrap();
    let mut met = f64::INFINITY;
    for k in 0..12 {
        let lambda2 = if k == 0 { whole(0) } else { whole(10).pow(k) };
        let at = System::new(
            system.stiffness().add_scaled(&lambda2, mass),
            None,
            None,
            system.particles().to_vec(),
        )
        .unwrap();
        let problem =
            mceip::model::Problem::new(mceip::model::Body::System(at), Unknown::Mu, Window::all())
                .unwrap();
        let found = enumerate(&reduce(&problem).unwrap().pencil, &Window::all()).unwrap();
        met = found
            .solutions
            .iter()
            .map(|s| s.decimal(17).parse::<f64>().unwrap())
            .fold(met, f64::min);
    }
    assert!(to_f64(&below) <= met, "{below} {met}");
    let excluded = a.necessary.excluded_below().unwrap();
    assert!(
        below > excluded,
        "the cover goes beyond the condition: {below} {excluded}"
    );
    if let Some(s) = &a.critical.solution {
        assert!(
            below <= *s.mu.hi() && to_f64(s.mu.hi()) < 1.01 * met,
            "{} {met}",
            enclosing_decimals(&s.mu, 9).1
        );
    }
}

#[test]
fn certificates_are_written_and_accepted() {
    let folder = Folder::new();
    let dir = folder.path("proofs");
    let file = example("oblique.json");
    let out = mceip(&[
        "analyze",
        &file,
        "--json",
        "--samples",
        "4",
        "--certificates",
        &dir,
    ]);
    assert_eq!(
        out.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    let report: Value = serde_json::from_slice(&out.stdout).unwrap();
    assert_eq!(report["format"], "mceip-analysis/1");
    assert_eq!(report["divergence"]["verdict"], "present");
    let mut checked = 0;
    for s in report["sentences"].as_array().unwrap() {
        let kind = s["evidence"]["kind"].as_str().unwrap();
        assert!(["certificate", "exact", "measured"].contains(&kind));
        if let Some(path) = s["evidence"]["path"].as_str() {
            let problem = path.replace(".certificate.json", ".problem.json");
            assert_eq!(mceip(&["check", &problem, path]).status.code(), Some(0));
            checked += 1;
        }
    }
    assert!(checked >= 3);
    // A certificate of another question is refused.
    let (mu, lambda2) = (
        folder.path("proofs/mu.problem.json"),
        folder.path("proofs/lambda2.certificate.json"),
    );
    assert_eq!(mceip(&["check", &mu, &lambda2]).status.code(), Some(1));
    let words = String::from_utf8(mceip(&["analyze", &file, "--samples", "0"]).stdout).unwrap();
    assert!(
        words.contains(
            "taken as impending slip at mu = 9, divergence instability of the form (8) is PRESENT"
        ),
        "{words}"
    );
}

/// An interrupt leaves everything undecided that was not done, and claims nothing.
/// One page with every sentence and mode, or none at all.
#[test]
fn the_report_says_what_the_text_says() {
    let folder = Folder::new();
    let page = folder.path("out.html");
    let o = mceip(&[
        "analyze",
        &example("two-particles.json"),
        "--report",
        &page,
        "--samples",
        "0",
    ]);
    assert_eq!(o.status.code(), Some(0));
    let html = std::fs::read_to_string(&page).unwrap();
    assert!(html.starts_with("<!DOCTYPE html>") && !html.contains("http"));
    let text = String::from_utf8(o.stdout).unwrap();
    let sentences: Vec<&str> = text.lines().skip(1).step_by(2).collect();
    assert!(sentences.len() > 5);
    for sentence in sentences {
        let escaped = sentence
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        assert!(html.contains(&escaped), "{sentence}");
    }
    assert!(html.contains("<td>proved</td>") && html.contains("Mode 1:"));
    let nowhere = folder.path("none/out.html");
    refused(
        &[
            "analyze",
            &example("two-particles.json"),
            "--report",
            &nowhere,
        ],
        &["cannot write"],
    );
    refused(
        &[
            "analyze",
            &example("fold.json"),
            "--report",
            &folder.path("fold.html"),
        ],
        &["mechanical system"],
    );
    assert!(!std::path::Path::new(&folder.path("fold.html")).exists());
}

#[test]
fn interrupted_work_is_undecided() {
    let stop = Cancel::requested();
    let a = analyse(
        None,
        &fold(),
        &whole(2),
        &Options::default(),
        &Watch::silent(&stop),
    )
    .unwrap();
    assert!(a.interrupted && !a.is_decided() && a.divergence.modes.is_empty());
    assert!(a.threshold.smallest().is_none() && a.samples.len() <= Options::default().samples);
    assert!(a.critical.solution.is_none() && a.sufficient.is_none());
    assert!(a.sentences()[0].text.contains("UNDECIDED"));
}

/// One answer for any number of threads.
#[test]
fn the_answer_does_not_depend_on_threads() {
    let run = |threads: &str| {
        mceip(&[
            "analyze",
            &example("two-particles.json"),
            "--json",
            "--threads",
            threads,
        ])
        .stdout
    };
    assert!(!run("1").is_empty());
    assert_eq!(run("1"), run("3"));
}

#[test]
fn bad_input_is_one_line() {
    let folder = Folder::new();
    let system = |k: &str, friction: &str| {
        let particles = r#"[{"tangential":0,"normal":1,"state":"slip","sign":1,"reaction":{"tangential":"1","normal":"-1"}}]"#;
        format!(
            r#"{{"format":"mceip-problem/1","unknown":"lambda2","system":{{"stiffness":{k},"mass":[[1,0],[0,1]],{friction}"particles":{particles}}}}}"#
        )
    };
    let write = |name: &str, k: &str, friction: &str| folder.write(name, &system(k, friction));
    let good = "[[2,0],[0,2]]";
    refused(
        &["analyze", &folder.path("nowhere.json")],
        &["nowhere.json"],
    );
    refused(
        &["analyze", &example("fold.json")],
        &["mechanical system", "pencil"],
    );
    refused(
        &[
            "analyze",
            &write("skew.json", "[[2,1],[0,2]]", "\"friction\":1,"),
        ],
        &["E3", "symmetric"],
    );
    refused(
        &["analyze", &write("cone.json", good, "\"friction\":2,")],
        &["E7", "particle 0"],
    );
    refused(
        &[
            "analyze",
            &write(
                "units.json",
                "[[\"1e300\",0],[0,\"1e300\"]]",
                "\"friction\":1,",
            ),
        ],
        &["K[0][0]", "units"],
    );
    let fine = write("fine.json", good, "\"friction\":1,");
    refused(&["analyze", &fine, "--friction", "-1"], &["--friction"]);
    refused(&["analyze", &fine, "--threads", "0"], &["--threads"]);
    refused(
        &["analyze", &fine, "--certificates", "/dev/null/x"],
        &["cannot write"],
    );
    assert_eq!(
        mceip(&["analyze", &fine, "--samples", "3"]).status.code(),
        Some(0)
    );
}
