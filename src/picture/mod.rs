//! Pictures and reports: SVG without anything from outside, one HTML file; PNG of the same with the
//! feature `png`.
//!
//! Everything is legible in black and white: states differ in the shape of their marker, lines in
//! their dashes, regions by a number. Charts draw doubles; what is exact or certified stands in the
//! numbers beside them.
//!
//! `markup` a tree of elements, `drawing` the picture made of them, `scale` and `chart` axes,
//! `marker` and `legend` the contact states; then a file for each picture: [`body_picture`],
//! [`path_picture`], [`threshold_picture`], [`branch_picture`],
//! [`presence_picture`], [`table1_picture`], [`cost_picture`], [`profile_picture`],
//! [`motion_picture`]; [`ReportPage`] puts them into a page. `vtu` writes a body for ParaView.

mod body;
mod branch;
mod chart;
mod cost;
mod drawing;
mod legend;
mod marker;
mod markup;
mod motion;
mod names;
mod path;
#[cfg(feature = "png")]
mod png;
mod presence;
mod profile;
mod report;
mod scale;
mod table1;
mod threshold;
mod vtu;

pub use body::{BodyDrawing, BodyMode, BodyUnderLoad, body_picture};
pub use branch::{Branches, ChartPoint, branch_picture};
pub use cost::{CostSeries, cost_picture};
pub use drawing::Picture;
pub use marker::Mark;
pub use markup::Element;
pub use motion::{MotionSeries, motion_picture};
pub use path::{PathDrawing, path_picture};
#[cfg(feature = "png")]
pub use png::PngError;
pub use presence::{Presence, PresenceChart, PresenceRange, presence_picture};
pub use profile::{PROFILES, ProfileSeries, profile_picture};
pub use report::{Content, ReportPage, Section};
pub use scale::{Scale, Spread};
pub use table1::table1_picture;
pub use threshold::{Threshold, ThresholdColumn, threshold_picture};
pub use vtu::body_vtu;
