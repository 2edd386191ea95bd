#!/bin/sh
# minatar.sh [FOLDER]: the study of docs/results/minatar.md, on all processors. Every run keeps a folder of
# its own in FOLDER (build/minatar), saved every minute: started again, the study goes on where it was.
# What is finished goes to docs/results/minatar.csv, and what is there to its last frame is not run again.
set -eu

root=$(dirname "$(dirname "$(readlink -f "$0")")")
out=${1:-$root/build/minatar}
quoll=${QUOLL:-$root/build/release/bin/quoll}
table=$root/docs/results/minatar.csv
head=settings,game,seed,frames,training_return,greedy_return,processor_seconds
mkdir -p "$out"
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

if [ "${2:-}" = --one ]; then
  shift 2
  run "$@"
else
  runs | xargs -P "$(nproc)" -L 1 sh "$0" "$out" --one
  tell
fi
