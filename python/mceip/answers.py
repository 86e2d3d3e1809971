"""Answers as dataclasses.

Exact numbers are `fractions.Fraction`, vectors numpy arrays; floats are near what is proved.
Indices count from 0. In a notebook the answers are tables.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from html import escape
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from ._native import NativeProblem
from .exact import (
    Interval,
    fraction_of,
    fraction_or_none,
    interval_of,
    known_text,
    number_text,
    range_text,
    short_text,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: How many numbers an interpreter shows of a list.
MOST_LISTED = 6

#: Components of a vector, in doubles.
Vector = npt.NDArray[np.float64]

#: A certificate as the JSON object that its file holds.
Certificate = dict[str, Any]


@dataclass(frozen=True)
class Solution:
    """A solution that the checker has accepted.

    What is proved is that the problem has a solution with this support and a value in the
    enclosure. The floats are its components to the precision of doubles.

    Attributes:
        unknown: "lambda2" (units of stiffness / mass), "mu" (no unit) or "eigenvalue".
        value: the value, rounded.
        enclosure: encloses the value.
        support: complementarity variables with x > 0; of a body, the particles in impending slip
            that slip.
        biactive: variables with x = y = 0, where that is proved; empty where the solution is only
            enclosed.
        x: over the variables of the pencil, scaled so that its complementarity variables sum to
            one.
        y: (A + t B) x, over the same.
        v: displacements over the degrees of freedom, the mode of (8); None for a pencil.
        w: reaction rates over the degrees of freedom; None for a pencil.
    """

    unknown: str
    value: float
    enclosure: Interval
    support: list[int]
    biactive: list[int]
    x: Vector = field(compare=False)
    y: Vector = field(compare=False)
    v: Vector | None = field(compare=False)
    w: Vector | None = field(compare=False)

    @property
    def exact_value(self) -> Fraction | None:
        """The value itself, where it is rational and known."""
        low, high = self.enclosure
        return low if low == high else None

    def __repr__(self) -> str:
        return two_lines(
            f"Solution {self.unknown} {placed(self.enclosure)}",
            f"x > 0 at {indices(self.support)}, x = y = 0 at {indices(self.biactive)}",
        )


@dataclass(frozen=True)
class Family:
    """Solutions of one support: at one value, or at every value between two.

    Attributes:
        support: complementarity variables with x > 0.
        start: encloses the smallest value; None where there is none.
        end: encloses the largest value; None where there is none.
        is_point: is it one value?
        is_alone: is it proved that there are no other solutions at these values?
    """

    support: list[int]
    start: Interval | None
    end: Interval | None
    is_point: bool
    is_alone: bool


@dataclass(frozen=True)
class OpenRegion:
    """Values and supports of which nothing is proved.

    Attributes:
        min: smallest value; None for -infinity.
        max: largest value; None for infinity.
        moving: variables that are in each of the supports.
        undecided: variables that may be in them or not.
    """

    min: Fraction | None
    max: Fraction | None
    moving: list[int]
    undecided: list[int]


@dataclass(frozen=True)
class Uncertified:
    """A point where the solver stopped, and why no proof was found. Nothing is known of it."""

    value: float
    x: Vector = field(compare=False)
    reason: str

    def __repr__(self) -> str:
        return two_lines(f"Uncertified {self.value:.10g}", self.reason)


@dataclass(frozen=True)
class Found:
    """What the solver has found. It does not say that there is nothing else.

    Attributes:
        solutions: by value; the checker has accepted each.
        uncertified: points without proof: do not use them.
        runs: runs of the solver.
        certificates: of all solutions; none where there are none, and one unless the solutions
            cost more together than the checker allows for one file.
    """

    solutions: list[Solution]
    uncertified: list[Uncertified]
    runs: int
    certificates: list[Certificate] = field(repr=False)

    def __repr__(self) -> str:
        points = counted(len(self.uncertified), "point")
        return two_lines(
            f"Found {counted(len(self.solutions), 'solution')}, certified: {values(self.solutions)}",
            f"{points} without proof, {counted(self.runs, 'run')}; others are not excluded",
        )

    def _repr_html_(self) -> str:
        return f"<p>{len(self.solutions)} found</p>" + table_of_solutions(self.solutions)


@dataclass(frozen=True)
class SolutionSet:
    """All solutions in the window, as far as they are proved.

    Attributes:
        solutions: the isolated solutions, by value.
        families: continua of solutions.
        open: what is left open.
        certificate: of the whole set.
    """

    solutions: list[Solution]
    families: list[Family]
    open: list[OpenRegion]
    certificate: Certificate = field(repr=False)

    @property
    def is_complete(self) -> bool:
        """Is it proved that there are no solutions but these?"""
        return not self.open

    @property
    def is_empty(self) -> bool:
        """Is it proved that the window holds no solution?"""
        return self.is_complete and not self.solutions and not self.families

    @property
    def _verdict(self) -> str:
        regions = counted(len(self.open), "region")
        verdict = "complete" if self.is_complete else f"undecided: {regions} open"
        if self.families:
            verdict += f", {counted(len(self.families), 'family', 'families')}"
        return verdict

    def __repr__(self) -> str:
        count = counted(len(self.solutions), "solution")
        return two_lines(f"SolutionSet {self._verdict}", f"{count}: {values(self.solutions)}")

    def _repr_html_(self) -> str:
        return f"<p>{self._verdict}</p>" + table_of_solutions(self.solutions)


@dataclass(frozen=True)
class Certified:
    """A solution near a point that was given, with its own certificate."""

    solution: Solution
    certificate: Certificate = field(repr=False)


@dataclass(frozen=True)
class Claim:
    """What is proved of a solution: its support, and an enclosure of its value."""

    support: list[int]
    enclosure: Interval


@dataclass(frozen=True)
class Accepted:
    """What an accepted certificate has proved.

    Attributes:
        claims: the claims that are proved one by one.
        solutions: all isolated solutions in the window; None where the certificate says nothing
            of completeness.
        families: the continua of solutions.
        open: what the certificate leaves open.
        windows: the windows that the certificate speaks of, as "[10, 11]"; they may be smaller than
            that of the problem.
    """

    claims: list[Claim]
    solutions: list[Claim] | None
    families: list[Family]
    open: list[OpenRegion]
    windows: list[str]

    @property
    def is_complete(self) -> bool:
        """Does the certificate prove that there are no other solutions in its `windows`?"""
        return self.solutions is not None and not self.open

    def __repr__(self) -> str:
        proved = self.claims if self.solutions is None else self.solutions
        windows = " and ".join(self.windows)
        others = f"no others in {windows}" if self.is_complete else "others are not excluded"
        regions = f"{counted(len(self.open), 'region')} open"
        count = counted(len(proved), "solution")
        return two_lines(
            f"Accepted {count}: {listed([str(claim.enclosure) for claim in proved])}",
            f"{counted(len(self.families), 'family', 'families')}, {regions}; {others}",
        )


@dataclass(frozen=True)
class Absence:
    """What an accepted certificate of absence has proved.

    Attributes:
        below: there is no solution for friction coefficients in [start, below] and lambda^2 >= 0.
        leaves: number of leaves that prove it.
        start: the smallest friction coefficient of which this is proved, 0 for a proof of
            `analyze`.
        of_every_member: is it proved of every body within the radii of the data? False: of the one
            body that data without radii are.
    """

    below: Fraction
    leaves: int
    start: Fraction
    of_every_member: bool

    def __repr__(self) -> str:
        # At 0 a particle may slide both ways, of which (9) has one.
        begin = "above 0" if self.start == 0 else f"from {number_text(self.start)}"
        return two_lines(
            f"Absence for friction {begin} up to {number_text(self.below)}{of_members(self)}",
            f"no solution with lambda^2 >= 0; {counted(self.leaves, 'leaf', 'leaves')} accepted",
        )


@dataclass(frozen=True)
class Presence:
    """What an accepted certificate of presence has proved.

    Attributes:
        start: the smallest friction coefficient of which this is proved.
        end: the largest: for each in [start, end] there is a solution with lambda^2 >= 0.
        pieces: number of pieces that prove it.
        of_every_member: is it proved of every body within the radii of the data? False: of the one
            body that data without radii are.
    """

    start: Fraction
    end: Fraction
    pieces: int
    of_every_member: bool

    def __repr__(self) -> str:
        return two_lines(
            f"Presence for friction in {range_text(self.start, self.end)}{of_members(self)}",
            f"a solution with lambda^2 >= 0 at each; {counted(self.pieces, 'piece')} accepted",
        )


@dataclass(frozen=True)
class Stability:
    """What an accepted certificate of stability has proved.

    Attributes:
        start: the smallest friction coefficient of which this is proved; not 0 itself.
        end: the largest: for each from start to end a motion that begins near the equilibrium, in
            contact, stays near it.
        of_every_motion: False if that is said only of motions that keep to the contact states.
    """

    start: Fraction
    end: Fraction
    of_every_motion: bool

    def __repr__(self) -> str:
        begin = "above 0" if self.start == 0 else f"from {number_text(self.start)}"
        motions = "every motion" if self.of_every_motion else "motions that keep to the states"
        return two_lines(
            f"Stability for friction {begin} up to {number_text(self.end)}",
            f"of {motions}, in contact and near the equilibrium",
        )


#: What an accepted certificate proves, by its kind.
Statement = Union[Accepted, Absence, Presence, Stability]


def of_members(statement: Absence | Presence) -> str:
    """Of which bodies something is said."""
    return ", of every member" if statement.of_every_member else ""


@dataclass(frozen=True)
class Members:
    """What is proved of every body within the radii of the data.

    Attributes:
        absent_below: none of them diverges for a friction coefficient above 0 up to this; None
            where that is proved of no coefficient.
        present: each of them diverges for every friction coefficient from the first number to the
            second; None where that is not proved.
        middle: the critical friction coefficient in the middle of them, in doubles, or None.
        width: how far from it theirs may be, to first order in the radii, or None.
        costs: which numbers of the data that width is due to, and how much each; the largest first.
        obstacle: why the search ended early, or None.
    """

    absent_below: Fraction | None
    present: tuple[Fraction, Fraction] | None
    middle: float | None
    width: float | None
    costs: dict[str, float] = field(repr=False)
    obstacle: str | None

    def __repr__(self) -> str:
        absent = "none proved" if self.absent_below is None else number_text(self.absent_below)
        present = "none proved" if self.present is None else range_text(*self.present)
        middle = "" if self.middle is None else f"critical friction near {self.middle:.6g}, "
        width = "no first order" if self.width is None else f"first order +- {self.width:.2g}"
        return two_lines(
            f"Members: no divergence up to {absent}, all diverge in {present}",
            f"{middle}{width}",
        )


def members_of(answer: dict[str, Any]) -> Members:
    """The field `members` of an analysis."""
    absent = answer["absent"]
    present = answer["present"]
    first_order = answer["first_order"] or {"middle": None, "width": None, "costs": []}
    return Members(
        None if absent is None else fraction_of(absent["below"]),
        None if present is None else (fraction_of(present["from"]), fraction_of(present["to"])),
        first_order["middle"],
        first_order["width"],
        {cost["of"]: cost["width"] for cost in first_order["costs"]},
        answer["obstacle"],
    )


@dataclass(frozen=True)
class Proof:
    """A certificate that the checker has accepted, with the problem that it belongs to.

    Attributes:
        name: what the evidence of a sentence refers to.
        problem: the JSON object of a problem file.
        certificate: the JSON object of a certificate.
    """

    name: str
    problem: dict[str, Any] = field(repr=False)
    certificate: Certificate = field(repr=False)

    def check(self) -> Statement:
        """Runs the checker once more; raises `RejectedError` where it refuses."""
        native = NativeProblem.from_json(json.dumps(self.problem))
        return statement_of(json.loads(native.check(json.dumps(self.certificate))))


@dataclass(frozen=True)
class Evidence:
    """What a statement rests on.

    Attributes:
        kind: "certificate": the checker has accepted one; "exact": a condition in exact
            arithmetic; "measured": doubles, not proved.
        source: the name of the `Proof`, or the condition in words.
    """

    kind: str
    source: str


@dataclass(frozen=True)
class Mode:
    """A motion u0 + alpha(t) v that diverges, (8), with alpha growing like exp(lambda t).

    Attributes:
        lambda2: encloses lambda^2, units of stiffness / mass (1/s^2 where these are consistent).
        growth_rate: lambda, its square root.
        slipping: particles that slip, by their place in the list of contacts.
        sticking: particles in impending slip that do not move.
        v: displacements over the degrees of freedom; the slip rates sum to one.
        names: the names of all particles, or their places as words.
    """

    lambda2: Interval
    growth_rate: float
    slipping: list[int]
    sticking: list[int]
    v: Vector = field(compare=False)
    names: list[str]

    @property
    def _rate(self) -> str:
        return f"{known_text(self.growth_rate, self.lambda2, 6)} 1/s"

    def __repr__(self) -> str:
        slipping, sticking = (
            listed([self.names[place] for place in places])
            for places in (self.slipping, self.sticking)
        )
        return two_lines(
            f"Mode growing at {self._rate}, lambda^2 {placed(self.lambda2)}",
            f"contacts that slip: {slipping}; that do not: {sticking}",
        )


@dataclass(frozen=True)
class CriticalFriction:
    """What is proved of the smallest friction coefficient with divergence of the form (8).

    Attributes:
        without_friction: divergence at the coefficient 0: "present", "absent", "undecided".
        absent_below: there is no divergence below it, 0 if no such bound is proved; None: there is
            none at any coefficient.
        absent_evidence: what that rests on.
        mu: encloses a coefficient with divergence, the smallest that was found; None if none was.
        lambda2: encloses lambda^2 there; 0 at the static threshold.
        evidence: what that rests on.
        unbounded: encloses the coefficient beside which growth has no bound, where the critical one
            lies there, because M* loses its property; None elsewhere.
    """

    without_friction: str
    absent_below: Fraction | None
    absent_evidence: Evidence
    mu: Interval | None
    lambda2: Interval | None
    evidence: Evidence | None
    unbounded: Interval | None

    @property
    def bounds(self) -> Interval | None:
        """Encloses the critical friction coefficient, 0 where there is divergence without friction
        already; None where no upper bound was found."""
        if self.without_friction == "present":
            return Interval(Fraction(0), Fraction(0))
        if self.absent_below is None or self.mu is None:
            return None
        return Interval(self.absent_below, self.mu.upper)

    @property
    def _bounds_text(self) -> str:
        if self.without_friction == "present":
            return "0: divergence without friction already"
        if self.absent_below is None:
            return "none: no divergence at any mu"
        if self.bounds is None:
            return f"not below {number_text(self.absent_below)}"
        return placed(self.bounds)

    def __repr__(self) -> str:
        bases = [basis.kind for basis in (self.absent_evidence, self.evidence) if basis]
        at = "" if self.lambda2 is None else f"lambda^2 there {placed(self.lambda2)}; "
        return two_lines(
            f"CriticalFriction {self._bounds_text}", f"{at}rests on: {', '.join(bases)}"
        )


@dataclass(frozen=True)
class Analysis:
    """The engineer's answer.

    Attributes:
        answer: all of it, a JSON object (`mceip-analysis/1`).
        proofs: the certificates, each with its problem.
    """

    answer: dict[str, Any] = field(repr=False)
    proofs: list[Proof] = field(repr=False)

    @property
    def warnings(self) -> list[str]:
        """What looked wrong when the problem was made."""
        return [str(sentence) for sentence in self.answer["warnings"]]

    @property
    def summary(self) -> str:
        """The answer in one paragraph."""
        return str(self.answer["summary"])

    @property
    def verdict(self) -> str:
        """Divergence at the friction coefficient asked for: "present", "absent", "undecided"."""
        return str(self.answer["divergence"]["verdict"])

    @property
    def modes(self) -> list[Mode]:
        """The diverging motions at the friction coefficient asked for."""
        names = self.answer["particles"]
        return [mode_of(mode, names) for mode in self.answer["divergence"]["modes"]]

    @property
    def critical(self) -> CriticalFriction:
        """The critical friction coefficient, with what stands behind it."""
        return critical_of(self.answer["critical"])

    @property
    def critical_friction(self) -> Interval | None:
        """Bounds of the critical friction coefficient; None where no upper bound was found."""
        return self.critical.bounds

    @property
    def stability(self) -> Stability | None:
        """For which friction coefficients the equilibrium is proved to be stable; None for none."""
        answer = self.answer["stability"]
        if answer is None:
            return None
        return Stability(Fraction(0), fraction_of(answer["to"]), answer["of_every_motion"])

    @property
    def members(self) -> Members | None:
        """What is proved of every body within the radii of the data; None where they have none."""
        answer = self.answer["members"]
        return None if answer is None else members_of(answer)

    def __str__(self) -> str:
        return self.summary

    def __repr__(self) -> str:
        friction = short_text(fraction_of(self.answer["friction"]))
        rates = listed([mode._rate for mode in self.modes])
        growing = f", growing at {rates}" if self.modes else ""
        return two_lines(
            f"Analysis divergence at mu = {friction}: {self.verdict}{growing}",
            f"critical friction {self.critical._bounds_text}",
        )

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws along mu where divergence is present and where it is not, with the critical
        friction, into axes of matplotlib; new ones if none are given."""
        from .plotting import plot_ranges

        return plot_ranges(self, ax)

    def _repr_html_(self) -> str:
        rows = []
        for sentence in self.answer["sentences"]:
            evidence = evidence_of(sentence["evidence"])
            basis = f"{evidence.kind}: {evidence.source}"
            rows.append([sentence["topic"], sentence["text"], basis])
        paragraphs = [self.summary, *(f"Warning of the model: {text}." for text in self.warnings)]
        text = "".join(f"<p>{escape(paragraph)}</p>" for paragraph in paragraphs)
        return text + html_table(["", "", "rests on"], rows)


def solution_of(answer: dict[str, Any]) -> Solution:
    return Solution(
        unknown=answer["unknown"],
        value=answer["value"],
        enclosure=interval_of(answer["enclosure"]),
        support=answer["support"],
        biactive=answer["biactive"],
        x=np.array(answer["x"]),
        y=np.array(answer["y"]),
        v=None if answer["v"] is None else np.array(answer["v"]),
        w=None if answer["w"] is None else np.array(answer["w"]),
    )


def family_of(answer: dict[str, Any]) -> Family:
    start, end = answer["from"], answer["to"]
    return Family(
        support=answer["support"],
        start=None if start is None else interval_of(start),
        end=None if end is None else interval_of(end),
        is_point=answer["is_point"],
        is_alone=answer["is_alone"],
    )


def region_of(answer: dict[str, Any]) -> OpenRegion:
    return OpenRegion(
        min=fraction_or_none(answer["min"]),
        max=fraction_or_none(answer["max"]),
        moving=answer["moving"],
        undecided=answer["undecided"],
    )


def claim_of(answer: dict[str, Any]) -> Claim:
    return Claim(answer["support"], interval_of(answer["enclosure"]))


def found_of(answer: dict[str, Any]) -> Found:
    uncertified = [
        Uncertified(point["value"], np.array(point["x"]), point["reason"])
        for point in answer["uncertified"]
    ]
    return Found(
        solutions=[solution_of(solution) for solution in answer["solutions"]],
        uncertified=uncertified,
        runs=answer["runs"],
        certificates=answer["certificates"],
    )


def solution_set_of(answer: dict[str, Any]) -> SolutionSet:
    return SolutionSet(
        solutions=[solution_of(solution) for solution in answer["solutions"]],
        families=[family_of(family) for family in answer["families"]],
        open=[region_of(region) for region in answer["open"]],
        certificate=answer["certificate"],
    )


def certified_of(answer: dict[str, Any]) -> Certified:
    return Certified(solution_of(answer["solution"]), answer["certificate"])


def statement_of(answer: dict[str, Any]) -> Statement:
    """What a certificate of the kind that the answer names has proved."""
    kind = answer["format"]
    if kind == "mceip-critical/1":
        return Absence(
            fraction_of(answer["below"]),
            answer["leaves"],
            fraction_of(answer["start"]),
            answer["of_every_member"],
        )
    if kind == "mceip-presence/1":
        return Presence(
            fraction_of(answer["start"]),
            fraction_of(answer["end"]),
            answer["pieces"],
            answer["of_every_member"],
        )
    if kind == "mceip-stability/1":
        return Stability(
            fraction_of(answer["start"]), fraction_of(answer["end"]), answer["of_every_motion"]
        )
    return accepted_of(answer)


def accepted_of(answer: dict[str, Any]) -> Accepted:
    claims = [claim_of(claim) for claim in answer["claims"]]
    cover = answer["complete_set"]
    if cover is None:
        return Accepted(claims, None, families=[], open=[], windows=answer["windows"])
    return Accepted(
        claims=claims,
        solutions=[claim_of(claim) for claim in cover["solutions"]],
        families=[family_of(family) for family in cover["families"]],
        open=[region_of(region) for region in cover["open"]],
        windows=answer["windows"],
    )


def analysis_of(answer: dict[str, Any]) -> Analysis:
    proofs = [
        Proof(proof["name"], proof["problem"], proof["certificate"]) for proof in answer["proofs"]
    ]
    return Analysis(answer["answer"], proofs)


def mode_of(answer: dict[str, Any], names: list[str]) -> Mode:
    return Mode(
        lambda2=interval_of(answer["lambda2"]),
        growth_rate=answer["growth_rate"],
        slipping=answer["slipping"],
        sticking=answer["sticking"],
        v=np.array(answer["v"]),
        names=names,
    )


def critical_of(answer: dict[str, Any]) -> CriticalFriction:
    solution = answer["solution"]
    unbounded = answer["unbounded"]
    return CriticalFriction(
        without_friction=answer["without_friction"],
        absent_below=fraction_or_none(answer["absent_below"]),
        absent_evidence=evidence_of(answer["absent_evidence"]),
        mu=None if solution is None else interval_of(solution["mu"]),
        lambda2=None if solution is None else interval_of(solution["lambda2"]),
        evidence=None if solution is None else evidence_of(solution["evidence"]),
        unbounded=None if unbounded is None else interval_of(unbounded["mu"]),
    )


def evidence_of(answer: dict[str, Any]) -> Evidence:
    source = answer["path"] if answer["kind"] == "certificate" else answer["how"]
    return Evidence(answer["kind"], source)


def two_lines(first: str, second: str) -> str:
    """What an interpreter shows of an answer."""
    return f"<mceip.{first}\n {second}>"


def counted(number: int, one: str, many: str | None = None) -> str:
    """So many of something."""
    return f"{number} {one if number == 1 else many or one + 's'}"


def listed(texts: Sequence[str]) -> str:
    """The first of some texts, and how many more there are."""
    more = len(texts) - MOST_LISTED
    tail = [f"{more} more"] if more > 0 else []
    return ", ".join([*texts[:MOST_LISTED], *tail]) or "none"


def indices(numbers: Sequence[int]) -> str:
    return listed([str(number) for number in numbers])


def values(solutions: Sequence[Solution]) -> str:
    return listed([known_text(solution.value, solution.enclosure) for solution in solutions])


def placed(interval: Interval) -> str:
    """Where a number is known to lie."""
    return f"= {interval}" if interval.lower == interval.upper else f"in {interval}"


def table_of_solutions(solutions: Sequence[Solution]) -> str:
    """Values, with their enclosures, and supports."""
    unknown = solutions[0].unknown if solutions else "value"
    rows = []
    for solution in solutions:
        support = ", ".join(str(index) for index in solution.support)
        value = known_text(solution.value, solution.enclosure)
        rows.append([value, str(solution.enclosure), support])
    return html_table([unknown, "enclosure", "support"], rows)


def html_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    body = ""
    for row in rows:
        cells = "".join(f"<td>{escape(cell)}</td>" for cell in row)
        body += f"<tr>{cells}</tr>"
    return f"<table><tr>{head}</tr>{body}</table>"
