"""What users have, as the Rust part takes it: numbers, matrices and contacts.

Nothing is rounded on the way. A float is the binary fraction that it is; entries that a double
cannot hold are refused.
"""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from ._native import MceipError

#: A text is the number that it spells ("0.1" is 1/10), a float the binary fraction that it is.
Number = Union[str, int, float, Fraction]

#: Rows, columns and values of the entries of a matrix, counted from 0.
Triplets = tuple[list[int], list[int], list[float]]

#: Integers up to this size are doubles without rounding.
LARGEST_INTEGER = 2**53


@dataclass(frozen=True)
class Contact:
    """A particle that touches the obstacle, or may.

    Attributes:
        tangential: degree of freedom along the obstacle, a row of K, counted from 0.
        normal: degree of freedom normal to the obstacle.
        state: "slip+" is impending slip in the positive direction of the tangential degree of
            freedom, "slip-" in the negative one; "stick"; "free"; "zero" is contact without a
            reaction. "slip" is what problem files say: then `sign` is needed.
        sign: of the tangential reaction, 1 or -1: the opposite of the direction of slip.
        normal_direction: 1 where the normal degree of freedom is positive into the obstacle, -1
            where it is positive away from it.
        frame: of an oblique contact: the tangent and the normal, each over the two degrees of
            freedom. A rotation in doubles becomes the nearest simple rational one.
        friction_factor: the coefficient of friction of this particle over the common one, > 0.
        name: by which answers call it; without one it is called by its number.
        reaction_tangential: reaction of the obstacle on the body along the tangential degree of
            freedom, as a finite-element program gives it; it is held against (7).
        reaction_normal: the same along the normal degree of freedom; give both.
        friction_factor_range: between which numbers `friction_factor` is known to lie
            (spec/robust.md); none: it is exact.
        curvature: of the obstacle, 1 / R on a cylinder of radius R, positive where it is convex
            (spec/curvature.md). Where a particle slips, its reaction is needed beside it.
    """

    tangential: int
    normal: int
    state: str
    sign: int | None = None
    normal_direction: int = 1
    frame: Sequence[Sequence[Number]] | None = None
    friction_factor: Number = 1
    name: str | None = None
    reaction_tangential: Number | None = None
    reaction_normal: Number | None = None
    friction_factor_range: Sequence[Number] | None = None
    curvature: Number = 0


#: A list of `Contact`, or a table: a path to a CSV file, a pandas DataFrame, a mapping of columns,
#: or a list of rows as mappings.
Contacts = Union[
    Sequence[Contact], str, "os.PathLike[str]", Mapping[str, Any], Sequence[Mapping[str, Any]], Any
]


def spelt(number: Any, name: str | None = None) -> str:
    """A number as text that spells it exactly; errors begin with its name."""
    which = "" if name is None else f"{name}: "
    if isinstance(number, str):
        if not number.isascii():
            raise MceipError(f"{which}expected a number, got text with other characters")
        return number
    if isinstance(number, np.generic):
        number = number.item()
    try:
        return str(Fraction(number))
    except (TypeError, ValueError, OverflowError):
        # Not a long integer itself: Python refuses to spell it.
        got = repr(number) if isinstance(number, float) else type(number).__name__
        raise MceipError(
            f"{which}expected a finite number of at most 4300 digits, got {got}"
        ) from None


def triplets(name: str, matrix: Any, order: int | None = None) -> tuple[int, Triplets]:
    """The order n of an n x n matrix, and its entries. `order` is what n has to be, if known.

    Entries of a sparse matrix at one place are added, exactly.
    """
    if hasattr(matrix, "tocoo"):
        sparse = matrix.tocoo()
        shape = tuple(sparse.shape)
        require_square(name, shape, order)
        rows, columns = sparse.row, sparse.col
        values = np.asarray(sparse.data)
    else:
        dense = as_array(name, matrix)
        shape = dense.shape
        require_square(name, shape, order)
        rows, columns = dense.nonzero()
        values = dense[rows, columns]

    return shape[0], (rows.tolist(), columns.tolist(), doubles(name, values))


def as_array(name: str, matrix: Any) -> npt.NDArray[Any]:
    """A dense matrix as an array."""
    if np.ma.is_masked(matrix):
        raise MceipError(f"{name}: expected a matrix without masked entries")
    try:
        return np.asarray(matrix)
    except ValueError:
        raise MceipError(f"{name}: expected rows of one length") from None


def require_square(name: str, shape: tuple[int, ...], order: int | None) -> None:
    """Refuses a shape that is not n x n with this order."""
    expected = "n x n" if order is None else f"{order} x {order}"
    is_square = len(shape) == 2 and shape[0] == shape[1]
    if not is_square or order not in (None, shape[0]):
        is_list = len(shape) == 1
        remedy = " (scipy.sparse.diags makes a diagonal matrix of a list)" if is_list else ""
        raise MceipError(f"{name}: expected a matrix of shape {expected}, got {shape}{remedy}")


def doubles(name: str, values: npt.NDArray[Any]) -> list[float]:
    """Entries as doubles. Those that would be rounded are refused."""
    if values.size == 0:
        return []
    if values.dtype.kind not in "biuf":
        raise MceipError(f"{name}: expected real numbers, got entries of type {values.dtype}")

    if values.dtype.kind in "iu":
        is_rounded = bool(np.any((values > LARGEST_INTEGER) | (values < -LARGEST_INTEGER)))
    else:
        rounded = values.astype(np.float64).astype(values.dtype)
        is_rounded = bool(np.any((rounded != values) & np.isfinite(values)))
    if is_rounded:
        raise MceipError(
            f"{name}: expected entries that are doubles, got {values.dtype} with more digits "
            "(exact numbers can be given as text: Problem.from_json)"
        )

    converted: list[float] = values.astype(np.float64).tolist()
    return converted


def contacts_or_table(contacts: Contacts) -> list[Contact] | str:
    """Contacts as the Rust part takes them: a list, or the text of a table."""
    if isinstance(contacts, (str, os.PathLike)):
        return text_of_file("contacts", contacts)
    if hasattr(contacts, "to_dict"):
        return table_of_columns(contacts.to_dict(orient="list"))
    if isinstance(contacts, Mapping):
        return table_of_columns(contacts)

    if not isinstance(contacts, Iterable):
        raise MceipError(f"contacts: expected a list of mceip.Contact or a table, got {contacts!r}")

    entries = list(contacts)
    if entries and all(isinstance(entry, Mapping) for entry in entries):
        names = list(dict.fromkeys(name for entry in entries for name in entry))
        return table(names, [[entry.get(name) for name in names] for entry in entries])
    for place, entry in enumerate(entries):
        if not isinstance(entry, Contact):
            raise MceipError(
                f"contacts: expected a list of mceip.Contact or a table, got {entry!r} at {place}"
            )
    return [plain_contact(f"contact {place}", entry) for place, entry in enumerate(entries)]


def text_of_file(name: str, path: str | os.PathLike[str]) -> str:
    """What a file holds."""
    try:
        with open(path, encoding="utf-8") as file:
            return file.read()
    except (OSError, UnicodeDecodeError) as error:
        raise MceipError(f"{name}: {os.fspath(path)}: {error}") from None


def table_of_columns(columns: Mapping[str, Any]) -> str:
    """A table by its columns. A column of one value stands for that value in each row."""
    lists: dict[str, list[Any]] = {}
    for name, cells in columns.items():
        is_single = isinstance(cells, str) or np.ndim(cells) == 0
        lists[name] = [cells] if is_single else list(cells)

    height = max((len(cells) for cells in lists.values()), default=0)
    for name, cells in lists.items():
        if len(cells) == 1:
            lists[name] = cells * height
        elif len(cells) != height:
            raise MceipError(f"contacts: expected {height} cells in {name}, got {len(cells)}")

    names = list(lists)
    return table(names, [[lists[name][row] for name in names] for row in range(height)])


def table(names: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """The text of a table with these columns."""
    lines = [",".join(str(name) for name in names)]
    lines.extend(",".join(cell(value) for value in row) for row in rows)
    return "\n".join(lines) + "\n"


def cell(value: Any) -> str:
    """The text of a cell; empty for None and NaN."""
    if value is None or value != value:
        return ""
    if not isinstance(value, str):
        return spelt(value)
    if "," in value or "\n" in value:
        raise MceipError(f"contacts: expected cells without commas and line ends, got {value!r}")
    return value


def plain_contact(name: str, contact: Contact) -> Contact:
    """The same contact in plain integers and text."""
    if not isinstance(contact.state, str):
        raise MceipError(f"{name}: expected a state, got {contact.state!r}")
    for sign in (contact.sign, contact.normal_direction):
        if sign not in (1, -1, None):
            raise MceipError(f"{name}: expected sign and normal_direction 1 or -1, got {sign!r}")

    along_dofs = [
        None if component is None else spelt(component, f"{name}: {which}")
        for which, component in (
            ("reaction_tangential", contact.reaction_tangential),
            ("reaction_normal", contact.reaction_normal),
        )
    ]
    return Contact(
        tangential=count(f"{name}: tangential", contact.tangential),
        normal=count(f"{name}: normal", contact.normal),
        state=contact.state,
        sign=None if contact.sign is None else int(contact.sign),
        normal_direction=int(contact.normal_direction),
        frame=None if contact.frame is None else spelt_frame(name, contact.frame),
        friction_factor=spelt(contact.friction_factor, f"{name}: friction_factor"),
        name=None if contact.name is None else str(contact.name),
        reaction_tangential=along_dofs[0],
        reaction_normal=along_dofs[1],
        friction_factor_range=spelt_range(name, contact.friction_factor_range),
        curvature=spelt(contact.curvature, f"{name}: curvature"),
    )


def spelt_range(name: str, ends: Sequence[Number] | None) -> list[str] | None:
    """The ends of an interval as text."""
    if ends is None:
        return None
    name = f"{name}: friction_factor_range"
    if isinstance(ends, str) or not isinstance(ends, Iterable) or len(list(ends)) != 2:
        raise MceipError(f"{name}: expected two numbers, got {ends!r}")
    return [spelt(end, name) for end in ends]


def spelt_frame(name: str, frame: Sequence[Sequence[Number]]) -> list[list[str]]:
    """A frame with its numbers as text."""
    try:
        rows = [[spelt(entry) for entry in row] for row in frame]
    except TypeError:
        rows = []
    if [len(row) for row in rows] != [2, 2]:
        raise MceipError(f"{name}: expected a frame of 2 x 2 numbers, got {frame!r}")
    return rows


def reals(name: str, values: Any) -> npt.NDArray[np.float64]:
    """One number or some, as a list of doubles; text and complex numbers are refused."""
    try:
        array = np.atleast_1d(np.asarray(values))
        require_reals(name, array)
        if any(entry is None for entry in array.flat):
            raise MceipError(f"{name}: expected numbers, got None")
        array = array.astype(np.float64)
    except (TypeError, ValueError) as error:
        if isinstance(error, MceipError):
            raise
        raise MceipError(f"{name}: expected numbers: {error}") from None
    if array.ndim != 1:
        raise MceipError(f"{name}: expected a list of numbers, got an array of shape {array.shape}")
    return array


def require_reals(name: str, values: npt.NDArray[Any]) -> None:
    """Refuses entries that are text or complex."""
    if values.dtype.kind not in "biufO":
        raise MceipError(f"{name}: expected real numbers, got entries of type {values.dtype}")


def counts(name: str, values: Any) -> list[int]:
    """A list of integers >= 0."""
    if not isinstance(values, Iterable):
        raise MceipError(f"{name}: expected a list of integers, got {values!r}")
    return [count(name, value) for value in values]


def count(name: str, value: Any, least: int = 0, most: int = 2**63 - 1) -> int:
    """An integer from `least` to `most`; True and False are none."""
    if isinstance(value, bool):
        raise MceipError(f"{name}: expected an integer, got {value!r}")
    try:
        number = operator.index(value)
    except TypeError:
        raise MceipError(f"{name}: expected an integer, got {value!r}") from None
    if not least <= number <= most:
        raise MceipError(f"{name}: expected an integer from {least} to {most}, got {number}")
    return number
