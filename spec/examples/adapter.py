#!/usr/bin/env python3
"""A program for `mceip conform`: every support by numpy.linalg.eig, as a user might write it.

    mceip conform --as-pencil -- python3 spec/examples/adapter.py
    mceip conform --as-pencil --lines -- python3 spec/examples/adapter.py --lines

Reads a pencil (mceip-problem/1) on stdin, prints mceip-solutions/1; with --lines one after the
other, each in one line. It works in floats, with one tolerance: repeated roots, biactive indices,
cones, continua and blocks whose first and last matrices are singular are beyond it, as the run
shows.
"""
import json
import sys
from fractions import Fraction
from itertools import chain, combinations

import numpy as np

TOLERANCE = 1e-8


def matrix(m):
    """{rows, cols, entries} with exact entries, as doubles."""
    out = np.zeros((m["rows"], m["cols"]))
    for i, j, v in m["entries"]:
        out[i, j] = float(Fraction(v))
    return out


def eigenpairs(matrices):
    """(t, x) with (A + tB) x = 0, or (A + tB + t^2 C) x = 0, t real.

    By the last matrix where it is regular, else by the first one and 1/t.
    """
    n, by_last = len(matrices[0]), np.linalg.matrix_rank(matrices[-1]) == len(matrices[-1])
    ordered = matrices if by_last else matrices[::-1]
    if np.linalg.matrix_rank(ordered[-1]) < n:
        return  # both singular: given up
    companion = np.eye(n * (len(matrices) - 1), k=n)  # of x, t x, ...
    companion[-n:] = np.hstack([-np.linalg.solve(ordered[-1], m) for m in ordered[:-1]])
    values, vectors = np.linalg.eig(companion)
    for value, x in zip(values, vectors[:n].T):
        is_real = abs(value.imag) < TOLERANCE * (1 + abs(value))
        if is_real and (by_last or abs(value) > TOLERANCE):
            yield (value.real if by_last else 1 / value.real), x.real


def solutions(matrices, free, low, high):
    """Every support: an eigenvector of its block that is positive there, with y >= 0 elsewhere."""
    n, scale = len(matrices[0]), max(np.abs(m).max() for m in matrices)
    slip = [i for i in range(n) if i not in free]
    for support in chain.from_iterable(combinations(slip, k) for k in range(1, len(slip) + 1)):
        active = sorted([*free, *support])
        block = np.ix_(active, active)
        for t, vector in eigenpairs([m[block] for m in matrices]):
            if not low - TOLERANCE <= t <= high + TOLERANCE:
                continue
            x = np.zeros(n)
            x[active] = vector / (np.sum(vector[[i in support for i in active]]) or 1)
            y = sum(t**k * (m @ x) for k, m in enumerate(matrices))
            rest = [i for i in slip if i not in support]
            if np.all(x[list(support)] > TOLERANCE) and np.all(y[rest] >= -TOLERANCE * scale):
                yield {"value": max(low, float(t)), "x": [float(v) for v in x]}


def answer(problem):
    """The report on a problem."""
    pencil, window = problem["pencil"], problem["window"]
    low = float("-inf") if window["min"] is None else float(Fraction(window["min"]))
    high = float("inf") if window["max"] is None else float(Fraction(window["max"]))
    matrices = [matrix(pencil[name]) for name in "abc" if name in pencil]
    found = list(solutions(matrices, pencil.get("free", []), low, high))
    return {"format": "mceip-solutions/1", "solutions": found}


def main():
    problems = sys.stdin if "--lines" in sys.argv else [sys.stdin.read()]
    for text in problems:
        report = answer(json.loads(text))
        print(json.dumps(report), flush=True)


if __name__ == "__main__":
    main()
