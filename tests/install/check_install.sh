#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a build to a prefix, moves the prefix, and builds and runs a C program against it.
# Usage: check_install.sh cmake|pkgconfig|examples|components shared|static BUILD_DIR VERSION
# examples builds those of C and C++ by themselves against the prefix. components installs each component alone.
# Environment: CC, CXX, CMAKE, PKG_CONFIG.
set -euo pipefail

way=$1 kind=$2 build=$3 version=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

say() { printf '%s\n' "$*"; }
die() { say "$*" >&2; exit 1; }

"$CMAKE" --install "$build" --prefix "$work/first" >"$work/log" || { cat "$work/log"; exit 1; }
mv "$work/first" "$work/moved"
prefix=$work/moved
pc=$(dirname "$(find "$prefix" -name msq.pc)")

headers=$(find "$prefix/include" -type f -printf '%f\n' | LC_ALL=C sort | tr '\n' ' ')
has_io=OFF
if [[ -e $pc/msq_io.pc ]]; then has_io=ON; fi
if [[ $has_io == ON ]]; then wanted="msq.h msq.hpp msq_io.h "; else wanted="msq.h msq.hpp "; fi
[[ $headers == "$wanted" ]] || die "installed headers: $headers"
if grep -rlF -e "$work/first" -e "$build" "$prefix" --include='*.cmake' --include='*.pc'; then
  die "these files name the folder they were built or first installed in"
fi

case $way in
  cmake)
    options=(-DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$CC" -DCMAKE_BUILD_TYPE=Release
      -DCONSUMER_IO="$has_io")
    if [[ $kind == shared ]]; then
      # A host of the shared library needs none of its dependencies.
      for name in TBB assimp pugixml CGAL PkgConfig Threads PNG ZLIB; do
        options+=("-DCMAKE_DISABLE_FIND_PACKAGE_$name=ON")
      done
    else
      options+=(-DCONSUMER_STATIC=ON -DCMAKE_CXX_COMPILER="$CXX")
    fi
    configure() { "$CMAKE" -S "$here/consumer" -B "$work/build" "${options[@]}" "$@" >"$work/log" 2>&1; }
    configure "-DCONSUMER_WANTS=$version" || { cat "$work/log"; exit 1; }
    "$CMAKE" --build "$work/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    "$work/build/consumer"
    if [[ $has_io == ON ]]; then "$work/build/consumer_io"; fi
    # A component that there is not.
    rm -rf "$work/build"
    if configure "-DCONSUMER_WANTS=$version" -DCONSUMER_COMPONENT=none; then
      die "the package has a component that there is not"
    fi
    tr -s ' \n' ' ' <"$work/log" | grep -q "no component none" || { cat "$work/log"; exit 1; }
    # No request for a newer minor version is met, nor, before 0.2, one for an older version.
    major=${version%%.*} minor=${version#*.} minor=${minor%%.*}
    others=("$major.$((minor + 1))")
    if ((major == 0 && minor == 1)); then others+=(0.0); fi
    for other in "${others[@]}"; do
      rm -rf "$work/build"
      if configure "-DCONSUMER_WANTS=$other"; then die "the package passes for version $other"; fi
      grep -q "considered but not accepted" "$work/log" || { cat "$work/log"; exit 1; }
    done
    if [[ $kind == static ]]; then
      rm -rf "$work/build"
      if configure "-DCONSUMER_WANTS=$version" -DCONSUMER_STATIC=OFF; then
        die "a static msq was found by a project without C++"
      fi
      tr -s ' \n' ' ' <"$work/log" | grep -q "add CXX to the languages" || { cat "$work/log"; exit 1; }
    fi
    ;;
  examples)
    for language in c cpp; do
      { "$CMAKE" -S "$here/../../examples/$language" -B "$work/$language" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_BUILD_TYPE=Debug &&
        "$CMAKE" --build "$work/$language" --parallel 2; } >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    done
    "$work/c/hello" >"$work/layer"
    grep -q '#.*#' "$work/layer" || die "hello printed no layer"
    "$work/cpp/infill_plugin" >"$work/log" || { cat "$work/log"; exit 1; }
    ;;
  components)
    files() { (cd "$1" && find . ! -type d | LC_ALL=C sort); }
    for component in msq_runtime msq_io_runtime msq_development msq_tools msq_python msq_licence; do
      "$CMAKE" --install "$build" --component "$component" --prefix "$work/$component" >"$work/log" ||
        { cat "$work/log"; exit 1; }
      mkdir -p "$work/$component"
      # What a package has beside it, in share/doc of the package, only its component installs.
      files "$work/$component" | grep -v '^\./share/doc/.*/\(changelog\.gz\|copyright\)$' >"$work/$component.files" || true
    done
    LC_ALL=C sort "$work"/*.files | diff - <(files "$prefix") || die "the components are not the whole"
    if [[ $kind == shared ]]; then
      ! grep -v '/libmsq\.so\.[0-9.]*$' "$work/msq_runtime.files" || die "more than the library in msq_runtime"
      [[ -s $work/msq_runtime.files ]] || die "msq_runtime is empty"
      grep -q '/libmsq\.so$' "$work/msq_development.files" || die "no libmsq.so in msq_development"
    fi
    if [[ $has_io == ON ]]; then grep -q '/man1/msq\.1$' "$work/msq_tools.files" || die "no manual in msq_tools"; fi
    ;;
  pkgconfig)
    flags=()
    if [[ $kind == shared ]]; then
      export PKG_CONFIG_LIBDIR=$pc  # and nowhere else: no dependency is asked for
    else
      export PKG_CONFIG_PATH=$pc
      flags=(--static)
    fi
    [[ $("$PKG_CONFIG" --modversion msq) == "$version" ]] || die "wrong version in msq.pc"
    all_cflags=$("$PKG_CONFIG" --cflags msq)
    all_libs=$("$PKG_CONFIG" "${flags[@]}" --libs msq)
    read -r -a cflags <<<"$all_cflags"
    read -r -a libs <<<"$all_libs"
    "$CC" -std=c99 "${cflags[@]}" "$here/consumer/consumer.c" -o "$work/consumer" "${libs[@]}"
    LD_LIBRARY_PATH=$(dirname "$pc") "$work/consumer"
    if [[ $has_io == ON ]]; then
      all_flags=$("$PKG_CONFIG" "${flags[@]}" --cflags --libs msq_io)
      read -r -a both <<<"$all_flags"
      "$CC" -std=c99 "$here/consumer/consumer_io.c" -o "$work/consumer_io" "${both[@]}"
      LD_LIBRARY_PATH=$(dirname "$pc") "$work/consumer_io"
    fi
    ;;
  *) die "unknown way: $way" ;;
esac
