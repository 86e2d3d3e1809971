"""Plain mixed complementarity problems given as functions."""

import math

import numpy as np
import pytest
import scipy.sparse

import mceip


def kojima_shindo(z):
    a, b, c, d = z
    return np.array(
        [
            3 * a * a + 2 * a * b + 2 * b * b + c + 3 * d - 6,
            2 * a * a + a + b * b + 10 * c + 2 * d - 2,
            3 * a * a + a * b + 2 * b * b + 2 * c + 9 * d - 9,
            a * a + 3 * b * b + 2 * c + 3 * d - 3,
        ]
    )


def its_jacobian(z):
    a, b, _, _ = z
    return np.array(
        [
            [6 * a + 2 * b, 2 * a + 4 * b, 1, 3],
            [4 * a + 1, 2 * b, 10, 2],
            [6 * a + b, a + 4 * b, 2, 9],
            [2 * a, 6 * b, 2, 3],
        ]
    )


SOLUTIONS = [(math.sqrt(6) / 2, 0, 0, 0.5), (1, 0, 3, 0)]


def as_sparse(z):
    return scipy.sparse.csr_matrix(its_jacobian(z))


def as_sparse_array(z):
    return scipy.sparse.csc_array(its_jacobian(z))


@pytest.mark.parametrize("jacobian", [its_jacobian, as_sparse, as_sparse_array, None])
@pytest.mark.parametrize("start", [None, [1, 0, 1, 0], [0, 5, 0, 5], [100.0] * 4])
def test_the_solutions_of_kojima_and_shindo(jacobian, start):
    point = mceip.mcp(kojima_shindo, jacobian, np.zeros(4), np.inf, start, check=True)

    assert point.converged and point.status == "converged"
    assert min(np.abs(point.z - solution).max() for solution in SOLUTIONS) < 1e-5
    assert np.array_equal(point.f, kojima_shindo(point.z))
    assert point.residuals.normal_map <= 1e-10
    assert point.iterations >= 1 and point.functions >= point.iterations


def test_bounds_of_every_kind():
    target = np.array([-1.0, 1.0, 4.0, 0.0, 3.0])
    lower = [0, -1, 0, 5, -np.inf]
    upper = [np.inf, 2, 2, 5, np.inf]

    point = mceip.mcp(lambda z: z - target, lambda z: np.eye(5), lower, upper)

    assert point.z.tolist() == [0, 1, 2, 5, 3]
    assert point.f.tolist() == [1, 0, -2, 5, 0]


def test_two_lines_say_what_it_is_worth():
    point = mceip.mcp(lambda z: z - 2, lambda z: np.eye(1), 0, math.inf, [7.0])
    first, second = repr(point).split("\n")

    assert first == (
        f"<mceip.McpPoint 1 unknown, converged after {point.iterations} iterations: "
        "the residuals are within the tolerance"
    )
    assert second.endswith("a candidate in doubles, not proved>")


def test_a_problem_without_solution_says_why_it_stopped():
    point = mceip.mcp(lambda z: -1 - z, lambda z: [[-1]], 0, math.inf, [1.0])

    assert not point.converged and point.status == "stopped"
    assert "ray" in point.reason or "acceptable" in point.reason
    assert point.residuals.normal_map >= 1


class Own(Exception):
    """What functions raise in these tests."""


@pytest.mark.parametrize("last", [1, 2, 5])
@pytest.mark.parametrize("kind", [Own, KeyboardInterrupt])
def test_exceptions_of_f_go_on_as_they_are(kind, last):
    calls = []
    raised = kind("enough")

    def function(z):
        calls.append(z)
        if len(calls) == last:
            raise raised
        return kojima_shindo(z)

    with pytest.raises(kind) as caught:
        mceip.mcp(function, its_jacobian, np.zeros(4), np.inf, np.ones(4))
    assert caught.value is raised
    assert len(calls) == last


def test_exceptions_of_j_go_on_as_they_are():
    raised = Own("no derivative here")

    def jacobian(z):
        raise raised

    for check in [False, True]:
        with pytest.raises(Own) as caught:
            mceip.mcp(kojima_shindo, jacobian, np.zeros(4), np.inf, np.ones(4), check=check)
        assert caught.value is raised


def test_a_wrong_jacobian_is_named():
    def wrong(z):
        matrix = its_jacobian(z)
        matrix[2, 1] += 1
        return matrix

    with pytest.raises(mceip.MceipError, match=r"expected F'\[2\]\[1\] near .*, got 6 "):
        mceip.mcp(kojima_shindo, wrong, np.zeros(4), np.inf, np.ones(4), check=True)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"l": [1.0] * 4, "u": [0.0] * 4}, "expected lower <= upper at 0, got 1 and 0"),
        ({"l": [0.0] * 3}, "l: expected 4 numbers, got 3"),
        ({"z0": [0.0] * 3}, "z0: expected 4 numbers, got 3"),
        ({"z0": [math.nan] * 4}, "expected a finite start at 0, got NaN"),
        ({"l": "nothing"}, "l: expected real numbers, got entries of type <U7"),
        ({"l": None}, "l: expected numbers, got None"),
        ({"l": [[0.0], [0.0, 0.0]]}, "l: expected numbers: "),
        ({"l": np.zeros((2, 2))}, "l: expected a list of numbers, got an array of shape (2, 2)"),
        ({"tolerance": 0.0}, "expected option convergence_tolerance > 0 and finite, got 0"),
        ({"F": lambda z: z[:3]}, "F: expected 4 numbers, got an array of shape (3,)"),
        ({"J": lambda z: np.eye(3)}, "J: expected 4 rows and columns, got a matrix of shape (3, 3)"),
        ({"J": lambda z: scipy.sparse.eye(3)}, "J: expected 4 rows and columns, got a matrix of"),
    ],
)
def test_what_makes_no_sense_is_refused(changes, message):
    arguments = {"F": kojima_shindo, "J": its_jacobian, "l": np.zeros(4), "u": np.full(4, np.inf)}
    with pytest.raises(mceip.MceipError) as caught:
        mceip.mcp(**{**arguments, "z0": np.ones(4), **changes})
    assert message in str(caught.value)


def test_a_function_that_is_not_finite_is_a_reason_to_stop():
    point = mceip.mcp(lambda z: np.full(1, np.nan), lambda z: np.eye(1), 0, 1, [0.0])
    assert not point.converged and point.reason == "expected a finite F[0]"


def test_an_obstacle_problem_with_a_sparse_jacobian():
    """A membrane over an obstacle, 0 <= z - obstacle, 0 <= A z - b: where it touches and where
    not is decided; no dense matrix of 3,600 unknowns is made."""
    n = 60
    line = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n)) * (n + 1)
    one = scipy.sparse.identity(n)
    laplacian = scipy.sparse.csr_matrix(
        scipy.sparse.kron(line, one) + scipy.sparse.kron(one, line)
    )
    x, y = np.meshgrid(np.linspace(0, 1, n + 2)[1:-1], np.linspace(0, 1, n + 2)[1:-1])
    obstacle = (0.3 - (x - 0.5) ** 2 - (y - 0.5) ** 2).ravel()

    point = mceip.mcp(
        lambda z: laplacian @ z + 0.01 * z**3,
        lambda z: laplacian + scipy.sparse.diags(0.03 * z**2),
        obstacle,
        np.inf,
        np.maximum(obstacle, 0.0),
    )

    assert point.converged
    touches = point.z == obstacle
    in_the_square = touches.reshape(n, n)
    assert in_the_square[n // 2, n // 2] and not in_the_square[0, 0]
    assert np.abs(point.f[~touches]).max() <= 1e-10
    assert point.f[touches].min() >= 0


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"F": lambda z: z + 1j}, "F: expected real numbers, got entries of type complex128"),
        ({"F": lambda z: ["1"]}, "F: expected real numbers"),
        ({"J": lambda z: np.eye(1) * 1j}, "J: expected real numbers"),
        ({"J": lambda z: scipy.sparse.eye(1) * 1j}, "J: expected real numbers"),
        ({"J": np.eye(1)}, "J: expected a function of an array, got ndarray"),
        ({"F": 3}, "F: expected a function of an array, got int"),
        ({"z0": None}, "z0: expected a start"),
        ({"tolerance": "small"}, "tolerance: expected real numbers"),
    ],
)
def test_what_is_no_function_of_real_numbers_is_refused(changes, message):
    given = {"F": lambda z: z - 2, "J": None, "l": 0, "u": math.inf, "z0": [1.0], **changes}
    with pytest.raises(mceip.MceipError, match=message):
        mceip.mcp(**given)
