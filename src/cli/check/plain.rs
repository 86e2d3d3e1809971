//! `mceip check` on a plain LCP or MCP: every point of a solution file, exactly.

use super::super::common::{CliError, exit, print, text};
use super::super::job::decided;
use mceip_engine::lcp::{judge, read_mcp, read_solution};
use mceip_engine::report::counted;
use std::path::Path;

/// The verdict on the solution file `certificate` of the plain problem `source`, read from `path`.
pub(in super::super) fn verdict(
    path: &Path,
    source: &str,
    certificate: &Path,
) -> Result<u8, CliError> {
    let problem = read_mcp(source).map_err(|e| CliError::other_file(path, e))?;
    let claimed = text("the certificate", certificate)?;
    let claimed = read_solution(&claimed).map_err(|e| CliError::other_file(certificate, e))?;

    match decided(|| judge(&problem, &claimed)) {
        Ok(count) => {
            let digest = problem.sha256();
            let solutions = counted(count, "solution");
            print(&format!("ACCEPTED: {solutions} of problem {digest}\n"))?;
            Ok(exit::DONE)
        }
        Err(rejected) => {
            print(&format!("REJECTED: {rejected}\n"))?;
            Ok(exit::REJECTED)
        }
    }
}
