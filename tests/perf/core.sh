#!/bin/bash
# The tracer's core by itself: the scenes of tests/perf/core at 1280x960, one thread.
# Usage: tests/perf/core.sh [-n RUNS] [OTHER_LAMBERT]
# Prints a Markdown table: seconds for building and tracing (best of RUNS), millions of
# rays a second, peak memory; with another lambert, its trace time in turn, too.
set -u
runs=3
while getopts n: option; do
  case $option in
  n) runs=$OPTARG ;;
  *) exit 64 ;;
  esac
done
shift $((OPTIND - 1))
here=$(cd "$(dirname "$0")" && pwd)
lambert=${LAMBERT:-$here/../../build/lambert}
other=${1:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# field NAME FILE...: a number of --stats=json, the least of all files
field() { sed -n "s/.*\"$1\": *\([0-9.e+-]*\).*/\1/p" "${@:2}" | sort -g | head -1; }

render() {
  "$1" "$2" -o "$work/picture.png" --width=1280 --height=960 --threads=1 -q --stats=json >"$3" ||
    echo "core.sh: $1 failed on $2" >&2
}

echo "| scene | build s | trace s | rays M/s | memory MB |${other:+ other s | ratio |}"
echo "|---|---|---|---|---|${other:+---|---|}"
for scene in one csg flake sponge; do
  for i in $(seq "$runs"); do
    render "$lambert" "$here/core/$scene.scn" "$work/own.$i"
    [ -z "$other" ] || render "$other" "$here/core/$scene.scn" "$work/other.$i"
  done
  echo "$scene $(field build_seconds "$work"/own.*) $(field trace_seconds "$work"/own.*)" \
    "$(field rays "$work"/own.*) $(field shadow_rays "$work"/own.*)" \
    "$(field memory_peak "$work"/own.*) ${other:+$(field trace_seconds "$work"/other.*)}" |
    awk '{printf "| %s | %.3f | %.3f | %.1f | %.0f |", $1, $2, $3, ($4 + $5)/$3*1e-6, $6/1e6
          if (NF > 6) printf " %.3f | %.2f |", $7, $7/$3
          print ""}'
done
