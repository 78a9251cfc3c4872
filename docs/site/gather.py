"""gather.py SOURCE BUILD PROGRAM: the pages as MkDocs takes them, in BUILD/source, and its configuration beside that.

In the tree pages link to each other and to files as GitHub shows them. Here each goes to the place that it has in the
site, with all that it links to, and its links go along; a link to what is not there is an error.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from pages import lines_of, pages

# The first page, and the one that lists the others; the rest keep their names, those of docs/ without that folder.
PLACES = {"README.md": "index.md", "docs/index.md": "pages.md"}
FIELDS = """# Fields

The program prints this page with `isojam fields --markdown`, from the descriptions with which it writes and reads files.

"""
REFERENCE = """# Headers of the engine

[All declarations](api/namespaceisojam.html), [types](api/annotated.html) and [files](api/files.html) of the public
headers. Begin with [the protocol](api/structisojam_1_1JamOptions.html),
[packings](api/structisojam_1_1Packing.html), [energy and forces](api/classisojam_1_1PackingEnergy.html),
[solids](api/classisojam_1_1ConvexSolid.html), [contacts](api/structisojam_1_1ContactAnalysis.html) or
[modes](api/structisojam_1_1SpectrumEnds.html).
"""


def place_of(path):
    """Where a file of the tree stands in the site."""
    name = path.as_posix()
    return pathlib.PurePosixPath(PLACES.get(name, name.removeprefix("docs/") if name.endswith(".md") else name))


def rewritten(root, page, needed):
    """The text of a page with its links as the site needs them; adds the files that it links to."""
    place = place_of(page)

    def link(match):
        target, anchor = re.fullmatch(r"([^#]*)(#.*)?", match[2]).groups()
        if not target or "://" in target or target.startswith("mailto:"):
            return match[0]
        file = pathlib.Path(os.path.normpath(root / page.parent / target)).relative_to(root)
        if (root / file).is_dir():
            file = file / "README.md"
        if not (root / file).is_file():
            raise SystemExit(f"{page}: there is no {target}")
        needed.add(file)
        return match[1] + os.path.relpath(place_of(file), place.parent) + (anchor or "") + match[3]

    lines = []
    for _, is_code, line in lines_of((root / page).read_text(encoding="utf-8"), fences=True):
        if not is_code:
            line = re.sub(r"(\]\()([^()\s]+)(\))", link, line)
            line = re.sub(r"(^\[[^\]]+\]:\s+)(\S+)($)", link, line)
            # A comment at the beginning of a line would end the paragraph, and Python-Markdown prints \| in code as it is.
            line = re.sub(r"<!--.*?-->", "", line)
            line = re.sub(r"`[^`]+`", lambda code: code[0].replace("\\|", "|"), line)
            # A line ends neither between a value and its first error, nor after a sign.
            line = re.sub(r"([±<]) (?=[\d.<])", "\\1\u00a0", line)
            line = re.sub(r"(\d) (±\u00a0\S+)", "\\1\u00a0\\2", line)
        lines.append(line)
    return "\n".join(lines)


def gather(root, build, program):
    source = build / "source"
    needed, done = set(), set()
    texts = {page.relative_to(root): None for page in pages(root)}
    for page in texts:
        texts[page] = rewritten(root, page, needed)
        done.add(page)
    for page, text in texts.items():
        (source / place_of(page)).parent.mkdir(parents=True, exist_ok=True)
        (source / place_of(page)).write_text(text, encoding="utf-8")
    for file in needed - done:
        (source / place_of(file)).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(root / file, source / place_of(file))
    (source / "reference.md").write_text(REFERENCE, encoding="utf-8")
    fields = subprocess.run([program, "fields", "--markdown"], capture_output=True, text=True, check=True).stdout
    (source / "fields.md").write_text(FIELDS + fields, encoding="utf-8")
    shutil.copy(root / "docs/site/extra.css", source)
    for name in ("mkdocs.yml", "hooks.py"):
        shutil.copy(root / "docs/site" / name, build)
    shutil.copytree(root / "docs/site/theme", build / "theme")


if __name__ == "__main__":
    gather(*(pathlib.Path(path).resolve() for path in sys.argv[1:4]))
