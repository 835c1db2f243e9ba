#!/usr/bin/env python3
"""The arch: how its voussoirs begin to turn beyond the largest axle."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(pathlib.Path(__file__).resolve().parent))
import hand
import pictures

HERE = pathlib.Path(__file__).resolve().parent


def main():
    options = pictures.options_of(__doc__, HERE, "masonry_arch.results")
    summary = pictures.run(options.scabo, HERE / "model.yaml", options.results)
    limit, by_hand = summary["limit"], hand.calculate()["axle"]
    print(f"limit {limit['solved']:.2f} to {limit['beyond']:.2f}, by hand {by_hand:.2f}")
    path = options.output / "masonry_arch.png"
    pictures.scabo_plot.mechanism(pictures.scabo_plot.Results(options.results)).savefig(path)
    print(path)


if __name__ == "__main__":
    main()
