"""Replaces the parts of a page that are made from data.

A block is the text between `<!-- block NAME -->` and `<!-- end -->`. A value in a sentence is the text between `<!-- =
NAME -->` and `<!-- / -->`. Both are replaced by the text for NAME. The rest of the page does not change."""

import re

BLOCK = re.compile(r"(<!-- block (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
VALUE = re.compile(r"(<!-- = ([^\n]+?) -->).*?(<!-- / -->)", re.DOTALL)


class PageError(Exception):
    """The page does not have the required blocks, or it contains an unknown value."""


def renewed(page, blocks, data, value_of=None, every=True):
    """The page with all its parts made again.

    `blocks` is {name: function of data}. `value_of` is a function of (data, name). The page must have every block once.
    With every=False, it must have at least one of them."""
    names = [match.group(2) for match in BLOCK.finditer(page)]
    if not every and not names or not set(names) <= set(blocks):
        raise PageError(f"the page must have some of these blocks: {', '.join(sorted(blocks))}")
    if every and sorted(names) != sorted(blocks):
        raise PageError(f"the page must have every block once: {', '.join(sorted(blocks))}; "
                        f"wrong: {', '.join(sorted(set(names) ^ set(blocks))) or 'one occurs twice'}")
    page = BLOCK.sub(lambda match: match.group(1) + blocks[match.group(2)](data) + match.group(3), page)

    def value(match):
        if not value_of:
            raise PageError(f"there is no value named {match.group(2)}")
        return match.group(1) + value_of(data, match.group(2)) + match.group(3)

    return VALUE.sub(value, page)


def without_marks(text):
    """The text without HTML comments, as a reader sees it."""
    return re.sub(r"<!--.*?-->", "", text)
