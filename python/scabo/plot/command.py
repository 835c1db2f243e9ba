"""The command line of the pictures, `scabo plot`. Exit status 0: pictures were written; 1: the command line or the directory is
wrong; 3: a picture cannot be written."""
import argparse
import json
import logging
import math
import pathlib
import sys
import warnings

from . import memory, screen

KINDS = ("stress", "contact", "convergence", "mesh", "history", "lines", "cracks", "mechanism")
ON_REQUEST = ("envelope", "spectrum")  # not drawn without being named
NO_MEMORY = "not enough memory for pictures: raise the limit, as in `ulimit -v 1000000`, in kB"
FORMATS = (".png", ".svg", ".pdf")
APPLIES = {"increment": ("stress", "contact", "lines"), "component": ("stress", "contact", "history", "lines", "spectrum"), "contact": ("contact", "envelope"), "scale": ("stress", "mechanism"),
           "window": ("stress", "mesh", "cracks", "mechanism"), "view": ("stress", "mechanism"), "cut": ("stress",), "along": ("lines", "contact"),
           "units": ("stress", "contact", "mesh", "history", "lines", "cracks", "mechanism", *ON_REQUEST)}  # options that mean something for few kinds


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise SystemExit(complain(f"{message} (see `scabo plot --help`)", 1))


def parser():
    options = Parser(prog="scabo plot", description="Draws pictures of a results directory")
    options.add_argument("directory", type=pathlib.Path, metavar="DIR", help="results of `scabo run`, or a model file, which is drawn as it is")
    options.add_argument("--drawing", type=pathlib.Path, help=argparse.SUPPRESS)  # what the program says of a model that is DIR
    options.add_argument("--what", choices=(*KINDS, *ON_REQUEST, "all"), default="all",
                         help="what is drawn; default: all that the results have but envelope and spectrum")
    options.add_argument("--increment", type=int, metavar="N",
                         help="number from 1 over all steps, or of the mode; default -1, the last one")
    options.add_argument("--component", metavar="NAME", help="of stress, contact, history, lines or spectrum; a wrong name lists those there are")
    options.add_argument("--contact", action="append", default=[], metavar="NAME", help="only this contact; may be repeated")
    options.add_argument("--scale", type=float, metavar="S", help="magnification of displacements; default: one that shows them")
    options.add_argument("--window", metavar="X0,X1,Y0,Y1", help="only this part of stress, mesh, cracks and mechanism")
    options.add_argument("--mirror", action="store_true", help="bodies of revolution: both halves of the section")
    options.add_argument("--turned", type=int, metavar="N", help="bodies of revolution: writes no picture, but a .vtu file of the fields turned about the axis in N parts")
    options.add_argument("--view", metavar="AZIMUTH,ELEVATION", help="from where bodies in space are seen, in degrees; default: -60,25")
    options.add_argument("--cut", metavar="X,Y,Z,NX,NY,NZ", help="stress of bodies in space: a point of a plane and its normal; what this points to is taken away")
    options.add_argument("--along", metavar="X0,Y0,Z0,X1,Y1,Z1", help="lines and contact of bodies in space: values along this line")
    options.add_argument("--units", metavar="LENGTH,FORCE", help="units of the model, as in --units m,N")
    options.add_argument("-o", "--output", type=pathlib.Path, metavar="FILE",
                         help=".png, .svg or .pdf, of lines and along a line a .csv too; default: .png files beside DIR, one for each picture")
    return options


def complain(message, status):
    screen.complain("scabo plot", message)
    return status


def show(path):
    screen.show("scabo plot", path, "the pictures are")


def main(words=None):
    words = join_negative(sys.argv[1:] if words is None else words)
    try:
        options = parser().parse_args(words)
    except SystemExit as end:
        return end.code
    try:
        import matplotlib  # takes half a second: a wrong option is answered before
        matplotlib.use("Agg")
        from . import style
        from .results import ResultsError
        from .units import UnitsError
        memory.take_blas_buffer()
    except MemoryError:
        return complain(NO_MEMORY, 3)
    except ImportError as error:
        if memory.is_shortage(error):
            return complain(NO_MEMORY, 3)
        return complain(f"{error}: install NumPy and Matplotlib (apt install python3-matplotlib), or name another interpreter with "
                        "SCABO_PYTHON", 3)
    warnings.filterwarnings("ignore", message="Glyph .* missing")
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    style.apply()
    try:
        return write(options)
    except (ResultsError, UnitsError) as error:
        return complain(error, 1)
    except OSError as error:
        return complain(f"cannot write {error.filename or 'the picture'}: {error.strerror}", 3)
    except MemoryError:
        return complain(NO_MEMORY, 3)
    except KeyboardInterrupt:
        return 130


def join_negative(words):
    """`--window -1,2,0,1` is an option and its value, which argparse takes for an option of its own."""
    joined = []
    for word in words:
        if joined and joined[-1] in ("--window", "--scale", "--increment", "--view", "--cut", "--along") and word[:1] == "-" and word[1:2].isdigit():
            joined[-1] += "=" + word
        else:
            joined.append(word)
    return joined


def window_of(text):
    from .results import ResultsError
    if text is None:
        return None
    try:
        x0, x1, y0, y1 = map(float, text.split(","))
    except ValueError:
        raise ResultsError(f"--window {text}: give four numbers, as in --window 0,2,0,1") from None
    if not (x0 < x1 and y0 < y1):
        raise ResultsError(f"--window {text}: the numbers are x0,x1,y0,y1, with x0 below x1 and y0 below y1")
    return x0, x1, y0, y1


def view_of(text):
    from .results import ResultsError
    if text is None:
        return None
    try:
        azimuth, elevation = map(float, text.split(","))
    except ValueError:
        raise ResultsError(f"--view {text}: give two angles in degrees, as in --view -60,25") from None
    if not (abs(azimuth) <= 360 and abs(elevation) <= 90):
        raise ResultsError(f"--view {text}: the angles are azimuth, from -360 to 360 degrees, and elevation, from -90 to 90")
    return azimuth, elevation


def six_numbers(text):
    """Those of `0,0,0.1,1,0,0`; None of anything else."""
    try:
        numbers = list(map(float, text.split(",")))
    except ValueError:
        return None
    return numbers if len(numbers) == 6 and all(map(math.isfinite, numbers)) else None


def cut_of(text):
    from .results import ResultsError
    if text is None:
        return None
    numbers = six_numbers(text)
    if numbers is None or not any(numbers[3:]):
        raise ResultsError(f"--cut {text}: give a point of the plane and its normal, as in --cut 0,0,0.1,1,0,0")
    return numbers[:3], numbers[3:]


def along_of(text):
    from .results import ResultsError
    if text is None:
        return None
    numbers = six_numbers(text)
    if numbers is None or numbers[:3] == numbers[3:]:
        raise ResultsError(f"--along {text}: give both ends of a line, as in --along 0,0,0,1,0,0")
    return numbers[:3], numbers[3:]


def refuse_other_dimension(options, results):
    from .results import ResultsError
    if results.in_space and options.window is not None:
        raise ResultsError("--window: has no meaning for bodies in space; --view says from where they are seen")
    if results.in_space and options.what not in ("all", "stress", "contact", "lines", "mechanism"):
        raise ResultsError(f"--what {options.what}: of a model in space there are pictures of stress, contact, lines and mechanism")
    if not results.in_space and options.view is not None:
        raise ResultsError(f"--view: {results.directory} is of a model in the plane")
    if not results.in_space and options.cut is not None:
        raise ResultsError(f"--cut: {results.directory} is of a model in the plane")
    if not results.in_space and options.along is not None:
        raise ResultsError(f"--along: {results.directory} is of a model in the plane, whose `output: {{lines: ...}}` gives values along lines")
    if options.along is not None and options.what == "all":
        raise ResultsError("--along: say of what, as in --what lines or --what contact")


def figures(options, results, increment):
    """Names and functions of the wanted figures."""
    from . import contacts, crack_paths, curves, fields, in_time, mechanisms, meshes, paths, solids
    from .units import Units
    units = Units.parse(options.units) if options.units else Units()
    if results.in_space:
        component, along = options.component if options.what != "all" else None, along_of(options.along)
        return {"stress": lambda: solids.stress(results, increment, component, options.scale, units, view_of(options.view), cut_of(options.cut)),
                "contact": lambda: solids.contact(results, increment, options.contact, component, units, along),
                "lines": lambda: paths.lines(results, increment, component, units, along),
                "mechanism": lambda: solids.mechanism(results, options.scale, units, view_of(options.view))}
    window = window_of(options.window)
    one = options.what != "all"
    component = options.component if one else None
    return {
        "stress": lambda: fields.stress(results, increment, component, options.scale, units, window),
        "contact": lambda: contacts.contact(results, increment, options.contact, component, units),
        "convergence": lambda: curves.convergence(results),
        "mesh": lambda: meshes.mesh(results, units, window),
        "history": lambda: curves.history(results, component, units),
        "lines": lambda: paths.lines(results, increment, component, units),
        "cracks": lambda: crack_paths.cracks(results, units, window),
        "envelope": lambda: in_time.envelope(results, options.contact, units),
        "spectrum": lambda: in_time.spectrum(results, component, units),
        "mechanism": lambda: mechanisms.mechanism(results, options.scale, units, window),
    }


def write(options):
    from .results import NothingToDraw, Results, ResultsError, refuse_impossible
    from .sweeps import Sweep
    as_table = options.output is not None and options.output.suffix.lower() == ".csv" and (options.what == "lines" or options.along is not None)
    if options.output is not None and options.turned is None and options.output.suffix.lower() not in FORMATS and not as_table:
        raise ResultsError(f"-o {options.output}: the name must end in .png, .svg or .pdf")
    if options.drawing is not None:
        return write_model(options)
    refuse_impossible(options.directory)
    if options.what == "all" and options.component is not None and not Sweep.is_in(options.directory):
        raise ResultsError(f"--component {options.component}: say of what, as in --what stress")
    if options.scale is not None and not 0 <= options.scale < math.inf:
        raise ResultsError(f"--scale {options.scale:g}: give a number that is not negative, 0 for the undeformed shape")
    for option, kinds in APPLIES.items():
        if getattr(options, option) not in (None, []) and options.what not in (*kinds, "all"):
            raise ResultsError(f"--{option}: has no meaning for --what {options.what}")
    if Sweep.is_in(options.directory):
        return write_sweep(options)
    results = Results(options.directory, options.mirror)
    if options.turned is not None:
        return write_turned(options, results)
    increment = -1 if options.increment is None else options.increment
    refuse_other_dimension(options, results)
    if as_table:
        return write_along(options, results, increment)
    kinds = kinds_of(results, options.what)
    if kinds != ["mechanism"]:
        results.number(increment)
    drawn = {}
    for kind, draw in figures(options, results, increment).items():
        if kind not in kinds:
            continue
        try:
            drawn[kind] = draw()
        except NothingToDraw as error:
            if options.what == kind or options.contact and kind == "contact":
                raise
            screen.write(sys.stderr, f"no picture of {kind}: {error}")
    if not drawn:
        raise NothingToDraw(f"{options.directory}: has nothing to draw")
    for figure in drawn.values():
        figure.draw_without_rendering()  # the layout follows from the labels, and these from the layout
    save(drawn, options)
    return 0


def write_along(options, results, increment):
    """Values along lines as a table."""
    from . import paths
    from .results import ResultsError
    along = along_of(options.along)
    if options.units is not None:
        raise ResultsError("--units: a table has the units of the model; leave it out")
    if options.what == "contact":
        if options.component is not None:
            raise ResultsError("--component: the table of a contact has all of pressure, shear, gap and slip; leave it out")
        paths.write_contact_table(results, increment, options.contact, along, options.output)
    else:
        paths.write_table(results, increment, options.component, along, options.output)
    screen.show("scabo plot", options.output, "the file is")
    return 0


def write_model(options):
    """The picture of a model before it is solved."""
    from .models import model
    from .results import ResultsError
    from .units import Units
    for option in ("increment", "component", "contact", "scale", "view", "cut", "along", "mirror", "turned"):
        if getattr(options, option) not in (None, [], False):
            raise ResultsError(f"--{option}: has no meaning for a model that is not solved")
    if options.what != "all":
        raise ResultsError(f"--what {options.what}: of a model that is not solved there is one picture; solve it with `scabo run`")
    drawing = json.loads(options.drawing.read_text(encoding="utf-8"))
    figure = model(drawing, Units.parse(options.units) if options.units else Units(), window_of(options.window))
    figure.draw_without_rendering()
    path = options.output or options.directory.with_suffix(".model.png")
    figure.savefig(path)
    show(path)
    return 0


def write_turned(options, results):
    """Fields of one increment once around the axis of revolution."""
    from . import revolution
    from .results import ResultsError
    if not results.revolved or options.mirror:
        raise ResultsError(f"--turned {options.turned}: is for bodies of revolution (plane: axisymmetric), without --mirror")
    if not 3 <= options.turned <= 720:
        raise ResultsError(f"--turned {options.turned}: give a number of parts from 3 to 720, as in --turned 36")
    if options.output is not None and options.output.suffix.lower() != ".vtu":
        raise ResultsError(f"-o {options.output}: the name must end in .vtu")
    grid = results.fields(results.number(-1 if options.increment is None else options.increment))
    directory = options.directory.resolve()
    path = options.output or options.directory.parent / f"{directory.name.removesuffix('.results')}.turned.vtu"
    revolution.write_turned(grid, options.turned, path)
    screen.show("scabo plot", path, "the file is")
    return 0


def has_lines(results):
    return (results.directory / "lines.csv").exists()


def kinds_of(results, what):
    """What is to be drawn. In few runs cracks grow, or they end as a mechanism; where the first increment does, there is nothing else."""
    if what != "all":
        return [what]
    if results.mechanism() is not None and not results.count:
        return ["mechanism"]
    if results.in_space:
        return ["stress", "contact"] + ["lines"] * has_lines(results) + ["mechanism"] * (results.mechanism() is not None)
    missing = [kind for kind, there in (("lines", has_lines(results)), ("cracks", "growth" in results.summary), ("mechanism", results.mechanism() is not None)) if not there]
    return [kind for kind in KINDS if kind not in missing]


def write_sweep(options):
    """The picture of a sweep, in which --component names columns of its table."""
    from .results import ResultsError
    from .sweeps import sweep
    from .units import Units
    for option in ("increment", "contact", "scale", "window", "view", "cut", "along", "mirror", "turned"):
        if getattr(options, option) not in (None, [], False):
            raise ResultsError(f"--{option}: has no meaning for a sweep")
    if options.what != "all":
        raise ResultsError(f"--what {options.what}: {options.directory} is a sweep, of which there is one picture; draw one of its points, "
                           f"such as {options.directory / 'point_001'}")
    names = [name.strip() for name in (options.component or "").split(",") if name.strip()]
    figure = sweep(options.directory, names, Units.parse(options.units) if options.units else Units())
    figure.draw_without_rendering()
    directory = options.directory.resolve()
    path = options.output or options.directory.parent / f"{directory.name.removesuffix('.sweep')}.sweep.png"
    figure.savefig(path)
    show(path)
    return 0


def save(drawn, options):
    """Prints the name of each file. Several pictures go into one .pdf, or into files whose names end in what they show."""
    from . import style
    output = options.output
    if output is not None and output.suffix.lower() != ".png":
        for figure in drawn.values():
            style.close_gaps(figure)
    if output is not None and output.suffix.lower() == ".pdf" and len(drawn) > 1:
        from matplotlib.backends.backend_pdf import PdfPages
        with PdfPages(output) as pages:
            for figure in drawn.values():
                pages.savefig(figure)
        show(output)
        return
    for kind, figure in drawn.items():
        if output is None:
            directory = options.directory.resolve()
            stem = directory.name.removesuffix(".results")
            path = options.directory.parent / f"{stem}.{kind}.png" if directory.name == options.directory.name else \
                directory.parent / f"{stem}.{kind}.png"
        else:
            path = output if options.what != "all" else output.with_name(f"{output.stem}.{kind}{output.suffix}")
        figure.savefig(path)
        show(path)
