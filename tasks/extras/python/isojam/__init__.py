"""Runs studies of isojam and reads their results as pandas DataFrames and numpy arrays.

    import isojam
    study = isojam.run({"name": "two-solids", ...}, "results/two-solids")
    study = isojam.load("results/two-solids")    # or a study that was run before
    study.replicates["phi_j"]                    # one value per replicate
    study.states["C"]                            # one value per state
    study.packing(study.names[0]).positions
    study.contacts().vectors("force")            # (contacts, 3)
    study.table()                                # means and confidence intervals

docs/python.md describes the module."""

from . import palette
from .commands import aggregate, measure, run
from .errors import InputError, ManifestError, ProgramError
from .facts import quantities
from .facts import version as __version__
from .packing import Packing, Solid
from .rows import Rows
from .study import Study, load

__all__ = ["InputError", "ManifestError", "Packing", "ProgramError", "Rows", "Solid", "Study", "__version__", "aggregate",
           "load", "measure", "palette", "quantities", "run"]
