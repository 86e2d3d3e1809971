//! `mceip block --lambda2`: growth rates by sparse condensation, certified where the mesh is small
//! enough.

use super::args::{Args, published};
use super::scale;
use super::scale_error::ScaleError;
use crate::cli::common::{CliError, exit, print};
use crate::cli::job::Job;
use mceip_engine::certify::{Certifier, ENCLOSED_ORDER};
use mceip_engine::multistart::{
    CondensedFound, CondensedSearch, CondensedSolution, search_condensed,
};
use mceip_engine::reduction::{SparseCondensation, reduce};
use mceip_engine::report::Table;
use mceip_engine::run::{Cancel, Progress, Watch};
use mceip_exact::{Rational, parse, to_f64};
use mceip_model::{Body, ContactState, Problem, Unknown, Window};
use mceip_paper::{Block, BlockModel, DoubleBlock, MassKind};
use num_traits::Signed;
use serde_json::{Value, json};
use std::time::Instant;

/// A mesh with its contact states.
struct Case {
    name: String,
    model: BlockModel,
    states: Vec<ContactState>,
}

/// What came of a case at one friction.
struct Row {
    name: String,
    mu: String,
    orders: (usize, usize),
    found: CondensedFound,
    /// For each solution: the certified value, or why there is none.
    evidence: Vec<Result<f64, String>>,
    seconds: f64,
}

/// Searches each case at each friction and prints the table.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let bad = |got: &str| CliError::Option {
        option: "lambda2",
        expected: "a friction mu > 0",
        got: got.chars().take(60).collect(),
    };
    let friction = |text: &String| {
        parse(text)
            .ok()
            .filter(Rational::is_positive)
            .ok_or_else(|| bad(text))
    };
    let frictions = args
        .lambda2
        .iter()
        .map(friction)
        .collect::<Result<Vec<_>, _>>()?;
    let cases = cases(args)?;
    let job = Job::begin("block");
    let search = CondensedSearch {
        starts: args.starts,
        seed: args.seed,
        ..CondensedSearch::default()
    };
    let mut rows = Vec::new();
    for case in &cases {
        job.say(format!("{}: assembling", case.name));
        let condensation = condensation(case)?;
        let exact = (condensation.dofs() <= ENCLOSED_ORDER)
            .then(|| Block::new(&case.model))
            .transpose()?;
        for (mu, text) in frictions.iter().zip(&args.lambda2) {
            let heard = |what: &str| job.say(format!("{}, mu = {text}: {what}", case.name));
            let clock = Instant::now();
            let told = |progress: &Progress<'_>| heard(&progress.to_string());
            let watch = Watch::new(job.cancel(), &told);
            let found = searched(&condensation, mu, &search, &watch)?;
            let seconds = clock.elapsed().as_secs_f64();
            heard("certifying");
            let evidence = evidence(exact.as_ref(), case, mu, &found.solutions, job.cancel())?;
            let orders = (condensation.dofs(), condensation.slip_count());
            rows.push(Row {
                name: case.name.clone(),
                mu: text.clone(),
                orders,
                found,
                evidence,
                seconds,
            });
            if job.is_cancelled() {
                break;
            }
        }
        if job.is_cancelled() {
            break;
        }
    }
    job.end();
    print(&if args.json {
        format!(
            "{}\n",
            json!({ "lambda2": rows.iter().map(json_of).collect::<Vec<_>>() })
        )
    } else {
        text_of(&rows, args.seed)
    })?;
    let certified = rows
        .iter()
        .all(|r| !r.evidence.is_empty() && r.evidence.iter().all(Result::is_ok));
    Ok(match () {
        () if job.is_cancelled() => exit::INTERRUPTED,
        () if certified => exit::DONE,
        () => exit::UNDECIDED,
    })
}

/// The published states on the paper's mesh, or all-slip states on the meshes of --scale.
fn cases(args: &Args) -> Result<Vec<Case>, CliError> {
    let mass = if args.lumped {
        MassKind::Lumped
    } else {
        MassKind::Consistent
    };
    if args.scale.is_empty() {
        let case = |s: mceip_paper::PublishedState| Case {
            name: s.name().to_string(),
            model: BlockModel {
                mass,
                ..BlockModel::of_the_paper()
            },
            states: s.states(),
        };
        return Ok(published(args.state)?.into_iter().map(case).collect());
    }
    let case = |text: &String| {
        let model = BlockModel {
            mass,
            ..scale::model(text)?
        };
        let states = scale::states(model.cells.0);
        Ok(Case {
            name: format!("{}x{} cells", model.cells.0, model.cells.1),
            model,
            states,
        })
    };
    args.scale.iter().map(case).collect()
}

fn condensation(case: &Case) -> Result<SparseCondensation, ScaleError> {
    let block = DoubleBlock::new(&case.model)?;
    let (stiffness, mass) = (
        scale::symmetric("K", &block.stiffness)?,
        scale::symmetric("M", &block.mass)?,
    );
    Ok(SparseCondensation::new(
        stiffness,
        Some(mass),
        &block.particles(&case.states),
        Some(&block.points),
    )?)
}

fn searched(
    condensation: &SparseCondensation,
    mu: &Rational,
    search: &CondensedSearch,
    watch: &Watch<'_>,
) -> Result<CondensedFound, ScaleError> {
    Ok(search_condensed(condensation, to_f64(mu), search, watch)?)
}

/// Certifies each solution on the exact K and M: the checker has accepted its claim.
fn evidence(
    block: Option<&Block>,
    case: &Case,
    mu: &Rational,
    solutions: &[CondensedSolution],
    cancel: &Cancel,
) -> Result<Vec<Result<f64, String>>, CliError> {
    let Some(block) = block else {
        return Ok(solutions
            .iter()
            .map(|_| Err(format!("more than {ENCLOSED_ORDER} dofs")))
            .collect());
    };
    let mut states = case.states.clone();
    states.resize(block.contact.len(), ContactState::Free);
    let system = block.system(&states, Some(mu.clone()))?;
    let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?;
    let pencil = reduce(&problem)?.pencil;
    let certifier = Certifier::new(&problem, &pencil);
    let one = |s: &CondensedSolution| {
        if cancel.is_requested() {
            Err("interrupted".into())
        } else {
            accepted(&certifier, s)
        }
    };
    Ok(solutions.iter().map(one).collect())
}

/// The value of a solution that the checker accepts.
fn accepted(certifier: &Certifier<'_>, solution: &CondensedSolution) -> Result<f64, String> {
    let (_, proved) = certifier
        .certify_with_verdict(&solution.candidate)
        .map_err(|e| e.to_string())?;
    Ok(to_f64(&proved.value.mid()))
}

fn text_of(rows: &[Row], seed: u64) -> String {
    let mut table = Table::new(&[
        "state",
        "dofs",
        "n_s",
        "mu",
        "lambda^2 1/s^2",
        "lambda 1/s",
        "slipping",
        "runs",
        "factorisations",
        "seconds",
        "evidence",
    ]);
    for r in rows {
        let head = || {
            vec![
                r.name.clone(),
                r.orders.0.to_string(),
                r.orders.1.to_string(),
                r.mu.clone(),
            ]
        };
        let tail = |runs: usize| {
            vec![
                format!("{runs} of {}", r.found.runs),
                r.found.factorisations.to_string(),
                format!("{:.2}", r.seconds),
            ]
        };
        if r.found.solutions.is_empty() {
            let none = ["none found", "", ""].map(String::from).to_vec();
            table.row(
                [
                    head(),
                    none,
                    tail(0),
                    vec!["none: this proves nothing".into()],
                ]
                .concat(),
            );
        }
        for (s, evidence) in r.found.solutions.iter().zip(&r.evidence) {
            let value = *evidence.as_ref().unwrap_or(&s.candidate.value);
            let slipping = s.slip.iter().filter(|x| **x > 0.0).count();
            let middle = vec![
                format!("{value:.4}"),
                format!("{:.6}", value.sqrt()),
                slipping.to_string(),
            ];
            let why = evidence.as_ref().map_or_else(
                |e| format!("UNCERTIFIED: {e}"),
                |_| "certified, accepted".into(),
            );
            table.row([head(), middle, tail(s.runs), vec![why]].concat());
        }
    }
    format!(
        "{table}MCEIP-lambda2 by many starts (seed {seed}): other solutions may exist; `mceip \
         complete` proves that there are none\n"
    )
}

fn json_of(r: &Row) -> Value {
    let one = |(s, evidence): (&CondensedSolution, &Result<f64, String>)| {
        json!({
            "lambda2": evidence.as_ref().unwrap_or(&s.candidate.value),
            "certified": evidence.is_ok(),
            "reason": evidence.as_ref().err(),
            "x_slip": s.slip,
            "y_slip": s.reaction,
            "runs": s.runs,
        })
    };
    json!({
        "state": r.name,
        "mu": r.mu,
        "dofs": r.orders.0,
        "slip": r.orders.1,
        "seconds": r.seconds,
        "runs": r.found.runs,
        "factorisations": r.found.factorisations,
        "interrupted": r.found.interrupted,
        "solutions": r.found.solutions.iter().zip(&r.evidence).map(one).collect::<Vec<_>>(),
    })
}
