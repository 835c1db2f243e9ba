"""Bodies of revolution: names of their stresses, the other half of their section, and the section turned about its axis."""
import numpy as np

from . import geometry, vtu

NAMES = {"xx": "radial stress", "yy": "axial stress", "xy": "shear stress rz", "zz": "hoop stress",
         "ux": "radial displacement", "uy": "axial displacement"}
ODD = ("stress_xy",)  # with another sign on the other side of the axis
WEDGE, HEXAHEDRON, QUAD = 13, 12, 9


def mirrored(grid):
    """The section on both sides of the axis; both halves have its points in common."""
    count, ends = len(grid.points), len(grid.connectivity)
    on_axis = grid.points[:, 0] <= 1e-9 * geometry.extent(grid.points)
    image = np.where(on_axis, 0, count) + np.arange(count)
    twice = {name: np.concatenate([values, reflected(name, values)]) for name, values in grid.point_data.items()}
    return vtu.Grid(np.concatenate([grid.points, grid.points * [-1.0, 1.0]]), np.concatenate([grid.connectivity, image[grid.connectivity]]),
                    np.concatenate([grid.offsets, grid.offsets + ends]), np.tile(grid.types, 2), twice,
                    {name: np.concatenate([values, values]) for name, values in grid.cell_data.items()})


def reflected(name, values):
    """Values of a field at the mirror images of its points."""
    if name in ("displacement", "traction"):
        return values * np.array([-1.0, 1.0, 1.0], dtype=values.dtype)
    if name == "stress":  # xx, yy, zz, xy, yz, xz
        return values * np.array([1, 1, 1, -1, -1, 1], dtype=values.dtype)
    if name == "principal_angle":
        return -values
    return -values if name in ODD else values


def turned(grid, sectors):
    """Points, cells and fields of the bodies, once around the axis in `sectors` equal parts: points n x 3, prisms as (points, offsets, types),
    displacement n x 3, scalar fields by name. Of rigid bodies the surface."""
    corners, rigid = geometry.triangles(grid), geometry.rigid_outlines(grid)
    count, angles = len(grid.points), 2 * np.pi * np.arange(sectors) / sectors
    cosine, sine = (np.repeat(values, count) for values in (np.cos(angles), np.sin(angles)))
    around = lambda radial, axial: np.column_stack([np.tile(radial, sectors) * cosine, np.tile(axial, sectors), np.tile(radial, sectors) * sine])
    sides = np.concatenate([np.column_stack([body, np.roll(body, -1)]) for body in rigid]) if rigid else np.zeros((0, 2), dtype=int)
    cells, types = [], []
    for sector in range(sectors):
        here, there = sector * count, (sector + 1) % sectors * count
        cells += [np.column_stack([corners + there, corners + here]), np.column_stack([sides + here, (sides + there)[:, ::-1]])]
        types += [np.full(len(corners), WEDGE), np.full(len(sides), QUAD)]
    connectivity = np.concatenate([cell.ravel() for cell in cells])
    types = np.concatenate(types)
    offsets = np.cumsum(np.where(types == WEDGE, 6, 4))
    scalars = {name: np.tile(values, sectors) for name, values in grid.point_data.items() if values.ndim == 1}
    moved = grid.point_data.get("displacement")
    displacement = None if moved is None else around(moved[:, 0], moved[:, 1])
    return around(grid.points[:, 0], grid.points[:, 1]), (connectivity, offsets, types), displacement, scalars


def write_turned(grid, sectors, path):
    """A .vtu file of `turned`, for ParaView."""
    points, (connectivity, offsets, types), displacement, scalars = turned(grid, sectors)
    data = []

    def array(name, values, kind):
        values = np.ascontiguousarray(values, dtype=kind)
        offset = sum(8 + len(block) for block in data)
        data.append(values.tobytes())
        components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
        named = {"<f8": "Float64", "<f4": "Float32", "<i8": "Int64", "<u1": "UInt8"}[np.dtype(kind).newbyteorder("<").str.replace("|", "<")]
        return f'<DataArray type="{named}" Name="{name}"{components} format="appended" offset="{offset}"/>\n'

    fields = "".join(array(name, values, "<f4") for name, values in scalars.items())
    if displacement is not None:
        fields += array("displacement", displacement, "<f8")
    head = (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
            f'<UnstructuredGrid>\n<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(types)}">\n<PointData>\n{fields}</PointData>\n'
            f'<Points>\n{array("Points", points, "<f8")}</Points>\n<Cells>\n{array("connectivity", connectivity, "<i8")}'
            f'{array("offsets", offsets, "<i8")}{array("types", types, "<u1")}</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding="raw">\n_')
    with open(path, "wb") as file:
        file.write(head.encode())
        for block in data:
            file.write(np.uint64(len(block)).astype("<u8").tobytes() + block)
        file.write(b"\n</AppendedData>\n</VTKFile>\n")
