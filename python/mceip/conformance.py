"""The conformance pack: problems with complete exact answers, read from a folder.

    >>> from mceip.conformance import read_pack
    >>> pack = read_pack("spec/conformance-pack")        # doctest: +SKIP
    >>> case = pack.case("fold-00")                # doctest: +SKIP
    >>> case.problem.solve()                             # doctest: +SKIP

`mceip conform --write FOLDER` writes such a folder. Here digests are compared and nothing else;
`mceip conform --pack FOLDER` finds or certifies every answer anew.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ._native import MceipError
from .problem import Problem

#: The formats of the index and of a group that are read.
INDEX_FORMAT = "mceip-pack-index/1"
GROUP_FORMAT = "mceip-pack/1"


@dataclass(frozen=True)
class WrongAnswer:
    """A report that must not be called correct."""

    #: The mistake in one word, and in a sentence.
    bug: str
    reason: str
    #: What the report must be called: "incomplete" or "wrong".
    label: str
    #: The report, `mceip-solutions/1`.
    report: dict[str, Any]


@dataclass(frozen=True)
class Case:
    """A problem with its answer."""

    id: str
    comment: str
    #: What the case is about; the index says what each flag means.
    flags: tuple[str, ...]
    #: The problem as it stands in the file, `mceip-problem/1`.
    problem_json: dict[str, Any]
    #: Every solution, `mceip-solutions/1`: `solutions`, `cones`, `continua`.
    answer: dict[str, Any]
    wrong: tuple[WrongAnswer, ...]
    #: What is known of the answer: "exact" (complete, by enumeration), "proved" (complete, by a
    #: certificate) or "best_known" (each solution is certified, there may be others).
    completeness: str = "exact"
    #: "easy", "medium" or "hard", as measured; `None` where it has not been.
    difficulty: str | None = None
    #: SHA-256 of the certificate of a proved answer, as it was when the case was written.
    certificate_sha256: str | None = None

    @property
    def problem(self) -> Problem:
        """The problem, to be solved."""
        return Problem.from_json(json.dumps(self.problem_json))


@dataclass(frozen=True)
class Pack:
    """The cases of a folder, in its order."""

    cases: tuple[Case, ...]
    #: What each flag is about.
    flags: dict[str, str]
    #: Version of the cases; empty for a pack that has none.
    version: str = ""
    #: 1 for the small cases, 2 for those of order 10 to 200.
    tier: int = 1

    def case(self, id: str) -> Case:
        """The case with this id; `KeyError` if there is none."""
        for case in self.cases:
            if case.id == id:
                return case
        raise KeyError(id)

    def with_flag(self, flag: str) -> tuple[Case, ...]:
        """The cases with this flag; `KeyError` for a flag that the pack does not know."""
        if flag not in self.flags:
            raise KeyError(flag)
        return tuple(case for case in self.cases if flag in case.flags)


def read_pack(folder: str | os.PathLike[str]) -> Pack:
    """Reads a pack by its `index.json`.

    `MceipError` for another format, missing fields, or a group that differs from its digest in the
    index; `OSError` for a file that cannot be read.
    """
    try:
        return _read(Path(folder))
    except (AttributeError, KeyError, TypeError) as error:
        text = f"{type(error).__name__}: {error}"
        raise MceipError(f"expected the fields of a pack, got {text}") from None


def _read(place: Path) -> Pack:
    index = _json_of("index.json", (place / "index.json").read_bytes(), INDEX_FORMAT)

    cases: list[Case] = []
    for entry in index["groups"]:
        name = str(entry["file"])
        if name in ("", "..") or Path(name).name != name:
            raise MceipError(f"index.json: expected the name of a file beside it, got {name!r}")

        content = (place / name).read_bytes()
        digest = hashlib.sha256(content).hexdigest()
        if digest != entry["sha256"]:
            raise MceipError(f"{name}: expected the digest {entry['sha256']}, got {digest}")

        group = _json_of(name, content, GROUP_FORMAT)
        cases.extend(_case_of(raw) for raw in group["cases"])

    notes = {word: str(flag["note"]) for word, flag in index["flags"].items()}
    version, tier = str(index.get("version", "")), int(index.get("tier", 1))
    return Pack(cases=tuple(cases), flags=notes, version=version, tier=tier)


def _json_of(name: str, content: bytes, expected: str) -> dict[str, Any]:
    try:
        value = json.loads(content)
    except ValueError as error:
        raise MceipError(f"{name}: expected JSON, got {error}") from None

    got = value.get("format") if isinstance(value, dict) else None
    if not isinstance(value, dict) or got != expected:
        raise MceipError(f"{name}: expected the format {expected!r}, got {got!r}")
    return value


def _case_of(raw: dict[str, Any]) -> Case:
    wrong = tuple(
        WrongAnswer(
            bug=answer["bug"],
            reason=answer["reason"],
            label=answer["label"],
            report=answer["report"],
        )
        for answer in raw["wrong"]
    )
    return Case(
        id=raw["id"],
        comment=raw["comment"],
        flags=tuple(raw["flags"]),
        problem_json=raw["problem"],
        answer=raw["answer"],
        wrong=wrong,
        completeness=raw.get("completeness", "exact"),
        difficulty=raw.get("difficulty"),
        certificate_sha256=raw.get("certificate_sha256"),
    )
