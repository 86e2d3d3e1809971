//! The stepped path beside the exact one: what the steps miss, and by how much they are off.
//!
//! Inside a stretch of the exact path the reactions are affine in the motion, so they are known at
//! the motion of each step by interpolation between the two ends. `mceip block --path` calls this.
#![allow(clippy::float_arithmetic)]

use super::step::Step;
use mceip_exact::to_f64;
use mceip_path::{LoadingPath, Stretch};

/// How a stepped path compares with the exact one.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Steps that were compared (those within the exact path).
    pub steps: usize,
    /// Stretches of the exact path in which no step ends.
    pub skipped: Vec<usize>,
    /// Steps (from 1) that end in a stretch, and began in it, with other states than the stretch
    /// has.
    pub other_states: Vec<usize>,
    /// Largest difference of a nodal reaction component at a step, N.
    pub reaction: f64,
}

impl Comparison {
    /// Compares step by step; the exact reactions between two events are interpolated, which is
    /// exact up to rounding. Steps in a last stretch that never ends are compared if it slides.
    pub fn of(path: &LoadingPath, steps: &[Step]) -> Comparison {
        let slides = path.slides();
        let stretches: Vec<ExactStretch> = path
            .stretches
            .iter()
            .map(|stretch| ExactStretch::of(stretch, slides))
            .collect();

        let mut result = Comparison {
            steps: 0,
            skipped: Vec::new(),
            other_states: Vec::new(),
            reaction: 0.0,
        };
        let mut visited = vec![false; stretches.len()];
        for (number, step) in steps.iter().enumerate().skip(1) {
            let at = stretch_at(&stretches, step.motion);
            let Some(stretch) = stretches.get(at) else {
                continue;
            };
            let Some(exact) = stretch.reactions_at(step.motion) else {
                continue;
            };

            result.steps += 1;
            visited[at] = true;

            let began_here = stretch_at(&stretches, steps[number - 1].motion) == at;
            if began_here && step.states != path.stretches[at].states {
                result.other_states.push(number);
            }

            let difference = largest_difference(&exact, &step.reactions);
            result.reaction = result.reaction.max(difference);
        }

        result.skipped = (0..visited.len()).filter(|&k| !visited[k]).collect();
        result
    }
}

/// The stretch in which a motion lies, its beginning left out and its end included.
fn stretch_at(stretches: &[ExactStretch], motion: f64) -> usize {
    stretches
        .partition_point(|stretch| stretch.from < motion)
        .saturating_sub(1)
}

/// The largest difference of a component, N.
fn largest_difference(a: &[(f64, f64)], b: &[(f64, f64)]) -> f64 {
    let mut largest: f64 = 0.0;
    for (a, b) in a.iter().zip(b) {
        largest = largest.max((a.0 - b.0).abs());
        largest = largest.max((a.1 - b.1).abs());
    }

    largest
}

/// A stretch of the exact path in doubles: mm and N.
struct ExactStretch {
    from: f64,
    start: Vec<(f64, f64)>,
    stop: Option<Stop>,
}

/// Where a stretch ends, and the reactions there; the same reactions at infinity if it slides.
struct Stop {
    to: f64,
    reactions: Vec<(f64, f64)>,
}

impl ExactStretch {
    fn of(stretch: &Stretch, slides: bool) -> ExactStretch {
        let start = stretch.start.reactions_f64();

        let stop = match &stretch.stop {
            Some(stop) => Some(Stop {
                to: to_f64(stop.amount()),
                reactions: stop.reactions_f64(),
            }),
            None if slides => Some(Stop {
                to: f64::INFINITY,
                reactions: start.clone(),
            }),
            None => None,
        };

        ExactStretch {
            from: to_f64(stretch.start.amount()),
            start,
            stop,
        }
    }

    /// (r_T, r_N) of each node at a motion; `None` beyond the end.
    fn reactions_at(&self, motion: f64) -> Option<Vec<(f64, f64)>> {
        let stop = self.stop.as_ref().filter(|stop| motion <= stop.to)?;
        let share = (motion - self.from) / (stop.to - self.from); // 0 if the stretch never ends

        let mut reactions = Vec::with_capacity(self.start.len());
        for (start, stop) in self.start.iter().zip(&stop.reactions) {
            let tangential = start.0 + share * (stop.0 - start.0);
            let normal = start.1 + share * (stop.1 - start.1);
            reactions.push((tangential, normal));
        }

        Some(reactions)
    }
}
