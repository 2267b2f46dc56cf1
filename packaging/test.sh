#!/bin/sh
# Builds and runs every test. Stops at the first step that fails and says which.
set -eu

usage() {
  cat <<'TEXT'
usage: sh packaging/test.sh [--quick | --format | --tidy | --tsan | --window-asan]

Without an option: the format check, all tests in Release, and the core's tests once more under address and
undefined-behaviour sanitizers.

  --quick   without the sanitizers
  --format  only the format check
  --tidy    only clang-tidy over core, widgets and app
  --tsan    only the tests under the thread sanitizer
  --window-asan  only the window's tests under the address and undefined-behaviour sanitizers
  --help    print this text
TEXT
}

say() { printf 'test: %s\n' "$*" >&2; }

step=''
begin() {
  step=$1
  say "$step"
}

finish() {
  code=$?
  [ "$code" -eq 0 ] || [ -z "$step" ] || say "FAILED: $step"
  exit "$code"
}
trap finish EXIT

steps='format release asan'
case ${1-} in
  '') ;;
  --quick) steps='format release' ;;
  --format) steps='format' ;;
  --tidy) steps='tidy' ;;
  --tsan) steps='tsan' ;;
  --window-asan) steps='window_asan' ;;
  -h | --help)
    usage
    exit 0
    ;;
  *)
    say "unknown option '$1'"
    usage >&2
    exit 2
    ;;
esac
[ $# -le 1 ] || {
  say 'give one option at most'
  usage >&2
  exit 2
}

cd -- "$(dirname -- "$0")/.."
jobs=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)

begin 'set-up'
sh packaging/setup.sh

# The folders with C++ sources that exist.
source_folders() {
  for folder in app core tests widgets; do
    [ ! -d "$folder" ] || printf '%s\n' "$folder"
  done
}

check_format() {
  begin 'format'
  # Versions format differently; the sources follow that of Debian 12.
  case $(clang-format --version 2>/dev/null) in
    *'version 14.'*) ;;
    *)
      say 'no clang-format 14 here: skipped'
      return
      ;;
  esac
  # shellcheck disable=SC2046 # the folders' names are words
  find $(source_folders) \( -name '*.h' -o -name '*.cpp' \) -print0 | xargs -0 clang-format --dry-run -Werror
}

configure() {
  preset=$1
  shift
  begin "configure $preset"
  cmake --preset "$preset" "$@"
}

build() {
  begin "build $1"
  $around cmake --build --preset "$1" -j "$jobs"
}

run_tests() {
  preset=$1
  shift
  begin "tests $preset"
  $around ctest --preset "$preset" -j "$jobs" --no-tests=error --output-on-failure "$@"
}

# The labels that prove memory and arithmetic without the large models.
core_labels='^(unit|property|cli)$'
around=''

check_release() {
  # The window is part of what is tested, so it has to be there; its tests start a display of their own.
  configure release -DLORICA_WINDOW=ON
  build release
  run_tests release
}

check_asan() {
  export ASAN_OPTIONS="strict_string_checks=1:detect_stack_use_after_return=1${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
  export UBSAN_OPTIONS="print_stacktrace=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}"
  configure asan
  build asan
  run_tests asan -L "$core_labels" -LE '^data$'
}

check_window_asan() {
  # Qt's X11 plug-in reads strings as the strict check forbids; what font and graphics libraries keep to the end is theirs.
  export ASAN_OPTIONS="detect_leaks=0:detect_stack_use_after_return=1${ASAN_OPTIONS:+:$ASAN_OPTIONS}"
  export UBSAN_OPTIONS="print_stacktrace=1${UBSAN_OPTIONS:+:$UBSAN_OPTIONS}"
  configure asan -DLORICA_WINDOW=ON
  build asan
  run_tests asan -L '^window$'
}

check_tsan() {
  # The sanitizer of GCC 12 does not know the wide address randomisation of newer kernels; the tests are started
  # while building too, to be listed.
  if setarch "$(uname -m)" -R true 2>/dev/null; then
    around="setarch $(uname -m) -R"
  fi
  configure tsan
  build tsan
  run_tests tsan -L "$core_labels" -LE '^data$'
}

check_tidy() {
  configure release
  begin 'clang-tidy'
  if ! command -v run-clang-tidy >/dev/null 2>&1; then
    say 'run-clang-tidy is not here'
    return 1
  fi
  run-clang-tidy -quiet -p build/release -j "$jobs" "^$(pwd)/(core|app|widgets)/"
}

for one in $steps; do
  "check_$one"
done
step=''
say 'all passed'
