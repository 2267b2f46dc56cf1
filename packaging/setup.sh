#!/bin/sh
# Installs what Lorica needs to be built and tested, as far as it is missing. Safe to repeat; quick and silent when
# nothing is missing. Debian 12 and newer, and its kin, by apt; elsewhere it says what has to be there.
#
# LORICA_VTK_SOURCE  where the source package of the installed VTK is kept for the window (default: the user's cache)
set -eu

# Packages by what they are for. "a|b": the first of them that the distribution offers. The CMake package of libzip is
# found only where its three programs are too.
build_tools='g++ cmake ninja-build ccache mold pkg-config clang-format clang-tidy git'
engine='libembree-dev libtinygltf-dev libtbb-dev libeigen3-dev nlohmann-json3-dev libcli11-dev libfmt-dev
  libspdlog-dev libssl-dev libzip-dev zipcmp zipmerge ziptool libboost-dev libvtk9-dev'
tests='libgtest-dev librapidcheck-dev libbenchmark-dev libcgal-dev'
window='qt6-base-dev libqt6opengl6-dev|qt6-base-dev qt6-svg-dev|libqt6svg6-dev qt6-charts-dev|libqt6charts6-dev
  libmeshoptimizer-dev libgl1-mesa-dri xvfb xauth fonts-dejavu-core fonts-liberation2|fonts-liberation poppler-utils
  dpkg-dev'
wanted="$build_tools $engine $tests $window"

say() { printf 'setup: %s\n' "$*" >&2; }

fail() {
  say "$*"
  exit 1
}

# Where apt is unknown nothing can be installed: a look at what is there, and a plain list of what is not.
check_without_apt() {
  lacking=''
  for tool in cmake ninja pkg-config git; do
    command -v "$tool" >/dev/null 2>&1 || lacking="$lacking $tool"
  done
  compiler=${CXX:-c++}
  if command -v "${compiler%% *}" >/dev/null 2>&1; then
    # One run of the preprocessor answers for all headers: each that is not there leaves its library's name.
    # shellcheck disable=SC2086 # CXX may carry options
    lacking="$lacking $(while read -r library headers; do
      printf '#if 1'
      for header in $headers; do printf ' && !__has_include(<%s>)' "$header"; done
      printf '\nLACKS %s\n#endif\n' "$library"
    done <<'HEADERS' | $compiler -std=c++20 -E -x c++ - 2>/dev/null | sed -n 's/^LACKS //p' | tr '\n' ' '
Embree embree3/rtcore.h embree4/rtcore.h
tinygltf tiny_gltf.h tinygltf/tiny_gltf.h
TBB tbb/parallel_for.h
Eigen eigen3/Eigen/Core Eigen/Core
nlohmann-json nlohmann/json.hpp
CLI11 CLI/CLI.hpp
fmt fmt/format.h
spdlog spdlog/spdlog.h
OpenSSL openssl/sha.h
libzip zip.h
Boost.Math boost/math/distributions/students_t.hpp
GoogleTest gtest/gtest.h
RapidCheck rapidcheck.h
HEADERS
    )"
  else
    lacking="$lacking $compiler"
  fi
  # Word splitting is wanted: an empty or blank list is no list.
  # shellcheck disable=SC2086
  set -- $lacking
  [ $# -gt 0 ] || return 0
  say "this system has no apt, so nothing can be installed for you, and this is missing: $*"
  cat >&2 <<'LIST'
setup: Lorica needs
  a C++20 compiler (GCC 12), CMake 3.25, Ninja, pkg-config, git; ccache and mold where present
  Embree 3.13, tinygltf 2.7, TBB 2021, Eigen 3.4, VTK 9.1, nlohmann-json 3.11, CLI11 2.1, fmt 9, spdlog 1.10,
  OpenSSL 3 (libcrypto), libzip 1.7, Boost 1.74 (headers)
  for the tests: GoogleTest 1.12, RapidCheck, Google Benchmark 1.7; CGAL 5.5 (headers) for one ratio of the benchmarks
  for the window: Qt 6.4 (Widgets, OpenGLWidgets, Charts, Svg, PrintSupport, Test), meshoptimizer 0.18, Xvfb, Mesa,
  poppler-utils; the fonts Liberation Sans or DejaVu Sans for reports
LIST
  exit 1
}

if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
  check_without_apt
  exit 0
fi

# What is installed, in one question: lines of "package status upstream-version full-version".
# shellcheck disable=SC2046 # the list is made of words
known=$(dpkg-query -W -f='${Package} ${db:Status-Status} ${source:Upstream-Version} ${source:Version}\n' \
  $(printf '%s' "$wanted" | tr '|' ' ') 2>/dev/null) || true

installed() {
  case "
$known" in
    *"
$1 installed "*) return 0 ;;
  esac
  return 1
}

offered() {
  case $(LC_ALL=C apt-cache policy "$1" 2>/dev/null) in
    '' | *'Candidate: (none)'*) return 1 ;;
  esac
  return 0
}

# Sets `missing` to the packages to install; a name nobody offers is kept, for apt to complain about by name.
find_missing() {
  missing=''
  for group in $wanted; do
    first=${group%%|*}
    installed "$first" && continue
    choice=$first
    if [ "$group" != "$first" ] && ! offered "$first"; then
      second=${group#*|}
      installed "$second" && continue
      ! offered "$second" || choice=$second
    fi
    missing="$missing $choice"
  done
  missing=${missing# }
}

# Runs a command as root.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif [ -t 0 ]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

may_install() {
  [ "$(id -u)" -eq 0 ] && return 0
  command -v sudo >/dev/null 2>&1 || return 1
  [ -t 0 ] || sudo -n true 2>/dev/null
}

install_missing() {
  may_install || fail "these packages are missing and installing them needs root or sudo: $missing
setup: as root: apt-get install --no-install-recommends $missing"
  say "installing $missing"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 update >&2 ||
    say 'apt-get update had trouble; going on with the package lists that are there'
  # On a fresh machine the alternatives can be told apart only now that there are lists.
  find_missing
  # shellcheck disable=SC2086 # a list of words
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
    install --no-install-recommends $missing >&2 || fail "apt-get could not install: $missing"
  known=$(dpkg-query -W -f='${Package} ${db:Status-Status} ${source:Upstream-Version} ${source:Version}\n' libvtk9-dev)
}

# The machine's own source lists, saying deb-src, and a state folder of their own below $1: nothing of the system's
# lists, caches or hooks is touched.
write_private_apt() {
  mkdir -p "$1/lists/partial" "$1/cache/archives/partial" "$1/parts"
  main_list='' list_folder=''
  eval "$(apt-config shell main_list Dir::Etc::sourcelist/f list_folder Dir::Etc::sourceparts/d)"
  for list in "$main_list" "${list_folder%/}"/*.list; do
    [ ! -r "$list" ] || sed -n 's/^[[:space:]]*deb\(-src\)\{0,1\}\([[:space:]]\)/deb-src\2/p' "$list"
  done | awk '!seen[$0]++' >"$1/parts/one-line.list"
  for list in "${list_folder%/}"/*.sources; do
    [ ! -r "$list" ] || sed 's/^[Tt][Yy][Pp][Ee][Ss]:.*/Types: deb-src/' "$list" >"$1/parts/${list##*/}"
  done
  cat >"$1/apt.conf" <<CONF
Dir::Etc::sourcelist "/dev/null";
Dir::Etc::sourceparts "$1/parts";
Dir::State::lists "$1/lists";
Dir::Cache "$1/cache";
Dir::Cache::pkgcache "";
Dir::Cache::srcpkgcache "";
Acquire::Languages "none";
Acquire::Retries "1";
Acquire::http::Timeout "10";
Acquire::https::Timeout "10";
#clear APT::Update::Pre-Invoke;
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
CONF
  if [ "$(id -u)" -eq 0 ]; then
    # The folder is root's alone, so root has to do the fetching too.
    echo 'APT::Sandbox::User "root";' >>"$1/apt.conf"
  fi
}

# Gets the source package of the installed VTK into $1, whole or not at all.
fetch_vtk_source() {
  mkdir -p "$1" || return 1
  work=$(mktemp -d "$1/.fetching.XXXXXX") || return 1
  trap 'rm -rf "$work"' EXIT
  trap 'exit 130' INT TERM HUP
  write_private_apt "$work"
  mkdir "$work/package"
  # A repository without sources is no reason to stop: what counts is whether the package can be had.
  apt-get -q -q -c="$work/apt.conf" update >"$work/log" 2>&1 || true
  (
    cd "$work/package" || exit 1
    apt-get -q -q -c="$work/apt.conf" source --download-only "vtk9=$vtk_version" ||
      apt-get -q -q -c="$work/apt.conf" source --download-only vtk9
  ) >>"$work/log" 2>&1 || return 1
  set -- "$1" "$work"/package/vtk9_"${vtk_upstream#*:}"-*.dsc
  [ -r "$2" ] || return 1
  # The .dsc goes last: it is what says that all is there.
  for file in "$work"/package/*; do
    case $file in *.dsc) ;; *) mv -f "$file" "$1/" || return 1 ;; esac
  done
  mv -f "$work"/package/*.dsc "$1/"
}

find_missing
[ -z "$missing" ] || install_missing

# Debian's VTK has its Qt widget for Qt 5 only; the window builds VTK's own for Qt 6 from the distribution's source.
cache=${XDG_CACHE_HOME:-${HOME:+$HOME/.cache}}
vtk_source=${LORICA_VTK_SOURCE:-${cache:-/var/cache}/lorica/vtk9-source}
# shellcheck disable=SC2046 # the line is made of words
set -- $(printf '%s\n' "$known" | sed -n 's/^libvtk9-dev installed //p')
vtk_upstream=${1-} vtk_version=${2-}
set -- "$vtk_source"/vtk9_"${vtk_upstream#*:}"-*.dsc
if [ -n "$vtk_upstream" ] && [ ! -r "$1" ]; then
  fetch_vtk_source "$vtk_source" ||
    say "the source package of VTK $vtk_upstream could not be fetched; the engine does without, the window cannot be built"
fi
