//! Table 1: closed form = enumerator = what the solver finds, certified and accepted.
#![cfg(feature = "solver")]

use mceip::certify::certificate;
use mceip::check::check;
use mceip::exact::{rational, whole};
use mceip::model::{Admissible, Body, Problem, Unknown, Window};
use mceip::multistart::{Search, multistart};
use mceip::oracle::{TwoParticles, enumerate, table1};
use mceip::reduction::reduce;
use mceip::source::two_particles;

#[test]
fn solver_finds_what_the_oracle_lists() {
    for signs in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
        for mu in [1, 2, 5, 20] {
            let data = TwoParticles { c: rational(3, 5), s: rational(4, 5), k: whole(7), m: whole(2), mu: whole(mu), signs };
            let problem = Problem::new(Body::System(two_particles(&data).unwrap()), Unknown::Lambda2, Window::all()).unwrap();
            let pencil = reduce(&problem).unwrap().pencil;
            let oracle = enumerate(&pencil, problem.window()).unwrap();
            assert_eq!(oracle.solutions.len(), table1(&data).len());
            let admissible = Admissible::new(&pencil, Unknown::Lambda2).unwrap();
            let found = multistart(&admissible, problem.window(), &Search::default()).unwrap();
            println!("{signs:?} {mu}: {} {:?} {:?}", found.certified.len(), found.terminations, found.uncertified);
            assert_eq!(found.certified.len(), oracle.solutions.len());
            if !found.certified.is_empty() {
                let claims = found.certified.iter().map(|c| c.claim.clone()).collect();
                check(&problem, &certificate(&problem, claims)).unwrap();
            }
        }
    }
}
