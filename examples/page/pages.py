"""Makes the two pages of a study from data: README.md, whose tables and numbers have marks, and tables.md, which is
written only to another folder than that of the study.

Sentences of README.md that depend on the data are checked: each claim is a sentence and a function of the data. If the
function is false, the sentence must be rewritten."""

import argparse
import os
import re
import shutil
import sys
from pathlib import Path

from data import Data
from marks import PageError, renewed, without_marks


def supported(holds, data):
    """True if a claim holds. Data that lack a value do not support it."""
    try:
        return bool(holds(data))
    except (TypeError, KeyError, ValueError):
        return False


def claim_errors(page, claims, data):
    """Messages about claims that the page lacks, or that the data do not support."""
    text = " ".join(without_marks(page).split())
    messages = []
    for sentence, holds in claims.items():
        if sentence not in text:
            messages.append(f"the page lacks the sentence \"{sentence}\"; rewrite it and its claim together")
        elif not supported(holds, data):
            messages.append(f"the data do not support the sentence \"{sentence}\"; rewrite it and its claim together")
    return messages


def tables_page(study, data):
    """Text of tables.md: a heading, an introduction and a table for each part."""
    parts = [f"# {study.TITLE}: all tables\n\nA script makes this page from the data in `data/`. "
             "[The main page](README.md) explains the study.\n\n" + " ".join(study.ENTRIES.split())]
    for title, introduction, make in study.TABLES:
        paragraphs = "\n\n".join(" ".join(part.split()) for part in introduction.split("\n\n"))
        parts.append(f"## {title}\n\n{paragraphs}\n\n{make(data)}")
    return "\n\n".join(part.rstrip("\n") for part in parts) + "\n"


def relocated(page, folder, out):
    """The page with links that lead to the same files from another folder. Links to files that `out` has do not
    change."""
    def link(match):
        target, _, anchor = match[1].partition("#")
        if not target or "://" in target or (out / target).exists() or not (folder / target).exists():
            return match[0]
        return f"]({os.path.relpath(folder / target, out)}{'#' + anchor if anchor else ''})"

    return re.sub(r"\]\(([^)\s]+)\)", link, page)


def folded(page, limit=120):
    """The page with paragraphs of tables.md in lines of at most `limit` characters."""
    lines = []
    for line in page.split("\n"):
        if len(line) <= limit or line.startswith("|"):
            lines.append(line)
            continue
        current = ""
        for word in line.split(" "):
            if current and len(current) + 1 + len(word) > limit:
                lines.append(current)
                current = word
            else:
                current = f"{current} {word}" if current else word
        lines.append(current)
    return "\n".join(lines)


def summary_page(page, study, data):
    """A page of another folder that has the block `summary` and some values of the study."""
    blocks = {name: make for name, make in study.BLOCKS.items() if f"<!-- block {name} -->" in page}
    return renewed(page, blocks, data, study.value_of)


def main(study, folder):
    """Command line of a study's page.py. `study` has TITLE, ENTRIES, FILES, BLOCKS, TABLES, CLAIMS and value_of. It may
    have a class Data of its own."""
    parser = argparse.ArgumentParser(description=f"Makes README.md of {folder.name} from data, and with -o also tables.md.")
    parser.add_argument("--data", type=Path, nargs="*", help="data files; the default is the committed data")
    parser.add_argument("-o", "--out", type=Path, default=folder, help="folder of the pages; the default is the study's")
    parser.add_argument("--check", action="store_true", help="write nothing; a page that differs is an error")
    parser.add_argument("--summary", type=Path, help="another page with the block `summary`, which is made instead")
    arguments = parser.parse_args()
    data = getattr(study, "Data", Data)(*(arguments.data or study.FILES))
    elsewhere = arguments.out.resolve() != folder.resolve() and not arguments.summary
    source = arguments.summary or folder / "README.md"
    page = source.read_text(encoding="utf-8")
    try:
        if arguments.summary:
            made = {source: summary_page(page, study, data)}
        else:
            made = {arguments.out / "README.md": renewed(page, study.BLOCKS, data, study.value_of)}
        if elsewhere:
            made[arguments.out / "tables.md"] = folded(tables_page(study, data))
    except PageError as error:
        sys.exit(f"{source}: {error}")
    errors = [] if arguments.summary else claim_errors(made[arguments.out / "README.md"], study.CLAIMS, data)
    if arguments.check:
        errors += [f"differs from the data; {folder.name}/page.py without --check updates {path.name}"
                   for path, text in made.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
        sys.exit("\n".join(f"{source}: {error}" for error in errors) if errors else 0)
    arguments.out.mkdir(parents=True, exist_ok=True)
    if elsewhere:
        for image in re.findall(r"\]\((\w+\.(?:svg|png|pdf))\)", "\n".join(made.values())):
            if not (arguments.out / image).exists():
                shutil.copy(folder / image, arguments.out)
    for path, text in made.items():
        path.write_text(relocated(text, folder, arguments.out) if elsewhere else text, encoding="utf-8")
    for error in errors:
        print(f"{source}: {error}", file=sys.stderr)
