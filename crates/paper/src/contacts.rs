//! Contact states of a model of one's own, as a CSV table: what `mceip convert` reads.
//!
//! A header line names the columns, in any order: `tangential`, `normal` (degrees of freedom),
//! `state` (`slip+`: about to slip in the positive direction of its tangential dof, so r_T < 0 and
//! S = -1; `slip-`: the other way, S = 1; `stick`; `free`), and optionally `particle` (a label),
//! `normal_direction` (1: the normal dof is positive into the obstacle, the default; -1: away from
//! it), `reaction_tangential`, `reaction_normal` (the equilibrium's reaction on the body along
//! these dofs, as the finite-element program gives it). Lines that begin with # are comments; a
//! cell may be empty where it is optional.

use crate::tolerance::CONE_SLACK;
use mceip_exact::{Rational, parse, rational};
use mceip_model::{ContactState, Particle, Reaction};
use num_traits::{Signed, Zero};

/// Why a table of contacts is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactsError {
    /// A needed column is missing.
    #[error("contacts: expected a column {column:?} in the header, got {got:?}")]
    MissingColumn {
        /// Its name.
        column: &'static str,
        /// The header.
        got: String,
    },
    /// A column that means nothing, or one named twice.
    #[error(
        "contacts: expected each of particle, tangential, normal, state, normal_direction, \
         reaction_tangential, reaction_normal at most once in the header, got {got:?}"
    )]
    Column {
        /// The name.
        got: String,
    },
    /// A cell cannot be read.
    #[error("contacts line {line}, column {column}: expected {expected}, got {got:?}")]
    Cell {
        /// Line of the file, from 1.
        line: usize,
        /// Name of the column.
        column: &'static str,
        /// What belongs there.
        expected: &'static str,
        /// What stands there.
        got: String,
    },
    /// A line has another number of cells than the header.
    #[error("contacts line {line}: expected {expected} cells, got {got}")]
    Cells {
        /// Line of the file, from 1.
        line: usize,
        /// Cells of the header.
        expected: usize,
        /// Cells of the line.
        got: usize,
    },
    /// A reaction contradicts (7), or the state.
    #[error(
        "E7: contacts line {line}, state {state}: expected {expected}, got r_T = {tangential}, r_N \
         = {normal} along its dofs"
    )]
    Contradiction {
        /// Line of the file, from 1.
        line: usize,
        /// The state.
        state: &'static str,
        /// What (7) wants.
        expected: &'static str,
        /// Reaction along the tangential dof.
        tangential: String,
        /// Reaction along the normal dof.
        normal: String,
    },
    /// No particle.
    #[error("contacts: expected at least one particle, got none")]
    Empty,
}

const COLUMNS: [&str; 7] = [
    "particle",
    "tangential",
    "normal",
    "state",
    "normal_direction",
    "reaction_tangential",
    "reaction_normal",
];

/// Reads the table. `dof` finds the 0-based degree of freedom that a cell names (an index, or a
/// node and direction of a `.dof` file).
///
/// A reaction is held against (7) with a relative slack, for it comes from floats, and kept in the
/// particle only where it satisfies (7) exactly.
///
/// # Errors
/// [`ContactsError`] with line and column.
pub fn read_contacts(
    text: &str,
    friction: &Rational,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<Vec<Particle>, ContactsError> {
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, l)| (i + 1, l.trim_start_matches('\u{feff}').trim()));
    let mut lines = lines
        .by_ref()
        .filter(|(_, l)| !l.is_empty() && !l.starts_with('#'));
    let header = lines.next().map_or("", |l| l.1);
    let table = Table::new(header)?;
    let particles = lines
        .map(|(line, text)| table.particle(line, text, friction, dof))
        .collect::<Result<Vec<_>, _>>()?;
    if particles.is_empty() {
        Err(ContactsError::Empty)
    } else {
        Ok(particles)
    }
}

/// Place of each column, in the order of [`COLUMNS`].
struct Table {
    place: [Option<usize>; 7],
    width: usize,
}

impl Table {
    fn new(header: &str) -> Result<Table, ContactsError> {
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        let mut place = [None; 7];
        for (k, name) in names.iter().enumerate() {
            match COLUMNS.iter().position(|c| c == name) {
                Some(c) if place[c].is_none() => place[c] = Some(k),
                _ => return Err(ContactsError::Column { got: cut(name) }),
            }
        }
        match (1..4).find(|&c| place[c].is_none()) {
            Some(c) => Err(ContactsError::MissingColumn {
                column: COLUMNS[c],
                got: cut(header),
            }),
            None => Ok(Table {
                place,
                width: names.len(),
            }),
        }
    }

    fn particle(
        &self,
        line: usize,
        text: &str,
        mu: &Rational,
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<Particle, ContactsError> {
        let cells: Vec<&str> = text.split(',').map(str::trim).collect();
        if cells.len() != self.width {
            return Err(ContactsError::Cells {
                line,
                expected: self.width,
                got: cells.len(),
            });
        }
        let cell = |c: usize| self.place[c].map(|k| cells[k]).filter(|t| !t.is_empty());
        let bad = |c: usize, expected| ContactsError::Cell {
            line,
            column: COLUMNS[c],
            expected,
            got: cut(cell(c).unwrap_or("")),
        };
        let index = |c: usize| {
            cell(c)
                .and_then(dof)
                .ok_or_else(|| bad(c, "a degree of freedom of the model"))
        };
        let number = |c: usize| {
            cell(c)
                .map(|t| parse(t).map_err(|_| bad(c, "a number")))
                .transpose()
        };
        let state = match cell(3) {
            Some("slip+") => ContactState::Slip { sign: -1 },
            Some("slip-") => ContactState::Slip { sign: 1 },
            Some("stick") => ContactState::Stick,
            Some("free") => ContactState::Free,
            _ => return Err(bad(3, "slip+, slip-, stick or free")),
        };
        let normal_direction = match cell(4) {
            None | Some("1" | "+1") => 1,
            Some("-1") => -1,
            Some(_) => return Err(bad(4, "1 or -1")),
        };
        let reaction = match (number(5)?, number(6)?) {
            (Some(t), Some(n)) => {
                let exact = held_against_the_cone(line, state, &t, &n, normal_direction, mu)?;
                exact.then(|| Reaction {
                    tangential: t,
                    normal: n * Rational::from_integer(normal_direction.into()),
                })
            }
            (None, None) => None,
            (Some(_), None) => return Err(bad(6, "a number beside reaction_tangential")),
            (None, Some(_)) => return Err(bad(5, "a number beside reaction_normal")),
        };
        Ok(Particle {
            tangential: index(1)?,
            normal: index(2)?,
            state,
            normal_direction,
            frame: None,
            reaction,
        })
    }
}

/// (7) and the state with a relative slack; true if they hold exactly as well.
fn held_against_the_cone(
    line: usize,
    state: ContactState,
    t: &Rational,
    n: &Rational,
    direction: i8,
    mu: &Rational,
) -> Result<bool, ContactsError> {
    let pressure = -(n * Rational::from_integer(direction.into())); // -r_N >= 0 in contact
    let cone = mu * &pressure;
    let slack = &cone.abs() * rational(CONE_SLACK.0, CONE_SLACK.1);
    let excess = t.abs() - &cone;
    let (expected, exact) = match state {
        ContactState::Free => (
            if n.is_zero() && t.is_zero() {
                None
            } else {
                Some("no reaction")
            },
            true,
        ),
        _ if !pressure.is_positive() => (
            Some("a reaction that pushes the body off the obstacle (see normal_direction)"),
            false,
        ),
        ContactState::Stick => (
            (excess > slack).then_some("|r_T| < mu |r_N|"),
            excess.is_negative(),
        ),
        ContactState::Slip { sign } if t.signum() != Rational::from_integer(sign.into()) => {
            (Some("r_T against the impending slip"), false)
        }
        ContactState::Slip { .. } => (
            (excess.abs() > slack).then_some("|r_T| = mu |r_N|"),
            excess.is_zero(),
        ),
    };
    let short = |v: &Rational| cut(&v.to_string());
    match expected {
        Some(expected) => Err(ContactsError::Contradiction {
            line,
            state: state.word(),
            expected,
            tangential: short(t),
            normal: short(n),
        }),
        None => Ok(exact),
    }
}

fn cut(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(60).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    fn read(text: &str) -> Result<Vec<Particle>, ContactsError> {
        read_contacts(text, &rational(1, 2), &|t| {
            t.parse().ok().filter(|d| *d < 10)
        })
    }

    const HEADER: &str =
        "particle,tangential,normal,state,normal_direction,reaction_tangential,reaction_normal\n";

    #[test]
    fn states_signs_and_directions() {
        let text = format!(
            "# a comment\n{HEADER}a,0,1,slip+,,-1,-2\nb, 2, 3, slip-, -1, 1.0000001, \
             2\n\nc,4,5,stick,1,,\nd,6,7,free,,0,0\n"
        );
        let p = read(&text).unwrap();
        assert_eq!(p[0].state, ContactState::Slip { sign: -1 });
        assert_eq!(
            p[0].reaction,
            Some(Reaction {
                tangential: whole(-1),
                normal: whole(-2)
            })
        );
        assert_eq!(
            (p[1].state, p[1].normal_direction),
            (ContactState::Slip { sign: 1 }, -1)
        );
        assert_eq!(p[1].reaction, None); // on the cone within the slack, not exactly
        assert_eq!(
            (p[2].state, p[3].state),
            (ContactState::Stick, ContactState::Free)
        );
        assert_eq!(
            read("state,normal,tangential\nstick,1,0\n").unwrap()[0].tangential,
            0
        );
    }

    #[test]
    fn contradictions_with_7_are_refused() {
        for line in [
            "a,0,1,slip+,,1,-2",
            "a,0,1,slip-,,0.9,-2",
            "a,0,1,slip-,,1,2",
            "a,0,1,stick,,1.1,-2",
            "a,0,1,free,,0,-1",
        ] {
            assert!(
                matches!(
                    read(&format!("{HEADER}{line}\n")),
                    Err(ContactsError::Contradiction { line: 2, .. })
                ),
                "{line}"
            );
        }
    }

    #[test]
    fn malformed_tables_name_line_and_column() {
        assert!(matches!(
            read("tangential,normal\n0,1\n"),
            Err(ContactsError::MissingColumn {
                column: "state",
                ..
            })
        ));
        assert!(matches!(
            read("tangential,normal,state,colour\n"),
            Err(ContactsError::Column { .. })
        ));
        assert!(matches!(read(HEADER), Err(ContactsError::Empty)));
        assert!(matches!(
            read(&format!("{HEADER}a,0,1,stick\n")),
            Err(ContactsError::Cells {
                line: 2,
                expected: 7,
                got: 4
            })
        ));
        for (line, column) in [
            ("a,0,99,stick,,,", "normal"),
            ("a,0,1,slip,,,", "state"),
            ("a,0,1,stick,2,,", "normal_direction"),
            ("a,0,1,stick,,x,1", "reaction_tangential"),
            ("a,0,1,stick,,1,", "reaction_normal"),
        ] {
            assert!(
                matches!(read(&format!("{HEADER}{line}\n")), Err(ContactsError::Cell { line: 2, column: c, .. }) if c == column),
                "{line}"
            );
        }
    }
}
