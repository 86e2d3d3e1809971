//! `mceip table1`: closed form and enumerator side by side.

use super::common::{CliError, exit, print};
use super::output::Output;
use crate::picture::table1_picture;
use mceip_engine::multistart::Search;
use mceip_engine::report::{Listed, Table};
use mceip_exact::{Rational, parse};
use mceip_model::{Body, Problem, Unknown, Window};
use mceip_oracle::TwoParticles;
use mceip_paper::two_particles;
use mceip_testkit::{Instance, compare};
use num_traits::{One, Signed};
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

pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let number = |option: &'static str, text: &str| {
        parse(text).map_err(|_| CliError::Option {
            option,
            expected: "a number",
            got: text.into(),
        })
    };
    let positive = |option: &'static str, text: &str| {
        number(option, text)?
            .is_positive()
            .then(|| parse(text).ok())
            .flatten()
            .ok_or_else(|| CliError::Option {
                option,
                expected: "a number > 0",
                got: text.into(),
            })
    };
    let (c, s) = (number("c", &args.c)?, number("s", &args.s)?);
    if c.is_negative() || s.is_negative() || &c * &c + &s * &s != Rational::one() {
        return Err(CliError::Option {
            option: "s",
            expected: "c, s >= 0 with c^2 + s^2 = 1 exactly",
            got: format!("{c}, {s}"),
        });
    }
    let (k, m, mu) = (
        positive("k", &args.k)?,
        positive("m", &args.m)?,
        positive("mu", &args.mu)?,
    );
    if let Some(path) = &args.chart {
        chart(path)?;
    }
    let mut table = Table::new(&[
        "S1",
        "S2",
        "lambda^2",
        "slip",
        "x_T1",
        "x_T2",
        "exact polynomial",
    ]);
    let (mut json, mut agreed) = (Vec::new(), true);
    let mut uncertified = 0;
    for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
        let data = TwoParticles {
            c: c.clone(),
            s: s.clone(),
            k: k.clone(),
            m: m.clone(),
            mu: mu.clone(),
            signs,
        };
        let problem = Problem::new(
            Body::System(two_particles(&data)?),
            Unknown::Lambda2,
            Window::all(),
        )?;
        let reduced = mceip_engine::reduction::reduce(&problem)?;
        let found = mceip_oracle::enumerate(&reduced.pencil, problem.window())?;
        let instance = Instance {
            label: format!("{signs:?}"),
            problem: problem.clone(),
            closed_form: Some(data),
            corners: Vec::new(),
        };
        let report = compare(&instance, &Search::default());
        agreed &= report.disagreements.is_empty();
        uncertified += report.uncertified.len();
        for reason in &report.uncertified {
            eprintln!("S = {signs:?}: uncertified: {reason}");
        }
        for d in &report.disagreements {
            eprintln!("S = {signs:?}: {d}");
        }
        let (s1, s2) = (format!("{:+}", signs.0), format!("{:+}", signs.1));
        if found.solutions.is_empty() {
            table.row(vec![s1.clone(), s2.clone(), "no solution".into()]);
        }
        for s in &found.solutions {
            let l = Listed::of_solution(&problem, &reduced, s);
            let polynomial = s.value.poly().to_string();
            table.row(vec![
                s1.clone(),
                s2.clone(),
                l.value.clone(),
                format!("{:?}", s.slip),
                l.x[0].clone(),
                l.x[1].clone(),
                polynomial,
            ]);
            json.push(serde_json::json!({
                "signs": [signs.0, signs.1],
                "lambda2": l.value,
                "slip": l.slip,
                "x": l.x,
            }));
        }
    }
    let verdict = match (agreed, uncertified) {
        (true, 0) => "closed form = enumerator = certified, all four sign patterns",
        (true, _) => "closed form = enumerator, not all certified",
        (false, _) => "DISAGREEMENT",
    };
    if args.json {
        print(&format!(
            "{}\n",
            serde_json::json!({ "solutions": json, "agreement": agreed })
        ))?;
    } else {
        print(&format!(
            "c = {c}, s = {s}, k = {k}, m = {m}, mu = {mu}\n{table}{verdict}\n"
        ))?;
    }
    Ok(if agreed { exit::DONE } else { exit::REJECTED })
}

/// The endings that a chart's name may have in this build.
#[cfg(feature = "png")]
const CHART_NAMES: &str = "a name ending in .svg or .png";
#[cfg(not(feature = "png"))]
const CHART_NAMES: &str = "a name ending in .svg (.png needs a build with `--features png`)";

/// The chart, in the format that the file's name asks for.
fn chart(path: &Path) -> Result<(), CliError> {
    let ending = path
        .extension()
        .and_then(|e| e.to_str())
        .map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("svg") => Output::prepare("chart", path, &[])?.write(&table1_picture().to_svg()),
        #[cfg(feature = "png")]
        Some("png") => {
            Output::prepare("chart", path, &[])?.write_bytes(&table1_picture().to_png(2.0)?)
        }
        _ => Err(CliError::Option {
            option: "chart",
            expected: CHART_NAMES,
            got: path.display().to_string(),
        }),
    }
}
