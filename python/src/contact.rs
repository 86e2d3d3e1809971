//! Contacts as Python gives them: a list of `mceip.Contact`, or a table as text.

use crate::MceipError;
use crate::number;
use mceip::{ContactState, Particle, Rational};
use mceip_paper::{ContactTable, ReactionPlace, make_frames_exact, read_contacts, with_reaction};
use pyo3::prelude::*;

/// The contacts of a mechanical system.
#[derive(FromPyObject)]
pub(crate) enum Contacts {
    /// The text of a table, as `mceip convert` reads it.
    Table(String),
    /// One entry for each particle.
    List(Vec<Contact>),
}

/// What is read of a `mceip.Contact`.
#[derive(FromPyObject)]
pub(crate) struct Contact {
    tangential: usize,
    normal: usize,
    state: String,
    sign: Option<i8>,
    normal_direction: i8,
    frame: Option<[[String; 2]; 2]>,
    friction_factor: String,
    name: Option<String>,
    reaction_tangential: Option<String>,
    reaction_normal: Option<String>,
    friction_factor_range: Option<[String; 2]>,
    curvature: String,
}

impl Contacts {
    /// The particles, with names and reactions where a table has them; `friction` is what these
    /// reactions are held against, (7).
    pub(crate) fn table(self, dofs: usize, friction: Option<&Rational>) -> PyResult<ContactTable> {
        match self {
            Contacts::Table(text) => of_table(&text, dofs, friction),
            Contacts::List(contacts) => of_list(contacts, friction),
        }
    }
}

/// Reactions are held against the friction, so that there is one.
fn require_friction(friction: Option<&Rational>, has_reactions: bool) -> PyResult<Rational> {
    match friction {
        Some(friction) => Ok(friction.clone()),
        None if has_reactions => Err(MceipError::new_err(
            "contacts: expected no reactions where no friction is given, for they are held \
             against it, got some",
        )),
        None => Ok(Rational::from_integer(0.into())),
    }
}

fn of_table(text: &str, dofs: usize, friction: Option<&Rational>) -> PyResult<ContactTable> {
    let friction = require_friction(friction, text.contains("reaction_"))?;
    let dof = |name: &str| name.parse().ok().filter(|dof| *dof < dofs);
    let table = read_contacts(text, &friction, &dof);
    table.map_err(|e| MceipError::new_err(e.to_string()))
}

fn of_list(contacts: Vec<Contact>, friction: Option<&Rational>) -> PyResult<ContactTable> {
    let given = contacts.iter().enumerate().map(reaction);
    let given: Vec<Option<[Rational; 2]>> = given.collect::<PyResult<_>>()?;
    let friction = require_friction(friction, given.iter().any(Option::is_some))?;
    let curvatures = contacts.iter().map(|c| number("curvature", &c.curvature));
    let curvatures: Vec<Rational> = curvatures.collect::<PyResult<_>>()?;
    let particles = contacts.into_iter().enumerate().map(of_entry);
    let mut particles: Vec<Particle> = particles.collect::<PyResult<_>>()?;
    make_frames_exact(&mut particles);

    let mut reactions = vec![None; particles.len()];
    for (index, (along_dofs, curvature)) in given.into_iter().zip(curvatures).enumerate() {
        let place = ReactionPlace::Entry(index);
        let particle = particles[index].clone();
        let held = with_reaction(particle, along_dofs, curvature, &friction, place);
        (particles[index], reactions[index]) =
            held.map_err(|e| MceipError::new_err(e.to_string()))?;
    }

    Ok(ContactTable {
        particles,
        reactions,
    })
}

/// Both components of the reaction, or none.
fn reaction((index, contact): (usize, &Contact)) -> PyResult<Option<[Rational; 2]>> {
    match (&contact.reaction_tangential, &contact.reaction_normal) {
        (Some(tangential), Some(normal)) => Ok(Some([
            number("reaction_tangential", tangential)?,
            number("reaction_normal", normal)?,
        ])),
        (None, None) => Ok(None),
        _ => Err(MceipError::new_err(format!(
            "contact {index}: expected both reaction_tangential and reaction_normal, or none, \
             got one"
        ))),
    }
}

fn of_entry((index, contact): (usize, Contact)) -> PyResult<Particle> {
    let state = match (contact.state.as_str(), contact.sign) {
        ("slip", Some(sign)) => ContactState::Slip { sign },
        // About to slip in the positive direction: the reaction points the other way.
        ("slip+", None) => ContactState::Slip { sign: -1 },
        ("slip-", None) => ContactState::Slip { sign: 1 },
        ("stick", None) => ContactState::Stick,
        ("free", None) => ContactState::Free,
        ("zero", None) => ContactState::Zero,
        (state, sign) => {
            let sign = sign.map_or("none".to_owned(), |sign| sign.to_string());
            return Err(MceipError::new_err(format!(
                "contact {index}: expected the state \"slip+\", \"slip-\", \"stick\", \"free\" \
                 or \"zero\", or \"slip\" with the sign of its reaction, got {state:?}, sign {sign}"
            )));
        }
    };

    let mut particle = Particle::plain(contact.tangential, contact.normal, state);
    particle.name = contact.name.filter(|name| !name.is_empty());
    particle.normal_direction = contact.normal_direction;
    particle.friction_factor = number("friction_factor", &contact.friction_factor)?;
    if let Some([least, greatest]) = contact.friction_factor_range {
        let end = |text: &str| number("friction_factor_range", text);
        particle.friction_factor_range = Some([end(&least)?, end(&greatest)?]);
    }
    if let Some([[a, b], [c, d]]) = contact.frame {
        let entry = |text: &str| number("frame", text);
        particle.frame = Some([[entry(&a)?, entry(&b)?], [entry(&c)?, entry(&d)?]]);
    }
    Ok(particle)
}
