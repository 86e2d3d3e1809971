//! Options of a run, with PATH's names and defaults (Ferris and Munson, the PATH manual; book,
//! 3.5).
//!
//! A limit on steps or pivots bounds what a run costs; none of them makes its result more or less
//! of a solution. Checked by [`Options::validate`] before each run.

use super::error::SolverError;

/// Limits and tolerances of a run. Names are PATH's; so are defaults unless a reason is given.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// A run ends with [`super::Termination::ToleranceReached`] when the normal-map, minimum-map
    /// and Fischer residuals (infinity norm, units of F) are at most this, and the complementarity
    /// products (units of F times z) at most its square root. PATH: 1e-6. Here 1e-10: 1e-6 accepts
    /// points near thresholds where no solution exists, and Newton gives the digits for nothing.
    pub convergence_tolerance: f64,
    /// What comes before the first path. PATH: projected Newton. Here Newton on the
    /// Fischer-Burmeister system and, where that does not converge, projected Newton from its best
    /// point: a solution found so costs a factorisation a step and no pivot.
    pub crash_method: CrashMethod,
    /// Crash steps of each kind before the first path. 0 switches the crash off. PATH: 50.
    pub crash_iteration_limit: usize,
    /// Linearisations in a run, an even share of them for each attempt. PATH: 500.
    pub major_iteration_limit: usize,
    /// Pivots on one path. PATH: 1000.
    pub minor_iteration_limit: usize,
    /// Pivots in a run, an even share of them for each attempt. PATH: 10000.
    pub cumulative_iteration_limit: usize,
    /// Entries of one variable into the basis of a regular start, without a new maximum of t, that
    /// count as a cycle. Ours; the lexicographic rule excludes loops of bases only in exact
    /// arithmetic, and a regular path may be a closed loop. 5 was found no worse than 20, and
    /// cheaper. Unit: entries.
    pub cycle_entry_limit: usize,
    /// Merit values whose maximum is the reference of the non-monotone test. PATH: 10.
    pub nms_memory_size: usize,
    /// Every so many steps one is checked against the reference; 1 checks every step. PATH: 10.
    pub nms_mstep_frequency: usize,
    /// The memory starts at this multiple of the first merit. PATH: 20.
    pub nms_initial_reference_factor: f64,
    /// Returns to the checkpoint in a row before a gradient step is taken instead. PATH: 5.
    pub nms_maximum_watchdogs: usize,
    /// Projected-gradient steps between two restarts. PATH: 5.
    pub gradient_step_limit: usize,
    /// Restarts from the user's point, each with other settings. PATH: 3.
    pub restart_limit: usize,
    /// Are linear problems reduced by what their bounds decide before Lemke's method starts? PATH:
    /// yes. Used by [`super::solve_linear`] only; pivots are reported by the indices of the whole
    /// problem.
    pub preprocess: bool,
    /// How ties of the ratio test are broken. PATH: EXPAND. Here lexicographic, which is finite
    /// from a ray in exact arithmetic.
    pub ratio_test: RatioTest,
    /// Steps along the curve of the Newton homotopy ([`super::continuation`]), which is followed
    /// where the first attempt fails, and of each curve of a search; 0 for none. Ours. Unit: steps.
    pub curve_step_limit: usize,
}

/// What comes before the first path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum CrashMethod {
    /// Nothing: the first path leaves from the start.
    None,
    /// Newton on the guessed active set, projected onto the bounds (Dirkse and Ferris 1997).
    ProjectedNewton,
    /// Newton on the Fischer-Burmeister system within the bounds (De Luca, Facchinei and Kanzow
    /// 1996); if it does not converge, projected Newton from the point it has come to.
    #[default]
    FischerNewton,
}

/// How a path decides between bounds met at nearly the same step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum RatioTest {
    /// The right-hand side is thought perturbed by the first basis times (eps, eps^2, ...): no
    /// basis repeats on a path from a ray (Dantzig, Orden and Wolfe 1955; Cottle, Pang and Stone
    /// 1992, 4.9).
    #[default]
    Lexicographic,
    /// The largest pivot within bounds that widen with every pivot (Gill, Murray, Saunders and
    /// Wright 1989), as PATH has it: better pivots, finite in practice only.
    Expand,
}

impl Options {
    /// The defaults of a search for all solutions: PATH's own crash. What the curves of a search
    /// may cost is counted in such runs; where Newton on the Fischer-Burmeister system makes them
    /// cheap, that buys fewer curves.
    pub fn for_search() -> Self {
        Options {
            crash_method: CrashMethod::ProjectedNewton,
            ..Options::default()
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            convergence_tolerance: 1e-10,
            crash_method: CrashMethod::FischerNewton,
            crash_iteration_limit: 50,
            major_iteration_limit: 500,
            minor_iteration_limit: 1000,
            cumulative_iteration_limit: 10_000,
            cycle_entry_limit: 5,
            nms_memory_size: 10,
            nms_mstep_frequency: 10,
            nms_initial_reference_factor: 20.0,
            nms_maximum_watchdogs: 5,
            gradient_step_limit: 5,
            restart_limit: 3,
            preprocess: true,
            ratio_test: RatioTest::Lexicographic,
            curve_step_limit: 200,
        }
    }
}

impl Options {
    /// Refuses tolerances that are not positive numbers, factors below 1, and limits of zero where
    /// zero would forbid every step. Crash, watchdog, gradient and restart limits may be zero.
    ///
    /// # Errors
    /// [`SolverError::Option`] naming the option, what it must be, and its value.
    pub fn validate(&self) -> Result<(), SolverError> {
        let tolerance = self.convergence_tolerance;
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(SolverError::Option {
                name: "convergence_tolerance",
                expected: "> 0 and finite",
                got: tolerance,
            });
        }

        let factor = self.nms_initial_reference_factor;
        if !(factor >= 1.0 && factor.is_finite()) {
            return Err(SolverError::Option {
                name: "nms_initial_reference_factor",
                expected: ">= 1 and finite",
                got: factor,
            });
        }

        check_positive("major_iteration_limit", self.major_iteration_limit)?;
        check_positive("minor_iteration_limit", self.minor_iteration_limit)?;
        check_positive(
            "cumulative_iteration_limit",
            self.cumulative_iteration_limit,
        )?;
        check_positive("cycle_entry_limit", self.cycle_entry_limit)?;
        check_positive("nms_memory_size", self.nms_memory_size)?;

        check_positive("nms_mstep_frequency", self.nms_mstep_frequency)
    }
}

/// Refuses a count of zero.
fn check_positive(name: &'static str, count: usize) -> Result<(), SolverError> {
    if count > 0 {
        return Ok(());
    }

    Err(SolverError::Option {
        name,
        expected: ">= 1",
        got: 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_keeps_path_s_own_crash() {
        let search = Options::for_search();
        assert_eq!(Options::default().crash_method, CrashMethod::FischerNewton);
        assert_eq!(search.crash_method, CrashMethod::ProjectedNewton);
        assert_eq!(
            Options {
                crash_method: CrashMethod::FischerNewton,
                ..search
            },
            Options::default()
        );
    }

    #[test]
    fn defaults_are_valid_and_refusals_name_the_option() {
        assert_eq!(Options::default().validate(), Ok(()));

        let refused = [
            (
                Options {
                    convergence_tolerance: f64::NAN,
                    ..Options::default()
                },
                "convergence_tolerance",
            ),
            (
                Options {
                    nms_initial_reference_factor: 0.5,
                    ..Options::default()
                },
                "nms_initial_reference_factor",
            ),
            (
                Options {
                    nms_memory_size: 0,
                    ..Options::default()
                },
                "nms_memory_size",
            ),
            (
                Options {
                    minor_iteration_limit: 0,
                    ..Options::default()
                },
                "minor_iteration_limit",
            ),
        ];

        for (options, expected) in refused {
            let refusal = options.validate().unwrap_err();
            let SolverError::Option { name, .. } = refusal else {
                panic!("{refusal}")
            };
            assert_eq!(name, expected);
        }
    }
}
