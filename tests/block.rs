//! The polyurethane block: exact condensation, both published states found, certified, accepted.
#![cfg(feature = "testkit")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use mceip::source::{Block, MassKind, PublishedState};
use mceip::testkit::block_state;
use std::sync::atomic::AtomicBool;

#[test]
fn published_states_are_found_certified_and_accepted() {
    let block = Block::of_the_paper(MassKind::Consistent);
    for (state, decimals, slipping) in [(PublishedState::FifteenSlip, "60.805842", 14), (PublishedState::SeventeenSlip, "1.7048043", 17)] {
        let report = block_state(&block, state, &AtomicBool::new(false), &|_| {}).unwrap().unwrap();
        assert_eq!(report.accepted.len(), 1, "{}", state.name());
        assert!(report.uncertified.is_empty(), "{:?}", report.uncertified);
        let claim = &report.accepted[0];
        // Three digits fewer than printed by a run of this project (2026-11-21): a regression value.
        assert!(claim.value.starts_with(decimals), "{}", claim.value);
        assert_eq!(claim.slipping, slipping);
        assert_eq!(report.rejected_forgeries, report.forgeries);
        assert!(report.forgeries > 0);
    }
}
