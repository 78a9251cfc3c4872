"""All blocks of the page, {name: function from data to Markdown}, and the numbers within its sentences."""

import contacts
import counts
import densities
import vibrations
from values import value_of

BLOCKS = {**counts.BLOCKS, **densities.BLOCKS, **contacts.BLOCKS, **vibrations.BLOCKS}
__all__ = ["BLOCKS", "value_of"]
