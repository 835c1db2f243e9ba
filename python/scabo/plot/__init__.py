"""Pictures of a results directory of Scabo: NumPy and Matplotlib only, without the compiled module.

    import scabo_plot                       # from share/scabo of an installation; scabo.plot where the module is installed
    results = scabo_plot.Results("model.results")
    figure = scabo_plot.stress(results, component="principal_1")
    figure.savefig("stress.pdf")

`stress`, `mesh`, `contact`, `convergence`, `history` and, of a sweep's directory, `sweep` each return a Matplotlib figure. What they draw comes from functions that
return arrays (geometry.py, contacts.py, curves.py); colours, marks and fonts from style.py. The folder is a program too:
`python3 .../scabo/plot DIR` does what `scabo plot DIR` does.
"""
from .contacts import contact
from .curves import convergence, history
from .fields import stress
from .meshes import mesh
from .results import Results, ResultsError
from .sweeps import sweep
from .units import Units

__all__ = ["Results", "ResultsError", "Units", "contact", "convergence", "history", "mesh", "stress", "sweep"]
