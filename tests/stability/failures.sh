#!/bin/sh
# Pictures in which POV-Ray (povray on PATH) fails, lambert's above and POV-Ray's below: the sheet
# of doc/accuracy.md. usage: failures.sh BUILD-FOLDER OUT.png, after `make accuracy lambert`
set -e
build=$(cd "${1:?usage: failures.sh BUILD-FOLDER OUT.png}" && pwd)
out=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

own= pov=
# show NAME SIZE
show() {
  "$build/accuracy" picture "$1" "$2" 0 >"$1.pov"
  "$build/lambert" "$1.pov" -o "$1-own.png" --width=64 --height=64 --quiet
  povray "$1.pov" "+O$1-pov.png" +FN +W64 +H64 -A -D +BS16 >/dev/null 2>&1
  own="$own $1-own.png" pov="$pov $1-pov.png"
}
for name in drilled nothing merge crest far fan; do show $name 1; done
show still-life 1e-5
show sheet 1
show glass 1
# shellcheck disable=SC2086
"$build/accuracy" sheet "$out" $own $pov
