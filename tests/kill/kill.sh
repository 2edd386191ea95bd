#!/bin/sh
# kill.sh QUOLL [TIMES]: a learning run that saves every 20 ms is killed (SIGKILL) at random times. After
# each kill the file, if there is one, loads, and no temporary file is left behind by the next save.
# 20 times; 200 under QUOLL_FULL.
set -eu

quoll=$1
times=${2:-${QUOLL_FULL:+200}}
times=${times:-20}
folder=$(mktemp -d "${TMPDIR:-/tmp}/quoll-kill-XXXXXX")
trap 'rm -rf "$folder"' EXIT
world=$folder/world.txt
run=$folder/run.quoll

# 60 x 60 open cells: a table of 230 kB, so that a kill often meets a save.
awk 'BEGIN { for (r = 0; r < 60; r++) { line = ""
  for (c = 0; c < 60; c++) line = line (r == 0 && c == 0 ? "S" : r == 59 && c == 59 ? "G" : ".")
  print line } }' >"$world"

# Seconds to live, from 0.005 to 0.25, the same ones each time.
awk -v n="$times" 'BEGIN { srand(7); for (i = 0; i < n; i++) printf "%.3f\n", 0.005 + 0.245 * rand() }' \
  >"$folder/lives"

loaded=0
while read -r life; do
  "$quoll" learn "$world" --explore epsilon-greedy --steps 1000000000000 --quiet \
    --save "$run" --save-every 20ms >/dev/null 2>"$folder/errors" &
  process=$!
  sleep "$life"
  # The first one lives until it has saved, however slow the machine is.
  until [ "$loaded" -gt 0 ] || [ -e "$run" ] || ! kill -0 "$process" 2>/dev/null; do sleep 0.02; done
  kill -9 "$process" 2>/dev/null || { cat "$folder/errors"; echo "ended by itself"; exit 1; }
  wait "$process" 2>/dev/null || true
  left=$(find "$folder" -name '.quoll-*' | wc -l)
  [ "$left" -le 1 ] || { echo "$left temporary files are left"; exit 1; }
  [ -e "$run" ] || continue
  # At or past its total a run loads, does nothing and exits 0.
  "$quoll" learn "$world" --resume "$run" --steps 1 --quiet >/dev/null 2>"$folder/errors" || {
    cat "$folder/errors"
    exit 1
  }
  loaded=$((loaded + 1))
done <"$folder/lives"

# A save that comes to its end leaves nothing but the file.
"$quoll" learn "$world" --resume "$run" --steps 1 --quiet --save "$run" >/dev/null
left=$(find "$folder" -name '.quoll-*' | wc -l)
[ "$left" -eq 0 ] || { echo "$left temporary files are left at the end"; exit 1; }
echo "$times kills, $loaded times a file that loads"
[ "$loaded" -gt 0 ]
