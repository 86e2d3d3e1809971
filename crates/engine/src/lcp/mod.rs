//! Plain linear MCPs and LCPs in exact numbers, apart from friction: file, solution, exact check.
//!
//! The problem is F(z) = M z + q on [l, u]; an LCP has l = 0 and no upper bounds. `exact` holds the
//! problem, `file` reads `mceip-mcp/1`, `search` runs the solver, `certify` turns a solver's point
//! into an exact one, `check` decides (it multiplies and compares, nothing else), and `verdict`
//! applies it to a file.

mod certify;
mod check;
mod exact;
mod file;
mod search;
mod verdict;

pub use certify::{Uncertifiable, certify};
pub use check::{NUMBER_BITS, POINT_BITS, Violated, check};
pub use exact::{ExactMcp, ExactMcpError};
pub use file::{
    FileError, MCP_FORMAT, McpCertificate, SOLUTION_FORMAT, read_mcp, read_solution, write_mcp,
    write_solution,
};
pub use search::{PlainFound, PlainSearch, search};
pub use verdict::{McpRejected, judge};
