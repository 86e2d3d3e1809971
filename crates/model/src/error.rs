//! Every way in which a problem is refused: equation or field, index, expected, got.
//!
//! Each message is one line that names the place in the file or the equation of
//! the book (as E12; `spec/README.md` says where), what was expected there and what was found.

use mceip_exact::{NumberError, Rational, to_f64};
use num_traits::Signed;

/// Where in a JSON text something was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ErrorLocation {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1; 0 where only the line is known.
    pub column: usize,
}

/// Why a problem is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A matrix has the wrong shape.
    #[error(
        "{equation}: expected {what} to be {expected_rows} x {expected_cols}, got {rows} x {cols}"
    )]
    Shape {
        /// Equation id (`spec/README.md` says where it is defined).
        equation: &'static str,
        /// Name of the matrix.
        what: &'static str,
        /// Rows wanted.
        expected_rows: usize,
        /// Columns wanted.
        expected_cols: usize,
        /// Rows found.
        rows: usize,
        /// Columns found.
        cols: usize,
    },
    /// Coordinates that do not fit the system.
    #[error("coordinates: expected {expected}, got {got}")]
    Coordinates {
        /// What was wanted.
        expected: &'static str,
        /// What was found.
        got: String,
    },
    /// Loads, or contact candidates, that make no sense.
    #[error("loads: expected {expected}, got {got}")]
    Loads {
        /// What was wanted.
        expected: String,
        /// What was found.
        got: String,
    },
    /// A pencil or system without a single variable.
    #[error("expected at least one variable in {what}, got none")]
    Empty {
        /// What is empty.
        what: &'static str,
    },
    /// No particle is in impending slip. That is an answer: there is no solution.
    #[error(
        "no particle is about to slip: there is no divergence of the form (8) then, for any \
         mu >= 0 and lambda^2 >= 0 (spec/zero-reaction.md, Z.2); expected one at least in \
         impending slip, for a problem to be posed"
    )]
    NothingSlips,
    /// A matrix that must be symmetric is not.
    #[error(
        "{equation}: expected {what} symmetric, got {what}[{row}][{col}] = {} and \
         {what}[{col}][{row}] = {} (rows and columns from 0)",
        told_apart(upper, lower),
        told_apart(lower, upper)
    )]
    NotSymmetric {
        /// Equation id.
        equation: &'static str,
        /// Name of the matrix.
        what: &'static str,
        /// Row of the first difference.
        row: usize,
        /// Its column.
        col: usize,
        /// Entry (row, col).
        upper: Rational,
        /// Entry (col, row).
        lower: Rational,
    },
    /// A matrix that must be positive definite is not.
    #[error(
        "{equation}: expected {what} positive definite, got pivot {} at index {index} of its LDL'",
        shortened(pivot)
    )]
    NotDefinite {
        /// Equation, proposition or remark that needs it.
        equation: &'static str,
        /// Name of the matrix.
        what: &'static str,
        /// Row of the failing pivot within the matrix named.
        index: usize,
        /// The pivot, or the value of the quadratic form that refutes definiteness.
        pivot: Rational,
    },
    /// K_ff is not positive definite, or too close to singular to be proved so: supports are
    /// missing, or an entry of K is wrong.
    #[error(
        "P1: expected K_ff positive definite, got {} at degree of freedom {dof}: {}",
        pivot_of_ldl(pivot.as_ref()),
        why_not_held(pivot.as_ref())
    )]
    NotHeld {
        /// Where LDL' ended, in the numbering of K.
        dof: usize,
        /// The pivot, or the value of the quadratic form that refutes definiteness; `None` where
        /// rounding leaves its sign open.
        pivot: Option<Rational>,
    },
    /// A large matrix too close to singular to be proved definite or not.
    #[error(
        "{equation}: expected {what} provably positive definite, \
         got a factorisation that decides nothing at index {index}"
    )]
    DefinitenessUndecided {
        /// Equation, proposition or remark that needs it.
        equation: &'static str,
        /// Name of the matrix.
        what: &'static str,
        /// Row at which the rounded factorisation stopped.
        index: usize,
    },
    /// A block that must vanish does not.
    #[error(
        "{equation}: expected {what}[{row}][{col}] = 0 \
         (the f rows do not depend on the unknown), got {value}"
    )]
    NotZero {
        /// Equation id.
        equation: &'static str,
        /// Name of the matrix.
        what: &'static str,
        /// Row of the entry.
        row: usize,
        /// Its column.
        col: usize,
        /// The entry.
        value: Rational,
    },
    /// An index is not below its bound.
    #[error("expected {what} below {limit}, got {index}")]
    IndexOutOfRange {
        /// What the index numbers.
        what: &'static str,
        /// The index.
        index: usize,
        /// First value that is too large.
        limit: usize,
    },
    /// A particle names a degree of freedom that does not exist.
    #[error("particle {particle}: expected {which} below {limit}, got {dof}")]
    DofOutOfRange {
        /// The particle.
        particle: usize,
        /// `tangential` or `normal`.
        which: &'static str,
        /// The degree of freedom.
        dof: usize,
        /// Number of degrees of freedom.
        limit: usize,
    },
    /// An entry lies outside its matrix.
    #[error(
        "{what}: expected entries within {rows} x {cols}, their rows and columns counted from 0, \
         got one at ({row}, {col})"
    )]
    EntryOutside {
        /// Name of the matrix.
        what: &'static str,
        /// Row of the entry.
        row: usize,
        /// Its column.
        col: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Its columns.
        cols: usize,
    },
    /// An entry is listed twice, or with its mirror in a symmetric matrix.
    #[error(
        "{what}: expected each entry once (of \"symmetric\": true in one triangle), got \
         ({row}, {col}) twice"
    )]
    EntryTwice {
        /// Name of the matrix.
        what: &'static str,
        /// Row of the entry.
        row: usize,
        /// Its column.
        col: usize,
    },
    /// An index is listed twice.
    #[error("expected each {what} once, got {index} twice")]
    IndexTwice {
        /// What the index numbers.
        what: &'static str,
        /// The index.
        index: usize,
    },
    /// Two contact particles claim the same degree of freedom.
    #[error(
        "particles {first} and {second}: expected each degree of freedom in one particle, \
         got {dof} in both"
    )]
    DofTwice {
        /// The degree of freedom.
        dof: usize,
        /// Particle that claims it first.
        first: usize,
        /// Particle that claims it again.
        second: usize,
    },
    /// Something needed for this unknown is missing.
    #[error(
        "{equation}: expected {what} for unknown {unknown}, got none{}",
        remedy_for(what)
    )]
    Missing {
        /// Equation id.
        equation: &'static str,
        /// The missing field.
        what: &'static str,
        /// The unknown that needs it.
        unknown: &'static str,
    },
    /// Slip particles need friction.
    #[error(
        "E7: expected friction > 0 with slip particles (particle {particle}), got {friction}: \
         without friction nothing is in impending slip; write the mu of the contact, or, on \
         flat obstacles, ask `mceip analyze --friction 0`, which a theorem answers"
    )]
    FrictionNotPositive {
        /// The first slip particle.
        particle: usize,
        /// The coefficient given.
        friction: Rational,
    },
    /// A negative coefficient of friction.
    #[error("E2: expected friction >= 0, got {friction}")]
    FrictionNegative {
        /// The coefficient given.
        friction: Rational,
    },
    /// The factor on mu of a particle is not positive.
    #[error("E2: particle {particle}: expected friction_factor > 0, got {factor}")]
    FrictionFactor {
        /// The particle.
        particle: usize,
        /// The factor given.
        factor: Rational,
    },
    /// The interval of the friction factor of a particle is none, or does not hold the factor.
    #[error(
        "E2: particle {particle}: expected friction_factor_range [lo, hi] with 0 <= lo < hi and \
         lo <= {factor} <= hi, the friction_factor, got [{lo}, {hi}]"
    )]
    FrictionFactorRange {
        /// The particle.
        particle: usize,
        /// The factor given.
        factor: Rational,
        /// The lower end.
        lo: Rational,
        /// The upper end.
        hi: Rational,
    },
    /// A radius is negative.
    #[error("E3: {what}: expected no negative entry, got {got} in row {row}, column {col}")]
    RadiusNegative {
        /// The matrix.
        what: &'static str,
        /// Its row.
        row: usize,
        /// Its column.
        col: usize,
        /// The entry.
        got: Rational,
    },
    /// A radius of M without M.
    #[error("E3: a radius of M, and no M; expected \"mass\" beside it")]
    RadiusWithoutMass,
    /// Radii of the data, where one body is asked for.
    #[error(
        "the data have radii, so that they stand for a set of bodies; expected one body here \
         (analyze treats radii: spec/robust.md; without \"radii\" and \"friction_factor_range\" \
         the problem is that of the data as given)"
    )]
    NotExact,
    /// A particle in contact with zero reaction, where it is not treated.
    #[error(
        "E9: particle {particle} has state \"zero\"; expected free, stick or slip \
         (not supported here; what treats z particles: spec/zero-reaction.md)"
    )]
    ZeroReaction {
        /// The particle.
        particle: usize,
    },
    /// A curved obstacle, where it is not treated.
    #[error(
        "E9: particle {particle} slips on a curved obstacle; expected flat ones here (curved ones \
         are treated at one mu > 0, without radii: spec/curvature.md, K.2)"
    )]
    Curved {
        /// The particle.
        particle: usize,
    },
    /// A curvature stands at a particle that does not slip, or with a normal reaction that is none.
    #[error("E7: particle {particle}: curvature: expected {expected}, got {got}")]
    Curvature {
        /// The particle.
        particle: usize,
        /// What was expected.
        expected: &'static str,
        /// What was found.
        got: String,
    },
    /// A sign is neither 1 nor -1, or is missing on a slip particle, or stands on another one.
    #[error("E10: particle {particle}: expected {field} {expected}, got {got}")]
    Sign {
        /// The particle.
        particle: usize,
        /// `sign` or `normal_direction`.
        field: &'static str,
        /// What was expected.
        expected: &'static str,
        /// What was found.
        got: String,
    },
    /// A frame is not a rotation.
    #[error(
        "particle {particle}: expected frame to be a rotation \
         (rows orthonormal, determinant 1), got {got}"
    )]
    FrameNotRotation {
        /// The particle.
        particle: usize,
        /// What fails.
        got: String,
    },
    /// A reaction contradicts the contact state.
    #[error(
        "E7: particle {particle} in state {state}: expected {expected}, \
         got r_T = {tangential}, r_N = {normal}"
    )]
    ReactionContradicts {
        /// The particle.
        particle: usize,
        /// Its state.
        state: &'static str,
        /// The line of (7) that fails.
        expected: &'static str,
        /// Tangential reaction given.
        tangential: Rational,
        /// Normal reaction given.
        normal: Rational,
    },
    /// An eigenvalue problem that is not posed on a pencil without free variables.
    #[error(
        "unknown eigenvalue: expected a pencil without free variables, got {got} (a body has the \
         unknowns lambda2 and mu)"
    )]
    Eigenvalue {
        /// What it is posed on.
        got: String,
    },
    /// A quadratic pencil with another unknown than an eigenvalue.
    #[error(
        "pencil.c: expected the unknown eigenvalue for a quadratic pencil, got {got} (for lambda2 \
         and mu leave c out)"
    )]
    Quadratic {
        /// The unknown.
        got: &'static str,
    },
    /// The window of an eigenvalue problem that is empty, or that ends below 0.
    #[error(
        "expected a window min <= max with 0 <= max, got [{min}, {max}]{}",
        if *ends_below_zero { BELOW_ZERO_ALONE } else { "" }
    )]
    RealWindow {
        /// Lower end.
        min: String,
        /// Upper end.
        max: String,
        /// Does it end below 0?
        ends_below_zero: bool,
    },
    /// A certificate that speaks of values below 0 where there are none.
    #[error("negative: expected the unknown eigenvalue, got {unknown}")]
    NegativeValues {
        /// The unknown of the certificate.
        unknown: &'static str,
    },
    /// A window that is empty or negative.
    #[error(
        "expected a window 0 <= min <= max, got min = {min}, max = {max}{}",
        if min.is_negative() { NOT_NEGATIVE } else { "" }
    )]
    Window {
        /// Lower end.
        min: Rational,
        /// Upper end.
        max: String,
    },
    /// The file is not JSON of the expected shape.
    #[error("line {}, column {}: {problem}", location.line, location.column)]
    Json {
        /// Where.
        location: ErrorLocation,
        /// What the JSON reader expected and got.
        problem: String,
    },
    /// The `format` field is missing or names another version.
    #[error("expected format {expected:?}, got {got}{}", hint_of(expected, got))]
    Format {
        /// The version this program reads.
        expected: &'static str,
        /// What the file says.
        got: String,
    },
    /// Not exactly one of `pencil` and `system`.
    #[error("expected exactly one of \"pencil\" and \"system\", got {got}")]
    Body {
        /// What the file has.
        got: &'static str,
    },
    /// A number cannot be read.
    #[error("{place}: {source}")]
    Number {
        /// Where in the file.
        place: String,
        /// What is wrong with it.
        source: NumberError,
    },
    /// A row of a dense matrix has another length than the first.
    #[error("{what}: expected row {row} to have {expected} entries, got {got}")]
    Ragged {
        /// Name of the matrix.
        what: &'static str,
        /// The row.
        row: usize,
        /// Length of the first row.
        expected: usize,
        /// Length of this row.
        got: usize,
    },
    /// Larger than this program will read.
    #[error("{what}: expected at most {limit}, got {got}")]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// The bound.
        limit: u64,
        /// What was found.
        got: u64,
    },
    /// A text that is not, when it is read again, what was written.
    #[error(
        "expected the text of a file to be what was written, got something else (a defect of this \
         program)"
    )]
    NotAsWritten,
    /// A file named by the problem cannot be read.
    #[error("{what}: cannot read {path:?}: {problem}")]
    Unreadable {
        /// Name of the matrix, or of the file's role.
        what: &'static str,
        /// The path tried.
        path: String,
        /// The system's reason.
        problem: String,
    },
    /// A Matrix Market file is malformed.
    #[error("{what}: Matrix Market line {line}: expected {expected}, got {got:?}")]
    MatrixMarket {
        /// Name of the matrix.
        what: &'static str,
        /// Line in the file, from 1.
        line: usize,
        /// What the format wants there.
        expected: &'static str,
        /// The beginning of what stands there.
        got: String,
    },
}

/// A number as text; the beginning of one that fills more than a line.
fn shortened(v: &Rational) -> String {
    const MOST: usize = 60;

    let text = v.to_string();
    if text.len() <= MOST {
        text
    } else {
        format!("{}... ({} characters)", &text[..MOST], text.len())
    }
}

/// A number in decimals of a double, where these tell it from another one.
fn told_apart(number: &Rational, other: &Rational) -> String {
    let [shown, other] = [number, other].map(to_f64);
    if shown == other {
        shortened(number)
    } else {
        shown.to_string()
    }
}

/// What LDL' of K_ff ended with.
fn pivot_of_ldl(pivot: Option<&Rational>) -> String {
    match pivot {
        Some(pivot) => format!("pivot {} of its LDL'", shortened(pivot)),
        None => "a pivot of its LDL' that is 0 up to rounding".to_string(),
    }
}

/// What such a pivot says of a body, and what to do.
fn why_not_held(pivot: Option<&Rational>) -> &'static str {
    if pivot.is_some_and(Signed::is_negative) {
        return "a motion of the free degrees of freedom has negative energy, which no elastic body \
                has: look at the signs in K";
    }

    "in these contact states a motion needs no work, as of a body that is not held (leave the \
     degrees of freedom of its supports out of K)"
}

/// What to do about a missing field.
fn remedy_for(what: &str) -> &'static str {
    match what {
        "mass" => {
            ": add \"mass\" beside \"stiffness\" (`mceip convert --mass FILE`); without it, \
             \"unknown\": \"mu\" asks for the mu of lambda = 0"
        }
        "friction" => ": add \"friction\", the mu of the contact",
        _ => "",
    }
}

/// Why a window of lambda^2 or mu begins at 0 or above.
const NOT_NEGATIVE: &str = " (a mode with lambda^2 < 0 does not grow, and mu is not negative)";

/// What to do for a window that ends below 0.
const BELOW_ZERO_ALONE: &str = " (one that ends at 0 has the values below 0 too)";

const BESIDE_PROBLEM: &str = "`mceip check PROBLEM CERTIFICATE` reads it beside its problem";

/// The formats that commands read, and which command does.
const FORMATS: [(&str, &str); 10] = [
    (
        "mceip-problem/1",
        "`mceip analyze`, `complete` and `solve` read problems",
    ),
    ("mceip-loads/1", "`mceip path` reads bodies under loads"),
    ("mceip-certificate/1", BESIDE_PROBLEM),
    ("mceip-critical/1", BESIDE_PROBLEM),
    ("mceip-presence/1", BESIDE_PROBLEM),
    ("mceip-stability/1", BESIDE_PROBLEM),
    (
        "mceip-equilibrium/1",
        "`mceip check LOADS CERTIFICATE` reads it beside its loads",
    ),
    (
        "mceip-solutions/1",
        "`mceip check PROBLEM REPORT` reads it beside its problem",
    ),
    ("mceip-mcp/1", "`mceip solve` reads plain LCP and MCP"),
    (
        "mceip-mcp-solution/1",
        "`mceip check PROBLEM SOLUTION` reads it beside its plain problem",
    ),
];

/// Which command reads a file of another format, or which known format a misspelt one is nearest
/// to; `got` is what the field says, in quotes.
fn hint_of(expected: &str, got: &str) -> String {
    let got = got.trim_matches('"');
    if let Some((_, reader)) = FORMATS.iter().find(|(format, _)| *format == got) {
        return format!(": {reader}");
    }

    let apart = |format: &str| {
        let short = format.trim_start_matches("mceip-");
        changes(format, got).min(changes(short, got))
    };
    let nearest = FORMATS.iter().map(|(format, _)| (apart(format), *format));
    match nearest.min() {
        Some((apart, format)) if apart <= MISSPELT && format != expected => {
            format!("; the nearest format that is known is {format:?}")
        }
        _ => String::new(),
    }
}

/// Letters by which a misspelt format differs from the one meant, at most.
const MISSPELT: usize = 3;

/// The least number of letters that are added, left out or exchanged to get from one text to the
/// other: row by row of the table of all beginnings (Wagner and Fischer, J. ACM 21, 1974).
fn changes(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, letter) in from.chars().enumerate() {
        let mut next = vec![i + 1];
        for (j, other) in to.iter().enumerate() {
            let exchanged = row[j] + usize::from(letter != *other);
            let added_or_left_out = row[j + 1].min(next[j]) + 1;
            next.push(exchanged.min(added_or_left_out));
        }
        row = next;
    }

    row[to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_format_has_a_nearest_one() {
        for (got, nearest) in [
            ("mceip-solution/1", Some("mceip-solutions/1")),
            ("solutions/1", Some("mceip-solutions/1")),
            ("mceip-criticl/1", Some("mceip-critical/1")),
            ("mceip-anything/1", None),
            ("no format field", None),
            ("mceip-certificate/2", None), // another version of what is expected
        ] {
            let hint = hint_of("mceip-certificate/1", &format!("\"{got}\""));
            match nearest {
                Some(nearest) => assert!(hint.contains(nearest), "{got}: {hint}"),
                None => assert_eq!(hint, "", "{got}"),
            }
        }
    }

    #[test]
    fn changes_are_counted() {
        for (from, to, count) in [
            ("", "", 0),
            ("a", "", 1),
            ("abc", "acb", 2),
            ("kitten", "sitting", 3),
        ] {
            assert_eq!(changes(from, to), count);
            assert_eq!(changes(to, from), count);
        }
    }
}
