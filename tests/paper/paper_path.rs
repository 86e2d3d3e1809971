//! The block of the paper and its loading path, computed once for all tests of this program.
#![cfg(feature = "solver")]

use mceip_paper::path::{BlockPath, Loading};
use mceip_paper::{Block, BlockModel};
use mceip_path::{Contact, LoadingPath, Stretch};
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

/// The motion of a condensed block under the loading of the paper.
pub(crate) fn path_of(contact: &Contact) -> LoadingPath {
    let loading = Loading::of_the_paper();
    BlockPath::follow(contact, &loading, &|_, _| ControlFlow::Continue(()))
        .unwrap()
        .motion
}

/// How many nodes slip, to either side.
pub(crate) fn slip_nodes(stretch: &Stretch) -> usize {
    let [_, left, right, _] = stretch.counts();
    left + right
}
