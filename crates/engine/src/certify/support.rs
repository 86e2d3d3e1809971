//! The supports that a candidate suggests: several guesses, best first, and repairs of them.
//!
//! A component of a candidate in doubles is rarely exactly zero. Whether x_i > 0 is therefore
//! guessed by thresholds ([`SUPPORT_GUESSES`]) relative to the largest slip component. Where a
//! claim about a guess has a wrong sign at a component that doubles cannot tell from zero, that
//! component changes sides. Called by `proposals`; which guess is right the signs of the claims
//! decide.

use super::failure::AttemptFailure;
use super::rows::center_of;
use crate::candidate::Candidate;
use crate::tolerance::SUPPORT_GUESSES;
use mceip_check::certificate::EnclosedSolution;
use mceip_exact::to_f64;
use mceip_model::Pencil;

/// Share of the largest slip component up to which doubles cannot tell a component from zero.
const ROUNDING_SHARE: f64 = SUPPORT_GUESSES[0];

/// The distinct supports {i : x_i > threshold max x_s} over the thresholds, in their order.
///
/// # Errors
/// x of another length than the pencil's order, NaN or infinite numbers, or x = 0.
pub(super) fn guesses(
    pencil: &Pencil,
    candidate: &Candidate,
) -> Result<Vec<Vec<usize>>, AttemptFailure> {
    require_usable(pencil, candidate)?;

    let mut supports: Vec<Vec<usize>> = Vec::new();
    for support in candidate.supports(&pencil.slip()) {
        if !supports.contains(&support) {
            supports.push(support);
        }
    }

    Ok(supports)
}

/// Demands one finite number for each variable, and not only zeros.
fn require_usable(pencil: &Pencil, candidate: &Candidate) -> Result<(), AttemptFailure> {
    if candidate.x.len() != pencil.order() {
        return Err(AttemptFailure::WrongLength {
            expected: pencil.order(),
            got: candidate.x.len(),
        });
    }
    if !candidate.value.is_finite() || candidate.x.iter().any(|v| !v.is_finite()) {
        return Err(AttemptFailure::NotFinite);
    }
    if candidate.x.iter().all(|v| *v == 0.0) {
        return Err(AttemptFailure::ZeroX);
    }

    Ok(())
}

/// The support with the component changed whose sign is wrong: without it where x is not positive,
/// with it where y is negative. `None` where nothing of that kind failed, or the candidate's
/// component is too large for a matter of rounding.
pub(super) fn repaired(
    pencil: &Pencil,
    candidate: &Candidate,
    support: &[usize],
    failure: &AttemptFailure,
) -> Option<Vec<usize>> {
    let (index, moves) = match failure {
        AttemptFailure::XNotPositive { index } => (*index, false),
        AttemptFailure::YNegative { index } => (*index, true),
        _ => return None,
    };
    let largest = candidate.largest_slip(&pencil.slip());
    if candidate.x[index].abs() > ROUNDING_SHARE * largest {
        return None;
    }

    let mut repaired = support.to_vec();
    repaired.retain(|i| *i != index);
    if moves {
        repaired.push(index);
        repaired.sort_unstable();
    }

    Some(repaired)
}

/// Demands of a claim about a repaired support that each component which the candidate has within
/// rounding of zero is as small in the claim.
///
/// # Errors
/// [`AttemptFailure::TooFar`] with the component, relative to the largest one of the claim.
pub(super) fn require_within_rounding(
    pencil: &Pencil,
    candidate: &Candidate,
    claim: &EnclosedSolution,
) -> Result<(), AttemptFailure> {
    let largest = candidate.largest_slip(&pencil.slip());
    let center = center_of(pencil, claim);
    let claimed = claim.support.iter().map(|&i| to_f64(&center[i]));
    let largest_claimed = claimed.clone().fold(0.0, f64::max);

    for (&index, x) in claim.support.iter().zip(claimed) {
        let is_zero_in_doubles = candidate.x[index].abs() <= ROUNDING_SHARE * largest;
        if is_zero_in_doubles && x > ROUNDING_SHARE * largest_claimed {
            return Err(AttemptFailure::TooFar {
                distance: x / largest_claimed,
                limit: ROUNDING_SHARE,
            });
        }
    }

    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;

    /// The first variable is free, the others slip.
    fn identity(order: usize) -> Pencil {
        let a = Sparse::identity(order);
        Pencil::new(a, Sparse::identity(order), vec![0]).unwrap()
    }

    fn supports(x: &[f64]) -> Result<Vec<Vec<usize>>, AttemptFailure> {
        let candidate = Candidate {
            value: 1.0,
            x: x.to_vec(),
        };
        guesses(&identity(3), &candidate)
    }

    #[test]
    fn ambiguous_components_give_several_guesses() {
        assert_eq!(supports(&[9.0, 1.0, 0.5]).unwrap(), vec![vec![1, 2]]);
        assert_eq!(
            supports(&[9.0, 1.0, 1e-7]).unwrap(),
            vec![vec![1, 2], vec![1]]
        );
        assert_eq!(
            supports(&[9.0, 0.0, -1.0]).unwrap(),
            vec![Vec::<usize>::new()]
        );
    }

    /// What becomes of a support of x = (9, 1, 1e-12, 0.1) after a failure.
    fn repaired_support(support: &[usize], failure: AttemptFailure) -> Option<Vec<usize>> {
        let candidate = Candidate {
            value: 1.0,
            x: vec![9.0, 1.0, 1e-12, 0.1],
        };
        repaired(&identity(4), &candidate, support, &failure)
    }

    /// A component within rounding of zero joins or leaves; a larger one does not.
    #[test]
    fn a_support_is_repaired_where_doubles_cannot_tell() {
        let joins = repaired_support(&[1, 3], AttemptFailure::YNegative { index: 2 });
        let leaves = repaired_support(&[1, 2, 3], AttemptFailure::XNotPositive { index: 2 });
        let too_large = repaired_support(&[1, 3], AttemptFailure::XNotPositive { index: 3 });
        let no_sign = repaired_support(&[1, 3], AttemptFailure::NotContracting);

        assert_eq!(joins, Some(vec![1, 2, 3]));
        assert_eq!(leaves, Some(vec![1, 3]));
        assert_eq!(too_large, None);
        assert_eq!(no_sign, None);
    }

    #[test]
    fn unusable_candidates_are_named() {
        assert!(matches!(
            supports(&[1.0]),
            Err(AttemptFailure::WrongLength {
                expected: 3,
                got: 1
            })
        ));
        assert!(matches!(
            supports(&[0.0, f64::NAN, 0.0]),
            Err(AttemptFailure::NotFinite)
        ));
        assert!(matches!(
            supports(&[0.0, 0.0, 0.0]),
            Err(AttemptFailure::ZeroX)
        ));
    }
}
