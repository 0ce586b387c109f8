#!/bin/sh
# Asks POV-Ray (povray on PATH) for the rays and pictures of the stability tests and
# prints the tables of doc/accuracy.md. usage: povray.sh BUILD-FOLDER, after `make accuracy`
set -e
build=$(cd "${1:?usage: povray.sh BUILD-FOLDER}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

"$build/accuracy" scene >rays.pov
povray rays.pov +W4 +H4 -D -F 2>&1 | grep '^answer ' >answers || true
test -s answers || { echo "povray gave no answer" >&2; exit 1; }
"$build/accuracy" table answers

# pov OUT SCENE OPTION...; own likewise: 64 x 64, no antialiasing
pov() { out=$1; scene=$2; shift 2; povray "$scene" "+O$out" +FN +W64 +H64 -A -D "$@" >/dev/null 2>&1; }
own() { out=$1; scene=$2; shift 2; "$build/lambert" "$scene" -o "$out" --width=64 --height=64 --quiet "$@"; }

# row NAME LAMBERT POV
row() { echo "| $1 | $2 | $3 |"; }

echo
echo "| Picture (64 x 64) | lambert | POV-Ray 3.7 |"
echo "|---|---|---|"
"$build/accuracy" picture still-life 1 0 >one.pov
pov one_pov.png one.pov
own one_own.png one.pov
for at in "1e-5 0" "1e-3 0" "1e-1 0" "10 0" "1e3 0" "1e5 0" "1 1e6"; do
  size=${at% *}
  place=${at#* }
  "$build/accuracy" picture still-life "$size" "$place" >other.pov
  pov other_pov.png other.pov
  own other_own.png other.pov
  row "T29, T30 size $size, moved by $place: pixels that change by more than 1/255" \
    "$("$build/accuracy" pixels one_own.png other_own.png)" \
    "$("$build/accuracy" pixels one_pov.png other_pov.png)"
done
"$build/accuracy" picture sheet 1 0 >sheet.pov
for block in 4 16 32 64; do
  pov pov.png sheet.pov "+BS$block" +WT2
  own own.png sheet.pov "--tile-size=$block" --threads=2
  row "T32 shadow of a rising sheet, blocks of $block: pixels of 4096 in shadow" \
    "$("$build/accuracy" pixels own.png)" "$("$build/accuracy" pixels pov.png)"
done
for size in 1 1e-3 1e3; do
  "$build/accuracy" picture glass "$size" 0 >glass.pov
  pov pov.png glass.pov
  own own.png glass.pov
  row "T33 glass close above a white plane, size $size: black pixels of 4096" \
    "$("$build/accuracy" pixels own.png)" "$("$build/accuracy" pixels pov.png)"
done
