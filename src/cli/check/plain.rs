//! `mceip check` on a plain LCP or MCP: every point of a solution file, exactly.

use super::super::common::{CliError, exit, print, text};
use mceip_engine::lcp::{FileError, judge, read_mcp, read_solution};
use std::path::Path;

/// The verdict on the solution file `certificate` of the plain problem `source`, read from `path`.
pub(in super::super) fn verdict(
    path: &Path,
    source: &str,
    certificate: &Path,
) -> Result<u8, CliError> {
    let named = |path: &Path, source: FileError| CliError::Plain {
        path: path.display().to_string(),
        source,
    };
    let problem = read_mcp(source).map_err(|e| named(path, e))?;
    let claimed =
        read_solution(&text("the certificate", certificate)?).map_err(|e| named(certificate, e))?;
    match judge(&problem, &claimed) {
        Ok(count) => {
            print(&format!(
                "ACCEPTED: {count} solution(s) of problem {}\n",
                problem.sha256()
            ))?;
            Ok(exit::DONE)
        }
        Err(rejected) => {
            print(&format!("REJECTED: {rejected}\n"))?;
            Ok(exit::REJECTED)
        }
    }
}
