"""doxygen_filter.py HEADER: a header as Doxygen reads it, line by line as it was.

In the headers a comment is of all that is declared in its line or in the line below it, and of the overloads directly
below that; Doxygen takes it for the first of them. So each gets a copy. Comparisons, which compare all members, and the
lists of names of enumerators say nothing that is not said elsewhere and are left out.
"""

import re
import sys

OPENING, CLOSING = "([{<", ")]}>"


def parts_of(text):
    """Text between commas that no bracket encloses."""
    parts, depth = [""], 0
    for at, sign in enumerate(text):
        depth += sign in OPENING
        depth -= sign in CLOSING and not text[:at].endswith("-")
        if sign == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += sign
    return [part.strip() for part in parts]


def split(line, above):
    """A line that declares several variables, each with the comment; the line itself if it does not."""
    match = re.match(r"( +)([^/;]*);(?: *///< (.*))?$", line)
    if not match or not (match[3] or above):
        return line
    first, *others = parts_of(match[2])
    head = re.match(r"((?:alignas\(\d+\) )?[\w:<>, ]+?[\w>]) +([*&]?\w+(?:\[[^\]]*\])*(?: = .*|\{.*\})?)$", first)
    if not others or not head or head[1] in ("return", "using") or not all(re.match(r"[*&]?\w", one) for one in others):
        return line
    own = f" /**< {match[3]} */" if match[3] else ""
    before = "" if match[3] else f"/** {above} */ "
    return match[1] + " ".join([f"{head[1]} {head[2]};{own}"] + [f"{before}{head[1]} {one};{own}" for one in others])


def function_of(line):
    """The name of the function that a line begins to declare."""
    if re.match(r" *(return|if|for|throw)\b", line):
        return None
    match = re.match(r" *[\w:<>&*, ]*[\w>&*] ([\w]+|operator\S+)\(", line)
    return match[1] if match else None


def filtered(text):
    text = re.sub(r"^template <>\ninline constexpr std::array enum_names<\w[\w:]*>\{.*?\};$",
                  lambda match: "\n" * match[0].count("\n"), text, flags=re.S | re.M)
    lines, comment, shared, name = [], [], "", None
    for line in text.split("\n"):
        stripped = line.strip()
        if stripped.startswith("///") and not stripped.startswith("///<"):
            comment.append(stripped[3:].strip())
            lines.append(line)
            continue
        if re.search(r"operator(==|<=>)\(.*;$|operator(==|<=>)\(.*\}$", line):
            line = ""
        above, comment = " ".join(comment), []
        if not stripped:
            shared, name = "", None
        function = function_of(line)
        if above:
            shared, name = above, function
        elif function and function == name and shared:
            line = f"/** {shared} */ {line}"
        lines.append(split(line, above))
    return "\n".join(lines)


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as header:
        sys.stdout.write(filtered(header.read()))
