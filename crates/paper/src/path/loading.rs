//! How the block is loaded: friction, normal force, range of the motion.

use super::error::PathError;
use mceip_exact::{Rational, rational, whole};
use num_traits::Signed;

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

    pub(super) fn validate(&self) -> Result<(), PathError> {
        let range = self
            .until
            .as_ref()
            .map(|u| ("the range of the motion (mm)", u));
        let all = [
            ("friction", &self.friction),
            ("the normal force (N)", &self.force),
        ];
        match all.into_iter().chain(range).find(|(_, v)| !v.is_positive()) {
            Some((what, v)) => Err(PathError::NotPositive {
                what,
                got: v.clone(),
            }),
            None => Ok(()),
        }
    }
}
