//! `mceip path`: the contact states that loads lead to, event by event.
//!
//! A body with contact candidates is loaded step by step (`mceip-loads/1`). The path is piecewise
//! linear in the load; each event, where a candidate changes its state, is located exactly by
//! `mceip_path`. Each stretch between two events gives contact states: on request as a problem
//! file, and with what is proved of them ([`states`]), as pictures and as a report ([`pages`]).

mod bodies;
mod own;
mod pages;
mod states;

use super::common::{CliError, error_line, exit, friction_of, print_answer, text};
use super::job::Job;
use super::output::{Folder, Output};
use super::pictures::{self, PictureArgs};
use crate::front::require_mass;
use crate::say::path::candidate_name;
use crate::{FrictionGrid, LoadPath, Loads, OwnCritical, PathAnalysis};
use mceip_check::with_short_numbers;
use mceip_engine::equilibrium::StatesNotCertified;
use mceip_engine::report::counted;
use mceip_engine::run::{Progress, Watch};
use mceip_exact::Rational;
use mceip_model::Unknown;
use mceip_model::file::{LoadsFile, folder_of, read_loads, write_problem};
use mceip_path::{LoadingPath, LoadingPathEnd};
use pages::{CheckedOn, Shown};
use serde_json::{Value, json};
use states::{ExaminedStates, Wanted};
use std::cell::Cell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Arguments of `path`.
#[derive(clap::Args)]
#[command(
    group = clap::ArgGroup::new("examined")
        .args(["complete", "report", "pictures", "vtk"])
        .multiple(true)
)]
pub(super) struct Args {
    /// The body and its loads (`mceip-loads/1`; `-` for stdin).
    file: PathBuf,
    /// Another coefficient of friction than that of the file.
    #[arg(long, alias = "friction", allow_hyphen_values = true)]
    mu: Option<String>,
    /// Condense in doubles instead of exactly: fast for large bodies and for matrices in doubles.
    /// The path is then, exactly, that of a body which differs from the given one by rounding.
    #[arg(long)]
    doubles: bool,
    /// At the beginning of a stretch go on in another way than the first that is met: STRETCH=K,
    /// the K-th of those that are listed, from 0 (several with commas).
    #[arg(
        long,
        value_name = "STRETCH=K",
        value_delimiter = ',',
        conflicts_with = "own_critical"
    )]
    take: Vec<String>,
    /// Write the problem of each stretch with impending slip into this folder, as
    /// `stretch-NUMBER.json`: input of `analyze`. Files of that name from an earlier path are
    /// removed.
    #[arg(long, value_name = "FOLDER")]
    states: Option<PathBuf>,
    /// Whether the state inside each stretch can diverge at the mu of the path, and from which mu
    /// on with its contact states held: the analysis of each, proved.
    #[arg(long)]
    analyze: bool,
    /// For each state with impending slip the complete set of MCEIP-mu, proved: the mu at which
    /// divergence begins at lambda = 0.
    #[arg(long)]
    complete: bool,
    /// With --complete: check these sets on K itself instead of the exactly condensed pencil
    /// (slower).
    #[arg(long, requires = "examined")]
    uncondensed: bool,
    /// With --complete: from which mu the necessary condition (19) or (20) holds.
    #[arg(long, requires = "examined")]
    conditions: bool,
    /// With --complete: at these mu (one or more, by commas) the complete set of MCEIP-lambda2,
    /// with growth rates.
    #[arg(
        long,
        requires = "examined",
        value_name = "MU",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    at_mu: Vec<String>,
    /// With --complete --json: the mode of each solution over all degrees of freedom.
    #[arg(long, requires = "examined")]
    modes: bool,
    /// The own critical friction: at mu between these the path at this mu, and whether an
    /// equilibrium on it can diverge; at a grid, and between neighbours that differ.
    #[arg(
        long,
        value_name = "MIN,MAX",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    own_critical: Vec<String>,
    /// With --own-critical: ask the equilibrium at the end of the loads alone, for large bodies;
    /// what the path meets before is not examined.
    #[arg(long, requires = "own_critical")]
    end_alone: bool,
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
    /// Certify the contact states at one amount inside each stretch, into this folder, as
    /// `equilibrium-NUMBER.json` for `mceip check FILE`, and where T(mu) is positive definite in
    /// them that the rates are the only ones, as `unique-NUMBER.certificate.json` with its problem;
    /// files of these names from an earlier path are removed. With --own-critical those that decide
    /// on each path, and problems and certificates of what is said of divergence.
    #[arg(long, value_name = "FOLDER")]
    certificates: Option<PathBuf>,
    /// With --own-critical --certificates: go on from the proofs about divergence that an earlier
    /// run has left in the folder, each checked again.
    #[arg(long, requires_all = ["own_critical", "certificates"])]
    resume: bool,
    /// Write the state, the displacement and the reaction of each candidate at both ends of each
    /// stretch, as CSV.
    #[arg(long, value_name = "OUT.csv")]
    reactions: Option<PathBuf>,
    /// Draw resultants and states along the path, as SVG.
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
    /// The path, every state's answers and pictures as one HTML file (implies --complete
    /// --conditions, as --pictures and --vtk do; with --own-critical that answer instead); modes
    /// are drawn where the file has coordinates.
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
    #[command(flatten)]
    pictures: PictureArgs,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Follows the path and prints it.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let input: &[&Path] = &[&args.file];
    let loads = read_loads_of(&text("the loads", &args.file)?, &args.file)?;
    let at_mu = args.at_mu.iter().map(|mu| friction_of("at-mu", mu));
    let at_mu = at_mu.collect::<Result<Vec<_>, _>>()?;
    let reactions = Output::prepare_if("reactions", args.reactions.as_deref(), input)?;
    let picture = Output::prepare_if("picture", args.picture.as_deref(), input)?;
    let report = Output::prepare_if("report", args.report.as_deref(), input)?;
    let has_places = loads.as_file().coordinates.is_some();
    let pictures = args.pictures.prepare(&args.file, has_places)?;
    let folder = Folder::prepare_if("states", args.states.as_deref(), input)?;
    let proofs = Folder::prepare_if("certificates", args.certificates.as_deref(), input)?;
    let own_asked = match args.own_critical.as_slice() {
        [] => None,
        ends => Some(own::grid_of(ends, args.grid, &args.width)?),
    };
    if own_asked.is_some() || !at_mu.is_empty() || args.analyze {
        require_mass(loads.body())?; // before the path takes its time
    }

    let job = Job::begin("reading");
    if !args.doubles && is_slow(&loads) {
        job.note(
            "mceip: condensing this body exactly may take minutes; with --doubles it takes seconds",
        );
    }
    let mut question = loads.path().in_doubles(args.doubles).cancel(job.cancel());
    match args.mu.as_deref() {
        Some(mu) => question = question.friction(friction_of("mu", mu)?),
        None if loads.body().system().friction().is_some() => {}
        None => {
            let expected = "a coefficient of friction here or in the file";
            return Err(CliError::option("mu", expected, "none"));
        }
    }
    let mut taken = BTreeSet::new();
    for choice in &args.take {
        let (stretch, continuation) = choice_of(choice)?;
        if !taken.insert(stretch) {
            return Err(CliError::option("take", "each stretch once", choice));
        }
        question = question.take(stretch, continuation);
    }
    let question = question.on_progress(|progress| job.say(progress));
    let Some(followed) = question.run()? else {
        job.end();
        return Ok(exit::INTERRUPTED);
    };
    let path = followed.as_path();
    let names = loads.step_names();
    // Each output is written as soon as its data are there. What cannot be written is told at once,
    // of pictures that are written together the first file; it takes nothing else along.
    let is_written = Cell::new(true);
    let tell = |written: Result<(), CliError>| {
        if let Err(e) = written {
            let why = with_short_numbers(&e.to_string());
            job.note(&error_line(&format!("{why}; the run goes on")));
            is_written.set(false);
        }
    };
    if let Some(folder) = folder {
        tell(write_states(&followed, &folder));
    }
    if let Some(file) = reactions {
        tell(file.write(&followed.reactions_csv()));
    }
    if picture.is_some() || pictures.are_wanted() {
        let chart = pages::path_chart(&followed, &names);
        if let Some(file) = picture {
            tell(file.write(chart.svg()));
        }
        tell(pictures.write(&[chart]));
    }

    let say = |progress: &Progress<'_>| job.say(progress);
    let watch = Watch::new(job.cancel(), &say);
    let is_shown = report.is_some() || pictures.are_wanted();
    // Nothing is proved of the given body on matrices that were rounded.
    let uncondensed = args.uncondensed || args.doubles;
    let own = own_asked.map(|grid| own_critical(&followed, grid, proofs.as_ref(), args, &job));
    let own = own.transpose()?;
    // After an interrupt the pictures of bodies and states are not drawn; the path is complete and
    // its own stays.
    if pictures.are_wanted() && !job.is_cancelled() {
        tell(pictures.write(&pages::beside_the_path(&followed, own.as_ref())));
    }
    let analysed = if args.analyze {
        let question = followed.analyze().cancel(job.cancel());
        Some(question.on_progress(|progress| job.say(progress)).run()?)
    } else {
        None
    };
    // The states of this path are not those that the own critical friction tells of.
    let are_examined = args.complete || (is_shown && own.is_none());
    let examined = if are_examined {
        let wanted = Wanted {
            uncondensed,
            conditions: args.conditions || is_shown,
            at_mu: &at_mu,
            modes: args.modes || is_shown,
        };
        Some(states::of(&followed, &wanted, &watch))
    } else {
        None
    };
    let shown = if is_shown {
        let examined = examined.as_ref();
        let states = examined.map_or(&[][..], |examined| &examined.proved);
        Some(Shown {
            followed: &followed,
            names: &names,
            analysed: analysed.as_ref(),
            examined,
            own: own.as_ref(),
            branches: pictures::drawn(
                pages::branches(loads.body().system(), path, states, &watch),
                &job,
            ),
            checked_on: if uncondensed {
                CheckedOn::Given
            } else {
                CheckedOn::Condensed
            },
        })
    } else {
        None
    };
    if let Some(shown) = shown.filter(|_| !job.is_cancelled()) {
        if pictures.are_wanted() {
            let drawn = shown.state_pictures().map_err(CliError::from);
            tell(drawn.and_then(|drawn| pictures.write(&drawn)));
        }
        if let Some(file) = report {
            let page = shown.report().map_err(CliError::from);
            tell(page.and_then(|page| file.write(&page.to_html())));
        }
    }
    let certified = match (&proofs, &own) {
        (Some(folder), None) => Some(certify_stretches(&followed, folder, &job)?),
        _ => None,
    };
    job.end();
    if !job.is_cancelled() {
        pictures.tell_no_body();
    }

    let outcome = PathOutcome {
        followed: &followed,
        names: &names,
        analysed,
        examined,
        own,
        certified,
        is_interrupted: job.is_cancelled(),
    };
    print_answer(args.json, || outcome.json(), || outcome.text())?;
    proofs.map_or(Ok(()), Folder::first_failure)?;
    if !is_written.get() {
        return Ok(CliError::EXIT);
    }
    let code = exit_code(path, outcome.examined.as_ref(), outcome.is_interrupted);
    let is_open = |analysed: &PathAnalysis| analysed.is_undecided();
    if code == exit::DONE && outcome.analysed.as_ref().is_some_and(is_open) {
        return Ok(exit::UNDECIDED);
    }
    let mut certified = outcome.certified.iter().flatten();
    let is_certified = certified.all(|stretch| stretch.states.is_ok());
    if code == exit::DONE && !is_certified {
        return Ok(exit::UNDECIDED);
    }
    match outcome.own {
        Some(own) if code == exit::DONE && own.is_undecided() => Ok(exit::UNDECIDED),
        _ => Ok(code),
    }
}

/// Degrees of freedom and bits of an entry from which on exact condensation takes long.
const SLOW: (usize, u64) = (120, 40);

fn is_slow(loads: &Loads) -> bool {
    let (dofs, bits) = SLOW;
    let system = loads.body().system();
    let mut entries = system.stiffness().entries();
    let is_long = |v: &Rational| v.numer().bits() + v.denom().bits() > bits;
    system.dofs() > dofs && entries.any(|(_, _, v)| is_long(v))
}

/// The own critical friction, each answer kept in the folder as soon as it is found.
fn own_critical(
    followed: &LoadPath,
    grid: FrictionGrid,
    folder: Option<&Folder>,
    args: &Args,
    job: &Job,
) -> Result<OwnCritical, CliError> {
    let mut question = followed.own_critical(grid).cancel(job.cancel());
    question = question.end_alone(args.end_alone);
    question = question.on_progress(|progress| job.say(progress));
    if let Some(folder) = folder {
        question = question
            .on_proof(|mu, place, proof| own::keep_divergence(folder, mu, place, proof))
            .on_point(|point| own::keep_point(folder, point));
    }
    if let Some(folder) = folder.filter(|_| args.resume) {
        question = question.resume(|mu, place| own::earlier(folder, mu, place));
    }

    let found = question.run()?;
    if let Some(folder) = folder {
        own::keep_frozen(folder, &found);
    }
    Ok(found)
}

/// `STRETCH=K` of `--take`.
fn choice_of(text: &str) -> Result<(usize, usize), CliError> {
    let both = text.split_once('=');
    let both = both.and_then(|(stretch, k)| Some((stretch.parse().ok()?, k.parse().ok()?)));
    let expected = "STRETCH=K, two numbers from 0";
    both.ok_or_else(|| CliError::option("take", expected, text))
}

/// Reads the text of a file of a body under loads; stdin has its matrices in this folder.
pub(super) fn read_loads_of(text: &str, path: &Path) -> Result<Loads, CliError> {
    let folder = if path == Path::new("-") {
        Path::new(".")
    } else {
        folder_of(path)
    };
    let file = read_loads(text, folder).map_err(|source| CliError::file(path, source))?;
    Ok(Loads::from(file))
}

/// What came out.
struct PathOutcome<'a> {
    followed: &'a LoadPath,
    /// Names of the steps.
    names: &'a [&'a str],
    /// Whether the states diverge, if asked for.
    analysed: Option<PathAnalysis>,
    /// What is proved of the states, if asked for.
    examined: Option<ExaminedStates>,
    /// The own critical friction, if asked for.
    own: Option<OwnCritical>,
    /// Whether the contact states inside each stretch are certified, if asked for.
    certified: Option<Vec<StretchCertification>>,
    is_interrupted: bool,
}

impl PathOutcome<'_> {
    fn file(&self) -> &LoadsFile {
        self.followed.loads().as_file()
    }

    fn path(&self) -> &LoadingPath {
        self.followed.as_path()
    }

    /// The path and the states, for people.
    fn text(&self) -> String {
        let mut out = match &self.own {
            Some(own) if self.is_interrupted => format!("{OWN_INTERRUPTED}{}", own.text()),
            Some(own) => own.text(),
            None => self.followed.text(),
        };
        if let Some(certified) = &self.certified {
            out += &certified_text(certified);
        }
        if let Some(analysed) = &self.analysed {
            out += &format!("\n{}", analysed.text());
        }
        if let Some(examined) = &self.examined {
            out += &states::text_of(examined, self.path());
        }
        if self.is_interrupted && self.own.is_none() {
            out += INTERRUPTED;
        }

        out
    }

    /// The same for programs.
    fn json(&self) -> Value {
        let mut out = json!({
            "name": self.file().name,
            "warnings": self.file().warnings,
            "mu": self.path().steps.friction.to_string(),
            "condensed": if self.followed.is_in_doubles() { "in doubles" } else { "exactly" },
            "steps": self.names,
            "candidates": self.candidate_names(),
            "intervals": self.followed.to_json(),
            "end": self.followed.end_text(),
            "slides": self.path().slides(),
            "held_by_rounding": self.followed.held_by_rounding(),
            "interrupted": self.is_interrupted,
        });
        if let Some(certified) = &self.certified {
            let states = certified.iter().map(|stretch| stretch.states.is_ok());
            out["states_certified"] = json!(states.collect::<Vec<_>>());
            let unique = certified.iter().map(|stretch| stretch.is_unique);
            out["rates_certified_unique"] = json!(unique.collect::<Vec<_>>());
        }
        if let Some(analysed) = &self.analysed {
            out["analyses"] = analysed.to_json();
        }
        if let Some(examined) = &self.examined {
            let places = self.file().body.places();
            out["complete_sets"] = states::json_of(&examined.proved, self.path(), places);
            out["not_examined"] = json!(examined.refused_json());
        }
        if let Some(own) = &self.own {
            out["own_critical"] = own.to_json();
        }

        out
    }

    /// The names of the candidates in the order of the file, as the table of events calls them.
    fn candidate_names(&self) -> Vec<String> {
        let candidates = self.file().body.system().particles();
        (0..candidates.len())
            .map(|node| candidate_name(candidates, node))
            .collect()
    }
}

/// The problem of each stretch with impending slip; those of an earlier path go. One that is
/// refused is told when the others are written.
fn write_states(followed: &LoadPath, folder: &Folder) -> Result<(), CliError> {
    let mut refused = Ok(());
    let mut written = Vec::new();
    for (k, stretch) in followed.as_path().stretches.iter().enumerate() {
        let states = stretch.equilibrium_states();
        if !states.iter().any(states::is_slip) {
            continue;
        }

        match followed.problem_in(k, Unknown::Mu) {
            Ok(problem) => {
                let file = format!("stretch-{k:03}.json");
                folder.write(&file, write_problem(&problem).as_bytes())?;
                written.push(k);
            }
            Err(why) => refused = refused.and(Err(why.into())),
        }
    }

    folder.keep_numbered("stretch", &written)?;
    refused
}

/// What is certified of a stretch.
struct StretchCertification {
    /// The contact states inside it, or why not.
    states: Result<(), StatesNotCertified>,
    /// That the rates in these states are the only ones.
    is_unique: bool,
}

/// Certifies the contact states inside each stretch, and that the rates in them are the only ones
/// where T(mu) is positive definite, and writes what is accepted; those that an interrupt leaves
/// are not in the list.
fn certify_stretches(
    followed: &LoadPath,
    folder: &Folder,
    job: &Job,
) -> Result<Vec<StretchCertification>, CliError> {
    let mut certified = Vec::new();
    let mut written = Vec::new();
    let mut unique = Vec::new();
    let count = followed.as_path().stretches.len();
    for k in 0..count {
        if job.is_cancelled() {
            break;
        }

        job.say(format!(
            "certifying the contact states of stretch {k} of {count}"
        ));
        let states = match followed.certify(k) {
            Ok(proved) => {
                if folder.keep(&format!("equilibrium-{k:03}.json"), &proved.file()?) {
                    written.push(k);
                }
                Ok(())
            }
            Err(why) => Err(why),
        };

        // What fails here takes nothing else along: these rates are not certified.
        let rates = followed.certify_unique(k, job.cancel()).ok().flatten();
        if let Some(rates) = &rates {
            let name = format!("unique-{k:03}");
            folder.keep_proof(&name, rates.problem(), &rates.proved().file()?);
            unique.push(k);
        }
        certified.push(StretchCertification {
            states,
            is_unique: rates.is_some(),
        });
    }

    // What an interrupt leaves unexamined may be proved by an earlier run.
    if !job.is_cancelled() {
        folder.keep_only("equilibrium", &written);
        folder.keep_only("unique", &unique);
    }
    Ok(certified)
}

/// Of how many stretches the contact states are certified, and why others are not.
fn certified_text(certified: &[StretchCertification]) -> String {
    let proved = certified
        .iter()
        .filter(|stretch| stretch.states.is_ok())
        .count();
    let unique = certified.iter().filter(|stretch| stretch.is_unique).count();
    let stretches = counted(certified.len(), "stretch");
    let mut out = format!(
        "the contact states at one amount inside {proved} of {stretches} are certified to be \
         those of an equilibrium; other equilibria are not excluded\n\
         in the states of {unique} of {stretches} the rates are certified to be unique, whatever \
         load grows\n"
    );
    for (k, stretch) in certified.iter().enumerate() {
        if let Err(why) = &stretch.states {
            out += &format!("  stretch {k} is not: {why}\n");
        }
    }

    out
}

/// What the text of an interrupted search for the own critical friction begins with.
const OWN_INTERRUPTED: &str = "INTERRUPTED: mu that are not listed were not examined. With \
    --certificates, the same command with --resume goes on.\n";

/// What the text of an interrupted run ends with.
const INTERRUPTED: &str = "INTERRUPTED: what is not listed was not examined\n";

/// Undecided is a path that may go on, and a state with open regions.
fn exit_code(path: &LoadingPath, states: Option<&ExaminedStates>, is_interrupted: bool) -> u8 {
    let is_unproved =
        matches!(&path.end, LoadingPathEnd::NoContinuation { why, .. } if !why.is_proved());
    let is_open = states.is_some_and(ExaminedStates::are_open);

    if is_interrupted {
        exit::INTERRUPTED
    } else if is_unproved || is_open {
        exit::UNDECIDED
    } else {
        exit::DONE
    }
}
