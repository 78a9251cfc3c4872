"""The project's pages, and what stands in them: headings, links, code."""

import pathlib
import re
import unicodedata


def pages(root):
    """README.md and its companions, docs/ and the pages of examples."""
    root = pathlib.Path(root)
    return [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")] + sorted(
        [*root.glob("docs/*.md"), *root.glob("examples/**/*.md")])


def lines_of(text, fences=False):
    """Triples of a line's number, whether it is code in a block, and the line; that of a fence is empty unless asked
    for, and then is code."""
    fence, before_blank, indented = None, True, False
    for number, line in enumerate(text.split("\n"), 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if fence:
            closes = mark is not None and mark[1].startswith(fence)
            yield number, not closes or fences, line
            fence = None if closes else fence
            continue
        if mark:
            fence = mark[1]
            yield number, fences, line if fences else ""
            continue
        # Four spaces make code where a paragraph cannot go on; in a list they may go on with its entry.
        deep = line.startswith("    ") and line.strip() != ""
        indented = deep and (before_blank or indented)
        yield number, indented, line
        before_blank = not line.strip()


def code_lines(text):
    return [(number, line.strip()) for number, is_code, line in lines_of(text) if is_code]


def spans(text):
    """Inline code, with the numbers of the lines that it begins in; a row of a table says \\| for |."""
    found = []
    for number, is_code, line in lines_of(text):
        if not is_code:
            found += [(number, span.replace("\\|", "|")) for span in re.findall(r"(?<!`)`([^`]+)`(?!`)", line)]
    return found


def prose(text):
    """The text without code."""
    return "\n".join("" if is_code else re.sub(r"(?<!`)`[^`]*`(?!`)", "", line) for _, is_code, line in lines_of(text))


def links(text):
    """Pairs of a line's number and the target of a link or picture."""
    kept = prose(text)
    found = []
    for match in re.finditer(r"\]\(([^()\s]+(?:\([^()]*\)[^()\s]*)?)(?:\s+\"[^\"]*\")?\)", kept):
        found.append((kept.count("\n", 0, match.start()) + 1, match[1]))
    for match in re.finditer(r"^\[[^\]]+\]:\s+(\S+)", kept, re.M):
        found.append((kept.count("\n", 0, match.start()) + 1, match[1]))
    return found


def plain(heading):
    """A heading as it is read."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[`*]", "", heading).strip()


def github_slug(heading):
    return re.sub(r"[^\w\- ]", "", plain(heading).lower()).replace(" ", "-")


def site_slug(heading):
    """As Python-Markdown's slugify_unicode has it, which the site is made with."""
    text = unicodedata.normalize("NFKC", plain(heading))
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", text).strip().lower())


def anchors(text):
    """The anchors that headings have on GitHub and in the site alike: one that differs is none."""
    github, site = [], []
    for _, is_code, line in lines_of(text):
        match = re.match(r"#{1,6}\s+(.*?)\s*#*$", line)
        if match and not is_code:
            github.append(numbered(github_slug(match[1]), "-", github))
            site.append(numbered(site_slug(match[1]), "_", site))
    return {one for one, other in zip(github, site) if one == other}


def numbered(slug, mark, before):
    count, name = 0, slug
    while name in before:
        count += 1
        name = f"{slug}{mark}{count}"
    return name
