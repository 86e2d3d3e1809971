//! Output files that appear whole or not at all, and are known to be writable before the work
//! starts.

use super::common::CliError;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// A file to be written at the end. Regular files are written beside their place and renamed;
/// devices and pipes are written through; links are followed.
pub(super) struct Output {
    path: PathBuf,
    /// `None` for what is no regular file.
    beside: Option<tempfile::NamedTempFile>,
}

impl Output {
    /// Prepares the output named by `option`; refuses a path that cannot be written or is one of
    /// `inputs`.
    pub(super) fn prepare(
        option: &'static str,
        path: &Path,
        inputs: &[&Path],
    ) -> Result<Output, CliError> {
        let failed = |e: std::io::Error| CliError::write(path.display(), &e);
        let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        if inputs
            .iter()
            .any(|i| std::fs::canonicalize(i).is_ok_and(|i| i == target))
        {
            return Err(CliError::OutputIsInput {
                option,
                path: path.display().to_string(),
            });
        }
        if target.is_dir() {
            return Err(failed(std::io::ErrorKind::IsADirectory.into()));
        }
        if target.exists() && !target.is_file() {
            return Ok(Output {
                path: target,
                beside: None,
            });
        }
        let folder = target
            .parent()
            .filter(|p| !p.as_os_str().is_empty())
            .unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            // Less the umask, as any new file.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let beside = builder.tempfile_in(folder).map_err(failed)?;
        Ok(Output {
            path: target,
            beside: Some(beside),
        })
    }

    /// Writes the text.
    pub(super) fn write(self, text: &str) -> Result<(), CliError> {
        self.write_bytes(text.as_bytes())
    }

    /// Writes bytes.
    pub(super) fn write_bytes(self, bytes: &[u8]) -> Result<(), CliError> {
        let failed = |e: std::io::Error| CliError::write(self.path.display(), &e);
        match self.beside {
            None => std::fs::write(&self.path, bytes).map_err(failed),
            Some(mut file) => {
                file.write_all(bytes).map_err(failed)?;
                file.persist(&self.path).map_err(|e| failed(e.error))?;
                Ok(())
            }
        }
    }
}

/// A folder for files whose names are known only at the end; it exists and can be written to.
pub(super) struct Folder {
    option: &'static str,
    path: PathBuf,
}

impl Folder {
    /// Makes the folder if it is not there; refuses one in which no file can be made.
    pub(super) fn prepare(option: &'static str, path: &Path) -> Result<Folder, CliError> {
        let failed = |e: std::io::Error| CliError::write(path.display(), &e);
        std::fs::create_dir_all(path).map_err(failed)?;
        tempfile::tempfile_in(path).map_err(failed)?;
        Ok(Folder {
            option,
            path: path.to_path_buf(),
        })
    }

    /// Writes a file, whole.
    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), CliError> {
        Output::prepare(self.option, &self.path.join(name), &[])?.write_bytes(bytes)
    }
}
