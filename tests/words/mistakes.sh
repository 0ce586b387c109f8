#!/bin/sh
# Walks mistakes.tsv, whose numbers are those of the list of common mistakes (1 to 73; 74 on: our own): what is said
# of each scene, with caret and hint, is in mistakes.out. `mistakes.sh --update` writes that,
# `mistakes.sh --povray` compares with an installed POV-Ray instead.
folder=$(cd "$(dirname "$0")" && pwd)
harness=$folder/../harness
lambert=${lambert:-$(cd "${top_builddir:-.}" && pwd)/lambert}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset POVINI POVINC LAMBERT_PATH
tab=$(printf '\t')
grep -v '^#' "$folder/mistakes.tsv" >rows
# \n and \0303 in the last column are a line end and a byte.
n=0
while IFS=$tab read -r number _ _ text; do
  n=$((n + 1))
  scene=$(printf '%s-%03d.pov' "$number" $n)
  printf '#version 3.7;\nglobal_settings { assumed_gamma 1 }\n%b\n' "$text" >"$scene"
  echo "$scene" >>scenes
done <<END
$(sed 's/\\\\/\\134/g' rows)
END

# verdict CODE WORD: of the messages in `out`
verdict()
{
  if [ "$1" != 0 ]; then
    echo error
  elif grep -i ' *warning:' out | grep -qv -i 'no objects'; then
    echo warning
  else
    echo nothing
  fi
}

if [ "$1" = --povray ]; then
  paste rows scenes | while IFS=$tab read -r _ wanted _ _ scene; do
    timeout 60 povray "+I$scene" -D -F +W1 +H1 +Q0 >out 2>&1 </dev/null
    got=$(verdict $?)
    [ "$got" = "$wanted" ] || echo "$scene: $got: $(tail -n 1 "$scene")"
  done
  exit
fi

paste rows scenes | while IFS=$tab read -r _ _ _ _ scene; do
  "$lambert" check "+L$folder/../../scenes/include" --color=never "$scene" >out 2>&1
  verdict $? >>verdicts
  sed -n 3p "$scene" | sed 's/^/==== /'
  sed "s/^$scene://" out
done >shown
if [ "$1" = --update ]; then
  cp shown "$folder/mistakes.out"
  exit
fi

. "$harness/same.sh"
seq 1 104 | grep -v -x -e 16 -e 19 -e 73 >wanted
cut -f 1 rows | sort -nu >got
same "every mistake of the list has a scene"
paste scenes rows | cut -f 1,4 >wanted
paste scenes verdicts >got
same "each is an error, a warning or nothing as the rows say"
cp "$folder/mistakes.out" wanted
cp shown got
same "the messages show the place and help"
same_end
