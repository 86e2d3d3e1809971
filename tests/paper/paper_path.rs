//! The block of the paper and its loading path, computed once for all tests of this program.
#![cfg(feature = "solver")]

use mceip_exact::Rational;
use mceip_paper::{Block, BlockModel, Loading};
use mceip_path::{Contact, Equilibrium, LoadingPath, PathError, Stretch};
use std::ops::ControlFlow;
use std::sync::LazyLock;

pub(crate) struct PaperPath {
    pub(crate) block: Block,
    pub(crate) contact: Contact,
    pub(crate) path: LoadingPath,
}

pub(crate) static PAPER_PATH: LazyLock<PaperPath> = LazyLock::new(|| {
    let block = Block::new(&BlockModel::of_the_paper()).unwrap();
    let contact = block.contact_side().unwrap();
    let path = path_of(&contact);
    PaperPath {
        block,
        contact,
        path,
    }
});

/// The path of a block: the pressing, then the motion to the left, mm and N.
pub(crate) struct BlockPath {
    /// Depth of the pressing.
    pub(crate) depth: Rational,
    /// The equilibrium at its end.
    pub(crate) pressed: Equilibrium,
    pub(crate) motion: LoadingPath,
}

/// Follows a condensed block, never interrupted.
pub(crate) fn follow_contact(contact: &Contact, loading: &Loading) -> Result<BlockPath, PathError> {
    let steps = loading.steps(contact)?;
    let mut path = LoadingPath::follow(contact, &steps, &|_| ControlFlow::Continue(()))?;
    let pressing = path.stretches.remove(0);
    assert!(path.stretches.iter().all(|stretch| stretch.step == 1));

    Ok(BlockPath {
        depth: steps.amounts[0].clone().unwrap(),
        pressed: pressing.stop.unwrap(),
        motion: path,
    })
}

/// The motion of a condensed block under the loading of the paper.
pub(crate) fn path_of(contact: &Contact) -> LoadingPath {
    let path = follow_contact(contact, &Loading::of_the_paper());
    path.unwrap().motion
}

/// How many nodes slip, to either side.
pub(crate) fn slip_nodes(stretch: &Stretch) -> usize {
    let [_, left, right, _] = stretch.counts();
    left + right
}
