//! The verification run as a test: a smaller one than `mceip verify`, same code.
#![cfg(feature = "testkit")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use mceip::testkit::verify;
use std::sync::atomic::AtomicBool;

#[test]
fn no_disagreement() {
    let t = std::time::Instant::now();
    let v = verify(60, 1, &AtomicBool::new(false), &|_, _, _| {}).unwrap();
    for f in &v.families {
        println!(
            "{} {}/{} oracle {} found {}/{} accepted {} uncert {} rejected {} degenerate {} corners {:?}",
            f.name,
            f.done,
            f.instances,
            f.oracle,
            f.found,
            f.findable,
            f.accepted,
            f.uncertified.len(),
            f.rejected,
            f.degenerate,
            f.corners
        );
        for d in f.disagreements.iter().take(8) {
            println!("   DIS {d}");
        }
        for d in f.uncertified.iter().take(4) {
            println!("   UNC {d}");
        }
    }
    for b in &v.block {
        println!("{:?} {:?} {:?} {}/{}", b.state, b.accepted, b.uncertified, b.rejected_forgeries, b.forgeries);
    }
    println!("{:?}", t.elapsed());
    assert_eq!(v.disagreements(), 0);
}
