//! Continua of solutions as a reader wants them: in as few parts as they have.
//!
//! A cover yields a family for each place of each of its leaves, so that a continuum is cut where
//! leaves meet. Called for what is listed; the certificate and the checker's verdict have each.

use mceip_check::SolutionFamily;

/// The same families, ordered as the checker orders them, by support and lower end, with two
/// intervals and the value between them as one interval, where as much is proved of all three.
pub fn joined(families: &[SolutionFamily]) -> Vec<SolutionFamily> {
    let mut joined: Vec<SolutionFamily> = Vec::new();
    for next in families {
        if let [.., interval, value] = joined.as_mut_slice()
            && continues(interval, value, next)
        {
            interval.to = next.to.clone();
            joined.pop();
        } else {
            joined.push(next.clone());
        }
    }

    joined
}

/// Does the next interval begin at the value where the interval ends?
fn continues(interval: &SolutionFamily, value: &SolutionFamily, next: &SolutionFamily) -> bool {
    let are_of_the_kind = !interval.is_point && value.is_point && !next.is_point;
    let has_one_support = interval.support == value.support && value.support == next.support;
    let is_alike = interval.is_alone == value.is_alone && value.is_alone == next.is_alone;
    let meets = interval.to == value.from && value.from == next.from;

    are_of_the_kind && has_one_support && is_alike && meets
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Interval, whole};

    fn family(support: usize, from: i64, to: Option<i64>, is_alone: bool) -> SolutionFamily {
        let point = |v: i64| Interval::point(whole(v));
        SolutionFamily {
            support: vec![support],
            from: Some(point(from)),
            to: to.map(point),
            is_point: to == Some(from),
            is_alone,
        }
    }

    /// 0, (0, 1), 1, (1, 2), 2 and (2, infinity) are 0 and (0, infinity).
    #[test]
    fn what_meets_is_one() {
        let place = |from, to| family(7, from, to, true);
        let rest = [place(0, Some(1)), place(1, Some(1)), place(1, Some(2))];
        let end = [place(2, Some(2)), place(2, None)];
        let all = [vec![place(0, Some(0))], rest.to_vec(), end.to_vec()].concat();

        let expected = vec![place(0, Some(0)), place(0, None)];
        assert_eq!(joined(&all), expected);
        assert_eq!(joined(&expected), expected);
    }

    /// A value that is missing, that is a cone, or of another support divides.
    #[test]
    fn what_differs_divides() {
        let place = |from, to| family(7, from, to, true);
        for between in [
            vec![],
            vec![family(7, 1, Some(1), false)],
            vec![family(8, 1, Some(1), true)],
            vec![place(2, Some(2))],
        ] {
            let all = [vec![place(0, Some(1))], between, vec![place(1, Some(2))]].concat();
            assert_eq!(joined(&all), all);
        }
    }
}
