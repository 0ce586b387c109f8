#!/bin/sh
# Every row of the tables has a test and a line in doc/compatibility.md.
# One TAP line per row.
srcdir=${top_srcdir:-.}
n=0 failed=0
check() { # what, word
  n=$((n + 1))
  if grep -q "^| *\`$2\`" "$srcdir/doc/compatibility.md"; then
    echo "ok $n - $1 $2"
  else
    echo "not ok $n - $1 $2 has no row in doc/compatibility.md"
    failed=1
  fi
}
for table in "shape src/scene/shapes.def SHAPE" "pattern src/scene/patterns.def PATTERN" \
  "word src/lang/keywords.def WORD"; do
  # shellcheck disable=SC2086
  set -- $table
  for word in $(sed -n "s/^$3(\([a-z_0-9]*\).*/\1/p" "$srcdir/$2"); do
    check "$1" "$word"
  done
done
echo "1..$n"
exit $failed
