//! The loading of section 5: the glued side of a [`Block`] is pressed towards the obstacle until
//! the normal force is N, then moved to the left.
//!
//! A motion g of the glued side is a load on the other dofs: K vanishes on translations of the
//! whole block, so that the forces -K_fg g of the glued nodes are K applied to the translation of
//! all others. The pressing is proportional to its depth, so the depth at which the normal force is
//! N follows from a pressing by 1 mm. [`BlockModel::loads`] makes a body under loads of it, which
//! `mceip path` follows; units are mm and N.

use super::block::Block;
use super::block_model::BlockModel;
use super::error::SourceError;
use mceip_exact::{Rational, rational, whole};
use mceip_model::file::LoadsFile;
use mceip_model::{
    ContactCandidate, ContactState, LoadStep, LoadedBody, LoadedParts, PrescribedDisplacement,
};
use mceip_path::{Contact, LoadSteps, LoadingPath, LoadingPathEnd, PathError, require_positive};
use num_traits::Zero;
use std::ops::ControlFlow;

/// How the block is loaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loading {
    /// Coefficient of friction mu > 0.
    pub friction: Rational,
    /// Normal force N > 0 at the end of the pressing, N.
    pub force: Rational,
    /// Motion of the glued side at which to stop, mm; `None` to follow the path to its last event.
    pub until: Option<Rational>,
}

/// One mm of each load of a block, as a translation of the glued side; y points away from the
/// obstacle.
const PRESSING: [i64; 2] = [0, -1];
const MOTION: [i64; 2] = [-1, 0];

impl Loading {
    /// The paper's loading: mu = 1.1, 55 N, until nothing more happens.
    pub fn of_the_paper() -> Loading {
        Loading {
            friction: rational(11, 10),
            force: whole(55),
            until: None,
        }
    }

    /// Friction, and the mm of pressing and of motion: the steps of [`Block::contact_side`].
    ///
    /// # Errors
    /// [`PathError`]: what is not positive, a pressing without states or without pressure.
    ///
    /// ```
    /// use mceip_paper::{Block, BlockModel, Loading};
    /// use mceip_path::LoadingPath;
    /// let block = Block::new(&BlockModel::of_the_paper().with_cells(2, 1)).unwrap();
    /// let contact = block.contact_side().unwrap();
    /// let steps = Loading::of_the_paper().steps(&contact).unwrap();
    /// let path = LoadingPath::follow(&contact, &steps, &|_| {
    ///     std::ops::ControlFlow::Continue(())
    /// })
    /// .unwrap();
    /// assert!(path.slides());
    /// ```
    pub fn steps(&self, contact: &Contact) -> Result<LoadSteps, PathError> {
        require_positive("friction", &self.friction)?;
        require_positive("the normal force (N)", &self.force)?;
        if let Some(until) = &self.until {
            require_positive("the range of the motion (mm)", until)?;
        }

        let per_mm = normal_force_per_mm(contact, &self.friction)?;
        let amounts = vec![Some(&self.force / per_mm), self.until.clone()];
        Ok(LoadSteps::new(self.friction.clone(), amounts))
    }
}

/// The normal force (N) of a pressing by 1 mm, which is one stretch.
fn normal_force_per_mm(contact: &Contact, friction: &Rational) -> Result<Rational, PathError> {
    let steps = LoadSteps::new(friction.clone(), vec![Some(whole(1))]);
    let path = LoadingPath::follow(contact, &steps, &|_| ControlFlow::Continue(()))?;
    if let LoadingPathEnd::NoContinuation { why, .. } = path.end {
        return Err(PathError::NoContinuation(why));
    }

    let pressed = path
        .stretches
        .last()
        .and_then(|stretch| stretch.stop.as_ref());
    let normal = pressed.map_or_else(Rational::zero, |pressed| -pressed.resultants().1);
    require_positive("the normal force of a pressing by 1 mm (N)", &normal)?;
    Ok(normal)
}

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
        let loads = [PRESSING, MOTION].map(|mm| self.force_of_translation(mm));
        Contact::condense(&system, &gaps, &loads)
    }

    /// K applied to a translation of all nodes: the forces of the glued side for that motion. The
    /// dofs are along x and y in turn.
    fn force_of_translation(&self, translation: [i64; 2]) -> Vec<Rational> {
        let dofs = 0..self.stiffness.rows();
        let moved: Vec<Rational> = dofs.map(|dof| whole(translation[dof % 2])).collect();
        self.stiffness.times(&moved)
    }

    /// The load of this many mm of a translation.
    fn step(&self, name: &str, translation: [i64; 2], mm: &Rational) -> LoadStep {
        let mut forces = Vec::new();
        for (dof, force) in self.force_of_translation(translation).iter().enumerate() {
            if !force.is_zero() {
                forces.push((dof, force * mm));
            }
        }

        LoadStep {
            name: name.into(),
            forces,
            displacements: Vec::new(),
            is_endless: false,
        }
    }
}

impl BlockModel {
    /// The block as a body under loads: step 1 presses until the normal force is reached, step 2
    /// moves to the left by `until`; without it 1 mm is the unit of a step that has no end.
    ///
    /// # Errors
    /// [`SourceError`]: as [`Block::new`] and [`Loading::steps`].
    pub fn loads(&self, loading: &Loading) -> Result<LoadsFile, SourceError> {
        let block = Block::new(self)?;
        let contact = block.contact_side()?;
        let steps = loading.steps(&contact)?;
        let [depth, until] = &steps.amounts[..] else {
            unreachable!("a pressing and a motion");
        };

        let depth = depth.clone().unwrap_or_default();
        let until_or_unit = until.clone().unwrap_or_else(|| whole(1));
        let press = block.step("press", PRESSING, &depth);
        let motion = block.step("move", MOTION, &until_or_unit);
        let motion = LoadStep {
            is_endless: until.is_none(),
            ..motion
        };

        let states = vec![ContactState::Stick; block.contact.len()];
        let mut candidates = Vec::with_capacity(states.len());
        for particle in block.system(&states, None)?.particles() {
            candidates.push(ContactCandidate {
                particle: particle.clone(),
                gap: Rational::zero(),
            });
        }
        let body = LoadedBody::new(LoadedParts {
            stiffness: block.stiffness,
            mass: Some(block.mass),
            friction: Some(loading.friction.clone()),
            candidates,
            held: Vec::new(),
            steps: vec![press, motion],
        })?;

        let (nx, ny) = self.cells;
        let mesh = self.mesh.word();
        let plane = self.plane.word();
        let force = &loading.force;
        let coordinates = self.coordinates(body.system())?;
        let mut glued = Vec::new();
        for (step, (along, mm)) in [(PRESSING, &depth), (MOTION, &until_or_unit)]
            .into_iter()
            .enumerate()
        {
            for (node, placed) in coordinates.nodes().iter().enumerate() {
                if placed.dofs == [None, None] {
                    let by = along.map(|unit| mm * whole(unit));
                    glued.push(PrescribedDisplacement { step, node, by });
                }
            }
        }
        let coordinates = coordinates.with_prescribed(glued, body.steps().len())?;
        Ok(LoadsFile {
            name: Some(format!("block of {nx} x {ny} cells, {mesh}, plane {plane}")),
            comment: Some(format!(
                "Units: mm, N, t, s. The glued side is pressed down until the normal force is \
                 {force} N, then moved to the left."
            )),
            warnings: Vec::new(),
            body,
            coordinates: Some(coordinates),
        })
    }
}
