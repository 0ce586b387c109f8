#!/bin/sh
# povray.sh [--update] [SCENE...]: are the `// debug:` lines what POV-Ray prints, and
# does it refuse the scenes with `// expect error:`? --update writes the lines anew.
folder=$(cd "$(dirname "$0")" && pwd)
update=no
if test "$1" = --update; then
  update=yes
  shift
fi
command -v povray >/dev/null || {
  echo "povray is not installed" >&2
  exit 77
}
test $# -gt 0 || set -- "$folder"/*.scn
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
failed=0
for scene; do
  scene=$(cd "$(dirname "$scene")" && pwd)/$(basename "$scene")
  grep -q '^// povray: no' "$scene" && continue # says why
  rm -f "$work"/*
  (cd "$work" && timeout 120 povray -D -F +W4 +H4 "+L$folder" "+I$scene" +GDdebug +GA- +GS- +GR- \
    >all 2>&1 </dev/null)
  code=$?
  expected=0
  grep -q '// expect error:' "$scene" && expected=1
  if test $code != $expected; then
    echo "$scene: povray exits with $code"
    grep -A3 ' Error' "$work/all" | sed 's/^/    /'
    failed=1
    continue
  fi
  # After an error the rest of the debug line that was begun is written too.
  if test $update = yes; then
    sed '/^\/\/ debug:/d' "$scene" >"$work/scene"
    sed -e 's|^|// debug: |' -e 's/ *$//' "$work/debug" >>"$work/scene"
    cat "$work/scene" >"$scene"
  elif ! sed -n 's|^// debug: \{0,1\}||p' "$scene" | diff - "$work/debug" >"$work/diff"; then
    echo "$scene: the debug streams differ"
    sed 's/^/    /' "$work/diff"
    failed=1
  fi
done
exit $failed
