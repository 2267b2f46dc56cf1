#!/bin/sh
# Installs what is missing, builds Release and runs the sample study, which leaves its tables in out/.
set -eu

usage() {
  cat <<'TEXT'
usage: sh packaging/run.sh [--headless] [--] [OPTION OF lorica-cli run]...

Installs what is missing, builds Release, writes the sample study to out/sample.lorica.json and runs it. Leaves
summary.csv, trials.csv and provenance.json in out/ and prints the summary.

  --headless  run without a window
  --help      print this text
  --          hand what follows to lorica-cli run, for example: -- --shots 1000000 --threads 2
TEXT
}

say() { printf 'run: %s\n' "$*" >&2; }

while [ $# -gt 0 ]; do
  case $1 in
    --headless) ;;
    -h | --help)
      usage
      exit 0
      ;;
    --)
      shift
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
study=out/sample.lorica.json
mkdir -p out
"$cli" template sample >"$study.new"
mv -f "$study.new" "$study"
say "running $study"
"$cli" run "$study" --out out "$@"
say "the tables are in $(pwd)/out"
