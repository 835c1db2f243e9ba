"""The include rule (ARCHITECTURE.md): each part of src/scabo includes only the parts in its row below.

    check_includes.py [ROOT]         checks the project at ROOT (default: this one)
    check_includes.py --self-test    shows that the check finds violations
"""

import pathlib
import re
import sys
import tempfile
import unittest

# In the order of the data's journey. A part always includes itself.
ALLOWED = {
    "base": [],
    "linalg": ["base"],
    "contact": ["base", "linalg"],
    "geometry": ["base"],
    "files": ["base"],
    "model": ["base", "geometry", "files"],
    "convert": ["base", "geometry", "files", "model"],
    "input": ["base", "geometry", "files", "model"],
    "mesh": ["base", "geometry", "files", "model"],
    "element": ["base", "linalg", "geometry", "files", "model", "mesh"],
    "system": ["base", "linalg", "contact", "geometry", "files", "model", "mesh", "element"],
    "analysis": ["base", "linalg", "contact", "geometry", "files", "model", "mesh", "element", "system"],
    "result": ["base", "geometry", "files", "model", "mesh", "element", "analysis"],
    "run": ["base", "linalg", "contact", "geometry", "files", "model", "mesh", "element", "system", "analysis", "result"],
    "compare": ["base", "linalg", "contact"],  # beside src, for comparison
}

# Headers that `result` includes although it never includes a solver: plain values, and the loop over threads. They
# include only base/ and each other.
PLAIN_VALUES = ["linalg/parallel.hpp", "contact/delassus.hpp", "contact/rigid_map.hpp", "contact/problem.hpp",
                "contact/solution.hpp", "contact/certificate.hpp"]

# Rooms of a part, in order: each includes itself and those before it, and never a file beside the rooms, which composes
# them. Schemes of the march never include each other.
ROOMS = {"element": ["sbfem", "facet", "plane", "space"],
         "analysis": ["state", "diagnostics", "march", "quasistatic", "dynamics", "modal", "growth", "adaptive", "space"]}
SCHEMES = ["quasistatic", "dynamics", "modal"]
# Rooms that never include each other; what they share stands beside them.
APART = {"mesh": ["plane", "space"]}
# A room that may include fewer parts than the part it belongs to: the algebra of super-elements knows no coordinates.
ALLOWED_IN_ROOM = {"element/sbfem": ["base", "linalg"]}

SUFFIXES = {".hpp", ".cpp", ".h", ".cc"}
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SUFFIXES)


def includes(path):
    """Line number, whether quoted, and name of every include."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1] == '"', match[2]


def violation_of_part(part, header, included):
    """Why a file `header` (as in `contact/problem.hpp`) of `part` may not include `included`; None if it may."""
    target = included.split("/")[0]
    if target not in ALLOWED:
        return f"'{target}' is no part of src/scabo"
    if header in PLAIN_VALUES:
        if target == "base" or included in PLAIN_VALUES:
            return None
        return "a header of plain values includes only base/ and other plain values"
    if target == part:
        return violation_of_room(part, header, included)
    room = "/".join(header.split("/")[:2])
    if target not in ALLOWED_IN_ROOM.get(room, ALLOWED[part]) and target in ALLOWED[part]:
        return f"{room}/ may include {', '.join(f'{name}/' for name in ALLOWED_IN_ROOM[room])}, not {target}/"
    if target in ALLOWED[part] or (part == "result" and included in PLAIN_VALUES):
        return None
    allowed = ", ".join(f"{name}/" for name in ALLOWED[part]) or "no other part"
    return f"{part}/ may include {allowed}, not {target}/"


def violation_of_room(part, header, included):
    """The same for two files of one part."""
    rooms = ROOMS.get(part, [])
    own, target = (name.split("/")[1] for name in (header, included))
    if own != target and own in APART.get(part, []) and target in APART.get(part, []):
        return f"{part}/{own}/ and {part}/{target}/ do not include each other"
    if own not in rooms:
        return None
    if target not in rooms:
        return f"{part}/{own}/ may not include what composes the rooms of {part}/"
    before = rooms[: rooms.index(own) + 1]
    if target in before and not (own in SCHEMES and target in SCHEMES and own != target):
        return None
    return f"{part}/{own}/ may not include {part}/{target}/"


def violations(root):
    """Every violation below `root`, as `file:line: reason`."""
    source = root / "src"
    found = []
    for folder in ("src", "compare", "apps", "python", "tests", "benchmarks", "examples"):
        for path in files(root / folder):
            own = path.relative_to(source / "scabo" if folder == "src" else root).as_posix()
            if folder not in ("src", "compare"):
                own = None
            part = own.split("/")[0] if own else None
            if part is not None and part not in ALLOWED:
                found.append(f"{path.relative_to(root)}:1: not in a part of src/scabo")
                continue
            for number, quoted, name in includes(path):
                where = f"{path.relative_to(root)}:{number}: {name}: "
                if not quoted:
                    if name.startswith("scabo/") and folder != "tests":
                        found.append(where + "our own headers are included in quotes")
                    continue
                if name.startswith("compare/") and folder not in ("src", "examples"):
                    if not (root / name).is_file():
                        found.append(where + "no such header")
                elif not name.startswith("scabo/"):
                    # A test or a program may share helpers with its neighbours; the library may not.
                    beside = [path.parent / name, root / folder / name]
                    if own or not any(file.is_file() for file in beside):
                        found.append(where + 'quotes are for "scabo/..." (others: <...>)')
                elif not (source / name).is_file():
                    found.append(where + "no such header")
                elif own:
                    if reason := violation_of_part(part, own, name.removeprefix("scabo/")):
                        found.append(where + reason)
    return found


class SelfTest(unittest.TestCase):
    """A small tree that keeps the rule, and one violation at a time."""

    TREE = {
        "base/types.hpp": [],
        "linalg/dense.hpp": ["base/types.hpp"],
        "contact/problem.hpp": ["base/types.hpp"],
        "contact/solution.hpp": ["contact/problem.hpp"],
        "contact/newton.hpp": ["contact/problem.hpp", "linalg/dense.hpp"],
        "model/model.hpp": ["base/types.hpp"],
        "input/read.hpp": ["model/model.hpp"],
        "mesh/mesh.hpp": ["model/model.hpp"],
        "mesh/plane/quadtree.hpp": ["mesh/mesh.hpp"],
        "mesh/space/solid.hpp": ["model/model.hpp"],
        "element/sbfem/doubling.hpp": ["linalg/dense.hpp"],
        "element/facet/ring.hpp": ["element/sbfem/doubling.hpp", "mesh/mesh.hpp"],
        "element/plane/law.hpp": ["element/facet/ring.hpp"],
        "element/stiffness.hpp": ["element/plane/law.hpp", "mesh/mesh.hpp", "linalg/dense.hpp"],
        "system/system.hpp": ["element/stiffness.hpp", "contact/newton.hpp"],
        "analysis/state/state.hpp": ["system/system.hpp"],
        "analysis/march/steps.hpp": ["analysis/state/state.hpp"],
        "analysis/quasistatic/run.hpp": ["analysis/march/steps.hpp", "analysis/state/state.hpp"],
        "analysis/modal/modal.hpp": ["analysis/march/steps.hpp"],
        "analysis/static.hpp": ["analysis/quasistatic/run.hpp", "system/system.hpp"],
        "result/tables.hpp": ["contact/solution.hpp", "mesh/mesh.hpp", "analysis/static.hpp"],
    }

    def check(self, file=None, line=None):
        """Violations of TREE with `line` written at the end of `file` (from the root of the project)."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            texts = {f"src/scabo/{name}": [f'#include "scabo/{other}"' for other in others]
                     for name, others in self.TREE.items()}
            texts["apps/scabo/main.cpp"] = ["#include <vector>", '#include "scabo/contact/newton.hpp"']
            texts["tests/unit/helper.hpp"] = []
            texts["tests/unit/test.cpp"] = ['#include "helper.hpp"', '#include "unit/helper.hpp"']
            if file is not None:
                texts.setdefault(file, []).append(line)
            for name, lines in texts.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text("\n".join(lines), encoding="utf-8")
            return violations(root)

    def test_tree_that_keeps_the_rule(self):
        self.assertEqual(self.check(), [])

    def test_one_violation_at_a_time(self):
        for file, line, reason in [
            ("src/scabo/contact/newton.hpp", '#include "scabo/model/model.hpp"', "not model/"),
            ("src/scabo/model/read.cpp", '#include "scabo/linalg/dense.hpp"', "not linalg/"),
            ("src/scabo/mesh/mesh.cpp", '#include "scabo/linalg/dense.hpp"', "not linalg/"),
            ("src/scabo/mesh/mesh.cpp", '  #  include "scabo/contact/problem.hpp"', "not contact/"),
            ("src/scabo/mesh/space/solid.hpp", '#include "scabo/mesh/plane/quadtree.hpp"', "do not include each other"),
            ("src/scabo/linalg/dense.cpp", '#include "scabo/mesh/mesh.hpp"', "not mesh/"),
            ("src/scabo/base/log.cpp", '#include "scabo/linalg/dense.hpp"', "no other part"),
            ("src/scabo/system/load.cpp", '#include "scabo/analysis/static.hpp"', "not analysis/"),
            ("src/scabo/element/sbfem/doubling.hpp", '#include "scabo/element/facet/ring.hpp"', "not include element/facet/"),
            ("src/scabo/element/sbfem/doubling.hpp", '#include "scabo/element/plane/law.hpp"', "not include element/plane/"),
            ("src/scabo/element/sbfem/doubling.hpp", '#include "scabo/mesh/mesh.hpp"', "not mesh/"),
            ("src/scabo/element/facet/ring.hpp", '#include "scabo/element/plane/law.hpp"', "not include element/plane/"),
            ("src/scabo/element/plane/law.hpp", '#include "scabo/element/stiffness.hpp"', "composes the rooms"),
            ("src/scabo/analysis/state/state.hpp", '#include "scabo/analysis/march/steps.hpp"', "not include analysis/march/"),
            ("src/scabo/analysis/march/steps.hpp", '#include "scabo/analysis/static.hpp"', "composes the rooms"),
            ("src/scabo/analysis/modal/modal.hpp", '#include "scabo/analysis/quasistatic/run.hpp"',
             "not include analysis/quasistatic/"),
            ("src/scabo/result/vtu.cpp", '#include "scabo/contact/newton.hpp"', "not contact/"),
            ("src/scabo/result/vtu.cpp", '#include "scabo/linalg/dense.hpp"', "not linalg/"),
            ("src/scabo/result/vtu.cpp", '#include "scabo/system/system.hpp"', "not system/"),
            ("src/scabo/contact/solution.hpp", '#include "scabo/linalg/dense.hpp"', "plain values"),
            ("src/scabo/mesh/mesh.cpp", '#include "scabo/mesh/missing.hpp"', "no such header"),
            ("src/scabo/mesh/mesh.cpp", '#include "mesh.hpp"', "quotes are for"),
            ("src/scabo/mesh/mesh.cpp", "#include <scabo/mesh/mesh.hpp>", "in quotes"),
            ("src/scabo/gadgets/new.hpp", "", "not in a part"),
            ("src/scabo/stray.hpp", "", "not in a part"),
            ("src/scabo/contact/newton.hpp", '#include "compare/solvers.hpp"', "quotes are for"),
            ("compare/solvers.cpp", '#include "scabo/mesh/mesh.hpp"', "not mesh/"),
            ("apps/scabo/main.cpp", '#include "compare/gone.hpp"', "no such header"),
            ("src/scabo/model/model.hpp", '#include "scabo/input/read.hpp"', "not input/"),
            ("apps/scabo/main.cpp", '#include "scabo/gone.hpp"', "no such header"),
            ("tests/unit/test.cpp", '#include "gone.hpp"', "quotes are for"),
        ]:
            with self.subTest(file=file, line=line):
                found = self.check(file, line)
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(file + ":"), found)
                self.assertIn(reason, found[0])


def main():
    if sys.argv[1:] == ["--self-test"]:
        unittest.main(argv=sys.argv[:1])
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    found = violations(root)
    for line in found:
        print(line, file=sys.stderr)
    checked = len(files(root / "src"))
    if checked == 0:
        sys.exit(f"no source below {root / 'src'}")
    print(f"{checked} files of src/scabo, {len(found)} violations of the include rule")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
