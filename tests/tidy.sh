#!/bin/sh
# tidy.sh TREE STATE FILE...: clang-tidy over the files read as one, which takes little longer than one of
# them: most of it is headers. Where they cannot be one (two use the same name for something of their
# own), over each half of them. A stamp in build/tidy remembers STATE and the files that were found well.
set -u

tree=$1 state=$2
shift 2
stamp=build/tidy/$(printf %s "$*" | cksum | cut -d ' ' -f 1)
now="$state $(cat "$@" | cksum)"
[ "$(cat "$stamp" 2>/dev/null)" = "$now" ] && exit 0

together=$stamp.cpp
printf '#include "%s"\n' "$@" >"$together"
result=0
found=$(clang-tidy-19 --quiet --header-filter='.*/quoll/.*' "$together" -- -std=gnu++20 -I. \
  -I"$tree/embedded" -DFMT_HEADER_ONLY -DQUOLL_VERSION='""' -DQUOLL_GMP -DQUOLL_ZLIB -DQUOLL_LZMA \
  2>/dev/null) || result=1
case $#,$found in
  1,*) ;;
  *clang-diagnostic-error*)
    found=''
    printf '%s\n' "$@" | xargs -n $((($# + 1) / 2)) sh "$0" "$tree" "$state" && result=0 || result=1 ;;
esac
[ -z "$found" ] || printf '%s\n' "$found"
[ $result = 0 ] && printf %s "$now" >"$stamp"
exit $result
