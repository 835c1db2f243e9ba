"""Changes lines of the library, one at a time, and says which test notices.

    tests/mutations/run.py FOLDER              # all entries of mutations.py
    tests/mutations/run.py FOLDER 4 17         # those two

A copy of the sources in FOLDER gets all changes at once, each behind a switch, SCABO_MUTATION=number: one build, and no
file of this tree is touched. Then the tests named beside each change run with its switch; a change that they do not
notice is listed as SURVIVES. Entry 0 is no change: its tests must pass.

Nothing runs this with the tests. Run it after larger changes, and add an entry for a part that is new: an entry whose
line has changed is listed and left out.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from mutations import MUTATIONS

ROOT = Path(__file__).resolve().parents[2]
SWITCH = """#pragma once
#include <cstdlib>
namespace scabo {
inline bool mutated(int k) {
  static const int which = [] {
    const char* given = std::getenv("SCABO_MUTATION");
    return given ? std::atoi(given) : 0;
  }();
  return which == k;
}
}  // namespace scabo
"""


def copy(to):
    """The files that git knows, where they differ; the library of the copy is then changed."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    changed = {}
    for number, (file, original, replacement, _) in MUTATIONS.items():
        path = f"src/scabo/{file}"
        text = changed.get(path) or (ROOT / path).read_text()
        if text.count(original) != 1:
            print(f"{number}: {path} does not contain this line once: {original}")
            continue
        changed[path] = text.replace(original, re.sub(r"\bMUTATED\b", f"mutated({number})", replacement))
    for path, text in changed.items():
        first = text.index("#include")
        changed[path] = text[:first] + '#include "scabo/base/mutated.hpp"\n' + text[first:]
    changed["src/scabo/base/mutated.hpp"] = SWITCH
    for name in filter(None, names.split("\0")):
        if name in changed or not (ROOT / name).is_file():
            continue
        there = to / name
        if not there.exists() or there.read_bytes() != (ROOT / name).read_bytes():
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, there)
    for name, text in changed.items():
        there = to / name
        there.parent.mkdir(parents=True, exist_ok=True)
        if not there.exists() or there.read_text() != text:
            there.write_text(text)


def build(to, targets):
    subprocess.run(["cmake", "--preset", "release", "-S", "."], cwd=to, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "build", "--target", *sorted(targets)], cwd=to, check=True)


def command_of(to, test):
    """`program filter` of GoogleTest, or the path of a Python test."""
    program, _, only = test.partition(" ")
    if not program.endswith(".py"):
        return [to / "build/tests" / program, f"--gtest_filter={only or '*'}", "--gtest_fail_fast", "--gtest_brief=1"]
    uses = "build/tests/result_sample" if "read_vtu" in program else "build/bin/scabo"
    return [sys.executable, to / program, to / uses]


def target_of(test):
    program = test.split()[0]
    return "result_sample" if "read_vtu" in program else "scabo_program" if program.endswith(".py") else program


def noticed_by(to, number, test):
    """Name of the first test that fails; empty if none does."""
    ended = subprocess.run(command_of(to, test), cwd=to, capture_output=True, text=True,
                           env={**os.environ, "SCABO_MUTATION": str(number), "SCABO": str(to / "build/bin/scabo"),
                                "OPENBLAS_NUM_THREADS": "1"})
    if ended.returncode == 0:
        return ""
    output = ended.stdout + ended.stderr
    failed = re.search(r"\[  FAILED  \] (\S+)", output) or re.search(r"(?:FAIL|ERROR): (\S+)", output)
    return failed.group(1).rstrip(",") if failed else f"{test}, status {ended.returncode}"


def main():
    to = Path(sys.argv[1]).resolve()
    wanted = [int(number) for number in sys.argv[2:]] or list(MUTATIONS)
    copy(to)
    build(to, {target_of(MUTATIONS[number][3]) for number in wanted})
    survivors = 0
    for number in wanted:
        file, _, _, test = MUTATIONS[number]
        if by := noticed_by(to, 0, test):
            sys.exit(f"{by} fails without any change")
        by = noticed_by(to, number, test)
        survivors += not by
        print(f"{number:4} {file:40} {by or 'SURVIVES ' + test}", flush=True)
    sys.exit(1 if survivors else 0)


if __name__ == "__main__":
    main()
