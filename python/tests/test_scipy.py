"""Against scipy: eigenvalues with all contacts slipping, and a trial of every choice of them."""

from collections import Counter

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse
import scipy.sparse.linalg
from bodies import lattice, random_body

import mceip

#: By friction: solutions with so many contacts that slip, how many of all of them `solve` finds,
#: and bodies without any.
EXPECTED = {
    0.5: {"absent": 25, "found": 0},
    2.0: {"absent": 20, "found": 5, 2: 3, 3: 2},
    8.0: {"absent": 9, "found": 21, 1: 6, 2: 11, 3: 3, 4: 1},
}


def test_solutions_with_all_contacts_slipping_are_eigenvalues_of_scipy_sparse():
    body = lattice(5, 6)
    friction = 3.0
    everyone = list(range(5))
    _, k, m = body.slip_pencil(friction, everyone)
    operator = scipy.sparse.csr_array(-scipy.linalg.solve(m, k))
    start = np.ones(operator.shape[0])
    found = scipy.sparse.linalg.eigs(operator, k=8, which="LR", v0=start)
    values = found[0]

    problem = body.problem(friction)
    everything = problem.complete()

    assert everything.is_complete
    all_slip = [s for s in everything.solutions if len(s.support) == len(everyone)]
    assert all_slip
    for solution in all_slip:
        distance = min(abs(value - solution.value) for value in values)
        assert distance < 1e-8 * solution.value


@pytest.mark.parametrize("friction", [0.5, 2.0, 8.0])
def test_solutions_are_those_of_a_trial_of_every_choice(friction):
    bodies = [lattice(4, 3), *(random_body(seed) for seed in range(24))]
    counts = Counter(absent=0, found=0)
    for body in bodies:
        by_trial = body.solutions_by_trial(friction)
        problem = body.problem(friction)

        everything = problem.complete()
        found = problem.solve(all=True)

        assert everything.is_complete
        assert len(everything.solutions) == len(by_trial)
        for solution, (value, slipping) in zip(everything.solutions, by_trial):
            assert abs(solution.value - value) < 1e-8
            slips = np.array(solution.v)[body.tangential] < 0
            assert list(np.flatnonzero(slips)) == slipping
            counts[len(slipping)] += 1

        values = [value for value, _ in by_trial]
        for solution in found.solutions:
            assert min(abs(solution.value - value) for value in values) < 1e-8
        counts["found"] += len(found.solutions)
        counts["absent"] += not by_trial

    assert dict(counts) == EXPECTED[friction]


def test_the_perron_root_of_a_pencil_is_found():
    rng = np.random.default_rng(7)
    for _ in range(10):
        # (A + t I) x = 0 with x > 0 for the largest t alone, the root of Perron of -A > 0.
        a = rng.integers(-3, 0, (4, 4)).astype(float)
        largest = max(value.real for value in scipy.linalg.eigvals(-a))

        solutions = mceip.Problem.from_pencil(a, np.eye(4)).complete().solutions

        whole = [s.value for s in solutions if s.support == [0, 1, 2, 3]]
        assert len(whole) == 1
        assert abs(whole[0] - largest) < 1e-9 * largest
