//! The two states of the loading path whose MCEIP-mu value the paper prints (chapter 7 of the book,
//! 7.3). `mceip block`, the tests and the benchmarks solve them.

use super::block::Block;
use mceip_model::{Body, ContactState, ModelError, Problem, Unknown, Window};

/// A state of the loading path whose MCEIP-mu value the paper prints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PublishedState {
    /// 2 nodes stuck, 15 in impending slip, 4 free (Fig. 2).
    FifteenSlip,
    /// 17 nodes in impending slip, 4 free (Fig. 3).
    SeventeenSlip,
}

impl PublishedState {
    /// Both, in the paper's order.
    pub const ALL: [PublishedState; 2] =
        [PublishedState::FifteenSlip, PublishedState::SeventeenSlip];

    /// The value of mu as printed in the paper.
    pub fn printed_mu(self) -> &'static str {
        match self {
            PublishedState::FifteenSlip => "60.81",
            PublishedState::SeventeenSlip => "1.71",
        }
    }

    /// A short name.
    pub fn name(self) -> &'static str {
        match self {
            PublishedState::FifteenSlip => "2 stick + 15 slip + 4 free",
            PublishedState::SeventeenSlip => "17 slip + 4 free",
        }
    }

    /// The states of the 21 contact nodes, left to right.
    pub fn states(self) -> Vec<ContactState> {
        let stick = match self {
            PublishedState::FifteenSlip => 2,
            PublishedState::SeventeenSlip => 0,
        };

        let mut states = vec![ContactState::Free; 21];
        states[..stick].fill(ContactState::Stick);
        states[stick..17].fill(ContactState::Slip { sign: 1 });
        states
    }

    /// The MCEIP-mu problem of this state on the paper's block.
    ///
    /// # Errors
    /// [`ModelError`]; none for the block as given.
    pub fn problem(self, block: &Block) -> Result<Problem, ModelError> {
        let system = block.system(&self.states(), None)?;
        let problem = Problem::new(Body::System(system), Unknown::Mu, Window::all())?;
        Ok(problem.named(format!("block, {}", self.name())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(published: PublishedState, state: ContactState) -> usize {
        let states = published.states();
        states.into_iter().filter(|s| *s == state).count()
    }

    #[test]
    fn states_are_the_published_ones() {
        let slip = ContactState::Slip { sign: 1 };
        assert_eq!(count(PublishedState::FifteenSlip, slip), 15);
        assert_eq!(count(PublishedState::SeventeenSlip, slip), 17);
        assert_eq!(count(PublishedState::FifteenSlip, ContactState::Stick), 2);
    }
}
