"""The readers of results: those of the pictures, in the package `scabo` or, where the folder stands alone, beside it."""
if __package__ and "." in __package__:
    from ..plot import Results, ResultsError, Units, geometry, revolution, screen, tetrahedra, vtu
    from ..plot.motions import magnification_of, motion_of
    from ..plot.results import refuse_impossible, without_rounding
    from ..plot.units import UnitsError
else:
    from scabo_plot import Results, ResultsError, Units, geometry, revolution, screen, tetrahedra, vtu
    from scabo_plot.motions import magnification_of, motion_of
    from scabo_plot.results import refuse_impossible, without_rounding
    from scabo_plot.units import UnitsError

__all__ = ["Results", "ResultsError", "Units", "UnitsError", "geometry", "magnification_of", "motion_of", "refuse_impossible", "revolution", "screen", "tetrahedra", "vtu", "without_rounding"]
