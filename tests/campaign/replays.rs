//! What the campaign has found, shrunk by it: none of it may come back. What each was is told in
//! `spec/verifying.md`.
//!
//! The truth is the judgement of the campaign itself: a fault that returns is a finding again.
#![cfg(feature = "testkit")]

use mceip_testkit::campaign::{Replay, judge, standard};
use std::path::Path;

#[test]
fn what_the_campaign_found_stays_mended() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/replays");
    let mut count = 0;

    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let replay = Replay::from_json(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let judged = judge(&replay.case().unwrap(), &standard(replay.seed));

        assert!(
            judged.findings.is_empty(),
            "{}: {:#?}",
            path.display(),
            judged.findings
        );
        count += 1;
    }

    assert!(count >= 10);
}
