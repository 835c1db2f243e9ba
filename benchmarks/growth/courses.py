#!/usr/bin/env python3
"""Courses of cracks beside loads, notches, inclusions and each other: runs five models and draws their paths, courses.png and half_disc.png.

    benchmarks/growth/courses.py --scabo build/bin/scabo
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "examples"))
import pictures
from pictures import np, plt

# Single-edge notched beam in shear (Arrea, Ingraffea 1982), millimetres and newtons. Point loads close the notch a little: its faces slide.
IN_SHEAR = """
scabo: 1
analysis: {plane: stress, thickness: 156}
materials: {mortar: {young: 24.8e3, poisson: 0.18}}
bodies:
  beam:
    material: mortar
    shape: {polygon: {vertices: [[0, 0], [600, 0], [1119, 0], [1322, 0], [1322, 306], [722, 306], [203, 306], [0, 306]]}}
    mesh: {kind: quadtree, size: 50}
    cracks: [{path: [[661, 0], [661, 82]], name: notch}]
contacts: {faces: {between: [beam.notch.left, beam.notch.right], friction: 0}}
supports: [{on: beam.vertex_2, fix: [x, y]}, {on: beam.vertex_3, fix: y}]
loads: {near: {on: beam.vertex_6, force: [0, -1000]}, far: {on: beam.vertex_7, force: [0, -130]}}
steps: [{growth: {toughness: {K_Ic: 40}, step: 10}}]
"""
# Both by plain finite elements: tests/verification/references/crack_paths_by_triangles.py in_shear --step 10 --size 20 --until 300, and two_notches
# --step 10 --size 20 --until 160
IN_SHEAR_BY_TRIANGLES = ((679.23, 89.88), (694.81, 102.39), (708.49, 116.97), (720.28, 133.11), (730.14, 150.51), (738.04, 168.87),
                         (744.02, 187.95), (748.17, 207.51), (750.59, 227.36), (751.43, 247.34))
TWO_NOTCHES_BY_TRIANGLES = ((408.91, 44.54), (424.8, 56.67), (438.81, 70.92), (450.48, 87.14), (459.7, 104.88), (466.9, 123.53))
# Two notches in four-point shear, antisymmetric, after Bocca, Carpinteri and Valente (1991).
TWO_NOTCHES = """
scabo: 1
analysis: {plane: stress, thickness: 100}
materials: {concrete: {young: 27e3, poisson: 0.18}}
bodies:
  beam:
    material: concrete
    shape: {polygon: {vertices: [[0, 0], [320, 0], [780, 0], [800, 0], [800, 200], [480, 200], [20, 200], [0, 200]]}}
    mesh: {kind: quadtree, size: 40}
    cracks: [{path: [[400, 0], [400, 40]], name: low}, {path: [[400, 200], [400, 160]], name: high}]
contacts:
  low: {between: [beam.low.left, beam.low.right], friction: 0}
  high: {between: [beam.high.left, beam.high.right], friction: 0}
supports: [{on: beam.vertex_2, fix: [x, y]}, {on: beam.vertex_3, fix: y}]
loads: {near: {on: beam.vertex_6, force: [0, -1000]}, far: {on: beam.vertex_7, force: [0, -210.526315789]}}
steps: [{growth: {toughness: {K_Ic: 40}, step: 10, until: {length: 160}}}]
"""
# An edge crack beside an inclusion a tenth or ten times as stiff.
INCLUSION = """
scabo: 1
analysis: {plane: strain}
materials: {stone: {young: 30e9, poisson: 0.2}, core: {young: 3e9, poisson: 0.2}}
bodies:
  plate:
    material: stone
    shape: {rectangle: {corner: [0, -1], size: [2, 2]}}
    regions: {core: {material: core, shape: {circle: {centre: [1, 0.25], radius: 0.2}}}}
    mesh: {kind: quadtree, size: 0.125}
    cracks: [{path: [[0, 0], [0.4, 0]], name: flaw}]
supports: [{on: plate.bottom, fix: [y]}, {on: plate.bottom_left, fix: [x]}]
loads: {pull: {on: plate.top, traction: [0, 1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.05, until: {length: 1.6}}}]
"""
# Two cracks beside each other under tension.
HOOKS = """
scabo: 1
analysis: {plane: stress}
materials: {steel: {young: 200e9, poisson: 0.3}}
bodies:
  plate:
    material: steel
    shape: {rectangle: {corner: [-10, -10], size: [20, 20]}}
    mesh: {kind: quadtree, size: 2}
    cracks: [{path: [[-2.2, -0.2], [-0.4, -0.2]], name: left}, {path: [[0.4, 0.2], [2.2, 0.2]], name: right}]
supports: [{on: plate.bottom_left, fix: [x, y]}, {on: plate.bottom_right, fix: [y]}]
loads: {up: {on: plate.top, traction: [0, 1e6]}, down: {on: plate.bottom, traction: [0, -1e6]}}
steps: [{growth: {toughness: {K_Ic: 1e6}, step: 0.2, cracks: [plate.left.end, plate.right.start], until: {steps: 24}}}]
"""


# Half a disc with an inclined notch in three-point bending (Ayatollahi, Aliha, Hassani 2006), millimetres and newtons. Points of the path that they
# computed and of the one that they measured, read off their figure by F. Loiseau (github.com/floiseau/gcrack).
HALF_DISC = """
scabo: 1
analysis: {plane: stress, thickness: 5}
materials: {acrylic: {young: 3e3, poisson: 0.38}}
bodies:
  disc:
    material: acrylic
    shape:
      outline:
        - {line: {from: [-50, 0], to: [-21.5, 0]}}
        - {line: {to: [0, 0]}}
        - {line: {to: [21.5, 0]}}
        - {line: {to: [50, 0]}}
        - {arc: {to: [0, 50], centre: [0, 0]}}
        - {arc: {to: [-50, 0], centre: [0, 0]}}
    mesh: {kind: quadtree, size: 4}
    cracks: [{path: [[0, 0], [7.5, "${7.5 * sqrt(3)}"]], name: notch}]
supports: [{on: disc.vertex_2, fix: [x, y]}, {on: disc.vertex_4, fix: [y]}]
loads: {P: {on: disc.vertex_6, force: [0, -100]}}
steps: [{growth: {toughness: {K_Ic: 40}, step: 1}}]
"""
COMPUTED = ((6.3, 14.9), (4.8, 18), (3.8, 21.2), (2.95, 24), (2.35, 27), (1.97, 30), (1.57, 33), (1.17, 36), (0.97, 40), (0.75, 44), (0.6, 48))
MEASURED = ((6.2, 15), (4.2, 18), (2.64, 21), (1.5, 24), (0.9, 27), (0.5, 30), (0.29, 33), (0.05, 36), (-0.2, 40), (-0.3, 44), (-0.43, 48))


def main():
    options = pictures.options_of(__doc__, HERE, "courses.results")
    options.output = HERE if options.output == HERE / "figures" else options.output
    options.results.mkdir(parents=True, exist_ok=True)
    draw_half_disc(options)
    figure = plt.figure(figsize=(11.0, 6.4), layout="constrained")
    (beam, notches), (inclusion, hooks) = figure.subplots(2, 2)
    draw(options, beam, "in_shear", IN_SHEAR, (480, 850), (0, 306), "mm", "notched beam in shear")
    beam.plot(*np.array(IN_SHEAR_BY_TRIANGLES).T, "s", color="k", mfc="none", ms=5, label="plain finite elements")
    beam.legend(loc="upper left")
    for x, y, down in ((600, 0, False), (722, 306, True)):
        arrow(beam, x, y, down, 22)
    draw(options, notches, "two_notches", TWO_NOTCHES, (250, 550), (0, 200), "mm", "two notches in four-point shear")
    notches.plot(*np.array(TWO_NOTCHES_BY_TRIANGLES).T, "s", color="k", mfc="none", ms=5)
    for x, y, down in ((320, 0, False), (480, 200, True)):
        arrow(notches, x, y, down, 16)
    for name, young, colour, dashes in (("soft", "3e9", pictures.BLUE, "--"), ("stiff", "300e9", pictures.RED, "-")):
        draw(options, inclusion, name, INCLUSION, (0, 2), (-0.6, 0.6), "m", "inclusion a tenth (dashed) and ten times as stiff", colour, dashes,
             (f"materials.core.young={young}",))
    draw(options, hooks, "hooks", HOOKS, (-2.4, 2.4), (-1.2, 1.2), "m", "two cracks beside each other")
    figure.savefig(options.output / "courses.png")
    print(options.output / "courses.png")


def draw_half_disc(options):
    figure, axis = plt.subplots(figsize=(7.6, 4.2), layout="constrained")
    draw(options, axis, "half_disc", HALF_DISC, (-52, 52), (-1, 51), "mm", "notched half disc in bending")
    for points, mark, label in ((COMPUTED, "s", "computed by Ayatollahi and others"), (MEASURED, "o", "measured by them")):
        axis.plot(*np.array(points).T, mark, color="k", mfc="none", ms=4, label=label)
    axis.legend(loc="upper right")
    figure.savefig(options.output / "half_disc.png")
    print(options.output / "half_disc.png")


def draw(options, axis, name, model, across, up, unit, title, colour=pictures.RED, dashes="-", settings=()):
    """The paths of a model over its cells."""
    path, directory = options.results / f"{name}.yaml", options.results / f"{name}.results"
    path.write_text(model, encoding="utf-8")
    summary = pictures.run(options.scabo, path, directory, *settings)
    print(f"{name}: {summary['growth']['ended']}")
    if not axis.lines:
        pictures.draw_cells(axis, directory, linewidths=0.25)
    for points in summary["growth"]["paths"].values():
        axis.plot(*np.array(points).T, dashes, color=colour, lw=1.6)
    axis.set(xlim=across, ylim=up, aspect="equal", xlabel=f"x ({unit})", ylabel=f"y ({unit})", title=title)


def arrow(axis, x, y, down, length):
    axis.annotate("", (x, y), (x, y + (length if down else -length)), arrowprops={"arrowstyle": "-|>", "color": "k", "lw": 1.4}, annotation_clip=False)


if __name__ == "__main__":
    main()
