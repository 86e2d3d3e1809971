"""Where the nodes of a body are: for the directions of its contacts, and for pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ._native import MceipError
from .drawing import Array, coordinates, edges_of, require_points
from .inputs import spelt

#: Places, degrees of freedom (None where there is none) and edges, as the Rust part takes them.
PlainMesh = tuple[list[tuple[str, str]], list[tuple[Any, Any]], list[tuple[int, int]]]


@dataclass(frozen=True, eq=False)
class Mesh:
    """The nodes of a plane body. With scikit-fem: `Mesh(mesh.p.T, basis.nodal_dofs.T, mesh.t.T)`.

    Attributes:
        points: n x 2, x to the right and y up.
        dofs: n x 2, the degrees of freedom along x and y of each point, counted from 0; -1 where
            there is none.
        cells: m x k, the points around each cell in order; without cells nothing is said of
            tangents that are turned, or of normals that point into the body.
    """

    points: Any
    dofs: Any
    cells: Any = field(default=())

    def displacement(self, v: Any) -> Array:
        """n x 2: a vector over the degrees of freedom, such as `Mode.v`, point by point."""
        values = np.asarray(v, dtype=np.float64)
        dofs = self._dofs()
        if values.ndim != 1 or dofs.max(initial=-1) >= len(values):
            raise MceipError(
                f"displacement: expected one number for each degree of freedom, got shape "
                f"{values.shape}"
            )
        return np.where(dofs < 0, 0.0, np.append(values, 0.0)[dofs])

    def _dofs(self) -> npt.NDArray[np.int64]:
        dofs = np.asarray(self.dofs)
        points = coordinates("points", self.points)
        if dofs.shape != points.shape or dofs.dtype.kind not in "iu":
            raise MceipError(
                f"dofs: expected integers of the shape of points, {points.shape}, got shape "
                f"{dofs.shape} of {dofs.dtype}"
            )
        return dofs.astype(np.int64)

    def _plain(self) -> PlainMesh:
        points = coordinates("points", self.points)
        dofs = [
            (None if along_x < 0 else along_x, None if along_y < 0 else along_y)
            for along_x, along_y in self._dofs().tolist()
        ]
        edges: Sequence[tuple[int, int]] = []
        cells = np.asarray(self.cells)
        if cells.size > 0:
            if cells.ndim != 2:
                raise MceipError(f"cells: expected the shape m x k, got {cells.shape}")
            require_points("cells", cells, len(points))
            edges = edges_of(cells)
        return [(spelt(x), spelt(y)) for x, y in points.tolist()], dofs, list(edges)
