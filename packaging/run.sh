#!/bin/sh
# Installs what is missing, builds Release and opens the sample study in the window; without a display it runs the study,
# which leaves its tables and a report in out/.
set -eu

usage() {
  cat <<'TEXT'
usage: sh packaging/run.sh [--headless] [--] [OPTION OF lorica-cli run]...

Installs what is missing, builds Release and writes the sample study to out/sample.lorica.json. With a display it opens
the study in the window. Without one it runs it, leaves the tables (summary.csv, deformation.csv, ...),
provenance.json and the report (report.pdf) in out/ and prints the summary.

  --headless  run without a window although there is a display
  --help      print this text
  --          run without a window and hand what follows to lorica-cli run, for example: -- --shots 1000000
TEXT
}

say() { printf 'run: %s\n' "$*" >&2; }

headless=''
[ -n "${DISPLAY-}${WAYLAND_DISPLAY-}" ] || headless=yes

while [ $# -gt 0 ]; do
  case $1 in
    --headless) headless=yes ;;
    -h | --help)
      usage
      exit 0
      ;;
    --)
      shift
      headless=yes
      break
      ;;
    *)
      say "unknown option '$1'"
      usage >&2
      exit 2
      ;;
  esac
  shift
done

cd -- "$(dirname -- "$0")/.."
sh packaging/setup.sh

# Runs a quiet step; when it fails, shows the end of what it said.
log=build/release/run.log
mkdir -p build/release
step() {
  "$@" >"$log" 2>&1 && return 0
  tail -n 40 "$log" >&2
  say "failed: $*"
  say "the whole output is in $(pwd)/$log"
  exit 1
}

jobs=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)
if [ ! -e build/release/build.ninja ]; then
  say 'building Release; the first time takes some minutes'
  step cmake --preset release
fi
step cmake --build --preset release --target lorica-cli -j "$jobs"

cli=build/release/app/cli/lorica-cli
window=build/release/app/gui/lorica
study=out/sample.lorica.json
mkdir -p out
if [ -z "$headless" ]; then
  if grep -q 'app/gui/lorica' build/release/build.ninja; then
    step cmake --build --preset release --target lorica -j "$jobs"
  else
    say 'the window cannot be built here, so the study runs without it; packaging/setup.sh says what is missing'
    headless=yes
  fi
fi
# An open study is the user's: what is there is not written over.
if [ -n "$headless" ] || [ ! -e "$study" ]; then
  "$cli" template sample >"$study.new"
  mv -f "$study.new" "$study"
fi
if [ -z "$headless" ]; then
  say "opening $study"
  exec "$window" "$study"
fi
say "running $study"
# Reports need Qt, which a build has when it has the window.
if grep -q 'app/gui/lorica' build/release/build.ninja; then
  "$cli" run "$study" --out out --pdf "$@"
  say "the tables and report.pdf are in $(pwd)/out"
else
  "$cli" run "$study" --out out "$@"
  say "the tables are in $(pwd)/out; a report needs Qt, and packaging/setup.sh says what is missing"
fi
