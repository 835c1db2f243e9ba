#!/usr/bin/env python3
"""A dam whose joint breaks from the heel: stress in dam and rock, pressure in the joint, share of the pairs that fail."""
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
              f"{1e3 * joint['max_gap']:.4f} mm; {round(free, 1) + 0.0:.1f} J/m set free")
    path = options.output / "joint.png"
    picture(options, glued, plain).savefig(path)
    print(path)


def flood(summary):
    """Factor of the thrust at each increment."""
    return np.array([increment["factors"].get("water_1", 0.0) for increment in summary["increments"]])


def picture(options, glued, plain):
    figure = plt.figure(figsize=(13.2, 4.2), layout="constrained")
    left, middle, right = figure.subplots(1, 3, gridspec_kw={"width_ratios": [1.25, 1, 1]})
    count = len(glued["increments"])
    last = pictures.fields(options.results / "cohesion", count)
    drawn = pictures.draw(left, last, pictures.values_of(last, "stress_yy", 1e-6), pictures.signed_levels(1.4, bands=8),
                          magnification=1500)
    pictures.colour_bar(figure, drawn, left, "vertical stress (MPa)", shrink=0.85)
    left.set(xlim=(-9, 24), ylim=(-9, 22), title=f"thrust {flood(glued)[-1]:.1f}")

    for thrust, colour in ((0.0, pictures.GREY), (0.9, pictures.BLUE), (1.4, pictures.GREEN), (2.0, pictures.RED)):
        number = 1 + int(np.argmin(np.abs(flood(glued) - thrust)))
        joint = pictures.pairs_of(options.results / "cohesion", number)["joint"]
        middle.plot(joint["x"], joint["pressure"] / 1e6, "o-", color=colour, markersize=2.5, linewidth=1, label=f"thrust {thrust:.1f}")
    middle.axhline(-TENSION / 1e6, color="black", linewidth=0.7, linestyle=":")
    middle.text(15, -TENSION / 1e6 - 0.02, "tensile strength", ha="right", va="top", fontsize=8)
    middle.set(xlabel="along the joint from heel to toe (m)", ylabel="pressure in the joint (MPa)", title="what the joint carries")
    middle.legend()
    middle.grid(True)

    pairs = sum(glued["increments"][-1]["contacts"]["joint"][state] for state in ("open", "stick", "slip"))
    for summary, state, style, colour, name in ((plain, "slip", ":", pictures.GREY, "friction alone: slips"),
                                                (plain, "open", "--", pictures.GREY, "friction alone: open"),
                                                (glued, "broken", "-", pictures.RED, "with cohesion: broken")):
        share = [100 * increment["contacts"]["joint"][state] / pairs for increment in summary["increments"]]
        right.plot(flood(summary), share, style, color=colour, marker="o", markersize=2.5, label=name)
    right.axvline(LIMIT, color="black", linewidth=0.7, linestyle=":")
    right.text(LIMIT + 0.02, 60, "µ N", fontsize=8)
    right.set(xlabel="thrust / thrust of a full reservoir", ylabel="share of the pairs (%)", ylim=(0, 100), title="failure of the joint")
    right.legend(loc="upper left")
    right.grid(True)
    return figure


if __name__ == "__main__":
    main()
