#!/usr/bin/env python3
"""Changes lines of the library, one at a time, and says which changes no test notices.

    tests/mutations/mutate.py FOLDER PART TEST... [--count 20] [--seed 1]

    tests/mutations/mutate.py ~/mutations contact/judge.cpp unit_contact_judge
    tests/mutations/mutate.py ~/mutations element unit_element verification_tests --count 50

FOLDER becomes a clone of this checkout as it is committed; no file of the checkout is touched. PART is a file or folder of
src/scabo, TEST a program of build/tests. Places are drawn at random among those that a pattern below finds. A change that
does not compile is left out. One that SURVIVES is either no change of the results, or a test is missing: that is for
a person to judge. Each change costs one compilation and one run of the tests.
"""
import argparse
import pathlib
import random
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATIENCE = 1200  # seconds until a test counts as hung: changed code may well not come to an end
# What is sought in a line of code, and what it becomes. Templates are written without blanks, so that ` < ` compares.
PATTERNS = [(r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" \+= ", " -= "), (r" -= ", " += "),
            (r" < ", " <= "), (r" <= ", " < "), (r" > ", " >= "), (r" >= ", " > "), (r" == ", " != "), (r" != ", " == "),
            (r" && ", " || "), (r" \|\| ", " && "), (r"std::max\(", "std::min("), (r"std::min\(", "std::max("),
            (r"std::abs\(", "("), (r"\b0\.5\b", "1.0"), (r"\b2\.0\b", "1.0"), (r"\btrue\b", "false"), (r"\bfalse\b", "true"),
            (r"^ +[\w.>\[\]()-]+ [+*-]?= [^;]*;$", ""),  # an assignment without a type in front, left out
            (r"^( +if \(.*\)) (return|continue|break)\b.*;$", "")]


def mutants_of(text):
    """Line, from 0, and what it becomes: every change that a pattern makes in code. Comments, texts and includes stay."""
    for number, line in enumerate(text.split("\n")):
        code = re.sub(r'"(?:[^"\\]|\\.)*"', lambda found: "_" * len(found[0]), line)
        code = code.partition("//")[0].rstrip()
        if code.lstrip().startswith("#"):
            continue
        for pattern, becomes in PATTERNS:
            for found in re.finditer(pattern, code):
                yield number, line[:found.start()] + becomes + line[found.end():]


def clone(to):
    if not to.exists():
        subprocess.run(["git", "clone", "--quiet", "--shared", ROOT, to], check=True)
    subprocess.run(["git", "fetch", "--quiet", ROOT, "HEAD"], cwd=to, check=True)
    subprocess.run(["git", "checkout", "--quiet", "--force", "--detach", "FETCH_HEAD"], cwd=to, check=True)
    subprocess.run(["cmake", "--preset", "release", "-DSCABO_UNITY=OFF", "-DSCABO_REPORT=OFF"], cwd=to, check=True, stdout=subprocess.DEVNULL)


def built(to, tests):
    return subprocess.run(["cmake", "--build", "build", "--target", *tests], cwd=to, capture_output=True).returncode == 0


def noticed_by(to, tests):
    """Name of the first test that fails; empty if none does."""
    for test in tests:
        try:
            ended = subprocess.run([to / "build/tests" / test, "--gtest_fail_fast", "--gtest_brief=1"], cwd=to, capture_output=True,
                                   text=True, timeout=PATIENCE, errors="replace")
        except subprocess.TimeoutExpired:
            return f"{test}, not at its end after {PATIENCE} s"
        if ended.returncode != 0:
            failed = re.search(r"\[  FAILED  \] (\S+)", ended.stdout)
            return failed[1].rstrip(",") if failed else f"{test}, status {ended.returncode}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("part")
    parser.add_argument("tests", nargs="+")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    to = options.folder.resolve()
    clone(to)
    if not built(to, options.tests):
        sys.exit("the tests do not build without any change")
    if by := noticed_by(to, options.tests):
        sys.exit(f"{by} fails without any change")
    part = to / "src/scabo" / options.part
    sources = [part] if part.is_file() else sorted(part.rglob("*.cpp"))
    places = [(source, *mutant) for source in sources for mutant in mutants_of(source.read_text(encoding="utf-8"))]
    random.Random(options.seed).shuffle(places)
    tried, survivors = 0, 0
    for source, number, becomes in places:
        if tried == options.count:
            break
        text = source.read_text(encoding="utf-8")
        lines = text.split("\n")
        before, lines[number] = lines[number], becomes
        try:
            source.write_text("\n".join(lines), encoding="utf-8")
            if not built(to, options.tests):
                continue
            by = noticed_by(to, options.tests)
        finally:
            source.write_text(text, encoding="utf-8")
        tried += 1
        survivors += not by
        print(f"{source.relative_to(to / 'src/scabo')}:{number + 1}: {by or 'SURVIVES'}\n  - {before.strip()}\n  + {becomes.strip()}", flush=True)
    print(f"{tried} changes, {survivors} noticed by no test")
    sys.exit(1 if survivors else 0)


if __name__ == "__main__":
    main()
