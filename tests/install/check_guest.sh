#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# msq as a part of another project: configures a host, builds, installs and moves it, and builds and runs a
# third project against the installed host.
# Usage: check_guest.sh add_subdirectory|FetchContent shared|static [full]
# Without `full`, one file stands for the sources of msq, since the build takes minutes: what is tested is
# the CMake code. scripts/test_guest runs it with all sources.
# Environment: CXX, CMAKE, CTEST.
set -euo pipefail

way=$1 kind=$2 full=${3-}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

die() { printf '%s\n' "$*" >&2; exit 1; }
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }

msq=$root
if [[ $full != full ]]; then
  msq=$work/msq
  mkdir -p "$msq/src/api"
  cp -R "$root/CMakeLists.txt" "$root/LICENSE" "$root/cmake" "$root/include" "$msq"
  mkdir "$msq/bindings" && cp -R "$root/bindings/cpp" "$msq/bindings"
  cp "$root"/src/api/msq.{map,exports} "$here/guest/stand_in/version.cpp" "$msq/src/api"
fi

# Without BUILD_SHARED_LIBS a library is static, as everywhere in CMake.
options=(-DHOST_MSQ="$msq" -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_BUILD_TYPE=Release)
if [[ $kind == shared ]]; then options+=(-DBUILD_SHARED_LIBS=ON); fi

cached() { grep -E '^[A-Za-z0-9_]+:[A-Z]+=' "$work/host/CMakeCache.txt" | grep -v ':INTERNAL=' | LC_ALL=C sort; }
quietly "$CMAKE" -S "$here/guest/host" -B "$work/host" "${options[@]}" -DHOST_WAY=none
cached | grep -v '^HOST_WAY:' >"$work/before"
quietly "$CMAKE" -S "$here/guest/host" -B "$work/host" -DHOST_WAY="$way"
grep -q 'licence of the binary: *Apache-2.0$' "$work/log" || { cat "$work/log"; die "no licence in the summary"; }
cached | grep -v '^HOST_WAY:' >"$work/after"
changed=$(LC_ALL=C comm -23 "$work/before" "$work/after")
[[ -z $changed ]] || die "the guest changed cache variables of the host: $changed"
# Its own, and those of the modules that find its libraries.
added=$(LC_ALL=C comm -13 "$work/before" "$work/after" |
  grep -vE '^(MSQ_|msq_|FETCHCONTENT_|PKG_CONFIG_|pkgcfg_lib_MSQ_|ZLIB_|[A-Za-z0-9]+_DIR:)' || true)
[[ -z $added ]] || die "the guest added cache variables: $added"
[[ ! -e $work/host/compile_commands.json ]] || die "the guest made compile_commands.json"
tests=$(cd "$work/host" && "$CTEST" -N)
[[ $tests == *"Total Tests: 0"* ]] || die "the guest has tests: $tests"

quietly "$CMAKE" --build "$work/host" --parallel 2
quietly "$CMAKE" --install "$work/host" --prefix "$work/first"
mv "$work/first" "$work/moved"
# What the host and the third project need, and nothing that is the host's.
(cd "$work/moved" && find . -name '*.h' -o -iname 'licen[cs]e*') | LC_ALL=C sort >"$work/log"
printf '%s\n' ./include/engine.h ./include/msq.h ./share/doc/msq/LICENSE |
  diff - "$work/log" || die "other headers or licences were installed"
if grep -rlF -e "$work" -e "$root" "$work/moved" --include='*.cmake' --include='*.pc'; then
  die "these files name the folder they were built or first installed in"
fi

quietly "$CMAKE" -S "$here/guest/third" -B "$work/third" -DCMAKE_PREFIX_PATH="$work/moved" \
  -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_BUILD_TYPE=Release
quietly "$CMAKE" --build "$work/third"
said=$("$work/third/third")
[[ $said == "msq "*" Apache-2.0" ]] || die "the third project says: $said"
