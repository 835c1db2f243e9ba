#!/usr/bin/env bash
# cmake/run_fuzzers.sh BUILD_DIR [SECONDS]: runs every fuzzer of the build on a temporary copy of its corpus,
# tests/fuzz/corpus/NAME for the fuzzer fuzz_NAME, with the dictionary tests/fuzz/NAME.dict where there is one.
# Fails on a crash, a hang (60 s for one input, which needs less than one on an idle machine), a leak or more than 2 GB;
# keeps the input in BUILD_DIR/found. All fuzzers run, also after one that failed, as many at a time as there are processors.
set -euo pipefail
build=$1
seconds=${2:-60}
fuzz=$(cd "$(dirname "$0")/../tests/fuzz" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# fuzz_one NAME: prints at its end, at once, so that lines of several are not mixed.
fuzz_one() {
  local name=$1 log=$build/fuzz_$1.log said
  mkdir -p "$scratch/$name" "$build/found"
  if [ -d "$fuzz/corpus/$name" ]; then
    cp -r "$fuzz/corpus/$name/." "$scratch/$name/"
  fi
  if [ "$name" = read_model ]; then cp "$fuzz"/../input/good/*.yaml "$scratch/$name/"; fi  # every key there is
  local options=(-max_total_time="$seconds" -timeout=60 -rss_limit_mb=2048 -print_final_stats=1
                 -artifact_prefix="$build/found/$name-")
  if [ -f "$fuzz/$name.dict" ]; then options+=(-dict="$fuzz/$name.dict"); fi
  said="fuzz_$name: $(find "$scratch/$name" -type f | wc -l) inputs to start from, $seconds s"$'\n'
  local status=0
  UBSAN_OPTIONS=print_stacktrace=1 "$build/fuzz/fuzz_$name" "${options[@]}" "$scratch/$name" >"$log" 2>&1 || status=1
  said+=$(awk '/^stat::(number_of_executed_units|new_units_added|peak_rss_mb)/ { sub(/stat::/, "  "); print }' "$log")
  printf '%s\n' "$said"
  if [ $status -ne 0 ]; then
    printf '%s\n' "$(tail -n 60 "$log")" \
      "fuzz_$name: failed; the input is in $build/found, everything it said in $log" >&2
  fi
  return $status
}
export build seconds fuzz scratch
export -f fuzz_one

names=()
for fuzzer in "$build"/fuzz/fuzz_*; do
  if [ -x "$fuzzer" ]; then names+=("${fuzzer##*/fuzz_}"); fi
done
if [ ${#names[@]} -eq 0 ]; then
  echo "no fuzzer in $build/fuzz" >&2
  exit 1
fi
printf '%s\0' "${names[@]}" | xargs -0 -P "$(nproc)" -I NAME bash -c 'fuzz_one "$1"' _ NAME
