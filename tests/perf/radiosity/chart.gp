# gnuplot -e "data='...'; out='...'" chart.gp
set terminal svg size 2000,2350 font "sans,13" background "#ffffff"
set output out
set multiplot layout 6,4
set logscale xy
set grid lc rgb "#dddddd"
set format x "%g"
set format y "%g"
set pointsize 0.8
set tics font "sans,11"
set title font "sans,14"
set key below maxrows 3 samplen 1.5 font "sans,11" spacing 1.1 width -2
set bmargin 6.8

# Colour-blind safe (Okabe, Ito 2008); every curve has a shape of its own as well.
set style line 1 lc rgb "#0072b2" lw 2 pt 7  # analytic, Gauss-Seidel
set style line 2 lc rgb "#d55e00" lw 2 pt 5  # hemicube, shooting
set style line 3 lc rgb "#009e73" lw 2 pt 9  # rays, conjugate gradients
set style line 4 lc rgb "#cc79a7" lw 2 pt 13 # Sobol, hierarchical
set style line 5 lc rgb "#e69f00" lw 2 pt 11 # area, Jacobi
set style line 6 lc rgb "#56b4e9" lw 2 pt 4  # disc, elimination
set style line 7 lc rgb "#000000" lw 2 pt 6  # stochastic, patches and rays grow
set style line 8 lc rgb "#999999" lw 2 pt 8 # more rays, rays grow

s = data."/solutions.tsv"
# "more rays": the stochastic solver on 1000 patches with 1e4 to 1e6 rays.
# Of a curve: patches, error, time, rays, bytes, by patches.
pick(scene, method, solver) = sprintf("< awk -F'\\t' '$1==\"%s\" && $2==\"%s\" && $3==\"%s\" && $4 !~ /rays=1e/ && $4 ~ /tolerance/ {print $5, $6, $7, $8, $9}' %s | sort -g", scene, method, solver, s)
grown(scene) = sprintf("< awk -F'\\t' '$1==\"%s\" && $3==\"stochastic\" && $4 ~ /rays=1e/ {print $8, $6, $7, $8, $9}' %s | sort -g", scene, s)
method(k) = word("analytic hemicube rays sobol area disc", k)
solver(k) = word("gauss-seidel shooting cg hierarchical jacobi elimination stochastic", k)
title_of(scene) = scene eq "cube" ? "Cube" : scene eq "cornell" ? "Cornell box" : scene eq "csg" ? "CSG furnace" : "Room"

do for [scene in "cube cornell csg room"] {
  set yrange [2e-3:1]
  set xrange [.005:20]
  set xlabel "user CPU, s"
  set ylabel "relative rms error"
  set title title_of(scene).": form factors"
  plot for [k=1:6] pick(scene, method(k), "gauss-seidel") u 3:2 w lp ls k t method(k)
  set title title_of(scene).": solvers"
  plot for [k=1:7] pick(scene, "analytic", solver(k)) u 3:2 w lp ls k t solver(k), \
       grown(scene) u 3:2 w lp ls 8 t "more rays"
  set xrange [3e3:1e7]
  set xlabel "rays"
  set title title_of(scene).": rays"
  plot pick(scene, "analytic", "gauss-seidel") u 4:2 w lp ls 1 t "Gauss-Seidel", \
       pick(scene, "rays", "gauss-seidel") u 4:2 w lp ls 3 t "by rays", \
       pick(scene, "sobol", "gauss-seidel") u 4:2 w lp ls 5 t "by Sobol", \
       pick(scene, "analytic", "shooting") u 4:2 w lp ls 2 t "shooting", \
       pick(scene, "analytic", "hierarchical") u 4:2 w lp ls 4 t "hierarchical", \
       pick(scene, "analytic", "stochastic") u 4:2 w lp ls 7 t "stochastic", \
       grown(scene) u 4:2 w lp ls 8 t "more rays"
  set xrange [2e4:1e7]
  set xlabel "bytes"
  set title title_of(scene).": memory"
  plot for [k=1:7] pick(scene, "analytic", solver(k)) u 5:2 w lp ls k t solver(k)
}

# ---- stability
unset xrange
unset yrange
set autoscale
st = data."/stability.tsv"
get(what, name) = sprintf("< awk -F'\\t' '$1==\"%s\" && $2==\"%s\" {print $3, $4}' %s", what, name, st)
set xlabel "1 - reflectance"
set ylabel "steps to 1 %"
set title "Stability: steps of solvers, 96 patches"
plot for [k=1:5] get("rho", solver(k)) u (1-$1):2 w lp ls k t solver(k)
set xlabel "distance / size"
set ylabel "relative error of F"
set yrange [1e-9:1e2]
set title "Stability: two squares coming close"
plot for [k=1:6] get("distance", method(k)) u 1:2 w lp ls k t method(k)
set xlabel "side of the square between two unit squares"
set yrange [1e-5:10]
set title "Stability: partly hidden squares, one pair"
plot for [k=1:6] get("occluder", method(k)) u 1:2 w lp ls k t method(k)

# ---- pictures
p = data."/pictures.tsv"
shown(scene, program) = sprintf("< awk -F'\\t' '$1==\"%s\" && $2==\"%s\" {print $5, $4}' %s | sort -g", scene, program, p)
set xrange [.01:200]
set yrange [5e-3:1]
set xlabel "user CPU, s"
set ylabel "relative rms error"
do for [scene in "cube cornell"] {
  set title title_of(scene).": pictures"
  plot shown(scene, "povray") u 1:2 w lp ls 2 t "POV-Ray radiosity", \
       shown(scene, "lambert") u 1:2 w lp ls 1 t "lambert --gi=radiosity"
}
unset multiplot
