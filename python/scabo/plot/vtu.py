"""The .vtu and .pvd files that Scabo writes: text, or raw appended data in one piece or compressed by zlib
(docs/decisions/0002-vtu-writer.md). Other forms of the format are refused."""
import dataclasses
import xml.etree.ElementTree as xml
import zlib

import numpy as np

TYPES = {"Float64": "f8", "Float32": "f4", "Int32": "i4", "UInt8": "u1", "Int64": "i8"}
TRIANGLE, POLYGON, QUAD, LINE, QUADRATIC_TRIANGLE, QUADRATIC_QUAD = 5, 7, 9, 3, 22, 23
TETRAHEDRON, QUADRATIC_TETRAHEDRON, QUADRATIC_HEXAHEDRON, QUADRATIC_WEDGE = 10, 24, 25, 26


class FormatError(ValueError):
    """The file is not one that Scabo wrote, or a part of it is missing."""


@dataclasses.dataclass
class Grid:
    """An unstructured grid."""
    points: np.ndarray        # n x 2, or n x 3 in space
    connectivity: np.ndarray  # points of all cells in sequence
    offsets: np.ndarray       # for each cell the end of its points in `connectivity`
    types: np.ndarray         # for each cell, VTK's number
    point_data: dict          # name: n or n x components
    cell_data: dict

    def cells(self, kind):
        """Points of each cell of one type that has a fixed number of points: cells x points."""
        ends = self.offsets[self.types == kind]
        if len(ends) == 0:
            return np.zeros((0, 3), dtype=int)
        size = int(ends[0] - self.starts()[self.types == kind][0])
        return self.connectivity[ends[:, None] - size + np.arange(size)]

    def starts(self):
        return np.concatenate([[0], self.offsets[:-1]]).astype(int)

    def lists(self, kind):
        """Points of each cell of one type, of any length."""
        chosen = self.types == kind
        return [self.connectivity[start:end] for start, end in zip(self.starts()[chosen], self.offsets[chosen])]


def read_grid(path, dimension=2):
    """Points have `dimension` coordinates. Raises FormatError, and OSError where the file cannot be read."""
    content = path.read_bytes()
    try:
        return _grid_of(content, dimension)
    except FormatError:
        raise
    except (xml.ParseError, zlib.error, ValueError, KeyError, AttributeError, IndexError) as error:
        raise FormatError(str(error)) from error


def read_parts(path):
    """The grid of a .pvtu, whose parts were written by several processes: as one process writes it, but for the order of cells and of the
    points inside them. Errors as of read_grid."""
    try:
        pieces = xml.fromstring(path.read_bytes()).findall("PUnstructuredGrid/Piece")
        names = [piece.attrib["Source"] for piece in pieces]
    except (xml.ParseError, KeyError) as error:
        raise FormatError(str(error)) from error
    parts = [read_grid(path.parent / name) for name in names]
    if not parts or any("node" not in part.point_data for part in parts):
        raise FormatError("it names no parts with nodes")
    return _joined(parts)


def _joined(parts):
    """Points that are the same node with the same values in several parts become one. The points of every body follow each other, nodes
    first."""
    shift = np.cumsum([0] + [len(part.points) for part in parts])
    ends = np.cumsum([0] + [len(part.connectivity) for part in parts])
    joined = lambda arrays: np.concatenate(list(arrays))
    points = joined(part.points for part in parts)
    data = {name: joined(part.point_data[name] for part in parts) for name in parts[0].point_data}
    node, body = data.pop("node"), data["body"]
    connectivity = joined(part.connectivity + first for part, first in zip(parts, shift))
    # Equal nodes come together, points inside cells (which have no number) stay apart.
    table = np.column_stack([body, node] + [np.nan_to_num(values.reshape(len(points), -1).astype(float)) for values in data.values()])
    inside = node < 0
    table[inside, 1] = np.max(node, initial=0) + 1 + np.arange(np.count_nonzero(inside))
    _, first, copy_of = np.unique(table, axis=0, return_index=True, return_inverse=True)
    copy_of = copy_of.reshape(-1)
    # Several points at a node, where materials meet: the first stands among the nodes, the others behind them.
    kept_body, kept_node = body[first], node[first].astype(int)
    again = np.zeros(len(first), dtype=bool)
    again[1:] = (kept_node[1:] >= 0) & (kept_node[1:] == kept_node[:-1]) & (kept_body[1:] == kept_body[:-1])
    order = np.lexsort([np.where(kept_node < 0, first, kept_node), np.where(kept_node < 0, 2, again.astype(int)), kept_body])
    place = np.empty(len(first), dtype=int)
    place[order] = np.arange(len(order))
    chosen = first[order]
    return Grid(points[chosen], place[copy_of][connectivity].astype("i4"),
                joined(part.offsets + end for part, end in zip(parts, ends)).astype("i4"), joined(part.types for part in parts),
                {name: values[chosen] for name, values in data.items()},
                {name: joined(part.cell_data[name] for part in parts) for name in parts[0].cell_data})


def read_collection(path):
    """Times and names of the files of a .pvd, in its order."""
    try:
        sets = xml.fromstring(path.read_bytes()).findall("Collection/DataSet")
        return [(float(entry.attrib["timestep"]), entry.attrib["file"]) for entry in sets]
    except (xml.ParseError, ValueError, KeyError) as error:
        raise FormatError(str(error)) from error


def _grid_of(content, dimension):
    appended = content.find(b"<AppendedData")
    head, data = (content, b"") if appended < 0 else (content[:appended] + b"</VTKFile>",
                                                      memoryview(content)[content.index(b"_", appended) + 1:])
    if appended >= 0 and b'encoding="raw"' not in content[appended:appended + 80]:
        raise FormatError("its appended data are not raw")
    root = xml.fromstring(head)
    order = "<" if root.attrib.get("byte_order") == "LittleEndian" else ">"
    compressed = "compressor" in root.attrib
    piece = root.find("UnstructuredGrid/Piece")

    def values_of(node):
        kind = np.dtype(order + TYPES[node.attrib["type"]])
        if node.attrib["format"] == "ascii":
            values = np.array((node.text or "").split(), dtype=kind.newbyteorder("="))
        elif node.attrib["format"] == "appended":
            values = np.frombuffer(_block(data, int(node.attrib["offset"]), order, compressed), dtype=kind)
        else:
            raise FormatError(f"an array in the format '{node.attrib['format']}'")
        components = int(node.attrib.get("NumberOfComponents", 1))
        return values.reshape(-1, components) if components > 1 else values

    def arrays_of(name):
        return {node.attrib["Name"]: values_of(node) for node in piece.find(name) or ()}

    cells = arrays_of("Cells")
    grid = Grid(arrays_of("Points")["Points"].reshape(-1, 3)[:, :dimension], cells["connectivity"], cells["offsets"], cells["types"],
                arrays_of("PointData"), arrays_of("CellData"))
    wanted = int(piece.attrib["NumberOfPoints"]), int(piece.attrib["NumberOfCells"])
    if (len(grid.points), len(grid.types)) != wanted or any(len(values) != wanted[0] for values in grid.point_data.values()):
        raise FormatError("it has fewer values than it says")
    return grid


def _block(data, offset, order, compressed):
    """The bytes of an array: their number in 64 bits before them; or compressed, number and sizes of pieces before them."""
    number = lambda at: int(np.frombuffer(data[at:at + 8], dtype=order + "u8")[0])
    if not compressed:
        size = number(offset)
        block = data[offset + 8:offset + 8 + size]
        if len(block) != size:
            raise FormatError("it ends in the middle of an array")
        return block
    count = number(offset)
    if count > len(data):
        raise FormatError("an array of impossible size")
    at, pieces = offset + 8 * (3 + count), []
    for k in range(count):
        size = number(offset + 8 * (3 + k))
        pieces.append(zlib.decompress(data[at:at + size]))
        at += size
    return b"".join(pieces)
