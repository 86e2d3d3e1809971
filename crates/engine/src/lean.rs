//! Lean certificates (`mceip-lean/1`): the same without W and V, which are made anew.
//!
//! The matrices of an anchor are witnesses: whatever numbers stand there, the checker computes
//! their residuals exactly and believes nothing else (`check::cover::condensed`). They take most of
//! the file of a large body. A lean certificate names the centre of each anchor and the binary
//! exponent of each coefficient, and leaves the rows out:
//!
//! ```text
//!     {"center": "3/2", "right": [{"exponent": 34}, {"exponent": 32}], ...}
//! ```
//!
//! [`elaborate`] computes the coefficients of W and V from
//!
//! ```text
//!     F_c W_k = [k = 0] T_fs(c) + [k = 1] B_fs - B_ff W_(k-1)
//! ```
//!
//! in doubles and rounds each to its exponent. What it returns goes to the checker as if it had
//! been read from a file. [`shorten`] leaves out only what it has made anew and found to be the
//! same, so that both forms have one verdict; what has more digits than doubles stays.
//!
//! Input: a problem and a certificate with a condensation. Relies on `search::complete::pieces`,
//! where anchors are made. Nothing here is trusted.

use crate::analysis::friction_parts;
use crate::run::{Progress, Watch, in_threads};
use crate::search::complete::pieces::anchor::{CenterSolver, MAX_EXPONENT};
use crate::search::complete::pieces::blocks::{FreeEquations, PencilBlocks};
use crate::search::complete::pieces::reverse::exchanged;
use mceip_check::Provable;
use mceip_check::certificate::{
    Anchor, CERTIFICATE_FORMAT, CRITICAL_FORMAT, Certificate, CriticalAnchor, CriticalCertificate,
    IntegerMatrix, PRESENCE_FORMAT, PresenceCertificate,
};
use mceip_exact::{Rational, to_f64};
use mceip_model::file::{from_json, from_json_of_with_unique_keys, require_format, to_json_of};
use mceip_model::reduction::reduce;
use mceip_model::{Body, ModelError, Pencil, Problem};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The format of lean certificates.
pub const LEAN_FORMAT: &str = "mceip-lean/1";

/// Coefficients of one matrix, at most: the checker takes no more.
const MAX_COEFFICIENTS: usize = 8;

/// Anchors of one certificate that are made anew, at most: each costs a factorization.
const MAX_ANCHORS: usize = 1 << 10;

/// Integers that are made anew for one certificate, at most: eight bytes each.
const MAX_INTEGERS: usize = 1 << 30;

/// Why a certificate has no other form.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeanError {
    /// No certificate of this format, or a problem that is not reduced.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The certificate is about another problem.
    #[error("problem_sha256: expected {expected}, the digest of the problem, got {got}")]
    OtherProblem {
        /// Of the problem.
        expected: String,
        /// Of the certificate.
        got: String,
    },
    /// A certificate over the friction is about a mechanical system.
    #[error("certificate over the friction: expected a mechanical system, got a pencil")]
    NoSystem,
    /// A certificate that has no lean form.
    #[error(
        "certificate: expected {CERTIFICATE_FORMAT}, {CRITICAL_FORMAT} or {PRESENCE_FORMAT} with \
         anchors that can be made anew, which have a lean form; got another one"
    )]
    NoAnchors,
    /// The lean file is not read as it was written.
    #[error("lean certificate: expected to read what was written, got another certificate")]
    NotAsWritten,
    /// More is left out than is made anew.
    #[error("{what}: expected at most {limit}, got {got}")]
    TooLarge {
        /// What is too large.
        what: &'static str,
        /// The limit.
        limit: usize,
        /// What was found.
        got: usize,
    },
    /// F is not definite at a centre.
    #[error(
        "anchor about {0}: expected F definite there in doubles, to make W anew, and it is not"
    )]
    NotDefinite(Rational),
    /// The run was cancelled.
    #[error("interrupted before all anchors were made anew")]
    Interrupted,
}

/// A kind of certificate whose anchors can be left out.
pub trait HasAnchors: Provable<Subject = Problem> + Clone {
    /// Digest of the problem.
    fn digest(&self) -> &str;

    /// The pencils that the anchors expand: T, or T0 and T1; none where the problem has no such
    /// pencils.
    ///
    /// # Errors
    /// [`ModelError`]: the problem is not reduced.
    fn pencils(problem: &Problem) -> Result<Vec<Pencil>, ModelError>;

    /// The matrices of each anchor.
    fn anchors(&mut self) -> Vec<AnchorMatrices<'_>>;
}

/// The matrices of an anchor.
pub struct AnchorMatrices<'a> {
    center: &'a Rational,
    reversed: bool,
    /// Coefficients of W and V, each with the pencil and the block that it solves for.
    solutions: Vec<(RightHandSide, &'a mut Vec<IntegerMatrix>)>,
}

/// The right-hand side of a solution: T_fs or T_sf' of the pencil with this number.
#[derive(Clone, Copy)]
enum RightHandSide {
    Right(usize),
    Left(usize),
}

impl HasAnchors for Certificate {
    fn digest(&self) -> &str {
        &self.problem_sha256
    }

    fn pencils(problem: &Problem) -> Result<Vec<Pencil>, ModelError> {
        Ok(vec![reduce(problem)?.pencil])
    }

    fn anchors(&mut self) -> Vec<AnchorMatrices<'_>> {
        let complete = self.complete_set.as_mut();
        let condensation = complete.and_then(|set| set.condensation.as_mut());
        let anchors = condensation.into_iter().flat_map(|c| &mut c.anchors);
        anchors.map(matrices).collect()
    }
}

fn matrices(anchor: &mut Anchor) -> AnchorMatrices<'_> {
    let Anchor {
        center,
        reversed,
        right,
        left,
    } = anchor;
    AnchorMatrices {
        center: &center.0,
        reversed: *reversed,
        solutions: vec![
            (RightHandSide::Right(0), right),
            (RightHandSide::Left(0), left),
        ],
    }
}

macro_rules! condensed_over_friction {
    ($kind:ty) => {
        impl HasAnchors for $kind {
            fn digest(&self) -> &str {
                &self.problem_sha256
            }

            fn pencils(problem: &Problem) -> Result<Vec<Pencil>, ModelError> {
                over_friction(problem)
            }

            fn anchors(&mut self) -> Vec<AnchorMatrices<'_>> {
                let anchors = self.condensation.iter_mut().flat_map(|c| &mut c.anchors);
                anchors.map(matrices_over_friction).collect()
            }
        }
    };
}

condensed_over_friction!(CriticalCertificate);
condensed_over_friction!(PresenceCertificate);

/// T0 and T1, which a pencil that is given without a body has not.
fn over_friction(problem: &Problem) -> Result<Vec<Pencil>, ModelError> {
    match problem.body() {
        Body::System(system) => Ok(friction_parts(system)?.into()),
        Body::Pencil(_) | Body::Quadratic(_) => Ok(Vec::new()),
    }
}

fn matrices_over_friction(anchor: &mut CriticalAnchor) -> AnchorMatrices<'_> {
    let CriticalAnchor {
        center,
        reversed,
        right,
        left,
        left_friction,
    } = anchor;
    let mut solutions = vec![(RightHandSide::Right(0), right)];
    solutions.extend(left.as_mut().map(|left| (RightHandSide::Left(0), left)));
    solutions.push((RightHandSide::Left(1), left_friction));
    AnchorMatrices {
        center: &center.0,
        reversed: *reversed,
        solutions,
    }
}

/// The certificate in a lean file, as a file of its own kind: the coefficients that were left out
/// have no rows.
///
/// # Errors
/// [`LeanError`]: no file of this format, or one of a kind without anchors.
pub fn skeleton(text: &str) -> Result<String, LeanError> {
    let LeanFile { mut certificate } = from_json_of_with_unique_keys(LEAN_FORMAT, text)?;
    for matrix in matrices_of(&mut certificate) {
        matrix.entry("rows").or_insert_with(|| json!([]));
    }

    let text = certificate.to_string();
    drop(certificate); // many times as long as its text
    match AnchoredKind::of(&text) {
        Some(_) => Ok(text),
        None => Err(LeanError::NoAnchors),
    }
}

/// Makes what was left out of a certificate anew.
///
/// # Errors
/// [`LeanError`]: it is about another problem, or cannot be made anew.
pub fn elaborate<C: HasAnchors>(
    problem: &Problem,
    certificate: &mut C,
    watch: &Watch<'_>,
) -> Result<(), LeanError> {
    visit(problem, certificate, watch, is_left_out, |list, made| {
        let is_made = made.is_some();
        if let Some(made) = made {
            *list = made;
        }
        is_made
    })
}

/// The lean file of a certificate; `None` where nothing can be left out.
///
/// # Errors
/// [`LeanError`]: it is about another problem, or an interrupt.
pub fn shorten<C: HasAnchors>(
    problem: &Problem,
    certificate: &C,
    watch: &Watch<'_>,
) -> Result<Option<String>, LeanError> {
    let mut certificate = certificate.clone();
    let may_be_left_out =
        |list: &[IntegerMatrix]| !is_left_out(list) && require_makeable(list).is_ok();
    visit(
        problem,
        &mut certificate,
        watch,
        may_be_left_out,
        |list, made| {
            if made.as_ref() == Some(list) {
                list.iter_mut()
                    .for_each(|matrix| matrix.rows = Arc::default());
            }
            true
        },
    )?;

    let mut anchors = certificate.anchors().into_iter();
    if !anchors.any(|anchor| anchor.solutions.iter().any(|(_, list)| is_left_out(list))) {
        return Ok(None);
    }

    let file = written(&certificate.text())?;

    // What is made of the file is the certificate that was given: nothing got lost on the way.
    if C::read(&skeleton(&file)?)? != certificate {
        return Err(LeanError::NotAsWritten);
    }
    Ok(Some(file))
}

/// The lean file of a certificate whose coefficients to be left out have no rows.
fn written(certificate: &str) -> Result<String, LeanError> {
    let mut lean = LeanFile {
        certificate: from_json(certificate)?,
    };
    for matrix in matrices_of(&mut lean.certificate) {
        if matrix["rows"] == json!([]) {
            matrix.remove("rows");
        }
    }

    Ok(to_json_of(LEAN_FORMAT, &lean))
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LeanFile {
    certificate: Value,
}

/// The coefficients of all anchors in the file of a certificate.
fn matrices_of(certificate: &mut Value) -> Vec<&mut Map<String, Value>> {
    let holder = match certificate.get("complete_set") {
        Some(_) => &mut certificate["complete_set"],
        None => certificate,
    };
    let anchors = holder
        .pointer_mut("/condensation/anchors")
        .and_then(Value::as_array_mut);

    let mut matrices = Vec::new();
    for anchor in anchors
        .into_iter()
        .flatten()
        .filter_map(Value::as_object_mut)
    {
        for (name, list) in anchor {
            if ["right", "left", "left_friction"].contains(&name.as_str()) {
                let list = list.as_array_mut().into_iter().flatten();
                matrices.extend(list.filter_map(Value::as_object_mut));
            }
        }
    }

    matrices
}

/// Have these coefficients no rows?
fn is_left_out(list: &[IntegerMatrix]) -> bool {
    !list.is_empty() && list.iter().all(|matrix| matrix.rows.is_empty())
}

/// Refuses coefficients that are not made in doubles.
fn require_makeable(list: &[IntegerMatrix]) -> Result<(), LeanError> {
    at_most("coefficients of an anchor", MAX_COEFFICIENTS, list.len())?;
    let exponents = list.iter().map(|matrix| matrix.exponent as usize);
    let largest = exponents.max().unwrap_or(0);
    at_most(
        "binary exponent of a coefficient",
        MAX_EXPONENT as usize,
        largest,
    )
}

/// Makes those coefficients of the anchors that are `wanted` anew, several anchors at a time, and
/// hands them to `settle`: `None` where F is not definite in doubles, which `settle` may refuse by
/// `false`.
fn visit<C: HasAnchors>(
    problem: &Problem,
    certificate: &mut C,
    watch: &Watch<'_>,
    wanted: impl Fn(&[IntegerMatrix]) -> bool,
    settle: impl Fn(&mut Vec<IntegerMatrix>, Option<Vec<IntegerMatrix>>) -> bool + Sync,
) -> Result<(), LeanError> {
    let expected = problem.sha256();
    if certificate.digest() != expected {
        let got = certificate.digest().to_owned();
        return Err(LeanError::OtherProblem { expected, got });
    }

    let mut anchors = certificate.anchors();
    for anchor in &mut anchors {
        anchor.solutions.retain(|(_, list)| wanted(list));
    }
    anchors.retain(|anchor| !anchor.solutions.is_empty());
    if anchors.is_empty() {
        return Ok(());
    }

    let pencils = C::pencils(problem)?;
    if pencils.is_empty() {
        return Err(LeanError::NoSystem);
    }
    let makers = Makers::of(&pencils)?;
    makers.require_few(&anchors)?;

    let total = anchors.len();
    let begun = AtomicUsize::new(0);
    let make_anew = |anchor| {
        let number = begun.fetch_add(1, Ordering::Relaxed);
        watch.report(&Progress::of("anchors made anew", number, total));
        if watch.is_cancelled() {
            return Err(LeanError::Interrupted);
        }
        makers.visit(anchor, &settle)
    };
    let visited: Vec<Result<(), LeanError>> =
        in_threads(None, || anchors.into_par_iter().map(make_anew).collect());

    // In the order of the anchors: of several refusals the first one is told.
    visited.into_iter().collect()
}

/// What the anchors of a certificate are made from.
struct Makers {
    direct: Vec<PencilBlocks>,
    /// Of the pencils with their matrices exchanged.
    reversed: Vec<PencilBlocks>,
}

impl Makers {
    fn of(pencils: &[Pencil]) -> Result<Makers, ModelError> {
        let exchanged = pencils.iter().map(exchanged);
        let exchanged = exchanged.collect::<Result<Vec<_>, _>>()?;
        Ok(Makers {
            direct: pencils.iter().map(PencilBlocks::of).collect(),
            reversed: exchanged.iter().map(PencilBlocks::of).collect(),
        })
    }

    /// Makes the coefficients of an anchor anew and hands them to `settle`; see [`visit`].
    fn visit(
        &self,
        anchor: AnchorMatrices<'_>,
        settle: &impl Fn(&mut Vec<IntegerMatrix>, Option<Vec<IntegerMatrix>>) -> bool,
    ) -> Result<(), LeanError> {
        let blocks = if anchor.reversed {
            &self.reversed
        } else {
            &self.direct
        };
        let solver = CenterSolver::about(&blocks[0], to_f64(anchor.center));
        for (block, list) in anchor.solutions {
            let exponents: Vec<u32> = list.iter().map(|matrix| matrix.exponent).collect();
            let made = solver.as_ref();
            let made = made.map(|solver| solver.rounded_to(block.of(blocks), &exponents));
            if !settle(list, made) {
                return Err(LeanError::NotDefinite(anchor.center.clone()));
            }
        }

        Ok(())
    }

    /// Refuses what would take too long or too much memory.
    fn require_few(&self, anchors: &[AnchorMatrices<'_>]) -> Result<(), LeanError> {
        at_most("anchors to be made anew", MAX_ANCHORS, anchors.len())?;
        let mut matrices: usize = 0;
        for (_, list) in anchors.iter().flat_map(|anchor| &anchor.solutions) {
            require_makeable(list)?;
            matrices += list.len();
        }

        let PencilBlocks { free, slip, .. } = &self.direct[0];
        let entries = free.len().saturating_mul(slip.len());
        at_most(
            "integers to be made anew",
            MAX_INTEGERS,
            matrices.saturating_mul(entries),
        )
    }
}

fn at_most(what: &'static str, limit: usize, got: usize) -> Result<(), LeanError> {
    if got > limit {
        return Err(LeanError::TooLarge { what, limit, got });
    }

    Ok(())
}

impl RightHandSide {
    fn of(self, blocks: &[PencilBlocks]) -> &FreeEquations {
        match self {
            RightHandSide::Right(number) => &blocks[number].right,
            RightHandSide::Left(number) => &blocks[number].left,
        }
    }
}

/// The lean file of a certificate's file; `None` where nothing can be left out.
///
/// # Errors
/// [`LeanError`]: no certificate, one of another problem, or an interrupt.
pub fn shorten_file(
    problem: &Problem,
    text: &str,
    watch: &Watch<'_>,
) -> Result<Option<String>, LeanError> {
    fn of<C: HasAnchors>(
        problem: &Problem,
        text: &str,
        watch: &Watch<'_>,
    ) -> Result<Option<String>, LeanError> {
        shorten(problem, &C::read(text)?, watch)
    }

    match AnchoredKind::of(text) {
        Some(AnchoredKind::Solutions) => of::<Certificate>(problem, text, watch),
        Some(AnchoredKind::Absence) => of::<CriticalCertificate>(problem, text, watch),
        Some(AnchoredKind::Presence) => of::<PresenceCertificate>(problem, text, watch),
        None => Ok(None),
    }
}

/// The certificate's file of a lean file.
///
/// # Errors
/// [`LeanError`]: no lean file, one of another problem, one that cannot be made anew, an interrupt.
pub fn elaborate_file(
    problem: &Problem,
    text: &str,
    watch: &Watch<'_>,
) -> Result<String, LeanError> {
    fn of<C: HasAnchors>(
        problem: &Problem,
        text: &str,
        watch: &Watch<'_>,
    ) -> Result<String, LeanError> {
        let mut certificate = C::read(text)?;
        elaborate(problem, &mut certificate, watch)?;
        Ok(certificate.text())
    }

    let text = skeleton(text)?;
    match AnchoredKind::of(&text) {
        Some(AnchoredKind::Solutions) => of::<Certificate>(problem, &text, watch),
        Some(AnchoredKind::Absence) => of::<CriticalCertificate>(problem, &text, watch),
        Some(AnchoredKind::Presence) => of::<PresenceCertificate>(problem, &text, watch),
        None => Err(LeanError::NoAnchors),
    }
}

/// A kind of certificate with anchors.
enum AnchoredKind {
    Solutions,
    Absence,
    Presence,
}

impl AnchoredKind {
    /// That of a file.
    fn of(text: &str) -> Option<AnchoredKind> {
        let is = |format| require_format(text, format).is_ok();
        if is(CERTIFICATE_FORMAT) {
            Some(AnchoredKind::Solutions)
        } else if is(CRITICAL_FORMAT) {
            Some(AnchoredKind::Absence)
        } else {
            is(PRESENCE_FORMAT).then_some(AnchoredKind::Presence)
        }
    }
}
