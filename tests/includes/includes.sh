#!/bin/sh
# Every file of scenes/include has a scene beside this script that uses it: it must render
# without a message, and not to a picture of one colour. (screen.inc gives the camera anew
# each time it moves; radiosity may not be rendered.) The macros' values are POV-Ray's.
. "${top_srcdir:-.}/tests/cli/common.sh"
tests=$(cd "$(dirname "$table")/../.." && pwd)/tests/includes
includes=$tests/../../scenes/include

renders()
{
  exits 0 "$lambert" "$tests/$1.scn" "+L$includes" +W48 +H36 -o "$1.ppm" -q || return 1
  grep -v -e E0443 err | grep -e warning -e error && return 1
  tail -c +14 "$1.ppm" | od -An -v -tx1 -w3 | sort -u | head -3 | wc -l | grep -q 3
}

for inc in "$includes"/*.inc; do
  name=$(basename "$inc" .inc)
  check "$name.inc" renders "$name"
done

# The debug stream of a scene of calls against what POV-Ray wrote with its own includes.
values()
{
  "$lambert" "$tests/values/$1.scn" "+L$includes" +W4 +H4 -o x.ppm 2>&1 |
    grep -E '^ *-?[0-9.]+( +-?[0-9.]+)* *$' >got
  cmp got "$tests/values/$1.txt" || { diff got "$tests/values/$1.txt" | sed 's/^/# /'; return 1; }
}
for scene in "$tests"/values/*.scn; do
  name=$(basename "$scene" .scn)
  check "values of $name" values "$name"
done
finish
