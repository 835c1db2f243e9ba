"""A contact problem made by hand: a steel block on a rigid floor, held by contact alone, pressed and pushed.

The stiffness is that of one super-element. Flexibility, loads and rigid motions of the nodes on the floor are a discrete
contact problem, which is solved by itself, and again by Scabo from a model.
"""
import numpy as np

import scabo

young, poisson, friction, traction = 210e9, 0.3, 0.3, np.array([1e6, -10e6])
corners = [[0, 0], [2, 0], [2, 1], [0, 1]]

element = scabo.SuperElement(scabo.boundary_nodes(corners, 0.1, order=2), young, poisson)
nodes, K = element.nodes, element.stiffness

# The forces of a uniform traction on the top: 1/6, 4/6, 1/6 of what acts on each quadratic element.
f = np.zeros_like(nodes)
for first in range(0, len(nodes), 2):
    ends = [first, first + 1, (first + 2) % len(nodes)]
    if np.allclose(nodes[ends, 1], 1.0):
        length = np.linalg.norm(nodes[ends[2]] - nodes[ends[0]])
        f[ends] += np.outer([1 / 6, 4 / 6, 1 / 6], length * traction)
f = f.reshape(-1)

# Pairs: the nodes on the floor from left to right. n = +y out of the floor, t = +x: the motion of a pair is [u_y, u_x].
base = np.flatnonzero(nodes[:, 1] == 0.0)
base = base[np.argsort(nodes[base, 0])]
B = np.zeros((2 * len(base), K.shape[0]))
B[np.arange(0, 2 * len(base), 2), 2 * base + 1] = 1.0
B[np.arange(1, 2 * len(base), 2), 2 * base] = 1.0

# Rigid motions: two translations and the rotation about the centroid. Nothing but contact holds the block, so that K is
# singular: u = K+ (f + B'p) + R a, with 0 = R'(f + B'p). Any K+ that is right for forces in balance will do.
x, y = (nodes - nodes.mean(axis=0)).T
R = np.zeros((K.shape[0], 3))
R[0::2, 0] = R[1::2, 1] = 1.0
R[0::2, 2], R[1::2, 2] = -y, x
flexibility = np.linalg.inv(K + young * R @ R.T / len(nodes))

solution = scabo.solve_contact(W=B @ flexibility @ B.T, q=B @ flexibility @ f, mu=friction, G=B @ R, f=R.T @ f,
                               force_scale=np.abs(f).max())
normal, tangential = solution.forces.T
print(f"{solution.iterations} Newton iterations; worst figure of the certificate {max(solution.certificate.values()):.1e}")
print(f"normal force {normal.sum() / 1e6:.6f} MN, tangential force {tangential.sum() / 1e6:.6f} MN")
print("pairs that slip:", np.flatnonzero(solution.state == "slip") + 1, "of", len(base))

model = scabo.Model({
    "scabo": 1,
    "materials": {"steel": {"young": young, "poisson": poisson}},
    "bodies": {
        "floor": {"rigid": True, "shape": {"rectangle": {"corner": [-1, -1], "size": [4, 1]}}},
        "block": {"material": "steel", "shape": {"polygon": {"vertices": corners}}, "mesh": {"size": 0.1, "order": 2}},
    },
    "supports": [{"on": "floor", "fix": ["x", "y"]}],
    "loads": {"push": {"on": "block.edge_3", "traction": traction}},
    "contacts": {"base": {"between": ["floor.top", "block.edge_1"], "friction": friction}},
})
table = model.run().contact["base"].table()
difference = max(np.abs(table["normal_force"] - normal).max(), np.abs(table["tangential_force"] - tangential).max())
print(f"largest difference to the forces of a run of the same model: {difference / normal.max():.1e} of the largest force")
