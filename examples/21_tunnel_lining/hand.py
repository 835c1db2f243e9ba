#!/usr/bin/env python3
"""Thrust and moment in the lining of a circular tunnel in ground under the far stress -P vertically and -K P horizontally,
with and without slip between them, in plane strain. Two calculations:

- `elasticity`: ring and ground by Airy's stress functions, exact for a ring of any thickness. Of the far stress only the
  terms 1 and cos 2 theta are left, theta from the horizontal:
      mean term   u_r = A r + B / r
      second      phi = (a r^2 + b r^4 + c / r^2 + d) cos 2 theta,  the ground with c and d only
  and the coefficients follow from the continuity of displacement and traction at the interface. The displacement of the
  ground counts from the ground at rest: the lining is put in together with the excavation.
- `thin_shell`: Einstein and Schwartz, "Simplified analysis for tunnel supports", J. Geotech. Engng Div. ASCE 105 (1979)
  499-518, for a lining so thin that its radius is that of the tunnel.

Standard library only. Units of the model: N, m; forces and moments for each metre of tunnel, thrust positive in tension,
moment positive with tension outside."""

GROUND, CONCRETE = (150e6, 0.3), (15e9, 0.2)  # Young's modulus, Poisson's ratio
P, K, R, T = 0.4e6, 0.5, 3.0, 0.3
PLACES = {"side": 1.0, "crown": -1.0}  # cos 2 theta


def solve(matrix, right):
    """Gaussian elimination with pivots."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [x - factor * y for x, y in zip(rows[k], rows[i])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][k] * x[k] for k in range(i + 1, n))) / rows[i][i]
    return x


def mean_term(material, r):
    """u_r, sigma_rr, sigma_tt of A = 1 and of B = 1."""
    young, poisson = material
    stress = young / (1 + poisson)
    return (r, stress / (1 - 2 * poisson), stress / (1 - 2 * poisson)), (1 / r, -stress / r**2, stress / r**2)


def second_term(material, r):
    """Factors of cos 2 theta in u_r, sigma_rr, sigma_tt and of sin 2 theta in u_t, sigma_rt, of a, b, c and d = 1:
    tuples u_r, u_t, rr, rt, tt."""
    young, poisson = material
    double_shear, kappa = young / (1 + poisson), 3 - 4 * poisson
    raw = ((-2 * r, 2 * r, -2, 2, 2),
           ((kappa - 3) * r**3, (kappa + 3) * r**3, 0, 6 * r**2, 12 * r**2),
           (2 / r**3, 2 / r**3, -6 / r**4, -6 / r**4, 6 / r**4),
           ((kappa + 1) / r, -(kappa - 1) / r, -4 / r**2, -2 / r**2, 0))
    return [(ur / double_shear, ut / double_shear, rr, rt, tt) for ur, ut, rr, rt, tt in raw]


def ring_and_ground(slip, thickness=T):
    """Coefficients: A and B of the ring, B of the ground; a, b, c, d of the ring, c, d of the ground."""
    inner = R - thickness
    far_mean, far_second = -P * (1 + K) / 2, P * (1 - K) / 2  # rr of the far stress; rt is -far_second
    at_inner, at_outer, ground = mean_term(CONCRETE, inner), mean_term(CONCRETE, R), mean_term(GROUND, R)
    mean = solve([[at_inner[0][1], at_inner[1][1], 0],
                  [at_outer[0][0], at_outer[1][0], -ground[1][0]],
                  [at_outer[0][1], at_outer[1][1], -ground[1][1]]], [0, 0, far_mean])
    at_inner, at_outer, ground = second_term(CONCRETE, inner), second_term(CONCRETE, R), second_term(GROUND, R)[2:]
    both = [*at_outer, *([-value for value in mode] for mode in ground)]
    alone = [*at_outer, (0,) * 5, (0,) * 5]
    matrix = [[mode[i] for mode in (*at_inner, (0,) * 5, (0,) * 5)] for i in (2, 3)] + [[mode[i] for mode in both] for i in (0, 2)]
    right = [0, 0, 0, far_second]
    if slip:
        matrix += [[mode[3] for mode in alone], [mode[3] for mode in ((0,) * 5,) * 4 + tuple(ground)]]
        right += [0, far_second]
    else:
        matrix += [[mode[i] for mode in both] for i in (1, 3)]
        right += [0, -far_second]
    return mean, solve(matrix, right)


def elasticity(slip, thickness=T):
    """The hoop stress integrated over the thickness (Gauss, exact to rounding): {"side": (thrust, moment), ...}."""
    mean, second = ring_and_ground(slip, thickness)
    result = {}
    for place, cosine in PLACES.items():
        thrust = moment = 0.0
        for x, weight in ((-0.9602898564975363, 0.1012285362903763), (-0.7966664774136267, 0.2223810344533745),
                          (-0.5255324099163290, 0.3137066458778873), (-0.1834346424956498, 0.3626837833783620)):
            for s in (x, -x):
                r = R - thickness / 2 + s * thickness / 2
                hoop = sum(value * mode[2] for value, mode in zip(mean, mean_term(CONCRETE, r)))
                hoop += cosine * sum(value * mode[4] for value, mode in zip(second, second_term(CONCRETE, r)))
                thrust += weight * thickness / 2 * hoop
                moment += weight * thickness / 2 * hoop * s * thickness / 2
        result[place] = thrust, moment
    return result


def thin_shell(slip, thickness=T):
    """Einstein and Schwartz (1979), with the compressibility ratio C and the flexibility ratio F."""
    (young, nu), (young_lining, nu_lining) = GROUND, CONCRETE
    ratio = young * (1 - nu_lining**2) / (young_lining * (1 - nu**2))
    c, f = ratio * R / thickness, ratio * R**3 / (thickness**3 / 12)
    a0 = c * f * (1 - nu) / (c + f + c * f * (1 - nu))
    if slip:
        a2 = (f + 6) * (1 - nu) / (2 * f * (1 - nu) + 6 * (5 - 6 * nu))
        thrust_2, moment_2 = (1 - K) / 2 * (1 - 2 * a2), (1 - K) / 2 * (1 - 2 * a2)
    else:
        beta = ((6 + f) * c * (1 - nu) + 2 * f * nu) / (3 * f + 3 * c + 2 * c * f * (1 - nu))
        b2 = c * (1 - nu) / (2 * (c * (1 - nu) + 4 * nu - 6 * beta - 3 * beta * c * (1 - nu)))
        a2 = beta * b2
        thrust_2, moment_2 = (1 - K) / 2 * (1 + 2 * a2), (1 - K) / 4 * (1 - 2 * a2 + 2 * b2)
    return {place: (-P * R * ((1 + K) / 2 * (1 - a0) + cosine * thrust_2), P * R**2 * cosine * moment_2)
            for place, cosine in PLACES.items()}


def calculate():
    numbers = {}
    for kind, slip in (("slip", True), ("no_slip", False)):
        for name, result in (("elasticity", elasticity(slip)), ("shell", thin_shell(slip))):
            for place, (thrust, moment) in result.items():
                numbers[f"{kind}_{place}_thrust_{name}"] = thrust
                numbers[f"{kind}_{place}_moment_{name}"] = moment
    return numbers


if __name__ == "__main__":
    for name, value in calculate().items():
        print(f"{name:32} {value / 1e3:10.3f} kN or kN m")
