//! Complementarity eigenproblems of elastic systems in frictional contact, verified exactly.
//!
//! Find t >= 0 and x != 0 with
//!
//! ```text
//! (A + tB) x = y,   y_f = 0,   0 <= x_s _|_ y_s >= 0
//! ```
//!
//! where t is lambda^2, (12)-(14), or mu, (21)-(23), of Pinto da Costa, Figueiredo, Júdice and
//! Martins, *A complementarity eigenproblem in the stability analysis of finite dimensional elastic
//! systems with frictional contact*. A solution means that the equilibrium can diverge in the form
//! (8): it is unstable.
//!
//! # First program
//!
//! ```
//! # #[cfg(not(feature = "solver"))]
//! # fn main() {}
//! use mceip::{Problem, check};
//!
//! # #[cfg(feature = "solver")]
//! fn main() -> Result<(), mceip::Error> {
//!     let problem = Problem::read("spec/examples/fold.json")?;
//!     let found = problem.solve().run()?; // the PATH-style solver, every solution certified
//!     let all = problem.complete().run()?; // all solutions, and a proof that there are no others
//!     check(&problem, all.certificate())?; // what anybody else would run
//!     println!("{} found, {} in all", found.solutions.len(), all.solutions().len());
//!     Ok(())
//! }
//! ```
//!
//! | you want to | call |
//! |---|---|
//! | make a problem | [`Problem::read`], [`Problem::from_matrices`], [`Problem::from_pencil`] |
//! | find solutions | [`Problem::solve`] |
//! | find all solutions, or prove that there are none | [`Problem::complete`] |
//! | list all solutions of a small problem by plain enumeration | [`Problem::enumerate`] |
//! | know whether an equilibrium can diverge, and from which friction on | [`Problem::analyze`] |
//! | find the contact states that loads lead to | [`Loads::path`] |
//! | prove a solution that you have computed | [`Problem::certify`] |
//! | check a certificate | [`check`](check()) |
//!
//! # What to trust
//!
//! Floating-point numbers propose, exact arithmetic decides. Every solution that these functions
//! return has been accepted by the checker, the crate [`mceip_check`], and so has every
//! certificate. Whoever only checks certificates depends on that crate alone.
//!
//! ```text
//! problem -> reduction -> MCP -> solver -> candidates          untrusted, f64
//!    |           |                            | certify        untrusted
//!    |           v                            v
//!    |        oracle (exact enumeration)   certificate
//!    +---------------------------------------> check -> accepted / rejected   trusted, exact
//! ```
//!
//! The parts are crates: `mceip_exact` numbers, `mceip_model` problems and files, `mceip_check`,
//! `mceip_oracle` the plain enumerator, `mceip_mcp` the solver, `mceip_engine` searches,
//! `mceip_path` equilibria along a loading path, `mceip_paper` the paper's examples,
//! `mceip_testkit` what compares them all. Whoever needs their insides uses them directly.

// `println!` and `eprintln!` panic where nothing can be written: `cli::common` prints.
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod front;
#[cfg(feature = "solver")]
mod say;

pub use front::*;
pub use mceip_check::certificate::Certificate;
pub use mceip_check::{
    Accepted, AcceptedClaim, OpenRegion, Proved, Reason, Rejected, SolutionFamily,
};
#[cfg(feature = "solver")]
pub use mceip_engine::analysis::{self, Analysis};
#[cfg(feature = "solver")]
pub use mceip_engine::lean::LEAN_FORMAT;
#[cfg(feature = "solver")]
pub use mceip_engine::multistart::Uncertified;
#[cfg(feature = "solver")]
pub use mceip_engine::run::{Cancel, Kept, Progress};
pub use mceip_exact::{Interval, Rational};
pub use mceip_model::{
    ContactState, Curvature, ModelError, Particle, Reaction, RealWindow, Unknown, Window,
};

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "picture")]
#[doc(hidden)]
pub mod picture;
