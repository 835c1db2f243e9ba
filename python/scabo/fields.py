"""Fields of all bodies, and their hand-over to meshio and PyVista."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import meshio
    import pyvista

__all__ = ["Fields"]

_OF_CELLS = ("points", "connectivity", "offsets", "types", "cell_body")
_NAMES = {5: "triangle", 7: "polygon", 9: "quad", 10: "tetra", 22: "triangle6", 23: "quad8", 24: "tetra10",
          25: "hexahedron20", 26: "wedge15"}  # of meshio, by VTK's numbers


@dataclass(frozen=True)
class Fields:
    """Points, cells and values of all bodies after an increment, as in fields.vtu (docs/results.md). Bodies that are absent
    are left out."""

    points: np.ndarray
    """(n, 3), of the undeformed shape; z = 0 in the plane."""
    connectivity: np.ndarray
    """Indices of the points of all cells, one cell after the other."""
    offsets: np.ndarray
    """Cells + 1: where each begins in ``connectivity``, and the end."""
    types: np.ndarray
    """Of the cells, numbers of VTK: 5 triangle, 7 polygon, 9 quadrilateral, 22 and 23 the quadratic ones; in space 10 and 24, the
    linear and the quadratic tetrahedron, 25 and 26, the quadratic hexahedron and wedge."""
    cell_body: np.ndarray
    """Body of every cell, from 1 in the order of the model."""
    values: dict[str, np.ndarray]
    """At the points: body, displacement (n, 3), stress (n, 6): xx, yy, zz, xy, yz, xz, principal_1 to principal_3, descending,
    principal_angle (from x, radians; in the plane), von_mises. Not a number where stress is infinite or, as in rigid bodies, unknown;
    in space it is 0 in rigid bodies."""

    @classmethod
    def of(cls, arrays: dict[str, np.ndarray]) -> Fields:
        """From all arrays by name."""
        return cls(*(arrays[name] for name in _OF_CELLS),
                   {name: array for name, array in arrays.items() if name not in _OF_CELLS})

    def cells(self) -> dict[tuple[int, int], np.ndarray]:
        """Indices of the cells of a type and a number of points, by both."""
        sizes = np.diff(self.offsets)
        kinds = sorted(set(zip(self.types.tolist(), sizes.tolist())))
        return {kind: np.flatnonzero((self.types == kind[0]) & (sizes == kind[1])) for kind in kinds}

    def to_meshio(self) -> meshio.Mesh:
        """A ``meshio.Mesh`` with a block of cells for each type; needs meshio (python3-meshio)."""
        try:
            import meshio
        except ImportError:
            raise ImportError("to_meshio() needs meshio (python3-meshio): install it") from None
        from meshio._mesh import topological_dimension
        topological_dimension.setdefault("wedge15", 3)  # which versions of meshio write and read, and have no dimension of
        blocks = self.cells()
        cells = [(_NAMES[kind], self.connectivity[self.offsets[of][:, None] + np.arange(size)])
                 for (kind, size), of in blocks.items()]
        return meshio.Mesh(self.points, cells, point_data=dict(self.values),
                           cell_data={"body": [self.cell_body[of] for of in blocks.values()]})

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """A ``pyvista.UnstructuredGrid``; needs PyVista."""
        try:
            import pyvista
        except ImportError:
            raise ImportError("to_pyvista() needs PyVista (pip install pyvista): install it") from None
        cells: Any = np.insert(self.connectivity, self.offsets[:-1], np.diff(self.offsets))
        grid = pyvista.UnstructuredGrid(cells, self.types, self.points)
        grid.cell_data["body"] = self.cell_body
        for name, array in self.values.items():
            grid.point_data[name] = array
        return grid
