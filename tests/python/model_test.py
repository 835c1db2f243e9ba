"""Models: the same messages as the program for files, for changed models and for those built in Python.

    model_test.py FOLDER_OF_BROKEN_MODELS
"""
import ast
import copy
import json
import os
import pathlib
import pickle
import re
import sys
import unittest

import numpy as np
import yaml

import scabo
from support import BEAM, ROOT, InTemporaryDirectory, block, program

BAD = pathlib.Path(sys.argv.pop(1))
GOOD = ROOT / "tests" / "input" / "good"


class Yaml12(yaml.SafeLoader):
    """1e9 is a number and `on` a word, as in YAML 1.2 and for Scabo."""


Yaml12.yaml_implicit_resolvers = {}
for kind, pattern, first in (("bool", r"true|false", "tf"), ("null", r"~|null|", ["~", "n", ""]),
                             ("int", r"[-+]?[0-9]+", "-+0123456789"),
                             ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", "-+.0123456789"),
                             ("merge", "<<", "<")):
    Yaml12.add_implicit_resolver(f"tag:yaml.org,2002:{kind}", re.compile(f"^(?:{pattern})$"), list(first))


def problems_of(run):
    """The mistakes in a model, by `run()`; empty if there are none."""
    try:
        run()
    except scabo.ModelError as error:
        return error
    return None


class BrokenFiles(unittest.TestCase):
    def test_every_file(self):
        """As files, with the text of the program. As dictionaries, as far as another reader of YAML can read them: the same
        paths, without lines."""
        files = sorted(BAD.glob("*.yaml"))
        as_file = as_dictionary = 0
        for file in files:
            with self.subTest(file=file.name):
                done = program("check", file)
                error = problems_of(lambda: scabo.read(file).check())
                if done.returncode == 0:  # found by `scabo run` only
                    self.assertIsNone(error)
                    continue
                as_file += 1
                self.check_text(file, error, done.stderr)
                as_dictionary += self.check_dictionary(file, error, done.stderr)
        self.assertGreaterEqual(as_file, 0.8 * len(files))
        self.assertGreaterEqual(as_dictionary, 0.7 * len(files))

    def check_text(self, file, error, expected):
        self.assertEqual(f"{error}\n", expected)
        self.assertEqual(error.file, str(file))
        lines = []
        for path, line, column, text in error.problems:
            place = f":{line}:{column}" if line else ""
            lines.append(f"{file}{place}: {path + ': ' if path else ''}{text}\n")
        self.assertEqual("".join(lines), expected)

    def check_dictionary(self, file, error, expected):
        """Whether the file is a dictionary with the same mistakes."""
        if file.name.startswith("syntax_") or file.name == "later_copies_of_too_many_nodes.yaml":  # seconds
            return False
        try:
            data = yaml.load(file.read_text(encoding="utf-8"), Loader=Yaml12)
        except (yaml.YAMLError, ValueError, UnicodeDecodeError):
            return False
        if not isinstance(data, dict):
            return False
        found = problems_of(lambda: scabo.Model(data, file=file).check())
        if found is None:  # a key given twice, a tag: not in the dictionary
            self.assertRegex(expected, "given twice|tags|quotation|YAML|is read as 'on'|smaller in size")
            return False
        self.assertEqual({problem.line for problem in found.problems}, {None})
        if len(found.problems) == len(error.problems):  # more than 200 are counted only
            self.assertEqual(sorted(problem.path for problem in found.problems),
                             sorted(problem.path for problem in error.problems))
        return True


class Types(unittest.TestCase):
    def test_stubs_name_what_is_in_the_extension_module(self):
        from scabo import _core
        tree = ast.parse((ROOT / "python" / "scabo" / "_core.pyi").read_text(encoding="utf-8"))
        public = {name for name in dir(_core) if not name.startswith("_")}
        named = {part.name if isinstance(part, (ast.ClassDef, ast.FunctionDef)) else part.target.id
                 for part in tree.body if isinstance(part, (ast.ClassDef, ast.FunctionDef, ast.AnnAssign))}
        self.assertEqual(named, public)
        for part in tree.body:
            if not isinstance(part, ast.ClassDef):
                continue
            members = {item.name if isinstance(item, ast.FunctionDef) else item.target.id for item in part.body
                       if isinstance(item, (ast.FunctionDef, ast.AnnAssign))}
            real = {name for name in dir(getattr(_core, part.name)) if not name.startswith("_")}
            self.assertEqual(members - {"__init__"}, real, part.name)

    def test_everything_public_has_a_docstring(self):
        for name in scabo.__all__:
            thing = getattr(scabo, name)
            self.assertTrue(isinstance(thing, str) or thing.__doc__, name)
            for member, value in vars(thing).items() if isinstance(thing, type) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    self.assertTrue(value.__doc__, f"{name}.{member}")


class Dictionaries(InTemporaryDirectory):
    def test_a_model_built_in_python(self):
        result = scabo.Model(block()).run()
        self.assertEqual(result.status, "solved")
        self.assertAlmostEqual(result.contact["base"].normal_force, 2e7, delta=1e-3)       # equilibrium: 10 MPa over 2 m
        self.assertAlmostEqual(result.contact["base"].tangential_force, -2e6, delta=1e-4)  # the push, on B

    def test_the_bracket_of_a_limit(self):
        model = block()
        model["loads"] = {"down": {"on": "block.top", "pressure": 10e6}, "push": {"on": "block.left", "traction": [10e6, 0]}}
        model["steps"] = [{"name": "down", "loads": {"down": 1}}, {"name": "push", "limit": {"of": "push", "relative": 1e-4}}]
        result = scabo.Model(model).run()
        solved, beyond = result.limit
        self.assertLessEqual(solved, 0.6 + 1e-9)  # T = mu N: 10 MPa over 1 m, 0.3 times 10 MPa over 2 m
        self.assertGreaterEqual(beyond, 0.6 - 1e-9)
        self.assertLess(beyond - solved, 1e-4)
        self.assertEqual(result.mechanism.moving, ["block"])
        self.assertIsNone(scabo.Model(block()).run().limit)

    def test_every_good_file_as_a_dictionary(self):
        for file in sorted([*GOOD.glob("*.yaml"), *GOOD.glob("*.json")]):
            if "space" in file.stem:  # the program alone takes them
                continue
            with self.subTest(file=file.name):
                of_file = scabo.read(file)
                built = scabo.Model(yaml_free(of_file), file=file)
                self.assertEqual(built, of_file)
                self.assertEqual(built.check(), of_file.check())

    def test_numbers_survive_bit_by_bit(self):
        young = 0.1 + 0.2
        model = scabo.Model(block())
        model["materials"]["steel"]["young"] = young * 1e12
        text = scabo.Model(block())
        text["materials"]["steel"]["young"] = "0.30000000000000004e12"
        error = problems_of(text.check)
        self.assertIn("quotation marks", error.problems[0].text)  # a text is no number
        file = self.directory / "model.yaml"
        file.write_text(json.dumps(model).replace(repr(young * 1e12), "300000000000.00004"))
        np.testing.assert_array_equal(scabo.read(file).run().contact["base"].table()["slip"],
                                      model.run().contact["base"].table()["slip"])

    def test_messages_name_the_key(self):
        model = scabo.Model(block())
        model["bodies"]["block"]["material"] = "stel"
        model["contacts"]["base"]["frction"] = model["contacts"]["base"].pop("friction")
        error = problems_of(model.check)
        self.assertEqual([tuple(problem) for problem in error.problems], [
            ("bodies.block.material", None, None, "there is no material named 'stel' (did you mean 'steel'?)"),
            ("contacts.base.frction", None, None, "unknown key 'frction' (did you mean 'friction'?)")])
        self.assertTrue(str(error).startswith("model: bodies.block.material: there is no material"))
        self.assertIsInstance(error, ValueError)
        self.assertIsInstance(error, scabo.Error)

    def test_a_changed_file_keeps_the_lines_of_the_rest(self):
        model = scabo.read(BEAM)
        model["contacts"]["joint"]["friction"] = -1.0
        error = problems_of(model.run)
        [problem] = error.problems
        self.assertEqual((problem.path, problem.line), ("contacts.joint.friction", None))
        self.assertIn(str(BEAM), str(error))
        model["contacts"]["joint"]["friction"] = 0.2
        self.assertEqual(model.run().contact["joint"].normal_force, scabo.read(BEAM).run().contact["joint"].normal_force)
        del model["materials"]["concrete"]["young"]
        [problem] = problems_of(model.run).problems
        line = [number for number, text in enumerate(BEAM.read_text().splitlines(), 1) if "  concrete:" in text]
        self.assertEqual([problem.line], line)

    def test_settings(self):
        model = scabo.read(BEAM, set={"contacts.joint.friction": 0.5, "loads.tip.force": np.array([0.0, -50e3])})
        self.assertEqual(model["contacts"]["joint"]["friction"], 0.5)
        self.assertEqual(model["loads"]["tip"]["force"], [0.0, -50e3])
        for settings in ({"contacts.jiont.friction": 0.5}, {"contacts.joint.friction": -1}, {"": 1}, {"a..b": 1},
                         {"contacts.joint.friction": "[0.2"}):
            with self.subTest(settings=settings):
                words = [word for path, value in settings.items() for word in ("--set", f"{path}={value}")]
                said = program("check", BEAM, *words).stderr.removeprefix("scabo: ")  # the program's name is its own
                self.assertEqual(f"{problems_of(lambda: scabo.read(BEAM, set=settings))}\n", said)
        with self.assertRaisesRegex(TypeError, "contacts.joint.friction"):
            scabo.read(BEAM, set={"contacts.joint.friction": object()})
        with self.assertRaisesRegex(TypeError, "set must be a dictionary, as in .*, not str"):
            scabo.read(BEAM, set="contacts.joint.friction=0.5")
        self.assertEqual(scabo.read(BEAM, set={"contacts.joint.friction": None})["contacts"]["joint"], {"between": ["lower.top", "upper.bottom"]})

    def test_values_that_no_model_contains(self):
        for value, path in ((object(), "contacts.base.friction"), ({1, 2}, "contacts.base.friction"),
                            (1j, "contacts.base.friction")):
            model = scabo.Model(block())
            model["contacts"]["base"]["friction"] = value
            with self.assertRaisesRegex(TypeError, re.escape(path)):
                model.check()
        for text in ("wrong \udcff", pathlib.Path(os.fsdecode(b"wrong \xff"))):  # a name of a file that is not UTF-8
            model = scabo.Model(block())
            model["title"] = text
            with self.assertRaisesRegex(ValueError, r"^title: the text 'wrong \\udcff' cannot be written in UTF-8$"):
                model.check()
        model = scabo.Model(block())
        model["materials"]["\udcff"] = {}
        with self.assertRaisesRegex(ValueError, r"^materials: the text '\\udcff' cannot"):
            model.check()
        for value in (float("nan"), float("inf"), 1e200, None):
            model = scabo.Model(block())
            model["loads"]["push"]["traction"] = [value, 0.0]
            self.assertEqual(problems_of(model.check).problems[0].path, "loads.push.traction.0")
        model = scabo.Model(block())
        model["bodies"]["block"]["mesh"]["self"] = model["bodies"]
        self.assertIn("deeper than", problems_of(model.check).problems[0].text)
        model = scabo.Model(block())
        model[("a",)] = 1
        with self.assertRaisesRegex(TypeError, "key"):
            model.check()
        self.assertIsNotNone(problems_of(scabo.Model().check))

    def test_numbers_of_numpy(self):
        model = scabo.Model(block())
        model["bodies"]["block"]["shape"] = {"polygon": {"vertices": np.array([[0, 0], [2, 0], [2, 1], [0, 1]])}}
        model["contacts"]["base"]["between"] = ("floor.top", "block.edge_1")
        model["contacts"]["base"]["friction"] = np.float64(0.3)
        model["loads"]["push"]["on"] = "block.edge_3"
        model["bodies"]["floor"]["rigid"] = np.bool_(True)
        self.assertAlmostEqual(model.run().contact["base"].normal_force, 2e7, delta=1e-3)

    def test_copies_are_independent(self):
        data = block()
        one, other = scabo.Model(data), scabo.Model(data)
        one["contacts"]["base"]["friction"] = 0.9
        self.assertEqual((data["contacts"]["base"]["friction"], other["contacts"]["base"]["friction"]), (0.3, 0.3))
        read = scabo.read(BEAM)
        for twin in (read.copy(), copy.copy(read), copy.deepcopy(read), pickle.loads(pickle.dumps(read))):
            self.assertIsInstance(twin, scabo.Model)
            self.assertEqual((twin, twin.file), (read, read.file))
            twin["contacts"]["joint"]["friction"] = 0.9
            self.assertEqual(read["contacts"]["joint"]["friction"], 0.2)

    def test_files_that_a_model_names_are_beside_it(self):
        model = scabo.read(GOOD / "mesh_file.yaml")
        self.assertEqual(scabo.Model(model, file=GOOD / "built").check(), model.check())
        self.assertIsNotNone(problems_of(scabo.Model(model, file=self.directory / "built").check))

    def test_errors_can_be_sent_to_other_processes(self):
        error = problems_of(lambda: scabo.read(BEAM, set={"contacts.joint.friction": -1}))
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((str(again), again.problems, again.file), (str(error), error.problems, error.file))

    def test_sizes_are_those_of_the_program(self):
        sizes = scabo.read(BEAM).check()
        self.assertIn(f"{sizes.bodies} bodies, {sizes.nodes} nodes, {sizes.dofs} degrees of freedom, "
                      f"{sizes.super_elements} super-elements, {sizes.contact_pairs} contact pairs",
                      program("check", BEAM).stdout)
        self.assertEqual(sizes.contacts, {"joint": sizes.contact_pairs})

    def test_schema(self):
        self.assertEqual(scabo.schema(), json.loads(program("schema").stdout))


def yaml_free(model):
    """The same without what the class adds."""
    return json.loads(json.dumps(model))


if __name__ == "__main__":
    unittest.main()
