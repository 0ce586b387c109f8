#!/bin/bash
# Speed of every shape against POV-Ray: one scene a shape (tests/perf/shapes), rendered by both
# in turn, one thread each. Usage: tests/perf/shapes.sh [-n RUNS] [-s WxH] [NAME...]
# Prints a Markdown table of CPU times (the whole process, best of RUNS; they bear a busy
# machine), their ratio and the share of pixels off by more than 8/255, and at the end the
# shapes that are less than three times as fast.
set -u
here=$(cd "$(dirname "$0")" && pwd)
lambert=${LAMBERT:-$here/../../build/lambert}
runs=3 size=640x480
while getopts n:s: option; do
  case $option in
  n) runs=$OPTARG ;;
  s) size=$OPTARG ;;
  *) exit 64 ;;
  esac
done
shift $((OPTIND - 1))
width=${size%x*} height=${size#*x}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT=%U

if [ $# -gt 0 ]; then
  scenes=()
  for name in "$@"; do scenes+=("$here/shapes/$name.scn"); done
else
  scenes=("$here"/shapes/*.scn)
fi

# cpu FILE COMMAND...: adds the user time of a command to a file.
cpu() {
  local file=$1
  shift
  { time "$@" </dev/null >"$work/out" 2>"$work/err"; } 2>>"$file"
}

echo "| shape | POV-Ray s | lambert s | ratio | pixels off |"
echo "|---|---|---|---|---|"
for scene in "${scenes[@]}"; do
  name=$(basename "$scene" .scn)
  rm -f "$work"/*
  for _ in $(seq "$runs"); do
    cpu "$work/pov" povray "+I$scene" "+O$work/pov.png" "+W$width" "+H$height" +WT1 -D -A -P
    cpu "$work/lam" "$lambert" "$scene" -o "$work/lam.png" "+W$width" "+H$height" --threads=1 -q
  done
  [ -s "$work/pov.png" ] || { echo "$name: POV-Ray makes no picture" >&2; continue; }
  off=$("$lambert" compare "$work/lam.png" "$work/pov.png" 2>/dev/null |
    sed -n 's/.*8\/255: \([0-9.]*\) %.*/\1/p' | head -1)
  echo "$name $(sort -g "$work/pov" | head -1) $(sort -g "$work/lam" | head -1) ${off:--}"
done | awk '{ratio = $2/($3 > 0.001 ? $3 : 0.001)
             printf "| %s | %.2f | %.2f | %.1f | %s %% |\n", $1, $2, $3, ratio, $4
             fflush(); sum += log(ratio); n++
             if (ratio < 3) slow = slow sprintf(" %s (%.1f)", $1, ratio)}
       END {printf "| **geometric mean** | | | **%.1f** | |\n", exp(sum/n)
            print slow ? "Less than 3 times as fast:" slow : "All at least 3 times as fast."}'
