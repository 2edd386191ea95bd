#!/bin/sh
# new_world.sh PROGRAM COMPILER LIBRARY [FLAGS]: the program that `quoll new world` gives compiles, without a
# warning, and learns to walk to the right. FLAGS are the libraries that the library needs, and what a sanitized
# one asks of its users.
set -eu

program=$1 compiler=$2 library=$3
shift 3
here=$(dirname "$(readlink -f "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$program" new world my-street -o my-street.cpp >/dev/null
"$compiler" -std=c++20 -O1 -Wall -Wextra -Werror -I "$here/../.." my-street.cpp "$library" -pthread "$@" \
  -o my-street
./my-street >out.txt
cat out.txt
[ "$(grep -c ': right$' out.txt)" = 9 ]
