"""Comments and documents name files that exist: paths of this project, headers and sources, decisions by their whole name.
The version is the same wherever it stands."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "docs" / "site"))
from cpp_reference import FOLDERS  # noqa: E402

FOLDERS_OF_FILES = ("apps", "benchmarks", "cmake", "compare", "docs", "examples", "python", "report", "src", "tests")
PARTS = sorted(path.name for path in (ROOT / "src/scabo").iterdir() if path.is_dir())
# A path below a folder of the project or a part of src/scabo; a header or source by its name alone.
PATH = re.compile(rf"(?<![\w./*}}-])(?:\.\./)*((?:{'|'.join((*FOLDERS_OF_FILES, *PARTS))})(?:/[\w.-]+)+)(?![\w/*{{$<])")
NAME = re.compile(r"(?<![\w./*}-])([\w/-]+\.[hc]pp)\b")
DECISION = re.compile(r"decisions/(\d[\w.-]*)")
# What the manual makes, and the made-up names of examples and self-tests.
MADE = re.compile(r"docs/site/index\.md|tests/check_includes\.py|tests/references_test\.py")
NOT_FILES = {"examples/NN_name"}


def known():
    """Every file and folder by each end of its path, with and without its extension."""
    ends = set()
    for folder in FOLDERS_OF_FILES:
        for path in (ROOT / folder).rglob("*"):
            if "node_modules" in path.parts or "__pycache__" in path.parts:
                continue
            parts = path.relative_to(ROOT).parts
            for first in range(len(parts)):
                end = "/".join(parts[first:])
                ends.update((end, end.removesuffix(path.suffix)))
    return ends


def prose_of(path, text):
    """Line number and what is prose in it: comments of C++, all of a document."""
    for number, line in enumerate(text.split("\n"), 1):
        yield number, line if path.suffix == ".md" else re.sub(r"https?://\S+", "", line).partition("//")[2]


def stale_in(path, text, ends):
    for number, prose in prose_of(path, text):
        names = [found[1].rstrip("./") for pattern in (PATH, NAME) for found in pattern.finditer(prose)]
        for name in dict.fromkeys(names):
            if name not in ends and name.removeprefix("scabo/") not in ends and name not in NOT_FILES:
                yield f"{path.name}:{number}: there is no {name}"


class References(unittest.TestCase):
    maxDiff = None

    def files(self, *suffixes):
        for folder in (".", *FOLDERS_OF_FILES):
            for path in sorted((ROOT / folder).glob("*") if folder == "." else (ROOT / folder).rglob("*")):
                if path.suffix in suffixes and path.is_file() and "node_modules" not in path.parts and not MADE.search(str(path)):
                    yield path

    def test_comments_and_documents_name_what_exists(self):
        ends = known()
        self.assertEqual([stale for path in self.files(".hpp", ".cpp", ".md")
                          for stale in stale_in(path, path.read_text(encoding="utf-8"), ends)], [])

    def test_decisions_are_named_in_full(self):
        decisions = {path.name for path in (ROOT / "docs/decisions").glob("*.md")}
        found = [(path.name, name[1].rstrip(".")) for path in self.files(".hpp", ".cpp", ".md", ".py", ".txt", ".cmake", ".ts")
                 for name in DECISION.finditer(path.read_text(encoding="utf-8", errors="replace"))]
        self.assertGreater(len(found), 10)
        self.assertEqual([each for each in found if each[1] not in decisions], [])

    def test_headers_of_the_manual_exist(self):
        for folder, (_, names) in FOLDERS.items():
            for name in names:
                self.assertTrue(list((ROOT / "src/scabo" / folder).glob(name)), f"{folder}/{name}")

    def test_versions_agree(self):
        texts = {name: (ROOT / name).read_text(encoding="utf-8") for name in ("CMakeLists.txt", "CITATION.cff", "CHANGELOG.md", "README.md")}
        version = re.search(r"project\(scabo VERSION (\d+\.\d+)\.(\d+)", texts["CMakeLists.txt"])
        self.assertIn(f"\nversion: {version[1]}.{version[2]}\n", texts["CITATION.cff"])
        self.assertIn(f"\n## [{version[1]}.{version[2]}]", texts["CHANGELOG.md"])
        self.assertIn(f"find_package(scabo {version[1]} REQUIRED)", texts["README.md"])

    def test_stale_names_are_found(self):
        text = "int a;  // as in contact/gone.hpp, mesh/gone and gone.cpp; base/error.hpp, mesh/*, https://mesh/site\n"
        self.assertEqual(list(stale_in(pathlib.Path("a.cpp"), text, {"base/error.hpp"})),
                         ["a.cpp:1: there is no contact/gone.hpp", "a.cpp:1: there is no mesh/gone", "a.cpp:1: there is no gone.cpp"])


if __name__ == "__main__":
    unittest.main()
