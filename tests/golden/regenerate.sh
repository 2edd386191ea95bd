#!/bin/sh
# tests/golden/regenerate.sh BUILD: rewrites the transcripts from the program in the build tree BUILD, and
# begins one for each built-in world that has none. Read the difference before you commit it.
set -eu
build=${1:?usage: tests/golden/regenerate.sh BUILD}
here=$(cd "$(dirname "$0")" && pwd)
for world in $("$build/bin/quoll" list worlds | sed -n '2,/^quoll/s/^\([a-z0-9-]*\)  .*/\1/p'); do
  file=$here/$world.case
  [ -e "$file" ] && continue
  {
    echo "# The world $world: what it offers, an episode of the uniform policy, how it looks."
    echo "\$ quoll list worlds $world"
    echo
    echo "\$ quoll play $world --policy uniform --seed 1 --steps 6 --json"
    echo
    echo "\$ quoll play $world --policy uniform --seed 1 --steps 2 --render text"
    if "$build/bin/quoll" list worlds "$world" | grep -q '^seeding '; then
      echo
      echo "# The same seed as Gymnasium's."
      echo "\$ quoll play $world --with seeding=gymnasium --policy uniform --seed 1 --steps 6 --json"
    fi
  } >"$file"
done
runner=$(find "$build" -name case_runner -type f | head -n 1)
for file in "$here"/*.case; do
  "$runner" --update "$build/bin/quoll" "$file" >/dev/null || true
  "$runner" "$build/bin/quoll" "$file"
done
