#!/bin/bash
# Speed of every shape against POV-Ray: one scene a shape (tests/perf/shapes), measured by
# run.sh. Usage: tests/perf/shapes.sh [-n RUNS] [-s WxH] [NAME...]. Ends with the shapes
# whose tracing is less than three times as fast.
set -u
here=$(cd "$(dirname "$0")" && pwd)
runs=3 size=640x480
while getopts n:s: option; do
  case $option in
  n) runs=$OPTARG ;;
  s) size=$OPTARG ;;
  *) exit 64 ;;
  esac
done
shift $((OPTIND - 1))
if [ $# -gt 0 ]; then
  scenes=()
  for name in "$@"; do scenes+=("$here/shapes/$name.scn"); done
else
  scenes=("$here"/shapes/*.scn)
fi
"$here/run.sh" -n "$runs" -s "$size" "${scenes[@]}" | tee /dev/stderr |
  awk -F'|' '$8 + 0 > 0 && $8 + 0 < 3 && $2 !~ /mean/ {slow = slow sprintf("%s:%s", $2, $8)}
             END {print slow ? "less than 3 times as fast:" slow : "all at least 3 times as fast"}'
