#!/usr/bin/env python3
"""A rival for `mceip conform`: the mixed complementarity solvers of Siconos.

    apt-get install --no-install-recommends python3-siconos
    mceip conform --as-pencil --lines --except eigenvalue -- /usr/bin/python3 spec/rivals/siconos_adapter.py
    mceip conform --as-pencil --lines --except eigenvalue -- /usr/bin/python3 spec/rivals/siconos_adapter.py min

Newton's method on the Fischer-Burmeister function (`mcp_newton_FB_FBLSA`, the default) or on the
minimum function (`min`: `mcp_newton_min_FBLSA`), both with a line search on the former. Options are
those of Siconos (tolerance 1e-10), but for the number of iterations, 100 in place of 1000.
"""
import sys

import numpy as np
import siconos.numerics as siconos
from eigenproblem import run


def solver_named(name):
    """The function of Siconos and the number of its options."""
    if name == "min":
        return siconos.mcp_newton_min_FBLSA, siconos.SICONOS_MCP_NEWTON_MIN_FBLSA
    return siconos.mcp_newton_FB_FBLSA, siconos.SICONOS_MCP_NEWTON_FB_FBLSA


ITERATIONS = 100
NEWTON, NUMBER = solver_named(sys.argv[1] if len(sys.argv) > 1 else "FB")


def solve(problem, start):
    """The end of a run that Siconos calls successful, or None."""

    def function(_n, z, out):
        out[:] = problem.function(z)

    def jacobian(_n, z, out):
        out[:] = problem.jacobian(z)

    inequalities = problem.size - problem.equations
    mcp = siconos.MCP(problem.equations, inequalities, function, jacobian)
    z, w = start.copy(), np.zeros(problem.size)
    options = siconos.SolverOptions(NUMBER)
    options.iparam[siconos.SICONOS_IPARAM_MAX_ITER] = ITERATIONS
    failed = NEWTON(mcp, z, w, options)
    return None if failed or not np.all(np.isfinite(z)) else z


if __name__ == "__main__":
    run(solve)
