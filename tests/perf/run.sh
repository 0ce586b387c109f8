#!/bin/bash
# Speed against POV-Ray: every scene rendered by both in turn, one thread each, the
# pictures checked equal first. Usage: tests/perf/run.sh [-n RUNS] [-s WxH] [SCENE...]
# Prints a Markdown table: seconds of the whole process by the clock and of tracing in CPU
# time (best of RUNS), their ratios, and the share of pixels off by more than 8/255.
set -u
runs=3 size=640x480
while getopts n:s: option; do
  case $option in
  n) runs=$OPTARG ;;
  s) size=$OPTARG ;;
  *) exit 64 ;;
  esac
done
shift $((OPTIND - 1))
here=$(cd "$(dirname "$0")" && pwd)
lambert=${LAMBERT:-$here/../../build/lambert}
[ $# -gt 0 ] || set -- "$here"/*.scn "$here"/../../scenes/gallery/*.scn
width=${size%x*} height=${size#*x}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

now() { date +%s.%N; }

best() { sort -g | head -1; }

echo "| scene | POV-Ray s | lambert s | ratio | POV-Ray trace CPU s | lambert trace CPU s | ratio | pixels off |"
echo "|---|---|---|---|---|---|---|---|"
for scene in "$@"; do
  name=$(basename "$scene" .scn)
  : >"$work/pov" >"$work/lam"
  : >"$work/pov.trace" >"$work/lam.trace"
  for _ in $(seq "$runs"); do
    t0=$(now)
    povray "+I$scene" "+O$work/pov.png" "+W$width" "+H$height" +WT1 -D -A -P </dev/null >/dev/null 2>"$work/pov.log"
    t1=$(now)
    "$lambert" "$scene" -o "$work/lam.png" --width="$width" --height="$height" --threads=1 \
      -q --stats=json >"$work/lam.json" || echo "$name: lambert failed" >&2
    t2=$(now)
    echo "$t0 $t1" | awk '{print $2 - $1}' >>"$work/pov"
    echo "$t1 $t2" | awk '{print $2 - $1}' >>"$work/lam"
    sed -n '/Trace Time/,$s/.*with \([0-9.]*\) CPU-seconds.*/\1/p' "$work/pov.log" | tail -1 >>"$work/pov.trace"
    sed -n 's/.*"trace_cpu_seconds": *\([0-9.e+-]*\).*/\1/p' "$work/lam.json" >>"$work/lam.trace"
  done
  off=$("$lambert" compare "$work/lam.png" "$work/pov.png" 2>/dev/null |
    sed -n 's/.*8\/255: \([0-9.]*\) %.*/\1/p' | head -1)
  echo "$name $(best <"$work/pov") $(best <"$work/lam") $(best <"$work/pov.trace") $(best <"$work/lam.trace") ${off:--}" |
    tee -a "$work/rows" |
    awk '{printf "| %s | %.3f | %.3f | %.1f | %.3f | %.3f | %.1f | %s %% |\n", $1, $2, $3, $2/$3, $4, $5, $4/($5 > 0 ? $5 : 1e-9), $6}'
done
awk '{w += log($2/$3); t += log($4/($5 > 0 ? $5 : 1e-9)); n++}
     END {printf "| **geometric mean** | | | **%.1f** | | | **%.1f** | |\n", exp(w/n), exp(t/n)}' "$work/rows"
