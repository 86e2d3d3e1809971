"""A mode on its mesh, as SVG that a notebook shows, and in axes of matplotlib."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._native import MceipError
from .answers import counted, two_lines

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = npt.NDArray[np.float64]

#: Longer side of the mesh on paper, px.
SIZE = 640.0

#: Radius of the mark of a contact, px.
RADIUS = 6.0

#: Space for the title above the mesh, px.
HEADING = 40.0


@dataclass(frozen=True, eq=False)
class Drawing:
    """A mesh at rest and displaced.

    Attributes:
        svg: the text of an SVG file.
        rest: n x 2, the points at rest.
        displaced: n x 2, the same points displaced, enlarged as in the picture.
        edges: pairs of points.
        contacts: points of the contacts.
        slipping: places in `contacts` of those that slip.
        title: of the picture.
    """

    svg: str = field(repr=False)
    rest: Array = field(repr=False)
    displaced: Array = field(repr=False)
    edges: list[tuple[int, int]] = field(repr=False)
    contacts: list[int]
    slipping: list[int]
    title: str

    def __repr__(self) -> str:
        shown = f"Drawing {self.title!r} of {counted(len(self.rest), 'point')}"
        return two_lines(
            shown, f"{counted(len(self.contacts), 'contact')}, {len(self.slipping)} slipping"
        )

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the SVG file."""
        if os.path.splitext(path)[1].lower() != ".svg":
            raise MceipError(
                f"path: expected a name that ends in .svg, got {os.fspath(path)!r} (other formats: "
                "plot().figure.savefig)"
            )
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.svg)

    def plot(self, ax: Axes | None = None) -> Axes:
        """The same in axes of matplotlib; new ones if none are given."""
        from .plotting import plot_drawing

        return plot_drawing(self, ax)


def draw_mode(
    points: Any,
    cells: Any,
    displacement: Any,
    *,
    contacts: Sequence[int] = (),
    slipping: Sequence[int] = (),
    title: str = "",
    amplitude: float = 0.1,
) -> Drawing:
    """The mesh at rest (dashed) and displaced, with a mark on each contact.

    A mode has no size of its own: it is drawn with the largest displacement `amplitude` times the
    longer side of the mesh.

    Args:
        points: n x 2, x to the right and y up.
        cells: m x k, the points around each cell in order: triangles or quadrilaterals.
        displacement: n x 2, in the same directions.
        contacts: points of the contacts, in the order in which `Problem` has got them.
        slipping: places in `contacts` of those that slip (`Mode.slipping`): filled circles;
            the others are hollow.
        title: a line above.
        amplitude: the largest displacement drawn.
    """
    rest = coordinates("points", points)
    moved = coordinates("displacement", displacement)
    if rest.shape != moved.shape:
        raise MceipError(
            f"displacement: expected the shape of points, {rest.shape}, got {moved.shape}"
        )
    corners = np.asarray(cells)
    if corners.ndim != 2:
        raise MceipError(f"cells: expected the shape m x k, got {corners.shape}")
    require_points("cells", corners, len(rest))
    require_points("contacts", np.asarray(contacts, dtype=np.int64), len(rest))

    lower = rest.min(axis=0)
    extent = rest.max(axis=0) - lower
    longer_side = float(extent.max())
    largest = float(np.hypot(moved[:, 0], moved[:, 1]).max())
    factor = amplitude * longer_side / largest if largest > 0 else 0.0

    # From lengths of the mesh to px: x to the right, y down.
    unit = SIZE / longer_side if longer_side > 0 else 1.0
    margin = HEADING + amplitude * SIZE + RADIUS
    width = float(extent[0]) * unit + 2 * margin
    height = float(extent[1]) * unit + 2 * margin
    origin = np.array([margin, height - margin])
    scale = np.array([unit, -unit])
    on_paper = origin + scale * (rest - lower)
    enlarged = rest + factor * moved
    displaced = origin + scale * (enlarged - lower)

    edges = edges_of(corners)
    marks = marks_of(displaced, contacts, set(slipping))
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
        f'viewBox="0 0 {width:.1f} {height:.1f}" role="img" font-family="sans-serif">'
        f"<title>{escape(title)}</title>"
        f'<rect width="{width:.1f}" height="{height:.1f}" fill="#fff"/>'
        f'<text x="{margin:.0f}" y="28" font-size="14">{escape(title)}</text>'
        f'<path d="{lines(on_paper, edges)}" fill="none" stroke="#999" stroke-width="0.6" '
        'stroke-dasharray="4 4"/>'
        f'<path d="{lines(displaced, edges)}" fill="none" stroke="#222" stroke-width="0.9"/>'
        f"{marks}</svg>\n"
    )
    return Drawing(svg, rest, enlarged, edges, list(contacts), list(slipping), title)


def coordinates(name: str, values: Any) -> Array:
    """n x 2 finite numbers."""
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 2 or array.shape[0] == 0:
        raise MceipError(f"{name}: expected the shape n x 2, got {array.shape}")
    if not np.isfinite(array).all():
        raise MceipError(f"{name}: expected finite numbers")
    return array


def require_points(name: str, indices: npt.NDArray[Any], count: int) -> None:
    """Refuses what is no index of a point."""
    is_index = indices.dtype.kind in "iu" and np.all((indices >= 0) & (indices < count))
    if not is_index:
        raise MceipError(f"{name}: expected indices of points, 0 to {count - 1}")


def edges_of(cells: npt.NDArray[Any]) -> list[tuple[int, int]]:
    """Each edge of the cells once."""
    edges: set[tuple[int, int]] = set()
    for cell in cells.tolist():
        for start, end in zip(cell, cell[1:] + cell[:1]):
            edges.add((min(start, end), max(start, end)))
    return sorted(edges)


def lines(points: Array, edges: Sequence[tuple[int, int]]) -> str:
    """The edges as a path of SVG."""
    path = ""
    for start, end in edges:
        (x0, y0), (x1, y1) = points[start], points[end]
        path += f"M{x0:.1f} {y0:.1f}L{x1:.1f} {y1:.1f}"
    return path


def marks_of(points: Array, contacts: Sequence[int], slipping: set[int]) -> str:
    """A circle on each contact, filled where it slips."""
    marks = ""
    for place, point in enumerate(contacts):
        x, y = points[point]
        fill = "#000" if place in slipping else "#fff"
        marks += f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS}" fill="{fill}" stroke="#000"/>'
    return marks
