"""The wheel: it holds what the package needs, and imports in a virtual environment where nothing else of Scabo is.

    wheel_test.py MAKE_WHEEL PACKAGE
"""
import base64
import csv
import hashlib
import io
import os
import pathlib
import subprocess
import sys
import unittest
import zipfile

from support import BEAM, PATIENCE, InTemporaryDirectory

PACKAGE = sys.argv.pop(2)
MAKE_WHEEL = sys.argv.pop(1)

CODE = """
import sys, scabo
assert scabo.__file__.startswith(sys.prefix), scabo.__file__
print(scabo.read(sys.argv[1]).run().contact["joint"].normal_force)
"""


class Wheel(InTemporaryDirectory):
    def make(self):
        done = subprocess.run([sys.executable, MAKE_WHEEL, PACKAGE, "--version", "1.2.3", "--output",
                               str(self.directory / "wheel")], text=True, capture_output=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        return pathlib.Path(done.stdout.strip())

    def test_contents(self):
        wheel = self.make()
        with zipfile.ZipFile(wheel) as archive:
            names = archive.namelist()
            record = next(name for name in names if name.endswith("RECORD"))
            rows = list(csv.reader(io.StringIO(archive.read(record).decode())))
            self.assertEqual([row[0] for row in rows], names)
            for name, digest, size in rows[:-1]:
                content = archive.read(name)
                expected = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
                self.assertEqual((digest, size), (f"sha256={expected}", str(len(content))))
        for name in ("scabo/__init__.py", "scabo/py.typed", "scabo/_core.pyi"):
            self.assertIn(name, names)
        again = wheel.read_bytes()
        self.assertEqual(self.make().read_bytes(), again)  # equal packages are equal wheels

    def test_a_clean_environment(self):
        """NumPy is the system's, because a test downloads nothing; Scabo is only what the wheel brings."""
        environment = self.directory / "environment"
        clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}

        def run(*words):
            done = subprocess.run([str(word) for word in words], text=True, capture_output=True, timeout=PATIENCE, env=clean,
                                  cwd=self.directory)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            return done.stdout

        try:
            import ensurepip  # noqa: F401
        except ImportError:
            self.skipTest("no python3-venv")
        run(sys.executable, "-m", "venv", "--system-site-packages", environment)
        python = environment / "bin" / "python"
        run(python, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", self.make())
        self.assertAlmostEqual(float(run(python, "-c", CODE, BEAM)), 53640.0, delta=10.0)
        self.assertIn("Version: 1.2.3", run(python, "-m", "pip", "show", "scabo"))
        run(python, "-m", "pip", "uninstall", "--yes", "--quiet", "scabo")
        self.assertEqual(list(environment.glob("lib/python*/site-packages/scabo*")), [])


if __name__ == "__main__":
    unittest.main()
