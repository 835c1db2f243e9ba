"""Every snippet of README.md and docs/ is run: snippets_test.py SCABO.

Blocks of one page run in their order, in one directory, as a reader would type them.

- A whole model (```yaml with `scabo: 1` and `bodies:`) is checked by the program. Other ```yaml blocks are fragments: the
  schema must accept them somewhere in a model.
- Commands of the program (```sh, or indented blocks that begin with a command) are run, and must end with status 0 or the
  one that a mark names. Pages may speak of model.yaml, which is then the model of example 01. Targets of `make` must exist;
  they are not run.
- ```python blocks of one page share their names, as in a notebook (without the compiled module those of `import scabo` are
  left out).
- ```cpp and ```cmake blocks of the README are built and run by tests/install/readme.cmake.

A mark on the line above a block (docs/site/markdown.py) gives a file name, a status, or the reason why a block cannot be run.
"""
import importlib.util
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "docs" / "site"), str(ROOT / "tests" / "input")]
from markdown import blocks_of  # noqa: E402
from schema_test import load  # noqa: E402

PATIENCE = 1200  # s
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "docs" / "model").glob("*.md"))]
OTHER_PAGES = sorted((ROOT / "docs" / "methods").glob("*.md")) + sorted((ROOT / "docs" / "decisions").glob("*.md"))
SCABO = pathlib.Path()
HAS_MODULE = importlib.util.find_spec("scabo") is not None
# What pages call model.yaml, problem.hdf5 and part.inp; some pages have a model of their own, whose results they read.
GIVEN = {"model.yaml": "examples/01_double_cantilever/model.yaml", "problem.hdf5": "examples/03_discrete_problem/problem.hdf5",
         "part.inp": "tests/fuzz/corpus/convert_abaqus/contact.inp"}
GIVEN_TO = {"results": {"model.yaml": "tests/docs/results.yaml"},
            "space": {name: f"examples/30_blocks_in_space/{name}" for name in ("base.inp", "block.inp")}}
OPTIONAL = {"scabo": HAS_MODULE, "pandas": importlib.util.find_spec("pandas") is not None}


class Page:
    """A page's blocks, run in a directory of its own."""

    def __init__(self, test: unittest.TestCase, file: pathlib.Path, directory: pathlib.Path) -> None:
        self.test, self.file, self.directory = test, file, directory
        self.names = {"__name__": "snippet"}
        self.printed = ""
        self.counts: dict[str, int] = {}
        for name, original in {**GIVEN, **GIVEN_TO.get(file.stem, {})}.items():
            shutil.copy(ROOT / original, directory / name)
        (directory / "scabo_plot").symlink_to(ROOT / "python" / "scabo" / "plot")  # as in share/scabo of an installation

    def run(self) -> dict[str, int]:
        text = self.file.read_text(encoding="utf-8")
        before = [(text[:found.start()].count("\n"), found[1]) for found in re.finditer(r"^<!-- snippet: before, (.*?) -->$", text, re.M)]
        for block in blocks_of(text):
            with self.test.subTest(page=self.file.name, line=block.line):
                while before and before[0][0] < block.first:
                    self.call(shlex.split(before.pop(0)[1]), 0)
                self.run_block(block)
        return self.counts

    def run_block(self, block) -> None:
        if block.mark.startswith("not run"):
            self.test.assertRegex(block.mark, r"^not run, .{8,}", "a reason is missing")
            return
        if block.mark == "output":
            self.compare(block.text)
        elif block.language == "yaml":
            self.model(block)
        elif block.language in ("sh", "bash"):
            self.commands(block)
        elif block.language == "python":
            self.python(block)
        elif block.language in ("cpp", "cmake"):
            self.test.assertEqual(self.file, ROOT / "README.md", "tests/install/readme.cmake builds and runs those of the README only")
        elif block.fenced and block.language not in ("text", ""):
            self.test.fail(f"what is to be done with a block of '{block.language}'? See {pathlib.Path(__file__).name}")
        self.counts[block.language] = self.counts.get(block.language, 0) + 1

    def model(self, block) -> None:
        value = load(block.text)
        if isinstance(value, dict) and "scabo" in value and "bodies" in value:
            name = re.sub(r"^file=", "", block.mark) if block.mark.startswith("file=") else f"line_{block.line}.yaml"
            (self.directory / name).write_text(block.text, encoding="utf-8")
            self.call(["scabo", "check", name], 0)
        else:
            self.test.assertTrue(fits_somewhere(value), f"the schema accepts this nowhere:\n{block.text}")

    def commands(self, block) -> None:
        wanted = int(re.sub(r"^status=", "", block.mark)) if block.mark.startswith("status=") else 0
        for line in block.text.splitlines():
            words = shlex.split(line, comments=True)
            if not words:
                continue
            if words[0] == "make":
                self.targets(words[1:])
            elif words[0] == "scabo":
                self.call(quick(words, self.file), wanted)
            else:
                self.test.fail(f"'{words[0]}' is not run here: mark the block with the reason, <!-- snippet: not run, ... -->")

    def targets(self, words: list[str]) -> None:
        text = (ROOT / "Makefile").read_text(encoding="utf-8")
        for word in words:
            if "=" not in word:
                self.test.assertRegex(text, rf"(?m)^{re.escape(word)}:", f"there is no target {word}")

    def call(self, words: list[str], wanted: int) -> None:
        to = None
        if ">" in words:
            words, to = words[:words.index(">")], words[words.index(">") + 1]
        environment = {**os.environ, "SCABO_PYTHON": sys.executable, "OPENBLAS_NUM_THREADS": "1"}
        done = subprocess.run([str(SCABO), *words[1:]], cwd=self.directory, env=environment, capture_output=True, text=True, timeout=PATIENCE)
        if words[1] == "resume" and "nothing is left to resume" in done.stderr:
            return  # of a run that has ended; tests/regression interrupts some
        self.test.assertEqual(done.returncode, wanted, f"{' '.join(words)}\n{done.stderr}")
        if to:
            (self.directory / to).write_text(done.stdout, encoding="utf-8")
        self.printed = done.stdout

    def compare(self, text: str) -> None:
        """Every line of the block, in this sequence, is among what was printed; `...` stands for anything."""
        printed = iter([" ".join(line.split()) for line in self.printed.splitlines()])
        for line in text.splitlines():
            pattern = ".*".join(re.escape(part) for part in " ".join(line.split()).split("..."))
            if line.strip():
                self.test.assertTrue(any(re.fullmatch(pattern, each) for each in printed), f"not printed: {line}\n{self.printed}")

    def python(self, block) -> None:
        if any(not here and re.search(rf"\b{name}\b", block.text) for name, here in OPTIONAL.items()):
            return
        before = os.getcwd()
        os.chdir(self.directory)
        sys.path.append(str(self.directory))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                exec(compile("\n" * (block.line - 1) + block.text, str(self.file), "exec"), self.names)
        finally:
            os.chdir(before)
            sys.path.remove(str(self.directory))


def quick(words: list[str], file: pathlib.Path) -> list[str]:
    """All pictures of a result take seconds: they are drawn for the tutorial, one of them elsewhere (tests/plot draws all)."""
    everything = words[1] == "plot" and not words[2].endswith((".sweep", ".yaml")) and "--what" not in words and file.stem != "first_ten_minutes"
    return [*words, "--what", "mesh"] if everything else words


def schemas(schema):
    """Every schema in a schema, at any depth, of what has keys or entries; conditions have no say of their own."""
    if isinstance(schema, dict):
        if schema.get("additionalProperties") is False or isinstance(schema.get("additionalProperties"), dict) or isinstance(schema.get("items"), dict):
            yield schema
        for key, inner in schema.items():
            if key not in ("if", "then", "else"):
                yield from schemas(inner)
    elif isinstance(schema, list):
        for inner in schema:
            yield from schemas(inner)


def fits_somewhere(value) -> bool:
    """Whether a fragment is a part of some model: keys of one object, or entries by name or of a list; of the required keys
    a fragment may lack some."""
    for schema in schemas(SCHEMA):
        relaxed = {key: held for key, held in schema.items() if key in ("type", "properties", "propertyNames", "additionalProperties", "items")}
        held = isinstance(value, list) if "items" in schema else isinstance(value, dict)
        if held and schema.get("additionalProperties") is False and not set(value) <= set(schema.get("properties", {})):
            continue  # the quick answer for most
        if held and jsonschema.Draft202012Validator({**relaxed, "$defs": SCHEMA["$defs"]}).is_valid(value):
            return True
    return False


class Snippets(unittest.TestCase):
    def run_page(self, file: pathlib.Path) -> dict[str, int]:
        with tempfile.TemporaryDirectory() as directory:
            return Page(self, file, pathlib.Path(directory)).run()

    def test_other_pages(self):
        """Methods and decisions: formulas and tables, few blocks."""
        for file in OTHER_PAGES:
            self.run_page(file)

    def test_a_wrong_snippet_is_found(self):
        """The check itself: each of these must fail."""
        wrong = {
            "a fragment with a key that does not exist": "```yaml\nmaterials:\n  steel: {youngs: 1}\n```\n",
            "a model with a mistake": "```yaml\nscabo: 1\nbodies: {a: {rigid: true, shape: {circle: {centre: [0, 0], radius: 1}}}}\n```\n",
            "a command that fails": "    scabo run nothing.yaml\n",
            "a command that nobody runs": "```sh\nfrobnicate\n```\n",
            "a target that does not exist": "    make coffee\n",
            "an output that is not printed": "    scabo check model.yaml\n\n<!-- snippet: output -->\n```text\nNo mistake was found\n```\n",
            "a reason that is missing": "<!-- snippet: not run -->\n```sh\nmake test\n```\n",
        }
        for what, text in wrong.items():
            with self.subTest(what), tempfile.TemporaryDirectory() as directory:
                file = pathlib.Path(directory) / "page.md"
                file.write_text(text, encoding="utf-8")
                page = Page(self, file, pathlib.Path(directory))
                with self.assertRaises(AssertionError):
                    for block in blocks_of(text):
                        page.run_block(block)


def add_tests() -> None:
    """One test for each page."""
    for file in PAGES:
        def test(self, file=file):
            self.run_page(file)
        setattr(Snippets, f"test_{file.relative_to(ROOT).with_suffix('').as_posix().lower().replace('/', '_')}", test)


if __name__ == "__main__":
    SCABO = pathlib.Path(sys.argv[1]).resolve()
    SCHEMA = json.loads(subprocess.run([SCABO, "schema"], capture_output=True, text=True, check=True).stdout)
    add_tests()
    unittest.main(argv=sys.argv[:1])
