#!/usr/bin/env python3
"""Builds the manual, DIRECTORY/html/index.html, as `make docs` does.

    docs/site/build.py --build build --output build/docs [--without gallery,verification,cpp,python]

1. stage:     the Markdown pages of the repository are copied, with the files that they name, so that their links stay true
2. generate:  pages made from the program, the schema, the code, the tests and the examples are written beside them
3. render:    Sphinx makes the site; a warning is an error
4. check:     every link of every page leads to a file and an anchor that exist
"""
from __future__ import annotations

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

SITE = pathlib.Path(__file__).resolve().parent
ROOT = SITE.parent.parent
sys.path.insert(0, str(SITE))

import check_site
import cpp_reference
import gallery
import program_reference
import schema_reference
import verification_manual
from markdown import blocks_of, links_of

PARTS = ("gallery", "verification", "cpp", "python")
PAGES = ("README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/*.md", "docs/model/*.md", "docs/methods/*.md", "docs/decisions/*.md",
         "examples/README.md", "examples/*/README.md", "benchmarks/README.md")
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# What TeX-AMS_CHTML-full needs, 4 MB of 54.
OF_MATHJAX = ("MathJax.js", "config/TeX-AMS_CHTML-full.js", "extensions", "jax/element", "jax/input/TeX", "jax/output/CommonHTML",
              "fonts/HTML-CSS/TeX/woff")


def main() -> int:
    options = options_of()
    source = options.output / "source"
    shutil.rmtree(source, ignore_errors=True)
    shutil.rmtree(options.output / "html", ignore_errors=True)
    source.mkdir(parents=True)
    timed("pages", stage, source)
    timed("model file", write, source / "reference/keys.md", lambda: schema_reference.Reference(schema_of(options.scabo), ROOT).page())
    timed("program", write, source / "reference/program.md", lambda: program_reference.page(options.scabo))
    pages = [("gallery", source / "gallery.md", gallery.page, "Gallery"),
             ("verification", source / "verification.md", verification_manual.page, "Verification manual")]
    for part, file, make, title in pages:
        if part in options.without:
            write(file, lambda: f"# {title}\n\nLeft out of this build.\n")
        else:
            timed(part, write, file, lambda: make(options.scabo, options.build, file.parent, options.jobs))
    if "cpp" in options.without:
        write(source / "reference/cpp.md", lambda: "# C++\n\nLeft out of this build.\n")
    else:
        timed("C++", cpp_reference.write, source / "reference", options.output / "doxygen")
    python = "# Python\n\nLeft out of this build.\n" if "python" in options.without else (SITE / "python.md").read_text()
    write(source / "reference/python.md", lambda: python)
    copy_named_files(source)
    timed("Sphinx", render, source, options)
    timed("links", check, options.output / "html")
    print(options.output / "html" / "index.html")
    return 0


def options_of() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Builds the manual.")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where Scabo is built")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "build" / "docs")
    parser.add_argument("--without", type=lambda text: text.split(","), default=[], help=f"of {', '.join(PARTS)}")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    for part in options.without:
        if part not in PARTS:
            parser.error(f"there is no part {part}")
    options.build, options.output = options.build.resolve(), options.output.resolve()
    options.scabo = options.build / "bin" / "scabo"
    if not options.scabo.exists():
        parser.error(f"{options.scabo} does not exist: `make docs` builds it first")
    return options


def timed(name: str, step, *arguments) -> None:
    start = time.monotonic()
    step(*arguments)
    print(f"{name:14} {time.monotonic() - start:6.1f} s", flush=True)


def write(file: pathlib.Path, text_of) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text_of(), encoding="utf-8")


def schema_of(scabo: pathlib.Path) -> dict:
    return json.loads(subprocess.run([scabo, "schema"], capture_output=True, text=True, check=True).stdout)


# ---- pages of the repository --------------------------------------------------------------------------------


def stage(source: pathlib.Path) -> None:
    for pattern in PAGES:
        for page in sorted(ROOT.glob(pattern)):
            copy_page(page, source / page.relative_to(ROOT))
    index = (SITE / "index.md").read_text(encoding="utf-8")
    others = [f"docs/{page.stem}" for page in sorted((ROOT / "docs").glob("*.md")) if f"\ndocs/{page.stem}\n" not in index and page.stem != "README"]
    write(source / "index.md", lambda: index.replace("docs/pictures\n", "\n".join(["docs/pictures", *others]) + "\n"))
    methods = (ROOT / "docs/README.md").read_text(encoding="utf-8").partition("## Methods")[2].replace("](methods/", "](").replace("](notation", "](../notation")
    write(source / "docs/methods/README.md", lambda: f"# Methods{methods}")
    for page, glob in (("docs/model_file.md", "model/*"), ("docs/methods/README.md", "[0-9]*"), ("docs/decisions/README.md", "[0-9]*"), ("examples/README.md", "[0-9]*/README")):
        with open(source / page, "a", encoding="utf-8") as file:
            file.write(f"\n```{{toctree}}\n:hidden:\n:glob:\n\n{glob}\n```\n")
    tutorials = ["# Tutorials in Python", "",
                 "Three programs for the [Python package](../../docs/python.md), to run as they are. The tests run them and check"
                 " their numbers.", ""]
    for program in sorted((ROOT / "examples/python").glob("*.py")):
        text = program.read_text(encoding="utf-8")
        summary = re.search(r'"""(.*?)(?:\n\n|""")', text, re.S)
        tutorials += [f"## {program.name}", "", " ".join(summary[1].split()) if summary else "", "", "```python", text.rstrip(), "```", ""]
    write(source / "examples/python/README.md", lambda: "\n".join(tutorials))


def copy_page(page: pathlib.Path, to: pathlib.Path) -> None:
    text = page.read_text(encoding="utf-8")
    lines = text.split("\n")
    inside = {number for block in blocks_of(text) for number in range(block.first, block.last)}
    titles = [number for number, line in enumerate(lines) if line.startswith("# ") and number not in inside]
    if len(titles) > 1:  # a page of the manual has one title
        for number in range(titles[0] + 1, len(lines)):
            if re.match(r"#+ ", lines[number]) and number not in inside:
                lines[number] = "#" + lines[number]
    # Commands get colours: an indented block of them becomes a fenced one.
    for block in reversed(blocks_of(text)):
        if not block.fenced:
            language = "bash" if block.language == "sh" else "text"
            lines[block.first:block.last] = [f"```{language}", *block.text.rstrip("\n").split("\n"), "```"]
    text = "\n".join(lines)
    # A folder is shown as its page.
    def page_of(found: re.Match) -> str:
        folder = (page.parent / found[1]).resolve()
        return f"]({found[1].rstrip('/')}/README.md)" if folder.is_dir() else found[0]
    text = re.sub(r"\]\(([^()\s#:]+)\)", page_of, text)
    if page == ROOT / "docs" / "README.md":
        text = "---\norphan: true\n---\n" + text
    write(to, lambda: text)


def copy_named_files(source: pathlib.Path) -> None:
    """Pictures, models and programs that pages link to."""
    for page in sorted(source.rglob("*.md")):
        for _, target in links_of(page.read_text(encoding="utf-8")):
            path = target.partition("#")[0]
            if not path or re.match(r"[a-z]+:", path):
                continue
            place = (page.parent / path).resolve()
            if not place.is_relative_to(source) or place.exists():
                continue
            original = ROOT / place.relative_to(source)
            if original.is_file():
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(original, place)


# ---- Sphinx -------------------------------------------------------------------------------------------------


def render(source: pathlib.Path, options: argparse.Namespace) -> None:
    environment = {**os.environ, "SCABO_ROOT": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1",
                   "PYTHONPATH": str(options.build / "python"), "LC_ALL": "C.UTF-8"}
    done = subprocess.run(["/usr/bin/python3", "-m", "sphinx", "-b", "html", "-W", "--keep-going", "-q", "-c", str(SITE),
                           "-d", str(options.output / "doctrees"), str(source), str(options.output / "html")], env=environment)
    if done.returncode:
        sys.exit("make docs: Sphinx has complaints (above)")
    static = options.output / "html" / "_static" / "mathjax"
    for name in OF_MATHJAX:
        original = MATHJAX / name
        (static / name).parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if original.is_dir() else shutil.copy)(original, static / name)
    mend_theme(options.output / "html" / "_static")


def mend_theme(static: pathlib.Path) -> None:
    """Debian's Furo has its scripts and styles in several files, one of them outside of the site: a page that is read from a disk can use
    neither an import of a script nor a path from the root."""
    script = static / "scripts" / "furo.js"
    text = script.read_text(encoding="utf-8")
    for name in re.findall(r'^import \w+ from "\./([\w.-]+)";\n', text, re.M):
        text = (script.parent / name).read_text(encoding="utf-8") + text.replace(re.search(rf'^import \w+ from "\./{re.escape(name)}";\n', text, re.M)[0], "")
    script.write_text(text, encoding="utf-8")
    style = static / "styles" / "furo.css"
    text = style.read_text(encoding="utf-8")
    for path in re.findall(r"@import url\((/javascript/[^)]+)\);", text):
        text = text.replace(f"@import url({path});", pathlib.Path("/usr/share" + path).read_text(encoding="utf-8"))
    style.write_text(text, encoding="utf-8")


def check(html: pathlib.Path) -> None:
    broken = [*check_site.broken_links(html), *check_site.needs_of_theme(html)]
    for sentence in broken:
        print(sentence, file=sys.stderr)
    if broken:
        sys.exit(f"make docs: {len(broken)} broken links and missing files")


if __name__ == "__main__":
    sys.exit(main())
