//! Mixed complementarity problems in doubles: find z in [l, u] with F_i(z) >= 0 where z_i = l_i, = 0 strictly inside and
//! <= 0 where z_i = u_i.
//!
//! [`mcp`] states problems, [`solver`] solves them as PATH does, [`sparse`] eliminates the unknowns without bounds first,
//! [`linear`] holds the factorisations. The crate knows nothing of friction, and nothing here is trusted: what a run finds
//! is a candidate, and whether it is a solution is decided elsewhere, exactly.

pub mod linear;
pub mod mcp;
pub mod solver;
pub mod sparse;
mod tolerance;
