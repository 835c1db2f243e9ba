"""Docstrings: everything public has one, those of the extension module are the comments of the C++ code, and its stubs
name what it has."""
import ast
import importlib
import inspect
import re
import unittest

import scabo
from scabo import _core
from support import ROOT

STUBS = ast.parse((ROOT / "python" / "scabo" / "_core.pyi").read_text(encoding="utf-8"))
MODULES = [scabo, _core] + [importlib.import_module(f"scabo.{name}") for name in ("plot", "report")]


def words(text):
    return " ".join(re.sub("[`']", "", text).split()).lower().rstrip(".")


def described(thing):
    """The docstring without the signature that pybind11 puts first."""
    doc = thing.__doc__ or ""
    if re.match(r"\w+\(.*\) -> .*\n", doc):
        doc = doc.partition("\n")[2]
    return doc.strip()


def members(kind):
    """Public methods and properties of a class, and the constructor of an extension class that has one."""
    for name, value in vars(kind).items():
        if name.startswith("_") and not (name == "__init__" and (value.__doc__ or "").startswith("__init__(")):
            continue
        if callable(value) or isinstance(value, (property, classmethod, staticmethod)):
            yield name, getattr(value, "__func__", value)


def public():
    """(name, thing) of everything public."""
    for module in MODULES:
        yield module.__name__, module
        for name in getattr(module, "__all__", dir(module)):
            thing = getattr(module, name)
            if name.startswith("_") or isinstance(thing, str) or not callable(thing):
                continue
            yield f"{module.__name__}.{name}", thing
            if inspect.isclass(thing):
                for member, value in members(thing):
                    yield f"{module.__name__}.{name}.{member}", value


def comments():
    """All comments of the bindings, and of the headers of the library that they show."""
    build = (ROOT / "python" / "CMakeLists.txt").read_text(encoding="utf-8")
    headers = re.search(r"foreach\(name (analysis/[^)]*)\)", build).group(1).split()
    sources = [*(ROOT / "python" / "bindings").iterdir(), *(ROOT / "src" / "scabo" / f"{name}.hpp" for name in headers)]
    blocks = []
    for source in sources:
        text = source.read_text(encoding="utf-8")
        blocks += re.findall(r"(?://[/<]* .*)", text)
        blocks += [re.sub(r"(?m)^\s*/// ?", " ", block) for block in re.findall(r"(?m)(?:^\s*///.*\n)+", text)]
    return {words(re.sub(r"^//[/<]*", "", block)) for block in blocks}


class Docstrings(unittest.TestCase):
    def test_everything_public_has_one(self):
        names = [name for name, _ in public()]
        self.assertGreater(len(names), 150)
        self.assertEqual([name for name, thing in public() if len(described(thing).split()) < 2], [])

    def test_those_of_the_extension_module_are_the_comments_of_the_code(self):
        """As the build makes them, without a second copy: python/make_docstrings.py."""
        known = comments()
        shown = [(name, thing) for name, thing in public() if name.startswith("scabo._core.")]
        self.assertGreater(len(shown), 60)
        self.assertEqual([name for name, thing in shown if words(described(thing)) not in known], [])

    def test_arrays_have_a_shape_and_what_has_a_direction_a_sign(self):
        for kind, name, expected in ((_core.StaticResult, "pairs", "compression positive"),
                                     (_core.StaticResult, "values", "positive in tension"),
                                     (_core.StaticResult, "displacement", "(nodes, 2), length"),
                                     (_core.DiscreteSolution, "forces", "compression positive"),
                                     (_core.DiscreteSolution, "gap", "positive if open"),
                                     (_core.SuperElement, "stiffness", "n x n, force / length"),
                                     (_core.ModalResult, "nodes", "(nodes, 2), length")):
            self.assertIn(expected, " ".join(described(vars(kind)[name]).split()), name)


class Stubs(unittest.TestCase):
    def assert_same_arguments(self, stub, thing, name):
        """Names and order of the arguments, as pybind11 writes them into the docstring."""
        signature = thing.__doc__.partition("\n")[0]
        inside = signature[signature.index("(") + 1:signature.rindex(") ->")]
        real = re.findall(r"(?:^|, )(\w+):", re.sub(r"\[[^\[\]]*\]", "", re.sub(r"\[[^\[\]]*\]", "", inside)))
        self.assertEqual([argument.arg for argument in stub.args.args], real, name)

    def test_arguments(self):
        functions = 0
        for part in STUBS.body:
            if isinstance(part, ast.FunctionDef):
                self.assert_same_arguments(part, getattr(_core, part.name), part.name)
                functions += 1
            for item in part.body if isinstance(part, ast.ClassDef) else ():
                thing = vars(getattr(_core, part.name)).get(getattr(item, "name", None))
                if isinstance(item, ast.FunctionDef) and not isinstance(thing, property):
                    self.assert_same_arguments(item, thing, f"{part.name}.{item.name}")
                    functions += 1
        self.assertGreater(functions, 15)


if __name__ == "__main__":
    unittest.main()
