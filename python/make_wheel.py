"""Packs the Python package of a build into a wheel; needs nothing from a network.

    make_wheel.py build/python/scabo --version 0.1.0 --output build/wheel

The extension module is that of this build: it needs the shared libraries of the system that it was built on (OpenBLAS,
SuiteSparse, HDF5 and others), so that the tag of the wheel is that of this Python and this platform.
"""
import argparse
import base64
import csv
import hashlib
import io
import pathlib
import sys
import sysconfig
import zipfile

METADATA = """Metadata-Version: 2.1
Name: scabo
Version: {version}
Summary: Frictional contact by the scaled boundary finite element method
License: BSD-3-Clause (source); GPL-3.0-or-later (binary, with the libraries that it is linked with)
Requires-Python: =={major}.{minor}.*
Requires-Dist: numpy
Provides-Extra: tables
Requires-Dist: pandas; extra == "tables"
Provides-Extra: pictures
Requires-Dist: matplotlib; extra == "pictures"

Scabo computes frictional contact between elastic bodies in the plane. The manual is docs/python.md of its sources.
"""

WHEEL = """Wheel-Version: 1.0
Generator: scabo make_wheel
Root-Is-Purelib: false
Tag: {tag}
"""


def tag():
    version = "cp%d%d" % sys.version_info[:2]
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{version}-{version}-{platform}"


def digest(content):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def contents(package, version):
    """Names in the wheel and what they contain."""
    info = f"scabo-{version}.dist-info"
    for path in sorted(package.rglob("*")):
        if path.suffix in (".py", ".pyi", ".so", ".html") or path.name == "py.typed":
            yield f"scabo/{path.relative_to(package).as_posix()}", path.read_bytes()
    major, minor = sys.version_info[:2]
    yield f"{info}/METADATA", METADATA.format(version=version, major=major, minor=minor).encode()
    yield f"{info}/WHEEL", WHEEL.format(tag=tag()).encode()
    license_file = pathlib.Path(__file__).resolve().parent.parent / "LICENSE"
    yield f"{info}/LICENSE", license_file.read_bytes()


def make_wheel(package, version, output):
    if not any(package.glob("_core*.so")):
        sys.exit(f"{package}: the package is not built: run `make python`")
    output.mkdir(parents=True, exist_ok=True)
    wheel = output / f"scabo-{version}-{tag()}.whl"
    record = io.StringIO(newline="")
    rows = csv.writer(record, lineterminator="\n")
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in contents(package, version):
            # The same time for all files: equal packages are equal wheels.
            entry = zipfile.ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
            rows.writerow([name, digest(content), len(content)])
        name = f"scabo-{version}.dist-info/RECORD"
        rows.writerow([name, "", ""])
        archive.writestr(zipfile.ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0)), record.getvalue())
    return wheel


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("package", type=pathlib.Path)
    parser.add_argument("--version", required=True)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    print(make_wheel(options.package, options.version, options.output))


if __name__ == "__main__":
    main()
