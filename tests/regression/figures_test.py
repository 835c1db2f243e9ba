"""The pictures of the examples, all drawn in one process; those of the longest runs are drawn where their numbers are checked, and
those of 04_error_control, a study of many meshes that takes as long as all others together, only by hand."""
import support
from support import ROOT

ELSEWHERE = ["04_error_control", "14_wall", "15_concrete_section", "22_ironing", "36_wing_cracks", "37_heel_crack", "38_fatigue_at_a_hole"]  # example_14_and_15_test.py ...


class Figures(support.InTemporaryDirectory):
    def test_every_example_is_drawn(self):
        for script in sorted((ROOT / "examples").glob("*/figures.py")):
            folder = script.parent.name
            if folder in ELSEWHERE:
                continue
            with self.subTest(example=folder):
                directory = self.directory / folder
                directory.mkdir()
                printed = support.draw(folder, directory)
                support.check_pictures(self, folder, directory)
                support.check_stated_numbers(self, folder, printed)


if __name__ == "__main__":
    support.main()
