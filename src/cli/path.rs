//! `mceip path`: the contact states that loads lead to, event by event.
//!
//! A body with contact candidates is loaded step by step (`mceip-loads/1`). The path is piecewise
//! linear in the load; each event, where a candidate changes its state, is located exactly by
//! `mceip_path`. Each stretch between two events gives contact states: on request as a problem
//! file, and with what is proved of them ([`states`]).

mod certified;
mod own;
pub(in crate::cli) mod states;
pub(in crate::cli) mod stretches;
pub(in crate::cli) mod words;

use super::common::{CliError, exit, positive, print, require_count, text};
use super::job::Job;
use super::output::{Folder, Output};
use crate::picture::{PathLabels, path_picture};
use crate::say::counted;
use certified::certify;
use mceip_engine::analysis::AnalysisError;
use mceip_engine::equilibrium::Uncertified;
use mceip_engine::run::{Cancel, Progress, Watch};
use mceip_exact::{Rational, to_f64};
use mceip_model::file::{LoadsFile, folder_of, read_loads, write_problem};
use mceip_model::{LoadedBody, System, Unknown};
use mceip_path::{Contact, LoadSteps, LoadingPath, PathEnd, PathError};
use own::{Asked, Loaded, OwnCritical};
use serde_json::{Value, json};
use states::{Followed, ProvedState, Wanted};
use std::path::{Path, PathBuf};
use std::time::Duration;
use words::end_text;

/// Arguments of `path`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// The body and its loads (`mceip-loads/1`; `-` for stdin).
    file: PathBuf,
    /// Another coefficient of friction than that of the file.
    #[arg(long, allow_hyphen_values = true)]
    mu: Option<String>,
    /// Condense in doubles instead of exactly: fast for large bodies and for matrices in doubles.
    /// The path is then, exactly, that of a body which differs from the given one by rounding.
    #[arg(long)]
    doubles: bool,
    /// Write the problem of each stretch with impending slip into this folder, as
    /// `stretch-NUMBER.json`: input of `analyze`. Files of that name from an earlier path are
    /// removed.
    #[arg(long, value_name = "FOLDER")]
    states: Option<PathBuf>,
    /// For each state with impending slip the complete set of MCEIP-mu, proved.
    #[arg(long)]
    complete: bool,
    /// With --complete: check these sets on K itself instead of the exactly condensed pencil
    /// (slower).
    #[arg(long, requires = "complete")]
    uncondensed: bool,
    /// With --complete: from which mu the necessary condition (19) or (20) holds.
    #[arg(long, requires = "complete")]
    conditions: bool,
    /// With --complete: at these mu (one or more, by commas) the complete set of MCEIP-lambda2,
    /// with growth rates.
    #[arg(
        long,
        requires = "complete",
        value_name = "MU",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    at_mu: Vec<String>,
    /// The own critical friction: at mu between these the path at this mu, and whether the
    /// equilibrium at its end can diverge; at a grid, and between neighbours that differ.
    #[arg(
        long,
        value_name = "MIN,MAX",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    own_critical: Vec<String>,
    /// With --own-critical: parts of the grid from MIN to MAX.
    #[arg(
        long,
        requires = "own_critical",
        value_name = "N",
        default_value_t = 10
    )]
    grid: usize,
    /// With --own-critical: how near neighbours with different answers have to be, relative to mu.
    #[arg(
        long,
        requires = "own_critical",
        value_name = "WIDTH",
        default_value = "0.01",
        allow_hyphen_values = true
    )]
    width: String,
    /// Certify the contact states inside each stretch, into this folder, as
    /// `equilibrium-NUMBER.json` for `mceip check FILE`. With --own-critical those at the end of
    /// each path, and problem and certificate of what is said of divergence.
    #[arg(long, value_name = "FOLDER")]
    certificates: Option<PathBuf>,
    /// Draw resultants and states along the path, as SVG.
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// What the axes of the picture say: units are those of the file.
const LABELS: PathLabels = PathLabels {
    load: "load: 1 at the end of the first step, 2 of the second",
    resultants: "resultants",
};

/// Follows the path and prints it.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let input: &[&Path] = &[&args.file];
    let file = read_body(&text("the loads", &args.file)?, &args.file)?;
    let friction = friction(&file.body, args.mu.as_deref())?;
    let at_mu = args.at_mu.iter().map(|mu| positive("at-mu", mu));
    let at_mu = at_mu.collect::<Result<Vec<_>, _>>()?;
    let picture = Output::prepare_if("picture", args.picture.as_deref(), input)?;
    let folder = Folder::prepare_if("states", args.states.as_deref(), input)?;
    let proofs = Folder::prepare_if("certificates", args.certificates.as_deref(), input)?;
    require_count("grid", args.grid as u64, 1..=MAX_GRID)?;
    let own_asked = match args.own_critical.as_slice() {
        [] => None,
        ends => Some(Asked::of(ends, args.grid, &args.width)?),
    };
    if own_asked.is_some() && file.body.system().mass().is_none() {
        return Err(AnalysisError::NoMass.into());
    }

    let (how, condense): (_, Condense) = if args.doubles {
        ("in doubles", Contact::condense_in_doubles)
    } else {
        ("exactly", Contact::condense)
    };
    let job = Job::begin(&format!("condensing {how} to the contact candidates"));
    let body = file.body.clone();
    let condensed = in_background(job.cancel(), move || {
        condense(body.system(), body.gaps(), body.loads())
    });
    let Some(contact) = condensed else {
        job.end();
        return Ok(exit::INTERRUPTED);
    };
    let contact = contact?;

    let steps = steps(&file.body, &friction);
    let names: Vec<String> = file.body.steps().iter().map(|s| s.name.clone()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let path = LoadingPath::follow(&contact, &steps, &|at| {
        let amount = to_f64(at.amount);
        let step = names[at.step];
        job.say(format!("stretch {}: {step}, {amount:.4} of it", at.stretch));
        job.flow()
    })?;

    let proved = if args.complete {
        let wanted = Wanted {
            // Nothing is proved of the given body on matrices that were rounded.
            uncondensed: args.uncondensed || args.doubles,
            conditions: args.conditions,
            at_mu: &at_mu,
            modes: false,
        };
        let say = |progress: &Progress<'_>| job.say(progress);
        let watch = Watch::new(job.cancel(), &say);
        let followed = Followed {
            body: file.body.system(),
            contact: &contact,
            path: &path,
        };
        Some(states::of(&followed, &wanted, &watch)?)
    } else {
        None
    };
    let own = match &own_asked {
        None => None,
        Some(asked) => {
            let loaded = Loaded {
                body: &file.body,
                contact: &contact,
                steps: &steps,
                names: &names,
            };
            Some(job.watched(|watch| OwnCritical::find(&loaded, asked, proofs.as_ref(), watch))?)
        }
    };
    let certified = match (&proofs, &own) {
        (Some(folder), None) => Some(certify_stretches(&file.body, &path, folder, &job)?),
        _ => None,
    };
    job.end();

    let outcome = Outcome {
        file,
        names: &names,
        path,
        in_doubles: args.doubles,
        proved,
        own,
        certified,
        is_interrupted: job.is_cancelled(),
    };
    // What cannot be written takes nothing else along.
    let states = folder.map_or(Ok(()), |folder| outcome.write_states(&folder));
    let picture = picture.map_or(Ok(()), |picture| {
        let title = "Loading path: resultants, and the state of each contact candidate";
        picture.write(&path_picture(title, &outcome.path, LABELS).to_svg())
    });

    print(&if args.json {
        format!("{}\n", outcome.json())
    } else {
        outcome.text()
    })?;
    proofs.map_or(Ok(()), Folder::first_failure)?;
    states.and(picture)?;
    let code = exit_code(
        &outcome.path,
        outcome.proved.as_deref(),
        outcome.is_interrupted,
    );
    match outcome.own {
        Some(own) if code == exit::DONE && own.is_undecided() => Ok(exit::UNDECIDED),
        _ => Ok(code),
    }
}

/// More parts than any picture has use for.
const MAX_GRID: u64 = 10_000;

/// A way to condense a body under loads.
type Condense = fn(&System, &[Rational], &[Vec<Rational>]) -> Result<Contact, PathError>;

/// Reads the text of a file of a body under loads; stdin has its matrices in this folder.
pub(super) fn read_body(text: &str, path: &Path) -> Result<LoadsFile, CliError> {
    let folder = if path == Path::new("-") {
        Path::new(".")
    } else {
        folder_of(path)
    };
    read_loads(text, folder).map_err(|source| CliError::file(path, source))
}

/// mu of the command line, else of the file.
fn friction(body: &LoadedBody, given: Option<&str>) -> Result<Rational, CliError> {
    match (given, body.system().friction()) {
        (Some(mu), _) => positive("mu", mu),
        (None, Some(mu)) => Ok(mu.clone()),
        (None, None) => Err(CliError::option(
            "mu",
            "a coefficient of friction here or in the file",
            "none",
        )),
    }
}

/// Each load once, the last one without end where the file says so.
fn steps(body: &LoadedBody, friction: &Rational) -> LoadSteps {
    let one = Rational::from_integer(1.into());
    let steps = body.steps().iter();
    LoadSteps {
        friction: friction.clone(),
        amounts: steps
            .map(|step| (!step.is_endless).then(|| one.clone()))
            .collect(),
    }
}

/// Work in a thread of its own: it cannot be broken off, but it can be left behind. `None` if it
/// was.
pub(super) fn in_background<T: Send + 'static>(
    cancel: &Cancel,
    work: impl FnOnce() -> T + Send + 'static,
) -> Option<T> {
    let worker = std::thread::spawn(work);
    while !worker.is_finished() {
        if cancel.is_requested() {
            return None;
        }
        std::thread::sleep(Duration::from_millis(2));
    }

    match worker.join() {
        Ok(done) => Some(done),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// What came out.
struct Outcome<'a> {
    file: LoadsFile,
    /// Names of the steps.
    names: &'a [&'a str],
    path: LoadingPath,
    /// Was the body condensed in doubles?
    in_doubles: bool,
    /// What is proved of the states, if asked for.
    proved: Option<Vec<ProvedState>>,
    /// The own critical friction, if asked for.
    own: Option<OwnCritical>,
    /// Whether the contact states inside each stretch are certified, if asked for.
    certified: Option<Vec<Result<(), Uncertified>>>,
    is_interrupted: bool,
}

impl Outcome<'_> {
    /// The path and the states, for people.
    fn text(&self) -> String {
        let name = self.file.name.as_deref().unwrap_or("a body under loads");
        let mu = to_f64(&self.path.steps.friction);
        let letters = stretches::LETTERS;
        let table = stretches::table_of(&self.path, self.names);
        let end = end_text(&self.path);
        let of_what = if self.in_doubles {
            "of the body condensed in doubles every event is"
        } else {
            "every event is"
        };
        let own = self.own.as_ref().map(|own| own.text(self.in_doubles));
        let mut out = own.map_or_else(String::new, |own| format!("{own}\n"));
        out += &format!(
            "{name}; mu = {mu}; from and to: how much of the step's load is applied\n\
             {letters}\n\
             {table}\n\
             {of_what} an exact rational number; (1), (2), (5), (7) verified exactly at both \
             ends of each stretch; {end}\n"
        );
        if let Some(certified) = &self.certified {
            out += &certified_text(certified);
        }
        match self.proved.as_deref() {
            None => {}
            Some([]) => out += "\nno candidate is in impending slip: no state to examine\n",
            Some(proved) => out += &states::text_of(proved, &self.path),
        }
        if self.is_interrupted {
            out += INTERRUPTED;
        }

        out
    }

    /// The same for programs.
    fn json(&self) -> Value {
        let mut out = json!({
            "name": self.file.name,
            "mu": self.path.steps.friction.to_string(),
            "condensed": if self.in_doubles { "in doubles" } else { "exactly" },
            "steps": self.names,
            "intervals": stretches::json_of(&self.path, self.names),
            "end": end_text(&self.path),
            "slides": self.path.slides(),
            "interrupted": self.is_interrupted,
        });
        if let Some(certified) = &self.certified {
            let certified: Vec<bool> = certified.iter().map(Result::is_ok).collect();
            out["states_certified"] = json!(certified);
        }
        if let Some(proved) = &self.proved {
            out["complete_sets"] = states::json_of(proved, &self.path);
        }
        if let Some(own) = &self.own {
            out["own_critical"] = own.json();
        }

        out
    }

    /// The problem of each stretch with impending slip; those of an earlier path go.
    fn write_states(&self, folder: &Folder) -> Result<(), CliError> {
        let mut written = Vec::new();
        for (k, stretch) in self.path.stretches.iter().enumerate() {
            let states = stretch.equilibrium_states();
            if !states.iter().any(states::is_slip) {
                continue;
            }

            let friction = &self.path.steps.friction;
            let mut problem = self.file.body.problem(states, friction, Unknown::Mu)?;
            let name = self.file.name.as_deref().unwrap_or("loading path");
            problem.name = Some(format!(
                "{name}, stretch {k} ({})",
                self.names[stretch.step]
            ));
            problem.coordinates = self.file.coordinates.clone();

            let file = format!("stretch-{k:03}.json");
            folder.write(&file, write_problem(&problem).as_bytes())?;
            written.push(k);
        }

        folder.keep_numbered("stretch", &written)
    }
}

/// Certifies the contact states inside each stretch and writes what is accepted; those that an
/// interrupt leaves are not in the list.
fn certify_stretches(
    body: &LoadedBody,
    path: &LoadingPath,
    folder: &Folder,
    job: &Job,
) -> Result<Vec<Result<(), Uncertified>>, CliError> {
    let mut certified = Vec::new();
    let mut written = Vec::new();
    let count = path.stretches.len();
    for (k, stretch) in path.stretches.iter().enumerate() {
        if job.is_cancelled() {
            break;
        }

        job.say(format!(
            "certifying the contact states of stretch {k} of {count}"
        ));
        certified.push(match certify(body, path, stretch, &stretch.inside) {
            Ok(proved) => {
                folder.keep(&format!("equilibrium-{k:03}.json"), &proved.file()?);
                written.push(k);
                Ok(())
            }
            Err(why) => Err(why),
        });
    }

    folder.keep_numbered("equilibrium", &written)?;
    Ok(certified)
}

/// Of how many stretches the contact states are certified, and why others are not.
fn certified_text(certified: &[Result<(), Uncertified>]) -> String {
    let proved = certified.iter().filter(|state| state.is_ok()).count();
    let stretches = counted(certified.len(), "stretch");
    let mut out = format!(
        "the contact states inside {proved} of {stretches} are certified to be those of an \
         equilibrium; that it is the only one is not\n"
    );
    for (k, state) in certified.iter().enumerate() {
        if let Err(why) = state {
            out += &format!("  stretch {k} is not: {why}\n");
        }
    }

    out
}

/// What the text of an interrupted run ends with.
pub(super) const INTERRUPTED: &str = "INTERRUPTED: what is not listed was not examined\n";

/// Undecided is a path that may go on, and a state with open regions.
pub(super) fn exit_code(
    path: &LoadingPath,
    states: Option<&[ProvedState]>,
    is_interrupted: bool,
) -> u8 {
    let is_unproved = matches!(&path.end, PathEnd::NoContinuation { why, .. } if !why.is_proved());
    let is_open = states.is_some_and(|states| states.iter().any(ProvedState::is_open));

    if is_interrupted {
        exit::INTERRUPTED
    } else if is_unproved || is_open {
        exit::UNDECIDED
    } else {
        exit::DONE
    }
}
