#!/usr/bin/env python3
"""A dam whose joint breaks from the heel: stress in dam and rock, pressure in the joint, share of the pairs that fail."""
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import pictures
from pictures import np, plt

HERE = pathlib.Path(__file__).resolve().parent
TENSION = 0.1e6                                      # Pa, as in model.yaml
LIMIT = 0.75 * 190 * 2400 * 9.81 / (0.5 * 9810 * 20**2)  # mu times the weight / thrust of a full reservoir
# Friction alone holds no more than mu times the weight, 1.71 times the thrust of a full reservoir.
PLAIN = ("contacts.joint.cohesion=0", "contacts.joint.tension=0", "steps.1.increments=17",
         "steps.1.loads={weight: 1, water_1: 1.7, water_2: 1.7, water_3: 1.7, water_4: 1.7}")


def main():
    options = pictures.options_of(__doc__, HERE, "joint.results")
    glued = pictures.run(options.scabo, HERE / "model.yaml", options.results / "cohesion")
    plain = pictures.run(options.scabo, HERE / "model.yaml", options.results / "friction", *PLAIN)
    for name, summary in (("cohesion", glued), ("friction alone", plain)):
        last = summary["increments"][-1]
        joint, energy = last["contacts"]["joint"], last["energy"]
        free = energy["external"] - energy["elastic"] - energy["friction"]
        print(f"{name}: {joint['open']} pairs open, {joint['slip']} slip, {joint.get('broken', '-')} broken, widest "
              f"{1e3 * joint['max_gap']:.4f} mm; {free:.1f} J/m set free")
    path = options.output / "joint.png"
    picture(options, glued, plain).savefig(path)
    print(path)


def rows_of(directory):
    with open(directory / "contact.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def flood(summary):
    """Factor of the thrust at each increment."""
    return np.array([increment["factors"].get("water_1", 0.0) for increment in summary["increments"]])


def picture(options, glued, plain):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12, 4.1), gridspec_kw={"width_ratios": [1.25, 1, 1]})
    figure.subplots_adjust(left=0.045, right=0.985, top=0.9, bottom=0.13, wspace=0.28)
    count = len(glued["increments"])
    last = pictures.fields(options.results / "cohesion", count)
    drawn = pictures.draw(left, last, last.point_data["stress_yy"] / 1e6, np.linspace(-1.4, 0.2, 17), magnification=1500,
                          cmap="viridis")
    figure.colorbar(drawn, ax=left, label="vertical stress, MPa", shrink=0.85)
    left.set_xlim(-9, 24)
    left.set_ylim(-9, 22)
    left.set_title(f"thrust {flood(glued)[-1]:.2f}, moved 1500 times")

    rows = rows_of(options.results / "cohesion")
    factor = dict(zip([(str(i["step"]), str(i["increment"])) for i in glued["increments"]], flood(glued)))
    for thrust, colour in ((0.0, "0.6"), (0.9, "#2b5c8a"), (1.4, "#3f9c6b"), (2.0, "#c1442e")):
        chosen = [row for row in rows if abs(factor[row["step"], row["increment"]] - thrust) < 1e-9]
        middle.plot([float(row["x"]) for row in chosen], [float(row["pressure"]) / 1e6 for row in chosen], "o-", color=colour,
                    markersize=2.5, linewidth=1, label=f"thrust {thrust:.1f}")
    middle.axhline(-TENSION / 1e6, color="black", linewidth=0.7, linestyle=":")
    middle.text(15, -TENSION / 1e6 - 0.02, "tensile strength", ha="right", va="top", fontsize=8)
    middle.set_xlabel("along the joint from heel to toe, m")
    middle.set_ylabel("pressure in the joint, MPa")
    middle.legend(frameon=False)
    middle.grid(linewidth=0.3)
    middle.set_title("what the joint carries")

    pairs = sum(glued["increments"][-1]["contacts"]["joint"][state] for state in ("open", "stick", "slip"))
    for summary, state, style, colour, name in ((plain, "slip", ":", "0.45", "friction alone: slips"),
                                                (plain, "open", "--", "0.45", "friction alone: open"),
                                                (glued, "broken", "-", "#c1442e", "with cohesion: broken")):
        share = [100 * increment["contacts"]["joint"][state] / pairs for increment in summary["increments"]]
        right.plot(flood(summary), share, style, color=colour, marker="o", markersize=2.5, label=name)
    right.axvline(LIMIT, color="black", linewidth=0.7, linestyle=":")
    right.text(LIMIT + 0.02, 60, "mu N", fontsize=8)
    right.set_xlabel("thrust / thrust of a full reservoir")
    right.set_ylabel("part of the pairs, %")
    right.set_ylim(0, 100)
    right.legend(frameon=False, loc="upper left")
    right.grid(linewidth=0.3)
    right.set_title("failure of the joint")
    return figure


if __name__ == "__main__":
    main()
