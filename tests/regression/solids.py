"""Files of models in space, as tests read them. Standard library only."""
import re
import struct


def arrays_of(file):
    """Arrays of an uncompressed .vtu file by name; `node_body`: `body` of the points."""
    content = file.read_bytes()
    begin = content.index(b"<AppendedData")
    data = content.index(b"_", begin) + 1
    arrays = {}
    for kind, name, offset in re.findall(rb'<DataArray type="(\w+)" Name="(\w+)".*offset="(\d+)"', content[:begin]):
        at = data + int(offset)
        size, = struct.unpack_from("<Q", content, at)
        letter, width = {b"Float64": ("d", 8), b"Float32": ("f", 4), b"Int32": ("i", 4), b"UInt8": ("B", 1)}[kind]
        key = "node_body" if name == b"body" and "node_body" not in arrays else name.decode()
        arrays[key] = struct.unpack_from(f"<{size // width}{letter}", content, at + 8)
    return arrays


def vector(row, name):
    return [float(row[f"{name}_{axis}"]) for axis in "xyz"]
