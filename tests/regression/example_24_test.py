"""The checked numbers of examples/24_ratchet."""
import importlib.util

import support
from support import ROOT


class Ratchet(support.OfExample):
    FOLDER, PICTURES = "24_ratchet", ["ratchet.png"]

    def test_forces_are_those_of_a_rigid_block(self):
        folder = ROOT / "examples" / self.FOLDER
        specification = importlib.util.spec_from_file_location("hand_24", folder / "hand.py")
        hand = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(hand)
        numbers = hand.calculate()
        self.solve()
        lines = (self.directory / "results" / "history.csv").read_text(encoding="utf-8").splitlines()
        names = lines[0].split(",")
        rows = [dict(zip(names, (float(cell or "nan") for cell in line.split(",")))) for line in lines[1:]]
        text = (folder / "README.md").read_text(encoding="utf-8").splitlines()
        for row in self.check()["rows"]:
            value, by_hand = row["times"] * rows[row["row"]][row["column"]], numbers[row["hand"]]
            self.assertAlmostEqual(value / by_hand, 1, delta=row["relative_tolerance"], msg=row["quantity"])
            cells = " | ".join(f"{row['scale'] * cell:.{row['digits']}f}" for cell in (by_hand, value))
            self.assertIn(f"| {row['quantity']} | {cells} |", text)

    def test_figures_are_drawn(self):
        self.draw()


if __name__ == "__main__":
    support.main()
