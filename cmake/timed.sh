#!/usr/bin/env bash
# cmake/timed.sh TITLE COMMAND...: runs the command under a heading and prints how long it took.
set -uo pipefail
title=$1
shift
printf '\n==== %s\n' "$title"
start=$SECONDS
"$@"
status=$?
if [ $status -eq 0 ]; then word="done"; else word="FAILED (exit status $status)"; fi
printf '==== %s: %s in %d s\n' "$title" "$word" $((SECONDS - start))
exit $status
