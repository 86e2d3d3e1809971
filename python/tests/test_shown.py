"""What an interpreter shows: each answer in two lines, with its figures."""

import pytest
from test_loading import example_body

import mceip


@pytest.fixture
def shown(example):
    """Answers of the book's examples."""
    fold = example("fold")
    everything = fold.complete()
    analysis = example("point").analyze(samples=0)
    body, steps, friction = example_body()
    path = body.path(steps, friction)
    proofs = example("robust").analyze(samples=0)
    absence, presence, *_, stability = (
        proof.check() for proof in proofs.proofs if not isinstance(proof.check(), mceip.Accepted)
    )
    return {
        "absence": absence,
        "presence": presence,
        "stability": stability,
        "members": proofs.members,
        "problem": example("point"),
        "found": fold.solve(),
        "set": everything,
        "solution": everything.solutions[0],
        "accepted": mceip.check(fold, everything.certificate),
        "analysis": analysis,
        "critical": analysis.critical,
        "mode": analysis.modes[0],
        "path": path,
        "stretch": path.stretches[5],
        "own": path.own_critical("0.7", "1.5", parts=1),
    }


def test_every_answer_has_two_lines_with_its_figures(shown):
    figures = {
        "absence": "above 0 up to 0.650390625, of every member",
        "presence": "of every member\n a solution with lambda^2 >= 0",
        "stability": "above 0 up to 0.6909\n of every motion",
        "members": "no divergence up to 0.650390625",
        "problem": "contacts: 1, mu = 1.5; sought: lambda2 in [0, infinity)",
        "found": "2 solutions, certified: 2, 3",
        "set": "complete\n 2 solutions: 2, 3",
        "solution": "lambda2 in [1.99",
        "accepted": "no others in [0, infinity)",
        "analysis": "mu = 1.5: present, growing at 0.5 1/s\n critical friction in [1.33",
        "critical": "in [1.333333333333, 1.333333333334]",
        "mode": "growing at 0.5 1/s",
        "path": "mu = 0.8, 8 stretches\n all loads are applied",
        "stretch": "slip- slip- slip-",
        "own": "2 mu examined",
    }
    for name, answer in shown.items():
        text = repr(answer)
        assert text.count("\n") == 1 and max(map(len, text.split("\n"))) <= 110, text
        assert figures[name] in text


def test_the_version_is_that_of_the_package():
    from importlib.metadata import version

    assert mceip.__version__ == version("mceip")
