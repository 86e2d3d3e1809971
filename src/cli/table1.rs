//! `mceip table1`: closed form and enumerator side by side.
//!
//! The two particles of Fig. 1 at one angle and friction. For each of the four sign patterns
//! (S_1, S_2) all solutions of MCEIP-lambda2 are listed as the enumerator finds them, and compared
//! with the closed form of Table 1 and with what the solver finds and certifies.

use super::common::{CliError, aside, exit, number, positive, print_answer};
use super::output::Output;
use crate::picture::table1_picture;
use mceip_engine::multistart::Search;
use mceip_engine::report::{Listed, Table};
use mceip_exact::Rational;
use mceip_model::reduction::reduce;
use mceip_model::{Body, Problem, Unknown, Window};
use mceip_oracle::{TwoParticles, enumerate};
use mceip_paper::two_particles;
use mceip_testkit::{Disagreement, Instance, compare};
use num_traits::{One, Signed};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Arguments of `table1`: exact numbers, "3/5" or "0.6".
#[derive(clap::Args)]
pub(super) struct Args {
    /// cos(phi).
    #[arg(long, default_value = "3/5", allow_hyphen_values = true)]
    c: String,
    /// sin(phi); c^2 + s^2 must be 1 exactly.
    #[arg(long, default_value = "4/5", allow_hyphen_values = true)]
    s: String,
    /// Spring stiffness.
    #[arg(long, default_value = "1", allow_hyphen_values = true)]
    k: String,
    /// Particle mass.
    #[arg(long, default_value = "1", allow_hyphen_values = true)]
    m: String,
    /// Coefficient of friction.
    #[arg(long, default_value = "8", allow_hyphen_values = true)]
    mu: String,
    /// Write a chart of the number of solutions over angle and friction to this file (.svg; .png in
    /// a build with the feature png).
    #[arg(long, value_name = "OUT.svg")]
    chart: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// A solution of one of the four sign patterns.
struct SignedSolution {
    signs: (i8, i8),
    listed: Listed,
    /// The exact polynomial of which lambda^2 is a root.
    polynomial: String,
}

/// One sign pattern, solved in three ways.
struct Pattern {
    lines: Vec<SignedSolution>,
    /// Do closed form, enumerator and solver agree?
    agrees: bool,
    /// Points of the solver without a certificate.
    uncertified: usize,
}

/// Solves the four sign patterns and prints the table.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let data = data(args)?;
    if let Some(path) = &args.chart {
        chart(path)?;
    }

    let mut table = Table::new(&[
        "S1",
        "S2",
        "lambda^2",
        "support",
        "x_T1",
        "x_T2",
        "exact polynomial",
    ]);
    let mut solutions = Vec::new();
    let mut agreed = true;
    let mut uncertified = 0;
    for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
        let pattern = pattern(TwoParticles {
            signs,
            ..data.clone()
        })?;
        agreed &= pattern.agrees;
        uncertified += pattern.uncertified;

        if pattern.lines.is_empty() {
            table.row(vec![
                format!("{:+}", signs.0),
                format!("{:+}", signs.1),
                "no solution".into(),
            ]);
        }

        for line in &pattern.lines {
            table.row(line.cells());
            solutions.push(line.json());
        }
    }

    let json = || json!({ "solutions": solutions, "agreement": agreed });
    let text = || {
        let verdict = verdict(agreed, uncertified);
        let TwoParticles { c, s, k, m, mu, .. } = data;
        format!("c = {c}, s = {s}, k = {k}, m = {m}, mu = {mu}\n{table}{verdict}\n")
    };
    print_answer(args.json, json, text)?;

    Ok(if agreed { exit::DONE } else { exit::REJECTED })
}

/// The data of the options, with the first sign pattern.
fn data(args: &Args) -> Result<TwoParticles, CliError> {
    let c = number("c", &args.c)?;
    let s = number("s", &args.s)?;
    let is_unit = &c * &c + &s * &s == Rational::one();
    if c.is_negative() || s.is_negative() || !is_unit {
        return Err(CliError::Option {
            option: "s",
            expected: "c, s >= 0 with c^2 + s^2 = 1 exactly",
            got: format!("{c}, {s}"),
        });
    }

    Ok(TwoParticles {
        c,
        s,
        k: positive("k", &args.k)?,
        m: positive("m", &args.m)?,
        mu: positive("mu", &args.mu)?,
        signs: (1, 1),
    })
}

/// Solves one sign pattern by the enumerator, and compares closed form, enumerator and solver.
/// What disagrees or has no certificate goes to stderr.
fn pattern(data: TwoParticles) -> Result<Pattern, CliError> {
    let signs = data.signs;
    let system = two_particles(&data)?;
    let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?;
    let reduced = reduce(&problem)?;
    let found = enumerate(&reduced.pencil, problem.window())?;

    let mut lines = Vec::new();
    for solution in &found.solutions {
        lines.push(SignedSolution {
            signs,
            listed: Listed::of_solution(&problem, &reduced, solution),
            polynomial: solution.value.poly().to_string(),
        });
    }

    let instance = Instance {
        label: format!("{signs:?}"),
        problem,
        closed_form: Some(data),
        corners: Vec::new(),
    };
    let report = compare(&instance, &Search::default());
    for reason in &report.uncertified {
        aside(&format!("S = {signs:?}: uncertified: {reason}"));
    }

    // Values beyond doubles are no contradiction: the solver does not begin, nothing is certified.
    let is_missing = |disagreement: &&Disagreement| {
        matches!(
            disagreement,
            Disagreement::Refused {
                engine: "solver",
                ..
            } | Disagreement::OracleNotCertified { .. }
        )
    };
    for disagreement in &report.disagreements {
        aside(&format!("S = {signs:?}: {disagreement}"));
    }
    let missing = report.disagreements.iter().filter(is_missing).count();

    Ok(Pattern {
        lines,
        agrees: missing == report.disagreements.len(),
        uncertified: report.uncertified.len() + missing,
    })
}

impl SignedSolution {
    fn cells(&self) -> Vec<String> {
        let (s_1, s_2) = self.signs;
        let listed = &self.listed;

        vec![
            format!("{s_1:+}"),
            format!("{s_2:+}"),
            listed.value.clone(),
            format!("{:?}", listed.slip),
            listed.x[0].clone(),
            listed.x[1].clone(),
            self.polynomial.clone(),
        ]
    }

    fn json(&self) -> Value {
        json!({
            "signs": [self.signs.0, self.signs.1],
            "lambda2": self.listed.value,
            "slip": self.listed.slip,
            "x": self.listed.x,
        })
    }
}

fn verdict(agreed: bool, uncertified: usize) -> &'static str {
    if !agreed {
        "DISAGREEMENT"
    } else if uncertified > 0 {
        "closed form = enumerator, not all certified"
    } else {
        "closed form = enumerator = certified, all four sign patterns"
    }
}

/// The endings that a chart's name may have in this build.
#[cfg(feature = "png")]
const CHART_NAMES: &str = "a name ending in .svg or .png";
#[cfg(not(feature = "png"))]
const CHART_NAMES: &str = "a name ending in .svg (.png needs a build with `--features png`)";

/// The chart, in the format that the file's name asks for.
fn chart(path: &Path) -> Result<(), CliError> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    let ending = ending.map(str::to_ascii_lowercase);

    match ending.as_deref() {
        Some("svg") => {
            let output = Output::prepare("chart", path, &[])?;
            output.write(&table1_picture().to_svg())
        }
        #[cfg(feature = "png")]
        Some("png") => {
            let output = Output::prepare("chart", path, &[])?;
            output.write_bytes(&table1_picture().to_png(2.0)?)
        }
        _ => Err(CliError::Option {
            option: "chart",
            expected: CHART_NAMES,
            got: path.display().to_string(),
        }),
    }
}
