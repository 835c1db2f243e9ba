"""Performance profiles (Dolan and More, Math. Program. 91 (2002) 201): for each solver, the share of problems it solves within
a factor of the fastest solver of each problem."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
import numpy

STYLE = {"Scabo": "-", "Siconos": "--"}


def profile(seconds, factors):
    """seconds: solver -> {problem: time, only where solved}. Shares of all problems for each factor."""
    names = sorted({name for times in seconds.values() for name in times})
    best = {name: min(times[name] for times in seconds.values() if name in times) for name in names}
    return {solver: [numpy.mean([times.get(name, numpy.inf) <= factor * best[name] for name in names]) if names else 0.0
                     for factor in factors] for solver, times in seconds.items()}


def draw(panels, file, caption):
    """panels: title -> (seconds, number of all problems)."""
    figure, axes = pyplot.subplots(1, len(panels), figsize=(6.2 * len(panels), 4.6), squeeze=False)
    for axis, (title, (seconds, count)) in zip(axes[0], panels.items()):
        factors = numpy.geomspace(1.0, 1e5, 400)
        solved = len({name for times in seconds.values() for name in times})
        colours = pyplot.rcParams["axes.prop_cycle"].by_key()["color"]
        for index, (solver, shares) in enumerate(profile(seconds, factors).items()):
            axis.step(factors, numpy.array(shares) * solved / max(count, 1), where="post", label=solver,
                      linestyle=STYLE["Scabo" if solver.startswith("Scabo") else "Siconos"],
                      color=colours[index % len(colours)], linewidth=2.6 if solver == "Scabo b_differentiable" else 1.4)
        axis.set(xscale="log", xlim=(1.0, 1e5), ylim=(0.0, 1.02), title=f"{title}, {count} problems",
                 xlabel="time / time of the fastest solver", ylabel="share of problems solved")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7.5, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    figure.suptitle(caption, fontsize=10)
    figure.tight_layout()
    figure.savefig(file, dpi=110)
    pyplot.close(figure)
