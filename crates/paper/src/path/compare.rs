//! The stepped path beside the exact one: what the steps miss, and by how much they are off.
#![allow(clippy::float_arithmetic)]

use super::loading_path::LoadingPath;
use super::step::Step;
use mceip_exact::to_f64;

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
        let begins: Vec<f64> = path
            .intervals
            .iter()
            .map(|i| to_f64(i.start.motion()))
            .collect();
        let stretch = |motion: f64| begins.partition_point(|&b| b < motion).saturating_sub(1);
        let ends: Vec<Knot> = path
            .intervals
            .iter()
            .map(|i| Knot::of(i, path.slides()))
            .collect();
        let mut result = Comparison {
            steps: 0,
            skipped: Vec::new(),
            other_states: Vec::new(),
            reaction: 0.0,
        };
        let mut visited = vec![false; begins.len()];
        for (number, step) in steps.iter().enumerate().skip(1) {
            let k = stretch(step.motion);
            let Some(exact) = ends.get(k).and_then(|knot| knot.at(step.motion)) else {
                continue;
            };
            result.steps += 1;
            visited[k] = true;
            if stretch(steps[number - 1].motion) == k && step.states != path.intervals[k].states {
                result.other_states.push(number);
            }
            for (a, b) in exact.iter().zip(&step.reactions) {
                result.reaction = result
                    .reaction
                    .max((a.0 - b.0).abs())
                    .max((a.1 - b.1).abs());
            }
        }
        result.skipped = (0..visited.len()).filter(|&k| !visited[k]).collect();
        result
    }
}

/// A stretch in doubles.
struct Knot {
    from: f64,
    start: Vec<(f64, f64)>,
    /// Where it ends, and the reactions there; the same reactions at infinity if it slides.
    stop: Option<(f64, Vec<(f64, f64)>)>,
}

impl Knot {
    fn of(interval: &super::stretch::Interval, slides: bool) -> Knot {
        let start = interval.start.reactions_f64();
        let stop = match &interval.stop {
            Some(s) => Some((to_f64(s.motion()), s.reactions_f64())),
            None => slides.then(|| (f64::INFINITY, start.clone())),
        };
        Knot {
            from: to_f64(interval.start.motion()),
            start,
            stop,
        }
    }

    fn at(&self, motion: f64) -> Option<Vec<(f64, f64)>> {
        let (to, stop) = self.stop.as_ref().filter(|s| motion <= s.0)?;
        let share = (motion - self.from) / (to - self.from); // 0 if `to` is infinite
        let mix = |a: f64, b: f64| a + share * (b - a);
        Some(
            self.start
                .iter()
                .zip(stop)
                .map(|(a, b)| (mix(a.0, b.0), mix(a.1, b.1)))
                .collect(),
        )
    }
}
