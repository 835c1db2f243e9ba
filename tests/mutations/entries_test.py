"""Every changed line of mutations.py is in its file, once, and is changed; so is the number of them in docs/mutations.md."""
import re
import unittest
from pathlib import Path

from mutations import MUTATIONS

ROOT = Path(__file__).resolve().parents[2]


class Entries(unittest.TestCase):
    def test_every_line_is_in_its_file_once(self):
        for number, (file, original, replacement, _) in MUTATIONS.items():
            with self.subTest(number=number):
                self.assertEqual((ROOT / "src/scabo" / file).read_text(encoding="utf-8").count(original), 1, original)
                self.assertIn("MUTATED", replacement)

    def test_python_tests_exist(self):
        for _, _, _, test in MUTATIONS.values():
            if test.endswith(".py"):
                self.assertTrue((ROOT / test).is_file(), test)

    def test_their_number_is_that_of_the_page(self):
        page = (ROOT / "docs/mutations.md").read_text(encoding="utf-8")
        self.assertEqual([int(found) for found in re.findall(r"(\d+) changed lines, all noticed", page)], [len(MUTATIONS)])
        self.assertEqual(sum(int(found) for found in re.findall(r"^\|[^|]*\| (\d+) \|", page, re.M)), len(MUTATIONS))


if __name__ == "__main__":
    unittest.main()
