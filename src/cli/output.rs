//! Output files that appear whole or not at all, and are known to be writable before the work
//! starts.

use super::common::{CliError, aside, text};
use mceip_check::{Provable, Proved};
use mceip_model::Problem;
use mceip_model::file::write_problem;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

/// A file to be written, whole, as often as there is something new to keep. Regular files are
/// written beside their place, as `.mceip-*.part`, flushed to the disk and renamed; devices and
/// pipes are written through; links are followed.
pub(super) struct Output {
    path: PathBuf,
    is_device: bool,
}

impl Output {
    /// Prepares the output named by `option`; refuses a path that cannot be written, is one of
    /// `inputs` or a matrix that one of them names, or is the output of another option.
    pub(super) fn prepare(
        option: &'static str,
        path: &Path,
        inputs: &[&Path],
    ) -> Result<Output, CliError> {
        let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let is_read = |input: &&Path| {
            is_file_at(input, &target) || matrices_of(input).iter().any(|m| is_file_at(m, &target))
        };
        if inputs.iter().any(is_read) {
            return Err(CliError::OutputIsInput {
                option,
                path: path.display().to_string(),
            });
        }

        if target.is_dir() {
            let is_folder = std::io::ErrorKind::IsADirectory.into();
            return Err(CliError::write(path.display(), &is_folder));
        }

        let is_device = target.exists() && !target.is_file();
        if !is_device {
            reserve(option, &target)?;
            let tried = tempfile::tempfile_in(folder_of(&target));
            tried.map_err(|e| CliError::write(path.display(), &e))?;
        }

        Ok(Output {
            path: target,
            is_device,
        })
    }

    /// Prepares the output if the option is given; see [`Output::prepare`].
    pub(super) fn prepare_if(
        option: &'static str,
        path: Option<&Path>,
        inputs: &[&Path],
    ) -> Result<Option<Output>, CliError> {
        path.map(|path| Output::prepare(option, path, inputs))
            .transpose()
    }

    /// Writes what the checker has accepted, as it was accepted: the first certificate to the path
    /// given, further ones to files beside it, of which stderr says the names.
    pub(super) fn write_proved<C: Provable>(self, proved: &[Proved<C>]) -> Result<(), CliError> {
        let path = self.path.clone();
        let mut output = Some(self);
        for (k, proved) in proved.iter().enumerate() {
            let text = proved.file()?;
            if let Some(first) = output.take() {
                first.write(&text)?;
                continue;
            }

            let beside = numbered(&path, k + 1);
            Output::prepare("certificate", &beside, &[])?.write(&text)?;
            aside(&format!("further claims are in {}", beside.display()));
        }

        Ok(())
    }

    /// Is it a file with this text?
    fn holds(&self, text: &str) -> bool {
        !self.is_device && std::fs::read(&self.path).is_ok_and(|there| there == text.as_bytes())
    }

    /// Removes what is there, if anything is.
    fn remove(&self) -> Result<(), CliError> {
        if self.is_device {
            return Ok(());
        }

        match std::fs::remove_file(&self.path) {
            Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
                Err(CliError::write(self.path.display(), &e))
            }
            _ => Ok(()),
        }
    }

    /// Is it a device or a pipe, which keeps what was written first?
    pub(super) fn is_device(&self) -> bool {
        self.is_device
    }

    /// Writes the text.
    pub(super) fn write(&self, text: &str) -> Result<(), CliError> {
        self.write_bytes(text.as_bytes())
    }

    /// Writes bytes.
    pub(super) fn write_bytes(&self, bytes: &[u8]) -> Result<(), CliError> {
        let written = if self.is_device {
            std::fs::write(&self.path, bytes)
        } else {
            replace(&self.path, bytes)
        };
        written.map_err(|e| CliError::write(self.path.display(), &e))
    }
}

/// The places of the outputs of this run, and the options that they were named by.
static RESERVED: Mutex<BTreeMap<PathBuf, &'static str>> = Mutex::new(BTreeMap::new());

/// Refuses a place that another option has.
fn reserve(option: &'static str, target: &Path) -> Result<(), CliError> {
    let place = match (std::fs::canonicalize(folder_of(target)), target.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => target.to_path_buf(),
    };

    // A thread that panicked with the lock leaves the map whole.
    let mut reserved = RESERVED.lock().unwrap_or_else(PoisonError::into_inner);
    let other = *reserved.entry(place).or_insert(option);
    if other == option {
        return Ok(());
    }

    Err(CliError::OutputTwice {
        option,
        other,
        path: target.display().to_string(),
    })
}

/// The files of the matrices that a problem file names; none of what is no problem file.
fn matrices_of(input: &Path) -> Vec<PathBuf> {
    const FIELD: &str = "matrix_market";
    // A pipe can be read once, by whoever needs it.
    if !(input.is_file() || input == Path::new("-")) {
        return Vec::new();
    }
    let Ok(text) = text("the problem", input) else {
        return Vec::new();
    };
    if !text.contains(FIELD) {
        return Vec::new();
    }

    let mut files = Vec::new();
    let mut waiting: Vec<Value> = serde_json::from_str(&text).into_iter().collect();
    while let Some(value) = waiting.pop() {
        match value {
            Value::Array(values) => waiting.extend(values),
            Value::Object(fields) => {
                for (name, value) in fields {
                    match value {
                        Value::String(file) if name == FIELD => {
                            files.push(folder_of(input).join(file));
                        }
                        value => waiting.push(value),
                    }
                }
            }
            _ => {}
        }
    }

    files
}

/// `claims-2.json` beside `claims.json`.
fn numbered(path: &Path, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = match path.extension() {
        Some(extension) => format!("{stem}-{number}.{}", extension.to_string_lossy()),
        None => format!("{stem}-{number}"),
    };
    path.with_file_name(name)
}

/// Does this path lead to the file at `target`, whose own path is canonical?
fn is_file_at(path: &Path, target: &Path) -> bool {
    std::fs::canonicalize(path).is_ok_and(|canonical| canonical == target)
}

/// The folder that a file is in.
pub(super) fn folder_of(file: &Path) -> &Path {
    let parent = file.parent();
    parent
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// A new file in a folder, with the permissions of any new file. A run that is killed while it
/// writes leaves it behind; its name says whose it is.
fn part_file(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".mceip-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // The system takes the umask off.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }

    builder.tempfile_in(folder)
}

/// Puts a file with these bytes in this place. What has been there stays until the new file is on
/// the disk as a whole.
fn replace(place: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let folder = folder_of(place);
    let mut file = part_file(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(place).map_err(|e| e.error)?;
    flush_names(folder);
    Ok(())
}

/// Flushes the names of the files in a folder to the disk. Where the system cannot do that, the
/// file is in its place all the same.
fn flush_names(folder: &Path) {
    if cfg!(unix)
        && let Ok(opened) = std::fs::File::open(folder)
    {
        let _ = opened.sync_all();
    }
}

/// A folder for files whose names are known only at the end; it exists and can be written to.
pub(super) struct Folder {
    option: &'static str,
    path: PathBuf,
    /// The files that the run reads, which nothing may replace.
    inputs: Vec<PathBuf>,
    /// The first file that was to be kept and could not be written.
    failed: Mutex<Option<CliError>>,
}

impl Folder {
    /// Makes the folder if it is not there; refuses one in which no file can be made.
    pub(super) fn prepare(
        option: &'static str,
        path: &Path,
        inputs: &[&Path],
    ) -> Result<Folder, CliError> {
        make_writable(path)?;
        Ok(Folder {
            option,
            path: path.to_path_buf(),
            inputs: inputs.iter().map(|input| input.to_path_buf()).collect(),
            failed: Mutex::default(),
        })
    }

    /// Prepares the folder if the option is given; see [`Folder::prepare`].
    pub(super) fn prepare_if(
        option: &'static str,
        path: Option<&Path>,
        inputs: &[&Path],
    ) -> Result<Option<Folder>, CliError> {
        path.map(|path| Folder::prepare(option, path, inputs))
            .transpose()
    }

    /// Writes a file, whole.
    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), CliError> {
        self.output(name)?.write_bytes(bytes)
    }

    /// Writes a file that is to be kept while the run goes on. Whether it could be written is told,
    /// and the run asks again at its end ([`Folder::first_failure`]).
    pub(super) fn keep(&self, name: &str, text: &str) -> bool {
        let written = self.write(name, text.as_bytes());
        let is_there = written.is_ok();
        self.note(written);
        is_there
    }

    /// [`Folder::keep_numbered`], with a failure told at the end of the run.
    pub(super) fn keep_only(&self, stem: &str, kept: &[usize]) {
        self.note(self.keep_numbered(stem, kept));
    }

    /// Removes a file of an earlier run that nothing takes the place of.
    pub(super) fn drop_earlier(&self, name: &str) {
        self.note(self.output(name).and_then(|output| output.remove()));
    }

    /// The same for a proof.
    pub(super) fn keep_proof(&self, name: &str, problem: &Problem, certificate: &str) {
        self.note(self.write_proof(name, problem, certificate));
    }

    /// What was made; a failure is told at the end of the run.
    pub(super) fn made<T>(&self, made: Result<T, impl Into<CliError>>) -> Option<T> {
        made.map_err(|e| self.note(Err(e.into()))).ok()
    }

    fn note(&self, written: Result<(), CliError>) {
        if let Err(e) = written {
            let mut failed = self.failed.lock().unwrap_or_else(PoisonError::into_inner);
            failed.get_or_insert(e);
        }
    }

    /// The first file that was to be kept and could not be written.
    pub(super) fn first_failure(self) -> Result<(), CliError> {
        let failed = self.failed.into_inner();
        failed
            .unwrap_or_else(PoisonError::into_inner)
            .map_or(Ok(()), Err)
    }

    fn output(&self, name: &str) -> Result<Output, CliError> {
        let inputs: Vec<&Path> = self.inputs.iter().map(PathBuf::as_path).collect();
        Output::prepare(self.option, &self.path.join(name), &inputs)
    }

    /// Writes a proof as NAME.problem.json and NAME.certificate.json, the problem first. A
    /// certificate of an earlier run goes before its problem is replaced: a run that is killed
    /// between the two leaves no pair that does not belong together.
    pub(super) fn write_proof(
        &self,
        name: &str,
        problem: &Problem,
        certificate: &str,
    ) -> Result<(), CliError> {
        let [problem_file, certificate_file] = proof_files(name);
        let problem_output = self.output(&problem_file)?;
        let certificate_output = self.output(&certificate_file)?;

        let text = write_problem(problem);
        if !problem_output.holds(&text) {
            certificate_output.remove()?;
            problem_output.write(&text)?;
        }
        certificate_output.write(certificate)
    }

    /// Where the certificate of a proof is.
    pub(super) fn certificate_path(&self, name: &str) -> PathBuf {
        let [_, certificate] = proof_files(name);
        self.path.join(certificate)
    }

    /// Removes a proof that another one has taken the place of. One that stays is a proof all the
    /// same.
    pub(super) fn remove_proof(&self, name: &str) {
        for file in proof_files(name) {
            let _ = std::fs::remove_file(self.path.join(file));
        }
    }

    /// Removes the files `stem-NUMBER.json`, and of a proof both with its equilibrium, but for
    /// these numbers: those of an earlier run.
    pub(super) fn keep_numbered(&self, stem: &str, kept: &[usize]) -> Result<(), CliError> {
        let failed = |error: &std::io::Error| CliError::write(self.path.display(), error);
        for entry in std::fs::read_dir(&self.path).map_err(|e| failed(&e))? {
            let entry = entry.map_err(|e| failed(&e))?;
            let name = entry.file_name();
            let name = name.to_str().unwrap_or_default();
            let numbered = name.strip_prefix(stem).and_then(|n| n.strip_prefix('-'));
            let number = numbered.and_then(|n| n.strip_suffix(".json"));
            let number = number.map(|n| {
                let mut kinds = [".problem", ".certificate", ".equilibrium"].iter();
                kinds.find_map(|kind| n.strip_suffix(kind)).unwrap_or(n)
            });
            let number = number.and_then(|n| n.parse::<usize>().ok());
            let is_input = |input: &PathBuf| is_file_at(input, &entry.path());
            let is_earlier = number.is_some_and(|number| !kept.contains(&number));
            if is_earlier && !self.inputs.iter().any(is_input) {
                std::fs::remove_file(entry.path()).map_err(|e| failed(&e))?;
            }
        }

        Ok(())
    }
}

/// The files of a proof: its problem, its certificate.
fn proof_files(name: &str) -> [String; 2] {
    ["problem", "certificate"].map(|kind| format!("{name}.{kind}.json"))
}

/// Makes the folder if it is not there.
pub(super) fn make(folder: &Path) -> Result<(), CliError> {
    std::fs::create_dir_all(folder).map_err(|e| CliError::write(folder.display(), &e))
}

/// Makes the folder if it is not there, and tries whether a file can be made in it.
pub(super) fn make_writable(folder: &Path) -> Result<(), CliError> {
    make(folder)?;
    tempfile::tempfile_in(folder).map_err(|e| CliError::write(folder.display(), &e))?;
    Ok(())
}
