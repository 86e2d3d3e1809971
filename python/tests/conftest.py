"""What the tests share: problems of the book, a mass point, a slow search."""

import os

import numpy as np
import pytest

import mceip

EXAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "spec", "examples")


@pytest.fixture
def example():
    """Reads a problem of the book by its name."""
    return lambda name: mceip.Problem.read(os.path.join(EXAMPLES, name + ".json"))


@pytest.fixture
def point():
    """Makes the mass point of the README, with changes."""

    def make(stiffness=((2.0, 1.5), (1.5, 2.0)), friction="1.5", **changes):
        contact = {"tangential": 0, "normal": 1, "state": "slip+", **changes}
        contacts = [mceip.Contact(**contact)]
        return mceip.Problem.from_matrices(stiffness, np.eye(2), friction, contacts)

    return make


@pytest.fixture
def slow():
    """A problem on which 5,000 starts of the solver take minutes."""
    entries = np.random.default_rng(3).integers(-9, 10, (14, 14)).astype(float)
    return mceip.Problem.from_pencil(entries, np.eye(14))
