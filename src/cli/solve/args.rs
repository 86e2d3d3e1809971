//! The arguments of `mceip solve`.

use std::path::PathBuf;

/// Arguments of `solve`.
#[derive(clap::Args)]
pub(in crate::cli) struct Args {
    /// Problem file (mceip-problem/1), or a plain LCP or MCP (mceip-mcp/1).
    #[arg(required_unless_present = "replay")]
    pub(super) file: Option<PathBuf>,
    /// Look for all solutions: also follow curves, from starts and through each solution found, and
    /// search above and below each value found (the zeta windows of section 4).
    #[arg(long)]
    pub(super) all: bool,
    /// State solutions as exact algebraic numbers where that can be had, also on supports of more
    /// than 6 variables, where a box is cheaper.
    #[arg(long)]
    pub(super) exact: bool,
    /// Number of starts on the whole window.
    #[arg(long, default_value_t = 22)]
    pub(super) starts: usize,
    /// Seed of the random starts.
    #[arg(long, default_value_t = 1)]
    pub(super) seed: u64,
    /// Closed window a,b of values instead of the file's (b empty or inf: no upper end; of
    /// eigenvalues a empty or -inf: no lower end).
    #[arg(long, allow_hyphen_values = true)]
    pub(super) window: Option<String>,
    /// Print the linearisations and pivots of the first run.
    #[arg(long)]
    pub(super) log: bool,
    /// Write problem, options, seed and every pivot to this file.
    #[arg(long, value_name = "OUT")]
    pub(super) trace: Option<PathBuf>,
    /// Run a trace again: identical, or the first line that differs.
    #[arg(
        long,
        value_name = "TRACE",
        conflicts_with_all = ["file", "trace", "certificate", "json", "log", "window"]
    )]
    pub(super) replay: Option<PathBuf>,
    /// Of a plain LCP or MCP: check this solution file exactly instead of solving (as `mceip check`
    /// does).
    #[arg(long, value_name = "SOLUTION")]
    pub(super) check: Option<PathBuf>,
    /// Write the certificate of everything found to this file.
    #[arg(long, value_name = "OUT")]
    pub(super) certificate: Option<PathBuf>,
    /// Print mceip-solutions/1.
    #[arg(long)]
    pub(super) json: bool,
}
