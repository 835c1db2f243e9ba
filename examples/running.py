"""Running scabo, for the scripts of the examples. Standard library only."""
import subprocess
import sys


def run(scabo, model, directory, settings=()):
    """Results go to `directory`. Ends the program when scabo fails; scabo has said why."""
    command = [str(scabo), "run", str(model), "-o", str(directory), "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    try:
        status = subprocess.run(command).returncode
    except OSError as error:
        sys.exit(f"cannot run {scabo}: {error.strerror} (name the program with --scabo)")
    if status != 0:
        sys.exit(f"scabo ended with exit status {status}: {' '.join(command)}")
