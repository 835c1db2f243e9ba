"""Links of every page lead to files and headings that exist, and the references of the manual that are made quickly are
complete: pages_test.py SCABO."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "site"))
import check_site  # noqa: E402
import program_reference  # noqa: E402
import verification_manual  # noqa: E402
from markdown import blocks_of, broken_links, slug_of  # noqa: E402
from schema_reference import Reference  # noqa: E402

SCABO = pathlib.Path()
FOLDERS = ("", "docs", "docs/model", "docs/methods", "docs/decisions", "examples", "benchmarks")


class Links(unittest.TestCase):
    def test_of_all_pages(self):
        pages = [page for folder in FOLDERS for page in sorted((ROOT / folder).glob("*.md"))] + sorted(ROOT.glob("examples/*/README.md"))
        self.assertGreater(len(pages), 60)
        anchors = {}
        self.assertEqual([sentence for page in pages for sentence in broken_links(page, anchors)], [])

    def test_broken_ones_are_found(self):
        with tempfile.TemporaryDirectory() as directory:
            page = pathlib.Path(directory) / "page.md"
            page.write_text("# A `heading`, twice\n\n[ok](#a-heading-twice) [no](#heading) [no](other.md) `[code](nothing.md)`\n\n    [code](b.md)\n",
                            encoding="utf-8")
            self.assertEqual([sentence.split(": ")[1] for sentence in broken_links(page, {})],
                             ["page.md has no heading 'heading'", "there is no file other.md"])
            (pathlib.Path(directory) / "index.html").write_text('<a id="here" href="#there"></a><img src="a.png">', encoding="utf-8")
            self.assertEqual(len(list(check_site.broken_links(pathlib.Path(directory)))), 2)
            (pathlib.Path(directory) / "a.js").write_text('let a = 1;\nimport b from "./b.js";\n', encoding="utf-8")
            (pathlib.Path(directory) / "a.css").write_text("@import url(/c.css); b { src: url(d.woff) }", encoding="utf-8")
            self.assertEqual([sentence.split(": ")[1] for sentence in check_site.needs_of_theme(pathlib.Path(directory))],
                             ["imports another script", "needs /c.css"])

    def test_texts_of_pictures_have_no_colon(self):
        """The site reads them as YAML."""
        found = [(page.name, text) for folder in FOLDERS for page in sorted((ROOT / folder).glob("*.md"))
                 for text in re.findall(r'<img [^>]*alt="([^"]*)"', page.read_text(encoding="utf-8")) if ": " in text]
        self.assertEqual(found, [])

    def test_the_overview_names_every_page(self):
        overview = (ROOT / "docs/README.md").read_text(encoding="utf-8")
        self.assertEqual([page.name for page in sorted((ROOT / "docs").glob("*.md")) if page.stem != "README" and f"]({page.name}" not in overview], [])
        index = (ROOT / "docs/model_file.md").read_text(encoding="utf-8")
        self.assertEqual([page.name for page in sorted((ROOT / "docs/model").glob("*.md")) if f"](model/{page.name}" not in index], [])


class References(unittest.TestCase):
    def test_every_key_is_described(self):
        """With its type, a meaning, and an example."""
        schema = json.loads(subprocess.run([SCABO, "schema"], capture_output=True, text=True, check=True).stdout)
        reference = Reference(schema, ROOT)
        page = reference.page()
        rows = re.findall(r"^\| `(\w+)` \| (.*?) \| (.*?) \| (.*?) \| (.*?) \| (.*?) \|$", page.replace("\\|", "/"), re.M)
        self.assertGreater(len(rows), 200)
        keys = set()

        def collect(part):
            if isinstance(part, dict):
                for key, inner in part.items():
                    if key == "properties" and part.get("type") == "object" and part.get("additionalProperties") is False:
                        keys.update(inner)
                    collect(inner)
            elif isinstance(part, list):
                for inner in part:
                    collect(inner)
        collect(schema)
        self.assertEqual(keys - {row[0] for row in rows}, set())
        for key, kind, unit, default, meaning, example in rows:
            with self.subTest(key=key):
                self.assertTrue(kind and "any" not in kind.split(), kind)
                self.assertTrue(meaning or "[" in kind, "no meaning: give it a 'description' in src/scabo/input/schema.json")
                self.assertTrue(example, "no example: use it in a file of tests/input/good")
        anchors = {slug_of(line.lstrip("# ")) for line in page.splitlines() if line.startswith("#")}
        self.assertEqual(set(re.findall(r"\]\(#([^)]+)\)", page)) - anchors, set())

    def test_commands(self):
        page = program_reference.page(SCABO)
        for command in ("run", "check", "plot", "new", "sweep"):
            self.assertIn(f"\n## scabo {command}\n", page)

    def test_tables_of_the_verification_manual(self):
        with tempfile.TemporaryDirectory() as directory:
            records = pathlib.Path(directory)
            check = {"of": "force", "value": 1.001, "bound": 0.01, "times": 2, "reference": 1.0, "exact": "1.0"}
            worse = {**check, "value": 1.002, "times": 1}
            for number, each in enumerate((check, worse)):
                (records / f"{number}.jsonl").write_text(json.dumps(
                    {"suite": "All/FlatPunch", "test": f"Force/{number}", "file": "x/flat_punch_test.cpp", "line": 9, "checks": [each], "models": []}) + "\n")
            cases = verification_manual.read_cases(records)
        self.assertEqual([(case["suite"], case["name"]) for case in cases], [("FlatPunch", "Force")])
        page = verification_manual.page_of("flat_punch_test.cpp", [(cases[0], "picture.png")])
        self.assertIn("| `force` (1) | 1 | 1.002 | 0.002 | 0.01 | 3 |", page)


class Blocks(unittest.TestCase):
    def test_marks_and_kinds(self):
        blocks = blocks_of("text\n\n    scabo run a.yaml\n\n- item\n\n    not code\n\n<!-- snippet: file=a.yaml -->\n```yaml\na: 1\n```\n\n    output\n")
        self.assertEqual([(block.language, block.mark, block.line) for block in blocks], [("sh", "", 3), ("yaml", "file=a.yaml", 11), ("", "", 14)])


if __name__ == "__main__":
    SCABO = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1])
