#!/usr/bin/env python3
"""Makes docstrings of the extension module from the comments of the C++ code that it shows.

    make_docstrings.py OUT.hpp SOURCE...

Every struct, class, alias and function of a source with a comment (`///` above it) and every member with one (`///<` or `//`
behind it, or `///` above it) becomes a constant in a namespace of the source's name: of runs.cpp `doc::runs::Progress`,
`doc::runs::Progress_stage`, `doc::runs::solve_static`. A binding names the comment that it wants, so that one without a
comment does not compile. Sources of one name (models.hpp, models.cpp) share a namespace.
"""
import pathlib
import re
import sys
import textwrap

TYPE = re.compile(r"^(?:struct|class) (?:\[\[[^\]]*\]\] )?(\w+)(?: final)?(?: :[^;]*)?\s*\{")
MEMBER = re.compile(r"^  (?!using |static |friend |struct |return )[\w:<>,&* ]+?[ &*>](\w+)\s*(?:=[^;]*|\{[^;]*\})?;"
                    r"\s*(?://[/<]*\s*(.*))?$")
ALIAS = re.compile(r"^using (\w+) =")
FUNCTION = re.compile(r"^(?!using |namespace |return )[\w:<>,&* ]*?[ &*>](\w+)\(")


def comments(text):
    """(name, comment) of types, their members (two spaces deep) and functions; a member is named Type_member."""
    within, above = None, []
    for line in text.splitlines():
        if re.match(r"^\s*///( |$)", line):
            above.append(line.strip()[3:].strip())
            continue
        if re.match(r"^\s*template <", line):
            continue
        comment, name = " ".join(above), None
        if begin := TYPE.match(line):
            within = name = begin.group(1)
        elif line.startswith("}"):
            within = None
        elif within:
            if member := MEMBER.match(line):
                name, comment = f"{within}_{member.group(1)}", member.group(2) or comment
            elif line.startswith("  ") and (function := FUNCTION.match(line[2:])):
                name = f"{within}_{function.group(1)}"
        elif alias := ALIAS.match(line):
            name = alias.group(1)
        elif function := FUNCTION.match(line):
            name = function.group(1)
        if name and comment:
            yield name, comment
        above = []


def sentence(comment):
    """Begins with a capital letter, unless that is a symbol, and ends with a full stop."""
    text = comment.strip().replace("`", "'")
    if re.match(r"[a-z]{2}", text):
        text = text[0].upper() + text[1:]
    return textwrap.fill(text + ("" if text.endswith(".") else "."), 100)


def header(sources):
    """The text of the header."""
    spaces = {}
    for source in map(pathlib.Path, sources):
        space = spaces.setdefault(source.stem, {})
        for name, comment in comments(source.read_text(encoding="utf-8")):
            if name not in space:  # of overloads, the first one
                space[name] = sentence(comment)
    lines = ["// Made by make_docstrings.py.", "#pragma once"]
    for space, of_space in spaces.items():
        lines.append(f"namespace scabo::python::doc::{space} {{")
        for name, text in of_space.items():
            literal = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
            lines.append(f'inline constexpr const char* {name} = "{literal}";')
        lines.append("}")
    return "\n".join(lines + [""])


def main():
    out, *sources = sys.argv[1:]
    pathlib.Path(out).write_text(header(sources), encoding="utf-8")


if __name__ == "__main__":
    main()
