"""Pictures of a results directory of Scabo: NumPy and Matplotlib only, without the compiled module.

    import scabo_plot                       # from share/scabo of an installation; scabo.plot where the module is installed
    results = scabo_plot.Results("model.results")
    figure = scabo_plot.stress(results, component="principal_1")
    figure.savefig("stress.pdf")

`stress`, `mesh`, `contact`, `convergence`, `history`, `lines`, `cracks`, `mechanism`, `envelope`, `spectrum` and, of a sweep's directory, `sweep` each return a Matplotlib figure; `solid_stress`, `solid_contact` and `solid_mechanism` those of a model in space.
What they draw comes from functions that return arrays (geometry.py, contacts.py, curves.py); colours, marks and fonts from style.py. The folder is a program too:
`python3 .../scabo/plot DIR` does what `scabo plot DIR` does. Matplotlib is imported with the first of these functions:
reports read the files with this package and need only NumPy.
"""
import importlib
from typing import TYPE_CHECKING

from .results import Results, ResultsError
from .units import Units

if TYPE_CHECKING:
    from .contacts import contact
    from .crack_paths import cracks
    from .curves import convergence, history
    from .fields import stress
    from .in_time import envelope, spectrum
    from .mechanisms import mechanism
    from .paths import lines
    from .meshes import mesh
    from .solids import contact as solid_contact
    from .solids import mechanism as solid_mechanism
    from .solids import stress as solid_stress
    from .sweeps import sweep

__all__ = ["Results", "ResultsError", "Units", "contact", "convergence", "cracks", "envelope", "history", "lines", "mechanism", "mesh", "solid_contact",
           "solid_mechanism", "solid_stress", "spectrum", "stress", "sweep"]

_DRAWN_BY = {"contact": "contacts", "convergence": "curves", "cracks": "crack_paths", "envelope": "in_time", "spectrum": "in_time", "history": "curves", "lines": "paths", "mechanism": "mechanisms", "mesh": "meshes",
             "stress": "fields", "sweep": "sweeps"}
_IN_SPACE = {"solid_contact": "contact", "solid_mechanism": "mechanism", "solid_stress": "stress"}


def __getattr__(name):
    if name in _IN_SPACE:
        return getattr(importlib.import_module(".solids", __name__), _IN_SPACE[name])
    if name not in _DRAWN_BY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module("." + _DRAWN_BY[name], __name__), name)


def __dir__():
    return sorted([*globals(), *_DRAWN_BY, *_IN_SPACE])
