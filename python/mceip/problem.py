"""Problems, and the questions that can be put to them."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor, as_completed
from fractions import Fraction
from typing import Any

from ._native import MceipError, NativeProblem
from .answers import (
    Analysis,
    Certificate,
    Certified,
    Found,
    SolutionSet,
    Statement,
    analysis_of,
    certified_of,
    found_of,
    solution_set_of,
    statement_of,
    two_lines,
)
from .exact import short_text
from .inputs import (
    Contacts,
    Number,
    Triplets,
    contacts_or_table,
    count,
    counts,
    reals,
    spelt,
    text_of_file,
    triplets,
)
from .progress import Progress, listening

#: Threads at most: each is one of the operating system.
MOST_THREADS = 1024

#: Parts of a search at most.
MOST_PARTS = 10_000


class ModelWarning(UserWarning):
    """What looks wrong in K, M or the contacts of a model, such as matrices that are exchanged.

    No answer depends on it. `mceip convert` warns of the same.
    """


class Problem:
    """A mixed complementarity eigenproblem: find t and x != 0 with

        (A + t B) x = y,   y_f = 0,   0 <= x_s  _|_  y_s >= 0

    t is lambda^2, the square of a growth rate, or mu, the friction coefficient at which a
    quasi-static motion begins, or an eigenvalue of either sign (`Problem.eicp`; `Problem.qeicp`
    has t^2 as well). A and B come from a mechanical system or are given.

    `solve`, `complete` and `analyze` leave the interpreter to other threads, and end with
    `KeyboardInterrupt` on Ctrl-C. They take `progress`: a function of a line of text, the steps
    done, and the steps in all (or None); or True for a bar of tqdm.
    """

    # A problem is fixed when it is made: there is nothing else to assign.
    __slots__ = ("_native",)

    def __init__(self, native: NativeProblem) -> None:
        self._native = native

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Problem:
        """A problem file (`mceip-problem/1`). Warnings in it are repeated as `ModelWarning`."""
        native = NativeProblem.read(os.fspath(path))
        warn_of(native.warnings())
        return cls(native)

    @classmethod
    def from_json(cls, text: str | Mapping[str, Any]) -> Problem:
        """A problem file as text, or as the JSON object that it holds, such as `Proof.problem`. Its
        numbers may have any number of digits."""
        spelt_out = text if isinstance(text, str) else json_of("text", text)
        return cls(NativeProblem.from_json(spelt_out))

    @classmethod
    def from_matrices(
        cls,
        stiffness: Any,
        mass: Any,
        friction: Number,
        contacts: Contacts,
        *,
        stiffness_radius: Any = None,
        mass_radius: Any = None,
        accept_warnings: bool = False,
    ) -> Problem:
        """Growth rates of a mechanical system with N degrees of freedom, (12)-(14).

        What looks wrong in the model is said as `ModelWarning`, and kept in `warnings`.

        Args:
            stiffness: K, N x N, symmetric to the last bit (use `(K + K.T) / 2`), of numpy or
                scipy.sparse. Prescribed degrees of freedom are left out.
            mass: M, of the same kind. lambda^2 comes in the units of stiffness / mass.
            friction: the coefficient mu.
            contacts: a list of `Contact`; or a table with the columns `tangential`, `normal`,
                `state`, and optionally `particle`, `normal_direction`, `angle`, `normal_x`,
                `normal_y`, `friction_factor`, `reaction_tangential`, `reaction_normal`, `curvature`
                (spec/tutorial.md): a path to a CSV file, a pandas DataFrame, a mapping of columns,
                or a list of rows as mappings. Reactions are held against (7).
            stiffness_radius: R_K, N x N, symmetric, >= 0: how far each entry of K may be off, such
                as `0.001 * abs(K)`. With it, or a `friction_factor_range` of a contact, the problem
                is that of every body within (spec/robust.md), for `analyze` alone.
            mass_radius: the same of M.
            accept_warnings: neither says nor keeps what looks wrong.
        """
        dofs, k = triplets("stiffness", stiffness)
        _, m = triplets("mass", mass, dofs)
        given = contacts_or_table(contacts)
        radii = (
            radius_triplets("stiffness_radius", stiffness_radius, dofs),
            radius_triplets("mass_radius", mass_radius, dofs),
        )
        native = NativeProblem.lambda2(dofs, k, m, spelt(friction, "friction"), given, radii)
        if accept_warnings:
            return cls(native.without_warnings())
        warn_of(native.warnings())
        return cls(native)

    @classmethod
    def friction_threshold(
        cls, stiffness: Any, contacts: Contacts, *, accept_warnings: bool = False
    ) -> Problem:
        """Friction coefficients at which a quasi-static motion begins, (21)-(23).

        The arguments are as in `from_matrices`; a table has no reactions here.
        """
        dofs, k = triplets("stiffness", stiffness)
        native = NativeProblem.friction_threshold(dofs, k, contacts_or_table(contacts))
        if accept_warnings:
            return cls(native.without_warnings())
        warn_of(native.warnings())
        return cls(native)

    @classmethod
    def from_pencil(
        cls, a: Any, b: Any, free: Sequence[int] = (), unknown: str = "lambda2"
    ) -> Problem:
        """The problem of a pencil A + t B.

        Args:
            a: A, n x n.
            b: B, n x n.
            free: indices with y = 0 and x of any sign.
            unknown: "lambda2" or "mu": whether the solver relies on the conditions of
                Proposition 1 or of Proposition 2; or "eigenvalue": t of either sign, no free
                variables.
        """
        order, a_entries = triplets("a", a)
        _, b_entries = triplets("b", b, order)
        return cls(NativeProblem.pencil(order, a_entries, b_entries, counts("free", free), unknown))

    @classmethod
    def eicp(cls, a: Any, b: Any) -> Problem:
        """The eigenvalue complementarity problem: all t of either sign and x != 0 with

            0 <= x  _|_  (t B - A) x >= 0

        ("Pareto eigenvalues", where B is the identity). Those of the other convention,
        0 <= x  _|_  (A - t B) x >= 0, are those of -A and -B. As a pencil it is (-A, B).

        Args:
            a: A, n x n, of numpy or scipy.sparse.
            b: B, n x n.
        """
        order, a_entries = triplets("a", a)
        _, b_entries = triplets("b", b, order)
        rows, columns, values = a_entries
        minus_a = (rows, columns, [-value for value in values])
        return cls(NativeProblem.pencil(order, minus_a, b_entries, [], "eigenvalue"))

    @classmethod
    def qeicp(cls, a: Any, b: Any, c: Any) -> Problem:
        """The quadratic eigenvalue complementarity problem: all t of either sign and x != 0 with

            0 <= x  _|_  (t^2 A + t B + C) x >= 0

        Args:
            a: A, n x n, of numpy or scipy.sparse: the coefficient of t^2.
            b: B, n x n.
            c: C, n x n.
        """
        order, a_entries = triplets("a", a)
        _, b_entries = triplets("b", b, order)
        _, c_entries = triplets("c", c, order)
        return cls(NativeProblem.qeicp(order, a_entries, b_entries, c_entries))

    def in_window(self, min: Number | None = None, max: Number | None = None) -> Problem:
        """The same problem with the values sought in [min, max]; None is the lowest value that the
        unknown can have (0, for eigenvalues -infinity), and infinity."""
        lower = None if min is None else spelt(min)
        upper = None if max is None else spelt(max)
        return Problem(self._native.in_window(lower, upper))

    @property
    def unknown(self) -> str:
        """Which number is sought: "lambda2", "mu" or "eigenvalue"."""
        return self._native.unknown()

    @property
    def warnings(self) -> list[str]:
        """What looked wrong when the problem was made; its file and its analysis repeat it."""
        return self._native.warnings()

    @property
    def sha256(self) -> str:
        """The digest that certificates name, so that none is shown for another problem."""
        return self._native.sha256()

    def to_json(self) -> str:
        """The problem as the text of a file."""
        return self._native.to_json()

    def solve(
        self,
        *,
        starts: int = 22,
        seed: int = 1,
        all: bool = False,
        progress: Progress = None,
    ) -> Found:
        """Solutions by the PATH-style solver, each certified.

        Args:
            starts: starts of the solver.
            seed: of the random starts; one seed gives one result.
            all: looks above and below each value found, and along curves; slower.
            progress: see the class.
        """
        starts = count("starts", starts)
        seed = count("seed", seed)
        with listening(progress) as listener:
            answer = self._native.solve(starts, seed, bool(all), listener)
        return found_of(json.loads(answer))

    def complete(
        self,
        *,
        threads: int | None = None,
        resume: Certificate | None = None,
        executor: Executor | None = None,
        parts: int = 16,
        progress: Progress = None,
    ) -> SolutionSet:
        """All solutions in the window, with a proof that there are no others.

        With an executor of `concurrent.futures` (of processes, or that of a client of Dask) the
        search is cut into parts, each a task; `merge` joins their certificates. The certificate is
        the same for any number of workers.

        Args:
            threads: all cores if not said, with an executor one for each part; the certificate does
                not depend on it.
            resume: a certificate that leaves regions open; only these are searched.
            executor: searches the parts; none: this process does.
            parts: how many, with an executor.
            progress: see the class; with an executor the steps are parts.
        """
        if executor is not None:
            if not hasattr(executor, "submit"):
                raise MceipError(
                    "executor: expected one of concurrent.futures, such as ProcessPoolExecutor(), "
                    f"got {executor!r}"
                )
            if resume is not None:
                raise MceipError("resume: expected None with an executor, got a certificate")
            return self._complete_by(executor, count("parts", parts, 1, MOST_PARTS), threads, progress)
        earlier = None if resume is None else text_of(resume)
        with listening(progress) as listener:
            answer = self._native.complete(thread_count(threads), earlier, None, listener)
        return solution_set_of(json.loads(answer))

    def _complete_by(
        self, executor: Executor, parts: int, threads: int | None, progress: Progress
    ) -> SolutionSet:
        each = thread_count(1 if threads is None else threads)
        text = self.to_json()
        certificates = [""] * parts
        with listening(progress) as listener:
            places = {executor.submit(part_of, text, k, parts, each): k for k in range(parts)}
            try:
                for done, future in enumerate(as_completed(places), start=1):
                    certificates[places[future]] = future.result()
                    if listener is not None:
                        listener(f"{done} of {parts} parts searched", done, parts)
            except BaseException:
                for future in places:
                    future.cancel()
                raise
        return self.merge(certificates)

    def merge(self, certificates: Sequence[Certificate | str]) -> SolutionSet:
        """What the certificates of the parts of one search prove together.

        Raises `MceipError` where a part is missing or belongs to another search.
        """
        parts = [text_of(certificate) for certificate in certificates]
        return solution_set_of(json.loads(self._native.merge(parts)))

    def analyze(
        self,
        friction: Number | None = None,
        *,
        samples: int = 16,
        threads: int | None = None,
        progress: Progress = None,
    ) -> Analysis:
        """Can this equilibrium diverge in the form (8), from which friction on, and why?

        Args:
            friction: the coefficient asked for; the problem's own if not said.
            samples: coefficients at which divergence is decided, to find the ranges with it.
            threads: all cores if not said; the answer does not depend on it.
            progress: see the class.
        """
        mu = None if friction is None else spelt(friction, "friction")
        samples = count("samples", samples)
        with listening(progress) as listener:
            answer = self._native.analyze(mu, samples, thread_count(threads), listener)
        return analysis_of(json.loads(answer))

    def certify(self, value: float, x: Sequence[float]) -> Certified:
        """A proof that there is a solution near a point in floats.

        Raises `NotCertifiedError` where none is found, which is no proof that there is none.

        Args:
            value: lambda^2 or mu.
            x: over the variables of the pencil, in any positive scale.
        """
        (number,), components = reals("value", [value]), reals("x", x)
        return certified_of(json.loads(self._native.certify(number, components.tolist())))

    def check(self, certificate: Certificate | str | os.PathLike[str]) -> Statement:
        """What a certificate proves, of solutions, absence, presence or stability; raises
        `RejectedError` where it proves nothing. One of contact states under loads is for
        `LoadPath.check`.

        Args:
            certificate: a JSON object, its text, or a `pathlib.Path` to its file.
        """
        return statement_of(json.loads(self._native.check(text_of(certificate))))

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        # Pickled as its file, so that processes can be handed problems.
        return Problem.from_json, (self.to_json(),)

    def __repr__(self) -> str:
        friction = self._native.friction()
        at = "" if friction is None else f", mu = {short_text(Fraction(friction))}"
        sought = f"{self.unknown} in {self._native.window()}"
        return two_lines(
            f"Problem of {self._native.kind()}{at}; sought: {sought}",
            f"sha256 {self.sha256}",
        )


def part_of(problem: str, index: int, parts: int, threads: int | None) -> str:
    """The certificate of one part of a search, as text: what a worker of an executor does."""
    native = NativeProblem.from_json(problem)
    found = json.loads(native.complete(threads, None, (index, parts), None))
    return json.dumps(found["certificate"])


def check(problem: Problem, certificate: Certificate | str | os.PathLike[str]) -> Statement:
    """What a certificate proves of a problem; raises `RejectedError` where it proves nothing.

    Exact arithmetic decides. Whoever made the certificate, and however: an accepted one is a proof.
    """
    if not isinstance(problem, Problem):
        kind = type(problem).__name__
        raise MceipError(f"problem: expected mceip.Problem (Problem.read reads a file), got {kind}")
    return problem.check(certificate)


def radius_triplets(name: str, radius: Any, dofs: int) -> Triplets | None:
    """The entries of a radius, if one is given."""
    return None if radius is None else triplets(name, radius, dofs)[1]


def warn_of(sentences: Sequence[str]) -> None:
    """Says what looks wrong, at the line of the caller of a method of `Problem`."""
    for sentence in sentences:
        warnings.warn(sentence, ModelWarning, stacklevel=3)


def text_of(certificate: Certificate | str | os.PathLike[str]) -> str:
    """The text of a certificate."""
    if isinstance(certificate, os.PathLike):
        return text_of_file("certificate", certificate)
    if hasattr(certificate, "certificate"):
        kind = type(certificate).__name__
        raise MceipError(f"certificate: expected the `certificate` of a {kind}, got all of it")
    if isinstance(certificate, str):
        if not certificate.lstrip().startswith("{"):
            raise MceipError(
                "certificate: expected the text of a JSON object, or a pathlib.Path to its file, "
                f"got {certificate[:40]!r}"
            )
        return certificate
    return json_of("certificate", certificate)


def json_of(name: str, document: Any) -> str:
    """The text of a JSON object."""
    try:
        return json.dumps(document)
    except (TypeError, ValueError, RecursionError) as error:
        raise MceipError(f"{name}: expected a JSON object: {error}") from None


def thread_count(threads: int | None) -> int | None:
    """A number of threads that can be started."""
    return None if threads is None else count("threads", threads, least=1, most=MOST_THREADS)
