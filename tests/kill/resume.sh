#!/bin/sh
# resume.sh QUOLL: a run cut in two is the run in one piece, at 20 random cuts; what is not a run is
# refused in one line and never overwritten; a resumed run keeps its settings.
set -eu

quoll=$1
root=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
folder=$(mktemp -d "${TMPDIR:-/tmp}/quoll-resume-XXXXXX")
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cp "$root/worlds/adventure.toml" .
printf 'reward.x = 1\nslip = 0.2\n#x#.\nxS..\n.xG.\n' >noisy.txt

fail() {
  echo "$*"
  exit 1
}
# The result without the times it took.
result() { sed -E 's/"(seconds|processor_seconds|steps_per_second|seconds_load)": ?[-0-9.e+]+,?//g' "$1"; }
same() {
  result "$1" >left
  result "$2" >right
  cmp -s left right || { diff left right | head -5; fail "$3"; }
}

awk 'BEGIN { srand(11); for (i = 0; i < 20; i++) print 1 + int(7999 * rand()) }' >cuts
for world in adventure.toml noisy.txt; do
  how="--explore epsilon-greedy --start least-visited --seeds 2"
  "$quoll" learn "$world" $how --steps 8000 --json --quiet --save whole.quoll >whole.json
  while read -r cut; do
    rm -f part.quoll
    "$quoll" learn "$world" $how --steps "$cut" --json --quiet --save part.quoll >/dev/null
    "$quoll" learn "$world" --resume part.quoll --steps 8000 --json --quiet --save part.quoll >part.json
    same whole.json part.json "$world cut at $cut differs"
  done <cuts
  # At the total: nothing is done, the answer is the same, the status 0. Past it as well.
  for steps in 8000 5; do
    "$quoll" learn "$world" --resume whole.quoll --steps $steps --json --quiet >again.json ||
      fail "at its total: status $?"
    same whole.json again.json "a run at its total changes"
  done
done

# refused FILE TEXT OPTIONS...: status 1, one line that holds TEXT, the file as it was.
refused() {
  file=$1 text=$2
  shift 2
  cp "$file" before
  status=0
  "$quoll" learn adventure.toml --quiet --steps 10 "$@" >out 2>err || status=$?
  [ "$status" -eq 1 ] || fail "$file $*: status $status"
  [ "$(wc -l <err)" -eq 1 ] || fail "$file $*: $(cat err)"
  grep -q -- "$text" err || fail "$file: no '$text' in: $(cat err)"
  [ ! -s out ] || fail "$file: something on stdout"
  cmp -s "$file" before || fail "$file was changed"
}

"$quoll" learn adventure.toml --steps 500 --quiet --save good.quoll >/dev/null
size=$(wc -c <good.quoll)
for part in 1 7 20 $((size / 2)) $((size - 1)); do
  head -c "$part" good.quoll >short.quoll
  refused short.quoll "short.quoll" --resume short.quoll
  refused short.quoll "kept" --save short.quoll
done
for place in 0 9 13 40 $((size / 2)) $((size - 1)); do
  cp good.quoll flipped.quoll
  byte=$(od -An -tu1 -j "$place" -N 1 good.quoll | tr -d ' ')
  printf "\\$(printf %o $((byte ^ 64)))" | dd of=flipped.quoll bs=1 seek="$place" conv=notrunc 2>/dev/null
  refused flipped.quoll "flipped.quoll" --resume flipped.quoll
  refused flipped.quoll "kept" --save flipped.quoll
done
echo "a letter to grandmother" >letter.txt
refused letter.txt "not a Quoll file" --resume letter.txt
refused letter.txt "kept" --save letter.txt

refused good.quoll "0.1, not 0.5" --resume good.quoll --epsilon 0.5
refused good.quoll "1, not 2" --resume good.quoll --seed 2
refused good.quoll "uniform, not greedy" --resume good.quoll --explore greedy
refused good.quoll "takes no parameters, not 'size'" --resume good.quoll --with size=3
cp adventure.toml kept.toml
sed 's/100/101/' kept.toml >adventure.toml
refused good.quoll "has changed" --resume good.quoll
cp kept.toml adventure.toml

# A file size limit is a failed write with a line, not the end; the old file stays.
(
  ulimit -f 1
  status=0
  "$quoll" learn noisy.txt --steps 200000 --quiet --save whole.quoll >out 2>err || status=$?
  [ "$status" -le 1 ] || fail "under a file size limit: status $status"
)
"$quoll" learn noisy.txt --resume whole.quoll --steps 1 --quiet >/dev/null || fail "whole.quoll lost"
echo "resumed as if never cut"
