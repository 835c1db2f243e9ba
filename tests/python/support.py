"""What the tests of the Python package share."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEAM = ROOT / "examples" / "01_double_cantilever" / "model.yaml"
PROGRAM = os.environ["SCABO"]
PATIENCE = 1200  # seconds until a program counts as hung


def program(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, text=True, capture_output=True, timeout=PATIENCE)


def summary_of(directory):
    return json.loads(pathlib.Path(directory, "summary.json").read_text(encoding="utf-8"))


def block():
    """The block of the README, as a dictionary."""
    return {
        "scabo": 1,
        "materials": {"steel": {"young": 210e9, "poisson": 0.3}},
        "bodies": {
            "floor": {"rigid": True, "shape": {"rectangle": {"corner": [-1, -1], "size": [4, 1]}}},
            "block": {"material": "steel", "shape": {"rectangle": {"corner": [0, 0], "size": [2, 1]}},
                      "mesh": {"size": 0.1}},
        },
        "supports": [{"on": "floor", "fix": ["x", "y"]}],
        "loads": {"push": {"on": "block.top", "traction": [1e6, -10e6]}},
        "contacts": {"base": {"between": ["floor.top", "block.bottom"], "friction": 0.3}},
    }


class InTemporaryDirectory(unittest.TestCase):
    """Each test gets an empty directory, self.directory."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="scabo_test_")
        self.addCleanup(holder.cleanup)
        self.directory = pathlib.Path(holder.name)
