#!/bin/sh
# Reads every sample scene and every standard include with `lambert check` and with
# POV-Ray (which renders 4x3 pixels without light) and writes a table of what each says.
# usage: evaluate.sh LAMBERT OUT [SCENES-FOLDER [INCLUDES-FOLDER]]   (JOBS=n: so many at once)
# Works on a copy of the scenes, because some write files. Cached in OUT/reference.
# Fails when lambert refuses what POV-Ray takes, or takes what POV-Ray refuses.
lambert=$(realpath "$1") out=$2
scenes=${3:-/usr/share/doc/povray/examples} includes=${4:-/usr/share/povray-3.7/include}
mkdir -p "$out/rows" "$out/reference" || exit 1
out=$(realpath "$out")
rm -rf "$out/rows"/* "$out/scenes"
cp -rL "$scenes" "$out/scenes" && chmod -R u+w "$out/scenes" || exit 1
mkdir "$out/scenes/includes" || exit 1
for file in "$includes"/*.inc; do
  # An include alone is no scene: what it needs before it stands in its own comment.
  name=$(basename "$file" .inc)
  printf '#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#include "%s.inc"\nsphere { 0, 1 }\n' \
    "$name" >"$out/scenes/includes/$name.pov"
done

find "$out/scenes" -name '*.pov' | sort | grep -n '' >"$out/list"
xargs -P "${JOBS:-2}" -d '\n' -n 1 sh -c '
  number=$(printf %04d "${3%%:*}") scene=${3#*:}
  name=${scene#"$2/scenes/"} folder=$(dirname "$scene")
  cd "$folder" || exit 1
  log=$2/rows/$number.log
  begin=$(date +%s.%N)
  timeout 120 "$1" check --diagnostics=gcc --library-path="$folder" +W4 +H3 "$scene" >"$log" 2>&1
  code=$?
  end=$(date +%s.%N)
  error=$(grep -m 1 "error: " "$log" | sed "s/^[^ ]*error: //; s/^.* error: //")
  key=$2/reference/$(echo "$name" | tr / _)
  if [ ! -e "$key.code" ]; then
    timeout 300 povray "+I$scene" "+L$folder" -D -F +Q0 +W4 +H3 -P </dev/null >"$key.log" 2>&1
    echo $? >"$key.code"
  fi
  reference=$(cat "$key.code")
  theirs=$(grep -m 1 -E "(Parse|Cannot|Possible|Fatal) ?[a-z]* ?[Ee]rror|^[^ ]* line [0-9]+: Parse" "$key.log" | sed "s/^.*Error: //")
  printf "%s\t%d\t%d\t%.2f\t%s\t%s\n" "$name" "$code" "$reference" \
    "$(echo "$end - $begin" | bc)" "$error" "$theirs" >"$2/rows/$number.row"
' sh "$lambert" "$out" <"$out/list"

printf 'scene\tlambert\treference\tseconds\terror\treference error\n' >"$out/table.tsv"
cat "$out"/rows/*.row >>"$out/table.tsv"
awk -F '\t' 'NR > 1 {
    both += $2 == 0 && $3 == 0; neither += $2 != 0 && $3 != 0
    if ($2 != 0 && $3 == 0) { refused++; print "only lambert stops: " $1 ": " $5 }
    if ($2 == 0 && $3 != 0) { taken++; print "only POV-Ray stops: " $1 ": " $6 }
    if ($2 != 0 && $3 != 0) print "both stop: " $1 ": " $5 " | " $6
    if ($2 > 1) { bad++; print "code " $2 ": " $1 } }
  END { printf "%d scenes: %d read by both, %d by neither, %d only by POV-Ray, %d only by lambert\n",
      NR - 1, both, neither, refused, taken
    exit refused || taken || bad }' "$out/table.tsv" | tee "$out/summary.txt"
grep -q ' 0 only by POV-Ray, 0 only by lambert$' "$out/summary.txt"
