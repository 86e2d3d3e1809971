//! Contacts as Python gives them: a list of `mceip.Contact`, or a table as text.

use crate::MceipError;
use crate::number;
use mceip::{ContactState, Particle, Rational};
use mceip_paper::{ContactTable, make_frames_exact, read_contacts};
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
}

impl Contacts {
    /// The particles, with names and reactions where a table has them; `friction` is what these
    /// reactions are held against, (7).
    pub(crate) fn table(self, dofs: usize, friction: Option<&Rational>) -> PyResult<ContactTable> {
        match self {
            Contacts::Table(text) => of_table(&text, dofs, friction),
            Contacts::List(contacts) => of_list(contacts),
        }
    }
}

fn of_table(text: &str, dofs: usize, friction: Option<&Rational>) -> PyResult<ContactTable> {
    let frictionless = Rational::from_integer(0.into());
    let friction = match friction {
        Some(friction) => friction,
        None if text.contains("reaction_") => {
            return Err(MceipError::new_err(
                "contacts: expected a table without reactions where no friction is given, for \
                 they are held against it, got one with reactions",
            ));
        }
        None => &frictionless,
    };

    let dof = |name: &str| name.parse().ok().filter(|dof| *dof < dofs);
    let table = read_contacts(text, friction, &dof);
    table.map_err(|e| MceipError::new_err(e.to_string()))
}

fn of_list(contacts: Vec<Contact>) -> PyResult<ContactTable> {
    let particles = contacts.into_iter().enumerate().map(of_entry);
    let mut particles: Vec<Particle> = particles.collect::<PyResult<_>>()?;
    make_frames_exact(&mut particles);

    Ok(ContactTable {
        reactions: vec![None; particles.len()],
        particles,
    })
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
    if let Some([[a, b], [c, d]]) = contact.frame {
        let entry = |text: &str| number("frame", text);
        particle.frame = Some([[entry(&a)?, entry(&b)?], [entry(&c)?, entry(&d)?]]);
    }
    Ok(particle)
}
