#!/bin/sh
# run-scene.sh SCENE: reads a scene and compares with what its comments promise.
#   // debug: TEXT           the lines of the debug stream, in order
#   // expect: TEXT          the lines of --dump-csg, in order
#   // message: TEXT         the lines of the messages, in order (last line left out)
#   // expect error: Ennnn   an error that is reported on this line, and the same
#   // expect warning: Ennnn with warnings; no other error may appear
scene=$1
harness=$(cd "$(dirname "$0")" && pwd)
lambert=$(cd "${top_builddir:-.}" && pwd)/lambert
folder=$(cd "$(dirname "$scene")" && pwd)
name=$(basename "$scene")
scene=$folder/$name
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset POVINI POVINC LAMBERT_PATH

. "$harness/same.sh"

read_scene()
{
  "$lambert" "$scene" "--library-path=$folder" --width=4 --height=4 --dump-csg "$@" \
    >out 2>err
}

read_scene --diagnostics=json
code=$?
grep -v -e '^{"v":' -e '^lambert: ' err >got
sed -n 's|^// debug: \{0,1\}||p' "$scene" >wanted
same 'debug stream'

sed -n 's/.*"sev":"\([a-z]*\)","code":"\(E[0-9]*\)","file":"[^"]*'"$name"'","line":\([0-9]*\).*/\3 \1 \2/p' \
  err >found
if grep -q '// expect warning:' "$scene"; then cat found; else grep ' error ' found; fi |
  sort -u >got
awk '!/^\/\/ message:/ && match($0, /\/\/ expect (error|warning): E[0-9]+/) {
       n = split(substr($0, RSTART, RLENGTH), w, " "); sub(":", "", w[3]); print NR, w[3], w[4]
     }' "$scene" | sort -u >wanted
same 'errors and their lines'

n=$((n + 1))
if grep -q '// expect error:' "$scene"; then code_wanted=1; else code_wanted=0; fi
if test $code = $code_wanted; then
  echo "ok $n - exit code"
else
  echo "not ok $n - exit code $code, not $code_wanted"
  sed 's/^/# /' err
  failed=1
fi

if grep -q '^// expect:' "$scene"; then
  sed -n 's|^// expect: \{0,1\}||p' "$scene" >wanted
  cp out got
  same 'objects'
fi
if grep -q '^// message:' "$scene"; then
  sed -n 's|^// message: \{0,1\}||p' "$scene" >wanted
  read_scene --diagnostics=text --color=never
  sed -e "s|$folder/||g" -e '/^lambert: /d' err >got
  same 'messages'
fi
same_end
