"""How the bodies begin to move, for a page that plays it."""
import numpy as np

from .reading import magnification_of, motion_of


def add_mechanism(results, arrays, centre):
    """Returns what the page has to know of mechanism.vtu, or None where the run wrote none. The arrays are relative to the centre."""
    if results.modal or results.mechanism() is None:
        return None
    motion = motion_of(results)
    displacement = motion.grid.point_data["displacement"]
    arrays.add("mechanism_points", motion.grid.points - centre)
    arrays.add("mechanism_ux", displacement[:, 0])
    arrays.add("mechanism_uy", displacement[:, 1])
    arrays.add("mechanism_rings", np.concatenate(motion.cells) if motion.cells else [], "u4")
    arrays.add("mechanism_sizes", [len(cell) for cell in motion.cells], "u4")
    arrays.add("mechanism_sides", motion.outlines, "u4")
    arrays.add("mechanism_opens", motion.opens, "u4")
    arrays.add("mechanism_slips", motion.slips, "u4")
    return {"text": text_of(results), "length": motion.magnification}


def mechanism_of(results):
    """The same of a model in space, whose bodies have the motion at their nodes; None where the run wrote none."""
    grid = results.mechanism()
    return None if grid is None else {"text": text_of(results), "length": float(magnification_of(float(np.linalg.norm(np.ptp(grid.points, axis=0)))))}


def text_of(results):
    """Which bodies move, as a sentence."""
    text = results.summary.get("mechanism", {}).get("text", "")
    return text[:1].upper() + text[1:] + "." if text else ""
