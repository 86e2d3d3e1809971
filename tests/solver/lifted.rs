//! Claims in the degrees of freedom of a system (lifted claims), as the checker sees them.
//!
//! The truth is the exact enumerator: every solution it lists lifts to a claim that is accepted,
//! and whose forgeries are refused. `spec/corpus` has a forgery of each line of (9), `lifted-*`.
#![cfg(feature = "testkit")]

use mceip_check::certificate::{Certificate, Claim, ExactSolution};
use mceip_check::{Accepted, Reason, check};
use mceip_engine::certify::{flattened, lifted, propose};
use mceip_model::reduction::reduce;
use mceip_model::{Pencil, Problem, Window};
use mceip_oracle::{Solution, enumerate};
use mceip_testkit::{forgeries, in_doubles, mechanical, system_of};

/// The exact claim for a solution that the enumerator lists.
fn exact_claim(pencil: &Pencil, window: &Window, solution: &Solution) -> ExactSolution {
    let candidate = in_doubles(solution, &pencil.slip());
    match propose(pencil, window, &candidate).unwrap() {
        Claim::ExactSolution(claim) => claim,
        other => panic!("{other:?}"),
    }
}

/// Exact claims for all that the enumerator lists.
fn exact_claims(problem: &Problem) -> Vec<ExactSolution> {
    let pencil = reduce(problem).unwrap().pencil;
    let answer = enumerate(&pencil, problem.window()).unwrap();

    let mut claims = Vec::new();
    for solution in &answer.solutions {
        claims.push(exact_claim(&pencil, problem.window(), solution));
    }
    claims
}

/// What the checker says of one claim.
fn verdict(problem: &Problem, claim: Claim) -> Result<Accepted, Reason> {
    let certificate = Certificate::of_claims(problem, vec![claim]);
    check(problem, &certificate).map_err(|rejection| rejection.reason)
}

/// All forgeries of the certificate are refused for the reason that each expects; their number.
fn count_of_refused_forgeries(problem: &Problem, own: &Certificate) -> usize {
    let mut count = 0;
    for forgery in forgeries(own) {
        let rejection = check(problem, &forgery.certificate).expect_err(forgery.name);
        let reason = rejection.reason;
        assert!((forgery.expected)(&reason), "{}: {reason}", forgery.name);
        count += 1;
    }
    count
}

#[test]
fn every_solution_of_random_systems_is_accepted_lifted_and_its_forgeries_are_not() {
    let mut count = 0;
    let mut forged = 0;

    for instance in mechanical(60, 5).unwrap() {
        let label = &instance.label;
        let problem = &instance.problem;
        let system = system_of(problem);

        for exact in exact_claims(problem) {
            let claim = lifted(system, problem.unknown(), &exact);
            assert_eq!(flattened(system, &claim), exact, "{label}");

            let own = Certificate::of_claims(problem, vec![Claim::LiftedSolution(claim)]);
            let accepted = match check(problem, &own) {
                Ok(accepted) => accepted,
                Err(rejection) => panic!("{label}: {rejection}"),
            };
            let accepted_exact = verdict(problem, Claim::ExactSolution(exact)).unwrap();
            assert_eq!(accepted.claims, accepted_exact.claims);
            assert_eq!(Certificate::from_json(&own.to_json()).unwrap(), own);

            forged += count_of_refused_forgeries(problem, &own);
            count += 1;
        }
    }

    assert!(count > 20, "{count} {forged}");
    assert!(forged > 8 * count, "{count} {forged}");
}
