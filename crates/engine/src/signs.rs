//! The values of both signs of an eigenvalue problem: the problem itself has those that are not
//! negative, its reflection the others with their sign changed.
//!
//! A value in doubles tells on which side a solution lies, but for those next to 0: rounding can
//! change their sign, so that they are looked for on both sides. Called where points in doubles are
//! certified or judged.

use crate::candidate::Candidate;
use mceip_model::reduction::reduce;
use mceip_model::{ModelError, Problem, Reduced};

/// A problem, and its reduction.
#[derive(Debug, Clone)]
pub struct OfSign {
    /// The problem, or its reflection.
    pub problem: Problem,
    /// Its pencil.
    pub reduced: Reduced,
}

impl OfSign {
    fn of(problem: Problem) -> Result<OfSign, ModelError> {
        let reduced = reduce(&problem)?;
        Ok(OfSign { problem, reduced })
    }

    /// A point of the given problem as one of this.
    pub fn candidate(&self, given: &Candidate) -> Candidate {
        if self.problem.is_reflected() {
            given.reflected()
        } else {
            given.clone()
        }
    }
}

/// A problem and, where values below 0 are sought, its reflection.
#[derive(Debug, Clone)]
pub struct BothSigns {
    own: OfSign,
    reflected: Option<OfSign>,
}

impl BothSigns {
    /// Reduces both.
    ///
    /// # Errors
    /// As [`reduce`].
    pub fn of(problem: &Problem) -> Result<BothSigns, ModelError> {
        Ok(BothSigns {
            own: OfSign::of(problem.clone())?,
            reflected: problem.reflected().map(OfSign::of).transpose()?,
        })
    }

    /// The problem as it is given.
    pub fn own(&self) -> &OfSign {
        &self.own
    }

    /// Its reflection.
    pub fn reflected(&self) -> Option<&OfSign> {
        self.reflected.as_ref()
    }

    /// Which one has the solutions near this point, and the other one where it may have them too.
    pub fn near(&self, given: &Candidate) -> (&OfSign, Option<&OfSign>) {
        let Some(reflected) = &self.reflected else {
            return (&self.own, None);
        };

        let [lo, hi] = given.near();
        let is_next_to_zero = lo <= 0.0 && hi >= 0.0;
        let (likelier, other) = if given.value < 0.0 {
            (reflected, &self.own)
        } else {
            (&self.own, reflected)
        };
        (likelier, is_next_to_zero.then_some(other))
    }
}
