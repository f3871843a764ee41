#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# third_party_test.sh SOURCE BUILD FLAGS   installs BUILD into an empty prefix and builds and tests third_party/ on it. All of
# it happens in a temporary folder, and nothing there may mention SOURCE or BUILD. FLAGS: what else the compiler is to be told.
set -euo pipefail
source=$1 build=$2 flags=$3
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Folders of the source tree, not its bare path: that may be as short as /src.
names_our_trees() { grep -rF "-e$build/" "-e$source"/{core,adapters,plugin,tests,sample_scenes}/ "$@"; }
fail() { echo "install: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log" ||
  { cat "$work/install.log"; fail "cmake --install failed."; }
for file in bin/nscdd lib/libnscdd_solver.so lib/libnscdd_core.a lib/cmake/nscdd/nscddConfig.cmake include/nscdd_plugin.h \
  include/nscdd/platform_adapter.h share/nscdd/sample_scenes/rotating_box_730.toml; do
  [[ -e $work/prefix/$file ]] || fail "$file is not in the prefix."
done
if names_our_trees -l "$work/prefix/include" "$work/prefix/lib/cmake" "$work/prefix/share"; then
  fail "the files above name a path of the source or build tree."
fi

# What a third party has: its own files, here those of the project's examples.
cp -r "$here/third_party" "$work/third_party"
cp "$source"/tests/conformance/minimal_{adapter.h,adapter.cpp,test.cpp} "$source/tests/plugin/host_in_c.c" "$work/third_party"

# The prefix may be moved after the installation.
mv "$work/prefix" "$work/moved"
launcher=$(command -v ccache || true)
export CCACHE_BASEDIR=$work
cmake -S "$work/third_party" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=$work/moved" \
  "-DCMAKE_C_COMPILER_LAUNCHER=$launcher" "-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher" \
  "-DCMAKE_C_FLAGS=$flags" "-DCMAKE_CXX_FLAGS=$flags" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
if names_our_trees "$work/build/compile_commands.json" "$work/build/build.ninja"; then
  fail "the third party's build uses a path of the source or build tree."
fi
cmake --build "$work/build"
ctest --test-dir "$work/build" --output-on-failure --no-tests=error

# The installed program finds the installed plugin and scenes.
cd "$work"
moved/bin/nscdd solvers
moved/bin/nscdd run moved/share/nscdd/sample_scenes/column.toml --steps 2 --quiet
[[ -s results/column/final.csv ]] || fail "the installed program left no results/column/final.csv."
