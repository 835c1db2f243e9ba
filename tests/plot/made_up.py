"""Results made up for tests: two increments of two contacts, and a grid with every type of cell whose fields are known functions."""
import json
import pathlib
import struct
import sys
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python" / "scabo"))  # the package for pictures alone, as it is installed

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import numpy as np  # noqa: E402

NAMES = {"f8": "Float64", "f4": "Float32", "i4": "Int32", "u1": "UInt8"}
CONTACT_HEADER = ("step,increment,contact,pair,x,y,gap,slip,normal_force,tangential_force,pressure,shear,state,normal_displacement_a,"
                  "tangential_displacement_a,normal_displacement_b,tangential_displacement_b")


def vtu(path, arrays, encoding="raw", cut=None):
    """Writes arrays {"Points": ..., "connectivity": ..., "offsets": ..., "types": ..., "point": {}, "cell": {}} as Scabo does."""
    data, pieces = b"", 1 << 6

    def element(name, values, kind):
        nonlocal data
        values = np.ascontiguousarray(values, dtype="<" + kind)
        components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
        start = f'<DataArray type="{NAMES[kind]}" Name="{name}"{components} '
        if encoding == "text":
            return start + 'format="ascii">' + " ".join(repr(v.item()) for v in values.reshape(-1)) + "</DataArray>\n"
        at, content = len(data), values.tobytes()
        if encoding == "raw":
            data += struct.pack("<Q", len(content)) + content
        else:
            parts = [content[k:k + pieces] for k in range(0, len(content), pieces)]
            packed = [zlib.compress(part) for part in parts]
            data += struct.pack(f"<{3 + len(parts)}Q", len(parts), pieces, len(content) % pieces, *map(len, packed)) + b"".join(packed)
        return start + f'format="appended" offset="{at}"/>\n'

    compressor = ' compressor="vtkZLibDataCompressor"' if encoding == "zlib" else ""
    text = ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"'
            f'{compressor}>\n<!-- by a test -->\n<UnstructuredGrid><Piece NumberOfPoints="{len(arrays["Points"])}" '
            f'NumberOfCells="{len(arrays["types"])}"><PointData>\n')
    text += "".join(element(name, values, {"displacement": "f8", "body": "i4"}.get(name, "f4")) for name, values in arrays["point"].items())
    text += "</PointData><CellData>\n" + "".join(element(name, values, "i4") for name, values in arrays["cell"].items())
    text += "</CellData><Points>\n" + element("Points", arrays["Points"], "f8") + "</Points><Cells>\n"
    text += element("connectivity", arrays["connectivity"], "i4") + element("offsets", arrays["offsets"], "i4") + element(
        "types", arrays["types"], "u1") + "</Cells></Piece></UnstructuredGrid>\n"
    content = text.encode()
    if encoding != "text":
        content += b'<AppendedData encoding="raw">\n_' + data + b"\n</AppendedData>\n"
    path.write_bytes((content + b"</VTKFile>\n")[:cut])


def grid():
    """A triangle, a quadrilateral, a quadratic triangle and a quadratic quadrilateral of area 0.5, 1, 0.5 and 1, each a body of its
    own, and a rigid square. Displacement (0.01 x, -0.02 y), von Mises stress 3 + x, stress xx 2 x - 5."""
    triangle = np.array([[0, 0], [1, 0], [0, 1]], dtype=float)
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    with_middles = lambda corners: np.concatenate([corners, 0.5 * (corners + np.roll(corners, -1, axis=0))])
    cells = [(5, triangle), (9, square + [2, 0]), (22, with_middles(triangle) + [4, 0]), (23, with_middles(square) + [6, 0]),
             (7, square * [7, -0.5])]
    points = np.concatenate([at for _, at in cells])
    sizes = [len(at) for _, at in cells]
    x, y = points.T
    zero = np.zeros(len(points))
    rigid = np.arange(len(points)) >= len(points) - 4
    stress = lambda values: np.where(rigid, 0.0, values)
    return {"Points": np.column_stack([points, zero]), "connectivity": np.arange(len(points)), "offsets": np.cumsum(sizes),
            "types": [kind for kind, _ in cells],
            "point": {"displacement": np.column_stack([0.01 * x, -0.02 * y, zero]), "stress_xx": stress(2 * x - 5),
                      "von_mises": stress(3 + x), "body": np.repeat(np.arange(1, 6), sizes)},
            "cell": {"body": [1, 2, 3, 4, 5]}}


def contact_rows(increment=1):
    """Pairs of step 1 and of step 2, increment 1: a quarter of a circle, and a line of three pairs."""
    rows = []
    for step in (1, 2):
        for k, angle in enumerate(np.linspace(0, np.pi / 2, 9)):
            state = ("open", "stick", "slip")[k // 3]
            rows.append([step, increment, "bend", k + 1, np.cos(angle), np.sin(angle), 0.001 * (state == "open") * step, 0.002 * k * step, 10.0 + k,
                         k, 1e6 * (k + 1) * step, -2e5 * k, state, 0, 0, 0, 0])
        for k in range(3):
            rows.append([step, increment, "_seat", k + 1, 3.0 + k, 0.0, 0.0, -0.001 * k * step, 5.0, 1.0, 3e5 * step, 1e5, "stick", 0, 0, 0, 0])
    return rows


def summary():
    def entry(step):
        force = lambda f: {"normal_force": f * step, "tangential_force": -0.3 * f * step, "open": 3, "stick": 3, "slip": 3, "max_gap": 0.001,
                           "max_pressure": 1.0, "first_pair_in_contact": 1, "last_pair_in_contact": 2}
        return {"step": step, "increment": 1, "reached": 1, "factors": {"push": 0.5 * step, "weight": 1.0}, "converged": True,
                "newton_iterations": 3, "coarse_iterations": 0, "residual": 1e-12, "contacts": {"bend": force(100.0), "_seat": force(40.0)},
                "reactions": {"ground": [3.0 * step, -8.0]}, "cracks": {}, "certificate": {"equilibrium": 1e-14},
                "energy": {"external": 2.0 * step, "elastic": 1.5 * step, "friction": 0.5 * step}, "error": None}
    failed = {**entry(2), "increment": 2, "converged": False, "contacts": {}, "reactions": {}, "certificate": None, "energy": None}
    return {"scabo": "0.1.0", "title": "A title with $ and _ in it", "status": "not_converged", "reason": "made up", "warnings": [],
            "warning_kinds": [], "model": {"nodes": 20, "dofs": 40, "super_elements": 4, "contact_pairs": 12}, "passes": [],
            "increments": [entry(1), entry(2), failed], "timing": {}, "peak_memory_bytes": 1}


def convergence_rows():
    """Step 1 in two iterations from a coarse problem; step 2 in a second attempt; its increment 2 never."""
    return [(1, 1, 1, 0, "newton, 5 pairs", 1.0), (1, 1, 1, 1, "newton", 0.1), (1, 1, 1, 2, "newton", 0.0), (2, 1, 1, 0, "newton", 1.0),
            (2, 1, 1, 1, "newton", 3.0), (2, 1, 2, 0, "newton", 0.5), (2, 1, 2, 1, "newton", 1e-13), (2, 2, 1, 0, "newton", 0.7),
            (2, 2, 1, 1, "newton", 0.6)]


def write(directory):
    directory.mkdir()
    (directory / "summary.json").write_text(json.dumps(summary()), encoding="utf-8")
    later = [[*row[:6], 9.0, 9.0, *row[8:]] for row in contact_rows(2) if row[0] == 2]  # while a run writes, summary.json is behind
    lines = [CONTACT_HEADER] + [",".join(str(value) for value in row) for row in contact_rows() + later]
    (directory / "contact.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    lines = ["step,increment,attempt,iteration,stage,residual,merit,step_length,states_changed"] + [
        f'{s},{i},{a},{n},"{stage}",{r},0,1,0' for s, i, a, n, stage, r in convergence_rows()]
    (directory / "convergence.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (directory / "fields.pvd").write_text('<?xml version="1.0"?>\n<VTKFile type="Collection"><Collection>\n' + "".join(
        f'<DataSet timestep="{k}" part="0" file="fields_000{k}.vtu"/>\n' for k in (1, 2)) + "</Collection></VTKFile>\n", encoding="utf-8")
    for k in (1, 2):
        arrays = grid()
        arrays["point"]["displacement"] = k * arrays["point"]["displacement"]
        vtu(directory / f"fields_000{k}.vtu", arrays)
    return directory
