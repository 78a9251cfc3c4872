"""Results of isojam as numpy arrays.

    import isojam
    study = isojam.load("results/two-solids")
    study.replicates["phi_j"]            # one value per replicate
    study.states["C"]                    # one per state
    study.packing(study.names[0]).positions
    study.contacts()["force"]            # (contacts, 3)

docs/python.md has the rest.
"""

from .errors import InputError, ProgramError
from .facts import quantities
from .packing import Packing
from .rows import Rows
from .solid import Solid
from .study import Study, load
from .table import read_table

__all__ = ["InputError", "Packing", "ProgramError", "Rows", "Solid", "Study", "load", "quantities", "read_table"]
