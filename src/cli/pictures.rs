//! What the pages of `analyze` and `path` have in common: pictures with their captions, as figures
//! and as files in a folder; the levels of the chart of lambda against mu; warnings of the model.

use super::common::CliError;
use super::job::Job;
use super::output::Folder;
use crate::picture::{ChartPoint, Content, Picture};
use mceip_engine::reduction::SparseCondensation;
use mceip_engine::run::{Progress, Watch};
use mceip_engine::search::levels::{level_solutions, static_frequency2};
use mceip_model::System;

/// A picture with the name of its file and what to read off it.
pub(super) struct Named {
    pub(super) name: String,
    pub(super) picture: Picture,
    pub(super) caption: String,
}

impl Named {
    pub(super) fn into_figure(self) -> Content {
        Content::Figure {
            picture: self.picture,
            caption: self.caption,
        }
    }
}

/// What looked wrong when the file was made.
pub(super) fn warnings_of(warnings: &[String]) -> impl Iterator<Item = Content> {
    let sentences = warnings.iter();
    sentences.map(|warning| Content::Warning(format!("Warning of convert: {warning}.")))
}

/// Pixels of a PNG for each px of the SVG.
#[cfg(feature = "png")]
const ZOOM: f32 = 2.0;

/// Writes the pictures as SVG files, as PNG too in a build with the feature png.
pub(super) fn write_all(folder: &Folder, pictures: &[Named]) -> Result<(), CliError> {
    for named in pictures {
        let svg = named.picture.to_svg();
        folder.write(&format!("{}.svg", named.name), svg.as_bytes())?;
        #[cfg(feature = "png")]
        folder.write(&format!("{}.png", named.name), &named.picture.to_png(ZOOM)?)?;
    }

    Ok(())
}

/// Levels of lambda^2: the lowest static frequency squared times 1.5^k, for k in this range.
const LEVELS: std::ops::Range<i32> = -10..14;

/// What to read off the points of the chart of lambda against mu.
pub(super) const LEVELS_CAPTION: &str = "Points: every solution found at that \u{3bb}, from \
    the pencil condensed in doubles (measured, not certified).";

/// Every solution of MCEIP-lambda2 at some levels of lambda^2 above 0, in doubles, level by level;
/// as far as the work is not cancelled.
pub(super) fn levels_of(
    system: &System,
    watch: &Watch<'_>,
) -> Result<Vec<Vec<ChartPoint>>, CliError> {
    let condensation = SparseCondensation::of_system(system)?;
    let unit = static_frequency2(&condensation).unwrap_or(1.0);
    let mut levels = Vec::with_capacity(LEVELS.len());
    for (k, exponent) in LEVELS.enumerate() {
        if watch.is_cancelled() {
            break;
        }

        let number = k + 1;
        let stage = format!("lambda against mu: level {number} of {}", LEVELS.len());
        watch.report(&Progress::stage(&stage));

        let lambda2 = unit * 1.5f64.powi(exponent);
        levels.push(level_points(&condensation, lambda2, watch)?);
    }

    Ok(levels)
}

/// The chart of lambda against mu, if there is one. What keeps it from being drawn is told, and the
/// answers are given without it.
pub(super) fn drawn<T>(chart: Result<Option<T>, CliError>, job: &Job) -> Option<T> {
    chart.unwrap_or_else(|why| {
        job.note(&format!("mceip: lambda against mu is not drawn: {why}"));
        None
    })
}

/// Leaves out what lies at larger mu: far above the mu that matter, curves of other motions begin.
pub(super) fn keep_below(levels: &mut [Vec<ChartPoint>], top: f64) {
    for level in levels {
        level.retain(|point| point.mu <= top);
    }
}

/// Every solution of MCEIP-lambda2 at this lambda^2, in doubles.
fn level_points(
    condensation: &SparseCondensation,
    lambda2: f64,
    watch: &Watch<'_>,
) -> Result<Vec<ChartPoint>, CliError> {
    let (found, _) = level_solutions(&condensation.at(lambda2)?, &watch.quiet())?;
    let mut points = Vec::with_capacity(found.len());
    for solution in found {
        points.push(ChartPoint {
            mu: solution.mu,
            lambda2,
            support: solution.support,
        });
    }

    Ok(points)
}
