"""From loads to contact states: the quasi-static path of a body.

A body may touch an obstacle, and is loaded step by step. The path finds which candidates stick,
slip and open, exactly; each of its stretches has the problem in its contact states, for `analyze`.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from ._native import MceipError, NativeLoadPath, NativeLoads
from .answers import Analysis, Certificate, counted, indices, two_lines
from .exact import Interval, fraction_of, fraction_or_none, interval_of, number_text, short_text
from .inputs import Contact, Number, Triplets, count, counts, plain_contact, spelt, triplets
from .mesh import Mesh
from .problem import Problem, text_of, warn_of
from .progress import Progress, listening

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: One force for each degree of freedom, or forces by degree of freedom.
Load = Union[Sequence[Number], npt.NDArray[Any], Mapping[int, Number]]


@dataclass(frozen=True)
class Candidate:
    """What may come into contact.

    Attributes:
        tangential: degree of freedom along the obstacle, counted from 0.
        normal: degree of freedom normal to the obstacle.
        gap: distance from the obstacle in the unloaded body, >= 0.
        normal_direction: 1 where the normal degree of freedom is positive into the obstacle, -1
            where it is positive away from it.
        frame: of an oblique contact, as in `Contact`.
        friction_factor: the coefficient of friction of this candidate over the common one, > 0.
        name: by which answers call it; without one it is called by its number.
    """

    tangential: int
    normal: int
    gap: Number = 0
    normal_direction: int = 1
    frame: Sequence[Sequence[Number]] | None = None
    friction_factor: Number = 1
    name: str | None = None


@dataclass(frozen=True)
class Step:
    """A load that grows from nothing to these values, and stays while the next one grows.

    Attributes:
        name: for people.
        forces: by degree of freedom, or one for each.
        displacements: by degree of freedom; these are held from the beginning, also at 0.
        endless: of the last step: it grows until nothing more happens.
    """

    name: str
    forces: Load = field(default_factory=dict)
    displacements: Mapping[int, Number] = field(default_factory=dict)
    endless: bool = False


class Body:
    """An elastic body that may touch an obstacle.

    Args:
        stiffness: K, N x N, symmetric to the last bit, of numpy or scipy.sparse.
        mass: M, of the same kind; without it there are no growth rates.
        candidates: what may come into contact.
        held: degrees of freedom that do not move.
        mesh: where the nodes are: then the directions of the candidates are held against it, and
            wrong ones are said as `ModelWarning`.
    """

    def __init__(
        self,
        stiffness: Any,
        mass: Any = None,
        *,
        candidates: Sequence[Candidate],
        held: Sequence[int] = (),
        mesh: Mesh | None = None,
    ) -> None:
        self._dofs, self._stiffness = triplets("stiffness", stiffness)
        self._mass: Triplets | None = None
        if mass is not None:
            _, self._mass = triplets("mass", mass, self._dofs)
        if isinstance(candidates, Candidate) or not isinstance(candidates, Iterable):
            raise MceipError(f"candidates: expected a list of mceip.Candidate, got {candidates!r}")
        candidates = list(candidates)
        self._candidates = [contact_of(k, candidate) for k, candidate in enumerate(candidates)]
        self._gaps = [
            spelt(candidate.gap, f"candidate {k}: gap") for k, candidate in enumerate(candidates)
        ]
        self._held = counts("held", held)
        self._mesh = None if mesh is None else mesh._plain()

    def path(
        self,
        steps: Sequence[Step],
        friction: Number,
        *,
        in_doubles: bool = False,
        accept_warnings: bool = False,
        progress: Progress = None,
    ) -> LoadPath:
        """The path of the body, unloaded at its beginning, under these loads.

        What looks wrong in the body is said as `ModelWarning`; its problems repeat it.

        Args:
            steps: the loads, applied one after the other.
            friction: the coefficient mu.
            in_doubles: condenses in doubles instead of exactly; the path is then, exactly, that of
                a body which differs from this one by rounding. For more than some hundred degrees
                of freedom.
            accept_warnings: neither says nor keeps what looks wrong.
            progress: as in `Problem`.
        """
        if isinstance(steps, Step) or not isinstance(steps, Sequence):
            raise MceipError(f"steps: expected a list of mceip.Step, got {type(steps).__name__}")
        loads = NativeLoads.made(
            self._dofs,
            self._stiffness,
            self._mass,
            self._candidates,
            self._gaps,
            self._held,
            [plain_step(k, step, self._dofs) for k, step in enumerate(steps)],
            spelt(friction, "friction"),
            self._mesh,
            accept_warnings,
        )
        warn_of(loads.warnings())
        with listening(progress) as listener:
            path = loads.path(in_doubles, listener)
        if path is None:
            raise MceipError("the path was interrupted")
        return LoadPath(path, fraction_of(spelt(friction, "friction")))


class LoadPath:
    """The path of a body under loads.

    Attributes:
        stretches: between two events, in order.
        end: why it ends.
        friction: the coefficient mu.
    """

    def __init__(self, native: NativeLoadPath, friction: Fraction) -> None:
        self._native = native
        self.friction = friction
        stretches = json.loads(native.stretches())
        self.stretches = [Stretch(native, k, stretch) for k, stretch in enumerate(stretches)]
        self.end = native.end()

    def loads(self) -> str:
        """The body and its loads as the text of a file, `mceip-loads/1`: what certificates of its
        contact states are checked against. Held degrees of freedom are eliminated."""
        return self._native.loads()

    def __str__(self) -> str:
        return self._native.text()

    def analyze(self, *, progress: Progress = None) -> PathAnalysis:
        """Can the states inside the stretches diverge at the friction of the path, and from which
        friction on, each held?

        Args:
            progress: as in `Problem`.
        """
        with listening(progress) as listener:
            found, text = self._native.analyze(listener)
        return PathAnalysis([held_state_of(state) for state in json.loads(found)], text)

    def check(self, certificate: Certificate | str | os.PathLike[str]) -> CertifiedEquilibrium:
        """What a certificate of `Stretch.certify` proves of this body; raises `RejectedError` where
        it proves nothing."""
        friction, amounts, states = self._native.check(text_of(certificate))
        return CertifiedEquilibrium(
            friction=fraction_of(friction),
            amounts=[fraction_of(amount) for amount in amounts],
            states=np.array(states),
        )

    def own_critical(
        self,
        least: Number,
        greatest: Number,
        *,
        parts: int = 10,
        width: Number = "0.01",
        end_alone: bool = False,
        progress: Progress = None,
    ) -> OwnCritical:
        """From which friction on does the path meet an equilibrium that can diverge?

        At each mu of a grid the path is followed at this mu, and the equilibria on it are examined,
        one in each stretch and the one at its end; between neighbours with different answers more
        mu are.

        Args:
            least: the smallest mu.
            greatest: the largest mu.
            parts: parts of the grid.
            width: how near neighbours with different answers are brought, relative to mu.
            end_alone: examines the equilibrium at the end of the loads alone, for large bodies.
            progress: as in `Problem`.
        """
        ends = (spelt(least), spelt(greatest))
        with listening(progress) as listener:
            found, text = self._native.own_critical(
                ends, count("parts", parts, 1), spelt(width), bool(end_alone), listener
            )
        return OwnCritical(json.loads(found), text)

    def resultants(self) -> npt.NDArray[np.float64]:
        """A row (load, T, N) for the beginning of each stretch, and for the end of the last one if
        it ends. T is the sum of the tangential reactions, N the force that presses; loads are added
        up step after step."""
        rows = []
        load = 0.0
        for stretch in self.stretches:
            rows.append((load, *pressing(stretch.reactions)))
            if stretch.stop is not None and stretch.stop_reactions is not None:
                load += stretch.stop - stretch.start
                last = (load, *pressing(stretch.stop_reactions))
        if self.stretches and self.stretches[-1].stop is not None:
            rows.append(last)
        return np.array(rows).reshape(-1, 3)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws T, N and mu N against the load into axes of matplotlib; new ones if none are
        given."""
        from .plotting import plot_path

        return plot_path(self, ax)

    def __repr__(self) -> str:
        count = counted(len(self.stretches), "stretch", "stretches")
        return two_lines(f"LoadPath at mu = {short_text(self.friction)}, {count}", self.end)


@dataclass(frozen=True)
class HeldState:
    """The state inside a stretch of a path, its contact states held.

    Attributes:
        stretch: its number.
        divergence: at the friction of the path: "present", "absent", "undecided".
        lambda2: encloses lambda^2 of each motion that grows.
        absent_below: there is no divergence below it; None: there is none at any coefficient.
        present_at: encloses the smallest coefficient with divergence that is proved; None if none
            is.
    """

    stretch: int
    divergence: str
    lambda2: list[Interval]
    absent_below: Fraction | None
    present_at: Interval | None


@dataclass(frozen=True)
class PathAnalysis:
    """Which states on a path can diverge, in order of the stretches; its text is a table."""

    states: list[HeldState]
    text: str = field(repr=False)

    @property
    def diverging(self) -> list[HeldState]:
        """Those in which divergence is proved at the friction of the path."""
        return [state for state in self.states if state.divergence == "present"]

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        diverging = indices([state.stretch for state in self.diverging])
        count = counted(len(self.states), "stretch", "stretches")
        return two_lines(f"PathAnalysis of {count}", f"stretches that can diverge: {diverging}")


@dataclass(frozen=True)
class CertifiedEquilibrium:
    """What an accepted certificate of contact states has proved: there is such an equilibrium.

    Attributes:
        friction: the coefficient mu.
        amounts: how much of each step's load is applied.
        states: of the candidates, as in `Stretch`.
    """

    friction: Fraction
    amounts: list[Fraction]
    states: npt.NDArray[np.str_] = field(compare=False)


def held_state_of(answer: dict[str, Any]) -> HeldState:
    present_at = answer["present_at"]
    return HeldState(
        stretch=answer["stretch"],
        divergence=answer["divergence"],
        lambda2=[interval_of(ends) for ends in answer["lambda2"]],
        absent_below=fraction_or_none(answer["absent_below"]),
        present_at=None if present_at is None else interval_of(present_at),
    )


def pressing(reactions: npt.NDArray[np.float64]) -> tuple[float, float]:
    """The sums T of r_T and N of -r_N."""
    tangential, normal = reactions.sum(axis=0)
    return float(tangential), 0.0 - float(normal)


class OwnCritical:
    """The critical friction of the equilibria that loads lead to. Nothing is claimed between two mu.

    Attributes:
        found: "between", "at_most" (none below is decided), "none" or "undecided".
        absent: the mu before the critical one at which divergence is proved absent inside every
            stretch and at the end, if there is one.
        critical: the first mu at which divergence on it is proved, or the path ends.
        points: what is found at each mu, as in `mceip path --own-critical --json`.
        frozen: the critical friction of one state, held: of the one that diverges at `critical`,
            else of the end of the path at the last mu without divergence; see `points`.
    """

    def __init__(self, found: Mapping[str, Any], text: str) -> None:
        bracket: Mapping[str, str | None] = found["bracket"] or {}
        self.found: str = found["found"]
        self.absent: Fraction | None = fraction_or_none(bracket.get("absent"))
        self.critical: Fraction | None = fraction_or_none(bracket.get("critical"))
        self.points: list[dict[str, Any]] = found["points"]
        self.frozen: dict[str, Any] | None = found["frozen"]
        self._text = text

    def __str__(self) -> str:
        return self._text

    @property
    def bounds(self) -> Interval | None:
        """From `absent` to `critical`; None where one of them is missing."""
        if self.absent is None or self.critical is None:
            return None
        return Interval(self.absent, self.critical)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the answer at each mu examined into axes of matplotlib; new ones if none are
        given."""
        from .plotting import plot_own_critical

        return plot_own_critical(self, ax)

    def __repr__(self) -> str:
        lower, upper = (
            "none" if end is None else number_text(end) for end in (self.absent, self.critical)
        )
        return two_lines(
            f"OwnCritical {self.found}, absent at {lower}, critical at {upper}",
            f"{len(self.points)} mu examined",
        )


class Stretch:
    """A stretch of a path, on which no contact state changes.

    Attributes:
        step: the name of the load that grows.
        start: how much of it is applied at the beginning.
        stop: the same at the end; None where the stretch never ends.
        states: of the equilibria inside, one for each candidate: "free", "stick", "slip+" and
            "slip-" (impending slip along the tangent and against it, as in `Contact`), "zero".
        reactions: (r_T, r_N) of each candidate at the beginning.
        stop_reactions: the same at the end; None where the stretch never ends.
        continuations: the ways in which the path can go on at the beginning, each as the states of
            its candidates; None where there is one whatever load grows, or where not all were
            tried.
        is_only_one: there is one way to go on, proved. None where that is not known.
    """

    def __init__(self, native: NativeLoadPath, number: int, stretch: Mapping[str, Any]) -> None:
        self._native = native
        self._number = number
        self.step: str = stretch["step"]
        self.start: float = stretch["from"]
        self.stop: float | None = stretch["to"]
        self.states: npt.NDArray[np.str_] = np.array(stretch["equilibrium_states"])
        self.reactions: npt.NDArray[np.float64] = np.array(stretch["start"]["reactions_T_N"])
        self.stop_reactions: npt.NDArray[np.float64] | None = None
        if stretch["stop"] is not None:
            self.stop_reactions = np.array(stretch["stop"]["reactions_T_N"])
        ways = stretch["continuations"] or {}
        self.continuations: list[list[str]] | None = ways.get("states")
        self.is_only_one: bool | None = None
        if ways.get("one_for_every_load"):
            self.is_only_one = True
        elif self.continuations is not None:
            several = len(self.continuations) > 1
            self.is_only_one = None if ways["singular_sets"] and not several else not several

    @property
    def problem(self) -> Problem | None:
        """The problem in these contact states, without the held degrees of freedom; None where
        nothing slips."""
        native = self._native.problem(self._number)
        return None if native is None else Problem(native)

    def analyze(self, **options: Any) -> Analysis | None:
        """`Problem.analyze` in these contact states, held, with its modes over all degrees of
        freedom of the body; None where nothing slips."""
        problem = self.problem
        if problem is None:
            return None
        analysis = problem.analyze(**options)
        places = self._native.places()
        for mode in analysis.answer["divergence"]["modes"]:
            v = mode["v"]
            mode["v"] = [0.0 if place is None else v[place] for place in places]
        return analysis

    def certify(self) -> Certificate:
        """A certificate that there is an equilibrium in these contact states, at one amount of the
        load inside the stretch (`mceip-equilibrium/1`). Raises `NotCertifiedError` where none is
        found."""
        certificate: Certificate = json.loads(self._native.certify(self._number))
        return certificate

    def __repr__(self) -> str:
        stop = "without end" if self.stop is None else f"to {self.stop:.6g}"
        first = f"Stretch of {self.step} from {self.start:.6g} {stop}"
        return two_lines(first, " ".join(self.states.tolist()))


def contact_of(place: int, candidate: Candidate) -> Contact:
    """The candidate as a contact without a state."""
    if not isinstance(candidate, Candidate):
        raise MceipError(f"candidates: expected mceip.Candidate, got {candidate!r}")
    contact = Contact(
        tangential=candidate.tangential,
        normal=candidate.normal,
        state="free",
        normal_direction=candidate.normal_direction,
        frame=candidate.frame,
        friction_factor=candidate.friction_factor,
        name=candidate.name,
    )
    return plain_contact(f"candidate {place}", contact)


@dataclass(frozen=True)
class PlainStep:
    """A step as the Rust part takes it."""

    name: str
    forces: list[tuple[int, str]]
    displacements: list[tuple[int, str]]
    endless: bool


def plain_step(place: int, step: Step, dofs: int) -> PlainStep:
    """The step with its values by degree of freedom, as text."""
    if not isinstance(step, Step):
        raise MceipError(f"step {place}: expected mceip.Step, got {step!r}")
    return PlainStep(
        name=str(step.name),
        forces=forces(f"step {place}: forces", step.forces, dofs),
        displacements=by_dof(f"step {place}: displacements", step.displacements),
        endless=bool(step.endless),
    )


def forces(name: str, load: Load, dofs: int) -> list[tuple[int, str]]:
    """The forces that are given: of a mapping all, of a list those that are not zero."""
    if isinstance(load, Mapping):
        return by_dof(name, load)
    numbers = np.asarray(load, dtype=object)
    if numbers.shape != (dofs,):
        shape = numbers.shape
        raise MceipError(f"{name}: expected {dofs} numbers or a mapping, got shape {shape}")
    given = enumerate(numbers.tolist())
    return [(dof, spelt(value, f"{name}: {dof}")) for dof, value in given if value != 0]


def by_dof(name: str, given: Mapping[int, Number]) -> list[tuple[int, str]]:
    """Values by degree of freedom."""
    if not isinstance(given, Mapping):
        raise MceipError(f"{name}: expected a mapping from degrees of freedom, got {given!r}")
    return [(count(name, dof), spelt(value, f"{name}: {dof}")) for dof, value in given.items()]
