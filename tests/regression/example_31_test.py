"""The checked numbers of examples/31_beam_with_three_holes, and that a run that was killed continues with the same bits."""
import importlib.util
import math

import support
from support import ROOT, scabo, summary_of

EXAMPLE = ROOT / "examples" / "31_beam_with_three_holes"


def distance(path, centre):
    """Of a point from a path."""
    least = math.inf
    for (x, y), (to_x, to_y) in zip(path, path[1:]):
        along = (to_x - x, to_y - y)
        part = ((centre[0] - x) * along[0] + (centre[1] - y) * along[1]) / (along[0]**2 + along[1]**2)
        part = min(max(part, 0.0), 1.0)
        least = min(least, math.hypot(x + part * along[0] - centre[0], y + part * along[1] - centre[1]))
    return least


class BeamWithThreeHoles(support.InTemporaryDirectory):
    def test_paths(self):
        for notch in support.json.loads((EXAMPLE / "check.json").read_text(encoding="utf-8"))["notches"]:
            directory = self.directory / f"notch_{notch['from_middle']}"
            run = scabo("run", EXAMPLE / "model.yaml", "-o", directory, "--quiet", "--set", "output.fields=[]",
                        *[word for key in ("from_middle", "deep") for word in ("--set", f"parameters.{key}={notch[key]}")])
            self.assertEqual(run.returncode, 0, run.stderr)
            summary = summary_of(directory)
            self.assertIn(f"meets {notch['meets']}", summary["growth"]["ended"])
            tip = summary["increments"][10]["growth"]["tips"]["beam.notch.end"]["position"]
            self.assertLess(math.dist(tip, notch["tip"]), notch["tolerance"])
            path = summary["growth"]["paths"]["beam.notch"]
            for point in notch.get("by_triangles", ()):
                self.assertLess(distance(path, point), notch["within"])
            low, high = notch["passes_low_at"]
            passes = distance(path, (-4.0, 2.75)) - 0.25
            self.assertTrue(low < passes < high, passes)


if __name__ == "__main__":
    support.main()
