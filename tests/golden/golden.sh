#!/bin/sh
# Compares the dumps of the front end, kind by kind, with the files kept here.
# golden.sh --update writes those files anew (make update-golden).
folder=$(cd "$(dirname "$0")" && pwd)
lambert=$(cd "${top_builddir:-.}" && pwd)/lambert
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
n=0 failed=0
for kind in tokens ast csg; do
  for scene in "$folder"/input/*.pov; do
    name=$(basename "$scene" .pov)
    kept=$folder/$kind/$name.txt
    "$lambert" "$scene" --dump-$kind >"$work/got" 2>"$work/err"
    code=$?
    if test "$1" = --update; then
      cp "$work/got" "$kept"
      continue
    fi
    n=$((n + 1))
    if test $code = 0 && diff "$kept" "$work/got" >"$work/difference"; then
      echo "ok $n - $kind of $name"
    else
      echo "not ok $n - $kind of $name; if it should be so: make update-golden"
      sed 's/^/# /' "$work/err" "$work/difference"
      failed=1
    fi
  done
done
test "$1" = --update || echo "1..$n"
exit $failed
