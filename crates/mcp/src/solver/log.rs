//! The log of a run under way: steps, paths and pivots in three lists whose storage is kept.
//!
//! A [`MajorRecord`] holds its paths, and each path its pivots. While the run goes on they are kept
//! in flat lists, which need no new storage for each step: a step holds the number of paths logged
//! up to it, a path the number of pivots. `records` builds the nested form once, at the end.

use super::outcome::{MajorRecord, PathRecord, StepKind};
use super::path::{Path, Pivot};

/// What [`MajorRecord`] says, flat.
#[derive(Debug, Default)]
pub(super) struct Log {
    steps: Vec<LoggedStep>,
    paths: Vec<LoggedPath>,
    pivots: Vec<Pivot>,
}

/// A step, whose record has an empty list of paths.
#[derive(Debug)]
struct LoggedStep {
    record: MajorRecord,
    /// Number of paths logged up to this step.
    paths_end: usize,
}

/// A path, whose record has an empty list of pivots.
#[derive(Debug)]
struct LoggedPath {
    record: PathRecord,
    /// Number of pivots logged up to the end of this path.
    pivots_end: usize,
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

        self.paths.push(LoggedPath {
            record,
            pivots_end: self.pivots.len(),
        });
    }

    /// Logs a step, which takes the paths logged since the last one.
    pub(super) fn step(&mut self, merit: f64, step: StepKind, proximal: f64) {
        let record = MajorRecord {
            merit,
            step,
            proximal,
            paths: Vec::new(),
        };

        self.steps.push(LoggedStep {
            record,
            paths_end: self.paths.len(),
        });
    }

    /// The records with their paths and pivots.
    pub(super) fn records(&self) -> Vec<MajorRecord> {
        let mut paths = self.path_records().into_iter();
        let mut records = Vec::with_capacity(self.steps.len());
        let mut begin = 0;

        for step in &self.steps {
            let count = step.paths_end - begin;
            records.push(MajorRecord {
                paths: paths.by_ref().take(count).collect(),
                ..step.record
            });
            begin = step.paths_end;
        }
        records
    }

    /// The records of all paths with their pivots.
    fn path_records(&self) -> Vec<PathRecord> {
        let mut records = Vec::with_capacity(self.paths.len());
        let mut begin = 0;

        for path in &self.paths {
            let end = path.pivots_end;
            records.push(PathRecord {
                pivots: self.pivots[begin..end].to_vec(),
                ..path.record
            });
            begin = end;
        }
        records
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
