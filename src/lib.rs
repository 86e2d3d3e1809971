//! Complementarity eigenproblems of elastic systems in frictional contact, verified exactly.
//!
//! Find t >= 0 and x != 0 with (A + tB) x = y, y_f = 0, 0 <= x_s _|_ y_s >= 0, where t is lambda^2
//! (12)-(14) or mu (21)-(23) of Pinto da Costa, Figueiredo, Júdice and Martins, *A complementarity
//! eigenproblem in the stability analysis of finite dimensional elastic systems with frictional
//! contact*. A solution means that the equilibrium can diverge in the form (8).
//!
//! ```text
//! problem -> reduction -> MCP -> solver -> candidates          untrusted, f64
//!    |           |                            | certify        untrusted
//!    |           v                            v
//!    |        oracle (exact enumeration)   certificate
//!    +---------------------------------------> check -> accepted / rejected(reason)   trusted, exact
//! ```
//!
//! Floats propose, exact arithmetic decides. The rooms, in the order of the data: [`exact`]
//! numbers, [`model`] problems and files, [`source`] examples, [`reduction`] (10)-(16) and
//! Propositions 1 and 2, [`oracle`] the slow truth, `mcp`, `solver` and `sparse` the PATH-style
//! solver, `certify` and [`certificate`], [`check`] the verdict, `analysis` the engineer's answer,
//! `testkit` what compares them all. The crates of `crates/` are re-exported under the names of
//! their rooms.
//!
//! ```
//! use mceip::{
//!     exact::{Sparse, whole},
//!     model::{Pencil, Window},
//!     oracle::enumerate,
//! };
//! // The fold of spec/errata.md: lambda^2 = 2 and 3, both particles slipping.
//! let a = Sparse::from_entries(
//!     2,
//!     2,
//!     [
//!         (0, 0, whole(1)),
//!         (0, 1, whole(-6)),
//!         (1, 0, whole(2)),
//!         (1, 1, whole(-6)),
//!     ],
//! );
//! let found = enumerate(
//!     &Pencil::new(a, Sparse::identity(2), vec![]).unwrap(),
//!     &Window::all(),
//! )
//! .unwrap();
//! assert_eq!(
//!     found
//!         .solutions
//!         .iter()
//!         .map(|s| s.decimal(17))
//!         .collect::<Vec<_>>(),
//!     ["2", "3"]
//! );
//! assert!(found.is_complete_list());
//! ```

pub use mceip_check as check;
pub use mceip_check::certificate;
#[cfg(feature = "solver")]
pub use mceip_engine::{
    analysis, candidate, certify, foreign, lcp, multistart, reduction, report, run, search,
    tolerance,
};
pub use mceip_exact as exact;
#[cfg(feature = "solver")]
pub use mceip_mcp::{linear, mcp, solver, sparse};
pub use mceip_model as model;
#[cfg(not(feature = "solver"))]
pub use mceip_model::reduction;
pub use mceip_oracle as oracle;
#[cfg(feature = "solver")]
pub use mceip_paper as source;
#[cfg(feature = "testkit")]
pub use mceip_testkit as testkit;
#[cfg(feature = "testkit")]
pub use mceip_testkit::conform;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "picture")]
pub mod picture;
