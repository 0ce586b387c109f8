#!/bin/sh
# Images of scenes that cannot be read: for each type one cut in the middle, one that is
# something else, one that is missing. All of a scene are told, each with its place.
images=$(cd "${top_srcdir:-.}" && pwd)/tests/data/images
. "${top_srcdir:-.}/tests/cli/common.sh"

line=1
echo '#version 3.7; global_settings { assumed_gamma 1 }' >bad.pov
: >wanted
for image in rgb8.png photo.jpg rgb8.tif palette.gif rgb24.tga rgb8.ppm grey8.pgm rgb24.bmp \
    rgb24.iff packed.hdr photo.exr luma.exr; do
  size=$(wc -c <"$images/$image")
  head -c $((size / 2)) "$images/$image" >"cut-$image"
  line=$((line + 1))
  echo "sphere { 0, 1 pigment { image_map { \"cut-$image\" } } }" >>bad.pov
  echo "bad.pov:$line:37: error: image_map: the image 'cut-$image' cannot be read: " >>wanted
done
echo 'not an image' >text.png
line=$((line + 1))
echo 'sphere { 0, 1 normal { bump_map { png "text.png" } } }' >>bad.pov
echo "bad.pov:$line:39: error: bump_map: the image 'text.png' cannot be read: " >>wanted
line=$((line + 1))
echo 'height_field { png "nothing.png" }' >>bad.pov
echo "bad.pov:$line:20: error: height_field: the image file 'nothing.png' was not found" >>wanted
told() { exits 1 "$lambert" check bad.pov --diagnostics=gcc; }
check "images that cannot be read are errors" told
each()
{
  while read -r message; do
    grep -qF -e "$message" err || { echo "# not told: $message"; sed 's/^/# /' err; return 1; }
  done <wanted
}
check "each is told with its place" each
check "and nothing else" test "$(grep -c 'error:' err)" = "$(wc -l <wanted)"
finish
