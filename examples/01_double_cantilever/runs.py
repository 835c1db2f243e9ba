"""Runs the double cantilever beam with `scabo` and reads what it wrote. Standard library only."""
import csv
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import running

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE / "model.yaml"
CHECK = json.loads((HERE / "check.json").read_text(encoding="utf-8"))
FRICTIONS = [run["friction"] for run in CHECK["runs"]]


class Run:
    """One finished run: its directory, summary and last increment."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.summary = json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))
        self.last = self.summary["increments"][-1]
        self.joint = self.last["contacts"][CHECK["contact"]]

    def certificate(self):
        """The worst figure of the certificate; free of units."""
        return max(value for value in self.last["certificate"].values() if isinstance(value, (int, float)))

    def pairs(self):
        """Rows of contact.csv of the last increment; numbers as float."""
        with open(self.directory / "contact.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        last = (rows[-1]["step"], rows[-1]["increment"])
        return [{key: number(value) for key, value in row.items()}
                for row in rows if (row["step"], row["increment"]) == last]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def run(scabo, directory, **settings):
    """Runs the model with settings such as friction=0.5 (the joint's) and size=0.1 or kind="fem" (both
    bodies' mesh). Ends the program when scabo fails; scabo has said why."""
    paths = {"friction": [f"contacts.{CHECK['contact']}.friction"]}
    running.run(scabo, MODEL, directory,
                [f"{path}={value}" for key, value in settings.items()
                 for path in paths.get(key, [f"bodies.{body}.mesh.{key}" for body in ("lower", "upper")])])
    return Run(directory)
