#!/bin/sh
# tests/golden/regenerate.sh BUILD: rewrites the transcripts from the program in the build tree BUILD, and
# begins one for each built-in world that has none. Read the difference before you commit it.
set -eu
build=${1:?usage: tests/golden/regenerate.sh BUILD}
here=$(cd "$(dirname "$0")" && pwd)
for world in $("$build/bin/quoll" list worlds --json | sed -n 's/^ *"name": "\(.*\)",*$/\1/p'); do
  file=$here/$world.case
  if [ ! -e "$file" ]; then
    sed "s/adventure/$world/g" "$here/adventure.case" | grep '^[#$]' | sed 's/^\$/\n$/' > "$file"
  fi
done
runner=$(find "$build" -name case_runner -type f | head -n 1)
for file in "$here"/*.case; do
  "$runner" --update "$build/bin/quoll" "$file" > /dev/null || true
  "$runner" "$build/bin/quoll" "$file"
done
