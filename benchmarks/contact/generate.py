"""Problems that Scabo makes itself, where no collection is at hand: the increments of its examples, at several sizes and coefficients of
friction, written by `output: {discrete_problems: true}`."""
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODEL = ROOT / "examples" / "01_double_cantilever" / "model.yaml"


def problems_of_scabo(scabo, folder):
    files = []
    for size in ("0.375", "0.09375", "0.046875"):
        for friction in ("0.0", "0.3", "1.0"):
            name = f"double_cantilever_{size}_mu{friction}"
            results = folder / name
            command = [str(scabo), "run", str(MODEL), "--quiet", "-o", str(results), "--set", f"contacts.joint.friction={friction}",
                       "--set", "output.discrete_problems=true"]
            for body in ("lower", "upper"):
                command += ["--set", f"bodies.{body}.mesh.size={size}"]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"{' '.join(command)}: {done.stderr.strip()[-300:]}")
            for found in sorted(results.rglob("*.hdf5")):
                target = folder / f"{name}_{found.stem}.hdf5"
                shutil.copy(found, target)
                files.append(target)
    return files
