"""A roller on a block: a model built in Python, refined until its estimated error is small, against Hertz (1882)."""
import math

import scabo

radius, force, poisson = 0.05, 1e6, 0.3                                  # m, N/m
steel, aluminium = 210e9, 70e9                                           # Pa


def roller_on_block(tolerance: float) -> scabo.Model:
    mesh = {"kind": "quadtree", "tolerance": tolerance}
    return scabo.Model({
        "scabo": 1,
        "title": "Roller on a block",
        "analysis": {"plane": "strain"},
        "materials": {"steel": {"young": steel, "poisson": poisson}, "aluminium": {"young": aluminium, "poisson": poisson}},
        "bodies": {
            "block": {"material": "aluminium", "mesh": {**mesh, "size": 0.05},
                      "shape": {"rectangle": {"corner": [-0.2, -0.2], "size": [0.4, 0.2]}}},
            "roller": {"material": "steel", "mesh": {**mesh, "size": 0.01},
                       "shape": {"outline": [{"line": {"from": [radius, radius], "to": [-radius, radius]}, "name": "top"},
                                             {"arc": {"to": [radius, radius], "centre": [0, radius]}, "name": "rim"}]}},
        },
        "supports": [{"on": "block.bottom", "fix": ["x", "y"]}, {"on": "roller.top", "fix": "x"}],
        "loads": {"press": {"on": "roller.top", "pressure": force / (2 * radius)}},
        "contacts": {"touch": {"between": ["block.top", "roller.rim"]}},
    })


modulus = 1.0 / ((1 - poisson**2) / steel + (1 - poisson**2) / aluminium)
half_width = math.sqrt(4 * force * radius / (math.pi * modulus))
pressure = 2 * force / (math.pi * half_width)
print(f"Hertz: largest pressure {pressure / 1e6:.2f} MPa, half width {1e3 * half_width:.4f} mm\n")
print("tolerance   degrees of freedom   estimated error   largest pressure   against Hertz")
for tolerance in (0.03, 0.01, 0.003):
    result = roller_on_block(tolerance).run()
    largest = result.contact["touch"].history()["max_pressure"][-1]
    print(f"{tolerance:9.3f}{result.summary['model']['dofs']:21}"
          f"{100 * result.increments[-1]['error']['relative_energy_norm']:16.2f} %"
          f"{largest / 1e6:15.2f} MPa{100 * (largest / pressure - 1):14.2f} %")
