//! The log of a run under way: steps, paths and pivots in three lists whose storage is kept.

use super::outcome::{MajorRecord, PathRecord, StepKind};
use super::path::{Path, Pivot};

/// What [`MajorRecord`] says, flat.
#[derive(Debug, Default)]
pub(super) struct Log {
    /// Each step with an empty list of paths, and the number of paths logged after it.
    steps: Vec<(MajorRecord, usize)>,
    /// Each path with an empty list of pivots, and the number of pivots logged after it.
    paths: Vec<(PathRecord, usize)>,
    pivots: Vec<Pivot>,
}

impl Log {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.steps.clear();
        self.paths.clear();
        self.pivots.clear();
    }

    /// Logs a path; it belongs to the next step.
    pub(super) fn path(&mut self, path: &Path) {
        self.pivots.extend_from_slice(&path.pivots);
        let record = PathRecord {
            start: path.start,
            end: path.end,
            reach: path.reach(),
            pivots: Vec::new(),
        };
        self.paths.push((record, self.pivots.len()));
    }

    /// Logs a step, which takes the paths logged since the last one.
    pub(super) fn step(&mut self, merit: f64, step: StepKind, proximal: f64) {
        self.steps.push((
            MajorRecord {
                merit,
                step,
                proximal,
                paths: Vec::new(),
            },
            self.paths.len(),
        ));
    }

    /// The records with their paths and pivots.
    pub(super) fn records(&self) -> Vec<MajorRecord> {
        let (mut path, mut pivot) = (0, 0);
        let mut record = |(record, end): &(MajorRecord, usize)| {
            let mut of = |(record, end): &(PathRecord, usize)| {
                let pivots = self.pivots[std::mem::replace(&mut pivot, *end)..*end].to_vec();
                PathRecord { pivots, ..*record }
            };
            let paths = self.paths[std::mem::replace(&mut path, *end)..*end]
                .iter()
                .map(&mut of)
                .collect();
            MajorRecord { paths, ..*record }
        };
        self.steps.iter().map(&mut record).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_that_is_cleared_forgets_its_steps_paths_and_pivots() {
        let mut log = Log::default();
        let record = |log: &mut Log, merit: f64| {
            log.path(&Path::default());
            log.step(merit, StepKind::Failed, 0.0);
        };
        record(&mut log, 1.0);
        record(&mut log, 2.0);
        assert_eq!(
            log.records()
                .iter()
                .map(|r| (r.merit, r.paths.len()))
                .collect::<Vec<_>>(),
            [(1.0, 1), (2.0, 1)]
        );
        log.clear();
        assert!(log.records().is_empty());
        record(&mut log, 3.0);
        assert_eq!(
            log.records()
                .iter()
                .map(|r| (r.merit, r.paths.len()))
                .collect::<Vec<_>>(),
            [(3.0, 1)]
        );
    }
}
