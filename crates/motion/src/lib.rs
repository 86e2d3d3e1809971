//! The motion about an equilibrium: (1)-(4) integrated in time, in doubles.
//!
//! ```text
//! M z'' + K z = rho,   z = u - u^0,   rho = r - r^0                                 // (3), (5)
//! ```
//!
//! with the contact conditions (1), (2), (4) as they read as long as no contact leaves its state's
//! range: particles out of contact stay so (rho = 0), d particles stick (z = 0), and an s particle
//! keeps r_N < 0 (z_N = 0) and the sign S of r_T, so that Coulomb's law (2) is
//!
//! ```text
//! S z_T' <= 0,   S rho_T + mu rho_N <= 0,   (S rho_T + mu rho_N) (S z_T') = 0.
//! ```
//!
//! Unlike (9) this is about the *velocity*: a particle that has slipped may come to rest and stick
//! where it is. Within the range nothing is neglected: K and M are constant, and the law above is
//! (2). The conditions are homogeneous, so the range bounds the amplitude only
//! ([`AmplitudeRange`]).
//!
//! Input: a system with M and mu. The crate uses no reduction, solver or search of this project: it
//! is there to hold their answers against the motion itself. Nothing here is proved.
//!
//! | file | what |
//! |---|---|
//! | `equations` | the equations in the motions that the contact admits |
//! | `uniqueness` | has the problem of one step one solution? |
//! | `step` | one step of Moreau and Jean |
//! | `trajectory` | a run: samples, its class, the range of its amplitude |
//! | `growth` | a run along a mode, held against u^0 + alpha(t) v |

mod equations;
mod growth;
mod step;
mod tolerance;
mod trajectory;
mod uniqueness;

pub use equations::{Equations, MotionError};
pub use growth::{Growth, GrowthAgreement, GrowthMode, GrowthPoint, along_mode};
pub use step::{Instant, Stepper};
pub use trajectory::{
    AfterImpulse, AmplitudeRange, Limit, MotionClass, Plan, Trajectory, TrajectorySample, impulse,
    run,
};
pub use uniqueness::StepSolutions;

#[cfg(test)]
mod tests;
