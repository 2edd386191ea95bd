#!/bin/sh
# run.sh TREE: a program of somebody else's finds Quoll installed (find_package), and runs.
set -eu

here=$(dirname "$(readlink -f "$0")")
root=$(dirname "$(dirname "$here")")
tree=$1
out=$root/build/packaging
rm -rf "$out/installed" "$out/found"

cmake --install "$tree" --prefix "$out/installed" >/dev/null
cmake -S "$here" -B "$out/found" -G Ninja -DCMAKE_PREFIX_PATH="$out/installed" \
  -DCMAKE_CXX_FLAGS=-O0 >/dev/null
ninja -C "$out/found"
"$out/found/consumer"
"$out/installed/bin/quoll" --version

# Every installed header stands without the source tree.
(cd "$out/installed/include" && find quoll -name '*.hpp') | sort | while read -r header; do
  printf '#include <%s>\n' "$header"
done >"$out/all_headers.cpp"
g++ -std=c++20 -fsyntax-only -I "$out/installed/include" "$out/all_headers.cpp"
