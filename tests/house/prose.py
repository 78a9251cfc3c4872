"""Checks that texts are in plain English: prose.py ROOT [FILE...]

Pages, comments and messages are checked. If FILEs are given, only these are checked.
- No comment or sentence begins without a subject ("Of ...", "What ...", "Those ..." and others in OPENINGS).
- No text contains a word in WORDS, because the project uses another one.
- A sentence in a page has at most 35 words and four numbers. In tables, the number of numbers is not limited.
- No line of text in a page begins with an HTML comment, because renderers end the paragraph there. No line inside a
  paragraph begins with ">", "+" or a number and a full stop, because they make it a quotation or a list.

A line of prose_exceptions.txt exempts one text: `file: text: reason`.

The output has one line for each finding: `file:line: rule: text`. The exit code is 1 if there is a finding.
"""

import io
import pathlib
import re
import sys
import tokenize

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "docs/site"))
from pages import lines_of  # noqa: E402

OPENINGS = re.compile(r"(Of|What|Those|Who|Whose|Whether|By which|The same of|Neither of|None of what)\b(?![^.?!]*\?)")
# Pattern and the word that the project uses in its place.
WORDS = (
    (r"reckon(s|ed|ing)?", "compute"),
    (r"of (one's|its|their) own making", "user-defined"),
    (r"(solids?|packings?|mixtures?) of one's own", "user-defined"),
    (r"(give|gives|giving|gave|given) way", "rearrange, or: the cell shape relaxes"),
    (r"told (by|apart)", "identified, distinguished"),
    (r"way (up|down)", "compression, decompression"),
    (r"begin alike|began alike|start alike", "the same initial configuration"),
    (r"(what|whatever) the machine lacks?(ed)?", "out of memory, disk full"),
    (r"imbalance(?! of (force|torque))", "residual"),
    (r"without a word|aloud|loudly", "silently, or: with a message"),
    (r"for whose sake|unheard of|be it\b", "plain words"),
    (r"(it|them|that) says nothing", "does not state"),
    (r"no more than [^.]* but|nothing but|none but", "only"),
    (r"shortages?", "resource failure"),
    (r"reservations?", "warning"),
    (r"certified", "minimum"),
    (r"(follow(s|ed|ing)?|way) downhill", "relaxed along the negative mode"),
    (r"loose particles?", "near-rattler"),
    (r"seldom", "rarely"),
    (r"rooms as|same rooms", "folders"),
    (r"the machine has no (more|other)", "out of memory"),
)
WORDS = tuple((re.compile(rf"\b(?:{pattern})", re.I), better) for pattern, better in WORDS)
MAX_WORDS, MAX_NUMBERS = 35, 4
NUMBER = re.compile(r"(?<![\w.^_-])[-−±]?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w.]*\w)")
SENTENCE_END = re.compile(r"(?<=[.?!:;])(?:\s+|$)(?=[A-Z\[*`_(]|$)")


def comments_of_cpp(text):
    """Pairs of a line number and a comment. Consecutive lines are one comment."""
    found, block, begins = [], [], 0
    for number, line in enumerate(text.split("\n") + [""], 1):
        alone = re.match(r"\s*//[/!]?<?\s?(.*)", line)
        if alone and not line.lstrip().startswith("//\n"):
            begins = begins or number
            block.append(alone[1])
            continue
        if block:
            found.append((begins, " ".join(block)))
            block, begins = [], 0
        trailing = re.search(r"[;,{})\]]\s*//[/!]?<?\s?(.*)", line)
        if trailing and not re.search(r'"[^"]*//[^"]*"', line):
            found.append((number, trailing[1]))
    return found


def messages_of_cpp(text):
    """String literals with at least three words. Adjacent literals are joined."""
    found = []
    for match in re.finditer(r'"((?:[^"\\\n]|\\.)*)"(?:\s*"((?:[^"\\\n]|\\.)*)")*', text):
        words = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', match[0]))
        if len(re.findall(r"[A-Za-z]{2,} ", words)) >= 3:
            found.append((text.count("\n", 0, match.start()) + 1, words))
    return found


def comments_of_hash(text):
    found, block, begins = [], [], 0
    for number, line in enumerate(text.split("\n") + [""], 1):
        alone = re.match(r"\s*#(?!!)\s?(.*)", line)
        if alone:
            begins = begins or number
            block.append(alone[1])
        elif block:
            found.append((begins, " ".join(block)))
            block, begins = [], 0
    return found


def comments_of_python(text):
    found = comments_of_hash(text)
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.STRING and token.string.startswith(('"""', "'''")) and token.line.lstrip() == token.line.strip(" "):
                found.append((token.start[0], token.string.strip("\"'")))
    except tokenize.TokenError:
        pass
    return found


def paragraphs(text):
    """Triples: a line number; the text of a paragraph, list entry or table cell; and whether it is in a table."""
    found, block, begins = [], [], 0

    def close():
        nonlocal block, begins
        if block:
            found.append((begins, " ".join(block), False))
        block, begins = [], 0

    for number, is_code, line in lines_of(text):
        bare = line.strip()
        if is_code or not bare or bare.startswith(("#", "![")):
            close()
        elif bare.startswith("|"):
            close()
            found += [(number, cell.strip(), True) for cell in re.split(r"(?<!\\)\|", bare.strip("|")) if cell.strip()]
        else:
            if re.match(r"([-*]|\d+\.) ", bare):
                close()
                bare = re.sub(r"^([-*]|\d+\.) ", "", bare)
            begins = begins or number
            block.append(bare)
    close()
    return found


def without_code(text):
    text = re.sub(r"<!--.*?-->", "", text)
    text = re.sub(r"(?<!`)`[^`]*`(?!`)", "`code`", text)
    text = re.sub(r"\$[^$]+\$", "formula", text)
    return re.sub(r"\]\([^)]*\)", "]", text)


def findings_of(text):
    """Pairs of a rule and a text that breaks it, for any text."""
    for sentence in SENTENCE_END.split(without_code(text)):
        opening = sentence.strip(" *_[(")
        if OPENINGS.match(opening):
            yield "opens without a subject", opening
        for pattern, better in WORDS:
            match = pattern.search(sentence)
            if match:
                yield f'write "{better}"', f"{match[0]}: {opening}"


def findings_of_page(text):
    for number, paragraph, in_table in paragraphs(text):
        for rule, found in findings_of(paragraph):
            yield number, rule, found
        for sentence in SENTENCE_END.split(without_code(paragraph)):
            words = len(re.findall(r"[^\W\d_]{2,}", sentence))
            if words > MAX_WORDS:
                yield number, f"{words} words, at most {MAX_WORDS}", sentence
            numbers = len(NUMBER.findall(sentence))
            if numbers > MAX_NUMBERS and not in_table:
                yield number, f"{numbers} numbers, at most {MAX_NUMBERS}", sentence
    for number, is_code, line in lines_of(text):
        if not is_code and re.match(r"\s*(?:[-*] |\d+\. )?<!-- (?!block|end)", line):
            yield number, "begins with an HTML comment", line
    before = ""
    for number, is_code, line in lines_of(text):
        if not is_code and re.match(r"(?:[>+]|\d+\.) ", line) and re.match(r"(?![-*>+] |\d+\. )\S", before):
            yield number, "begins like a list or a quotation", line
        before = "" if is_code else line


def findings_of_file(path):
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        yield from findings_of_page(text)
        return
    texts = []
    if path.suffix in (".cpp", ".hpp"):
        texts = comments_of_cpp(text)
        if "tasks" in path.parts:
            texts += messages_of_cpp(text)
    elif path.suffix == ".py":
        texts = comments_of_python(text)
    elif path.suffix in (".sh", ".cmake") or path.name in ("CMakeLists.txt", "Makefile"):
        texts = comments_of_hash(text)
    elif path.suffix == ".json":
        texts = [(text.count("\n", 0, match.start()) + 1, match[1])
                 for match in re.finditer(r'"description": "((?:[^"\\]|\\.)*)"', text)]
    for number, words in texts:
        for rule, found in findings_of(words):
            yield number, rule, found


def files_of(root):
    for pattern in ("*.md", "Makefile", "CMakeLists.txt", "docs/**/*.md", "schemas/*.json", "docs/**/*.py"):
        yield from sorted(root.glob(pattern))
    for folder in ("engine", "tasks", "tests", "examples"):
        for path in sorted((root / folder).rglob("*")):
            checked = path.suffix in (".cpp", ".hpp", ".py", ".sh", ".cmake", ".md") or path.name == "CMakeLists.txt"
            if checked and "data" not in path.parts and "bad" not in path.parts:
                yield path


def exceptions_of(root):
    path = root / "tests/house/prose_exceptions.txt"
    rows = path.read_text(encoding="utf-8").split("\n") if path.exists() else []
    rows = [row.split(": ", 2) for row in rows if row and not row.startswith("#")]
    bad = [row for row in rows if len(row) != 3 or not row[2].strip()]
    if bad:
        sys.exit(f"{path}: write `file: text: reason`, not {bad[0]}")
    return [(file, text) for file, text, _ in rows]


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    files = [pathlib.Path(name).resolve() for name in sys.argv[2:]] or list(files_of(root))
    exceptions, count = exceptions_of(root), 0
    for path in files:
        name = str(path.relative_to(root))
        for number, rule, text in findings_of_file(path):
            if not any(file == name and part in text for file, part in exceptions):
                print(f"{name}:{number}: {rule}: {' '.join(text.split())[:120]}")
                count += 1
    print(f"{len(files)} files, {count} findings")
    sys.exit(1 if count else 0)


if __name__ == "__main__":
    main()
