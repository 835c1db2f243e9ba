"""How bodies begin to move where a run ended as a mechanism or collapse, or beyond a limit, as arrays: for pictures and reports."""
import dataclasses

import numpy as np

from . import geometry, vtu
from .results import NothingToDraw

AT_REST = 1e-4  # of the largest displacement, as in summary.json
PART = 0.06     # of the diagonal of the model, that the largest displacement is drawn as


@dataclasses.dataclass(frozen=True)
class Motion:
    """What the picture shows, in the units of the files; the largest displacement of the file is 1."""
    grid: vtu.Grid
    magnification: float
    points: np.ndarray    # n x 2, moved
    cells: list           # points of each cell of a body
    motion: np.ndarray    # one for each of them: largest displacement of its body
    rigid: np.ndarray     # one for each of them: whether its body is rigid
    outlines: np.ndarray  # sides of all bodies, S x 2
    slips: np.ndarray     # pieces of contacts that slip and do not open, P x 2
    opens: np.ndarray     # pieces that open, whether they slip or not


def motion_of(results, magnification=None):
    """Raises ResultsError where the results have no such thing."""
    grid = needed_mechanism(results)
    size = geometry.extent(grid.points[grid.point_data["pair"] == 0])
    if magnification is None:
        magnification = magnification_of(size)
    is_body = grid.cell_data["body"] > 0
    starts, kinds = grid.starts(), grid.types
    cells = [grid.connectivity[start:end] for start, end, kind, body in zip(starts, grid.offsets, kinds, is_body) if
             body and kind == vtu.POLYGON]
    sides = [np.column_stack([cell, np.roll(cell, -1)]) for cell in cells]
    distinct, times = geometry.distinct_sides(np.concatenate(sides) if sides else np.zeros((0, 2), dtype=int))
    lines, of_body = grid.cells(vtu.LINE)[:, :2], is_body[kinds == vtu.LINE]
    joints = lines[~of_body]
    opening, slip = (np.abs(grid.point_data[name]) for name in ("opening", "slip"))
    opens, slides = ((values > AT_REST)[joints].any(axis=1) for values in (opening, slip))
    is_cell = is_body & (kinds == vtu.POLYGON)
    rigid = np.array([body["rigid"] for body in results.summary["model"]["bodies"]], dtype=bool)
    return Motion(grid, magnification, geometry.moved(grid, magnification), cells, grid.cell_data["motion"][is_cell],
                  rigid[grid.cell_data["body"][is_cell] - 1], np.concatenate([distinct[times == 1], lines[of_body]]),
                  joints[slides & ~opens], joints[opens])


def needed_mechanism(results):
    """The grid of mechanism.vtu; raises ResultsError where there is none."""
    grid = results.mechanism()
    if grid is None:
        raise NothingToDraw(f"{results.directory}: has no mechanism.vtu, as only a run has that ends as a mechanism or collapse (status: "
                            f"{results.summary['status']})")
    return grid


def magnification_of(size):
    """1, 2 or 5 times a power of ten, by which a displacement of 1 is drawn as `PART` of the size or less."""
    power = 10.0 ** np.floor(np.log10(PART * size))
    return max(step * power for step in (1, 2, 5) if step * power <= PART * size * (1 + 1e-9))
