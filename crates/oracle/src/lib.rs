//! The slow truth: the enumerator of (24)-(26) and Table 1 in closed form. Exact, naive on purpose.
//!
//! The problem: given square rational matrices A and B and a set f of free variables, find all
//! t >= 0 in a window and all x != 0 with
//!
//! ```text
//! y = (A + tB) x,    y_f = 0,    0 <= x_s _|_ y_s >= 0,
//! ```
//!
//! where s are the other variables, the complementarity variables ((12)-(14) with t = lambda^2,
//! (21)-(23) with t = mu). [`enumerate`] goes through all supports, that is, through all sets of
//! positive x_s.
//!
//! What is listed where:
//! * [`Enumeration::solutions`]: every solution that is the only one (up to its positive factor)
//!   with its value and support; a kernel of dimension 1 always gives such a one. Biactive indices
//!   make no second entry. Free-only x and -x are two entries.
//! * [`Enumeration::cones`]: where one support has more than one solution at a value, the largest
//!   cone they belong to, by its extreme rays. A ray that stands alone on its own support is listed
//!   in `solutions` too: cones describe sets by generators, `solutions` counts rays.
//! * [`Enumeration::ranges`]: supports whose pencil is singular, with the intervals of values at
//!   which they have a solution. What they have at isolated values only is in the two lists above.
//!
//! Every solution in the window is in at least one of the three ([`Enumeration::contains`]).
//!
//! To read: `plain` (the algorithm), `integer_pencil` (its linear algebra), `solution` and
//! `enumeration` (its answer); then, for what is not a list, `degenerate`, `describe`, `cone` and
//! `range`. `member` and `table1` stand alone. `modes` enumerates the split form of systems with
//! particles in contact with zero reaction, `physical` the conditions (9) themselves.
#![deny(clippy::float_arithmetic)]

mod cone;
mod degenerate;
mod describe;
mod enumeration;
mod integer_pencil;
mod member;
mod modes;
mod physical;
mod plain;
mod range;
mod solution;
mod table1;

pub use degenerate::{Cone, End, SupportRange, Undescribed, ValueInterval, constants};
pub use enumeration::{Enumeration, WideKernel};
pub use integer_pencil::IntegerPencil;
pub use member::{GivenPencil, is_rational_solution, is_solution};
pub use modes::{DegenerateChoice, ModeList, enumerate_modes, enumerate_modes_with};
pub use physical::{
    DegenerateModes, Motion, Motions, ParticleMode, PhysicalParticle, PhysicalState,
    PhysicalSystem, enumerate_motions,
};
pub use plain::{
    MAX_BITS, MAX_FREE, MAX_SLIP, OracleError, coefficient_bits, enumerate, enumerate_with,
    examine_support,
};
pub use range::MAX_MINORS;
pub use solution::{Solution, is_between};
pub use table1::{ClosedSolution, TwoParticles, table1, thresholds};
