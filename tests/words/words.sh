#!/bin/sh
# Walks words.tsv: every reserved word has a row, its scene is read or refused as the row says,
# and the word can be no name. `words.sh --povray` compares with an installed POV-Ray instead.
folder=$(cd "$(dirname "$0")" && pwd)
harness=$folder/../harness
lambert=${lambert:-$(cd "${top_builddir:-.}" && pwd)/lambert}
data=$folder/../data
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset POVINI POVINC LAMBERT_PATH
grep -v '^#' "$folder/words.tsv" >rows
for pair in rgb8.png:png rgb24.bmp:bmp rgb24.bmp:sys photo.exr:exr palette.gif:gif palette.gif:pot plain.hdr:hdr \
  palette.iff:iff photo.jpg:jpeg grey8.pgm:pgm rgb8.ppm:ppm rgb24.tga:tga rgb8.tif:tiff; do
  cp "$data/images/${pair%:*}" "words.${pair#*:}" || exit 1
done
cp "$data/t8.df3" words.df3
awk -F '\t' '{
  file = $1 ".pov"
  if ($4 !~ /^#version/)
    print "#version 3.7; global_settings { assumed_gamma 1 }" >file
  print $4 >file
  close(file)
}' rows

if [ "$1" = --povray ]; then
  while IFS="$(printf '\t')" read -r word povray _; do
    verdict=no
    timeout 60 povray "+I$word.pov" -D -F +W1 +H1 +Q0 >out 2>&1 </dev/null && verdict=yes
    [ "$verdict" = "$povray" ] || echo "$word: POV-Ray says $verdict"
  done <rows
  exit
fi

. "$harness/same.sh"

sed -n 's/^WORD(\([a-z_0-9]*\),.*/\1/p' "$folder/../../src/lang/keywords.def" | sort >wanted
cut -f 1 rows | sort >got
same "every reserved word has a row"

cut -f 1 rows | sed 's/$/.pov/' | xargs "$lambert" check --diagnostics=gcc >out 2>&1
sed -n 's/^\([a-z_0-9]*\)\.pov:[0-9:]* error: .*/\1/p' out | sort -u >got
awk -F '\t' '$3 == "no" { print $1 }' rows | sort >wanted
same "read or refused as the rows say"

{ echo '#version 3.7;'; sed 's/^\([^\t]*\).*/#declare \1 = 1;/' rows; } >names.scn
"$lambert" check --max-errors=0 --diagnostics=gcc names.scn >out 2>&1
sed -n 's/^names\.scn:\([0-9]*\):.* error: .*\[E[0-9]*\]$/\1/p' out | sort -nu >got
awk 'END { for (i = 2; i <= NR + 1; i++) print i }' rows >wanted
same "no reserved word can be declared"

same_end
