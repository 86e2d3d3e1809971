//! The loading of section 5 as two steps: press the glued side of a [`Block`] until the normal
//! resultant is N, then move it to the left.
//!
//! A motion g of the glued side is a load on the other dofs: K vanishes on translations of the
//! whole block, so that the forces -K_fg g of the glued nodes are K applied to the translation of
//! all others. The pressing is proportional to its depth. So the path is followed for 1 mm of
//! pressing, and scaled by the depth at which the resultant is N.

use super::error::BlockPathError;
use super::loading::Loading;
use crate::block::Block;
use mceip_exact::{Rational, whole};
use mceip_model::ContactState;
use mceip_path::{Contact, Equilibrium, LoadSteps, LoadingPath, PathEnd, PathError};
use num_traits::{Signed, Zero};
use std::ops::ControlFlow;

/// The steps of the block's loading, by their number.
pub(super) const PRESS: usize = 0;
pub(super) const MOVE: usize = 1;

impl Block {
    /// The block condensed to its contact nodes, under the loads "glued side 1 mm towards the
    /// obstacle" and "glued side 1 mm to the left".
    ///
    /// # Errors
    /// [`PathError::Condensation`]; none for a block that was assembled.
    pub fn contact_side(&self) -> Result<Contact, PathError> {
        // Contact states play no part, and no node is open at the beginning.
        let states = vec![ContactState::Stick; self.contact.len()];
        let system = self.system(&states, None)?;
        let gaps = vec![Rational::zero(); states.len()];

        // The dofs along x and y in turn, y away from the obstacle.
        let towards_obstacle = self.force_of_translation([0, -1]);
        let to_the_left = self.force_of_translation([-1, 0]);
        Contact::condense(&system, &gaps, &[towards_obstacle, to_the_left])
    }

    /// K applied to a translation of all nodes: the forces of the glued side for that motion.
    fn force_of_translation(&self, translation: [i64; 2]) -> Vec<Rational> {
        let dofs = 0..self.stiffness.rows();
        let moved: Vec<Rational> = dofs.map(|dof| whole(translation[dof % 2])).collect();
        self.stiffness.times(&moved)
    }
}

/// The loading path of a block, in mm and N.
#[derive(Debug, Clone)]
pub struct BlockPath {
    /// How the block was loaded.
    pub loading: Loading,
    /// Depth of the pressing, mm.
    pub depth: Rational,
    /// States of the contact nodes during the pressing.
    pub pressing: Vec<ContactState>,
    /// The equilibrium at its end.
    pub pressed: Equilibrium,
    /// The motion to the left, stretch by stretch; its amounts are mm.
    pub motion: LoadingPath,
}

impl BlockPath {
    /// Follows the path; `progress` hears of each stretch of the motion (its number, the motion in
    /// mm) and may break off.
    ///
    /// # Errors
    /// [`BlockPathError`]: options out of range, a pressing without states or without pressure.
    ///
    /// ```
    /// use mceip_paper::path::{BlockPath, Loading};
    /// use mceip_paper::{Block, BlockModel};
    /// let block = Block::new(&BlockModel::of_the_paper().with_cells(2, 1)).unwrap();
    /// let contact = block.contact_side().unwrap();
    /// let path = BlockPath::follow(&contact, &Loading::of_the_paper(), &|_, _| {
    ///     std::ops::ControlFlow::Continue(())
    /// })
    /// .unwrap();
    /// assert!(path.motion.slides());
    /// ```
    pub fn follow(
        contact: &Contact,
        loading: &Loading,
        progress: &dyn Fn(usize, &Rational) -> ControlFlow<()>,
    ) -> Result<BlockPath, BlockPathError> {
        loading.validate()?;

        let pressing = press(contact, &loading.friction)?;
        let depth = depth(&pressing, &loading.force)?;

        let steps = LoadSteps {
            friction: loading.friction.clone(),
            amounts: vec![
                Some(whole(1)),
                loading.until.as_ref().map(|until| until / &depth),
            ],
        };
        let path = LoadingPath::follow(contact, &steps, &|at| {
            if at.step == PRESS {
                return ControlFlow::Continue(());
            }
            progress(at.stretch - 1, &(at.amount * &depth))
        })?;

        let mut path = path.scaled(&depth);
        path.stretches.retain(|stretch| stretch.step == MOVE);
        Ok(BlockPath {
            loading: loading.clone(),
            depth: depth.clone(),
            pressing: pressing.states,
            pressed: pressing.pressed.scaled(&depth),
            motion: path,
        })
    }
}

/// The pressing by 1 mm.
struct Pressing {
    states: Vec<ContactState>,
    /// The equilibrium at its end.
    pressed: Equilibrium,
}

/// Presses by 1 mm. Proportional to its depth, it is one stretch.
fn press(contact: &Contact, friction: &Rational) -> Result<Pressing, BlockPathError> {
    let steps = LoadSteps {
        friction: friction.clone(),
        amounts: vec![Some(whole(1))],
    };
    let path = LoadingPath::follow(contact, &steps, &|_| ControlFlow::Continue(()))?;
    if let PathEnd::NoContinuation { why, .. } = path.end {
        return Err(PathError::NoContinuation(why).into());
    }

    let stretch = path.stretches.into_iter().next();
    let Some((states, Some(pressed))) = stretch.map(|stretch| (stretch.states, stretch.stop))
    else {
        return Err(BlockPathError::NoPressure);
    };
    Ok(Pressing { states, pressed })
}

/// The pressing (mm) at which the normal resultant is -force, by proportion.
fn depth(pressing: &Pressing, force: &Rational) -> Result<Rational, BlockPathError> {
    let (_, per_mm) = pressing.pressed.resultants();
    if !per_mm.is_negative() {
        return Err(BlockPathError::NoPressure);
    }

    Ok(force / -per_mm)
}
