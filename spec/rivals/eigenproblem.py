"""What the rivals of this folder share: a problem as a mixed complementarity problem, and a report.

By Propositions 1 and 2 of the paper (the page solver.md, 3.1), with c = 1: find z = (x_f, x_s, s)
with

    F(z) = ((A + t B) x, e'x_s - 1),   t = low + scale s,
    F_f = 0,   0 <= (x_s, s)  _|_  (F_s, F_last) >= 0

The rows of A and B are divided by the largest entry of A, and `scale` is that of A over that of B,
so that the unknowns of a solution are of order one.
"""
import json
import sys
from fractions import Fraction

import numpy as np

STARTS = 60
SEED = 1
SAME = 1e-6  # two points of which no component differs by more are one
AT_END = 1e-9  # relative: a value that is this little above the window is at its end


def matrix(m):
    """{rows, cols, entries} with exact entries, as doubles."""
    out = np.zeros((m["rows"], m["cols"]))
    for i, j, v in m["entries"]:
        out[i, j] = float(Fraction(v))
    return out


class Eigenproblem:
    """A pencil of the pack, its free variables first; `equations` of them."""

    def __init__(self, problem):
        pencil, window = problem["pencil"], problem["window"]
        a, b = matrix(pencil["a"]), matrix(pencil["b"])
        free = pencil["free"]
        self.order = free + [i for i in range(len(a)) if i not in free]
        self.equations, self.size = len(free), len(a) + 1

        largest_a, largest_b = np.abs(a).max() or 1.0, np.abs(b).max() or 1.0
        rows_and_columns = np.ix_(self.order, self.order)
        self.a, self.b = a[rows_and_columns] / largest_a, b[rows_and_columns] / largest_a
        self.low = float(Fraction(window["min"]))
        self.high = np.inf if window["max"] is None else float(Fraction(window["max"]))
        self.scale = largest_a / largest_b

    def value(self, z):
        """t of the unknowns z."""
        return self.low + self.scale * z[-1]

    def function(self, z):
        """F(z)."""
        x = z[:-1]
        return np.append((self.a + self.value(z) * self.b) @ x, np.sum(x[self.equations :]) - 1)

    def jacobian(self, z):
        """F'(z)."""
        out = np.zeros((self.size, self.size))
        out[:-1, :-1] = self.a + self.value(z) * self.b
        out[:-1, -1] = self.scale * (self.b @ z[:-1])
        out[-1, self.equations : -1] = 1
        return out

    def starts(self):
        """x_s = 1/n_s at the low end, then random points with e'x_s = 1: STARTS points in all."""
        random = np.random.default_rng(SEED)
        slip = self.size - 1 - self.equations
        yield np.concatenate([np.zeros(self.equations), np.full(slip, 1 / max(slip, 1)), [0.0]])
        for _ in range(STARTS - 1):
            x_s = random.dirichlet(np.ones(slip)) if slip else np.zeros(0)
            s = np.exp(2 * random.standard_normal())
            if np.isfinite(self.high):
                s = random.uniform(0, (self.high - self.low) / self.scale)
            yield np.concatenate([random.standard_normal(self.equations), x_s, [s]])

    def report(self, points):
        """The points in the window, each once, as mceip-solutions/1."""
        kept = []
        for z in points:
            is_inside = self.value(z) <= self.high * (1 + AT_END)
            if is_inside and all(np.abs(z - other).max() > SAME for other in kept):
                kept.append(z)
        solutions = []
        for z in kept:
            x = np.zeros(self.size - 1)
            x[self.order] = z[:-1]
            value = min(max(self.value(z), self.low), self.high)
            solutions.append({"value": float(value), "x": x.tolist()})
        return {"format": "mceip-solutions/1", "solutions": solutions}


def run(solve):
    """Reads a problem from each line of stdin and prints the report on it.

    `solve(problem, start)` gives a point z, or None where it failed.
    """
    for line in sys.stdin:
        problem = Eigenproblem(json.loads(line))
        ends = (solve(problem, start) for start in problem.starts())
        report = problem.report([z for z in ends if z is not None])
        print(json.dumps(report), flush=True)
