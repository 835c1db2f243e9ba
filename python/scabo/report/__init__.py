"""A results directory as one page for the browser: NumPy only, without the compiled module.

    import scabo_report                     # from share/scabo of an installation; scabo.report where the module is installed
    scabo_report.write("model.results")     # model.report.html; does what `scabo report model.results` does

`fields` and `pairs` read the files (by the readers of the pictures) and pack arrays, `content` makes everything else, `words` the
sentences, `page` fills the template that is built from report/ of the sources.
"""
from .page import write
from .reading import ResultsError

__all__ = ["ResultsError", "write"]
