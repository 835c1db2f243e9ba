"""Lengths of functions: none in the program, the library or its bindings is longer than 60 lines.

    check_lengths.py [ROOT]         checks the project at ROOT (default: this one)
    check_lengths.py --self-test    shows that the check finds long functions

It reads the layout that clang-format gives: a function ends with a line `}` at its own indentation, and begins at the
last line before it with that indentation. Functions are at the indentation 0, members in a class two deeper. Classes,
enums and tables of data end with `};`, namespaces with their name in a comment.
"""

import pathlib
import re
import sys
import unittest

MOST = 60  # lines, from the first one of its head to its last brace
FOLDERS = ("src", "apps", "compare", "python")
SUFFIXES = {".hpp", ".cpp"}
CLASS = re.compile(r"\b(class|struct|union)\b")
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)


def files(root):
    return sorted(path for folder in FOLDERS for path in (root / folder).rglob("*") if path.suffix in SUFFIXES)


def without_raw_strings(text):
    """Lines of raw strings have any indentation: the text with lines of their number in place of them."""
    return RAW_STRING.sub(lambda found: '""' + "\n" * found[0].count("\n"), text)


def functions(lines, first=0, indentation=0):
    """First and last line, from 0, of each function that is at this indentation or in a class there; the first is None
    if it is not found."""
    head = None
    for number in range(first, len(lines)):
        line = lines[number]
        own = len(line) - len(line.lstrip(" "))
        text = line.strip() if line.startswith("}  // namespace") else line.split("  //")[0].strip()
        if not text or text.startswith(("#", "//")):
            continue
        if own < indentation and text.startswith("}"):
            return
        if own != indentation:
            continue
        if text == "}":
            yield head, number
        elif text.endswith("{") and CLASS.search(text) and not text.endswith("= {"):
            yield from functions(lines, number + 1, indentation + 2)
        if not text.startswith("}"):
            head = number
        elif not text.endswith("{"):  # `} catch (...) {` belongs to the function before it
            head = None


def long_functions(root):
    """Every long function below `root`, as `file:line: reason`, and the number of all functions."""
    found, count = [], 0
    for path in files(root):
        lines = without_raw_strings(path.read_text(encoding="utf-8")).split("\n")
        for first, last in functions(lines):
            count += 1
            where = f"{path.relative_to(root)}:{(last if first is None else first) + 1}: "
            if first is None:
                found.append(where + "a brace in the place of a function's end, without the function: run make format")
            elif last - first + 1 > MOST:
                found.append(where + f"{last - first + 1} lines, more than {MOST}: {lines[first].strip()}")
    return found, count


class SelfTest(unittest.TestCase):
    TEXT = '''
namespace scabo {

namespace {

enum class Kind {
  one,
};

constexpr int numbers[] = {
    1,
};

constexpr const char* text = R"(
void no_function() {
}
)";

template <typename T>
int sum(const T& first,
        const T& second) {
  return first + second;
}

}  // namespace

class Body : public Base {
 public:
  Body(int count)
      : count_(count) {
    prepare();
  }

  struct Part {
    int size() const {
      return 1;
    }
  };

 private:
  void prepare();
  struct {
    int a;
  } more_;
};

int Body::one_line() { return 1; }

void Body::prepare() try {
#if NDEBUG
  check();
#endif
} catch (const Error&) {  // of a check
  report();
}

}  // namespace scabo
'''

    @staticmethod
    def lengths(text):
        lines = without_raw_strings(text).split("\n")
        return {lines[first].strip().split("(")[0]: last - first + 1 for first, last in functions(lines)}

    def test_functions_of_a_file(self):
        self.assertEqual(self.lengths(self.TEXT), {"int sum": 4, "Body": 4, "int size": 3, "void Body::prepare": 7})

    def test_a_longer_function_is_found(self):
        for line, name in (("  return first", "int sum"), ("    prepare();", "Body"), ("      return 1;", "int size"),
                           ("  report();", "void Body::prepare")):
            with self.subTest(name):
                longer = self.TEXT.replace(line, "\n" * 60 + line)
                self.assertEqual(self.lengths(longer)[name], self.lengths(self.TEXT)[name] + 60)


def main():
    if sys.argv[1:] == ["--self-test"]:
        unittest.main(argv=sys.argv[:1])
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    found, count = long_functions(root)
    for line in found:
        print(line, file=sys.stderr)
    if count == 0:
        sys.exit(f"no function below {root}")
    print(f"{count} functions, {len(found)} longer than {MOST} lines or not found")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
