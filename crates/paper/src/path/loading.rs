//! How the block is loaded: friction, normal force, range of the motion. Input of
//! `BlockPath::follow` and `step_path`, which refuse what is not positive.

use mceip_exact::{Rational, rational, whole};
use mceip_path::{PathError, require_positive};

/// How the block is loaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loading {
    /// Coefficient of friction mu > 0.
    pub friction: Rational,
    /// Normal force N > 0 at the end of the pressing, N.
    pub force: Rational,
    /// Motion of the glued side at which to stop, mm; `None` to follow the path to its last event.
    pub until: Option<Rational>,
}

impl Loading {
    /// The paper's loading: mu = 1.1, 55 N, until nothing more happens.
    pub fn of_the_paper() -> Loading {
        Loading {
            friction: rational(11, 10),
            force: whole(55),
            until: None,
        }
    }

    /// Refuses what is not positive.
    pub(super) fn validate(&self) -> Result<(), PathError> {
        require_positive("friction", &self.friction)?;
        require_positive("the normal force (N)", &self.force)?;
        if let Some(until) = &self.until {
            require_positive("the range of the motion (mm)", until)?;
        }

        Ok(())
    }
}
