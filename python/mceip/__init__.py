"""Can a static equilibrium of an elastic body in frictional contact diverge? With proofs.

    >>> import mceip
    >>> body = mceip.Problem.from_matrices(
    ...     stiffness=[[2.0, 1.5], [1.5, 2.0]], mass=[[1.0, 0.0], [0.0, 1.0]], friction="1.5",
    ...     contacts=[mceip.Contact(0, 1, "slip", sign=-1)])
    >>> [solution.value for solution in body.complete().solutions]
    [0.25]

Matrices are numpy arrays, anything of scipy.sparse, or lists of rows; a double stands for exactly
the number that it is. Exact numbers are `fractions.Fraction`. Every solution has been accepted by
the checker; `check` is what anybody else would run.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Union

from ._native import MceipError, NativeProblem, NotCertifiedError, RejectedError

__all__ = [
    "Accepted", "Analysis", "Certified", "Claim", "Contact", "Family", "Found", "MceipError",
    "NotCertifiedError", "OpenRegion", "Problem", "Proof", "RejectedError", "Solution",
    "SolutionSet", "Uncertified", "check",
]

#: A number that is taken as what it spells ("0.1" is 1/10) or, for a float, as what it is.
Number = Union[str, int, float, Fraction]

#: Called with a line of text, the steps done, and the steps in all where they are known.
Listener = Callable[[str, int, Union[int, None]], object]

Interval = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Contact:
    """A particle that touches the obstacle, or may.

    `tangential` and `normal` are degrees of freedom, counted from 0. `state` is "slip" (impending
    slip, with the `sign` of the tangential reaction, 1 or -1), "stick" or "free".
    `normal_direction` is 1 where the normal degree of freedom points into the obstacle, else -1.
    `frame` turns an oblique contact: its rows are the tangent and the normal over the two degrees
    of freedom.
    """

    tangential: int
    normal: int
    state: str
    sign: int | None = None
    normal_direction: int = 1
    frame: Sequence[Sequence[Number]] | None = None


@dataclass(frozen=True)
class Solution:
    """A solution that the checker has accepted.

    Proved are the support and the enclosure of the value; the floats are near the solution.
    """

    unknown: str
    value: float
    enclosure: Interval
    support: list[int]
    biactive: list[int]
    x: list[float]
    y: list[float]
    v: list[float] | None
    w: list[float] | None

    @property
    def exact_value(self) -> Fraction | None:
        """The value itself, where it is rational and known."""
        low, high = self.enclosure
        return low if low == high else None


@dataclass(frozen=True)
class Family:
    """Solutions of one support at one value or at every value between two."""

    support: list[int]
    start: Interval
    end: Interval | None
    is_point: bool
    is_alone: bool


@dataclass(frozen=True)
class OpenRegion:
    """Values and supports of which nothing is proved."""

    min: Fraction
    max: Fraction | None
    moving: list[int]
    undecided: list[int]


@dataclass(frozen=True)
class Uncertified:
    """A point where the solver stopped and no proof was found."""

    value: float
    x: list[float]
    reason: str


@dataclass(frozen=True)
class Found:
    """What the solver has found; it does not say that there is nothing else."""

    solutions: list[Solution]
    uncertified: list[Uncertified]
    runs: int
    certificate: dict[str, Any] = field(repr=False)

    def _repr_html_(self) -> str:
        return _table(self.solutions)


@dataclass(frozen=True)
class SolutionSet:
    """All solutions in the window, as far as they are proved."""

    solutions: list[Solution]
    families: list[Family]
    open: list[OpenRegion]
    certificate: dict[str, Any] = field(repr=False)

    @property
    def is_complete(self) -> bool:
        """Is it proved that there are no other solutions?"""
        return not self.open

    @property
    def is_empty(self) -> bool:
        """Is it proved that there is none?"""
        return self.is_complete and not self.solutions and not self.families

    def _repr_html_(self) -> str:
        verdict = "complete" if self.is_complete else f"{len(self.open)} regions open"
        return f"<p>{verdict}</p>" + _table(self.solutions)


@dataclass(frozen=True)
class Certified:
    """A solution near a point that was given, with its own certificate."""

    solution: Solution
    certificate: dict[str, Any] = field(repr=False)


@dataclass(frozen=True)
class Proof:
    """A problem and a certificate that the checker has accepted."""

    name: str
    problem: dict[str, Any] = field(repr=False)
    certificate: dict[str, Any] = field(repr=False)


@dataclass(frozen=True)
class Analysis:
    """The engineer's answer. `answer` is all of it (`mceip-analysis/1`)."""

    answer: dict[str, Any] = field(repr=False)
    proofs: list[Proof] = field(repr=False)

    @property
    def summary(self) -> str:
        """The answer in one paragraph."""
        return self.answer["summary"]

    @property
    def verdict(self) -> str:
        """"present", "absent" or "undecided": divergence at the friction coefficient asked for."""
        return self.answer["divergence"]["verdict"]

    @property
    def absent_below(self) -> Fraction | None:
        """No divergence of the form (8) exists below this friction coefficient."""
        bound = self.answer["critical"]["absent_below"]
        return None if bound is None else Fraction(bound)

    @property
    def critical_friction(self) -> tuple[Fraction | None, Fraction | None]:
        """Proved bounds of the smallest friction coefficient with divergence."""
        solution = self.answer["critical"]["solution"]
        upper = None if solution is None else Fraction(solution["mu"][1])
        return self.absent_below, upper

    def __str__(self) -> str:
        return self.summary


@dataclass(frozen=True)
class Claim:
    """What is proved of a solution: its support and an enclosure of its value."""

    support: list[int]
    enclosure: Interval


@dataclass(frozen=True)
class Accepted:
    """What an accepted certificate has proved."""

    claims: list[Claim]
    solutions: list[Claim] | None
    families: list[Family]
    open: list[OpenRegion]

    @property
    def is_complete(self) -> bool:
        """Does the certificate prove that there are no other solutions?"""
        return self.solutions is not None and not self.open


class Problem:
    """A mixed complementarity eigenproblem: find t >= 0 and x != 0 with

        (A + t B) x = y,   y_f = 0,   0 <= x_s  _|_  y_s >= 0
    """

    def __init__(self, native: NativeProblem) -> None:
        self._native = native

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Problem:
        """A problem file (`mceip-problem/1`)."""
        return cls(NativeProblem.read(os.fspath(path)))

    @classmethod
    def from_json(cls, text: str) -> Problem:
        """The text of a problem file."""
        return cls(NativeProblem.from_json(text))

    @classmethod
    def from_matrices(
        cls, stiffness: Any, mass: Any, friction: Number, contacts: Sequence[Contact]
    ) -> Problem:
        """Growth rates lambda^2 of a mechanical system at a friction coefficient, (12)-(14).

        `stiffness` and `mass` are square over the degrees of freedom, symmetric.
        """
        dofs, k = _triplets("stiffness", stiffness)
        _, m = _triplets("mass", mass, dofs)
        contacts = [_spelt_contact(c) for c in contacts]
        return cls(NativeProblem.lambda2(dofs, k, m, _spelt(friction), contacts))

    @classmethod
    def friction_threshold(cls, stiffness: Any, contacts: Sequence[Contact]) -> Problem:
        """Friction coefficients at which a quasi-static motion begins, (21)-(23)."""
        dofs, k = _triplets("stiffness", stiffness)
        contacts = [_spelt_contact(c) for c in contacts]
        return cls(NativeProblem.friction_threshold(dofs, k, contacts))

    @classmethod
    def from_pencil(
        cls, a: Any, b: Any, free: Sequence[int] = (), unknown: str = "lambda2"
    ) -> Problem:
        """The problem of a pencil A + tB; `free` lists the indices with y = 0 and x of any sign."""
        order, a = _triplets("a", a)
        _, b = _triplets("b", b, order)
        return cls(NativeProblem.pencil(order, a, b, list(free), unknown))

    def in_window(self, min: Number, max: Number | None = None) -> Problem:
        """The same problem with the values sought in [min, max], or from min on."""
        upper = None if max is None else _spelt(max)
        return Problem(self._native.in_window(_spelt(min), upper))

    @property
    def unknown(self) -> str:
        """"lambda2" or "mu"."""
        return self._native.unknown()

    @property
    def sha256(self) -> str:
        """The digest that certificates name."""
        return self._native.sha256()

    def to_json(self) -> str:
        """The problem as a file."""
        return self._native.to_json()

    def solve(
        self, *, starts: int = 22, seed: int = 1, all: bool = False, progress: Listener | None = None
    ) -> Found:
        """Solutions by the PATH-style solver, each certified. One seed gives one result."""
        answer = json.loads(self._native.solve(starts, seed, all, progress))
        return Found(
            solutions=[_solution(s) for s in answer["solutions"]],
            uncertified=[Uncertified(**point) for point in answer["uncertified"]],
            runs=answer["runs"],
            certificate=answer["certificate"],
        )

    def complete(
        self,
        *,
        threads: int | None = None,
        resume: dict[str, Any] | None = None,
        progress: Listener | None = None,
    ) -> SolutionSet:
        """All solutions in the window, with a proof that there are no others."""
        earlier = None if resume is None else json.dumps(resume)
        answer = json.loads(self._native.complete(threads, earlier, progress))
        return SolutionSet(
            solutions=[_solution(s) for s in answer["solutions"]],
            families=[_family(f) for f in answer["families"]],
            open=[_region(r) for r in answer["open"]],
            certificate=answer["certificate"],
        )

    def analyze(
        self,
        friction: Number | None = None,
        *,
        samples: int = 16,
        threads: int | None = None,
        progress: Listener | None = None,
    ) -> Analysis:
        """Can this equilibrium diverge in the form (8), from which friction on, and how is it known?"""
        mu = None if friction is None else _spelt(friction)
        answer = json.loads(self._native.analyze(mu, samples, threads, progress))
        return Analysis(answer["answer"], [Proof(**proof) for proof in answer["proofs"]])

    def certify(self, value: float, x: Sequence[float]) -> Certified:
        """A proof that there is a solution near a point in floats."""
        answer = json.loads(self._native.certify(float(value), [float(x_i) for x_i in x]))
        return Certified(_solution(answer["solution"]), answer["certificate"])

    def check(self, certificate: dict[str, Any] | str) -> Accepted:
        """What a certificate proves; raises `RejectedError` where it proves nothing."""
        text = certificate if isinstance(certificate, str) else json.dumps(certificate)
        answer = json.loads(self._native.check(text))
        cover = answer["complete_set"]
        return Accepted(
            claims=[_claim(c) for c in answer["claims"]],
            solutions=None if cover is None else [_claim(c) for c in cover["solutions"]],
            families=[] if cover is None else [_family(f) for f in cover["families"]],
            open=[] if cover is None else [_region(r) for r in cover["open"]],
        )

    def __repr__(self) -> str:
        return f"<mceip.Problem {self.unknown} {self.sha256[:12]}>"


def check(problem: Problem, certificate: dict[str, Any] | str) -> Accepted:
    """What a certificate proves of a problem; raises `RejectedError` where it proves nothing."""
    return problem.check(certificate)


def _spelt(number: Number) -> str:
    """A number as text; a float as exactly the fraction that it is."""
    if isinstance(number, str):
        return number
    try:
        return str(Fraction(number))
    except (TypeError, ValueError, OverflowError):
        raise MceipError(f"expected a finite number, got {number!r}") from None


def _spelt_contact(contact: Contact) -> Contact:
    if contact.frame is None:
        return contact
    frame = [[_spelt(entry) for entry in row] for row in contact.frame]
    return Contact(
        contact.tangential, contact.normal, contact.state, contact.sign,
        contact.normal_direction, frame,
    )


Triplets = tuple[list[int], list[int], list[float]]


def _triplets(name: str, matrix: Any, order: int | None = None) -> tuple[int, Triplets]:
    """The order of a square matrix and its entries."""
    if hasattr(matrix, "tocoo"):
        coo = matrix.tocoo()
        shape = tuple(coo.shape)
        entries = (coo.row.tolist(), coo.col.tolist(), coo.data.astype(float).tolist())
    else:
        rows = [[float(entry) for entry in row] for row in matrix]
        shape = (len(rows), len(rows[0]) if rows else 0)
        if any(len(row) != shape[1] for row in rows):
            raise MceipError(f"{name}: expected rows of one length")
        places = [(i, j) for i, row in enumerate(rows) for j, entry in enumerate(row) if entry != 0]
        entries = (
            [i for i, _ in places], [j for _, j in places], [rows[i][j] for i, j in places],
        )

    expected = shape[0] if order is None else order
    if shape != (expected, expected):
        raise MceipError(f"{name}: expected a matrix of {expected} x {expected}, got {shape}")
    return shape[0], entries


def _interval(ends: Sequence[str]) -> Interval:
    low, high = ends
    return Fraction(low), Fraction(high)


def _solution(answer: dict[str, Any]) -> Solution:
    return Solution(**{**answer, "enclosure": _interval(answer["enclosure"])})


def _claim(answer: dict[str, Any]) -> Claim:
    return Claim(answer["support"], _interval(answer["enclosure"]))


def _family(answer: dict[str, Any]) -> Family:
    end = answer["to"]
    return Family(
        support=answer["support"],
        start=_interval(answer["from"]),
        end=None if end is None else _interval(end),
        is_point=answer["is_point"],
        is_alone=answer["is_alone"],
    )


def _region(answer: dict[str, Any]) -> OpenRegion:
    upper = answer["max"]
    return OpenRegion(
        min=Fraction(answer["min"]),
        max=None if upper is None else Fraction(upper),
        moving=answer["moving"],
        undecided=answer["undecided"],
    )


def _table(solutions: Sequence[Solution]) -> str:
    rows = "".join(
        f"<tr><td>{s.value:.10g}</td><td>{', '.join(map(str, s.support))}</td></tr>"
        for s in solutions
    )
    unknown = solutions[0].unknown if solutions else "value"
    return f"<table><tr><th>{unknown}</th><th>slip</th></tr>{rows}</table>"
