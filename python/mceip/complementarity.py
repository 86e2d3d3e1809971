"""Mixed complementarity problems given as functions of numpy arrays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ._native import MceipError, solve_mcp
from .answers import Vector, counted, two_lines
from .inputs import Triplets, reals, require_reals


@dataclass(frozen=True)
class McpResiduals:
    """Five numbers that are zero at every solution, largest component each; NaN where F is.

    Attributes:
        complementarity: products of F_i and the distance of z_i to the bound it points to.
        normal_map: |F_i| inside, the part of the wrong sign at a bound.
        minimum_map: z - mid(l, u, z - F).
        fischer: the Fischer-Burmeister function.
        fischer_gradient: the gradient of half its square; zero at other stationary points, too.
    """

    complementarity: float
    normal_map: float
    minimum_map: float
    fischer: float
    fischer_gradient: float


@dataclass(frozen=True)
class McpPoint:
    """Where a run of the solver has ended: a candidate in doubles, of which nothing is proved.

    Attributes:
        z: the point, within the bounds.
        f: F(z).
        residuals: how far it is from a solution.
        converged: are the residuals within the tolerance?
        reason: why the run stopped.
        iterations: Newton steps and linearisations.
        functions: calls of F, those for finite differences included.
        jacobians: values of the Jacobian.
        factorisations: of matrices.
        pivots: on the paths of linearised problems.
    """

    z: Vector = field(compare=False)
    f: Vector = field(compare=False)
    residuals: McpResiduals
    converged: bool
    reason: str
    iterations: int
    functions: int
    jacobians: int
    factorisations: int
    pivots: int

    @property
    def status(self) -> str:
        """ "converged", or "stopped" with a `reason`."""
        return "converged" if self.converged else "stopped"

    def __repr__(self) -> str:
        size = counted(len(self.z), "unknown")
        steps = counted(self.iterations, "iteration")
        return two_lines(
            f"McpPoint {size}, {self.status} after {steps}: {self.reason}",
            f"residual {self.residuals.normal_map:.1e}, a candidate in doubles, not proved",
        )


def mcp(
    F: Callable[[Vector], npt.ArrayLike],
    J: Callable[[Vector], Any] | None,
    l: npt.ArrayLike,
    u: npt.ArrayLike,
    z0: npt.ArrayLike | None = None,
    *,
    tolerance: float | None = None,
    check: bool = False,
) -> McpPoint:
    """Looks for z in [l, u] with F_i(z) >= 0 where z_i = l_i, F_i(z) <= 0 where z_i = u_i, and
    F_i(z) = 0 between: a mixed complementarity problem, by a PATH-style solver.

        >>> import math, mceip
        >>> mceip.mcp(lambda z: [math.exp(z[0]) - 2], None, [0], [math.inf]).z
        array([0.69314718])

    What comes back is a candidate in doubles, and nothing is proved. An exception of F or J ends
    the run and goes on to the caller as it is.

    Args:
        F: takes an array of n doubles and returns n numbers. It is only called within the bounds.
        J: takes the same and returns the Jacobian, n x n: an array, or anything of scipy.sparse.
            None: by finite differences, 2n calls of F each.
        l: n lower bounds, -inf for none; or one number for all unknowns.
        u: n upper bounds, inf for none; or one number for all unknowns.
        z0: where to start; without it at 0, or the bound nearest to it. Needed where both bounds
            are one number, for it tells n.
        tolerance: on the normal map, the minimum map and the Fischer-Burmeister function, in units
            of F; 1e-10 unless given.
        check: holds J against finite differences at the start first.

    Raises:
        MceipError: bounds, start or shapes make no sense; an entry is complex or text; the
            tolerance is not positive; or, with `check`, J is not the Jacobian of F: the message
            names row, column, expected and got.
    """
    require_functions(F, J)
    if z0 is None and np.ndim(l) == 0 and np.ndim(u) == 0:
        raise MceipError("z0: expected a start, for both bounds are one number, got None")
    given = [reals("l", l), reals("u", u)]
    if z0 is not None:
        given.append(reals("z0", z0))
    order = max(part.size for part in given)

    bounds = [np.full(order, part[0]) if part.size == 1 else part for part in given[:2]]
    start = given[2] if z0 is not None else np.clip(np.zeros(order), *bounds)
    for name, part in zip(("l", "u", "z0"), [*bounds, start]):
        if part.size != order:
            raise MceipError(f"{name}: expected {order} numbers, got {part.size}")

    def function(z: list[float]) -> bytes:
        values = np.asarray(F(np.array(z)))
        require_reals("F", values)
        if values.shape != (order,):
            raise MceipError(f"F: expected {order} numbers, got an array of shape {values.shape}")
        return values.astype(np.float64).tobytes()

    def jacobian(z: list[float]) -> bytes | Triplets:
        assert J is not None
        matrix = J(np.array(z))
        is_sparse = hasattr(matrix, "tocoo")
        if not is_sparse:
            matrix = np.asarray(matrix)
        if matrix.shape != (order, order):
            raise MceipError(
                f"J: expected {order} rows and columns, got a matrix of shape {matrix.shape}"
            )
        require_reals("J", matrix)
        if not is_sparse:
            return np.asfortranarray(matrix, dtype=np.float64).tobytes(order="F")

        entries = matrix.tocoo()
        values = np.asarray(entries.data, dtype=np.float64)
        return entries.row.tolist(), entries.col.tolist(), values.tolist()

    point, f, residuals, converged, reason, counts = solve_mcp(
        function,
        None if J is None else jacobian,
        bounds[0].tolist(),
        bounds[1].tolist(),
        start.tolist(),
        None if tolerance is None else float(reals("tolerance", [tolerance])[0]),
        bool(check),
    )
    return McpPoint(
        np.array(point), np.array(f), McpResiduals(*residuals), converged, reason, *counts
    )


def require_functions(F: Any, J: Any) -> None:
    """Refuses a matrix or a number in the place of a function."""
    for name, function in (("F", F), ("J", J)):
        if not callable(function) and not (name == "J" and function is None):
            kind = type(function).__name__
            raise MceipError(f"{name}: expected a function of an array, got {kind}")
