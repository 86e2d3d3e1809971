"""Paths of bodies under loads: against the command line's example, and what is refused."""

import copy
import json
import math
import os
import re
import subprocess
import sys
import warnings
from fractions import Fraction

import numpy as np
import pytest
import scipy.sparse

import mceip

EXAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "spec", "examples")


def example_body():
    """The body and the steps of spec/examples/loads.json."""
    with open(os.path.join(EXAMPLES, "loads.json"), encoding="utf-8") as file:
        given = json.load(file)
    system = given["system"]
    lower = [(i, j, float(v)) for i, j, v in system["stiffness"]["entries"]]
    stiffness = np.zeros((8, 8))
    for i, j, value in lower:
        stiffness[i, j] = stiffness[j, i] = value
    candidates = []
    for candidate in system["candidates"]:
        gap = str(candidate.get("gap", 0))
        candidates.append(mceip.Candidate(**{**candidate, "gap": gap}))
    body = mceip.Body(stiffness, np.array(system["mass"], dtype=float), candidates=candidates)
    steps = []
    for step in given["steps"]:
        displacements = {dof: str(value) for dof, value in step["displacements"]}
        steps.append(mceip.Step(step["name"], displacements=displacements))
    return body, steps, str(system["friction"])


def test_the_path_of_the_example_is_that_of_the_book():
    body, steps, friction = example_body()

    path = body.path(steps, friction)

    assert path.end == "all loads are applied"
    assert "event it begins with" in str(path)
    states = ["".join({"free": "o", "stick": "."}.get(s, s[-1]) for s in stretch.states)
              for stretch in path.stretches]
    assert states == ["..o", "...", "...", "..-", ".--", "---", "--o", "o-o"]
    assert path.stretches[0].stop == pytest.approx(0.46625)
    assert path.stretches[5].reactions.shape == (3, 2)
    assert path.stretches[0].problem is None and path.stretches[0].analyze() is None
    analysis = path.stretches[5].analyze(samples=0)
    assert analysis.critical_friction is not None


def test_states_are_certified_and_anybody_can_check_them(tmp_path):
    body, steps, friction = example_body()
    path = body.path(steps, friction)
    certificate = tmp_path / "certificate.json"
    own = tmp_path / "loads.json"

    for stretch in path.stretches:
        found = stretch.certify()
        assert found["format"] == "mceip-equilibrium/1"
    certificate.write_text(json.dumps(found))
    own.write_text(path.loads())

    checker = os.path.join(EXAMPLES, "..", "checker.py")
    for loads in [os.path.join(EXAMPLES, "loads.json"), own]:
        run = subprocess.run([sys.executable, checker, loads, certificate], capture_output=True)
        assert run.returncode == 0, run


def test_certificates_of_contact_states_are_checked_here_too():
    body, steps, friction = example_body()
    path = body.path(steps, friction)
    certificate = path.stretches[5].certify()

    proved = path.check(certificate)

    assert proved.friction == Fraction("0.8")
    assert proved.amounts[0] == 1 and 0 < proved.amounts[1] < 1
    assert list(proved.states) == list(path.stretches[5].states)
    forged = copy.deepcopy(certificate)
    forged["candidates"][0] = {"state": "free"}
    with pytest.raises(mceip.RejectedError):
        path.check(forged)
    with pytest.raises(mceip.MceipError, match="mceip-equilibrium/1"):
        path.check(path.stretches[5].problem.complete().certificate)


def test_a_path_says_which_of_its_states_diverge():
    body, steps, friction = own_critical_body()
    path = body.path(steps, "1.5")

    analysis = path.analyze()

    assert [state.divergence for state in analysis.states] == [
        "absent", "absent", "absent", "present", "absent"]
    (first,) = analysis.diverging
    assert first.stretch == 3
    assert 1.118 < float(first.absent_below) < float(first.present_at.upper) < 1.1181
    assert "MEETS AN EQUILIBRIUM THAT CAN DIVERGE" in str(analysis)
    assert "stretches that can diverge: 3" in repr(analysis)


def test_modes_are_over_all_degrees_of_freedom_of_the_body():
    # The mass point of the README beside a degree of freedom that is held.
    stiffness = np.array([[4.0, 1.0, -1.0], [1.0, 2.0, 1.5], [-1.0, 1.5, 2.0]])
    body = mceip.Body(stiffness, np.eye(3), candidates=[mceip.Candidate(1, 2)], held=[0])
    press = mceip.Step("press", forces={2: 4})
    pull = mceip.Step("pull", forces={1: 5})
    path = body.path([press, pull], "1")

    analysis = path.stretches[-1].analyze(friction="1.5", samples=0)

    (mode,) = analysis.modes
    assert mode.v == pytest.approx([0.0, 1.0, 0.0])
    assert path.stretches[-1].problem.complete().is_complete


def own_critical_body():
    """The body and the steps of spec/examples/own-critical.json."""
    with open(os.path.join(EXAMPLES, "own-critical.json"), encoding="utf-8") as file:
        given = json.load(file)
    system = given["system"]
    candidates = [mceip.Candidate(**candidate) for candidate in system["candidates"]]
    body = mceip.Body(system["stiffness"], system["mass"], candidates=candidates)
    steps = [mceip.Step(step["name"], forces=dict(step["forces"])) for step in given["steps"]]
    return body, steps, str(system["friction"])


def test_the_own_critical_friction_is_that_of_the_book():
    body, steps, friction = own_critical_body()
    path = body.path(steps, friction)

    own = path.own_critical("1.1", "1.2", parts=2)

    assert (own.found, own.absent, own.critical) == ("between", Fraction("1.11"), Fraction("1.12"))
    assert [point["states_certified"] for point in own.points] == [True] * len(own.points)
    assert str(own).startswith("OWN CRITICAL FRICTION: between 1.11 and 1.12")
    assert "between, absent at 1.11, critical at 1.12" in repr(own)
    assert own.bounds == (Fraction("1.11"), Fraction("1.12"))
    assert own.points[-1]["stretch"] == 3

    at_the_end = path.own_critical("1.7", "1.8", parts=2, end_alone=True)
    assert at_the_end.bounds == (Fraction("1.78"), Fraction("1.79"))
    for ends, options, word in [
        ((2, 1), {}, "0 < MIN < MAX"),
        ((1, 2), {"parts": 0}, "parts"),
        ((1, 2), {"width": 0}, "at least 1/10^9"),
    ]:
        with pytest.raises(mceip.MceipError, match=re.escape(word)):
            path.own_critical(*ends, **options)


def square(**wrong):
    """Two points on the floor, two above them that are held; candidates with a fault."""
    stiffness = np.diag([4.0, 4.0, 4.0, 4.0, 1.0, 1.0, 1.0, 1.0])
    stiffness[0, 1] = stiffness[1, 0] = 1.0
    points = [[0, 0], [1, 0], [1, 1], [0, 1]]
    mesh = mceip.Mesh(points, [[0, 1], [2, 3], [4, 5], [6, 7]], [[0, 1, 2, 3]])
    right = {"normal_direction": -1}
    candidates = [mceip.Candidate(2 * k, 2 * k + 1, **{**right, **wrong}) for k in range(2)]
    return mceip.Body(stiffness, candidates=candidates, held=[4, 5, 6, 7], mesh=mesh), mesh


def test_directions_are_held_against_the_mesh():
    press = mceip.Step("press", forces={1: -1, 3: -1})

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        body, mesh = square()
        path = body.path([press], "0.5")
    assert json.loads(path.loads())["coordinates"]["nodes"][0][2:] == ["0", "0"]
    assert mesh.displacement(np.arange(8.0)).tolist() == [[0, 1], [2, 3], [4, 5], [6, 7]]

    for wrong, words in [
        ({"normal_direction": 1}, "the normal points into the body"),
        ({"frame": [["4/5", "3/5"], ["-3/5", "4/5"]]}, "the tangent is turned"),
    ]:
        body, _ = square(**wrong)
        with pytest.warns(mceip.ModelWarning, match=words):
            body.path([press], "0.5")


def test_what_is_no_mesh_of_the_body_is_refused():
    candidates = [mceip.Candidate(0, 1)]
    points = [[0.0, 0.0], [1.0, 0.0]]
    press = mceip.Step("press", forces={1: 1})
    for mesh, words in [
        (mceip.Mesh(points, [[0, 1], [2, 9]]), "9 of 4 for node 1"),
        (mceip.Mesh(points, [[0, 1], [0, 3]]), "coordinates"),
        (mceip.Mesh(points, [[0, 1]]), "dofs"),
        (mceip.Mesh(points, [[0.0, 1.0], [2.0, 3.0]]), "dofs"),
        (mceip.Mesh([[0, 0], [np.inf, 0]], [[0, 1], [2, 3]]), "finite"),
        (mceip.Mesh(points, [[0, 1], [2, 3]], [[0, 1, 2]]), "cells"),
    ]:
        with pytest.raises(mceip.MceipError, match=words):
            mceip.Body(np.eye(4), candidates=candidates, mesh=mesh).path([press], "0.5")

    partly = mceip.Mesh(points, [[0, 1], [2, -1]])
    assert partly.displacement([1.0, 2.0, 3.0]).tolist() == [[1, 2], [3, 0]]
    with pytest.raises(mceip.MceipError, match="displacement"):
        partly.displacement([1.0, 2.0])


def test_what_looks_wrong_is_said_and_repeated_unless_it_is_accepted():
    mass = 1e9 * np.eye(3)
    stiffness = [[2, 0, -1], [0, 2, 0], [-1, 0, 2]]
    heavy = mceip.Body(stiffness, mass, candidates=[mceip.Candidate(0, 1)])
    push = [mceip.Step("push", forces={0: 3, 1: 2})]

    with pytest.warns(mceip.ModelWarning, match="the lowest frequency is .* below 1e-2") as said:
        path = heavy.path(push, 1)
    assert said[0].filename == __file__
    assert path.stretches[-1].problem.warnings == [str(said[0].message)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        path = heavy.path(push, 1, accept_warnings=True)
    assert path.stretches[-1].problem.warnings == []


def test_supports_left_in_the_stiffness_are_said_by_their_given_number():
    stiffness = np.diag([1.0, 2.0, 2.0, 1e12])
    body = mceip.Body(stiffness, candidates=[mceip.Candidate(1, 2)], held=[0])

    with pytest.warns(mceip.ModelWarning, match="1.0000e12 at dof 3 and nothing of that size"):
        body.path([mceip.Step("push", forces={1: 3, 2: 2})], 1)


def test_the_file_of_the_loads_has_what_is_prescribed_at_held_nodes():
    stiffness = [[2, 0, -1, 0], [0, 2, 0, -1], [-1, 0, 2, 0], [0, -1, 0, 2]]
    mesh = mceip.Mesh([[0, 0], [0, 1]], [[0, 1], [2, 3]])
    candidates = [mceip.Candidate(0, 1, normal_direction=-1)]
    steps = [
        mceip.Step("press", displacements={3: "-0.5", 2: 0}),
        mceip.Step("drag", displacements={2: "1/3"}),
    ]

    path = mceip.Body(stiffness, candidates=candidates, mesh=mesh).path(steps, 1)

    coordinates = json.loads(path.loads())["coordinates"]
    assert coordinates["nodes"][1][:2] == [None, None]
    assert coordinates["prescribed"] == [[0, 1, "0", "-1/2"], [1, 1, "1/3", "0"]]


@pytest.mark.parametrize(
    "given, message",
    [
        ({"candidates": 5}, "candidates: expected a list of mceip.Candidate, got 5"),
        ({"candidates": mceip.Candidate(0, 1)}, "candidates: expected a list"),
        ({"candidates": [mceip.Candidate(0, 1, gap=math.nan)]}, "candidate 0: gap: .*got nan"),
        ({"candidates": [mceip.Candidate(0, 1)], "held": 5}, "held: expected a list of integers"),
    ],
)
def test_what_is_no_body_is_refused_with_its_place(given, message):
    with pytest.raises(mceip.MceipError, match=message):
        mceip.Body(np.eye(2), **given)


def test_loads_are_lists_or_mappings_and_matrices_of_any_kind():
    stiffness = scipy.sparse.csr_matrix([[2.0, 0.0], [0.0, 1.0]])
    body = mceip.Body(stiffness, candidates=[mceip.Candidate(0, 1, name="heel")])
    press = mceip.Step("press", forces={1: 3})
    paths = [
        body.path([press, mceip.Step("push", forces=push)], "1/2")
        for push in ([2.0, 0.0], np.array([2.0, 0.0]), {0: "2"})
    ]

    # It sticks until the push reaches mu N = 3/2.
    for path in paths:
        last = path.stretches[-1]
        assert (last.start, last.states.tolist()) == (0.75, ["slip+"])
        assert last.problem.unknown == "mu"
        assert "heel: friction cone reached" in str(path)


@pytest.mark.parametrize(
    "change, word",
    [
        ({"candidates": []}, "candidate"),
        ({"candidates": [mceip.Candidate(0, 1, gap=-1)]}, "gap"),
        ({"candidates": [mceip.Candidate(0, 7)]}, "7"),
        ({"candidates": [(0, 1)]}, "mceip.Candidate"),
        ({"held": [1]}, "held"),
        ({"held": [9]}, "9"),
    ],
)
def test_bodies_that_make_no_sense_are_refused(change, word):
    arguments = {"candidates": [mceip.Candidate(0, 1)], **change}
    with pytest.raises(mceip.MceipError, match=word):
        body = mceip.Body(np.eye(2), **arguments)
        body.path([mceip.Step("push", forces={0: 1})], 1)


@pytest.mark.parametrize(
    "steps",
    [
        [],
        [{"name": "push"}],
        [mceip.Step("a", forces={5: 1})],
        [mceip.Step("a", forces=[1])],
        [mceip.Step("a", forces=3)],
        [mceip.Step("a", displacements=[0, 1])],
    ],
)
def test_steps_that_make_no_sense_are_refused(steps):
    body = mceip.Body(np.eye(2), candidates=[mceip.Candidate(0, 1)])
    with pytest.raises(mceip.MceipError):
        body.path(steps, 1)
    with pytest.raises(mceip.MceipError):
        body.path([mceip.Step("push", forces={0: 1})], 0)
