//! Mixed complementarity problems in doubles: find z in [l, u] with F_i(z) >= 0 where z_i = l_i,
//! F_i(z) = 0 where z_i lies strictly inside, and F_i(z) <= 0 where z_i = u_i.
//!
//! | module | what |
//! |---|---|
//! | [`mcp`] | problems: a function with its Jacobian, and bounds |
//! | [`solver`] | their solution as PATH does it |
//! | [`linear`] | dense and sparse factorisations |
//!
//! The crate knows nothing of friction, and nothing here is trusted. What a run finds is a
//! candidate; whether it is a solution is decided elsewhere, in exact arithmetic.

pub mod linear;
pub mod mcp;
pub mod solver;
mod tolerance;
