"""Limit loads of rigid blocks by linear programming, for the hand calculations of examples 40 and 44: the largest factor of the live loads
for which forces in the joints balance every block, press, and are within the cone of friction. NumPy only."""
import numpy as np


def limit(centres, joints, dead, live):
    """`centres`: a point of each block, n x 2. `joints`: (block below or -1, block above or -1, ends, unit normal from the first to the
    second, coefficient of friction). `dead`, `live`: force and moment about its point for each block, 3 n numbers."""
    columns = []
    for first, second, ends, normal, mu in joints:
        tangent = np.array([normal[1], -normal[0]])
        for end in ends:
            for part in (-mu, mu) if mu else (0.0,):  # the two sides of the cone
                force, column = normal + part * tangent, np.zeros(len(dead))
                for block, sign in ((second, 1.0), (first, -1.0)):
                    if block >= 0:
                        x, y = end - centres[block]
                        column[3 * block:3 * block + 3] = sign * np.array([*force, x * force[1] - y * force[0]])
                columns.append(column)
    cost = np.zeros(len(columns) + 1)
    cost[-1] = -1.0
    heaviest, largest = np.abs(dead).max(), np.abs(live).max()
    return smallest(cost, np.column_stack([*columns, live / largest]), -dead / heaviest)[-1] * heaviest / largest


def smallest(cost, matrix, right, tolerance=1e-10):
    """x >= 0 with matrix x = right and the smallest cost, by a primal-dual interior point method (Mehrotra 1992)."""
    scale = np.abs(matrix).max(axis=1)
    matrix, right = matrix / scale[:, None], right / scale
    rows, count = matrix.shape
    x, z, y = np.full(count, max(1.0, np.abs(right).max())), np.ones(count), np.zeros(rows)
    for _ in range(100):
        primal, dual, mean = matrix @ x - right, matrix.T @ y + z - cost, x @ z / count
        if max(np.abs(primal).max() / (1 + np.abs(right).max()), np.abs(dual).max(), mean / (1 + abs(cost @ x))) < tolerance:
            return x
        normal = (matrix * (x / z)) @ matrix.T
        normal += 1e-14 * np.trace(normal) / rows * np.eye(rows)

        def direction(product):
            of_y = np.linalg.solve(normal, -primal + matrix @ ((product - x * dual) / z))
            of_z = -dual - matrix.T @ of_y
            return (-product - x * of_z) / z, of_y, of_z

        def length(values, changes):
            falling = changes < 0
            return min(1.0, float(np.min(-values[falling] / changes[falling], initial=np.inf)))

        dx, _, dz = direction(x * z)
        ahead = (x + length(x, dx) * dx) @ (z + length(z, dz) * dz) / count
        dx, dy, dz = direction(x * z + dx * dz - (ahead / mean) ** 3 * mean)
        part, other = 0.995 * length(x, dx), 0.995 * length(z, dz)
        x, y, z = x + part * dx, y + other * dy, z + other * dz
    raise ArithmeticError("the linear program did not converge")
