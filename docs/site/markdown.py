"""What the manual and its tests need to know of a Markdown page: code blocks with their marks, headings as anchors, links.

A mark is a comment on the line above a block, invisible to readers:

    <!-- snippet: file=block.yaml -->      the model is kept under this name for the commands that follow
    <!-- snippet: status=2 -->             the exit status that the commands are meant to have; 0 unless stated
    <!-- snippet: output -->               what the last command prints, compared word by word; `...` stands for anything
    <!-- snippet: not run, REASON -->      cannot be run in a test, and why
    <!-- snippet: before, COMMAND -->      stands alone: what a reader has done before, run by the test
"""
from __future__ import annotations

import dataclasses
import html
import pathlib
import re
from collections.abc import Iterator

COMMANDS = re.compile(r"^(scabo|make|cmake|ctest|apt|apt-get|sudo|git|cd|python3|export|run-clang-tidy|benchmarks/\S+\.py|\./\S+)\b")


@dataclasses.dataclass
class Block:
    line: int
    """Of its first line of text, from 1."""
    language: str
    """As written after the fence; `sh` of an indented block that begins with a command; otherwise empty."""
    text: str
    mark: str
    """What follows `snippet:`; empty without one."""
    first: int
    """Its lines in the page, from 0: first, and one after the last; fences included."""
    last: int
    fenced: bool


def blocks_of(text: str) -> list[Block]:
    lines = text.split("\n")
    blocks, number = [], 0
    while number < len(lines):
        fence = re.match(r"^( *)(```+)([\w+-]*)", lines[number])
        if fence:
            end = number + 1
            while end < len(lines) and not lines[end].strip().startswith(fence[2]):
                end += 1
            inside = [line[len(fence[1]):] for line in lines[number + 1:end]]
            blocks.append(Block(number + 2, fence[3], "\n".join(inside) + "\n", mark_above(lines, number), number, end + 1, True))
            number = end + 1
        elif lines[number].startswith("    ") and not before_of(lines, number) and not in_list(lines, number):
            end = number
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            while not lines[end - 1].strip():
                end -= 1
            inside = "\n".join(line[4:] for line in lines[number:end]) + "\n"
            blocks.append(Block(number + 1, "sh" if COMMANDS.match(inside) else "", inside, mark_above(lines, number), number, end, False))
            number = end
        else:
            number += 1
    return blocks


def before_of(lines: list[str], number: int) -> str:
    return lines[number - 1].strip() if number else ""


def in_list(lines: list[str], number: int) -> bool:
    """An indented paragraph that continues an item of a list."""
    for line in reversed(lines[:number]):
        if line.strip() and not line.startswith("  "):
            return bool(re.match(r"([-*]|\d+\.) ", line))
    return False


def mark_above(lines: list[str], number: int) -> str:
    for line in reversed(lines[max(0, number - 2):number]):
        found = re.match(r"^ *<!-- snippet: (.*?) -->$", line)
        if found:
            return found[1]
        if line.strip():
            break
    return ""


def outside_code(text: str) -> str:
    """The page with its blocks, code spans and formulas blanked; lines keep their numbers."""
    lines = text.split("\n")
    for block in blocks_of(text):
        for number in range(block.first, min(block.last, len(lines))):
            lines[number] = ""
    text = re.sub(r"(`+)[^`].*?\1", lambda found: " " * len(found[0]), "\n".join(lines))
    return re.sub(r"\$\$.*?\$\$|\$[^$\n]+(\n[^$\n]+)?\$", lambda found: re.sub(r"[^\n]", " ", found[0]), text, flags=re.S)


def slug_of(heading: str) -> str:
    """The anchor that GitHub gives a heading."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip())
    return re.sub(r"[^\w\- ]", "", html.unescape(heading).lower()).replace(" ", "-")


def anchors_of(text: str) -> set[str]:
    lines, inside = text.split("\n"), set()
    for block in blocks_of(text):
        inside.update(range(block.first, block.last))
    anchors: set[str] = set()
    for number, line in enumerate(lines):
        found = re.match(r"^#{1,6} +(.*?) *#*$", line)
        if found and number not in inside:
            slug, copy = slug_of(found[1]), 1
            while slug in anchors:
                slug, copy = f"{slug_of(found[1])}-{copy}", copy + 1
            anchors.add(slug)
    return anchors | set(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", text))


def links_of(text: str) -> Iterator[tuple[int, str]]:
    """Line and target of every link and picture."""
    for number, line in enumerate(outside_code(text).split("\n"), 1):
        for found in re.finditer(r"\]\(([^()\s]+)(?: \"[^\"]*\")?\)|<img [^>]*src=\"([^\"]+)\"|<a [^>]*href=\"([^\"]+)\"", line):
            yield number, found[1] or found[2] or found[3]
    for found in re.finditer(r"\[[^\]]*\n[^\]]*\]\(([^()\s]+)\)", outside_code(text)):  # a text of two lines
        yield text[:found.start()].count("\n") + 1, found[1]


def broken_links(page: pathlib.Path, anchors: dict[pathlib.Path, set[str]]) -> Iterator[str]:
    """Links of a page to files and headings that do not exist, each as a sentence. `anchors` is filled as pages are read."""
    for line, target in links_of(page.read_text(encoding="utf-8")):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page.resolve()
        if not file.exists():
            yield f"{page}:{line}: there is no file {target}"
        elif anchor and file.suffix == ".md":
            if file not in anchors:
                anchors[file] = anchors_of(file.read_text(encoding="utf-8"))
            if anchor not in anchors[file]:
                yield f"{page}:{line}: {file.name} has no heading '{anchor}'"
