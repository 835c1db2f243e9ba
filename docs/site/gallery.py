"""The gallery: every example is run, and its result is drawn by `scabo plot`."""
from __future__ import annotations

import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KINDS = ("stress", "contact", "history")  # shown where a result has them
TIME = 300  # s, of one command


def page(scabo: pathlib.Path, build: pathlib.Path, source: pathlib.Path, jobs: int) -> str:
    work = build / "docs" / "gallery"
    shutil.rmtree(work, ignore_errors=True)
    pictures = source / "gallery"
    pictures.mkdir(parents=True, exist_ok=True)
    examples = [folder for folder in sorted((ROOT / "examples").iterdir()) if (folder / "model.yaml").exists()]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        entries = list(pool.map(lambda folder: entry(scabo, folder, work, pictures), examples))
    tiles = ['<div class="tiles">']
    for folder, text in zip(examples, entries):
        first = next(iter(sorted(pictures.glob(f"{folder.name}.*.png"), key=lambda file: KINDS.index(file.name.split(".")[1]))), None)
        title = title_of(folder)
        tiles += ["<div>", "", f"![{title}](gallery/{first.name})" if first else "", "", f"[{title}](#{anchor(title)})", "", "</div>"]
    tiles.append("</div>")
    return "\n".join(["# Gallery", "", "Every picture of this page is made by running the [example](examples/README.md) and drawing its results, by the commands",
                      "that are shown, when this manual is built.", "", *tiles, "", *entries])


def title_of(folder: pathlib.Path) -> str:
    return (folder / "README.md").read_text(encoding="utf-8").split("\n", 1)[0].lstrip("# ")


def anchor(title: str) -> str:
    from markdown import slug_of
    return slug_of(title)


def entry(scabo: pathlib.Path, folder: pathlib.Path, work: pathlib.Path, pictures: pathlib.Path) -> str:
    results = work / f"{folder.name}.results"
    results.parent.mkdir(parents=True, exist_ok=True)
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    run(scabo, "run", str(folder / "model.yaml"), "-o", str(results), "--quiet", environment=environment)
    units = "m,N"
    run(scabo, "plot", str(results), "--units", units, "-o", str(work / f"{folder.name}.png"), environment=environment)
    shown = []
    for kind in KINDS:
        file = work / f"{folder.name}.{kind}.png"
        if file.exists():
            shutil.move(file, pictures / file.name)
            shown.append(kind)
    text = (folder / "README.md").read_text(encoding="utf-8")
    about = re.search(r"^# .*?\n\n(.+?)\n\n", text, re.S)[1]
    about = re.sub(r"\]\((?![a-z]+:|#)([^)]+)\)", rf"](examples/{folder.name}/\1)", about)
    about = re.sub(r"\]\(#", f"](examples/{folder.name}/README.md#", about)
    summary = json.loads((results / "summary.json").read_text())
    model, timing = summary.get("model", {}), summary.get("timing", {})
    facts = [f"{model[key]:,} {name}" for key, name in (("dofs", "degrees of freedom"), ("contact_pairs", "contact pairs")) if model.get(key)]
    if timing.get("total"):
        facts.append(f"{timing['total']:.2g} s")
    lines = [f"## {title_of(folder)}", "", about, "", f"{', '.join(facts)}. [Model, results and remarks](examples/{folder.name}/README.md).", "",
             "```bash", f"scabo run examples/{folder.name}/model.yaml -o {folder.name}.results",
             f"scabo plot {folder.name}.results --units {units}", "```", ""]
    lines += [f"![{kind} of {title_of(folder)}](gallery/{folder.name}.{kind}.png)\n" for kind in shown]
    return "\n".join(lines)


def run(*command: str, environment: dict[str, str]) -> None:
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=TIME)
    if done.returncode:
        raise SystemExit(f"gallery: {' '.join(map(str, command))} ended with status {done.returncode}:\n{done.stderr}")
