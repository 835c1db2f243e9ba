"""The patterns of mutate.py change code, and neither comments nor texts."""
import unittest

from mutate import mutants_of


def changed(line):
    return [becomes for _, becomes in mutants_of(line)]


class Patterns(unittest.TestCase):
    def test_code_is_changed(self):
        self.assertEqual(changed("  return a + b;"), ["  return a - b;"])
        self.assertEqual(changed("  sum += w;"), ["  sum -= w;", ""])
        self.assertEqual(changed("  if (gap > 0.0) return {};"), ["  if (gap >= 0.0) return {};", ""])
        self.assertEqual(changed("  const double h = std::max(a, b);"), ["  const double h = std::min(a, b);"])

    def test_the_rest_is_not(self):
        for line in ("// a + b", "#include <a + b>", '  print("a + b");', "  std::vector<double> a;", "  const Vector x = y;"):
            with self.subTest(line=line):
                self.assertEqual(changed(line), [])
        self.assertEqual(changed('  print(a + b, "a + b");  // a + b'), ['  print(a - b, "a + b");  // a + b'])


if __name__ == "__main__":
    unittest.main()
