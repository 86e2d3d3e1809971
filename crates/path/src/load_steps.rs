//! How a body is loaded: its friction, and how much of each load is applied, one load after the
//! other. Input of `LoadingPath::follow`.

use super::contact::Contact;
use super::error::PathError;
use mceip_exact::Rational;
use num_traits::Signed;
use std::collections::BTreeMap;

/// How a body is loaded: load k of a [`Contact`] grows from 0 to `amounts[k]` and stays there while
/// the next one grows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadSteps {
    /// Coefficient of friction mu > 0.
    pub friction: Rational,
    /// How much of each load is applied, > 0; `None` for a last one that grows until nothing more
    /// happens. Loads beyond the list are not applied.
    pub amounts: Vec<Option<Rational>>,
    /// At the beginning of a stretch (from 0) which of all solutions of the rate problem is taken,
    /// as `LoadingPath::rate_solutions` lists them; elsewhere the first that the search meets.
    pub taken: BTreeMap<usize, usize>,
}

impl LoadSteps {
    /// These amounts of the loads, and everywhere the first solution that is met.
    pub fn new(friction: Rational, amounts: Vec<Option<Rational>>) -> LoadSteps {
        LoadSteps {
            friction,
            amounts,
            taken: BTreeMap::new(),
        }
    }

    /// Refuses what is not positive, steps without a load, and an endless step before another.
    pub(super) fn validate(&self, contact: &Contact) -> Result<(), PathError> {
        require_positive("friction", &self.friction)?;
        for amount in self.amounts.iter().flatten() {
            require_positive("the amount of a load", amount)?;
        }

        let steps = self.amounts.len();
        if steps == 0 || steps > contact.loads() {
            return Err(PathError::Steps {
                expected: format!("1 to {} steps, one for each load", contact.loads()),
                got: steps.to_string(),
            });
        }

        match self.amounts.iter().position(Option::is_none) {
            Some(endless) if endless + 1 < steps => Err(PathError::Steps {
                expected: "an end of every step but the last".into(),
                got: format!("none of step {}", endless + 1),
            }),
            _ => Ok(()),
        }
    }
}

/// Refuses a number that is not positive.
///
/// # Errors
/// [`PathError::NotPositive`].
pub fn require_positive(what: &'static str, value: &Rational) -> Result<(), PathError> {
    if value.is_positive() {
        return Ok(());
    }

    Err(PathError::NotPositive {
        what,
        got: value.clone(),
    })
}
