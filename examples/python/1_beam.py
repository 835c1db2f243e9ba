"""Two beams in frictional contact: read a model, change it, run it, look at the interface.

The model is that of example 01; the paper is Zhu et al. 2017 (README of the example).
"""
import pathlib

import numpy as np

import scabo

example = pathlib.Path(__file__).resolve().parents[1] / "01_double_cantilever"
model = scabo.read(example / "model.yaml")
print(model.check())

# A model is a dictionary with the keys of its file.
print("\nfriction   normal force   tangential force   pairs that slip")
for friction in (0.0, 0.2, 0.5):
    model["contacts"]["joint"]["friction"] = friction
    result = model.run()
    joint = result.contact["joint"]
    slipping = joint.table()["state"] == "slip"
    print(f"{friction:8.1f}{joint.normal_force / 1e3:12.2f} kN{joint.tangential_force / 1e3:16.2f} kN{slipping.sum():18}")

# Arrays of the pairs show the memory of the solver; n points out of the lower beam, t along it.
table = joint.table()
closed = table["state"] != "open"
print("\n   x, m   pressure, kPa   shear, kPa   slip, mm")
for x, pressure, shear, slip in zip(*(table[name][closed] for name in ("x", "pressure", "shear", "slip"))):
    print(f"{x:7.3f}{pressure / 1e3:16.1f}{shear / 1e3:13.1f}{1e3 * slip:11.4f}")

# Displacement and stress anywhere inside, from the solution itself and not from a grid.
points = np.column_stack([np.full(5, 1e-6), np.linspace(1.5, 3.0, 5)])
print("\nBending stress of the upper beam beside its support, MPa:",
      np.round(result.stress(points, body="upper")[:, 0] / 1e6, 3))
print("Deflection of its tip, mm:", round(1e3 * result.displacement([[6.0, 3.0]])[0, 1], 3))
