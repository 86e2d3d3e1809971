//! A performance profile (Dolan and Moré, Mathematical Programming 91, 2002): of all cases, the
//! share that each program answers correctly within tau times the least time.
//!
//! `mceip conform --compare` draws its runs with it.

use super::chart::{Axis, Chart, dot};
use super::cost::{AREA, STYLES, WIDTH, height_with_keys, push_key};
use super::drawing::Picture;
use super::scale::Spread;

/// The steps of one program.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileSeries {
    /// What it is, for the legend.
    pub name: String,
    /// Ratios tau >= 1, ascending, and the share from there on, 0 to 1.
    pub steps: Vec<(f64, f64)>,
}

/// Programs that can be told apart in black and white.
pub const PROFILES: usize = STYLES.len();

/// Steps of a program up to which each has a dot.
const FEW: usize = 30;

/// Draws each program as steps, with a dot at each where they are few; the ratio on a logarithmic
/// axis.
pub fn profile_picture(title: &str, series: &[ProfileSeries]) -> Picture {
    let ratios = series
        .iter()
        .flat_map(|s| &s.steps)
        .map(|(ratio, _)| *ratio);
    let right = 1.3 * ratios.fold(1.0, f64::max).max(2.0);
    let x = Axis {
        label: "\u{3c4}: time over the least time of any program",
        spread: Spread::Log,
        values: (1.0, right),
        ticks: 9,
    };
    let y = Axis::linear("\u{3c1}(\u{3c4}): share of the cases", (0.0, 1.02), 6);
    let chart = Chart::new(AREA, &x, &y);

    let mut picture = Picture::new(title, WIDTH, height_with_keys(series.len()));
    picture.push_heading(AREA.left, 24.0);
    picture.push(chart.frame(&x, &y));
    for (k, one) in series.iter().enumerate() {
        let style = &STYLES[k % STYLES.len()];
        let curve = chart.curve(&corners(&one.steps, right), 1.4, style.dash);
        picture.push(curve.with("class", "series"));

        let dots = last_of_each_ratio(&one.steps);
        let is_few = dots.len() <= FEW;
        for step in dots.into_iter().filter(|_| is_few) {
            let (ratio, share) = step;
            let tip = format!("{}: {share:.3} within {ratio:.3}", one.name);
            picture.push(dot(chart.point(step), 2.5, style.fill, step, tip));
        }
        push_key(&mut picture, k, &one.name, style);
    }

    picture
}

/// The corners of the steps, from (1, 0) to the right end.
fn corners(steps: &[(f64, f64)], right: f64) -> Vec<(f64, f64)> {
    let mut corners = vec![(1.0, 0.0)];
    let mut share = 0.0;
    for (ratio, next) in steps {
        corners.push((*ratio, share));
        corners.push((*ratio, *next));
        share = *next;
    }
    corners.push((right, share));
    corners
}

/// Of steps at one ratio only the last one.
fn last_of_each_ratio(steps: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for step in steps {
        match kept.last_mut() {
            Some(last) if last.0 == step.0 => *last = *step,
            _ => kept.push(*step),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_go_up_where_the_ratio_is_reached() {
        let steps = [(1.0, 0.25), (1.0, 0.5), (3.0, 0.75)];
        assert_eq!(last_of_each_ratio(&steps), [(1.0, 0.5), (3.0, 0.75)]);
        assert_eq!(
            corners(&steps[1..], 4.0),
            [
                (1.0, 0.0),
                (1.0, 0.0),
                (1.0, 0.5),
                (3.0, 0.5),
                (3.0, 0.75),
                (4.0, 0.75)
            ]
        );

        // A program that is never correct has a line at 0.
        let never = ProfileSeries {
            name: "a < b".into(),
            steps: Vec::new(),
        };
        let svg = profile_picture("title", &[never]).to_svg();
        assert!(
            svg.contains("a &lt; b") && svg.contains("polyline"),
            "{svg}"
        );
    }
}
