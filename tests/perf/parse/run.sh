#!/bin/bash
# run.sh [LAMBERT [SCENE...]]: processor time and memory that reading takes, lambert and
# POV-Ray (if installed) in turn, the best of three. POV-Ray renders one pixel without
# light; it has no way to stop after reading.
lambert=$(realpath "${1:-./lambert}")
folder=$(cd "$(dirname "$0")" && pwd)
shift
scenes=${*:-loops macros recursion strings arrays objects_loop objects_textured objects_plain mesh2 nested copies}
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

# once NAME COMMAND...: seconds of user and system time and KiB, kept if they are the least
once()
{
  local name=$1 seconds kib
  shift
  timeout 600 /usr/bin/time -o time -f '%U %S %M' "$@" </dev/null >/dev/null 2>&1 || { echo "- -" >"$name"; return; }
  read -r user system kib <time
  seconds=$(echo "$user + $system" | bc)
  if [ ! -e "$name" ] || [ "$(echo "$seconds < $(cut -d ' ' -f 1 "$name")" | bc)" = 1 ]; then
    echo "$seconds $kib" >"$name"
  fi
}

printf '%-18s %10s %10s %7s %10s %10s\n' scene 'POV-Ray s' 'lambert s' ratio 'POV MiB' 'MiB'
for scene in $scenes; do
  sh "$folder/generate.sh" "$scene" >scene.pov || exit 1
  rm -f ours theirs
  echo "- -" >theirs
  command -v povray >/dev/null && rm theirs
  for _ in 1 2 3; do
    [ ! -e theirs ] || grep -q -v - theirs && once theirs povray +Iscene.pov -D -F +W1 +H1 +Q0
    once ours "$lambert" check scene.pov
  done
  read -r a am <theirs
  read -r b bm <ours
  ratio=$(echo "scale=2; $a / $b" | bc 2>/dev/null)
  printf '%-18s %10s %10s %7s %10s %10s\n' "$scene" "$a" "$b" "${ratio:--}" \
    "$(echo "$am / 1024" | bc 2>/dev/null)" "$(echo "$bm / 1024" | bc 2>/dev/null)"
done
