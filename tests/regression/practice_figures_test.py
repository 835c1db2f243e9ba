"""The pictures of examples 17 to 21 and 23, drawn in one process."""
import contextlib
import io
import os
import runpy
import sys

import support
from support import ROOT

PICTURES = {"17_dam_sliding": "dam_sliding.png", "18_retaining_wall": "retaining_wall.png", "19_press_fit": "press_fit.png",
            "20_lap_joint": "lap_joint.png", "21_tunnel_lining": "tunnel_lining.png", "23_push_out": "push_out.png"}


class Figures(support.InTemporaryDirectory):
    def test_are_drawn(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.directory)
        for folder, picture in PICTURES.items():
            example = ROOT / "examples" / folder
            sys.modules.pop("hand", None)  # each example has its own
            sys.argv = ["figures.py", "--scabo", support.SCABO, "-o", str(self.directory)]
            with contextlib.redirect_stdout(io.StringIO()):
                runpy.run_path(str(example / "figures.py"), run_name="__main__")
            self.assertTrue((self.directory / picture).read_bytes().startswith(b"\x89PNG"))
            self.assertTrue((example / "figures" / picture).exists(), "the README shows it")


if __name__ == "__main__":
    support.main()
