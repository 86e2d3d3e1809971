//! Contact states of a model of one's own, as a CSV table: what `mceip convert` reads.
//!
//! A header line names the columns, in any order. Needed are `tangential`, `normal` (degrees of
//! freedom) and `state`: `slip+` (about to slip in the positive direction of its tangent, so r_T <
//! 0 and S = -1), `slip-` (the other way, S = 1), `stick`, `free`, or `zero` (in contact, no
//! reaction). Optional are
//!
//! * `particle`: a name;
//! * `normal_direction`: 1 if the normal dof is positive into the obstacle (default), -1 if it is
//!   positive away from it;
//! * `angle`: degrees by which the obstacle's tangent is turned from the tangential dof towards the
//!   normal dof;
//! * `normal_x`, `normal_y`, in place of these two: the normal into the obstacle, along the
//!   tangential and the normal dof;
//! * `friction_factor`: the friction of this particle over mu, > 0; 1 by default;
//! * `reaction_tangential`, `reaction_normal`: the reaction on the body along these dofs, as the
//!   finite-element program gives it;
//! * `curvature`: of the obstacle, 1 / R on a cylinder of radius R, positive where it is convex. It
//!   counts where a particle slips, with its reaction (`spec/curvature.md`).
//!
//! Of contact candidates under loads ([`read_candidates`]) states and reactions are not known, and
//! obstacles are flat: there are no such columns. `gap` may hold the distance from the obstacle in
//! the unloaded body.
//!
//! Lines that begin with # are comments; a cell may be empty where it is optional.
//!
//! The particles go into a `System`. A reaction guards against a wrong sign or another mu: it has
//! to satisfy (7), |r_T| <= mu |r_N|, with equality for slip. Directions become exact rotations
//! (`rotation.rs`).

use crate::lines::{TextLine, lines_with_content, shown};
use crate::plausibility::with_five_digits;
use crate::rotation::{Frame, rotation_along, rotation_by_degrees};
use crate::table::ColumnPlaces;
use crate::tolerance::CONE_SLACK;
use mceip_exact::{Rational, parse, rational, to_f64, whole};
use mceip_model::{ContactCandidate, ContactState, Curvature, Particle, Reaction};
use num_traits::{One, Signed, Zero};
use std::fmt::{self, Display, Formatter};

/// The column that the beginning of a name stands for, as a clause.
fn meant_column(got: &str) -> String {
    const LEAST: usize = 4;

    let beginning: String = got.chars().take(LEAST).collect();
    let names = Column::ALL.map(Column::name).into_iter();
    let mut meant = names.filter(|name| beginning.len() == LEAST && name.starts_with(&beginning));
    match meant.next() {
        Some(name) if name != got => format!(" ({name}?)"),
        _ => String::new(),
    }
}

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
        "contacts: expected columns in the first line, each of {} at most once, got {got:?}{}",
        Column::ALL.map(Column::name).join(", "),
        meant_column(got)
    )]
    Column {
        /// The name.
        got: String,
    },
    /// The cells are not separated by commas.
    #[error(
        "contacts: expected cells separated by commas and numbers with a decimal point, got \
         {got:?} between the cells; write the table as CSV in English, or exchange decimal commas \
         for points first and then {got:?} for commas"
    )]
    Separator {
        /// What stands between the cells.
        got: char,
    },
    /// A direction is given in two ways, or half.
    #[error(
        "contacts line {line}: expected either angle, or normal_x and normal_y without \
         normal_direction, got {got}"
    )]
    Direction {
        /// Line of the file, from 1.
        line: usize,
        /// The columns that have a number.
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
        "E7: {place}, state {state}: expected {expected}, got r_T = {tangential} \
         along the tangent, r_N = {normal} along the normal into the obstacle"
    )]
    Contradiction {
        /// Where the reaction stands.
        place: ReactionPlace,
        /// The state.
        state: &'static str,
        /// What (7) wants.
        expected: &'static str,
        /// Reaction along the tangent.
        tangential: String,
        /// Reaction along the normal into the obstacle.
        normal: String,
    },
    /// A reaction off the friction cone, or outside of it.
    #[error(
        "E7: {place}, state {state}: expected {expected}, that is |r_T| / |r_N| \
         {ratio} {friction} (mu times the friction factor), got {got} (r_T = {tangential} along \
         the tangent, r_N = {normal} along the normal into the obstacle)"
    )]
    OffCone {
        /// Where the reaction stands.
        place: ReactionPlace,
        /// The state.
        state: &'static str,
        /// What (7) wants.
        expected: &'static str,
        /// How |r_T| / |r_N| and the friction compare then.
        ratio: &'static str,
        /// mu times the friction factor.
        friction: String,
        /// |r_T| / |r_N|.
        got: String,
        /// Reaction along the tangent.
        tangential: String,
        /// Reaction along the normal into the obstacle.
        normal: String,
    },
    /// A particle slips along a curved obstacle, and its reaction is not given.
    #[error(
        "{place}: expected reaction_tangential and reaction_normal beside the curvature of a \
         particle that slips, for its reaction turns with the obstacle; got none"
    )]
    CurvatureWithoutReaction {
        /// Where the curvature stands.
        place: ReactionPlace,
    },
    /// No particle.
    #[error("contacts: expected at least one particle, got none")]
    Empty,
    /// A column of the other kind of table.
    #[error("contacts: expected no column {column:?}: {why}")]
    OfOtherTable {
        /// Its name.
        column: &'static str,
        /// Why it plays no part.
        why: &'static str,
    },
}

/// A column of the table.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Column {
    Particle,
    Tangential,
    Normal,
    State,
    NormalDirection,
    Angle,
    NormalX,
    NormalY,
    FrictionFactor,
    ReactionTangential,
    ReactionNormal,
    Curvature,
    Gap,
}

impl Column {
    /// Every column, in the order of the variants.
    const ALL: [Column; 13] = [
        Column::Particle,
        Column::Tangential,
        Column::Normal,
        Column::State,
        Column::NormalDirection,
        Column::Angle,
        Column::NormalX,
        Column::NormalY,
        Column::FrictionFactor,
        Column::ReactionTangential,
        Column::ReactionNormal,
        Column::Curvature,
        Column::Gap,
    ];

    fn name(self) -> &'static str {
        match self {
            Column::Particle => "particle",
            Column::Tangential => "tangential",
            Column::Normal => "normal",
            Column::State => "state",
            Column::NormalDirection => "normal_direction",
            Column::Angle => "angle",
            Column::NormalX => "normal_x",
            Column::NormalY => "normal_y",
            Column::FrictionFactor => "friction_factor",
            Column::ReactionTangential => "reaction_tangential",
            Column::ReactionNormal => "reaction_normal",
            Column::Curvature => "curvature",
            Column::Gap => "gap",
        }
    }
}

/// A table of contacts, read.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactTable {
    /// One for each line.
    pub particles: Vec<Particle>,
    /// For each particle, the reaction that the table gives.
    pub reactions: Vec<Option<TableReaction>>,
}

/// A reaction of a finite-element program.
#[derive(Debug, Clone, PartialEq)]
pub struct TableReaction {
    /// On the body, along the tangential and the normal dof.
    pub along_dofs: [Rational; 2],
    /// |r_T| over mu |r_N|, mu that of the particle; none where one of the two factors is zero.
    pub cone_ratio: Option<f64>,
}

/// Where a reaction stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReactionPlace {
    /// A line of a table, from 1.
    Line(usize),
    /// An entry of a list, from 0.
    Entry(usize),
}

impl Display for ReactionPlace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            ReactionPlace::Line(line) => write!(f, "contacts line {line}"),
            ReactionPlace::Entry(entry) => write!(f, "contact {entry}"),
        }
    }
}

/// Reads the table. `dof` finds the 0-based degree of freedom that a cell names (an index, or a
/// node and direction of a `.dof` file).
///
/// A reaction is held against (7) as [`with_reaction`] does it.
///
/// # Errors
/// [`ContactsError`] with line and column.
pub fn read_contacts(
    text: &str,
    friction: &Rational,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<ContactTable, ContactsError> {
    let rows = read_rows(text, &CONTACTS, &|row| row.particle(friction, dof))?;
    let (particles, reactions) = rows.into_iter().unzip();

    Ok(ContactTable {
        particles,
        reactions,
    })
}

/// Reads a table of contact candidates, one for each line, whose states follow from loads; see
/// [`read_contacts`].
///
/// # Errors
/// [`ContactsError`] with line and column.
pub fn read_candidates(
    text: &str,
    dof: &dyn Fn(&str) -> Option<usize>,
) -> Result<Vec<ContactCandidate>, ContactsError> {
    read_rows(text, &CANDIDATES, &|row| row.candidate(dof))
}

/// What each line of a table says.
fn read_rows<T>(
    text: &str,
    columns: &Columns,
    read: &dyn Fn(&ContactRow<'_>) -> Result<T, ContactsError>,
) -> Result<Vec<T>, ContactsError> {
    let mut lines = lines_with_content(text).into_iter();
    let header = lines.next().map_or("", |line| line.text);
    let places = places_of(header, columns)?;

    let mut rows = Vec::new();
    for line in lines {
        let row = ContactRow::cut(&line, &places)?;
        rows.push(read(&row)?);
    }

    if rows.is_empty() {
        return Err(ContactsError::Empty);
    }
    Ok(rows)
}

/// The columns of a kind of table.
struct Columns {
    /// Those without which there is no table.
    needed: &'static [Column],
    /// Those that it does not have, and why.
    foreign: &'static [Column],
    why: &'static str,
}

const CONTACTS: Columns = Columns {
    needed: &[Column::Tangential, Column::Normal, Column::State],
    foreign: &[Column::Gap],
    why: "a contact state says whether a gap is open; gaps belong to the candidates of a body \
          under loads",
};

const CANDIDATES: Columns = Columns {
    needed: &[Column::Tangential, Column::Normal],
    foreign: &[
        Column::State,
        Column::ReactionTangential,
        Column::ReactionNormal,
        Column::Curvature,
    ],
    why: "under loads the states and reactions follow from them, and obstacles are flat",
};

/// Where the columns stand, in the order of [`Column::ALL`]; refuses a header without those needed
/// and one with those of another kind of table.
fn places_of(header: &str, columns: &Columns) -> Result<ColumnPlaces<13>, ContactsError> {
    if !header.contains(',')
        && let Some(got) = header.chars().find(|c| matches!(c, ';' | '\t'))
    {
        return Err(ContactsError::Separator { got });
    }

    if header.trim().is_empty() {
        return Err(ContactsError::MissingColumn {
            column: columns.needed[0].name(),
            got: String::new(),
        });
    }

    let names = Column::ALL.map(Column::name);
    let places = ColumnPlaces::of(header, &names)
        .map_err(|name| ContactsError::Column { got: shown(name) })?;

    for column in columns.needed {
        if !places.has(*column as usize) {
            return Err(ContactsError::MissingColumn {
                column: column.name(),
                got: shown(header),
            });
        }
    }
    for column in columns.foreign {
        if places.has(*column as usize) {
            return Err(ContactsError::OfOtherTable {
                column: column.name(),
                why: columns.why,
            });
        }
    }

    Ok(places)
}

/// A line of the table, cut into cells.
struct ContactRow<'a> {
    /// Line of the file, from 1.
    line: usize,
    /// What stands in each column, in the order of [`Column::ALL`].
    cells: [&'a str; 13],
}

impl<'a> ContactRow<'a> {
    fn cut(line: &TextLine<'a>, places: &ColumnPlaces<13>) -> Result<Self, ContactsError> {
        let cells = places
            .cells(line.text)
            .map_err(|got| ContactsError::Cells {
                line: line.number,
                expected: places.width,
                got,
            })?;

        Ok(ContactRow {
            line: line.number,
            cells,
        })
    }

    /// The particle, and the reaction as the table gives it.
    fn particle(
        &self,
        friction: &Rational,
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<(Particle, Option<TableReaction>), ContactsError> {
        let state = self.state()?;
        let place = ReactionPlace::Line(self.line);
        let along_dofs = self.reaction()?;
        let curvature = self.number(Column::Curvature)?.unwrap_or_default();
        let particle = self.without_reaction(state, dof)?;
        with_reaction(particle, along_dofs, curvature, friction, place)
    }

    /// A candidate, whose state and reaction are not known.
    fn candidate(
        &self,
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<ContactCandidate, ContactsError> {
        let gap = self.number(Column::Gap)?.unwrap_or_default();
        if gap.is_negative() {
            return Err(self.unexpected(Column::Gap, "a number >= 0"));
        }

        let particle = self.without_reaction(ContactState::Free, dof)?;
        Ok(ContactCandidate { particle, gap })
    }

    /// The particle in a state, whatever its reaction.
    fn without_reaction(
        &self,
        state: ContactState,
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<Particle, ContactsError> {
        let directions = self.directions()?;
        let tangential = self.dof(Column::Tangential, dof)?;
        let normal = self.dof(Column::Normal, dof)?;
        Ok(Particle {
            normal_direction: directions.normal_direction,
            frame: directions.frame,
            friction_factor: self.friction_factor()?,
            name: self.cell(Column::Particle).map(String::from),
            ..Particle::plain(tangential, normal, state)
        })
    }

    /// What stands in a column, if it is there and not empty.
    fn cell(&self, column: Column) -> Option<&str> {
        let text = self.cells[column as usize];
        (!text.is_empty()).then_some(text)
    }

    /// The error that something else was expected in a column.
    fn unexpected(&self, column: Column, expected: &'static str) -> ContactsError {
        ContactsError::Cell {
            line: self.line,
            column: column.name(),
            expected,
            got: shown(self.cell(column).unwrap_or("")),
        }
    }

    fn dof(
        &self,
        column: Column,
        dof: &dyn Fn(&str) -> Option<usize>,
    ) -> Result<usize, ContactsError> {
        self.cell(column).and_then(dof).ok_or_else(|| {
            self.unexpected(column, "a degree of freedom of the model, numbered from 0")
        })
    }

    fn number(&self, column: Column) -> Result<Option<Rational>, ContactsError> {
        let Some(text) = self.cell(column) else {
            return Ok(None);
        };
        match parse(text) {
            Ok(value) => Ok(Some(value)),
            Err(_) => Err(self.unexpected(column, "a number")),
        }
    }

    fn state(&self) -> Result<ContactState, ContactsError> {
        match self.cell(Column::State) {
            Some("slip+") => Ok(ContactState::Slip { sign: -1 }),
            Some("slip-") => Ok(ContactState::Slip { sign: 1 }),
            Some("stick") => Ok(ContactState::Stick),
            Some("free") => Ok(ContactState::Free),
            Some("zero") => Ok(ContactState::Zero),
            _ => Err(self.unexpected(Column::State, "slip+, slip-, stick, free or zero")),
        }
    }

    fn normal_direction(&self) -> Result<i8, ContactsError> {
        match self.cell(Column::NormalDirection) {
            None | Some("1" | "+1") => Ok(1),
            Some("-1") => Ok(-1),
            Some(_) => Err(self.unexpected(Column::NormalDirection, "1 or -1")),
        }
    }

    fn friction_factor(&self) -> Result<Rational, ContactsError> {
        match self.number(Column::FrictionFactor)? {
            None => Ok(Rational::one()),
            Some(factor) if factor.is_positive() => Ok(factor),
            Some(_) => Err(self.unexpected(Column::FrictionFactor, "a number > 0")),
        }
    }

    /// The tangent and the normal of the obstacle, in the directions of the dofs.
    fn directions(&self) -> Result<Directions, ContactsError> {
        let normal_direction = self.normal_direction()?;
        let angle = self.number(Column::Angle)?;
        let x = self.number(Column::NormalX)?;
        let y = self.number(Column::NormalY)?;

        let frame = match (angle, x, y) {
            (None, None, None) => None,
            (Some(angle), None, None) => {
                let within_a_turn = &angle - whole(360) * (&angle / whole(360)).trunc();
                let frame = rotation_by_degrees(to_f64(&within_a_turn));
                Some(frame.ok_or_else(|| self.unexpected(Column::Angle, "degrees"))?)
            }
            (None, Some(x), Some(y)) if self.cell(Column::NormalDirection).is_none() => {
                // The normal (x, y) is the tangent (y, -x) turned by 90 degrees.
                let frame = rotation_along(to_f64(&y), to_f64(&-x));
                Some(frame.ok_or_else(|| self.unexpected(Column::NormalX, "a direction"))?)
            }
            _ => return Err(self.two_directions()),
        };

        Ok(Directions {
            normal_direction,
            frame,
        })
    }

    /// The error of a direction that is given in two ways, or half.
    fn two_directions(&self) -> ContactsError {
        let columns = [
            Column::NormalDirection,
            Column::Angle,
            Column::NormalX,
            Column::NormalY,
        ];
        let given = columns
            .into_iter()
            .filter(|column| self.cell(*column).is_some());

        ContactsError::Direction {
            line: self.line,
            got: given.map(Column::name).collect::<Vec<_>>().join(", "),
        }
    }

    /// Both components of the reaction, or none.
    fn reaction(&self) -> Result<Option<[Rational; 2]>, ContactsError> {
        let tangential = self.number(Column::ReactionTangential)?;
        let normal = self.number(Column::ReactionNormal)?;
        match (tangential, normal) {
            (Some(tangential), Some(normal)) => Ok(Some([tangential, normal])),
            (None, None) => Ok(None),
            (Some(_), None) => {
                let expected = "a number beside reaction_tangential";
                Err(self.unexpected(Column::ReactionNormal, expected))
            }
            (None, Some(_)) => {
                let expected = "a number beside reaction_normal";
                Err(self.unexpected(Column::ReactionTangential, expected))
            }
        }
    }
}

/// The directions of the obstacle at a particle.
struct Directions {
    /// 1: the normal of the frame, or without one the normal dof, points into the obstacle; -1: out
    /// of it.
    normal_direction: i8,
    frame: Option<Frame>,
}

/// The particle on an obstacle of this curvature, with a reaction on the body along its tangential
/// and its normal dof, if there is one, as a finite-element program gives it.
///
/// The reaction is held against (7) and the state with a relative slack, for it comes from floats,
/// and kept in the particle only where it satisfies (7) exactly. The curvature counts where the
/// particle slips: its normal reaction turns with the obstacle, and is needed.
///
/// # Errors
/// [`ContactsError::Contradiction`], [`ContactsError::OffCone`] and
/// [`ContactsError::CurvatureWithoutReaction`]; `place` is named in them.
pub fn with_reaction(
    particle: Particle,
    along_dofs: Option<[Rational; 2]>,
    curvature: Rational,
    friction: &Rational,
    place: ReactionPlace,
) -> Result<(Particle, Option<TableReaction>), ContactsError> {
    let slips = matches!(particle.state, ContactState::Slip { .. });
    let turns = slips && !curvature.is_zero();
    let Some(along_dofs) = along_dofs else {
        return match turns {
            true => Err(ContactsError::CurvatureWithoutReaction { place }),
            false => Ok((particle, None)),
        };
    };

    let given = GivenReaction::at(&particle, &along_dofs);
    let own_friction = friction * &particle.friction_factor;
    let is_exact = given.fits(place, particle.state, &own_friction)?;

    let reaction = TableReaction {
        cone_ratio: given.cone_ratio(&own_friction),
        along_dofs,
    };
    let curvature = turns.then(|| Curvature {
        value: curvature,
        normal_reaction: given.normal.clone(),
    });
    let in_particle = is_exact.then_some(Reaction {
        tangential: given.tangential,
        normal: given.normal,
    });
    let particle = Particle {
        reaction: in_particle,
        curvature,
        ..particle
    };
    Ok((particle, Some(reaction)))
}

/// A reaction on the body along the tangent and the normal into the obstacle.
struct GivenReaction {
    tangential: Rational,
    normal: Rational,
}

/// How a reaction and a state go together.
enum Fit {
    /// (7) holds exactly.
    Exact,
    /// (7) holds with the slack.
    WithinSlack,
    /// It does not; what was expected instead.
    Contradiction(&'static str),
    /// The reaction is off the cone; what was expected of |r_T|, and how |r_T| / |r_N| and the
    /// friction compare then.
    OffCone(&'static str, &'static str),
}

impl GivenReaction {
    /// That of a particle, along its dofs, turned into its directions.
    fn at(particle: &Particle, [tangential, normal]: &[Rational; 2]) -> GivenReaction {
        let (tangential, normal) = match &particle.frame {
            None => (tangential.clone(), normal.clone()),
            Some([t, n]) => (
                &t[0] * tangential + &t[1] * normal,
                &n[0] * tangential + &n[1] * normal,
            ),
        };

        GivenReaction {
            tangential,
            normal: normal * Rational::from_integer(particle.normal_direction.into()),
        }
    }

    /// Holds the reaction along tangent and normal against (7) and the state with a relative slack;
    /// true if they hold exactly as well. `friction` is that of the particle.
    ///
    /// # Errors
    /// [`ContactsError::Contradiction`] and [`ContactsError::OffCone`]; `place` is named in them.
    fn fits(
        &self,
        place: ReactionPlace,
        state: ContactState,
        friction: &Rational,
    ) -> Result<bool, ContactsError> {
        let pressure = -&self.normal;
        let fit = match state {
            ContactState::Free | ContactState::Zero => self.fit_of_free(),
            ContactState::Stick => self.fit_of_stick(&pressure, friction),
            ContactState::Slip { sign } => self.fit_of_slip(sign, &pressure, friction),
        };

        match fit {
            Fit::Exact => Ok(true),
            Fit::WithinSlack => Ok(false),
            Fit::Contradiction(expected) => Err(ContactsError::Contradiction {
                place,
                state: state.word(),
                expected,
                tangential: with_seven_digits(&self.tangential),
                normal: with_seven_digits(&self.normal),
            }),
            Fit::OffCone(expected, ratio) => Err(ContactsError::OffCone {
                place,
                state: state.word(),
                expected,
                ratio,
                friction: with_five_digits(to_f64(friction)),
                got: with_five_digits(to_f64(&(self.tangential.abs() / pressure))),
                tangential: with_seven_digits(&self.tangential),
                normal: with_seven_digits(&self.normal),
            }),
        }
    }

    fn fit_of_free(&self) -> Fit {
        if self.tangential.is_zero() && self.normal.is_zero() {
            Fit::Exact
        } else {
            Fit::Contradiction("no reaction")
        }
    }

    /// |r_T| < mu |r_N|.
    fn fit_of_stick(&self, pressure: &Rational, friction: &Rational) -> Fit {
        if !pressure.is_positive() {
            return Fit::Contradiction(PUSHED_OFF);
        }

        let excess = self.excess(pressure, friction);
        if excess > slack(pressure, friction) {
            Fit::OffCone("|r_T| < mu |r_N|", "<")
        } else if excess.is_negative() {
            Fit::Exact
        } else {
            Fit::WithinSlack
        }
    }

    /// |r_T| = mu |r_N|, with the sign S of r_T.
    fn fit_of_slip(&self, sign: i8, pressure: &Rational, friction: &Rational) -> Fit {
        if !pressure.is_positive() {
            return Fit::Contradiction(PUSHED_OFF);
        }
        if self.tangential.signum() != Rational::from_integer(sign.into()) {
            return Fit::Contradiction("r_T against the impending slip");
        }

        let excess = self.excess(pressure, friction);
        if excess.abs() > slack(pressure, friction) {
            Fit::OffCone("|r_T| = mu |r_N|", "=")
        } else if excess.is_zero() {
            Fit::Exact
        } else {
            Fit::WithinSlack
        }
    }

    /// |r_T| over mu |r_N|.
    fn cone_ratio(&self, friction: &Rational) -> Option<f64> {
        let radius = friction * self.normal.abs();
        (!radius.is_zero()).then(|| to_f64(&(self.tangential.abs() / radius)))
    }

    /// |r_T| - mu |r_N|.
    fn excess(&self, pressure: &Rational, friction: &Rational) -> Rational {
        self.tangential.abs() - friction * pressure
    }
}

/// What is expected of a node in contact.
const PUSHED_OFF: &str = "a reaction that pushes the body off the obstacle (see normal_direction)";

/// How far |r_T| may be from mu |r_N|.
fn slack(pressure: &Rational, friction: &Rational) -> Rational {
    let (numerator, denominator) = CONE_SLACK;
    (friction * pressure).abs() * rational(numerator, denominator)
}

/// A reaction for people: rotations make fractions of sixty digits of it.
fn with_seven_digits(reaction: &Rational) -> String {
    format!("{:.6e}", to_f64(reaction))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::whole;

    /// Reads a table for mu = 1/2 and ten degrees of freedom.
    fn read(text: &str) -> Result<Vec<Particle>, ContactsError> {
        let table = read_contacts(text, &rational(1, 2), &dof_below_ten)?;
        assert_eq!(table.reactions.len(), table.particles.len());
        Ok(table.particles)
    }

    fn dof_below_ten(text: &str) -> Option<usize> {
        text.parse().ok().filter(|dof| *dof < 10)
    }

    const HEADER: &str =
        "particle,tangential,normal,state,normal_direction,reaction_tangential,reaction_normal\n";

    #[test]
    fn states_signs_and_directions() {
        let text = format!(
            "# a comment\n{HEADER}a,0,1,slip+,,-1,-2\nb, 2, 3, slip-, -1, 1.0000001, \
             2\n\nc,4,5,stick,1,,\nd,6,7,free,,0,0\n"
        );

        let [a, b, c, d] = &read(&text).unwrap()[..] else {
            panic!("four particles")
        };

        assert_eq!(a.state, ContactState::Slip { sign: -1 });
        assert_eq!(
            a.reaction,
            Some(Reaction {
                tangential: whole(-1),
                normal: whole(-2)
            })
        );
        assert_eq!(b.state, ContactState::Slip { sign: 1 });
        assert_eq!(b.normal_direction, -1);
        assert_eq!(b.reaction, None); // on the cone within the slack, not exactly
        assert_eq!(c.state, ContactState::Stick);
        assert_eq!(d.state, ContactState::Free);

        let other_order = read("state,normal,tangential\nstick,1,0\n").unwrap();
        assert_eq!(other_order[0].tangential, 0);
    }

    #[test]
    fn contradictions_with_7_are_refused() {
        for line in [
            "a,0,1,slip+,,1,-2",
            "a,0,1,slip-,,1,2",
            "a,0,1,stick,,1,2",
            "a,0,1,free,,0,-1",
        ] {
            let refused = read(&format!("{HEADER}{line}\n"));
            assert!(
                matches!(
                    refused,
                    Err(ContactsError::Contradiction {
                        place: ReactionPlace::Line(2),
                        ..
                    })
                ),
                "{line}"
            );
        }
    }

    /// mu = 1/2 and the factor 3; both ratios are printed, the one of the table and the one of (7).
    #[test]
    fn reactions_off_the_cone_are_refused_with_both_ratios() {
        let header = "tangential,normal,state,friction_factor,reaction_tangential,reaction_normal";
        for (line, relation, got) in [
            ("0,1,slip-,3,2.4,-2", "=", "1.2000"),
            ("0,1,slip-,3,3.5,-2", "=", "1.7500"),
            ("0,1,stick,3,3.5,-2", "<", "1.7500"),
        ] {
            let refused = read(&format!("{header}\n{line}\n")).unwrap_err();

            let is_named = matches!(
                refused,
                ContactsError::OffCone {
                    place: ReactionPlace::Line(2),
                    ..
                }
            );
            assert!(is_named, "{line}: {refused}");
            let ratios = format!("|r_T| / |r_N| {relation} 1.5000 (mu times the friction factor)");
            let text = refused.to_string();
            assert!(text.contains(&ratios), "{text}");
            assert!(text.contains(&format!("got {got}")), "{text}");
        }

        for line in ["0,1,slip-,3,3,-2", "0,1,stick,3,2.9,-2"] {
            assert!(read(&format!("{header}\n{line}\n")).is_ok(), "{line}");
        }
    }

    #[test]
    fn oblique_obstacles_by_angle_or_by_normal() {
        let turned = read("tangential,normal,state,angle\n0,1,slip+,1e30\n").unwrap();
        let frame = turned[0].frame.clone().unwrap();
        let degrees = crate::angle_in_degrees(&frame);
        assert!(
            (degrees + 80.0).abs() < 1e-9,
            "10^30 = 280 modulo 360: {degrees}"
        );

        let by_angle = read("tangential,normal,state,angle\n0,1,slip+,30\n").unwrap();
        let frame = by_angle[0].frame.clone().unwrap();
        assert!((to_f64(&frame[0][0]) - 0.75_f64.sqrt()).abs() < 1e-11);
        assert!((to_f64(&frame[0][1]) - 0.5).abs() < 1e-11);

        // The normal (-0.6, 0.8) into the obstacle belongs to the tangent (0.8, 0.6). A reaction of
        // 2 against it, and of 1 along the tangent, is (0.8 + 1.2, 0.6 - 1.6) along the dofs.
        let header =
            "tangential,normal,state,normal_x,normal_y,reaction_tangential,reaction_normal";
        let by_normal = read(&format!("{header}\n0,1,slip-,-0.6,0.8,2,-1\n")).unwrap();
        let particle = &by_normal[0];
        let [c, s] = [rational(4, 5), rational(3, 5)];
        assert_eq!(particle.frame, Some([[c.clone(), s.clone()], [-s, c]]));
        assert_eq!(
            particle.reaction,
            Some(Reaction {
                tangential: whole(1),
                normal: whole(-2)
            })
        );

        // A curvature goes with the reaction along the normal, where the particle slips.
        let curved = format!("{header},curvature\n0,1,slip-,-0.6,0.8,2,-1,0.25\n");
        let expected = Curvature {
            value: rational(1, 4),
            normal_reaction: whole(-2),
        };
        assert_eq!(read(&curved).unwrap()[0].curvature, Some(expected));
        let at_rest = "tangential,normal,state,curvature\n0,1,stick,0.25\n";
        assert_eq!(read(at_rest).unwrap()[0].curvature, None);

        let out_of_it = read(&format!("{header}\n0,1,slip-,0.6,-0.8,2,-1\n"));
        assert!(matches!(
            out_of_it,
            Err(ContactsError::Contradiction { .. })
        ));
    }

    #[test]
    fn a_direction_is_given_once() {
        let header = "tangential,normal,state,normal_direction,angle,normal_x,normal_y";
        for cells in [",10,0,1", ",,0,", "1,,0,1", ",10,,1"] {
            let refused = read(&format!("{header}\n0,1,stick,{cells}\n"));
            assert!(
                matches!(refused, Err(ContactsError::Direction { line: 2, .. })),
                "{cells}"
            );
        }

        let nowhere = read(&format!("{header}\n0,1,stick,,,0,0\n"));
        assert!(matches!(nowhere, Err(ContactsError::Cell { .. })));
        assert!(read(&format!("{header}\n0,1,stick,-1,10,,\n")).is_ok());
    }

    /// mu = 1/2 and the factor 3 make the cone |r_T| <= 3/2 |r_N|.
    #[test]
    fn a_particle_may_have_its_own_friction() {
        let header =
            "tangential,normal,state,friction_factor,reaction_tangential,reaction_normal\n";
        let own = read(&format!("{header}0,1,slip-,3,3,-2\n")).unwrap();
        assert_eq!(own[0].friction_factor, whole(3));
        assert_eq!(
            read(&format!("{header}0,1,zero,,0,0\n")).unwrap()[0].state,
            ContactState::Zero
        );

        let common = read(&format!("{header}0,1,slip-,,3,-2\n"));
        assert!(matches!(common, Err(ContactsError::OffCone { .. })));
        let none = read(&format!("{header}0,1,slip-,0,0,-2\n"));
        assert!(matches!(
            none,
            Err(ContactsError::Cell {
                column: "friction_factor",
                ..
            })
        ));
    }

    #[test]
    fn semicolons_are_named_with_the_remedy() {
        let refused = read("tangential;normal;state\n0;1;slip+\n").unwrap_err();
        assert_eq!(refused, ContactsError::Separator { got: ';' });
        assert!(refused.to_string().contains("decimal commas"), "{refused}");
    }

    #[test]
    fn malformed_tables_name_line_and_column() {
        assert!(matches!(
            read(""),
            Err(ContactsError::MissingColumn {
                column: "tangential",
                ..
            })
        ));
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

        for (line, expected) in [
            ("a,0,99,stick,,,", "normal"),
            ("a,0,1,slip,,,", "state"),
            ("a,0,1,stick,2,,", "normal_direction"),
            ("a,0,1,stick,,x,1", "reaction_tangential"),
            ("a,0,1,stick,,1,", "reaction_normal"),
        ] {
            let Err(ContactsError::Cell {
                line: 2, column, ..
            }) = read(&format!("{HEADER}{line}\n"))
            else {
                panic!("{line} is accepted, or refused for another reason")
            };
            assert_eq!(column, expected, "{line}");
        }
    }
}
