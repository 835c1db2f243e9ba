#!/usr/bin/env bash
# Installs the packages of the named groups of cmake/packages.txt that are missing; silent when none is.
#   cmake/install_packages.sh build test
# SCABO_PACKAGES=no: touch nothing (the dependencies come from elsewhere).
set -euo pipefail

[ "${SCABO_PACKAGES:-yes}" = no ] && exit 0
list=$(dirname "$0")/packages.txt

fail() {
  printf 'packages: %s\n' "$@" >&2
  exit 1
}

# Lines of the wanted groups, one set of alternatives each: `a b c`.
wanted=$(awk -v groups=" $* " '
  { sub(/#.*/, ""); gsub(/\|/, " ") }
  !NF { next }
  /^\[/ { name = substr($1, 2, length($1) - 2); known[name]; take = index(groups, " " name " "); next }
  take
  END { n = split(groups, g, " ")
        for (i = 1; i <= n; i++) if (!(g[i] in known)) { print "no group " g[i] > "/dev/stderr"; exit 1 } }
' "$list") || fail "usage: $0 GROUP... (the groups of $list)"

first_of_each() { printf '%s\n' "$wanted" | awk '{ printf "%s ", $1 }'; }

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "this machine has no apt-get; install what corresponds to these Debian packages:" \
       "  $(first_of_each)" "and set SCABO_PACKAGES=no."
fi

# shellcheck disable=SC2086  # the names are words
installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' $wanted 2>/dev/null |
            awk '$2 == "installed" { print $1 }' || true)

missing=()  # sets of alternatives of which none is installed
while read -r -a alternatives; do
  found=no
  for name in "${alternatives[@]}"; do
    grep -qxF "$name" <<<"$installed" && found=yes && break
  done
  [ "$found" = yes ] || missing+=("${alternatives[*]}")
done <<<"$wanted"
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=(env DEBIAN_FRONTEND=noninteractive)
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    fail "missing: ${missing[*]%% *}" "neither root nor sudo: ask an administrator to run" \
         "  apt-get install --no-install-recommends ${missing[*]%% *}"
  as_root=(sudo "${as_root[@]}")
fi
apt=("${as_root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300)

# Not a pipe into grep -q: with pipefail its early end would look like a failure.
can_be_had() { [[ $(LC_ALL=C apt-cache policy "$1" 2>/dev/null) =~ Candidate:\ [^\(] ]]; }

# The first alternative that apt knows, for every missing set; in `unknown` the sets without one.
choose() {
  chosen=() unknown=()
  local set name
  for set in "${missing[@]}"; do
    for name in $set; do
      can_be_had "$name" && chosen+=("$name") && continue 2
    done
    unknown+=("${set%% *}")
  done
}

update() {
  echo "Updating the package lists"
  "${apt[@]}" update >/dev/null || fail "apt-get update failed"
  choose
}

install() {
  echo "Installing packages: ${chosen[*]}"
  "${apt[@]}" install -y --no-install-recommends "${chosen[@]}" >/dev/null
}

choose
updated=no
if [ ${#unknown[@]} -gt 0 ]; then
  update
  updated=yes
  [ ${#unknown[@]} -eq 0 ] || fail "apt knows no package for: ${unknown[*]}" \
    "(on Ubuntu they are in 'universe': add-apt-repository universe)"
fi
if ! install; then  # lists that are too old name versions that are gone
  [ $updated = no ] || fail "apt-get could not install: ${chosen[*]}"
  update
  install || fail "apt-get could not install: ${chosen[*]}"
fi
