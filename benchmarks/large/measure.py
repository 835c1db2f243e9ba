"""One `scabo run` of a model, measured: processor seconds of stages and increments, memory, files.

A run has limits of processor time and of memory (address space), so that no model can hold up the others or fill the machine: a run
that reaches one of them is a `Failure` with its reason.

Processor seconds are those of the clock of the process (all threads, ended ones too), read every 5 ms and related to the moments that the
events of `--json-lines` name. On a machine with other work they say more than wall seconds. `assemble` and `factorise` take turns, body
by body: they share the seconds of both as their wall seconds do. Below 0.05 s the figures are rough.
"""
import json
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import threading
import time

import numpy

INTERVAL = 0.005  # s, between two readings of the clock


class Failure(Exception):
    """The run did not end with a certified result; the text says why. `processor` is the time that it took."""

    def __init__(self, reason, processor):
        super().__init__(reason)
        self.processor = processor


def clock_of(pid):
    return (~pid << 3) | 2  # CLOCK_PROCESS_CPUTIME_ID of another process, as clock_getcpuclockid makes it


def resident_bytes(pid):
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="utf-8")
    except OSError:
        return None
    line = next((line for line in status.splitlines() if line.startswith("VmRSS:")), None)
    return int(line.split()[1]) * 1024 if line else None


class Watch(threading.Thread):
    """Events of the run in the order of their coming: (wall second of its arrival, resident bytes then, event)."""

    def __init__(self, process, begin):
        super().__init__(daemon=True)
        self.process, self.begin, self.events = process, begin, []

    def run(self):
        for line in self.process.stdout:
            try:
                event = json.loads(line)
            except json.JSONDecodeError:
                continue  # the process was ended while it wrote
            resident = resident_bytes(self.process.pid) if event["event"] == "increment_end" else None
            self.events.append((time.monotonic() - self.begin, resident, event))


def limit(seconds, gigabytes):
    def set_limits():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 5))
        resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 1e9), int(gigabytes * 1e9)))
    return set_limits


def last_line(text):
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else "no message"


def processor_of_stages(watch, samples, timing, increments):
    """Processor seconds of stages and of every increment with its files; see the head of this file."""
    offset = min(arrival - event["t"] for arrival, _, event in watch.events)  # the event that was read at once
    at = lambda wall: float(numpy.interp(wall, [s[0] for s in samples], [s[1] for s in samples]))
    begins = {}
    for _, _, event in watch.events:
        if event["event"] == "stage_begin":
            begins[event["stage"]] = event["t"] + offset
    first, second = begins["super-elements"], begins["factorisation"]
    third = begins["condensation to the contact pairs"]
    ends = [event["t"] + offset for _, _, event in watch.events if event["event"] == "increment_end"]
    starts = [event["t"] + offset for _, _, event in watch.events if event["event"] == "increment_begin"]
    both = at(third) - at(second)
    share = timing["assemble"] / max(timing["assemble"] + timing["factorise"], 1e-9)
    of = {"mesh": at(first), "super_elements": at(second) - at(first), "assemble": share * both, "factorise": (1.0 - share) * both,
          "condense": at(starts[0]) - at(third)}
    if increments == 1:
        of["newton"] = at(starts[0] + timing["newton"]) - at(starts[0])
        of["fields"] = samples[-1][1] - at(starts[0] + timing["newton"])
    return of, [at(end) - at(start) for start, end in zip(starts, ends)]


def run(scabo, text, threads=1, seconds=300.0, gigabytes=10.0, words=()):
    """Runs the model `text`; a dictionary for JSON, or Failure."""
    with tempfile.TemporaryDirectory(prefix="scabo-large-") as directory:
        model = pathlib.Path(directory) / "model.yaml"
        model.write_text(text, encoding="utf-8")
        errors = pathlib.Path(directory) / "errors"
        with errors.open("w", encoding="utf-8") as stream:
            begin = time.monotonic()
            process = subprocess.Popen([str(scabo), "run", str(model), "--threads", str(threads), "--json-lines", "--quiet", *words],
                                       stdout=subprocess.PIPE, stderr=stream, text=True, preexec_fn=limit(seconds, gigabytes))
            watch = Watch(process, begin)
            watch.start()
            samples, clock = [(0.0, 0.0)], clock_of(process.pid)
            try:
                while True:
                    pid, status, usage = os.wait4(process.pid, os.WNOHANG)
                    if pid:
                        break
                    try:
                        samples.append((time.monotonic() - begin, time.clock_gettime(clock)))
                    except OSError:
                        pass
                    time.sleep(INTERVAL)
            except KeyboardInterrupt:
                process.kill()
                process.wait()
                raise
        wall = time.monotonic() - begin
        watch.join()
        process.stdout.close()
        process.returncode = os.waitstatus_to_exitcode(status)
        processor = usage.ru_utime + usage.ru_stime
        samples.append((wall, processor))
        if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            raise Failure(f"over {seconds:.0f} s of processor time" if processor > 0.98 * seconds else "killed", processor)
        if process.returncode != 0:
            raise Failure(last_line(errors.read_text(encoding="utf-8")), processor)
        results = model.with_suffix(".results")
        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        of, increments = processor_of_stages(watch, samples, summary["timing"], len(summary["increments"]))
        return {"model": {key: summary["model"][key] for key in ("nodes", "dofs", "contact_pairs")},
                "nodes_of_bodies": [body["nodes"] for body in summary["model"]["bodies"]],
                "timing": summary["timing"], "processor_of": of, "of_increments": increments, "wall": wall, "processor": processor,
                "peak": summary["peak_memory_bytes"],
                "resident": [resident for _, resident, event in watch.events if event["event"] == "increment_end"],
                "files": sum(file.stat().st_size for file in results.rglob("*") if file.is_file()),
                "iterations": [increment["newton_iterations"] for increment in summary["increments"]],
                "coarse_iterations": [increment["coarse_iterations"] for increment in summary["increments"]],
                "states": {name: tuple(contact[state] for state in ("open", "stick", "slip"))
                           for name, contact in summary["increments"][-1]["contacts"].items()},
                "certificate": max(event["certificate"] or 0.0 for _, _, event in watch.events if event["event"] == "increment_end"),
                "plan": next(event for _, _, event in watch.events if event["event"] == "plan"),
                "threads": threads, "load": os.getloadavg()[0]}


def seconds_text(value):
    return f"{value:.3f}" if value < 1 else f"{value:.2f}" if value < 10 else f"{value:.1f}"


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
                      *("| " + " | ".join(str(entry) for entry in row) + " |" for row in rows)])
