#!/bin/bash
# Speed of every scene that POV-Ray ships, rendered by both one after the other, one thread each.
# Usage: tests/perf/examples.sh [-s WxH] [-j JOBS] [-t SECONDS] [-a THRESHOLD] [NAME...], NAME such
# as advanced/balcony. -a: with anti-aliasing, +ATHRESHOLD. Prints tab-separated CPU seconds, scenes sorted by the ratio of rendering: the
# whole process of POV-Ray and lambert and their ratio, rendering and its ratio (POV-Ray's times of
# photons, radiosity and tracing; all of lambert's but reading the scene). A scene that either does
# not render in SECONDS of processor time is named at the end (timeout(1) would be a process whose own
# time is counted). Pictures are not compared here: tests/compare/run.sh does that.
set -u
here=$(cd "$(dirname "$0")" && pwd)
lambert=$(realpath "${LAMBERT:-$here/../../build/lambert}")
examples=${EXAMPLES:-/usr/share/doc/povray/examples}
size=320x240 jobs=1 limit=120 antialias=-A
while getopts s:j:t:a: option; do
  case $option in
  s) size=$OPTARG ;;
  j) jobs=$OPTARG ;;
  t) limit=$OPTARG ;;
  a) antialias=+A$OPTARG ;;
  *) exit 64 ;;
  esac
done
shift $((OPTIND - 1))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$examples" "$work/scenes" # some scenes write files
export lambert work limit antialias width=${size%x*} height=${size#*x}

# row NAME: renders one scene with both and prints its row.
row() {
  local scene=$work/scenes/$1.pov own
  TIMEFORMAT=%U
  own=$(mktemp -d "$work/row.XXXXXX")
  cd "$(dirname "$scene")" || return
  ulimit -t "$limit" # of each process from here
  { time povray "+I$scene" "+O$own/pov.png" "+W$width" "+H$height" +WT1 -D "$antialias" -P \
    </dev/null >"$own/out" 2>"$own/log"; } 2>"$own/pov"
  { time "$lambert" "$scene" -o "$own/lam.png" "+W$width" "+H$height" --threads=1 "$antialias" \
    -q --stats=json </dev/null >"$own/json" 2>"$own/err"; } 2>"$own/lam"
  local made=
  [ -s "$own/pov.png" ] || made="$made POV-Ray"
  [ -s "$own/lam.png" ] || made="$made lambert"
  [ -z "$made" ] || { printf 'none\t%s\t%s\n' "$1" "no picture of$made" && rm -rf "$own" && return; }
  printf 'row\t%s\t%s\t%s\t%s\t%s\n' "$1" "$(cat "$own/pov")" "$(cat "$own/lam")" \
    "$(sed -n '/^Render Time:/,$s/.*with \([0-9.]*\) CPU-seconds.*/\1/p' "$own/log" | paste -sd+ | bc)" \
    "$(sed -n 's/.*"parse_seconds": *\([0-9.e+-]*\).*/\1/p' "$own/json" | awk -v all="$(cat "$own/lam")" '{print all - $1}')"
  rm -rf "$own"
}
export -f row

if [ $# -eq 0 ]; then
  mapfile -t names < <(cd "$work/scenes" && find . -name '*.pov' | sed 's,^\./,,; s,\.pov$,,' | sort)
  set -- "${names[@]}"
fi
printf '%s\n' "$@" | xargs -P "$jobs" -d '\n' -I NAME bash -c 'row "$1"' bash NAME |
  awk -F '\t' -v OFS='\t' '
    $1 == "none" {none[++m] = $2 OFS $3; next}
    {whole = $3 / ($4 > .001 ? $4 : .001); trace = $5 / ($6 > .001 ? $6 : .001)
     n++; w += log(whole > 0 ? whole : 1e-3); t += log(trace > 0 ? trace : 1e-3)
     printf "%s\t%.3f\t%.3f\t%.2f\t%.3f\t%.3f\t%.2f\n", $2, $3, $4, whole, $5, $6, trace | "sort -t \"\t\" -k 7,7g"}
    END {close("sort -t \"\t\" -k 7,7g")
         if (n) printf "geometric mean of %d scenes\t\t\t%.2f\t\t\t%.2f\n", n, exp(w / n), exp(t / n)
         for (i = 1; i <= m; i++) print none[i]}'
