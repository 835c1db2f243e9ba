"""The page: a template that is built from report/ (Vite), filled with the results of one run."""
import html
import json
import math
import os
import pathlib
import tempfile

from .content import content_of
from .fields import add_fields, asked_for
from .mechanism import add_mechanism, mechanism_of
from .packing import Arrays
from .pairs import add_pairs
from .reading import Results, ResultsError, Units, refuse_impossible
from .space import add_space

MEGABYTES = 25.0  # of a page, unless the values of a single increment need more
TITLE, CONTENT, ARRAYS = "<!--scabo:title-->", "<!--scabo:content-->", "<!--scabo:arrays-->"


def template():
    """The text of the template: beside this file in the Python package, or in share/scabo. Raises ResultsError."""
    folder = pathlib.Path(__file__).absolute().parent
    places = [folder / "template.html", folder.parent / "report_template.html"]
    for place in places:
        try:
            text = place.read_text(encoding="utf-8")
        except FileNotFoundError:
            continue
        if all(text.count(mark) == 1 for mark in (TITLE, CONTENT, ARRAYS)):
            return text
        raise ResultsError(f"{place}: is not the page for reports: build Scabo again (make build)")
    raise ResultsError(f"the page for reports is not at {places[1] if folder.name == 'scabo_report' else places[0]}: `make report` in "
                       "the sources of Scabo builds it, and `make install` takes it along (it needs Node.js 18 or newer and npm: apt install nodejs npm)")


def page_of(directory, units=None, megabytes=MEGABYTES, mirrored=False, fields=None):
    """The text of the page for a results directory. `units`: length and force as in "m,N". `mirrored`: of bodies of revolution both halves
    of the section. `fields`: names of those that the page has, as in "displacement,von_mises"; None: all. Raises ResultsError, UnitsError."""
    text = template()
    if not (math.isfinite(megabytes) and megabytes > 0):
        raise ResultsError(f"--size {megabytes:g}: give a number of megabytes above 0")
    named = Units.parse(units) if units else None
    quantities = asked_for(fields)
    results = Results(directory, mirrored)
    check(results)
    content = content_of(results)
    content["units"] = [named.length, named.force] if named else None
    arrays = Arrays()
    room = max(0.0, megabytes * 1e6 - len(text) - len(json.dumps(content)))
    content["space"] = add_space(results, arrays, room, fields) if results.in_space else None
    if results.in_space:
        return filled(text, {**content, "field": None, "pairs": None, "mechanism": mechanism_of(results)}, arrays)
    shown = add_fields(results, arrays, 0.75 * room, quantities) if results.count else None
    centre = shown["centre"] if shown else [0.0, 0.0]
    content["field"] = shown
    content["pairs"] = add_pairs(results, arrays, 0.25 * room, centre)
    content["mechanism"] = add_mechanism(results, arrays, centre) if shown else None
    return filled(text, content, arrays)


def check(results):
    """The keys that a page is made of exist."""
    needed = ("step", "increment", "reached", "factors", "converged", "newton_iterations", "contacts")
    entries = results.summary.get("modes") if results.modal else results.summary.get("increments")
    if not isinstance(entries, list) or not isinstance(results.summary.get("model"), dict) or not results.modal and not all(
            isinstance(entry, dict) and all(key in entry for key in needed) for entry in entries):
        raise ResultsError(f"{results.directory / 'summary.json'}: is damaged or of another version of Scabo; run the model again")


def filled(text, content, arrays):
    """Texts of the user stand in JSON without the character <, so that none of them ends the script that holds it."""
    data = json.dumps(finite(content), ensure_ascii=False, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c").replace(
        "\u2028", "\\u2028").replace("\u2029", "\\u2029")
    parts = {TITLE: html.escape(finite(content["title"] or content["directory"])), ARRAYS: "".join(arrays.elements()),
             CONTENT: f'<script type="application/json" id="content">{data}</script>'}
    pieces = [text]
    for mark, replacement in parts.items():  # not one after the other in the text: a title may contain a mark
        pieces = [piece for whole in pieces for piece in split(whole, mark, replacement)]
    return "".join(piece if isinstance(piece, str) else piece[0] for piece in pieces)


def split(piece, mark, replacement):
    """A piece of the template around a mark; what was filled in, a tuple, is left alone."""
    if not isinstance(piece, str) or mark not in piece:
        return [piece]
    before, after = piece.split(mark)
    return [before, (replacement,), after]


def finite(value):
    """The same value with None for numbers that JSON does not know, and text that UTF-8 can express."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, str):
        return value.encode("utf-8", "replace").decode("utf-8")
    if isinstance(value, dict):
        return {key if isinstance(key, int) else finite(key): finite(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(entry) for entry in value]
    return value


def default_name(directory):
    """`model.report.html` beside `model.results`."""
    resolved = pathlib.Path(directory).resolve()
    beside = pathlib.Path(directory).parent if pathlib.Path(directory).name == resolved.name else resolved.parent
    return beside / f"{resolved.name.removesuffix('.results')}.report.html"


def write(directory, output=None, units=None, megabytes=MEGABYTES, mirrored=False, fields=None):
    """Writes the page and returns its path; `output` None: `model.report.html` beside `model.results`. A page that is there is
    replaced when the new one is complete. Raises ResultsError and UnitsError, and OSError where it cannot be written."""
    refuse_impossible(pathlib.Path(directory))
    path = default_name(directory) if output is None else pathlib.Path(output)
    if path.is_dir():
        raise ResultsError(f"-o {path}: is a directory: name a file, as in -o {path / 'report.html'}")
    text = page_of(directory, units, megabytes, mirrored, fields)
    if path.exists() and not path.is_file():  # a device or a pipe, which a new file must not replace
        path.write_text(text, encoding="utf-8")
        return path
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with open(handle, "w", encoding="utf-8") as file:
            file.write(text)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(name, 0o666 & ~mask)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise
    return path
