"""`python3 FOLDER DIR ...` where FOLDER is this one, under whatever name it was installed: it needs no package around it."""
import importlib
import pathlib
import sys

if __package__:
    from .command import main
else:
    folder = pathlib.Path(__file__).absolute().parent
    sys.path[0] = str(folder.parent)  # instead of this folder, whose modules would hide others of the same name
    main = importlib.import_module(folder.name + ".command").main

if __name__ == "__main__":
    if sys.stdout is not None:
        sys.stdout.reconfigure(errors="surrogateescape")  # the name of a file is printed as it is, whatever its bytes
    sys.exit(main())
