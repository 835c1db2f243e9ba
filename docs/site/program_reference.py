"""The command line, as the program itself describes it."""
from __future__ import annotations

import pathlib
import re
import subprocess


def help_of(scabo: pathlib.Path, *arguments: str) -> str:
    return subprocess.run([scabo, *arguments, "--help"], capture_output=True, text=True, check=True).stdout.strip()


def page(scabo: pathlib.Path) -> str:
    whole = help_of(scabo)
    commands = re.findall(r"^  (\w+) {2,}\S", whole[whole.index("Subcommands"):], re.M)
    assert len(commands) >= 5, whole
    lines = ["# The program: all options", "", "What `scabo --help` and `scabo COMMAND --help` print. The exit status is explained in the",
             "[README](../README.md#the-program).", "", "```text", whole, "```", ""]
    for command in commands:
        lines += [f"## scabo {command}", "", "```text", help_of(scabo, command), "```", ""]
    return "\n".join(lines)
