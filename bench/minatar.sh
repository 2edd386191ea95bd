#!/bin/sh
# minatar.sh [FOLDER]: the study of docs/results/minatar.md, on all processors. Every run keeps a folder of
# its own in FOLDER (build/minatar), saved every minute: started again, the study goes on where it was.
# What is finished goes to docs/results/minatar.csv, and what is there to its last frame is not run again.
# minatar.sh --table: that file as the rows of docs/results/minatar.md.
set -eu

root=$(dirname "$(dirname "$(readlink -f "$0")")")
out=${1:-$root/build/minatar}
quoll=${QUOLL:-$root/build/release/bin/quoll}
table=$root/docs/results/minatar.csv
head=settings,game,seed,frames,training_return,greedy_return,processor_seconds
[ -e "$table" ] || echo "$head" >"$table"

# SETTINGS GAME SEED FRAMES...: what is run, in this order; at each of the frames its seeds.csv is kept.
runs() {
  for seed in 1 2 3; do
    for game in breakout asterix freeway; do
      echo "minatar-paper $game $seed 1000000 2000000"
    done
    [ $seed != 1 ] || pqn 1
    echo "without-replay breakout $seed 1000000 2000000"
  done
  for seed in 2 3 4 5; do pqn $seed; done
}
pqn() {
  for game in asterix breakout freeway seaquest space-invaders; do
    echo "pqn-minatar $game $1 10000000"
  done
}

run() {
  preset=$1 game=$2 seed=$3
  shift 3
  for last in "$@"; do :; done
  ! grep -q "^$preset,$game,$seed,$last," "$table" || return 0
  folder=$out/$preset/$game-$seed
  mkdir -p "$folder"
  case $preset in
    # One transition, learned from at once.
    without-replay) config="$root/presets/minatar-paper.toml --replay 1 --batch 1 --learning-starts 0" ;;
    *) config=$root/presets/$preset.toml ;;
  esac
  for frames in "$@"; do
    [ ! -e "$folder/seeds-$frames.csv" ] || continue
    if [ -e "$folder/run.quoll" ]; then begin="--resume $folder"
    else begin="minatar-$game --config $config --seed $seed"; fi
    # shellcheck disable=SC2086 # lists of words
    "$quoll" learn $begin --steps "$frames" --threads 1 --save-every 60s -o "$folder" --quiet \
      >"$folder/log" 2>&1 || return 0
    cp "$folder/seeds.csv" "$folder/seeds-$frames.csv"
    tell
  done
}

# All finished stages as one table, and what it held before.
tell() {
  {
    for file in "$out"/*/*/seeds-*.csv; do
      [ -e "$file" ] || continue
      run=${file%/*}
      name=${run##*/}
      settings=${run%/*}
      sed 1d "$file" | awk -F, -v OFS=, -v settings="${settings##*/}" -v game="${name%-*}" \
        '{ print settings, game, $1, $2, $10, $11, $6 }'
    done
    sed 1d "$table"
  } | sort -s -u -t, -k1,1 -k2,2 -k4,4n -k3,3n | sed "1i\\$head" >"$table.$$"
  mv "$table.$$" "$table"
}

# A row for each settings, game and frames: the mean of its seeds, with the least and the most.
rows() {
  awk -F, '
    BEGIN {
      published["asterix"] = "7.0 14.3 16.9"; published["breakout"] = "9.2 9.7 10.1"
      published["freeway"] = "47.9 50.9 50.4"; published["seaquest"] = "1.0 4.9 20.2"
      published["space-invaders"] = "34 42 45"
    }
    NR == 1 { next }
    {
      key = $1 "," $2 "," $4
      if (!(key in n)) order[++keys] = key
      if (!(key in n) || $5 < least[key]) least[key] = $5
      if (!(key in n) || $5 > most[key]) most[key] = $5
      n[key]++; sum[key] += $5; greedy[key] += $6; frames[key] += $4; seconds[key] += $7
    }
    END {
      for (i = 1; i <= keys; i++) {
        key = order[i]; split(key, of, ","); split(published[of[2]], by, " ")
        if (of[1] == "without-replay") told = "-"
        else if (of[3] <= 2e6) told = by[of[3] / 1e6]
        else told = by[3] " (DQN, 5 M)"
        spread = n[key] > 1 ? sprintf(" (%.1f to %.1f)", least[key], most[key]) : ""
        printf "| `%s` | %s | %d M | %s | %.1f%s | %d | %.1f | %.1f k |\n", of[1], of[2], of[3] / 1e6, told,
          sum[key] / n[key], spread, n[key], greedy[key] / n[key], frames[key] / seconds[key] / 1e3
      }
    }' "$table"
}

if [ "${1:-}" = --table ]; then
  rows
  exit
fi
mkdir -p "$out"
if [ "${2:-}" = --one ]; then
  shift 2
  run "$@"
else
  runs | xargs -P "$(nproc)" -L 1 sh "$0" "$out" --one
  tell
fi
