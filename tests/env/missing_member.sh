#!/bin/sh
# missing_member.sh COMPILER: a plain struct that lacks a member gives one error that names it.
set -eu

compiler=$1
here=$(dirname "$(readlink -f "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The library's header is read once for all the structs; the compiler finds it by the ending.
header=$folder/header.hpp
echo '#include "quoll/env/dynamics.hpp"' >"$header"
case $("$compiler" --version) in *clang*) ending=pch ;; *) ending=gch ;; esac
"$compiler" -std=c++20 -I "$here/../.." -x c++-header "$header" -o "$header.$ending"
compile() {
  "$compiler" -std=c++20 -fsyntax-only -include "$header" -I "$here/../.." -DMISSING="$1" \
    "$here/missing_member.cpp" 2>&1
}

compile 0 || { echo "the whole struct does not compile"; exit 1; }
number=0
for expected in "using Position = ...;" "quoll::Spaces spaces() const" \
  "Position start(auto& dice) const" "quoll::Feedback step(Position&, quoll::Action, auto& dice)" \
  "quoll::State number(const Position&) const, or"; do
  number=$((number + 1))
  if text=$(compile $number); then
    echo "compiles without $expected"
    exit 1
  fi
  errors=$(printf '%s\n' "$text" | grep -c "error:")
  printf '%s\n' "$text" | grep -F "error:" | grep -qF "$expected" && [ "$errors" -eq 1 ] || {
    printf '%s\n' "$text"
    echo "one error about '$expected' expected, not $errors"
    exit 1
  }
done
echo "each missing member is named"
