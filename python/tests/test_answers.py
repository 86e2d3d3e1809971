"""The answers of the book's examples, and certificates that are refused."""

import copy
import dataclasses
import json
import re
from fractions import Fraction

import numpy as np
import pytest
from bodies import lattice

import mceip
from mceip.answers import Presence, fraction_of
from mceip.exact import Interval


def test_the_fold_has_two_solutions_and_no_others(example):
    problem = example("fold")

    found = problem.solve()
    everything = problem.complete()

    assert [solution.value for solution in found.solutions] == [2.0, 3.0]
    assert [solution.exact_value for solution in found.solutions] == [2, 3]
    assert found.runs > 0 and found.uncertified == []
    assert everything.is_complete and not everything.is_empty
    assert everything.families == [] and everything.open == []
    for solution, value in zip(everything.solutions, (2, 3), strict=True):
        low, high = solution.enclosure
        assert isinstance(low, Fraction) and low <= value <= high
        assert high - low < Fraction(1, 10**6)

    accepted = mceip.check(problem, everything.certificate)
    assert accepted.is_complete
    assert [claim.support for claim in accepted.solutions] == [[0, 1], [0, 1]]
    assert not mceip.check(problem, found.certificates[0]).is_complete


def test_solutions_have_the_components_of_the_equations(example):
    problem = example("point")

    (solution,) = problem.complete().solutions

    # K v + lambda^2 v = w with v_N = 0, v_T = x: w_T - 1.5 w_N = (2 + t) - 1.5 * 1.5 = 0.
    assert abs(solution.value - 0.25) < 1e-12
    assert solution.unknown == "lambda2"
    assert np.allclose(solution.v, [1.0, 0.0])
    assert np.allclose(solution.w, [2.25, 1.5])
    assert np.allclose(solution.x, [1.0])


def test_absence_is_proved_and_open_regions_are_said(example):
    problem = example("fold").in_window(4)

    everything = problem.complete()

    assert everything.is_empty
    assert mceip.check(problem, everything.certificate).solutions == []


def test_pareto_eigenvalues_of_both_signs() -> None:
    a = np.array([[8.0, -1, -2], [3, 4, -1], [-1, 0, -6]])
    problem = mceip.Problem.eicp(a, np.eye(3))
    assert problem.unknown == "eigenvalue"

    found = problem.complete()
    assert found.is_complete
    values = [solution.value for solution in found.solutions]
    assert values == pytest.approx([-6.1453199, -6.1414284, -6, -6, 4, 5, 7])
    assert "negative" in found.certificate
    mceip.check(problem, found.certificate)

    for solution in found.solutions:
        w = solution.value * solution.x - a @ solution.x
        assert w == pytest.approx(solution.y, abs=1e-9)
        assert min(w) > -1e-9 and min(solution.x) >= 0

    assert not problem.in_window(7.5).complete().solutions
    assert len(problem.in_window(-6.1, 4).complete().solutions) == 3
    with pytest.raises(mceip.MceipError, match="0 <= max"):
        problem.in_window(-3, -2)

    certified = problem.certify(-6.0, [0, 0, 1])
    assert certified.solution.value == -6


def test_quadratic_eigenvalues_of_both_signs() -> None:
    a, b, c = np.eye(2), np.array([[-3.0, 1], [0, 5]]), np.diag([2.0, 6])
    problem = mceip.Problem.qeicp(a, b, c)
    found = problem.complete()
    assert found.is_complete
    assert [solution.value for solution in found.solutions] == [-3, -2, 1, 2]
    mceip.check(problem, found.certificate)

    for solution in found.solutions:
        t, x = solution.value, solution.x
        assert (t * t * a + t * b + c) @ x == pytest.approx(solution.y, abs=1e-9)
        assert len(x) == 2 and min(x) >= 0

    with pytest.raises(mceip.MceipError, match="b: expected a matrix of shape 3 x 3"):
        mceip.Problem.qeicp(np.eye(3), b, c)


def test_a_family_below_zero_has_no_start() -> None:
    # (t B - A) x = (0, x_1 - t x_0): x = (1, 0) for every t <= 0, x = (1, t) above.
    a, b = np.array([[0.0, 0], [0, -1]]), np.array([[0.0, 0], [-1, 0]])
    found = mceip.Problem.eicp(a, b).complete()
    ranges = [family for family in found.families if not family.is_point]
    assert found.is_complete
    assert [family.support for family in ranges] == [[0], [0, 1]]
    assert ranges[0].start is None and ranges[0].end == (0, 0)
    assert ranges[1].start == (0, 0) and ranges[1].end is None



def test_families_are_reported():
    # A + t B = 0 at t = 1: every x solves it.
    problem = mceip.Problem.from_pencil(-np.eye(2), np.eye(2))

    everything = problem.complete()

    assert everything.families
    assert any(family.start[0] <= 1 <= family.start[1] for family in everything.families)
    assert not everything.is_empty


def test_a_search_goes_on_with_an_earlier_certificate(example):
    problem = example("fold")
    earlier = problem.complete().certificate

    assert problem.complete(resume=earlier, threads=1).is_complete
    with pytest.raises(mceip.MceipError):
        example("point").complete(resume=earlier)


def test_forged_foreign_and_malformed_certificates_are_refused(example):
    problem = example("fold")
    certificate = problem.solve().certificates[0]
    assert len(mceip.check(problem, certificate).claims) == 2

    forged = copy.deepcopy(certificate)
    forged["claims"][0]["exact_solution"]["support"] = [0]
    with pytest.raises(mceip.RejectedError):
        problem.check(forged)

    with pytest.raises(mceip.RejectedError, match="digest|SHA|sha256"):
        example("point").check(certificate)

    for malformed in ("no certificate", "{}", {**certificate, "extra": 1}):
        with pytest.raises(mceip.MceipError) as refused:
            problem.check(malformed)
        assert not isinstance(refused.value, mceip.RejectedError)


def test_a_cover_without_a_piece_is_refused_and_claims_alone_are_no_cover(example):
    problem = example("fold")
    everything = problem.complete().certificate
    found = problem.solve().certificates[0]

    with_gap = copy.deepcopy(everything)
    del with_gap["complete_set"]["pieces"][-1]
    with pytest.raises(mceip.RejectedError):
        problem.check(with_gap)

    accepted = problem.check(found)
    assert accepted.solutions is None and not accepted.is_complete


def test_a_search_without_result_claims_nothing(example):
    found = example("fold").in_window(4).solve()

    assert found.solutions == []
    assert found.certificates == []


def test_a_point_is_certified_and_a_wrong_one_is_not(example):
    problem = example("fold")

    certified = problem.certify(2.0000001, [0.666667, 0.333333])

    assert certified.solution.exact_value == 2
    assert mceip.check(problem, certified.certificate).claims[0].support == [0, 1]
    with pytest.raises(mceip.NotCertifiedError):
        problem.certify(2.5, [0.5, 0.5])
    with pytest.raises(mceip.MceipError, match="^expected x with 2 components, got 1$") as refused:
        problem.certify(2.0, [0.5])
    assert refused.type is mceip.MceipError


def test_the_analysis_encloses_the_critical_friction_and_hands_over_its_proofs(example):
    analysis = example("point").analyze(samples=0)

    assert analysis.verdict == "present"
    assert str(analysis) == analysis.summary
    bounds = analysis.critical_friction
    lower, upper = bounds
    assert (bounds.lower, bounds.upper) == (lower, upper)
    assert lower <= Fraction(4, 3) <= upper
    assert upper - lower < Fraction(1, 10**5)
    assert str(bounds) == "[1.333333333333, 1.333333333334]"

    critical = analysis.critical
    names = {proof.name for proof in analysis.proofs}
    for evidence in (critical.absent_evidence, critical.evidence):
        assert evidence.kind == "exact" or evidence.source in names

    (mode,) = analysis.modes
    assert mode.slipping == [0] and mode.sticking == []
    assert abs(mode.growth_rate - 0.5) < 1e-9
    assert np.allclose(mode.v, [1.0, 0.0])


def test_every_proof_of_an_analysis_is_accepted_again_and_not_for_another_problem(example):
    analysis = lattice(4, 3).problem(3).analyze(samples=0)

    verdicts = [proof.check() for proof in analysis.proofs]

    kinds = {mceip.Accepted, mceip.Absence, mceip.Presence, mceip.Stability}
    assert {type(verdict) for verdict in verdicts} == kinds

    absence = next(verdict for verdict in verdicts if isinstance(verdict, mceip.Absence))
    assert absence.start == 0
    assert absence.below == analysis.critical.absent_below
    assert absence.leaves > 0

    presence = next(verdict for verdict in verdicts if isinstance(verdict, mceip.Presence))
    assert analysis.critical.mu[0] <= presence.start < presence.end
    assert presence.start <= 3 <= presence.end
    assert presence.pieces > 0
    assert not absence.of_every_member and not presence.of_every_member
    assert "member" not in repr(absence) + repr(presence)

    stability = next(verdict for verdict in verdicts if isinstance(verdict, mceip.Stability))
    assert stability == analysis.stability
    assert 0 == stability.start < stability.end < absence.below

    other = json.loads(example("point").to_json())
    for proof in analysis.proofs:
        moved = dataclasses.replace(proof, problem=other)
        with pytest.raises(mceip.RejectedError):
            moved.check()


def test_a_certificate_of_any_kind_is_checked_from_its_file(tmp_path):
    analysis = lattice(4, 3).problem(3).analyze(samples=0)

    for proof in analysis.proofs:
        path = tmp_path / f"{proof.name}.json"
        path.write_text(json.dumps(proof.certificate))
        problem = mceip.Problem.from_json(proof.problem)
        for given in (proof.certificate, path, path.read_text()):
            assert mceip.check(problem, given) == proof.check()


def test_a_lean_certificate_is_checked_with_what_it_leaves_out(example):
    analysis = lattice(4, 3).problem(3).analyze(samples=0)
    proof = next(proof for proof in analysis.proofs if proof.name == "absence")
    problem = mceip.Problem.from_json(proof.problem)

    certificate = json.loads(json.dumps(proof.certificate))
    for anchor in certificate["condensation"]["anchors"]:
        for matrix in anchor["right"] + anchor["left_friction"]:
            del matrix["rows"]
    lean = {"format": "mceip-lean/1", "certificate": certificate}
    assert mceip.check(problem, lean) == proof.check()

    with pytest.raises(mceip.RejectedError, match="problem_sha256"):
        mceip.check(example("point"), lean)
    certificate["condensation"]["anchors"][0]["right"][0]["exponent"] = 0
    with pytest.raises(mceip.RejectedError):
        mceip.check(problem, lean)


def test_what_is_no_certificate_is_refused_with_what_to_give(example, tmp_path):
    problem = example("fold")
    everything = problem.complete()

    for given, message in [
        (everything, "`certificate` of a SolutionSet"),
        ("c.json", "pathlib.Path to its file, got 'c.json'"),
        (tmp_path / "no-such-file.json", "no-such-file"),
        (b"{}", "JSON object"),
    ]:
        with pytest.raises(mceip.MceipError, match=message):
            mceip.check(problem, given)
    with pytest.raises(mceip.MceipError, match="expected mceip.Problem .*got str"):
        mceip.check("fold.json", everything.certificate)
    with pytest.raises(mceip.MceipError, match="executor: .*got 2"):
        problem.complete(executor=2)
    for value, x, message in [(None, [1.0, 0.0], "value"), (2.0, "ab", "x: "), (2.0, None, "x: ")]:
        with pytest.raises(mceip.MceipError, match=message):
            problem.certify(value, x)


def test_every_body_within_the_radii_has_its_critical_friction_between_two_bounds(example):
    analysis = example("robust").analyze(samples=0)
    members = analysis.members

    # To first order 0.6910 and 0.0410, both ways.
    assert 0.64 < members.absent_below < 0.66
    assert 0.73 < members.present[0] < 0.74 < members.present[1]
    assert abs(members.middle - 0.69098) < 1e-5 and abs(members.width - 0.0410) < 1e-4
    assert next(iter(members.costs)) == "the friction factor of particle heel"
    verdicts = [proof.check() for proof in analysis.proofs if proof.name.startswith("members")]
    assert [type(verdict) for verdict in verdicts] == [mceip.Absence, mceip.Presence]
    assert all(verdict.of_every_member and "every member" in repr(verdict) for verdict in verdicts)

    assert example("point").analyze(samples=0).members is None


def test_radii_of_matrices_and_friction_are_those_of_the_file(example):
    stiffness = np.array([[2.0, -1, -2, 0], [-1, 3, 0, -2], [-2, 0, 4, 0], [0, -2, 0, 5]])
    about = [Fraction(19, 20), Fraction(21, 20)]
    contacts = [
        mceip.Contact(0, 2, "slip-", name="heel", friction_factor_range=about),
        mceip.Contact(1, 3, "slip-", name="toe", friction_factor_range=("0.95", "1.05")),
    ]

    def robust(radius, **contact):
        changed = [dataclasses.replace(entry, **contact) for entry in contacts]
        return mceip.Problem.from_matrices(
            stiffness, np.eye(4), 1, changed, stiffness_radius=radius, accept_warnings=True
        )

    # 1/200 is no double: the radii of the file are a little smaller.
    radius = np.where(stiffness == 0, 0, 1 / 128)
    expected = json.loads(example("robust").to_json())
    entries = expected["system"]["radii"]["stiffness"]["matrix"]["entries"]
    for entry in entries:
        entry[2] = "1/128"
    assert robust(radius).sha256 == mceip.Problem.from_json(expected).sha256

    members = robust(radius).analyze(samples=0).members
    assert members.absent_below < members.middle < members.present[0]
    with pytest.raises(mceip.MceipError, match="radii"):
        robust(radius).complete()
    for wrong, message in [
        (-radius, "radius of K"),
        (radius[:2, :2], "stiffness_radius: .*4 x 4"),
        (radius * np.nan, "stiffness_radius: entry"),
    ]:
        with pytest.raises(mceip.MceipError, match=message):
            robust(wrong)
    for wrong in ((1, 2, 3), 0.05, ("1", "a"), (2, 1)):
        with pytest.raises(mceip.MceipError, match="friction_factor_range"):
            robust(radius, friction_factor_range=wrong)


def test_without_divergence_at_any_friction_there_is_no_critical_one(point):
    analysis = point(((2.0, 0.0), (0.0, 2.0))).analyze(samples=0)

    assert analysis.verdict == "absent"
    assert analysis.critical.absent_below is None
    assert analysis.critical.without_friction == "absent"
    assert analysis.critical.unbounded is None
    assert analysis.critical_friction is None
    assert analysis.modes == []


def test_what_cannot_be_analysed_is_refused(example):
    with pytest.raises(mceip.MceipError, match="pencil"):
        example("fold").analyze()
    with pytest.raises(mceip.MceipError):
        example("point").analyze(friction="-1")


def test_fractions_of_any_length_are_read():
    digits = "7" * 9001
    expected = Fraction(-7 * (10**9001 - 1) // 9, 10**8000)

    assert fraction_of("-" + digits + "/1" + "0" * 8000) == expected
    assert fraction_of(digits) == 7 * (10**9001 - 1) // 9
    assert fraction_of("-1/3") == Fraction(-1, 3)
    assert fraction_of("0.25") == Fraction(1, 4)


def test_a_smaller_window_is_said_and_ranges_are_rounded_inwards():
    problem = mceip.Problem.eicp([[8.0, -1, -2], [3, 4, -1], [-1, 0, -6]], np.eye(3))
    part = problem.in_window(10, 11).complete().certificate

    statement = mceip.check(problem, part)

    assert statement.windows == ["[10, 11]"]
    assert "no others in [10, 11]" in repr(statement)
    whole = mceip.check(problem, problem.complete().certificate)
    assert whole.windows == ["(-infinity, infinity)"]

    lower, upper = Fraction(7710747, 4194304), Fraction(20, 7)
    presence = Presence(lower, upper, 1, False)
    printed = re.search(r"\[(.*), (.*)\]", repr(presence).splitlines()[0])
    assert printed is not None
    assert lower <= Fraction(printed[1]) < Fraction(printed[2]) <= upper


def test_divergence_without_friction_is_one_answer(example):
    critical = example("two-particles").analyze(samples=0).critical
    already = dataclasses.replace(critical, without_friction="present")

    assert already.bounds == (0, 0)
    assert "0: divergence without friction already" in repr(already)
    assert critical.bounds is not None and critical.bounds.upper > 0


def test_a_number_lies_in_an_interval_or_not():
    interval = Interval(Fraction(1, 3), Fraction(1, 2))

    assert 0.4 in interval and Fraction(1, 3) in interval and np.float32(0.4) in interval
    assert 0.6 not in interval and float("nan") not in interval and "0.4" not in interval


def test_problems_are_fixed(example):
    problem = example("two-particles")
    with pytest.raises(AttributeError):
        problem.friction = 1.5
    with pytest.raises(mceip.MceipError, match="free: expected an integer, got True"):
        mceip.Problem.from_pencil(np.eye(2), np.eye(2), [True, False])
