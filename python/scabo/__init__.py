"""Scabo computes frictional contact between elastic bodies by the scaled boundary finite element method.

>>> import scabo
>>> result = scabo.read("model.yaml").run()
>>> result.contact["joint"].table()["pressure"]

A model is a dictionary with the content of a model file (docs/model_file.md), read from one or built in Python; both are
checked alike, with the same messages. Results are NumPy arrays that show the memory of the solver without a copy.
For researchers: ``SuperElement`` (stiffness, exponents and fields of one super-element) and ``solve_contact`` (a discrete
contact problem by itself). docs/python.md has the manual.
"""
try:
    from ._core import Progress
except ImportError as error:
    import pathlib
    import sysconfig

    made_for = ", ".join(sorted(path.name for path in pathlib.Path(__file__).parent.glob("_core.*.so")))
    wanted = "_core" + str(sysconfig.get_config_var("EXT_SUFFIX"))
    if not made_for or made_for == wanted:
        raise
    raise ImportError(f"scabo was built for another Python ({made_for}); this one needs {wanted}: build the package with it, "
                      "as by `make python PYTHON=...`") from error
from ._core import version as __version__
from .discrete import DiscreteSolution, solve_contact
from .errors import (Collapse, Error, Infeasible, InternalError, Interrupted, Mechanism, ModelError, ModelWarning,
                     NotConverged, Problem, WriteError)
from .fields import Fields
from .model import Model, Sizes, read, schema
from .modes import Mode, ModalResult
from .motion import Motion
from .result import Contact, Increment, Result
from .super_element import SuperElement, boundary_nodes

Progress.__module__ = "scabo"

__all__ = [
    "Collapse", "Contact", "DiscreteSolution", "Error", "Fields", "Increment", "Infeasible", "InternalError", "Interrupted",
    "Mechanism", "ModalResult", "Mode", "Model", "ModelError", "ModelWarning", "Motion", "NotConverged", "Problem", "Progress", "Result", "Sizes",
    "SuperElement", "WriteError", "__version__", "boundary_nodes", "read", "schema", "solve_contact",
]
