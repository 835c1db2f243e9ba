#!/usr/bin/env bash
# Prints the Python interpreter for tests, examples and benchmarks: the one named by the first argument or by
# SCABO_PYTHON, else the first of /usr/bin/python3 (the distribution's, which has the packages) and the python3
# on PATH that has every module. Fails and says what is missing where none has.
set -euo pipefail
modules="numpy matplotlib yaml jsonschema meshio h5py"

# Modules of $1 that cannot be imported, each with the reason.
missing() {
  "$1" - $modules 2>&1 <<'PYTHON' || echo "$1 does not run"
import importlib, sys
if sys.version_info < (3, 10):
    print("Python 3.10 or newer, this is %d.%d" % sys.version_info[:2])
for name in sys.argv[1:]:
    try:
        importlib.import_module(name)
    except Exception as error:
        print("%s (%s)" % (name, error))
PYTHON
}

named=${1:-${SCABO_PYTHON:-}}
if [ -n "$named" ]; then
  candidates=("$named")
else
  candidates=(/usr/bin/python3 python3)
fi

report=""
for candidate in "${candidates[@]}"; do
  if ! path=$(command -v "$candidate"); then
    report+="  $candidate: not found"$'\n'
    continue
  fi
  lacks=$(missing "$path")
  if [ -z "$lacks" ]; then
    echo "$path"
    exit 0
  fi
  report+="  $path lacks:"$'\n'"$(sed 's/^/    /' <<<"$lacks")"$'\n'
done
printf 'No suitable Python interpreter.\n%s%s\n' "$report" \
  "Run 'make packages', or name another with make PYTHON=..., -DSCABO_PYTHON=... or SCABO_PYTHON." >&2
exit 1
