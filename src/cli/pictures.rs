//! What the pages of `analyze` and `path` have in common: pictures with their captions, as figures
//! and as files in folders; the levels of the chart of lambda against mu; warnings of the model.

use super::common::{CliError, aside};
use super::job::Job;
use super::output::Folder;
use crate::picture::{BodyDrawing, ChartPoint, Content, Picture, Presence, body_picture, body_vtu};
use mceip_engine::analysis::Verdict;
use mceip_engine::reduction::SparseCondensation;
use mceip_engine::run::{Progress, Watch};
use mceip_engine::search::levels::{level_solutions, static_frequency2};
use mceip_model::System;
use std::cell::{Cell, OnceCell};
use std::path::{Path, PathBuf};

/// A picture with the name of its file and what to read off it.
pub(super) struct Named {
    name: String,
    picture: Picture,
    /// The picture as SVG, once it was asked for.
    svg: OnceCell<String>,
    caption: String,
    /// Of a body: the same as a VTU file.
    vtu: Option<String>,
}

impl Named {
    pub(super) fn chart(
        name: impl Into<String>,
        picture: Picture,
        caption: impl Into<String>,
    ) -> Named {
        Named {
            name: name.into(),
            picture,
            svg: OnceCell::new(),
            caption: caption.into(),
            vtu: None,
        }
    }

    pub(super) fn body(
        name: impl Into<String>,
        title: &str,
        body: &BodyDrawing<'_>,
        caption: impl Into<String>,
    ) -> Named {
        let picture = body_picture(title, body);
        Named {
            vtu: Some(body_vtu(body)),
            ..Named::chart(name, picture, caption)
        }
    }

    pub(super) fn svg(&self) -> &str {
        self.svg.get_or_init(|| self.picture.to_svg())
    }

    pub(super) fn into_figure(self) -> Content {
        Content::Figure {
            picture: self.picture,
            caption: self.caption,
        }
    }
}

/// What a verdict on divergence is in a chart along mu.
pub(super) fn presence_of(verdict: Verdict) -> Presence {
    match verdict {
        Verdict::Absent => Presence::Absent,
        Verdict::Present => Presence::Present,
        Verdict::Undecided => Presence::Undecided,
    }
}

/// What looked wrong when the file was made.
pub(super) fn warnings_of(warnings: &[String]) -> impl Iterator<Item = Content> {
    let sentences = warnings.iter();
    sentences.map(|warning| Content::Warning(format!("Warning of convert: {warning}.")))
}

/// Options that write pictures to files.
#[derive(clap::Args)]
pub(super) struct PictureArgs {
    /// Write the pictures of the report as SVG files into this folder, as PNG too in a build with
    /// the feature png.
    #[arg(long, value_name = "FOLDER", visible_alias = "figures")]
    pictures: Option<PathBuf>,
    /// Write the pictures of the body and of its modes as VTU files, for ParaView, into this
    /// folder; the file needs coordinates.
    #[arg(long, value_name = "FOLDER")]
    vtk: Option<PathBuf>,
}

impl PictureArgs {
    /// Prepares the folders; `has_places` says whether the file has coordinates.
    pub(super) fn prepare(
        &self,
        file: &Path,
        has_places: bool,
    ) -> Result<PictureFolders, CliError> {
        if let (Some(folder), false) = (&self.vtk, has_places) {
            let expected = "a file with coordinates (`mceip convert --coordinates` adds them)";
            return Err(CliError::option("vtk", expected, &folder.to_string_lossy()));
        }

        Ok(PictureFolders {
            pictures: Folder::prepare_if("pictures", self.pictures.as_deref(), &[file])?,
            vtk: Folder::prepare_if("vtk", self.vtk.as_deref(), &[file])?,
            has_body: Cell::new(false),
        })
    }
}

/// Where the files of pictures go.
pub(super) struct PictureFolders {
    pictures: Option<Folder>,
    vtk: Option<Folder>,
    /// Was a body to be written as VTU so far?
    has_body: Cell<bool>,
}

impl PictureFolders {
    /// Is any file asked for?
    pub(super) fn are_wanted(&self) -> bool {
        self.pictures.is_some() || self.vtk.is_some()
    }

    /// Writes the pictures as SVG files, as PNG too in a build with the feature png; bodies as VTU.
    /// A file that cannot be written keeps no other from it; the first such failure.
    pub(super) fn write(&self, all: &[Named]) -> Result<(), CliError> {
        let mut written = Ok(());
        for named in all {
            written = written.and(self.write_svg(named));
            #[cfg(feature = "png")]
            {
                written = written.and(self.write_png(named));
            }
            written = written.and(self.write_vtu(named));
        }

        written
    }

    fn write_svg(&self, named: &Named) -> Result<(), CliError> {
        let Some(folder) = &self.pictures else {
            return Ok(());
        };
        folder.write(&format!("{}.svg", named.name), named.svg().as_bytes())
    }

    #[cfg(feature = "png")]
    fn write_png(&self, named: &Named) -> Result<(), CliError> {
        let Some(folder) = &self.pictures else {
            return Ok(());
        };
        folder.write(&format!("{}.png", named.name), &named.picture.to_png(ZOOM)?)
    }

    fn write_vtu(&self, named: &Named) -> Result<(), CliError> {
        let (Some(folder), Some(vtu)) = (&self.vtk, &named.vtu) else {
            return Ok(());
        };
        self.has_body.set(true);
        folder.write(&format!("{}.vtu", named.name), vtu.as_bytes())
    }

    /// After all pictures: says that there is no VTU file if none of them was of a body.
    pub(super) fn tell_no_body(&self) {
        if self.vtk.is_some() && !self.has_body.get() {
            aside("mceip: --vtk: no body and no mode is drawn here, so that nothing is written");
        }
    }
}

/// Pixels of a PNG for each px of the SVG.
#[cfg(feature = "png")]
const ZOOM: f32 = 2.0;

/// Levels of lambda^2 above 0: the lowest static frequency squared times 1.5^k, for k in this
/// range.
const LEVELS: std::ops::Range<i32> = -10..14;

/// What to read off the points of the chart of lambda against mu.
pub(super) const LEVELS_CAPTION: &str = "Points: every solution found at that \u{3bb}, from \
    the pencil condensed in doubles (measured, not certified).";

/// Every solution of MCEIP-lambda2 at lambda^2 = 0 and at some levels above, in doubles, level by
/// level; as far as the work is not cancelled.
pub(super) fn levels_of(
    system: &System,
    watch: &Watch<'_>,
) -> Result<Vec<Vec<ChartPoint>>, CliError> {
    let condensation = SparseCondensation::of_system(system)?;
    let unit = static_frequency2(&condensation).unwrap_or(1.0);
    let mut values = vec![0.0];
    values.extend(LEVELS.map(|exponent| unit * 1.5f64.powi(exponent)));

    let count = values.len();
    let mut levels = Vec::with_capacity(count);
    for lambda2 in values {
        if watch.is_cancelled() {
            break;
        }

        let number = levels.len() + 1;
        let stage = format!("lambda against mu: level {number} of {count}");
        watch.report(&Progress::stage(&stage));
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
