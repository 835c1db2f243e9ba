"""What a verification test compares is recorded where SCABO_RECORDED_CHECKS asks for it, and nowhere else:
records_test.py PROGRAM."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


class Records(unittest.TestCase):
    def run_incline(self, directory, **more):
        environment = {**os.environ, **more}
        subprocess.run([PROGRAM, "--gtest_filter=*Incline.Rests*", "--gtest_brief=1"], env=environment, cwd=directory, check=True,
                       capture_output=True, timeout=1200)
        return [json.loads(line) for file in pathlib.Path(directory).iterdir() for line in file.read_text().splitlines()]

    def test_value_reference_and_bound(self):
        with tempfile.TemporaryDirectory() as directory:
            self.assertEqual(self.run_incline(directory), [])
            tests = self.run_incline(directory, SCABO_RECORDED_CHECKS=directory)
        self.assertEqual([test["test"] for test in tests], [f"RestsBelowTheAngleOfFriction/{number}" for number in range(4)])
        for test in tests:
            self.assertTrue(test["file"].endswith("incline_test.cpp"))
            self.assertTrue(test["models"][0]["text"].strip().startswith("scabo: 1"))
            checks = {check["of"]: check for check in test["checks"]}
            ratio = checks["contact.tangential_force / contact.normal_force"]
            self.assertEqual((ratio["exact"], ratio["bound"], ratio["times"]), ("-limit", 1e-9, 1))
            self.assertLessEqual(abs(ratio["value"] - ratio["reference"]), ratio["bound"])
            self.assertNotIn("reference", checks["increment.certificate.worst()"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
