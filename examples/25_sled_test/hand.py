#!/usr/bin/env python3
"""The sled test of model.yaml by hand: a rigid sled on a spring. The carriage at a pulls the sled at u with F = k (a - u). The sled
stays while -mu_b(s) N < F < mu_f(s) N and slides with F on one of these bounds otherwise; both coefficients fall linearly from their
static to their dynamic values while s, the sum of all slip forward and backward, grows to L (Ida 1972).

Between the places where stick and slip, or falling and constant friction, change, F is linear in a. The buffer is stiffer than friction
falls, k > (mu_s - mu_d) N / L, so that nothing jumps. The path: forward until half of L has passed, backward until the other half and
more has, forward again. Standard library only. Units of the model: N, m."""

WEIGHT = 5e3 * 0.08 * 0.05
STIFFNESS = 60e6 * 0.02 * 0.05
STATIC, DYNAMIC = {"forward": 0.3, "backward": 0.8}, {"forward": 0.2, "backward": 0.5}
LENGTH = 0.2e-3
TURNS = 11 / 60e3, -0.4e-3, 0.4e-3  # m, of the carriage


def bound(direction, slip):
    """mu N after this sum of slip."""
    return WEIGHT * (STATIC[direction] - (STATIC[direction] - DYNAMIC[direction]) * min(slip / LENGTH, 1.0))


def calculate():
    for direction in STATIC:
        assert STIFFNESS > (STATIC[direction] - DYNAMIC[direction]) * WEIGHT / LENGTH, "the sled would jump"
    first, second, third = TURNS
    # Forward: k (a - u) = mu_f(u) N, linear in u.
    fall = (STATIC["forward"] - DYNAMIC["forward"]) * WEIGHT / LENGTH
    u_1 = (STIFFNESS * first - bound("forward", 0.0)) / (STIFFNESS - fall)
    # Backward: at rest until the spring pushes with mu_b(u_1) N; the rest of L; then at the dynamic coefficient.
    peak = bound("backward", u_1)
    u_fallen = u_1 - (LENGTH - u_1)
    low = bound("backward", LENGTH)
    u_2 = second + low / STIFFNESS
    again = bound("forward", LENGTH)
    u_3 = third - again / STIFFNESS
    heat = (0.5 * (bound("forward", 0.0) + bound("forward", u_1)) * u_1 + 0.5 * (peak + low) * (LENGTH - u_1) +
            low * (u_fallen - u_2) + again * (u_3 - u_2))
    return {"starts": bound("forward", 0.0), "turned": bound("forward", u_1), "moved_1": u_1, "peak": -peak, "low": -low, "moved_2": u_2,
            "again": again, "moved_3": u_3, "heat": heat,
            "path": [(0.0, 0.0), (bound("forward", 0.0) / STIFFNESS, bound("forward", 0.0)), (first, bound("forward", u_1)),
                     (u_1 - peak / STIFFNESS, -peak), (u_fallen - low / STIFFNESS, -low), (second, -low),
                     (u_2 + again / STIFFNESS, again), (third, again)]}


if __name__ == "__main__":
    for name, value in calculate().items():
        if name != "path":
            print(f"{name:8} {value:14.6g}")
