//! `mceip path --own-critical`: its options, its certificates in a folder, its pictures.

use super::bodies;
use crate::cli::common::{CliError, friction_of, positive};
use crate::cli::output::Folder;
use crate::cli::pictures::{Named, presence_of};
use crate::picture::{
    Branches, ChartPoint, Content, Presence, PresenceChart, PresenceRange, Section, branch_picture,
    presence_picture,
};
use crate::say::number_text;
use crate::say::own_critical::{HEADER, headlines, rows_of};
use crate::say::path::LETTERS;
use crate::{
    Bracket, Certificate, FrictionAnswer, FrictionGrid, FrictionGridError, FrictionPoint,
    OwnCritical, PathPlace,
};
use mceip_engine::analysis::Proof;
use mceip_exact::{Rational, to_f64};
use mceip_model::file::read_text;

/// The mu that are asked for by the options of the command line.
pub(super) fn grid_of(
    ends: &[String],
    parts: usize,
    width: &str,
) -> Result<FrictionGrid, CliError> {
    let given = ends.join(",");
    let [least, greatest] = ends else {
        let expected = "two coefficients of friction, MIN,MAX";
        return Err(CliError::option("own-critical", expected, &given));
    };
    let least = friction_of("own-critical", least)?;
    let greatest = friction_of("own-critical", greatest)?;
    let relative = positive("width", width)?;

    let grid =
        FrictionGrid::new(least, greatest).map_err(|e| refused("own-critical", &e, &given))?;
    let grid = grid.with_parts(parts);
    let grid = grid.map_err(|e| refused("grid", &e, &parts.to_string()))?;
    grid.with_width(relative)
        .map_err(|e| refused("width", &e, width))
}

fn refused(option: &'static str, e: &FrictionGridError, given: &str) -> CliError {
    CliError::option(option, e.expected, given)
}

/// The certificate about divergence of an earlier run in this folder.
pub(super) fn earlier(folder: &Folder, mu: &Rational, place: PathPlace) -> Option<Certificate> {
    let path = folder.certificate_path(&name_of(mu, place));
    let text = read_text("an earlier certificate", &path).ok()?;
    Certificate::from_json(&text).ok()
}

/// Writes the proof about divergence at a place as `NAME.problem.json` and `NAME.certificate.json`;
/// NAME is `mu-VALUE` at the end of the path, `mu-VALUE-stretch-NUMBER` inside a stretch.
pub(super) fn keep_divergence(
    folder: &Folder,
    mu: &Rational,
    place: PathPlace,
    proof: Option<&Proof>,
) {
    let name = name_of(mu, place);
    match proof {
        Some(proof) => keep_proof(folder, &name, proof),
        None => folder.remove_proof(&name), // a theorem answers, or nothing does
    }
}

/// Writes the certificate of the contact states that decide as `NAME.equilibrium.json`. Files of an
/// earlier run that nothing takes the place of go.
pub(super) fn keep_point(folder: &Folder, point: &FrictionPoint) {
    let mu = point.friction();
    let equilibrium = |name: &str| format!("{name}.equilibrium.json");
    let mut inside = Vec::new();
    let mut has_end = false;
    let deciding = point.deciding().map(|examined| examined.place);
    for examined in &point.examined {
        let name = name_of(mu, examined.place);
        match examined.place {
            PathPlace::Inside(stretch) => inside.push(stretch),
            PathPlace::End => has_end = true,
        }
        match &point.states {
            Some(Ok(states)) if deciding == Some(examined.place) => {
                if let Some(text) = folder.made(states.file()) {
                    folder.keep(&equilibrium(&name), &text);
                }
            }
            _ => folder.drop_earlier(&equilibrium(&name)),
        }
    }

    let at_end = name_of(mu, PathPlace::End);
    folder.keep_only(&format!("{at_end}-stretch"), &inside);
    if !has_end {
        folder.remove_proof(&at_end);
        folder.drop_earlier(&equilibrium(&at_end));
    }
}

/// Writes the proofs about the frozen contact states.
pub(super) fn keep_frozen(folder: &Folder, own: &OwnCritical) {
    for proof in own.frozen.iter().flat_map(|frozen| &frozen.proofs) {
        keep_proof(folder, &format!("frozen-{}", proof.name), proof);
    }
}

fn keep_proof(folder: &Folder, name: &str, proof: &Proof) {
    if let Some(certificate) = folder.made(proof.certificate.file()) {
        folder.keep_proof(name, &proof.problem, &certificate);
    }
}

/// The name of the files of a place on the path at a mu.
fn name_of(mu: &Rational, place: PathPlace) -> String {
    let mu = number_text(mu).replace('/', "over");
    match place {
        PathPlace::End => format!("mu-{mu}"),
        PathPlace::Inside(stretch) => format!("mu-{mu}-stretch-{stretch:03}"),
    }
}

/// Where along mu the loads lead to what, how fast it grows, and the body that decides.
pub(super) fn pictures(own: &OwnCritical) -> Vec<Named> {
    if own.points.is_empty() {
        return Vec::new();
    }

    let mut all = vec![strip(own)];
    all.extend(growth(own));
    all.extend(bodies::of_deciding(own));
    all
}

/// The section of a report: the brackets, the pictures and what was examined.
pub(super) fn section(own: &OwnCritical) -> Section {
    let mut content: Vec<Content> = Vec::new();
    for headline in headlines(own) {
        content.push(Content::Paragraph(headline));
    }
    content.extend(pictures(own).into_iter().map(Named::into_figure));
    content.push(Content::Table {
        caption: format!("What was examined; {LETTERS}"),
        header: HEADER.map(String::from).to_vec(),
        rows: rows_of(own),
    });

    Section {
        title: "Own critical friction".into(),
        content,
    }
}

fn strip(own: &OwnCritical) -> Named {
    let mut samples = Vec::new();
    let mut ranges: Vec<PresenceRange> = Vec::new();
    for point in &own.points {
        let mu = to_f64(point.friction());
        let presence = drawn(point.answer());
        samples.push((mu, presence));
        match ranges.last_mut() {
            Some(range) if range.presence == presence => range.to = Some(mu),
            _ => ranges.push(PresenceRange {
                presence,
                from: mu,
                is_from_included: true,
                to: Some(mu),
                is_proved: false,
            }),
        }
    }

    let critical = match own.bracket() {
        Bracket::Between(_, point) | Bracket::AtMost(point) => Some(to_f64(point.friction())),
        Bracket::Undecided | Bracket::None => None,
    };
    let chart = PresenceChart {
        ranges,
        samples,
        friction: to_f64(own.path_friction()),
        critical,
        words: ["\u{3bc} of the path", "first critical \u{3bc} examined"],
        members: None,
    };
    let title = "Divergence on the path of the loads, against \u{3bc}";
    let picture = presence_picture(title, &chart);
    let caption = "Dots are the \u{3bc} examined: at each of them the loading path is followed. \
                   Between them nothing is claimed; a box joins neighbours with the same answer.";
    Named::chart("own-critical", picture, caption)
}

fn drawn(answer: FrictionAnswer) -> Presence {
    match answer {
        FrictionAnswer::Equilibrium(verdict) => presence_of(verdict),
        FrictionAnswer::NoPath { is_certain: true } => Presence::NoPath,
        FrictionAnswer::NoPath { is_certain: false } => Presence::Undecided,
    }
}

/// The certified growth rates against mu; `None` where there are none.
fn growth(own: &OwnCritical) -> Option<Named> {
    let mut certified = Vec::new();
    for point in &own.points {
        let modes = point.examined.iter().flat_map(|e| e.modes());
        certified.extend(modes.map(|mode| ChartPoint {
            mu: to_f64(point.friction()),
            lambda2: to_f64(&mode.lambda2.mid()),
            support: mode.slipping.clone(),
        }));
    }
    if certified.is_empty() {
        return None;
    }

    let branches = Branches {
        levels: Vec::new(),
        certified,
        absent_below: None,
    };
    let title = "Growth rates in these equilibria, against \u{3bc}";
    let picture = branch_picture(title, &branches);
    let caption = "Every motion that is proved to grow, at each \u{3bc} that was examined.";
    Some(Named::chart("own-critical-growth", picture, caption))
}
