"""Random models and their twins.

    run.py SCABO [--from SEED] [--count N] [--known FILE] [--keep DIR] [--seconds S]

prints a line for each model, and at the end how many passed. A model passes if its twins agree with it. Those that do not
are kept below DIR with all twins and their results. FILE lists known failures, a line for each twin: seed, twin, what
differs, and why; a twin that it lists must fail."""
import argparse
import pathlib
import shutil
import sys
import tempfile

import compare
import dress
from change import Change
from outcome import run, write
from twins import same_mesh_when_turned, twin_dice, twins


def main():
    arguments = parse()
    known, keep = read_known(arguments.known), pathlib.Path(arguments.keep)
    passed, failed, refused, seconds = 0, [], 0, 0.0
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        with tempfile.TemporaryDirectory(prefix="scabo_random_") as folder:
            report = Report(seed, pathlib.Path(folder), known.get(seed, {}))
            report.make(arguments.scabo)
            print(report.line(), flush=True)
            seconds += report.seconds
            refused += report.base.status == "refused"
            if report.bad():
                failed.append(seed)
                shutil.copytree(folder, keep / f"seed_{seed}", dirs_exist_ok=True)
                (keep / f"seed_{seed}" / "differences.txt").write_text(report.text(), encoding="utf-8")
            else:
                passed += 1
    print(f"{seconds:.0f} s of the processor" + (f"; {refused} models were refused" if refused else ""))
    if failed:
        print(f"Failed: {' '.join(map(str, failed))}. Models, results and differences are in {keep.resolve()}.")
    print(f"{passed} passed, {len(failed)} failed")
    return 1 if failed else 0


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scabo", help="the program")
    parser.add_argument("--from", dest="seed", type=int, default=1, help="first seed")
    parser.add_argument("--count", type=int, default=50, help="how many seeds")
    parser.add_argument("--known", default=pathlib.Path(__file__).with_name("known.txt"), help="list of known failures")
    parser.add_argument("--keep", default="random.failed", help="directory for models that fail")
    return parser.parse_args()


def read_known(path):
    """By seed and twin: the reason."""
    found = {}
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            seed, twin, reason = line.split(maxsplit=2)
            found.setdefault(int(seed), {})[twin] = reason
    return found


class Report:
    """One model and its twins: what differs, by twin."""

    def __init__(self, seed, folder, known):
        self.seed, self.folder, self.known = seed, folder, known
        self.found, self.seconds, self.family, self.base = {}, 0.0, "", None

    def make(self, program):
        self.family, model = dress.model(self.seed)
        self.bodies = len(model["bodies"])
        self.base = self.solve(program, "base", model, Change(), model)
        for name, (twin, change) in twins(model, twin_dice(self.seed)).items():
            other = self.solve(program, name, twin, change, model)
            strict = name in ("units", "reordered") or name == "turned" and self.turns(model, change)
            self.found[name] = compare.differences(self.base, other, strict)
            if other.status == "refused" and self.found[name]:
                self.found[name].append(other.reason)

    def solve(self, program, name, model, change, base):
        path = self.folder / f"{name}.yaml"
        write(model, path)
        outcome = run(program, path, change, base)
        self.seconds += outcome.seconds
        return outcome

    def turns(self, model, change):
        one_cell = sum(body.get("mesh", {}).get("kind", "superelement") == "superelement" for body in model["bodies"].values() if "mesh" in body)
        return same_mesh_when_turned(model, change) and self.base.cells == one_cell

    def bad(self):
        return any(bool(differences) != (name in self.known) for name, differences in self.found.items())

    def line(self):
        twin = lambda name: f"{name}: {self.found[name][0]}" + (" (known)" if name in self.known else "")
        wrong = [twin(name) for name in self.found if self.found[name]]
        wrong += [f"{name} passes now: remove its line from the list" for name in self.known if not self.found[name]]
        state = self.base.status + (f" ({self.base.reason[:100]})" if self.base.status in ("refused", "failed", "crashed") else "")
        return f"{self.seed:6} {self.family:8} {self.bodies} bodies, {state}, {self.seconds:.1f} s; " + ("; ".join(wrong) or "twins agree")

    def text(self):
        return "\n".join([self.line(), self.base.reason, *(f"{name}:\n  " + "\n  ".join(found[:30]) for name, found in self.found.items() if found)]) + "\n"


if __name__ == "__main__":
    sys.exit(main())
