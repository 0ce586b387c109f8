#!/bin/sh
# Renders the gallery and joins it into one picture (doc/gallery.png). Needs ImageMagick.
# usage: scenes/gallery/montage.sh LAMBERT OUT.png
set -eu
lambert=$1 out=$2
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for scene in glass csg quadrics mirrors spots sponge; do
  "$lambert" "$here/$scene.scn" -o "$work/$scene.png" --width=320 --height=240 +A0.1 +R3 -q
done
cd "$work"
convert +append glass.png csg.png quadrics.png top.png
convert +append mirrors.png spots.png sponge.png bottom.png
convert -append top.png bottom.png -strip joined.png
cd - >/dev/null
cp "$work/joined.png" "$out"
