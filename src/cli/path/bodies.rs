//! The body of a loading path: at rest, at the end of each step, and in the equilibrium that
//! decides on the own critical friction.
//!
//! Input: a path, and the places of the nodes; without them there is nothing to draw. Output:
//! pictures of the contact states, whose VTU files have displacements and reactions too. The
//! displacements are in doubles; those of held nodes are what the steps prescribe.

use crate::cli::common::aside;
use crate::cli::pictures::Named;
use crate::picture::{BodyDrawing, BodyUnderLoad};
use crate::say::number_text;
use crate::say::path::amount_text;
use crate::{Bracket, Loads, OwnCritical};
use mceip_exact::{to_f64, without_zeros};
use mceip_model::{ContactState, Coordinates, Particle};
use mceip_path::{Equilibrium, LoadingPath, Stretch};

/// The body at rest as `body`, and under load at the end of each step as `step-NUMBER`, from 1.
pub(super) fn of_path(loads: &Loads, path: &LoadingPath) -> Vec<Named> {
    let (Some(coordinates), Some(first)) = (&loads.as_file().coordinates, path.stretches.first())
    else {
        return Vec::new();
    };

    let particles = in_states(loads, first.equilibrium_states());
    let drawn = BodyDrawing {
        coordinates,
        particles: &particles,
        mode: None,
        load: None,
    };
    let title = "The body at rest, and the contact states with which the path begins";
    let mut all = vec![Named::body("body", title, &drawn, AT_REST)];

    let names = loads.step_names();
    let mut places = Vec::new();
    for stretches in path.stretches.chunk_by(|a, b| a.step == b.step) {
        if let Some(last) = stretches.last() {
            let number = last.step + 1;
            let amount = amount_text(last.last());
            let amount = without_zeros(&amount);
            let step = names[last.step];
            places.push(DrawnEquilibrium {
                name: format!("step-{number:02}"),
                title: format!("Contact states at {amount} of step {step} (the body at rest)"),
                stretch: last,
                at: last.last(),
            });
        }
    }
    all.extend(under_load(loads, path, coordinates, &places));
    all
}

/// The body in the equilibrium that decides at the critical mu, else at the last one that was
/// examined, as `own-critical-body`.
pub(super) fn of_deciding(own: &OwnCritical) -> Vec<Named> {
    let point = match own.bracket() {
        Bracket::Between(_, critical) | Bracket::AtMost(critical) => Some(critical),
        Bracket::Undecided | Bracket::None => own.points.last(),
    };
    let deciding = point.and_then(|point| Some((point, point.deciding()?)));
    let (Some(coordinates), Some((point, examined))) =
        (&own.loads().as_file().coordinates, deciding)
    else {
        return Vec::new();
    };

    let stretch = examined.place.stretch(&point.path);
    let step = own.loads().step_names()[stretch.step];
    let mu = number_text(point.friction());
    let amount = amount_text(&examined.equilibrium);
    let amount = without_zeros(&amount);
    let place = DrawnEquilibrium {
        name: "own-critical-body".into(),
        title: format!(
            "Contact states that decide at \u{3bc} = {mu}: {amount} of step {step} (the body at \
             rest)"
        ),
        stretch,
        at: &examined.equilibrium,
    };
    under_load(own.loads(), &point.path, coordinates, &[place])
}

/// What to read off the body at rest.
const AT_REST: &str = "The body without load, and the contact states in the first stretch.";

/// What to read off the body under load.
const UNDER_LOAD: &str = "The contact states in this equilibrium; the body is drawn at rest. In \
     the VTU file: displacement (where a node is held, what the steps prescribe), reaction, \
     normal_reaction (the force that presses).";

/// An equilibrium that is drawn.
struct DrawnEquilibrium<'a> {
    name: String,
    title: String,
    stretch: &'a Stretch,
    at: &'a Equilibrium,
}

/// The body at these places of a path; none where its displacements are not found, which is told.
fn under_load(
    loads: &Loads,
    path: &LoadingPath,
    coordinates: &Coordinates,
    places: &[DrawnEquilibrium<'_>],
) -> Vec<Named> {
    let equilibria: Vec<_> = places
        .iter()
        .map(|place| (place.stretch, place.at))
        .collect();
    let displacements = match path.displacements(loads.body(), &equilibria) {
        Ok(displacements) => displacements,
        Err(why) => {
            aside(&format!("mceip: the body under load is not drawn: {why}"));
            return Vec::new();
        }
    };

    let mut all = Vec::with_capacity(places.len());
    for (place, displacement) in places.iter().zip(&displacements) {
        let particles = in_states(loads, place.at.contact_states());
        let reactions = place.at.reactions_f64();
        let applied = path.applied_at(place.stretch, place.at);
        let prescribed = coordinates.prescribed_at(&applied).into_iter();
        let prescribed: Vec<_> = prescribed.map(|[x, y]| (to_f64(&x), to_f64(&y))).collect();
        let drawn = BodyDrawing {
            coordinates,
            particles: &particles,
            mode: None,
            load: Some(BodyUnderLoad {
                displacement,
                prescribed: &prescribed,
                reactions: &reactions,
            }),
        };
        let name = place.name.clone();
        all.push(Named::body(name, &place.title, &drawn, UNDER_LOAD));
    }
    all
}

/// The candidates in these states, with the names that the table of events has for them.
fn in_states(loads: &Loads, states: &[ContactState]) -> Vec<Particle> {
    let mut particles = numbered(loads.candidates());
    for (particle, state) in particles.iter_mut().zip(states) {
        particle.state = *state;
    }
    particles
}

/// The particles, those without a name by their numbers from 1.
pub(super) fn numbered(particles: &[Particle]) -> Vec<Particle> {
    let mut particles = particles.to_vec();
    for (node, particle) in particles.iter_mut().enumerate() {
        let number = (node + 1).to_string();
        particle.name.get_or_insert(number);
    }
    particles
}
