"""What tests of pages in headless Chromium share."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "regression"))
import support

def template():
    return pathlib.Path(support.SCABO).resolve().parents[1] / "share" / "scabo" / "report_template.html"


def chromium():
    return next((path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None)


class InBrowser(unittest.TestCase):
    """A test with a folder of its own. Skipped where there is no Chromium or where the page was not built."""

    @classmethod
    def setUpClass(cls):
        cls.modules, cls.node = os.environ.get("SCABO_REPORT_MODULES", ""), os.environ.get("SCABO_NODE") or shutil.which("node")
        if not chromium():
            raise unittest.SkipTest("there is no Chromium (apt install chromium)")
        if not cls.node or not template().exists() or not pathlib.Path(cls.modules, "playwright-core").is_dir():
            raise unittest.SkipTest("the page for reports was not built (apt install nodejs npm)")
        cls.holder = support.tempfile.TemporaryDirectory(prefix="scabo_test_")
        cls.addClassCleanup(cls.holder.cleanup)
        cls.folder = pathlib.Path(cls.holder.name)

    @classmethod
    def drive(cls, script, page, tasks, *words):
        """What a script of this folder saw on a page."""
        job = subprocess.run([cls.node, pathlib.Path(__file__).with_name(script), cls.modules, chromium(), page, cls.folder, *words],
                             input=json.dumps(tasks), text=True, capture_output=True, timeout=support.PATIENCE)
        assert job.returncode == 0, job.stderr
        return json.loads(job.stdout)
