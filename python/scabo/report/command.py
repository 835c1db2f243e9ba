"""The command line of reports, `scabo report`. Exit status 0: the page was written; 1: the command line or the directory is wrong;
3: the page cannot be written."""
import argparse
import contextlib
import pathlib
import sys


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise SystemExit(complain(f"{message} (see `scabo report --help`)", 1))


def parser():
    options = Parser(prog="scabo report", description="Writes results as one page for the browser")
    options.add_argument("directory", type=pathlib.Path, metavar="DIR", help="results of `scabo run`")
    options.add_argument("-o", "--output", type=pathlib.Path, metavar="FILE", help="name of the page; default: model.report.html beside DIR")
    options.add_argument("--mirror", action="store_true", help="bodies of revolution: both halves of the section")
    options.add_argument("--units", metavar="LENGTH,FORCE", help="units of the model, as in --units m,N; the page can change them")
    options.add_argument("--size", type=float, default=25.0, metavar="MB",
                         help="largest size of the page in megabytes; default: 25. Of long runs it leaves out fields of increments")
    options.add_argument("--fields", metavar="NAMES", help="fields that the page has, of displacement, stress, principal, von_mises; default: all")
    options.add_argument("-q", "--quiet", action="store_true", help="does not print the name of the page")
    return options


def complain(message, status):
    with contextlib.suppress(OSError):  # where standard error cannot be written the status remains
        print(f"scabo report: {message}", file=sys.stderr, flush=True)
    return status


def main(words=None):
    try:
        options = parser().parse_args(words)
    except SystemExit as end:
        return end.code
    try:
        from . import page
        from .reading import ResultsError, UnitsError, screen
    except ImportError as error:
        return complain(f"{error}: install NumPy (apt install python3-numpy), or name another interpreter with SCABO_PYTHON", 3)
    try:
        path = page.write(options.directory, options.output, options.units, options.size, options.mirror, options.fields)
    except (ResultsError, UnitsError) as error:
        return complain(error, 1)
    except OSError as error:
        return complain(f"cannot write {options.output or page.default_name(options.directory)}: {error.strerror}", 3)
    except MemoryError:
        return complain("not enough memory for the page; give a smaller one with --size", 3)
    except KeyboardInterrupt:
        return 130
    if not options.quiet:
        screen.show("scabo report", path, "the page is")
    return 0
