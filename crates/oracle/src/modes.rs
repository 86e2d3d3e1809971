//! The enumerator of the split form: systems with particles in contact with zero reaction (z).
//!
//! The pencil of [`Reduced`] has the variables x = (x_f, x_s, g, v+, v-). A *choice of modes*
//! says of each s particle whether it slips, and of each z particle one of
//!
//! | mode | variables of the block | inequalities |
//! |---|---|---|
//! | open | g and v+, which here stands for v_T | g > 0 |
//! | sticking | none | p, s+, s- >= 0 |
//! | slipping right | v+ | v+ > 0, p >= 0 |
//! | slipping left | v- | v- > 0, p >= 0 |
//!
//! As in `plain`, the roots of the determinant of the block are the values and its kernel is x:
//! y = 0 on the block, x > 0 on the slipping s particles, y >= 0 on the others. In the open mode
//! y = 0 on the rows p and s+ means w_N = 0 and w_T = 0. In the slipping modes y = 0 on the row s+
//! or s- leaves 2 c mu p on the other.
//!
//! Choices in which no s particle slips have no solution (`spec/zero-reaction.md`, Z.2), so
//! (2^n_s - 1) 4^n_z choices are examined. The inequalities g > 0, v+ > 0 and v- > 0 make the
//! modes disjoint: nothing is listed twice.

use super::describe::compare_places;
use super::integer_pencil::{Eigenspace, IntegerPencil};
use super::physical::ParticleMode;
use super::plain::{OracleError, multiplicity, require_size};
use super::solution::Solution;
use mceip_exact::{Algebraic, Poly, Sign, roots_in};
use mceip_model::{Reduced, Window, ZeroVariables};
use std::ops::ControlFlow;

/// A choice of modes that is listed and not described.
#[derive(Debug, Clone)]
pub struct DegenerateChoice {
    /// The variables of the s particles that slip.
    pub slip: Vec<usize>,
    /// The mode of each z particle.
    pub zero: Vec<ParticleMode>,
    /// The value with a kernel of more than one dimension; `None`: singular at every value.
    pub value: Option<Algebraic>,
}

/// What the enumerator found.
#[derive(Debug, Clone, Default)]
pub struct ModeList {
    /// The solutions x >= 0 of the split form in which v+ or v- is 0 for each z particle, in the
    /// order of the choices, then by value. `slip` lists the positive complementarity variables.
    pub solutions: Vec<Solution>,
    /// What is not described.
    pub degenerate: Vec<DegenerateChoice>,
    /// Choices of modes examined.
    pub choices: u64,
    /// Choices of modes there are: (2^n_s - 1) 4^n_z.
    pub choices_total: u64,
}

impl ModeList {
    /// Were all choices examined?
    pub fn is_finished(&self) -> bool {
        self.choices == self.choices_total
    }

    /// Are these all solutions: all choices examined, and none left without a description?
    pub fn is_complete_list(&self) -> bool {
        self.is_finished() && self.degenerate.is_empty()
    }
}

/// All solutions of (9) with a value in the window, in the variables of the split form.
///
/// The work is (2^n_s - 1) 4^n_z determinants: meant for a few particles.
pub fn enumerate_modes(split: &Reduced, window: &Window) -> ModeList {
    let integers = IntegerPencil::from(&split.pencil);
    examine_all(split, &integers, window, |_, _| ControlFlow::Continue(()))
}

/// [`enumerate_modes`] with a callback (choices done, choices in all) after each choice; breaking
/// ends the run and keeps what was found. The solutions are sorted by value, then by slip set.
///
/// # Errors
/// [`OracleError::TooLarge`] where n_s + 2 n_z or the free variables are beyond
/// [`MAX_SLIP`](super::MAX_SLIP) and [`MAX_FREE`](super::MAX_FREE), or coefficients beyond
/// [`MAX_BITS`](super::MAX_BITS).
pub fn enumerate_modes_with(
    split: &Reduced,
    window: &Window,
    progress: impl FnMut(u64, u64) -> ControlFlow<()>,
) -> Result<ModeList, OracleError> {
    // Two bits say which of the four modes a z particle has.
    let bits = split.normalised().len() + 2 * split.zero.len();
    let integers = IntegerPencil::from(&split.pencil);
    require_size(&integers, "slip variables + 2 z particles", bits)?;

    let mut found = examine_all(split, &integers, window, progress);
    found
        .solutions
        .sort_by(|a, b| compare_places((&a.value, &a.slip), (&b.value, &b.slip)));

    Ok(found)
}

fn examine_all(
    split: &Reduced,
    integers: &IntegerPencil<'_>,
    window: &Window,
    mut progress: impl FnMut(u64, u64) -> ControlFlow<()>,
) -> ModeList {
    let modes = choices_of_modes(split.zero.len());
    let slip_variables = split.normalised();
    let slip_sets = (1u64 << slip_variables.len()) - 1;
    let mut found = ModeList {
        choices_total: slip_sets * modes.len() as u64,
        ..ModeList::default()
    };

    for number in 1..=slip_sets {
        let slip = members(&slip_variables, number);
        for zero in &modes {
            let choice = Choice {
                split,
                slip: &slip,
                zero,
            };
            choice.examine(integers, window, &mut found);

            found.choices += 1;
            if progress(found.choices, found.choices_total).is_break() {
                return found;
            }
        }
    }

    found
}

/// The variables whose bits are set in `number`.
fn members(variables: &[usize], number: u64) -> Vec<usize> {
    let mut set = Vec::new();
    for (bit, &variable) in variables.iter().enumerate() {
        if number >> bit & 1 == 1 {
            set.push(variable);
        }
    }

    set
}

/// The modes of a z particle. A particle that slides to the right has the sign -1.
const MODES: [ParticleMode; 4] = [
    ParticleMode::Open,
    ParticleMode::Sticking,
    RIGHT,
    ParticleMode::Slipping { sign: 1 },
];
const RIGHT: ParticleMode = ParticleMode::Slipping { sign: -1 };

/// Every choice of a mode for each of so many particles.
fn choices_of_modes(particles: usize) -> Vec<Vec<ParticleMode>> {
    let mut choices: Vec<Vec<ParticleMode>> = vec![Vec::new()];
    for _ in 0..particles {
        let mut longer = Vec::new();
        for choice in &choices {
            for mode in MODES {
                let mut extended = choice.clone();
                extended.push(mode);
                longer.push(extended);
            }
        }
        choices = longer;
    }

    choices
}

/// The variables of the block of a z particle in a mode.
fn block_of(variables: &ZeroVariables, mode: ParticleMode) -> Vec<usize> {
    match mode {
        ParticleMode::Open => vec![variables.gap, variables.right],
        ParticleMode::Sticking => vec![],
        RIGHT => vec![variables.right],
        ParticleMode::Slipping { .. } => vec![variables.left],
    }
}

/// A choice of modes.
struct Choice<'a> {
    split: &'a Reduced,
    slip: &'a [usize],
    zero: &'a [ParticleMode],
}

impl Choice<'_> {
    /// Its eigenvalues and kernels, and what of them satisfies the inequalities.
    fn examine(&self, pencil: &IntegerPencil<'_>, window: &Window, found: &mut ModeList) {
        let active = self.block(pencil);
        let det = pencil.determinant(&active);
        if det.is_zero() {
            found.degenerate.push(self.degenerate(None));
            return;
        }

        let roots = roots_in(&det, window.min(), window.max());
        for eigenspace in pencil.eigenspaces(&active, roots) {
            let Eigenspace { mut value, basis } = eigenspace;
            let [vector] = &basis[..] else {
                found.degenerate.push(self.degenerate(Some(value)));
                continue;
            };

            let multiplicity = multiplicity(&det, &mut value);
            let x = self.oriented(pencil.extend(&active, vector), &mut value);
            if let Some(solution) = self.solution(pencil, x, value, multiplicity) {
                found.solutions.push(solution);
            }
        }
    }

    /// Free variables, slipping s particles, and the blocks of the z particles, ascending.
    fn block(&self, pencil: &IntegerPencil<'_>) -> Vec<usize> {
        let mut support = self.slip.to_vec();
        for (variables, &mode) in self.split.zero.iter().zip(self.zero) {
            support.extend(block_of(variables, mode));
        }

        pencil.active(&support)
    }

    /// x or -x, whichever is not negative on the first s particle that slips.
    fn oriented(&self, x: Vec<Poly>, value: &mut Algebraic) -> Vec<Poly> {
        if value.sign_of(&x[self.slip[0]]) == Sign::Negative {
            x.iter().map(|x_i| -x_i).collect()
        } else {
            x
        }
    }

    /// The kernel vector as a solution of the split form, if it satisfies the inequalities.
    fn solution(
        &self,
        pencil: &IntegerPencil<'_>,
        mut x: Vec<Poly>,
        mut value: Algebraic,
        multiplicity: usize,
    ) -> Option<Solution> {
        let mut positive = self.slip.to_vec();
        for (variables, &mode) in self.split.zero.iter().zip(self.zero) {
            match mode {
                ParticleMode::Open => {
                    positive.push(variables.gap);
                    positive.extend(split_sliding(&mut x, variables, &mut value));
                }
                ParticleMode::Sticking => {}
                ParticleMode::Slipping { .. } => positive.extend(block_of(variables, mode)),
            }
        }

        for &i in &positive {
            if value.sign_of(&x[i]) != Sign::Positive {
                return None;
            }
        }

        positive.sort_unstable();
        let y = pencil.times(&x);
        let biactive = biactive_of(pencil, &positive, &y, &mut value)?;
        Some(Solution {
            value,
            multiplicity,
            slip: positive,
            biactive,
            x,
            y,
        })
    }

    fn degenerate(&self, value: Option<Algebraic>) -> DegenerateChoice {
        DegenerateChoice {
            slip: self.slip.to_vec(),
            zero: self.zero.to_vec(),
            value,
        }
    }
}

/// Replaces v+ = v_T < 0 by v- = -v_T; the variable that is positive then, if v_T is not 0.
fn split_sliding(
    x: &mut [Poly],
    variables: &ZeroVariables,
    value: &mut Algebraic,
) -> Option<usize> {
    match value.sign_of(&x[variables.right]) {
        Sign::Positive => Some(variables.right),
        Sign::Zero => None,
        Sign::Negative => {
            x[variables.left] = -&x[variables.right];
            x[variables.right] = Poly::default();
            Some(variables.left)
        }
    }
}

/// The variables with x = y = 0, if y >= 0 wherever x = 0.
fn biactive_of(
    pencil: &IntegerPencil<'_>,
    positive: &[usize],
    y: &[Poly],
    value: &mut Algebraic,
) -> Option<Vec<usize>> {
    let mut biactive = Vec::new();
    for (i, y_i) in y.iter().enumerate() {
        if !pencil.is_complementarity(i) || positive.contains(&i) {
            continue;
        }

        match value.sign_of(y_i) {
            Sign::Negative => return None,
            Sign::Zero => biactive.push(i),
            Sign::Positive => {}
        }
    }

    Some(biactive)
}
