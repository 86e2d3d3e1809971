"""The module from outside: answers of the book's examples, other people's matrices, refusals.

The truth is the book (`spec/examples/`) and scipy's own eigenvalues.
"""

import copy
import os
import signal
import threading
from fractions import Fraction

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse

import mceip

EXAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "spec", "examples")


def example(name):
    return mceip.Problem.read(os.path.join(EXAMPLES, name + ".json"))


def point(k=None, **contact):
    """The mass point of the README."""
    k = [[2.0, 1.5], [1.5, 2.0]] if k is None else k
    slip = {"tangential": 0, "normal": 1, "state": "slip", "sign": -1, **contact}
    return mceip.Problem.from_matrices(k, np.eye(2), "1.5", [mceip.Contact(**slip)])


def test_the_fold_has_two_solutions_and_no_others():
    problem = example("fold")

    found = problem.solve()
    everything = problem.complete()

    assert [s.value for s in found.solutions] == [2.0, 3.0]
    assert everything.is_complete and not everything.is_empty
    assert [s.exact_value for s in everything.solutions] == [2, 3]
    accepted = mceip.check(problem, everything.certificate)
    assert accepted.is_complete
    assert [c.support for c in accepted.solutions] == [[0, 1], [0, 1]]


def test_a_changed_certificate_and_another_problem_are_rejected():
    problem = example("fold")
    certificate = problem.solve().certificate
    assert len(mceip.check(problem, certificate).claims) == 2

    forged = copy.deepcopy(certificate)
    claim = next(iter(forged["claims"][0].values()))
    claim["support"] = [0]
    with pytest.raises(mceip.RejectedError):
        problem.check(forged)
    with pytest.raises(mceip.RejectedError, match="digest|SHA"):
        point().check(certificate)
    with pytest.raises(mceip.MceipError):
        problem.check("no certificate")


def test_matrices_of_numpy_scipy_and_lists_are_one_problem():
    dense = np.array([[2.0, 1.5], [1.5, 2.0]])

    digests = {point(k).sha256 for k in (dense, dense.tolist())}
    for kind in (scipy.sparse.csr_matrix, scipy.sparse.coo_array, scipy.sparse.lil_matrix):
        digests.add(point(kind(dense)).sha256)

    assert len(digests) == 1
    assert [s.exact_value for s in point().complete().solutions] == [Fraction(1, 4)]


def test_a_float_is_the_number_it_is_and_text_the_one_it_spells():
    def at(friction):
        contacts = [mceip.Contact(0, 1, "slip", sign=-1)]
        k = [[2.0, 1.5], [1.5, 2.0]]
        return mceip.Problem.from_matrices(k, np.eye(2), friction, contacts).sha256

    assert at("0.1") == at(Fraction(1, 10)) == at("1/10")
    assert at(0.1) != at("0.1")
    assert at(0.5) == at("0.5")


def test_all_slip_solutions_are_eigenvalues_of_scipy():
    rng = np.random.default_rng(7)
    compared = 0
    for _ in range(20):
        # A Z-matrix with B = I: x > 0 for the largest t, the eigenvalue of Perron.
        a = rng.integers(-3, 0, (4, 4)).astype(float)
        values = scipy.linalg.eigvals(-a)
        largest = max(v.real for v in values)

        problem = mceip.Problem.from_pencil(a, np.eye(4))
        solutions = problem.complete().solutions

        whole = [s.value for s in solutions if s.support == [0, 1, 2, 3]]
        assert len(whole) == 1
        assert abs(whole[0] - largest) < 1e-9 * largest
        compared += 1
    assert compared == 20


def test_the_analysis_says_it_in_a_paragraph_and_hands_over_its_proofs():
    analysis = example("point").analyze(samples=0)

    assert analysis.verdict == "present"
    assert str(analysis) == analysis.summary
    lower, upper = analysis.critical_friction
    assert lower <= Fraction(4, 3) <= upper
    assert analysis.proofs
    for proof in analysis.proofs:
        if proof.certificate["format"] == "mceip-certificate/1":
            import json

            mceip.check(mceip.Problem.from_json(json.dumps(proof.problem)), proof.certificate)


def test_a_point_is_certified_and_a_wrong_one_is_not():
    problem = example("fold")

    certified = problem.certify(2.0000001, [0.666667, 0.333333])

    assert certified.solution.exact_value == 2
    mceip.check(problem, certified.certificate)
    with pytest.raises(mceip.NotCertifiedError):
        problem.certify(2.5, [0.5, 0.5])


def test_what_is_no_problem_is_refused_with_its_place():
    with pytest.raises(mceip.MceipError, match="slip"):
        point(state="slides")
    with pytest.raises(mceip.MceipError, match="sign"):
        point(sign=None)
    with pytest.raises(mceip.MceipError, match="mass"):
        contact = mceip.Contact(0, 1, "slip", sign=1)
        mceip.Problem.from_matrices(np.eye(2), np.eye(3), "1", [contact])
    with pytest.raises(mceip.MceipError, match="one length"):
        point([[1.0, 2.0], [3.0]])
    with pytest.raises(mceip.MceipError, match="finite"):
        point().in_window(float("nan"))
    with pytest.raises(mceip.MceipError):
        point([[2.0, 1.0], [1.5, 2.0]])  # not symmetric
    with pytest.raises(mceip.MceipError):
        mceip.Problem.read("no-such-file.json")


def test_progress_is_heard_and_an_exception_of_the_listener_ends_the_work():
    rng = np.random.default_rng(3)
    a = rng.integers(-9, 10, (14, 14)).astype(float)
    problem = mceip.Problem.from_pencil(a, np.eye(14), unknown="lambda2")
    heard = []
    problem.solve(starts=400, all=True, progress=lambda *what: heard.append(what))
    assert heard and all(isinstance(text, str) for text, _, _ in heard)

    class Enough(Exception):
        pass

    def stop(text, done, total):
        raise Enough

    with pytest.raises(Enough):
        problem.solve(starts=100_000, all=True, progress=stop)


def test_an_interrupt_ends_the_work():
    rng = np.random.default_rng(3)
    a = rng.integers(-9, 10, (14, 14)).astype(float)
    problem = mceip.Problem.from_pencil(a, np.eye(14))

    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        problem.solve(starts=100_000, all=True)


def test_answers_are_drawn_as_tables_in_notebooks():
    html = example("fold").complete()._repr_html_()
    assert "complete" in html and "<td>2</td>" in html
