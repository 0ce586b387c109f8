#!/bin/bash
# Measures the tables of the radiosity chart. Times are user CPU seconds on one thread: the
# median of RUNS runs, errors the rms over them. ONLY names curves (a regular expression for
# method/solver); all other rows stay. What takes over LIMIT seconds has no row.
# usage: [RUNS=3] [LIMIT=600] [ONLY='/(cg|elimination)$'] \
#        run.sh BUILD_FOLDER OUT_FOLDER [scene ...] [stability] [pictures-cube] ...
set -u
build=$(cd "$1" && pwd) out=$(cd "$2" && pwd)
shift 2
here=$(cd "$(dirname "$0")" && pwd)
runs=${RUNS:-3} limit=${LIMIT:-600} only=${ONLY:-.}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

solve() { # scene key=value ...
  local truth=$here/$1.truth.tsv method=analytic solver=stochastic i # by default
  for i in "${@:2}"; do
    case $i in
    method=*) method=${i#*=} ;;
    solver=*) solver=${i#*=} ;;
    esac
  done
  [[ $method/$solver =~ $only ]] || return 0
  [ "$1" = csg ] && truth=furnace
  timeout -s KILL "$limit" "$build/radiosity_bench" "$here/$1.pov" "$truth" runs="$runs" "${@:2}" \
    >>"$work/table" || echo "$1 ${*:2}: no row" >&2
}

# Patches asked for; the furnace's charts alone are 707.
sizes() {
  case $1 in csg) echo 400 1000 ;; *) echo 60 150 400 ;; esac
}

scene() { # replaces the lines of a scene in the table
  : >"$work/table"
  local n rays solver
  for n in $(sizes "$1"); do
    solve "$1" method=analytic solver=gauss-seidel patches=$n tolerance=2e-3
    solve "$1" method=analytic solver=stochastic patches=$n tolerance=1e-2 rays=$((n * 250))
    solve "$1" method=sobol solver=gauss-seidel patches=$n tolerance=2e-3 factor-rays=1024
    solve "$1" method=rays solver=gauss-seidel patches=$n tolerance=2e-3 factor-rays=1024
    solve "$1" method=hemicube solver=gauss-seidel patches=$n tolerance=2e-3 resolution=128
    solve "$1" method=area solver=gauss-seidel patches=$n tolerance=2e-3
    solve "$1" method=disc solver=gauss-seidel patches=$n tolerance=2e-3
    for solver in elimination jacobi cg hierarchical; do
      solve "$1" method=analytic solver=$solver patches=$n tolerance=2e-3
    done
  done
  # Rows are computed anew for every shot: not of the furnace.
  for n in 60 150; do
    [ "$1" = csg ] || solve "$1" method=analytic solver=shooting patches=$n tolerance=2e-3
  done
  for rays in 1e4 1e5 1e6; do
    solve "$1" method=analytic solver=stochastic patches=1000 tolerance=1e-2 rays=$rays
  done
  # What one gets who sets nothing.
  solve "$1"
  awk -F'\t' -v s="$1" -v only="$only" '$1 != s || $2 "/" $3 !~ only' "$out/solutions.tsv" \
    >"$work/rest" 2>/dev/null
  {
    printf '#scene\tmethod\tsolver\tsettings\tpatches\terror\tuser s\trays\tbytes\tsteps\testimate\truns\n'
    sort "$work/rest" "$work/table" | grep -v '^#'
  } >"$work/all"
  mv "$work/all" "$out/solutions.tsv"
}

# ---- pictures --------------------------------------------------------------------------
# Each setting renders the views of a scene; the programs take turns; what takes
# over 20 s is not repeated.
views() {
  case $1 in cube) echo 0 1 2 ;; *) echo 0 ;; esac
}
light() {
  case $1 in cube) echo .5 ;; *) echo 20 ;; esac
}
size() {
  case $1 in cube) echo 64 64 ;; *) echo 160 160 ;; esac
}

picture() { # scene program label options...
  local scene=$1 program=$2 label=$3 view total=0 t args=() w h i
  shift 3
  read -r w h < <(size "$scene")
  local times=()
  for ((i = 0; i < runs; i++)); do
    total=0
    args=()
    for view in $(views "$scene"); do
      printf '#version 3.7;\n#declare View = %s;\n#include "%s.pov"\n' "$view" "$scene" >"$work/$scene$view.pov"
      TIMEFORMAT=%U
      if [ "$program" = povray ]; then
        t=$({ time timeout -s KILL 1800 povray +I"$work/$scene$view.pov" +L"$here" +O"$work/p$view.ppm" +FP16 \
          File_Gamma=1.0 +W"$w" +H"$h" -D -GA +WT1 "$@" >/dev/null 2>&1; } 2>&1)
      else
        # The first view's solution serves the others.
        local solution=--gi-load=$work/solution
        [ "$view" = 0 ] && solution=--gi-save=$work/solution
        t=$({ time timeout -s KILL 1800 "$build/lambert" "$work/$scene$view.pov" "$solution" +L"$here" -o "$work/p$view.ppm" +FP16 \
          File_Gamma=1.0 +W"$w" +H"$h" --threads=1 --gi=radiosity "$@" >/dev/null 2>&1; } 2>&1)
      fi
      total=$(echo "$total $t" | awk '{print $1 + $2}')
      args+=("$work/$scene$view.pov" "$work/p$view.ppm")
    done
    times+=("$total")
    [ "$(echo "$total" | awk '{print ($1 > 20)}')" = 1 ] && break
  done
  t=$(printf '%s\n' "${times[@]}" | sort -g | awk '{x[NR] = $1} END {print x[int((NR + 1) / 2)]}')
  local off
  off=$(cd "$here" && "$build/radiosity_picture" "$here/$scene.truth.tsv" "$(light "$scene")" "${args[@]}" | cut -f1)
  printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$scene" "$program" "$label" "$off" "$t" "${#times[@]}" >>"$out/pictures.tsv"
}

pov() { # scene label count error_bound recursion_limit nearest_count pretrace_end
  picture "$1" povray "$2" Declare=Count="$3" Declare=Error="$4" Declare=Recursion="$5" \
    Declare=Nearest="$6" Declare=Pretrace="$7"
}

pictures() { # replaces the lines of a scene in the table
  local s=$1
  awk -F'\t' -v s="$s" '$1 != s && !/^#/' "$out/pictures.tsv" >"$work/rest" 2>/dev/null
  {
    printf '#scene\tprogram\tsettings\terror\tuser s\truns\n'
    cat "$work/rest"
  } >"$out/pictures.tsv"
  pov "$s" "defaults" 35 1.8 2 5 .04
  picture "$s" lambert "20 patches, 5e3 rays" --gi-patches=20 --gi-solver=stochastic --gi-rays=5e3
  picture "$s" lambert "100 patches, 3e4 rays" --gi-patches=100 --gi-solver=stochastic --gi-rays=3e4
  picture "$s" lambert "300 patches, 1e5 rays" --gi-patches=300 --gi-solver=stochastic --gi-rays=1e5
  pov "$s" "count 100, error_bound .5, recursion_limit 4" 100 .5 4 5 .02
  picture "$s" lambert "1000 patches, 3e5 rays" --gi-patches=1000 --gi-rays=3e5
  picture "$s" lambert "4000 patches" --gi-patches=4000
  pov "$s" "count 200, error_bound .3, recursion_limit 6, nearest_count 8" 200 .3 6 8 .02
  picture "$s" lambert "defaults"
  pov "$s" "count 400, error_bound .2, recursion_limit 8, nearest_count 10" 400 .2 8 10 .01
}

[ $# -gt 0 ] || set -- cube cornell csg room stability pictures-cube pictures-cornell
for what in "$@"; do
  case $what in
  stability) "$build/radiosity_stability" >"$out/stability.tsv" ;;
  pictures-*) pictures "${what#pictures-}" ;;
  *) scene "$what" ;;
  esac
done
