"""The model of the large runs: two rectangles in frictional contact, equal elements everywhere. The length of the interface gives the
number of pairs, the block below it the degrees of freedom."""
import math

MODEL = """scabo: 1
analysis: {{plane: strain}}
materials: {{steel: {{young: 210e9, poisson: 0.3}}}}
bodies:
  upper: {{material: steel, shape: {{rectangle: {{corner: [{left!r}, 0], size: [{upper[0]!r}, {upper[1]!r}]}}}}, mesh: {{{mesh}}}}}
  lower: {{material: steel, shape: {{rectangle: {{corner: [0, -{lower[1]!r}], size: [{lower[0]!r}, {lower[1]!r}]}}}}, mesh: {{{mesh}}}}}
supports: [{{on: lower.bottom, fix: [x, y]}}]
loads: {{down: {{on: upper.top, pressure: 100e6}}, push: {{on: upper.left, traction: [{push!r}, 0]}}}}
contacts: {{joint: {{between: [lower.top, upper.bottom], friction: 0.5}}}}
"""
KINDS = {  # mesh, degrees of freedom for each square of the side `size`
    "fem": ("kind: fem, order: 2", 6.0),
    "quadtree": ("kind: quadtree, order: 2", 6.0),
    "polygons": ("kind: polygons, order: 2", 10.5),
}
DOFS = (1e4, 1e5, 1e6, 2e6)
PAIRS = (32, 300, 1000, 3000)
LEAST_ROWS = 24  # degrees of freedom a pair: bodies of at least four rows of elements


def possible(dofs, pairs):
    return pairs * LEAST_ROWS <= dofs


def model_of(kind, dofs, pairs, push=1e6, more=""):
    """A square block with a smaller one on it; two layers as long as the interface if this is not possible."""
    mesh, dofs_of_square = KINDS[kind]
    squares = dofs / dofs_of_square
    along = max(1, round((pairs - 1) / 2))  # two pairs a side
    across = max(1, along // 2)
    side = math.sqrt(squares - along * across) if squares > along * across else 0.0
    if side > 1.2 * along:
        width = 2 ** round(math.log2(side)) if kind == "quadtree" else round(side)
        lower, upper = (width, round(side * side / width)), (along, across)
    else:
        across = max(1, round(squares / (2 * along)))
        lower, upper = (along, across), (along, across)
    size = 1 / 512  # exact: cells of a quadtree are halves of halves
    return MODEL.format(mesh=f"{mesh}, size: {size!r}", left=(lower[0] - upper[0]) // 2 * size, push=float(push),
                        upper=[n * size for n in upper], lower=[n * size for n in lower]) + more
