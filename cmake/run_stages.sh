#!/usr/bin/env bash
# cmake/run_stages.sh TITLE TARGET [TITLE TARGET...]: `make TARGET` for every stage, under its title and with the time it
# took. A stage that fails keeps no later one from running; the last lines name those that failed, with their tests, and
# the status is 1.
set -uo pipefail
marker=$(mktemp)
trap 'rm -f "$marker"' EXIT
summary=()
failed=0
while [ $# -ge 2 ]; do
  title=$1 target=$2
  shift 2
  printf '\n==== %s\n' "$title"
  start=$SECONDS
  if "${MAKE:-make}" --no-print-directory "$target"; then
    word="passed"
  else
    word="FAILED (exit status $?; again: make $target)"
    failed=$((failed + 1))
  fi
  summary+=("$title: $word in $((SECONDS - start)) s")
  printf '==== %s\n' "${summary[-1]}"
done
if [ ${#summary[@]} -gt 1 ]; then
  printf '\n==== All stages\n'
  printf '  %s\n' "${summary[@]}"
fi
for log in build*/Testing/Temporary/LastTestsFailed.log; do
  if [ "$log" -nt "$marker" ]; then
    printf '  %s:\n' "${log%%/*}"
    sed 's/^/    test /' "$log"
  fi
done
[ $failed -eq 0 ]
