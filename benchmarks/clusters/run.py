"""One process with several threads beside several ranks, on two blocks of quadtrees in contact: time of every stage, memory of every rank,
bytes between ranks.

    run.py --scabo build/bin/scabo [--ranks 2] [--dofs 1e5 3e5 1e6] [--pairs 300]
"""
import argparse
import json
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import threading
import time

MODEL = """
scabo: 1
title: Two blocks, {dofs:.0f} degrees of freedom
analysis: {{plane: strain}}
materials: {{rock: {{young: 20e9, poisson: 0.25}}}}
bodies:
  lower: {{material: rock, shape: {{rectangle: {{corner: [0, 0], size: [2, 1]}}}}, mesh: {{kind: {kind}, size: {size}, order: {order}}}}}
  upper: {{material: rock, shape: {{rectangle: {{corner: [{first}, 1], size: [{width}, 0.25]}}}}, mesh: {{kind: {kind}, size: {size}, order: {order}}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}]
loads:
  press: {{on: upper.top, pressure: 1e6}}
  push: {{on: upper.left, traction: [1e5, 0]}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.3}}}}
steps: [{{increments: 1}}]
solver: {{}}
"""
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "OMPI_MCA_mpi_yield_when_idle": "0"}  # else whatever else runs gets the processors at each message (docs/clusters.md)
STAGES = ("read", "mesh", "super_elements", "assemble", "factorise", "condense", "newton", "recover", "write", "total")


class Memory(threading.Thread):
    """Largest resident memory of each process of a name, as the system keeps it."""

    def __init__(self, names):
        super().__init__(daemon=True)
        self.names, self.most, self.over = names, {}, False

    def run(self):
        while not self.over:
            for entry in pathlib.Path("/proc").iterdir():
                if not entry.name.isdigit():
                    continue
                try:
                    if (entry / "comm").read_text().strip() not in self.names:
                        continue
                    peak = re.search(r"VmHWM:\s+(\d+)", (entry / "status").read_text())
                    environ = (entry / "environ").read_bytes()
                    rank = re.search(rb"OMPI_COMM_WORLD_RANK=(\d+)", environ)
                    if f"SCABO_BENCHMARK={os.getpid()}".encode() in environ and peak:
                        self.most[int(rank[1]) if rank else 0] = int(peak[1]) * 1024
                except OSError:
                    continue
            time.sleep(0.2)


def bytes_between(directory):
    """Sum of what Open MPI's monitoring counted, point to point and collective."""
    total = {}
    for path in directory.glob("volume*.prof"):
        for line in path.read_text().splitlines():
            kind, *numbers = line.split("\t")
            if kind in ("E", "I") and len(numbers) >= 3:
                total[kind] = total.get(kind, 0) + int(numbers[2].split()[0])
    return total


def run(command, directory, **environment):
    memory = Memory({"scabo", "scabo-mpi"})
    memory.start()
    start = time.monotonic()
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=directory, env={**ENVIRONMENT, "SCABO_BENCHMARK": str(os.getpid()), **environment},
                          capture_output=True, text=True)
    seconds = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    memory.over = True
    memory.join()
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: status {done.returncode}\n{done.stderr}")
    return seconds, processor, memory.most


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--scabo", required=True)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--dofs", type=float, nargs="+", default=[1e5, 3e5, 1e6])
    parser.add_argument("--pairs", type=int, default=300)
    parser.add_argument("--kind", default="quadtree")
    parser.add_argument("--order", type=int, default=1)
    parser.add_argument("--repeat", type=int, default=1, help="runs of each kind, in turns")
    parser.add_argument("--only", choices=("one", "ranks"), help="only this kind")
    parser.add_argument("--divide-from", type=float, help="smallest body that is divided, in degrees of freedom")
    parser.add_argument("--volume", action="store_true", help="count bytes between ranks (slower)")
    arguments = parser.parse_args()
    scabo = str(pathlib.Path(arguments.scabo).resolve())
    for dofs in arguments.dofs:
        with tempfile.TemporaryDirectory() as holder:
            directory = pathlib.Path(holder)
            size = (2.0 * 2.5 / dofs) ** 0.5 * (1 if arguments.order == 1 else 1.73)
            width = min(2.0, max(4 * size, arguments.pairs * size / arguments.order))
            (directory / "model.yaml").write_text(MODEL.format(dofs=dofs, size=round(size, 6), width=round(width, 6),
                                                               first=round(1 - width / 2, 6), kind=arguments.kind, order=arguments.order))
            common = ["run", "model.yaml", "--quiet", "--ignore-memory"]
            divide = [] if arguments.divide_from is None else ["--divide-from", str(arguments.divide_from)]
            kinds = (
                    ("one", [scabo, *common, "-o", "one", "--threads", str(arguments.ranks)], {}),
                    ("ranks", ["mpirun", "-n", str(arguments.ranks),
                               *(["--mca", "pml_monitoring_enable", "2", "--mca", "pml_monitoring_enable_output", "3",
                                  "--mca", "pml_monitoring_filename", "volume"] if arguments.volume else []),
                               scabo, *common, "-o", "ranks", "--threads", "1", *divide], {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}))
            for name, command, environment in kinds * arguments.repeat:
                if arguments.only not in (None, name):
                    continue
                seconds, processor, memory = run(command, directory, **environment)
                summary = json.loads((directory / name / "summary.json").read_text())
                stages = "  ".join(f"{stage} {summary['timing'][stage]:.2f}" for stage in STAGES)
                print(f"{name:6} {summary['model']['dofs']} dofs, {summary['model']['contact_pairs']} pairs, wall {seconds:.1f} s, processors {processor:.1f} s: {stages}; "
                      f"memory {', '.join(f'{memory[rank] / 1e9:.2f}' for rank in sorted(memory))} GB", flush=True)
            if arguments.volume:
                print(f"bytes between ranks: {bytes_between(directory)}", flush=True)


if __name__ == "__main__":
    main()
