#!/usr/bin/env python3
"""Makes docstrings of the extension module from the comments of the C++ members that it shows.

    make_docstrings.py OUT.hpp HEADER.hpp...

For every member of a struct with a comment (`///<` or `//` behind it, or `///` above it) the header gets a constant
`doc::Struct_member`, so that a binding names the member whose comment it wants and a member without one does not compile.
"""
import pathlib
import re
import sys

MEMBER = re.compile(r"^  (?!using |static |friend |struct )[\w:<>,&* ]+?[ &*>](\w+)\s*(?:=[^;]*|\{[^;]*\})?;\s*(?://[/<]*\s*(.*))?$")


def members(text):
    """(struct, member, comment) of simple structs: one member a line, two spaces deep."""
    struct, above = None, []
    for line in text.splitlines():
        begin = re.match(r"^struct (?:\[\[[^\]]*\]\] )?(\w+)[^;]*\{", line)
        if begin:
            struct, above = begin.group(1), []
        elif line.startswith("}"):
            struct = None
        elif struct and re.match(r"^  /// ", line):
            above.append(line.strip()[4:])
        elif struct and (found := MEMBER.match(line)):
            comment = found.group(2) or " ".join(above)
            if comment:
                yield struct, found.group(1), comment
            above = []
        elif struct:
            above = []


def sentence(comment):
    """Begins with a capital letter and ends with a full stop."""
    text = re.sub(r"`", "'", comment.strip())
    return text[0].upper() + text[1:] + ("" if text.endswith(".") else ".")


def main():
    out, *headers = sys.argv[1:]
    lines = ["// Made by make_docstrings.py.", "#pragma once", "namespace scabo::python::doc {"]
    for header in headers:
        for struct, member, comment in members(pathlib.Path(header).read_text(encoding="utf-8")):
            text = sentence(comment).replace("\\", "\\\\").replace('"', '\\"')
            lines.append(f'inline constexpr const char* {struct}_{member} = "{text}";')
    pathlib.Path(out).write_text("\n".join(lines + ["}", ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
