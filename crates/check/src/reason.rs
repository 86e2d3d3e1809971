//! Every reason for rejection, as a typed value: equation, index, expected, got.
//!
//! A rejection names the first obligation that fails, in the order of `spec/certificates.md`. Its
//! message says "expected ..., got ..."; its name ([`Reason::name`]) is what the corpus of
//! forgeries (`spec/corpus`) expects. What is wrong with a complete set, or with the boxes of
//! `mceip-critical/1` or `mceip-presence/1`, is a [`CoverFault`]. The
//! values hold the numbers in full; the message of a [`Rejected`] cuts numbers of more than 60
//! digits short.

use crate::cover::fault::CoverFault;
use mceip_exact::{Interval, Rational};

/// A rejected certificate.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{}{}{}",
    if *is_negative { "values below 0: " } else { "" },
    claim.map(|c| format!("claim {c}: ")).unwrap_or_default(),
    with_short_numbers(&reason.to_string())
)]
pub struct Rejected {
    /// Is it the part of values below 0 that fails?
    pub is_negative: bool,
    /// The claim of that part that fails; `None` where the part as a whole does.
    pub claim: Option<usize>,
    /// Why.
    pub reason: Reason,
}

impl From<Reason> for Rejected {
    /// The rejection of the certificate as a whole.
    fn from(reason: Reason) -> Rejected {
        Rejected {
            is_negative: false,
            claim: None,
            reason,
        }
    }
}

impl From<CoverFault> for Reason {
    fn from(fault: CoverFault) -> Reason {
        Reason::Matrices { fault }
    }
}

impl Reason {
    /// The obligation's name, as `spec/corpus` states it: `NotIsolated`, `Cover.Truncated`, ...
    pub fn name(&self) -> String {
        match self {
            Reason::Cover { fault, .. }
            | Reason::Boxes { fault, .. }
            | Reason::Matrices { fault } => {
                format!("Cover.{}", variant_name(&format!("{fault:?}")))
            }
            other => variant_name(&format!("{other:?}")),
        }
    }

    /// [`Reason::TooLarge`] if `got` exceeds `limit`.
    pub(super) fn at_most(what: &'static str, limit: u64, got: u64) -> Result<(), Reason> {
        if got > limit {
            return Err(Reason::TooLarge { what, limit, got });
        }

        Ok(())
    }

    /// [`Reason::Length`] if a list has not the entries it should have.
    pub(super) fn length(what: &'static str, expected: usize, got: usize) -> Result<(), Reason> {
        if got != expected {
            return Err(Reason::Length {
                what,
                expected,
                got,
            });
        }

        Ok(())
    }

    /// [`Reason::XNotPositive`] unless every number of the enclosure of x_i is positive.
    pub(super) fn x_positive(index: usize, enclosure: &Interval) -> Result<(), Reason> {
        if enclosure.certain_sign() == 1 {
            return Ok(());
        }

        Err(Reason::XNotPositive {
            index,
            lo: enclosure.lo().clone(),
            hi: enclosure.hi().clone(),
        })
    }

    /// [`Reason::YNotPositive`] unless every number of the enclosure of y_i is positive.
    pub(super) fn y_positive(index: usize, enclosure: &Interval) -> Result<(), Reason> {
        if enclosure.certain_sign() == 1 {
            return Ok(());
        }

        Err(Reason::YNotPositive {
            index,
            lo: enclosure.lo().clone(),
            hi: enclosure.hi().clone(),
        })
    }
}

/// The text with `12345678901234567890...(300 digits)` for each number of more than 60 digits.
pub fn with_short_numbers(text: &str) -> String {
    const LONGEST: usize = 60;
    const SHOWN: usize = 20;

    let mut short = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, number) = rest.split_at(start);
        let length = number
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(number.len());

        short.push_str(before);
        if length > LONGEST {
            short.push_str(&number[..SHOWN]);
            short.push_str(&format!("...({length} digits)"));
        } else {
            short.push_str(&number[..length]);
        }

        rest = &number[length..];
    }

    short.push_str(rest);
    short
}

/// The name of a variant, with which its debug form begins.
fn variant_name(debug: &str) -> String {
    debug
        .chars()
        .take_while(char::is_ascii_alphanumeric)
        .collect()
}

/// The obligation that fails.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Reason {
    /// The certificate was made for other matrices.
    #[error("digest: it is about another problem: expected {expected}, got {got:?}")]
    Digest {
        /// Digest of the problem at hand.
        expected: String,
        /// Digest the certificate names.
        got: String,
    },
    /// A kind of certificate that speaks of one body, of a problem with radii.
    #[error(
        "data: expected one body for this kind of certificate, got radii \
         (absence below a friction and presence treat them)"
    )]
    Radii,
    /// A kind of certificate that lets mu vary on flat obstacles, of a problem with curved ones.
    #[error(
        "obstacle: expected a flat one for this kind of certificate, got a curved one at particle \
         {particle} (a complete set of lambda^2 treats it at one friction)"
    )]
    Curved {
        /// The particle.
        particle: usize,
    },
    /// The certificate was made for the other eigenproblem.
    #[error("unknown: expected {expected}, got {got}")]
    Unknown {
        /// The problem's unknown.
        expected: &'static str,
        /// The certificate's.
        got: &'static str,
    },
    /// A certificate that claims nothing proves nothing.
    #[error("claims: expected at least one, got none")]
    NoClaims,
    /// An index set is not an ascending list of complementarity variables.
    #[error(
        "E14: {set}: expected ascending indices of complementarity variables, \
         got {got} at position {position}"
    )]
    IndexSet {
        /// `support` or `biactive`.
        set: &'static str,
        /// Position in the list.
        position: usize,
        /// The index there.
        got: usize,
    },
    /// A list has the wrong length.
    #[error("{what}: expected {expected} entries, got {got}")]
    Length {
        /// Which list.
        what: &'static str,
        /// Entries wanted.
        expected: usize,
        /// Entries found.
        got: usize,
    },
    /// Larger than the checker will multiply out: keeps time and memory bounded by the file's size.
    #[error("{what}: expected at most {limit}, got {got}")]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// The bound.
        limit: u64,
        /// What was found.
        got: u64,
    },
    /// The polynomial is constant.
    #[error(
        "polynomial: expected degree >= 1, got {coefficients} coefficients without a power of t"
    )]
    ConstantPolynomial {
        /// Number of coefficients.
        coefficients: usize,
    },
    /// The interval is reversed.
    #[error("interval: expected a <= b, got [{a}, {b}]")]
    ReversedInterval {
        /// Lower end.
        a: Rational,
        /// Upper end.
        b: Rational,
    },
    /// The interval leaves the certificate's window.
    #[error("window: expected the value within [{min}, {max}], got [{a}, {b}]")]
    OutsideWindow {
        /// Lower end of the window.
        min: Rational,
        /// Upper end of the window.
        max: String,
        /// Lower end of the interval.
        a: Rational,
        /// Upper end of the interval.
        b: Rational,
    },
    /// The interval is a point that is no root.
    #[error("interval: expected p(a) = 0 at the point a = {a}, got sign {sign}")]
    NotARoot {
        /// The point.
        a: Rational,
        /// Sign of p there.
        sign: i8,
    },
    /// p has the same sign at both ends, or vanishes at one.
    #[error("interval: expected p(a) p(b) < 0, got signs {at_a} and {at_b}")]
    NoSignChange {
        /// Sign at the lower end.
        at_a: i8,
        /// Sign at the upper end.
        at_b: i8,
    },
    /// p' may vanish in the interval, so the root may not be the only one.
    #[error("interval: expected p' of one sign by interval Horner, got [{lo}, {hi}]")]
    NotIsolated {
        /// Lower bound of p'.
        lo: Rational,
        /// Upper bound of p'.
        hi: Rational,
    },
    /// x_i must vanish off the support.
    #[error("E14: x[{index}]: expected 0 mod p outside the support, got a polynomial that is not")]
    XOffSupport {
        /// The variable.
        index: usize,
    },
    /// x_i is not certainly positive on the support.
    #[error("E14: x[{index}]: expected > 0 on the interval, got [{lo}, {hi}]")]
    XNotPositive {
        /// The variable.
        index: usize,
        /// Lower bound found.
        lo: Rational,
        /// Upper bound found.
        hi: Rational,
    },
    /// A slip that is negative.
    #[error("E14: x[{index}]: expected >= 0, got {got}")]
    XNegative {
        /// The variable.
        index: usize,
        /// Its value.
        got: Rational,
    },
    /// Nothing shows that x is not zero.
    #[error("E12: expected some x_i certainly non-zero, got none")]
    XZero,
    /// A particle with zero reaction slides both ways.
    #[error(
        "Z.3: particle {particle}: expected at most one of {right} and {left} in the support, \
         got both"
    )]
    BothHalves {
        /// The particle.
        particle: usize,
        /// The variable max(v_T, 0).
        right: usize,
        /// The variable max(-v_T, 0).
        left: usize,
    },
    /// Evidence that is not defined for particles with zero reaction.
    #[error(
        "E9: expected a system without particles in state \"zero\" for {what} \
         (not supported), got particle {particle}"
    )]
    ZeroReaction {
        /// The kind of evidence.
        what: &'static str,
        /// The first particle with zero reaction.
        particle: usize,
    },
    /// An active row of (A + tB) x does not vanish.
    #[error(
        "{equation}: y[{index}]: expected 0 mod p on an active row, got a polynomial that is not"
    )]
    YNotZero {
        /// E13 for free rows, E25 for slip rows.
        equation: &'static str,
        /// The row.
        index: usize,
    },
    /// y_i is not certainly positive off the support, and not identically zero.
    #[error("E26: y[{index}]: expected > 0 on the interval or 0 mod p, got [{lo}, {hi}]")]
    YNotPositive {
        /// The row.
        index: usize,
        /// Lower bound found.
        lo: Rational,
        /// Upper bound found.
        hi: Rational,
    },
    /// The biactive set is not the set of rows off the support with y_i = 0.
    #[error(
        "E14: biactive: expected {index} {}listed, got the opposite",
        if *expected { "" } else { "not " }
    )]
    Biactive {
        /// The variable.
        index: usize,
        /// Should it have been listed?
        expected: bool,
    },
    /// A radius is not positive.
    #[error("radius[{index}]: expected > 0, got {got}")]
    Radius {
        /// The unknown.
        index: usize,
        /// Its radius.
        got: Rational,
    },
    /// A lifted claim about a problem that is no mechanical system.
    #[error("E9: expected a mechanical system, got a pencil")]
    NotASystem,
    /// A line of (9) does not hold, or its sign is not certain.
    #[error(
        "E9: expected {line} at {place} {index}, \
         got a value in [{lo}, {hi}] up to a positive factor"
    )]
    Line {
        /// The line.
        line: &'static str,
        /// What `index` numbers: `dof` or `particle`.
        place: &'static str,
        /// The dof or particle.
        index: usize,
        /// Lower end of the left-hand side's enclosure.
        lo: Rational,
        /// Upper end.
        hi: Rational,
    },
    /// Krawczyk's operator does not map the box into its interior.
    #[error(
        "Krawczyk: unknown {index}: expected |Y F(c)| + |I - Y J| r < r, got {got} >= {radius}"
    )]
    NotContracting {
        /// The unknown.
        index: usize,
        /// The left-hand side.
        got: Rational,
        /// The radius.
        radius: Rational,
    },
    /// An accepted claim has no place in the accepted cover: one of both is false.
    #[error(
        "complete set: expected support {support:?} with a value in [{a}, {b}] \
         among its solutions, families or open regions, got none"
    )]
    NotInCover {
        /// The claim's support.
        support: Vec<usize>,
        /// Lower end of its value.
        a: Rational,
        /// Upper end.
        b: Rational,
    },
    /// The friction of an equilibrium is not positive.
    #[error("friction: expected > 0, got {got}")]
    FrictionNotPositive {
        /// What the certificate states.
        got: Rational,
    },
    /// The solution of the pencil of an equilibrium has no load.
    #[error("support: expected [{expected}], the load alone, got {got:?}")]
    NotTheLoad {
        /// The variable s.
        expected: usize,
        /// The support of the claim.
        got: Vec<usize>,
    },
    /// The pencil of an equilibrium cannot be formed.
    #[error("equilibrium: {what}")]
    NoPencil {
        /// What the model refuses.
        what: String,
    },
    /// A friction below which absence is claimed is not positive.
    #[error("below: expected > 0, got {got}")]
    Below {
        /// What the certificate states.
        got: Rational,
    },
    /// An interval of friction in which absence or presence is claimed is empty, or reaches below
    /// zero.
    #[error("friction: expected 0 <= from < to, got from {from} to {to}")]
    FrictionRange {
        /// Lower end of the interval.
        from: Rational,
        /// Upper end.
        to: Rational,
    },
    /// The boxes of a certificate of absence or of presence in a range of friction do not hold.
    #[error("boxes{}: {fault}", place(*piece, *node))]
    Boxes {
        /// The piece, if one is to blame.
        piece: Option<usize>,
        /// The node in its tree.
        node: Option<usize>,
        /// What is wrong.
        fault: CoverFault,
    },
    /// The condensed pencil, or a matrix that has to be definite, does not hold.
    #[error("{fault}")]
    Matrices {
        /// What is wrong.
        fault: CoverFault,
    },
    /// The part of the accelerations that friction feels and `inertia` does not take away is too
    /// large.
    #[error("inertia: expected 2 to sum |E| <= mass_sigma = {allowed}, got {got}")]
    Inertia {
        /// `mass_sigma`.
        allowed: Rational,
        /// Twice `to` times the sum.
        got: Rational,
    },
    /// Q of an end is not symmetric.
    #[error("{end} end: symmetric: expected entry ({column}, {row}) at ({row}, {column})")]
    NotSymmetric {
        /// `lower` or `upper`.
        end: &'static str,
        /// Row, by slip variables.
        row: usize,
        /// Column.
        column: usize,
    },
    /// Q of an end is not below the condensed pencil.
    #[error("{end} end: symmetric[{row}][{column}]: expected at most {limit}, got {got}")]
    NotBelow {
        /// `lower` or `upper`.
        end: &'static str,
        /// Row, by slip variables.
        row: usize,
        /// Column.
        column: usize,
        /// The least that the entry of T less theta can be.
        limit: Rational,
        /// The entry of Q.
        got: Rational,
    },
    /// b of an end is too small.
    #[error("{end} end: bounds[{index}]: expected at least mu a + rho >= 0, got {got}")]
    Bound {
        /// `lower` or `upper`.
        end: &'static str,
        /// The slip variable.
        index: usize,
        /// b_i.
        got: Rational,
    },
    /// A complete set does not hold.
    #[error("complete set{}: {fault}", place(*piece, *node))]
    Cover {
        /// The piece, if one is to blame.
        piece: Option<usize>,
        /// The node in its tree.
        node: Option<usize>,
        /// What is wrong.
        fault: CoverFault,
    },
}

/// Where in a cover, as the message says it: ", piece 2, node 5".
fn place(piece: Option<usize>, node: Option<usize>) -> String {
    let mut text = String::new();
    if let Some(piece) = piece {
        text += &format!(", piece {piece}");
    }

    if let Some(node) = node {
        text += &format!(", node {node}");
    }

    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use mceip_exact::{Integer, rational};

    fn not_contracting(got: &Integer) -> Rejected {
        Rejected {
            is_negative: false,
            claim: Some(0),
            reason: Reason::NotContracting {
                index: 3,
                got: Rational::from_integer(got.clone()),
                radius: rational(1, 7),
            },
        }
    }

    #[test]
    fn long_numbers_are_cut_short_in_the_message_of_a_rejection() {
        let longest = Integer::from(10).pow(59); // 60 digits
        let message = not_contracting(&longest).to_string();
        assert!(message.starts_with("claim 0: Krawczyk: unknown 3:"));
        assert!(message.ends_with(&format!("got {longest} >= 1/7")));

        let longer = longest * 10;
        let message = not_contracting(&longer).to_string();
        assert!(message.ends_with("got 10000000000000000000...(61 digits) >= 1/7"));
    }
}
