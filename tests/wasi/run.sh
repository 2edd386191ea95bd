#!/bin/sh
# run.sh TREE: the core as WebAssembly (clang-19, wasi-libc, libc++ without exceptions) learns the
# adventure under node, and every bit of the table equals the native one in TREE.
set -eu

root=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
tree=$1
out=$root/build/wasi
clang=clang++-19

skip() {
  echo "skipped: $1"
  exit 0
}
command -v "$clang" >/dev/null || skip "no $clang"
command -v wasm-ld-19 >/dev/null || skip "no wasm-ld-19 (package lld-19)"
command -v node >/dev/null || skip "no node (package nodejs)"
[ -e /usr/include/wasm32-wasi ] || skip "no wasi-libc"
[ -n "$(find /usr/include/wasm32-wasi /usr/lib/llvm-19/include/wasm32-wasi -name __config \
  2>/dev/null)" ] || skip "no libc++-19-dev-wasm32"

# The header-only libraries of the host, without the host's own libc beside them.
mkdir -p "$out/include"
for library in fmt hwy toml++ xxhash.h xxh3.h; do
  ln -sfn "/usr/include/$library" "$out/include/$library"
done

# The core: what compiles without exceptions (docs/design.md, section 5), and the small program.
cd "$root"
{
  echo "builddir = $out"
  echo "flags = --target=wasm32-wasi -std=c++20 -O1 -fno-exceptions -ffp-contract=off -DFMT_HEADER_ONLY"
  echo "paths = -I$root -isystem $out/include -I$tree/embedded"
  echo "rule precompile"
  echo "  command = $clang \$flags \$paths -x c++-header -c \$in -o \$out"
  echo "rule compile"
  echo "  command = $clang \$flags \$paths -include-pch $out/precompiled.pch -MD -MF \$out.d -c \$in" \
    "-o \$out"
  echo "  deps = gcc"
  echo "  depfile = \$out.d"
  echo "rule link"
  echo "  command = $clang --target=wasm32-wasi \$in -o \$out"
  echo "build $out/precompiled.pch: precompile $root/cmake/precompiled.hpp"
  objects=''
  for source in $(find quoll/base quoll/model quoll/nn quoll/env quoll/act quoll/solve quoll/verify \
    quoll/learn tests/wasi -name '*.cpp' | sort); do
    object=$out/objects/$(printf %s "$source" | tr / _).o
    echo "build $object: compile $root/$source | $out/precompiled.pch"
    objects="$objects $object"
  done
  echo "build $out/adventure.wasm: link$objects"
} >"$out/build.ninja"
ninja -f "$out/build.ninja" "$out/adventure.wasm"

node --no-warnings tests/wasi/run.mjs "$out/adventure.wasm" >"$out/wasm.txt"
"$tree/tests/wasi_native" >"$out/native.txt"
[ -s "$out/native.txt" ]
cmp "$out/native.txt" "$out/wasm.txt"
echo "g++ and WebAssembly agree on $(wc -l <"$out/native.txt") numbers"
