//! `mceip path --own-critical`: its options, and its certificates in a folder.

use crate::cli::common::{CliError, positive};
use crate::cli::output::Folder;
use crate::say::mu_text;
use crate::{Certificate, FrictionGrid, FrictionGridError, FrictionPoint, OwnCritical};
use mceip_engine::analysis::Proof;
use mceip_engine::run::Kept;
use mceip_exact::Rational;

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
    let least = positive("own-critical", least)?;
    let greatest = positive("own-critical", greatest)?;
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
pub(super) fn earlier(folder: &Folder, mu: &Rational) -> Option<Certificate> {
    let path = folder.certificate_path(&name_of(mu));
    let text = std::fs::read_to_string(path).ok()?;
    Certificate::from_json(&text).ok()
}

/// Writes the certificate of the contact states as `mu-VALUE.equilibrium.json`, and the proof
/// about divergence, where there is one, as `mu-VALUE.problem.json` and
/// `mu-VALUE.certificate.json`. Files of an earlier run that nothing takes the place of go.
pub(super) fn keep_point(folder: &Folder, point: &FrictionPoint) {
    let name = name_of(point.friction());
    let end = point.end_state.as_ref();

    let equilibrium = format!("{name}.equilibrium.json");
    match end.and_then(|end| end.states.as_ref().ok()) {
        Some(states) => {
            if let Some(text) = folder.made(states.file()) {
                folder.keep(&equilibrium, &text);
            }
        }
        None => folder.drop_earlier(&equilibrium),
    }
    match end.and_then(|end| end.proof.as_ref()) {
        Some(proof) => keep_proof(folder, &name, proof),
        None => folder.remove_proof(&name), // no path, or a theorem: nothing slips
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
        folder.keep_proof(&Kept {
            name,
            problem: &proof.problem,
            certificate: &certificate,
        });
    }
}

/// The name of the files of a mu.
fn name_of(mu: &Rational) -> String {
    format!("mu-{}", mu_text(mu).replace('/', "over"))
}
