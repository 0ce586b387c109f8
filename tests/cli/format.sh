#!/bin/sh
# `lambert fmt` and `lambert check`. Formatting keeps the tokens, and doing it twice
# changes nothing more: over every scene of the tree and, where POV-Ray is installed,
# over its includes and samples (one in eight of these unless LONG is set).
source=$(cd "${top_srcdir:-.}" && pwd)
. "${top_srcdir:-.}/tests/cli/common.sh"

all_files()
{
  find "$source/tests" "$source/scenes" -name '*.scn' -o -name '*.pov' -o -name '*.inc'
  for folder in /usr/share/povray-3.7/include /usr/share/doc/povray/examples; do
    test ! -d "$folder" || find -L "$folder" -name '*.inc' -o -name '*.pov'
  done | sort | awk -v step="${LONG:+1}" 'NR % (step ? step : 8) == 0'
}

# Kinds and texts of the tokens without their places.
tokens() { "$lambert" --dump-tokens "$1" 2>&1 | sed 's/^[0-9]*:[0-9]* //'; }

round_trip()
{
  count=0
  all_files >files
  while IFS= read -r file; do
    # What does not even split into tokens is not formatted.
    "$lambert" fmt "$file" >once.scn 2>err || continue
    if ! "$lambert" fmt --check once.scn >out; then
      echo "# formatting twice: $file"
      return 1
    fi
    tokens "$file" >before
    if ! tokens once.scn | cmp -s - before; then
      echo "# other tokens: $file"
      return 1
    fi
    count=$((count + 1))
  done <files
  echo "# $count files"
  test "$count" -ge 100
}
check "tokens stay, twice is once" round_trip

cat >loose.scn <<'EOF'
#declare A =
array[2] {
sphere { 0, 1 pigment {
rgb 1 }   
}, box {
-1, 1 }
}
#macro M(X)
#switch (X)
#case (1)
#if (X > 0) union { #else
merge {
#end
A[0]
/* as
  it was */
}
#break
#end
#end
EOF
cat >tidy.scn <<'EOF'
#declare A =
  array[2] {
  sphere { 0, 1 pigment {
      rgb 1 }
  }, box {
    -1, 1 }
}
#macro M(X)
  #switch (X)
  #case (1)
    #if (X > 0) union { #else
      merge {
      #end
      A[0]
      /* as
  it was */
    }
    #break
  #end
#end
EOF
tidies() { exits 0 "$lambert" fmt loose.scn && diff out tidy.scn; }
check "indents" tidies
named() { exits 1 "$lambert" fmt --check tidy.scn loose.scn && test "$(cat out)" = loose.scn; }
check "--check names what would change" named
cp loose.scn changed.scn
chmod 640 changed.scn
in_place() { exits 0 "$lambert" fmt -i changed.scn && cmp changed.scn tidy.scn; }
check "--in-place" in_place
check "keeps the file's mode" test "$(stat -c %a changed.scn)" = 640
printf 'sphere {\r\n0, 1 }' >dos.scn
printf 'sphere {\r\n  0, 1 }' >dos.want
dos() { exits 0 "$lambert" fmt dos.scn && cmp out dos.want; }
check "line ends stay" dos
printf '#debug "never closed' >open.scn
cp open.scn open.want
broken() { exits 1 "$lambert" fmt -i open.scn && cmp open.scn open.want; }
check "a broken file stays as it is" broken
check "fmt without files" exits 64 "$lambert" fmt

check "check: a good scene" exits 0 "$lambert" check sphere.pov
check "check: no picture" test ! -e sphere.png
printf 'sphere { 0, R }\nbox { 0 }\n' >bad.pov
all_said() {
  exits 1 "$lambert" check --diagnostics=gcc bad.pov sphere.pov &&
    has err '^bad.pov:1:13: error: ' && has err '^bad.pov:2:[0-9]*: error: '
}
check "check: every error" all_said
json() { exits 1 "$lambert" check --diagnostics=json bad.pov && has err '"line":2'; }
check "check: as JSON" json
check "check: a missing file" exits 66 "$lambert" check nowhere.pov sphere.pov
check "check: without files" exits 64 "$lambert" check
finish
