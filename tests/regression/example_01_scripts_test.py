"""The scripts of examples/01_double_cantilever: the comparison that `make demo` prints, and the pictures."""
import subprocess
import sys

import support
from support import BEAM, certificate_of, summary_of


def python(script, *arguments, cwd):
    return subprocess.run([sys.executable, BEAM.parent / script, *map(str, arguments)], cwd=cwd, text=True,
                          capture_output=True, timeout=support.PATIENCE)


class Scripts(support.InTemporaryDirectory):
    def test_compare_prints_the_papers_numbers_beside_ours(self):
        run = python("compare.py", "--scabo", support.SCABO, cwd=self.directory)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        for totals in ("53.64 /  0.00", "53.64 / 10.73", "53.64 / 26.82"):
            self.assertEqual(run.stdout.count(totals), 2, run.stdout)  # Scabo's and the paper's
        for friction in ("0.0", "0.2", "0.5"):
            directory = self.directory / "double_cantilever.results" / f"mu_{friction}"
            self.assertIn(f"double_cantilever.results/mu_{friction}", run.stdout)
            self.assertLess(certificate_of(summary_of(directory)["increments"][0]), 1e-10)

    def test_compare_fails_when_a_run_fails(self):
        for program in ("/bin/false", self.directory / "no_such_program"):
            run = python("compare.py", "--scabo", program, cwd=self.directory)
            self.assertNotEqual(run.returncode, 0)
            self.assertIn(str(program), run.stderr)


if __name__ == "__main__":
    support.main()
