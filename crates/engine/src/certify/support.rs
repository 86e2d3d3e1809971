//! Which complementarity variables a candidate takes as slipping: several guesses, best first.

use super::failure::AttemptFailure;
use super::rows::active;
use crate::candidate::Candidate;
use crate::tolerance::SUPPORT_GUESSES;
use mceip_check::certificate::Claim;
use mceip_exact::to_f64;
use mceip_model::Pencil;

/// The distinct supports {i : x_i > threshold max x_s} over the thresholds, in their order.
pub(super) fn guesses(
    pencil: &Pencil,
    candidate: &Candidate,
) -> Result<Vec<Vec<usize>>, AttemptFailure> {
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
    let slip = pencil.slip();
    let largest = slip.iter().map(|&i| candidate.x[i]).fold(0.0, f64::max);
    let mut supports: Vec<Vec<usize>> = Vec::new();
    for threshold in SUPPORT_GUESSES {
        let support: Vec<usize> = slip
            .iter()
            .copied()
            .filter(|&i| candidate.x[i] > threshold * largest)
            .collect();
        if !supports.contains(&support) {
            supports.push(support);
        }
    }
    Ok(supports)
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
    let largest = pencil
        .slip()
        .iter()
        .map(|&i| candidate.x[i])
        .fold(0.0, f64::max);
    if candidate.x[index].abs() > SUPPORT_GUESSES[0] * largest {
        return None;
    }

    let mut repaired: Vec<usize> = support.iter().copied().filter(|i| *i != index).collect();
    if moves {
        repaired.push(index);
        repaired.sort_unstable();
    }
    Some(repaired)
}

/// The claim, if no component of its support that the candidate has within rounding of zero is
/// larger than that.
pub(super) fn within_rounding(
    pencil: &Pencil,
    candidate: &Candidate,
    claim: Claim,
) -> Result<Claim, AttemptFailure> {
    let Claim::EnclosedSolution(c) = &claim else {
        return Ok(claim);
    };
    let slip = pencil.slip();
    let largest = slip.iter().map(|&i| candidate.x[i]).fold(0.0, f64::max);
    let active = active(pencil, &c.support);
    let centers: Vec<(usize, f64)> = active
        .into_iter()
        .zip(&c.center)
        .map(|(i, x)| (i, to_f64(&x.0)))
        .collect();
    let in_support = || centers.iter().filter(|(i, _)| c.support.contains(i));
    let largest_claimed = in_support().map(|(_, x)| *x).fold(0.0, f64::max);

    for (i, x) in in_support() {
        let is_zero_in_doubles = candidate.x[*i].abs() <= SUPPORT_GUESSES[0] * largest;
        if is_zero_in_doubles && *x > SUPPORT_GUESSES[0] * largest_claimed {
            return Err(AttemptFailure::TooFar {
                distance: *x / largest_claimed,
                limit: SUPPORT_GUESSES[0],
            });
        }
    }
    Ok(claim)
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::Sparse;

    fn supports(x: &[f64]) -> Result<Vec<Vec<usize>>, AttemptFailure> {
        let n = 3;
        let pencil = Pencil::new(Sparse::identity(n), Sparse::identity(n), vec![0]).unwrap();
        guesses(
            &pencil,
            &Candidate {
                value: 1.0,
                x: x.to_vec(),
            },
        )
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

    /// A component within rounding of zero joins or leaves; a larger one does not.
    #[test]
    fn a_support_is_repaired_where_doubles_cannot_tell() {
        let n = 4;
        let pencil = Pencil::new(Sparse::identity(n), Sparse::identity(n), vec![0]).unwrap();
        let candidate = Candidate {
            value: 1.0,
            x: vec![9.0, 1.0, 1e-12, 0.1],
        };
        let of = |support: &[usize], failure| repaired(&pencil, &candidate, support, &failure);

        assert_eq!(
            of(&[1, 3], AttemptFailure::YNegative { index: 2 }),
            Some(vec![1, 2, 3])
        );
        assert_eq!(
            of(&[1, 2, 3], AttemptFailure::XNotPositive { index: 2 }),
            Some(vec![1, 3])
        );
        assert_eq!(of(&[1, 3], AttemptFailure::XNotPositive { index: 3 }), None);
        assert_eq!(of(&[1, 3], AttemptFailure::NotContracting), None);
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
