"""Tables of the program as pandas DataFrames."""

from typing import IO, Any

import numpy
import pandas  # type: ignore[import]
from numpy.typing import NDArray

from . import facts


class Rows(pandas.DataFrame):  # type: ignore[misc]
    """A pandas DataFrame with a row for each replicate, state or contact.

    A missing number is NaN, and a missing text is ""."""

    @property
    def _constructor(self) -> type["Rows"]:
        return Rows

    @property
    def kept(self) -> "Rows":
        """The rows of replicates that the program uses for means: those that neither failed nor are excluded.

        Only for `study.replicates` and `study.states`."""
        kept = ~self["excluded"]
        return self[kept & (self["status"] == "done")] if "status" in self else self[kept]

    def vectors(self, name: str) -> NDArray[Any]:
        """An array of shape (rows, 3) of the columns NAME_x, NAME_y and NAME_z, for example of "force"."""
        return self[[f"{name}_{axis}" for axis in "xyz"]].to_numpy()


def read_csv(file: IO[bytes]) -> Rows:
    """Reads a table that the program printed. The numbers have the same bits."""
    texts = dict.fromkeys(facts.texts, str)
    frame = pandas.read_csv(file, dtype=texts, keep_default_na=False, na_values=[""], float_precision="round_trip",
                            low_memory=False)
    frame = frame.fillna({name: "" for name in texts if name in frame})
    # A column without values has no type of its own.
    empty = [name for name in frame.columns if name not in texts and frame[name].isna().all()]
    return Rows(frame.astype(dict.fromkeys(empty, numpy.float64)))
