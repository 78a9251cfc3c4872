"""All blocks of the page, {name: function from data to Markdown}, and the numbers within its sentences."""

import alignment
import constraints
import contacts
import counts
import densities
import minima
import search
import vibrations
from values import value_of

BLOCKS = {name: block for module in (alignment, constraints, contacts, counts, densities, minima, search, vibrations)
          for name, block in module.BLOCKS.items()}
__all__ = ["BLOCKS", "value_of"]
