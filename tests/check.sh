#!/bin/sh
# What ./dev check runs, after the release tree is built and the tools are there: each step on its own
# line with its time, all of them even when one fails. `tests/check.sh STEP...` runs some steps only.
set -u

root=$(dirname "$(dirname "$(readlink -f "$0")")")
tree=$root/build/release
jobs=$(nproc)
log=$root/build/check.log
cd "$root" || exit 1

# Every C++ file that git knows or would add.
cpp_files() {
  git ls-files --cached --others --exclude-standard -- "$@" |
    while read -r file; do [ ! -f "$file" ] || printf '%s\n' "$file"; done
}

# configure NAME: the tree build/NAME, by its preset.
configure() { [ -e "build/$1/build.ninja" ] || cmake --preset "$1"; }

# As clang-format-19 lays it out.
form() { cpp_files '*.cpp' '*.hpp' '*.inl' '*.c' '*.h' | xargs -r clang-format-19 --dry-run -Werror; }

# Floors, file sizes, what the core does without; each public header on its own.
floors() { "$tree/tests/floors_test" --gtest_brief=1 && ninja -C "$tree" headers_alone; }

# Names and mistakes (.clang-tidy), six files at a time. They are looked at again only when something they
# may see changed.
tidy() {
  mkdir -p build/tidy
  state=$( (cpp_files '*.hpp' | xargs cat; cat .clang-tidy) | cksum | cut -d ' ' -f 1)
  cpp_files 'quoll/*.cpp' | xargs -r -P "$jobs" -n 6 sh tests/tidy.sh "$tree" "$state"
}

# build/inside: the library by clang, without precompiled headers, inside the tree of a project that uses it.
inside() {
  [ -e build/inside/build.ninja ] ||
    cmake -S tests/packaging -B build/inside -G Ninja -DQUOLL_INSIDE="$root" -DQUOLL_TESTS=ON \
      -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_CXX_COMPILER=clang++-19 -DCMAKE_BUILD_TYPE=None \
      -DCMAKE_CXX_FLAGS=-O2 || return 1
  ninja -C build/inside consumer quoll_signature
}

# From clang the hash that ./dev test found from g++.
signature() { inside && build/inside/quoll/tests/quoll_signature --check tests/golden/signature.txt; }

# What does the same thing millions of times for a statistic or for whole tables, which others do once.
repeated='Dqn.SwitchesThatKeep*:Traps.EpsilonGreedyTakes*:Worlds.SteppedFrequencies*:Learners.SoundRulesReach*:Learners.OnPolicyValuesReach*
:SolverSuite.ThreadsDoNotChangeABit:ExploredWorlds.Blackjack:Explore.SaysWhatCannotBeListed
:Certifier.IsSeldomWrong*:Certifier.IsTrueAtEveryCheck*:KlInterval.Misses*
:BoardGames.LearnsTheBestGame*:BoardGames.SmallConnectFour*:Krk.*:Referee.SaysOfThePart*
:Dqn.DistributionsHave*:Dqn.OutputsOfNames*:Learners.SameSeed*:Learners.WatchingFor*:Floors.*'

# Unit tests, cases and fuzz corpora under AddressSanitizer and UndefinedBehaviorSanitizer. The tests of a
# program in one process, largest program first: what they share is made once.
sanitize() {
  configure sanitize && ninja -C build/sanitize || return 1
  ls -S build/sanitize/tests/*_test | xargs -P "$jobs" -I{} timeout 1200 {} --gtest_brief=1 \
    --gtest_filter="*-$(printf %s "$repeated" | tr -d '\n')" &&
    ctest --test-dir build/sanitize -j "$jobs" --output-on-failure --timeout 300 \
      -R '^(cases|cli|fuzz|examples)\.' -LE docs
}

# Whatever starts threads, under ThreadSanitizer.
threads() {
  configure tsan && ninja -C build/tsan base_test suites_test || return 1
  for test in base_test suites_test; do
    build/tsan/tests/$test --gtest_brief=1 --gtest_filter='*arallel*:*hread*:Team*' || return 1
  done
}

# An installed Quoll is found by find_package, and a tree of it by add_subdirectory.
packaging() { sh tests/packaging/run.sh "$tree" && inside && build/inside/consumer; }

# One adventure run in WebAssembly, with the bits of the native one.
wasi() { sh tests/wasi/run.sh "$tree"; }

failed=''
[ $# -gt 0 ] || set -- form floors tidy signature packaging wasi threads sanitize
for step in "$@"; do
  from=$(date +%s)
  if "$step" >"$log" 2>&1; then result=ok; else result=FAILED failed="$failed $step"; fi
  [ $result = ok ] || cat "$log"
  printf '%-10s %-7s %4d s   %s\n' "$step" "$result" "$(($(date +%s) - from))" \
    "$([ $result = FAILED ] || grep -E '^(skipped|g\+\+)' "$log" | tail -n 1)"
done
[ -z "$failed" ] || { echo "check failed:$failed"; exit 1; }
echo "check passed"
