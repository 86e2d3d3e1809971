//! `mceip analyze`: the engineer's answer for a mechanical system at one mu.
//!
//! The answers are sentences with their evidence: can the equilibrium diverge in the form (8) at
//! this mu, in which ranges of mu can it, from which mu on. They are printed, one paragraph that
//! sums them up first, and on request
//! written as a page with the modes; their certificates go into a folder for `mceip check`.

mod page;

use super::common::{
    CliError, aside, exit, number, print_answer, require_count, require_threads, shell_word,
};
use super::job::{CHECKPOINT, Job};
use super::output::{Folder, Output, folder_of};
use super::pictures::{self, PictureArgs};
use super::question::load_system;
use crate::Analyze;
use crate::say::{number_text, warnings_text};
use mceip_engine::analysis::{
    Analysis, AnalysisError, AnalysisOptions, Evidence, MAX_SAMPLES, ProofCertificate, ProofFile,
    Verdict,
};
use mceip_engine::lean::LeanError;
use mceip_engine::run::{Kept, Watch, in_threads};
use mceip_engine::tolerance::WIDE_CRITICAL_GAP;
use mceip_exact::Rational;
use mceip_model::file::SystemFile;
use mceip_model::{System, Window, sha256};
use num_traits::Signed;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

/// Arguments of `analyze`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Problem file (mceip-problem/1) of a mechanical system; `mceip convert` makes one.
    file: PathBuf,
    /// Coefficient of friction instead of the file's (reactions in the file are then not used).
    #[arg(long, value_name = "MU", alias = "mu", allow_hyphen_values = true)]
    friction: Option<String>,
    /// Values of mu at which divergence is decided to find its ranges, evenly spread from the
    /// critical mu to twice the largest of it, the static thresholds and the mu asked for; 0 for
    /// none (the default beyond 200 free degrees of freedom).
    #[arg(long, value_name = "N")]
    samples: Option<usize>,
    /// Boxes that may be examined, in each piece of [0, infinity), to bound the critical mu from
    /// below, and to prove absence on a range of mu above it.
    #[arg(long, default_value_t = AnalysisOptions::default().limits.boxes)]
    boxes: usize,
    /// Write every certificate and its problem into this folder, for `mceip check`, each as soon as
    /// it is accepted.
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Leave the matrices out of the certificates that `check` can make anew (mceip-lean/1): those
    /// of large bodies are much shorter.
    #[arg(long, requires = "certificates")]
    lean: bool,
    /// Write the answers with their evidence and the modes as one HTML page that needs no network;
    /// with pictures of the body where the problem file has coordinates.
    #[arg(long, value_name = "OUT")]
    report: Option<PathBuf>,
    #[command(flatten)]
    pictures: PictureArgs,
    /// Threads (default: all cores). The answer does not depend on it.
    #[arg(long)]
    threads: Option<usize>,
    /// Print mceip-analysis/1.
    #[arg(long)]
    json: bool,
}

/// More boxes than any machine has room for.
const MAX_BOXES: u64 = 1_000_000_000;

/// Free degrees of freedom beyond which the ranges of mu are looked for on request only.
const SAMPLED_FREE: usize = 200;

/// Analyses the system, writes the proofs and prints the answers.
pub(super) fn run(args: &Args) -> Result<u8, CliError> {
    let Some(file) = load_system(&args.file)? else {
        return Err(AnalysisError::NotASystem.into());
    };
    let system = &file.system;
    if file.window != Window::all() {
        aside(&format!(
            "mceip: the window {} of the file is not used: all values are looked at",
            file.window
        ));
    }
    let friction = friction(args, &file)?;
    require_threads(args.threads)?;
    require_count("boxes", args.boxes as u64, 0..=MAX_BOXES)?;
    let samples = samples(args, system)?;

    let keeping = match &args.certificates {
        Some(folder) => Some(Proofs::prepare(folder, args)?),
        None => None,
    };
    let report = Output::prepare_if("report", args.report.as_deref(), &[&args.file])?;
    let pictures = args
        .pictures
        .prepare(&args.file, file.coordinates.is_some())?;
    if let (Some(report), Some(folder)) = (&args.report, &args.certificates) {
        refuse_among_proofs(report, folder)?;
    }

    let job = Job::begin("reading");
    let question = Analyze::from(&file).friction(friction).samples(samples);
    let question = question.boxes(args.boxes).cancel(job.cancel());
    let mut question = question.on_progress(|progress| job.say(progress));
    if let Some(threads) = args.threads {
        question = question.threads(threads);
    }
    if let Some(proofs) = &keeping {
        question = question.keep(CHECKPOINT, |kept| {
            if let Err(e) = job.watched(|watch| proofs.keep(kept, watch)) {
                job.note(&format!("mceip: {e}; it is written again at the end"));
            }
        });
    }
    let analysis = question.run()?;
    // What cannot be written takes nothing else along.
    let written = keeping.map(|proofs| job.watched(|watch| proofs.write_all(&analysis, watch)));
    let is_drawn = report.is_some() || pictures.are_wanted();
    let branches = if is_drawn {
        let chart = job.watched(|watch| page::branches(&analysis, system, watch));
        pictures::drawn(chart, &job)
    } else {
        None
    };
    let are_named = args.json || report.is_some();
    let files = match written {
        Some(files) => files,
        None if are_named => analysis.unwritten_files().map_err(CliError::from),
        None => Ok(Vec::new()),
    };
    job.end();
    let (files, written) = match files {
        Ok(files) => (files, Ok(())),
        Err(e) => (Vec::new(), Err(e)),
    };
    let drawn = page::Drawn {
        system,
        coordinates: file.coordinates.as_ref(),
        branches,
        files: &files,
        date: SystemTime::now(),
    };
    let page = report.map_or(Ok(()), |output| {
        output.write(&page::page(&analysis, &drawn))
    });
    let pictures = if pictures.are_wanted() {
        let written = pictures.write(&drawn.pictures(&analysis));
        pictures.tell_no_body();
        written
    } else {
        Ok(())
    };

    print_answer(
        args.json,
        || analysis.to_json(&files),
        || text_of(&analysis, &files, args),
    )?;
    written.and(page).and(pictures)?;

    Ok(exit_code(&analysis))
}

/// The coefficient of friction: the option's, or else the file's.
fn friction(args: &Args, file: &SystemFile) -> Result<Rational, CliError> {
    if let Some(given) = &args.friction {
        let mu = number("friction", given)?;
        if mu.is_negative() {
            return Err(CliError::option("friction", "a number >= 0", given));
        }
        return Ok(mu);
    }

    let own = file.friction.clone();
    own.ok_or_else(|| AnalysisError::NoFriction.into())
}

/// Refuses a report in the place of a problem or certificate that the analysis may write.
fn refuse_among_proofs(report: &Path, folder: &Path) -> Result<(), CliError> {
    let place = |path: &Path| std::fs::canonicalize(path).ok();
    let is_inside = place(folder_of(report)) == place(folder);
    let name = report.to_string_lossy();
    let is_named_alike = name.ends_with(".certificate.json") || name.ends_with(".problem.json");
    if !(is_inside && is_named_alike) {
        return Ok(());
    }

    let expected = "another file than those of --certificates";
    Err(CliError::option("report", expected, &name))
}

/// The number of values of mu at which divergence is decided.
fn samples(args: &Args, system: &System) -> Result<usize, CliError> {
    let is_large = system.free_dofs().len() > SAMPLED_FREE;
    let usual = if is_large {
        0
    } else {
        AnalysisOptions::default().samples
    };

    let samples = args.samples.unwrap_or(usual);
    require_count("samples", samples as u64, 0..=MAX_SAMPLES as u64)?;
    Ok(samples)
}

fn exit_code(analysis: &Analysis) -> u8 {
    if analysis.interrupted {
        exit::INTERRUPTED
    } else if analysis.is_decided() {
        exit::DONE
    } else {
        exit::UNDECIDED
    }
}

/// The folder of the certificates. Each one is written as soon as it is accepted, and what a long
/// search has proved every minute.
struct Proofs {
    folder: Folder,
    /// Are they written without what can be made anew?
    is_lean: bool,
    threads: Option<usize>,
    /// The proofs written so far, by name.
    written: Mutex<BTreeMap<String, WrittenProof>>,
}

impl Proofs {
    /// Makes the folder if it is not there; refuses one in which no file can be made.
    fn prepare(folder: &Path, args: &Args) -> Result<Proofs, CliError> {
        Ok(Proofs {
            folder: Folder::prepare("certificates", folder, &[&args.file])?,
            is_lean: args.lean,
            threads: args.threads,
            written: Mutex::default(),
        })
    }

    /// Writes a proof during the run and remembers its digest.
    fn keep(&self, kept: &Kept<'_>, watch: &Watch<'_>) -> Result<(), CliError> {
        let written = WrittenProof {
            certificate: kept.certificate.clone(),
            sha256: self.write(kept, watch)?,
        };
        self.written().insert(kept.name.to_owned(), written);
        Ok(())
    }

    /// Writes a proof; in full where an interrupt leaves no time for its lean form. The SHA-256 of
    /// the certificate's file.
    fn write(&self, kept: &Kept<'_>, watch: &Watch<'_>) -> Result<String, CliError> {
        let lean = if self.is_lean {
            let made = in_threads(self.threads, || {
                kept.certificate.lean_file(kept.problem, watch)
            });
            match made {
                Err(LeanError::Interrupted) => None,
                shortened => shortened?,
            }
        } else {
            None
        };

        let text = match lean {
            Some(lean) => lean,
            None => kept.certificate.file()?,
        };
        self.folder.write_proof(kept.name, kept.problem, &text)?;
        Ok(sha256(&text))
    }

    /// Writes all proofs of the analysis, and removes those that others have taken the place of;
    /// the certificates' files.
    fn write_all(
        &self,
        analysis: &Analysis,
        watch: &Watch<'_>,
    ) -> Result<Vec<ProofFile>, CliError> {
        let mut superseded = std::mem::take(&mut *self.written());
        let mut files = Vec::new();
        for proof in &analysis.proofs {
            let written = superseded.remove(&proof.name);
            let written = written.filter(|w| w.certificate.is_clone_of(&proof.certificate));
            let sha256 = match written {
                Some(written) => written.sha256,
                None => self.write(
                    &Kept {
                        name: &proof.name,
                        problem: &proof.problem,
                        certificate: &proof.certificate,
                    },
                    watch,
                )?,
            };
            let path = self.folder.certificate_path(&proof.name);
            files.push(ProofFile {
                sha256,
                path: Some(path.display().to_string()),
            });
        }

        for name in superseded.into_keys() {
            self.folder.remove_proof(&name);
        }

        Ok(files)
    }

    /// A thread that panicked with the lock leaves the set whole.
    fn written(&self) -> MutexGuard<'_, BTreeMap<String, WrittenProof>> {
        self.written.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A proof that is in the folder.
struct WrittenProof {
    certificate: ProofCertificate,
    /// Of the certificate's file.
    sha256: String,
}

/// What to run next.
fn next_step(analysis: &Analysis, files: &[ProofFile], args: &Args) -> String {
    let file = shell_word(&args.file);
    if analysis.interrupted {
        return "Next: run it again, it was interrupted.".into();
    }

    if analysis
        .critical_gap()
        .is_some_and(|gap| gap > WIDE_CRITICAL_GAP)
    {
        let boxes = args.boxes.saturating_mul(10);
        return format!("Next: `mceip analyze {file} --boxes {boxes}` may narrow that.");
    }

    if analysis.proofs.is_empty() {
        return "The theorem and its proof: spec/zero-reaction.md, Z.2.".into();
    }

    // Of a growing motion its own certificate, else that of the critical mu.
    let [at_mu, below] = [&analysis.divergence.evidence, &analysis.critical.evidence];
    let proof = match (analysis.divergence.verdict, at_mu, below) {
        (Verdict::Present, Evidence::Certificate(proof), _) => *proof,
        (_, _, Evidence::Certificate(proof)) => *proof,
        (_, Evidence::Certificate(proof), _) => *proof,
        _ => 0,
    };
    match files.get(proof).and_then(|file| file.path.as_ref()) {
        Some(certificate) => {
            let problem = certificate.replace(".certificate.json", ".problem.json");
            let [problem, certificate] =
                [&problem, certificate].map(|path| shell_word(Path::new(path)));
            format!("Next: `mceip check {problem} {certificate}`.")
        }
        None => format!(
            "Next: `mceip analyze {file} --friction {} --certificates proofs` writes the \
             certificates, for `mceip check`.",
            number_text(&analysis.friction)
        ),
    }
}

/// The answers for people, in one paragraph and then each with its evidence; `files` of the
/// certificates as they were written.
fn text_of(analysis: &Analysis, files: &[ProofFile], args: &Args) -> String {
    let [dofs, free, slip, stick] = analysis.sizes;
    let mut out = String::new();
    if let Some(name) = &analysis.name {
        out += &format!("{name}: ");
    }

    out += &format!(
        "{dofs} degrees of freedom ({free} free), {slip} in impending slip, {stick} stick{}\n",
        match analysis.zero {
            0 => String::new(),
            zero => format!(", {zero} with zero reaction"),
        }
    );

    out += &warnings_text(&analysis.warnings);

    let next = next_step(analysis, files, args);
    out += &format!("\n{} {next}\n\n", analysis.summary());

    for sentence in analysis.sentences() {
        let evidence = analysis.evidence_text(&sentence.evidence, files);
        out += &format!("{}\n    [{evidence}]\n", sentence.text);
    }

    if analysis.interrupted {
        out += "INTERRUPTED: what was not done is undecided\n";
    }

    out
}
