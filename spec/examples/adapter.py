#!/usr/bin/env python3
"""A program for `mceip conform`: every support by numpy.linalg.eig, as a user might write it.

    mceip conform --as-pencil -- python3 spec/examples/adapter.py
    mceip conform --as-pencil --lines -- python3 spec/examples/adapter.py --lines

Reads a pencil (mceip-problem/1) on stdin, prints mceip-solutions/1; with --lines one after the
other, each in one line. It works in floats, with one
tolerance: repeated roots, biactive indices, cones and continua are beyond it, as the run shows.
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


def eigenpairs(a, b):
    """(t, x) with (a + t b) x = 0, t real: by b where that is regular, else by a and 1/t."""
    by_b = np.linalg.matrix_rank(b) == len(b)
    if not by_b and np.linalg.matrix_rank(a) < len(a):
        return  # both singular: given up
    values, vectors = np.linalg.eig(-np.linalg.solve(b, a) if by_b else -np.linalg.solve(a, b))
    for value, x in zip(values, vectors.T):
        if abs(value.imag) < TOLERANCE * (1 + abs(value)) and (by_b or abs(value) > TOLERANCE):
            yield (value.real if by_b else 1 / value.real), x.real


def solutions(a, b, free, low, high):
    """Every support: an eigenvector of its block that is positive there, with y >= 0 elsewhere."""
    slip = [i for i in range(len(a)) if i not in free]
    for support in chain.from_iterable(combinations(slip, k) for k in range(1, len(slip) + 1)):
        active = sorted([*free, *support])
        block = np.ix_(active, active)
        for t, vector in eigenpairs(a[block], b[block]):
            if not low - TOLERANCE <= t <= high + TOLERANCE:
                continue
            x = np.zeros(len(a))
            x[active] = vector / (np.sum(vector[[i in support for i in active]]) or 1)
            y = (a + t * b) @ x
            rest = [i for i in slip if i not in support]
            if np.all(x[list(support)] > TOLERANCE) and np.all(y[rest] >= -TOLERANCE * np.abs(a).max()):
                yield {"value": max(low, float(t)), "x": [float(v) for v in x]}


def answer(problem):
    """The report on a problem."""
    pencil, window = problem["pencil"], problem["window"]
    low = float(Fraction(window["min"]))
    high = float("inf") if window["max"] is None else float(Fraction(window["max"]))
    found = list(solutions(matrix(pencil["a"]), matrix(pencil["b"]), pencil["free"], low, high))
    return {"format": "mceip-solutions/1", "solutions": found}


def main():
    problems = sys.stdin if "--lines" in sys.argv else [sys.stdin.read()]
    for text in problems:
        report = answer(json.loads(text))
        print(json.dumps(report), flush=True)


if __name__ == "__main__":
    main()
