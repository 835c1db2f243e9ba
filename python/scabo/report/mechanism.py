"""How the bodies begin to move, for a page that plays it."""
import numpy as np

from .reading import motion_of


def add_mechanism(results, arrays, centre):
    """Returns what the page has to know of mechanism.vtu, or None where the run wrote none. The arrays are relative to the centre."""
    if results.modal or results.in_space or results.mechanism() is None:
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
    text = results.summary.get("mechanism", {}).get("text", "")
    return {"text": text[:1].upper() + text[1:] + "." if text else "", "length": motion.magnification}
