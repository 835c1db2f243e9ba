"""In a Python file the second class or test of one name hides the first, which then never runs."""
import ast
import collections
import unittest
from pathlib import Path

TESTS = Path(__file__).resolve().parent


def hidden_in(body):
    """Names that are defined twice among these statements, and in the classes among them."""
    classes = [statement for statement in body if isinstance(statement, ast.ClassDef)]
    functions = [statement for statement in body if isinstance(statement, ast.FunctionDef) and not statement.decorator_list]
    counts = collections.Counter(statement.name for statement in classes + functions)
    return [name for name, count in counts.items() if count > 1] + [name for one in classes for name in hidden_in(one.body)]


class Names(unittest.TestCase):
    def test_no_test_hides_another(self):
        files = sorted(TESTS.rglob("*.py"))
        self.assertGreater(len(files), 40)
        for file in files:
            with self.subTest(file=str(file.relative_to(TESTS))):
                self.assertEqual(hidden_in(ast.parse(file.read_text(encoding="utf-8")).body), [])


if __name__ == "__main__":
    unittest.main()
