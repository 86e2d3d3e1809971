//! What changes from one attempt to the next: crash, acceptance, proximal term, kind of start, and
//! the point it starts from.
//!
//! Attempt 0 is PATH's own. The restarts after it leave the places where it failed: each takes
//! other settings, and most move the start by pseudo-random amounts that are the same in every run.
//! The settings are data, in [`Attempt`]; `newton` carries them out.

use super::path::Start;
use super::tolerance::{CURVE_TRIAL_GROWTH, RESTART_FRACTION, RESTART_PROXIMAL, RESTART_SHIFT};

/// What a step must pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Acceptance {
    /// PATH's non-monotone rule: memory, unchecked steps inside a shrinking radius.
    NonMonotone,
    /// Each step is checked against the last merit.
    Monotone,
    /// The non-monotone rule with a distant reference and an unbounded radius: nearly pure Newton.
    Free,
}

/// Settings of one attempt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Attempt {
    /// Crash before the first path?
    pub(super) crash: bool,
    /// Which start a path tries first; the other one follows on failure.
    pub(super) first: Start,
    /// What a step must pass.
    pub(super) acceptance: Acceptance,
    /// Fraction of each regular path that is taken while the merit is far from zero; 1 for all.
    pub(super) fraction: f64,
    /// The user's start is moved in each component by up to this, relative to 1 + |z_i|.
    pub(super) shift: f64,
    /// Proximal term relative to the largest entry of F', at merits of 1 and above.
    pub(super) proximal: f64,
}

impl Attempt {
    /// The settings of attempt `k`: 0 is the first, 1 the first restart.
    ///
    /// The first restarts were chosen by measurement (non-monotone eigenvalue problems): plain
    /// Newton along the paths, then two that leave a cycle of Newton points by moving the start.
    pub(super) fn number(k: usize) -> Attempt {
        match k {
            0 => Attempt {
                crash: true,
                acceptance: Acceptance::NonMonotone,
                ..Attempt::free()
            },
            1 => Attempt::free(),
            _ => Attempt::moved(k),
        }
    }

    /// Paths from the start itself, each taken to its end nearly unchecked.
    fn free() -> Attempt {
        Attempt {
            crash: false,
            first: Start::Regular,
            acceptance: Acceptance::Free,
            fraction: 1.0,
            shift: 0.0,
            proximal: 0.0,
        }
    }

    /// The restarts from a start that is moved; four kinds take turns.
    fn moved(k: usize) -> Attempt {
        match k % 4 {
            2 => Attempt {
                fraction: RESTART_FRACTION,
                shift: RESTART_SHIFT[0],
                ..Attempt::free()
            },
            3 => Attempt {
                shift: RESTART_SHIFT[1],
                ..Attempt::free()
            },
            0 => Attempt {
                acceptance: Acceptance::Monotone,
                proximal: RESTART_PROXIMAL,
                shift: RESTART_SHIFT[0],
                ..Attempt::free()
            },
            _ => Attempt {
                first: Start::Ray,
                shift: RESTART_SHIFT[1],
                ..Attempt::free()
            },
        }
    }

    /// Settings of a point that is only the start of curves, `trial` from 0: two at each distance,
    /// then farther away, where other branches of the curves are.
    pub(super) fn far(trial: usize) -> Attempt {
        let mut factor = 1.0;
        for _ in 0..trial / 2 {
            factor *= CURVE_TRIAL_GROWTH;
        }

        Attempt {
            shift: RESTART_SHIFT[1] * factor,
            ..Attempt::number(1)
        }
    }

    /// Component `i` of the start of attempt `k`: the user's, moved the same way in every run.
    pub(super) fn shifted(&self, start: f64, i: usize, k: usize) -> f64 {
        let size = 1.0 + start.abs();
        start + self.shift * size * spread(k, i)
    }
}

/// A number in [-1, 1), spread over k and i by the bits of a multiplicative hash (splitmix64).
fn spread(k: usize, i: usize) -> f64 {
    let of_k = (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let of_i = (i as u64 + 1).wrapping_mul(0xd1b5_4a32_d192_ed03);
    let seed = of_k ^ of_i;

    let mixed = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let bits = (mixed ^ (mixed >> 31)) >> 11;

    // 53 bits, divided by 2^52: a number in [0, 2).
    bits as f64 / (1u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attempts_in_a_row_differ() {
        for k in 0..9 {
            assert_ne!(Attempt::number(k), Attempt::number(k + 1));
        }
    }

    #[test]
    fn trials_go_farther_two_by_two() {
        let shifts: Vec<f64> = (0..6).map(|k| Attempt::far(k).shift).collect();
        assert_eq!(shifts, [1.0, 1.0, 4.0, 4.0, 16.0, 16.0]);
    }

    #[test]
    fn shifts_are_bounded_deterministic_and_spread() {
        let attempt = Attempt::number(3);
        for (i, start) in [0.0, 3.0].into_iter().enumerate() {
            assert_eq!(Attempt::number(1).shifted(start, i, 1), start);
            assert_eq!(attempt.shifted(start, i, 3), attempt.shifted(start, i, 3));
        }

        let mean = (0..1000).map(|i| spread(3, i)).sum::<f64>() / 1000.0;
        assert!((0..1000).all(|i| spread(3, i).abs() <= 1.0), "{mean}");
        assert!(mean.abs() < 0.1, "{mean}");
    }

    /// The table of attempts, each with what sets it apart.
    #[test]
    fn each_attempt_has_its_settings() {
        let free = Attempt {
            crash: false,
            first: Start::Regular,
            acceptance: Acceptance::Free,
            fraction: 1.0,
            shift: 0.0,
            proximal: 0.0,
        };
        let [small, large] = RESTART_SHIFT;
        let list = [
            Attempt {
                crash: true,
                acceptance: Acceptance::NonMonotone,
                ..free
            },
            free,
            Attempt {
                fraction: RESTART_FRACTION,
                shift: small,
                ..free
            },
            Attempt {
                shift: large,
                ..free
            },
            Attempt {
                acceptance: Acceptance::Monotone,
                proximal: RESTART_PROXIMAL,
                shift: small,
                ..free
            },
            Attempt {
                first: Start::Ray,
                shift: large,
                ..free
            },
            Attempt {
                fraction: RESTART_FRACTION,
                shift: small,
                ..free
            },
            Attempt {
                shift: large,
                ..free
            },
        ];

        for (k, expected) in list.into_iter().enumerate() {
            assert_eq!(Attempt::number(k), expected, "{k}");
        }

        assert_eq!(
            Attempt::far(0),
            Attempt {
                shift: large,
                ..free
            }
        );
    }

    /// The hash again in 128 bits (splitmix64), and the shift it makes: relative to 1 + |z|.
    #[test]
    fn shifts_are_those_of_the_hash() {
        let wrap = |a: u128, b: u128| a * b % (1 << 64);
        let number = |k: u128, i: u128| {
            let seed = wrap(k, 0x9e37_79b9_7f4a_7c15) ^ wrap(i + 1, 0xd1b5_4a32_d192_ed03);
            let mixed = wrap(seed ^ (seed / (1 << 30)), 0xbf58_476d_1ce4_e5b9);
            let mixed = wrap(mixed ^ (mixed / (1 << 27)), 0x94d0_49bb_1331_11eb);
            let top = (mixed ^ (mixed / (1 << 31))) / (1 << 11);
            top as f64 / 2f64.powi(52) - 1.0
        };

        for k in 0..40 {
            for i in 0..10 {
                assert_eq!(spread(k, i), number(k as u128, i as u128));
            }
        }

        let attempt = Attempt {
            shift: 0.25,
            ..Attempt::number(1)
        };

        assert_eq!(attempt.shifted(-7.0, 0, 3), -7.0 + 2.0 * number(3, 0));
        assert_eq!(attempt.shifted(0.5, 1, 3), 0.5 + 0.375 * number(3, 1));
    }
}
