#!/bin/bash
# Measures the tables of the radiosity chart. Times are user CPU seconds on one thread.
# usage: run.sh BUILD_FOLDER OUT_FOLDER
set -u
build=$1 out=$2
here=$(cd "$(dirname "$0")" && pwd)
solve() { timeout -s KILL 900 "$build/radiosity_bench" "$here/$1.pov" "${@:2}" >>"$out/solutions.tsv"; }

printf '#scene\tmethod\tsolver\tpatches\terror\tuser s\twall s\trays\tbytes\tsteps\testimate\n' >"$out/solutions.tsv"
for scene in cube cornell cap discs; do
  n=300
  [ $scene = cornell ] && n=1000
  for rays in 3e4 1e5 3e5 1e6 3e6; do
    solve $scene analytic stochastic $n 1e-2 $rays
  done
  for n in 100 300 1000; do
    solve $scene analytic gauss-seidel $n 2e-3
  done
done
for method in rays sobol area disc; do
  FACTOR_RAYS=1024 solve cube $method gauss-seidel 300 2e-3
done
for resolution in 32 64 128 256; do
  RESOLUTION=$resolution solve cube hemicube gauss-seidel 300 2e-3
done
for solver in cg jacobi elimination shooting hierarchical; do
  solve cube analytic $solver 300 2e-3
done
"$build/radiosity_stability" >"$out/stability.tsv"

# POV-Ray on the cube: means of floor, ceiling and wall less what they give off, per
# settings; error relative to the truth as in radiosity_bench.
command -v povray >/dev/null || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
printf '#settings\terror\tuser s of three views\n' >"$out/povray.tsv"
while read -r name count bound recursion nearest pretrace; do
  total=0
  for view in 0 1 2; do
    TIMEFORMAT=%U
    t=$({ time timeout -s KILL 1800 povray +I"$here/cube.pov" +O"$work/$view.ppm" +FP16 File_Gamma=1.0 \
      +W64 +H64 -D -GA +WT1 Declare=View=$view Declare=Count=$count Declare=Error=$bound \
      Declare=Recursion=$recursion Declare=Nearest=$nearest Declare=Pretrace=$pretrace \
      >/dev/null 2>&1; } 2>&1)
    total=$(echo "$total $t" | awk '{print $1 + $2}')
    tail -c 24576 "$work/$view.ppm" | od -An -v -w6 -tu1 |
      awk '{s += 256 * $1 + $2} END {print s / NR / 65535}' >"$work/$view.mean"
  done
  paste "$work"/0.mean "$work"/1.mean "$work"/2.mean |
    awk -v name="$name" -v t=$total '{
      f = ($1 - .5) / .0521808 - 1; c = $2 / .085608 - 1; w = $3 / .0905528 - 1
      a = .0521808 ^ 2; b = .085608 ^ 2; d = .0905528 ^ 2
      print name "\t" sqrt((f * f * a + c * c * b + 4 * w * w * d) / (a + b + 4 * d)) "\t" t
    }' >>"$out/povray.tsv"
done <<END
default 35 1.8 2 5 .04
medium 100 .5 4 5 .02
high 400 .2 8 10 .01
END
