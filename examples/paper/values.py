"""Numbers within sentences, by names such as `offset octahedron 100`: a quantity, then solid and size."""

import alignment
import constraints
import contacts
import counts
import densities
import minima
import search
import vibrations

VALUES = {name: value for module in (alignment, constraints, contacts, counts, densities, minima, search, vibrations)
          for name, value in module.VALUES.items()}


class UnknownValue(Exception):
    """The page uses a value that is not defined."""


def value_of(data, name):
    what, *words = name.split()
    if what not in VALUES:
        raise UnknownValue(name)
    return VALUES[what](data, *words)
