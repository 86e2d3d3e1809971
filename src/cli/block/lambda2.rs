//! `mceip block --lambda2`: growth rates by sparse condensation, certified where the mesh is small
//! enough.
//!
//! For each case (a mesh with its contact states) and each mu, MCEIP-lambda2 is searched from many
//! starts on the pencil condensed in doubles. Where K has at most [`ENCLOSED_ORDER`] rows, each
//! solution found is then certified on the exact K and M. On a larger mesh the checker finds the
//! backward error of each, for the problem whose K and M are the doubles.

use super::super::common::require_count;
use super::args::{Args, published};
use super::doubles::CondensedBlock;
use super::scale;
use super::scale_error::ScaleError;
use crate::cli::common::{CliError, exit, positive_number, print_answer};
use crate::cli::job::Job;
use mceip_engine::candidate::BACKWARD_ERROR_DIGITS;
use mceip_engine::certify::{Certifier, ENCLOSED_ORDER};
use mceip_engine::multistart::{
    CondensedFound, CondensedSearch, CondensedSolution, MAX_STARTS, search_condensed,
};
use mceip_engine::report::Table;
use mceip_engine::run::{Cancel, Progress, Watch};
use mceip_exact::{Rational, to_f64, upper_decimal};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ContactState, Problem, Unknown, Window};
use mceip_paper::{Block, BlockModel};
use serde_json::{Value, json};
use std::fmt;
use std::time::Instant;

/// A mesh with its contact states.
struct MeshCase {
    name: String,
    model: BlockModel,
    states: Vec<ContactState>,
}

/// A coefficient of friction with the text that gave it.
struct SpeltFriction {
    mu: Rational,
    text: String,
}

/// For a solution: the certified value, or why there is none.
type CertifiedValue = Result<f64, WhyUncertified>;

/// Why a solution is not certified.
struct WhyUncertified {
    reason: String,
    /// The backward error for K and M in doubles, rounded up; on a large mesh only.
    backward_error: Option<String>,
}

/// What came of a case at one friction.
struct FrictionRow {
    name: String,
    mu: String,
    dofs: usize,
    slip: usize,
    found: CondensedFound,
    /// For each solution found.
    evidence: Vec<CertifiedValue>,
    /// Time of the search.
    seconds: f64,
}

/// Searches each case at each friction and prints the table.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let frictions = frictions(&args.lambda2)?;
    require_count("starts", args.starts as u64, 1..=MAX_STARTS as u64)?;
    let cases = cases(args)?;

    let job = Job::begin("block");
    let search = CondensedSearch {
        starts: args.starts,
        seed: args.seed,
        ..CondensedSearch::default()
    };
    let mut rows = Vec::new();
    for case in &cases {
        case.search(&frictions, &search, &job, &mut rows)?;
        if job.is_cancelled() {
            break;
        }
    }
    job.end();

    let json = || json!({ "lambda2": rows.iter().map(FrictionRow::json).collect::<Vec<Value>>() });
    print_answer(args.json, json, || text_of(&rows, args.seed))?;

    let is_certified = rows.iter().all(FrictionRow::is_certified);
    Ok(if job.is_cancelled() {
        exit::INTERRUPTED
    } else if is_certified {
        exit::DONE
    } else {
        exit::UNDECIDED
    })
}

fn frictions(texts: &[String]) -> Result<Vec<SpeltFriction>, CliError> {
    let mut frictions = Vec::new();
    for text in texts {
        let expected = "a friction mu > 0";
        let mu = positive_number(text);
        let mu = mu.ok_or_else(|| CliError::option("lambda2", expected, text))?;
        let text = text.clone();
        frictions.push(SpeltFriction { mu, text });
    }

    Ok(frictions)
}

/// The published states on the paper's mesh, or all-slip states on the meshes of --scale.
fn cases(args: &Args) -> Result<Vec<MeshCase>, CliError> {
    let mass = args.mass();
    let mut cases = Vec::new();
    if args.scale.is_empty() {
        for state in published(args.state)? {
            cases.push(MeshCase {
                name: state.name().to_string(),
                model: BlockModel {
                    mass,
                    ..BlockModel::of_the_paper()
                },
                states: state.states(),
            });
        }

        return Ok(cases);
    }

    for text in &args.scale {
        let model = BlockModel {
            mass,
            ..scale::model(text)?
        };
        let (nx, ny) = model.cells;
        cases.push(MeshCase {
            name: format!("{nx}x{ny} cells"),
            model,
            states: scale::states(nx),
        });
    }

    Ok(cases)
}

impl MeshCase {
    /// Searches at each friction, until interrupted; a row for each.
    fn search(
        &self,
        frictions: &[SpeltFriction],
        search: &CondensedSearch,
        job: &Job,
        rows: &mut Vec<FrictionRow>,
    ) -> Result<(), CliError> {
        job.say(format!("{}: assembling", self.name));
        let block = CondensedBlock::new(&self.model, &self.states)?;
        let condensation = &block.condensation;
        let exact = if condensation.dofs() <= ENCLOSED_ORDER {
            Some(Block::new(&self.model)?)
        } else {
            None
        };

        for friction in frictions {
            let place = format!("{}, mu = {}", self.name, friction.text);
            let show = |progress: &Progress<'_>| job.say(format!("{place}: {progress}"));
            let watch = Watch::new(job.cancel(), &show);

            let clock = Instant::now();
            let found = search_condensed(condensation, to_f64(&friction.mu), search, &watch);
            let found = found.map_err(ScaleError::from)?;
            let seconds = clock.elapsed().as_secs_f64();

            let evidence = match &exact {
                Some(block) => {
                    job.say(format!("{place}: certifying"));
                    self.certify(block, &friction.mu, &found.solutions, job.cancel())?
                }
                None => {
                    job.say(format!("{place}: backward errors"));
                    backward_errors(&block, &friction.mu, &found.solutions, job.cancel())?
                }
            };
            rows.push(FrictionRow {
                name: self.name.clone(),
                mu: friction.text.clone(),
                dofs: condensation.dofs(),
                slip: condensation.slip_count(),
                found,
                evidence,
                seconds,
            });
            if job.is_cancelled() {
                break;
            }
        }

        Ok(())
    }

    /// Certifies each solution on the exact K and M: the checker has accepted its claim.
    fn certify(
        &self,
        block: &Block,
        mu: &Rational,
        solutions: &[CondensedSolution],
        cancel: &Cancel,
    ) -> Result<Vec<CertifiedValue>, CliError> {
        let mut states = self.states.clone();
        states.resize(block.contact.len(), ContactState::Free);
        let system = block.system(&states, Some(mu.clone()))?;
        let problem = Problem::new(Body::System(system), Unknown::Lambda2, Window::all())?;
        let pencil = reduce(&problem)?.pencil;
        let certifier = Certifier::new(&problem, &pencil);

        let mut evidence = Vec::new();
        for solution in solutions {
            evidence.push(if cancel.is_requested() {
                Err(WhyUncertified::because("interrupted".into()))
            } else {
                accepted(&certifier, solution)
            });
        }

        Ok(evidence)
    }
}

/// The value of a solution that the checker accepts.
fn accepted(certifier: &Certifier<'_>, solution: &CondensedSolution) -> CertifiedValue {
    let certified = certifier.certify_with_verdict(&solution.candidate);
    let (_, proved) = certified.map_err(|reason| WhyUncertified::because(reason.to_string()))?;
    Ok(to_f64(&proved.value.mid()))
}

/// The evidence for solutions on a mesh that is too large to certify: their backward errors.
fn backward_errors(
    block: &CondensedBlock,
    mu: &Rational,
    solutions: &[CondensedSolution],
    cancel: &Cancel,
) -> Result<Vec<CertifiedValue>, CliError> {
    let mut evidence = Vec::new();
    if solutions.is_empty() {
        return Ok(evidence);
    }

    let problem = block.problem(mu)?;
    for solution in solutions {
        evidence.push(Err(if cancel.is_requested() {
            WhyUncertified::because("interrupted".into())
        } else {
            too_large(&problem, solution)
        }));
    }

    Ok(evidence)
}

fn too_large(problem: &Problem, solution: &CondensedSolution) -> WhyUncertified {
    let reason = format!("more than {ENCLOSED_ORDER} dofs");
    match solution.candidate.backward_error(problem) {
        Ok(error) => WhyUncertified {
            reason,
            backward_error: Some(upper_decimal(&error, BACKWARD_ERROR_DIGITS)),
        },
        Err(refusal) => WhyUncertified::because(format!("{reason}; {refusal}")),
    }
}

impl WhyUncertified {
    /// Without a backward error.
    fn because(reason: String) -> WhyUncertified {
        WhyUncertified {
            reason,
            backward_error: None,
        }
    }
}

impl fmt::Display for WhyUncertified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "UNCERTIFIED: {}", self.reason)?;
        match &self.backward_error {
            Some(error) => write!(f, "; backward error {error}"),
            None => Ok(()),
        }
    }
}

fn text_of(rows: &[FrictionRow], seed: u64) -> String {
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
    for row in rows {
        if row.found.solutions.is_empty() {
            let solution = ["none found", "", ""].map(String::from);
            let evidence = "none: this proves nothing".into();
            table.row(row.cells(solution, 0, evidence));
        }

        for (solution, evidence) in row.found.solutions.iter().zip(&row.evidence) {
            let value = value_of(solution, evidence);
            let slipping = solution.slip.iter().filter(|x| **x > 0.0).count();
            let numbers = [
                format!("{value:.4}"),
                format!("{:.6}", value.sqrt()),
                slipping.to_string(),
            ];
            let evidence = match evidence {
                Ok(_) => "certified, accepted".into(),
                Err(uncertified) => uncertified.to_string(),
            };
            table.row(row.cells(numbers, solution.runs, evidence));
        }
    }

    format!(
        "{table}MCEIP-lambda2 by many starts (seed {seed}): other solutions may exist; `mceip \
         complete` proves that there are none\n"
    )
}

/// lambda^2: the certified value if there is one, else that of the search.
fn value_of(solution: &CondensedSolution, evidence: &CertifiedValue) -> f64 {
    match evidence {
        Ok(value) => *value,
        Err(_) => solution.candidate.value,
    }
}

impl FrictionRow {
    /// Is there a solution, and is each certified?
    fn is_certified(&self) -> bool {
        !self.evidence.is_empty() && self.evidence.iter().all(Result::is_ok)
    }

    /// A line of the table; `solution` stands for lambda^2, lambda and the number of slip nodes,
    /// `runs` for the runs that found it.
    fn cells(&self, solution: [String; 3], runs: usize, evidence: String) -> Vec<String> {
        let [lambda2, lambda, slipping] = solution;
        vec![
            self.name.clone(),
            self.dofs.to_string(),
            self.slip.to_string(),
            self.mu.clone(),
            lambda2,
            lambda,
            slipping,
            format!("{runs} of {}", self.found.runs),
            self.found.factorisations.to_string(),
            format!("{:.2}", self.seconds),
            evidence,
        ]
    }

    fn json(&self) -> Value {
        let mut solutions = Vec::new();
        for (solution, evidence) in self.found.solutions.iter().zip(&self.evidence) {
            let uncertified = evidence.as_ref().err();
            solutions.push(json!({
                "lambda2": value_of(solution, evidence),
                "certified": evidence.is_ok(),
                "reason": uncertified.map(|u| &u.reason),
                "backward_error": uncertified.map(|u| &u.backward_error),
                "x_slip": solution.slip,
                "y_slip": solution.reaction,
                "runs": solution.runs,
            }));
        }

        json!({
            "state": self.name,
            "mu": self.mu,
            "dofs": self.dofs,
            "slip": self.slip,
            "seconds": self.seconds,
            "runs": self.found.runs,
            "factorisations": self.found.factorisations,
            "interrupted": self.found.interrupted,
            "solutions": solutions,
        })
    }
}
