"""Changes lines of the library, one at a time, and says which test notices.

    tests/mutations/run.py FOLDER              # all entries of mutations.py
    tests/mutations/run.py FOLDER 4 17         # those two

A copy of the sources in FOLDER gets all of these changes at once, each behind a switch, SCABO_MUTATION=number: one build, and
no file of this tree is touched. Then the tests named beside each change run with its switch; a change that they do not
notice is listed as SURVIVES. Entry 0 is no change: its tests must pass.

Nothing runs this with the tests. Run it after larger changes, and add an entry for a part that is new: an entry whose
line has changed is listed and left out.
"""
import functools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from mutations import MUTATIONS

ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 1200  # seconds until a test counts as hung: a changed line may well not come to an end
SOURCES = ("apps", "cmake", "compare", "python", "src", "tests")  # in the copy only what git knows
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


def copy(to, wanted):
    """The files that git knows, where they differ; the library of the copy gets the changes `wanted`. Returns the numbers of
    those whose line is there."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    names = [name for name in listed.split("\0") if name and (ROOT / name).is_file()]
    changed, there_are = {}, []
    for number in wanted:
        file, original, replacement, _ = MUTATIONS[number]
        path = f"src/scabo/{file}"
        text = changed.get(path) or (ROOT / path).read_text()
        if text.count(original) != 1:
            print(f"{number}: {path} does not contain this line once: {original}")
            continue
        changed[path] = text.replace(original, re.sub(r"\bMUTATED\b", f"mutated({number})", replacement))
        there_are.append(number)
    for path, text in changed.items():
        first = re.search(r"^#include", text, re.M).start()
        changed[path] = text[:first] + '#include "scabo/base/mutated.hpp"\n' + text[first:]
    changed["src/scabo/base/mutated.hpp"] = SWITCH
    known = {*names, *changed}
    for folder in SOURCES:  # what an earlier copy had more: sources are found by their names
        for path in list((to / folder).rglob("*")):
            if path.is_file() and str(path.relative_to(to)) not in known:
                path.unlink()
    for name in names:
        if name in changed:
            continue
        there = to / name
        if not there.exists() or there.read_bytes() != (ROOT / name).read_bytes():
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, there)  # as new: what was built from the former text may be newer than this file
    for name, text in changed.items():
        there = to / name
        there.parent.mkdir(parents=True, exist_ok=True)
        if not there.exists() or there.read_text() != text:
            there.write_text(text)
    return there_are


def build(to, targets):
    subprocess.run(["cmake", "--preset", "release", "-S", "."], cwd=to, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "build", "--target", *sorted(targets)], cwd=to, check=True)


@functools.cache
def python():
    """The interpreter that the tests use: it has their modules, which the one that runs this file may lack."""
    return subprocess.run([ROOT / "cmake/find_python.sh"], check=True, capture_output=True, text=True).stdout.strip()


def command_of(to, test):
    """`program filter` of GoogleTest, or the path of a Python test."""
    program, _, only = test.partition(" ")
    if not program.endswith(".py"):
        return [to / "build/tests" / program, f"--gtest_filter={only or '*'}", "--gtest_fail_fast", "--gtest_brief=1"]
    uses = "build/tests/result_sample" if "read_vtu" in program else "build/bin/scabo"
    return [python(), to / program, to / uses]


def targets_of(test):
    program = test.split()[0]
    if not program.endswith(".py"):
        return {program}
    return {"scabo_program", "result_sample"} if "read_vtu" in program else {"scabo_program"}


def noticed_by(to, number, test):
    """Name of the first test that fails; empty if none does."""
    try:
        ended = subprocess.run(command_of(to, test), cwd=to, capture_output=True, text=True, timeout=PATIENCE, errors="replace",
                               env={**os.environ, "SCABO_MUTATION": str(number), "SCABO": str(to / "build/bin/scabo"),
                                    "OPENBLAS_NUM_THREADS": "1"})
    except subprocess.TimeoutExpired:
        return f"{test}, not at its end after {PATIENCE} s"
    output = ended.stdout + ended.stderr
    if "[==========] 0 tests" in output:
        return f"{test}, which names no test,"
    if ended.returncode == 0:
        return ""
    failed = re.search(r"\[  FAILED  \] (\S+)", output) or re.search(r"(?:FAIL|ERROR): (\S+)", output)
    return failed.group(1).rstrip(",") if failed else f"{test}, status {ended.returncode}"


def main():
    words = sys.argv[2:]
    if len(sys.argv) < 2 or sys.argv[1].startswith("-") or not all(word.isdigit() and int(word) in MUTATIONS for word in words):
        sys.exit(f"usage: {sys.argv[0]} FOLDER [NUMBER...]; numbers are 1 to {max(MUTATIONS)}")
    to = Path(sys.argv[1]).resolve()
    wanted = copy(to, sorted(map(int, words)) or list(MUTATIONS))
    build(to, {target for number in wanted for target in targets_of(MUTATIONS[number][3])})
    survivors, sound = 0, set()
    for number in wanted:
        file, _, _, test = MUTATIONS[number]
        if test not in sound:
            if by := noticed_by(to, 0, test):
                sys.exit(f"{by} fails without any change")
            sound.add(test)
        by = noticed_by(to, number, test)
        survivors += not by
        print(f"{number:4} {file:40} {by or 'SURVIVES ' + test}", flush=True)
    sys.exit(1 if survivors else 0)


if __name__ == "__main__":
    main()
