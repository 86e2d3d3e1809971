#!/usr/bin/env python3
"""Siconos on the problems of `crates/mcp/tests/mcplib.rs`, from the same starts.

    apt-get install --no-install-recommends python3-siconos
    /usr/bin/python3 spec/rivals/siconos_mcplib.py

Prints for each problem from how many starts Newton's method on the Fischer-Burmeister function
(`mcp_newton_FB_FBLSA`) and on the minimum function (`mcp_newton_min_FBLSA`) ends at a solution.
Options are those of Siconos. Jacobians are central differences. F outside its domain is NaN. The
fixed price of Mathiesen's model is a number in F, and the unknown is left out.
"""
import math

import numpy as np
import siconos.numerics as siconos

SOLVERS = {
    "FB": (siconos.mcp_newton_FB_FBLSA, siconos.SICONOS_MCP_NEWTON_FB_FBLSA),
    "min": (siconos.mcp_newton_min_FBLSA, siconos.SICONOS_MCP_NEWTON_MIN_FBLSA),
}


def four_by_four(c_in_f2, d_in_f3, constant):
    """Kojima and Shindo's problem, or Josephy's."""

    def function(z):
        a, b, c, d = z
        return [
            3 * a * a + 2 * a * b + 2 * b * b + c + 3 * d - 6,
            2 * a * a + a + b * b + c_in_f2 * c + 2 * d - 2,
            3 * a * a + a * b + 2 * b * b + 2 * c + d_in_f3 * d - constant,
            a * a + 3 * b * b + 2 * c + 3 * d - 3,
        ]

    return function


def cournot(cost, elasticity, scale, gamma):
    """An oligopoly."""
    cost, power = np.array(cost), 1 / np.array(elasticity)

    def function(z):
        quantity = z.sum()
        price = (5000 / quantity) ** (1 / gamma)
        return cost + (scale * z) ** power - price + z * price / (gamma * quantity)

    return function


def walras(share, first, second):
    """Mathiesen's model with the price of good 2 fixed at 1."""

    def function(z):
        y, p1, p3 = z
        return [1 + p3 - p1, y - share * (first + second * p3) / p1, second - y]

    return function


E = np.array([-15.0, -27, -36, -18, -12])
C = np.array(
    [
        [30.0, -20, -10, 32, -10],
        [-20, 39, -6, -31, 32],
        [-10, -6, 10, -6, -10],
        [32, -31, -6, 39, -20],
        [-10, 32, -10, -20, 30],
    ]
)
D = np.array([4.0, 8, 10, 6, 2])
A = np.array(
    [
        [-16, 2, 0, 1, 0],
        [0, -2, 0, 4, 2],
        [-3.5, 0, 2, 0, 0],
        [0, -2, 0, -4, -1],
        [0, -9, -2, 1, -2.8],
        [2, 0, -4, 0, 0],
        [-1, -1, -1, -1, -1],
        [-1, -2, -3, -2, -1],
        [1, 2, 3, 4, 5],
        [1, 1, 1, 1, 1],
    ]
)
B = np.array([-40, -2, -0.25, -4, -4, -1, -40, -60, 5, 1])


def colvncp(z):
    x, u = z[:5], z[5:]
    return np.concatenate([E + 2 * C @ x + 3 * D * x * x - A.T @ u, A @ x - B])


def colvdual(z):
    u, y, v = z[:10], z[10:15], z[15:]
    gradient = E + 2 * C @ y + 3 * D * y * y
    of_y = 2 * C @ (y - v) + 6 * D * y * (y - v)
    return np.concatenate([A @ v - B, of_y, gradient - A.T @ u])


def transmcp(z):
    shipments, plants, markets = z[:6].reshape(2, 3), z[6:8], z[8:]
    costs = 0.09 * np.array([[2.5, 1.7, 1.8], [2.5, 1.8, 1.4]])
    gains = plants[:, None] + costs - markets[None, :]
    left = np.array([350, 600]) - shipments.sum(axis=1)
    needed = shipments.sum(axis=0) - np.array([325, 300, 275])
    return np.concatenate([gains.ravel(), left, needed])


FOUR = [[0.5] * 4, [0] * 4, [1] * 4, [100] * 4, [1, 0, 1, 0], [1.25, 0, 0, 0.5], [0, 5, 0, 5]]
PRICES = [[1, 1, 1], [0, 2, 0], [10, 10, 10], [3, 0.1, 5]]
FIVE = cournot([10, 8, 6, 4, 2], [1.2, 1.1, 1.0, 0.9, 0.8], 0.2, 1.1)
TEN = cournot(
    [5, 3, 8, 5, 1, 3, 7, 4, 6, 3], [1.2, 1, 0.9, 0.6, 1.5, 1, 0.7, 1.1, 0.95, 0.75], 10, 1.2
)

PROBLEMS = {
    "kojshin": (four_by_four(10, 9, 9), FOUR),
    "josephy": (four_by_four(3, 3, 1), FOUR),
    "five firms": (FIVE, [[k] * 5 for k in (1, 0.1, 10, 100)]),
    "nash": (TEN, [[k] * 10 for k in (1, 0.1, 10, 100)]),
    "billups": (lambda z: (z - 1) ** 2 - 1.01, [[0.5], [0], [1], [1.5], [10]]),
    "mathiesen 0.9, 5, 3": (walras(0.9, 5, 3), PRICES),
    "mathiesen 0.75, 1, 0.5": (walras(0.75, 1, 0.5), PRICES),
    "mathiesen 0.75, 1, 2": (walras(0.75, 1, 2), PRICES),
    "colvncp": (colvncp, [[1] * 15, [0, 0, 0, 0, 1] + [0] * 10, [0] * 15]),
    "colvdual": (colvdual, [[1] * 20, [0.001] * 6 + [60] + [0.001] * 13, [0] * 20]),
    "transmcp": (transmcp, [[1] * 11, [0] * 11, [100] * 11]),
}


def is_solved(function, name, start):
    """Does a run end with the minimum of z and F(z) at most 1e-6?"""
    newton, number = SOLVERS[name]
    n = len(start)

    def value(_n, z, out):
        with np.errstate(all="ignore"):
            out[:] = function(np.array(z))

    def jacobian(_n, z, out):
        columns = []
        with np.errstate(all="ignore"):
            for j in range(n):
                step = 6e-6 * max(1.0, abs(z[j])) * np.eye(n)[j]
                ahead, behind = (np.array(function(z + s * step)) for s in (1, -1))
                columns.append((ahead - behind) / (2 * step[j]))
        out[:] = np.array(columns).T

    mcp = siconos.MCP(0, n, value, jacobian)
    z, w = np.array(start, dtype=float), np.zeros(n)
    newton(mcp, z, w, siconos.SolverOptions(number))
    with np.errstate(all="ignore"):
        residual = np.abs(np.minimum(z, np.array(function(z)))).max()
    return math.isfinite(residual) and residual <= 1e-6


if __name__ == "__main__":
    for problem, (function, starts) in PROBLEMS.items():
        counts = (sum(is_solved(function, name, start) for start in starts) for name in SOLVERS)
        print(f"{problem:24}", *(f"{k} of {len(starts)}" for k in counts), sep="  ")
