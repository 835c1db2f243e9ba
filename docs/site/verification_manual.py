"""The verification manual: runs the tests of tests/verification, which record what they compare
(tests/support/recorded_checks.hpp), and makes a page for each of their sources: a table and a picture for every case.

Every number is from this run; the words are the names of the tests, the expressions that they compare and the comments above
them in the source.
"""
from __future__ import annotations

import collections
import concurrent.futures
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SHARDS = 4  # parts of a program, so that processors share the longest
LONGEST = 20  # s, of the run of a model that is drawn


def page(scabo: pathlib.Path, build: pathlib.Path, source: pathlib.Path, jobs: int) -> str:
    work = build / "docs" / "verification"
    shutil.rmtree(work, ignore_errors=True)
    (work / "records").mkdir(parents=True)
    run_tests(build, work / "records", jobs)
    cases = read_cases(work / "records")
    pages, pictures = source / "verification", source / "verification" / "pictures"
    pictures.mkdir(parents=True)
    with concurrent.futures.ProcessPoolExecutor(jobs, initializer=prepare) as pool:
        drawn = list(pool.map(draw, cases, [scabo] * len(cases), [work] * len(cases), [pictures] * len(cases)))
    by_file: dict[str, list[tuple[dict, str]]] = collections.defaultdict(list)
    for case, picture in zip(cases, drawn):
        by_file[case["file"]].append((case, picture))
    for file, entries in by_file.items():
        (pages / f"{stem(file)}.md").write_text(page_of(file, entries), encoding="utf-8")
    return summary(by_file)


# ---- the run ------------------------------------------------------------------------------------------------


def run_tests(build: pathlib.Path, records: pathlib.Path, jobs: int) -> None:
    programs = sorted(file for file in (build / "tests").glob("verification_*") if os.access(file, os.X_OK) and file.is_file())
    if not programs:
        raise SystemExit(f"verification manual: {build}/tests has no verification programs; `make docs` builds them")

    def shard(work: tuple[pathlib.Path, int]) -> str:
        program, number = work
        environment = {**os.environ, "SCABO_RECORDED_CHECKS": str(records), "GTEST_TOTAL_SHARDS": str(SHARDS),
                       "GTEST_SHARD_INDEX": str(number), "OPENBLAS_NUM_THREADS": "1"}
        done = subprocess.run([program], env=environment, capture_output=True, text=True, cwd=records)
        return done.stdout[-3000:] if done.returncode else ""

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        failed = [text for text in pool.map(shard, [(program, number) for program in programs for number in range(SHARDS)]) if text]
    if failed:
        raise SystemExit("verification manual: tests failed\n" + "\n".join(failed))


def read_cases(records: pathlib.Path) -> list[dict]:
    """One case for each test in the source; instances of a parameterised one are one case."""
    cases: dict[tuple[str, int, str], dict] = {}
    for record in sorted(records.glob("*.jsonl")):
        for line in record.read_text(encoding="utf-8").splitlines():
            test = json.loads(line)
            suite = test["suite"].rpartition("/")[2] if not test["suite"].rpartition("/")[2].isdigit() else test["suite"].split("/")[-2]
            name, _, parameter = test["test"].partition("/")
            key = (pathlib.Path(test["file"]).name, test["line"], name)
            case = cases.setdefault(key, {"file": key[0], "line": test["line"], "suite": suite, "name": name, "checks": {}, "models": []})
            for check in test["checks"]:
                add_check(case["checks"], check, parameter)
            case["models"] += test["models"]
    return [cases[key] for key in sorted(cases) if cases[key]["checks"]]


def add_check(checks: dict, check: dict, parameter: str) -> None:
    key = (check["of"], check.get("exact", ""))
    check["parameter"] = parameter
    known = checks.get(key)
    if known is None or share(check) > share(known):
        check["times"] += known["times"] if known else 0
        checks[key] = check
    else:
        known["times"] += check["times"]


def error_of(check: dict) -> float:
    values = check["value"], check.get("reference", 0.0)
    return math.nan if None in values else abs(values[0] - values[1])


def share(check: dict) -> float:
    """The error over its bound; of a value with an upper bound alone, the value over it."""
    bound, error = check["bound"], error_of(check)
    if bound is None or math.isnan(error):
        return math.inf
    return error / bound if bound > 0 else (0.0 if error == 0 else math.inf)


# ---- pictures -----------------------------------------------------------------------------------------------


def prepare() -> None:
    os.environ["MPLBACKEND"] = "Agg"
    sys.path.insert(0, str(ROOT / "python" / "scabo"))


def draw(case: dict, scabo: pathlib.Path, work: pathlib.Path, pictures: pathlib.Path) -> str:
    """The stress of the first model of a case that can be run by itself; otherwise its errors beside their bounds."""
    name = f"{stem(case['file'])}_{case['suite']}_{case['name']}"
    for number, model in enumerate(case["models"]):
        file, results = work / f"{name}_{number}.yaml", work / f"{name}_{number}.results"
        file.write_text(model["text"], encoding="utf-8")
        settings = [word for setting in model["settings"] for word in ("--set", setting)]
        try:
            done = subprocess.run([scabo, "run", str(file), "-o", str(results), "--quiet", "--threads", "1", *settings],
                                  capture_output=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            continue
        if done.returncode == 0 and draw_stress(results, pictures / f"{name}.png"):
            shutil.rmtree(results)
            return f"{name}.png"
        shutil.rmtree(results, ignore_errors=True)
    draw_errors(case, pictures / f"{name}.png")
    return f"{name}.png"


def draw_stress(results: pathlib.Path, file: pathlib.Path) -> bool:
    import matplotlib.pyplot as plt
    import plot
    try:
        figure = plot.stress(plot.Results(str(results)))
    except plot.ResultsError:
        return False
    figure.savefig(file, dpi=70)
    plt.close(figure)
    return True


def draw_errors(case: dict, file: pathlib.Path) -> None:
    import matplotlib.pyplot as plt
    checks = [check for check in case["checks"].values() if check["bound"] and math.isfinite(share(check))]
    figure, axis = plt.subplots(figsize=(6.4, 0.8 + 0.28 * max(1, len(checks))), layout="constrained")
    names = [check["of"] if len(check["of"]) < 50 else check["of"][:47] + "..." for check in checks]
    errors = [max(error_of(check), 1e-17) for check in checks]
    places = range(len(checks))
    axis.plot([check["bound"] for check in checks], places, "|", markersize=14, color="black", label="bound")
    axis.plot(errors, places, "o", color="#1f5f8b", label="error, or the value that has the bound")
    axis.set(xscale="log", yticks=list(places), ylim=(max(1, len(checks)) - 0.5, -0.5))
    axis.set_yticklabels([name.replace("$", r"\$") for name in names], fontsize=7, family="monospace")
    axis.legend(fontsize=7, loc="best")
    axis.grid(True, axis="x", alpha=0.4)
    figure.savefig(file, dpi=80)
    plt.close(figure)


# ---- text ---------------------------------------------------------------------------------------------------


def stem(file: str) -> str:
    return file.removesuffix("_test.cpp")


def words_of(name: str) -> str:
    """`SlidesAtFrictionTimesWeight` as a phrase."""
    words = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+\w*", name)
    text = " ".join(word if word.isupper() and len(word) > 1 else word.lower() for word in words)
    return text[:1].upper() + text[1:]


def comment_above(file: str, line: int) -> str:
    """The comment over a test, as one paragraph."""
    lines = (ROOT / "tests" / "verification" / file).read_text(encoding="utf-8").split("\n")
    above, number = [], line - 2
    while number >= 0 and lines[number].startswith("//"):
        above.insert(0, lines[number].lstrip("/ "))
        number -= 1
    return plain(" ".join(above))


def introduction(file: str) -> str:
    lines = []
    for line in (ROOT / "tests" / "verification" / file).read_text(encoding="utf-8").split("\n"):
        if not line.startswith("//"):
            break
        lines.append(line.lstrip("/ "))
    return plain(" ".join(lines))


def plain(text: str) -> str:
    """No mark-up in what is plain text."""
    return re.sub(r"([*_$<>|\[\]\\])", r"\\\1", text)


def number(value: float | None, digits: int = 7) -> str:
    return "not a number" if value is None else f"{value:.{digits}g}"


def code(text: str) -> str:
    text = " ".join(text.split()).replace("|", "\\|")
    return f"`{text}`" if "`" not in text else text


def page_of(file: str, entries: list[tuple[dict, str]]) -> str:
    lines = [f"# {words_of(''.join(word.capitalize() for word in stem(file).split('_')))}", "", introduction(file), "",
             f"Source: [tests/verification/{file}](../tests/verification/{file}).", ""]
    for case, picture in entries:
        title = f"{words_of(case['suite'])}: {words_of(case['name'])[:1].lower() + words_of(case['name'])[1:]}"
        lines += [f"## {title}", "", comment_above(case["file"], case["line"]), ""]
        lines += ["| compared in the test | reference | Scabo | error | bound | comparisons |", "|---|---|---|---|---|---|"]
        for check in case["checks"].values():
            of = code(check["of"]) + (f" ({plain(check['parameter'])})" if check["parameter"] else "")
            if "reference" in check:
                exact = code(check["exact"]) + " = " if not re.fullmatch(r"[-+\d.e']+", check["exact"]) else ""
                lines.append(f"| {of} | {exact}{number(check['reference'])} | {number(check['value'])} | {number(error_of(check), 2)} |"
                             f" {number(check['bound'], 2)} | {check['times']} |")
            else:
                lines.append(f"| {of} | | {number(check['value'], 4)} | | at most {number(check['bound'], 2)} | {check['times']} |")
        lines += ["", f"![{title}](pictures/{picture})", ""]
    return "\n".join(lines)


def summary(by_file: dict[str, list[tuple[dict, str]]]) -> str:
    cases = sum(len(entries) for entries in by_file.values())
    comparisons = sum(check["times"] for entries in by_file.values() for case, _ in entries for check in case["checks"].values())
    lines = ["# Verification manual", "",
             f"{cases} cases with {comparisons:,} comparisons. This page and those below it are made by running the tests of"
             " `tests/verification` when the manual is built: every reference, value and error comes from that run, and the manual is"
             " not built if a test fails. [Verification](docs/verification.md) groups the main cases by subject, with the sources of"
             " the references.", "",
             "In the tables, the first column is the expression that the test compares, and the reference is what it is compared with:"
             " a closed form, a published number, or another way to compute the same. Where a test makes a comparison many times (pairs of"
             " a contact, several meshes), the row has the one that is nearest to its bound, and the last column how many there are. In"
             " rows without a reference the value has an upper bound only; often it is an error that the test computes itself. The picture shows"
             " the von Mises stress of the first model of the case, or, where the test has no model of its own that runs alone, the errors"
             " beside their bounds.", "",
             "| cases | tests | comparisons | largest error over its bound |", "|---|---|---|---|"]
    for file, entries in by_file.items():
        checks = [check for case, _ in entries for check in case["checks"].values()]
        differences = [share(check) for check in checks if "reference" in check and math.isfinite(share(check))]
        title = words_of("".join(word.capitalize() for word in stem(file).split("_")))
        lines.append(f"| [{title}](verification/{stem(file)}.md) | {len(entries)} | {sum(check['times'] for check in checks)} |"
                     f" {max(differences):.2f} |" if differences else
                     f"| [{title}](verification/{stem(file)}.md) | {len(entries)} | {sum(check['times'] for check in checks)} | |")
    lines += ["", "```{toctree}", ":hidden:", ""] + [f"verification/{stem(file)}" for file in by_file] + ["```", ""]
    return "\n".join(lines)
