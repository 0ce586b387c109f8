# gnuplot -e "data='...'; out='...'" chart.gp
set terminal svg size 1500,1900 font "sans,13" background "#ffffff"
set output out
set multiplot layout 5,2
set logscale xy
set grid
set format y "%g"
set format x "%g"
set pointsize 0.8
set key outside right top samplen 2 font "sans,11"
s = data."/solutions.tsv"
pick(scene, method, solver) = sprintf("< awk -F'\\t' '$1==\"%s\" && index($2,\"%s\")==1 && $3==\"%s\"' %s | sort -g -k 8", scene, method, solver, s)
set ylabel "relative error (rms)"
set xlabel "user CPU, s"
set title "Cube (C1), means of walls"
plot pick("cube","analytic","stochastic") u 6:5 w lp t "stochastic", \
     pick("cube","analytic","gauss-seidel") u 6:5 w lp t "analytic, Gauss-Seidel", \
     pick("cube","analytic","cg") u 6:5 w p t "analytic, CG", \
     pick("cube","analytic","shooting") u 6:5 w p t "analytic, shooting", \
     pick("cube","analytic","hierarchical") u 6:5 w p t "analytic, hierarchical", \
     pick("cube","sobol","gauss-seidel") u 6:5 w p t "Sobol rays", \
     pick("cube","rays","gauss-seidel") u 6:5 w p t "random rays", \
     pick("cube","hemicube","gauss-seidel") u 6:5 w lp t "hemicube", \
     pick("cube","area","gauss-seidel") u 6:5 w p t "area", \
     pick("cube","disc","gauss-seidel") u 6:5 w p t "disc", \
     data."/povray.tsv" u 3:2 w lp lw 2 t "POV-Ray radiosity (3 views)"
set title "Cornell box, means of surfaces"
plot pick("cornell","analytic","stochastic") u 6:5 w lp t "stochastic", \
     pick("cornell","analytic","gauss-seidel") u 6:5 w lp t "analytic, Gauss-Seidel"
set title "Closed cap (S6), every patch"
plot pick("cap","analytic","stochastic") u 6:5 w lp t "stochastic", \
     pick("cap","analytic","gauss-seidel") u 6:5 w lp t "analytic, Gauss-Seidel"
set title "Two discs (C4), means"
plot pick("discs","analytic","stochastic") u 6:5 w lp t "stochastic", \
     pick("discs","analytic","gauss-seidel") u 6:5 w lp t "analytic, Gauss-Seidel"
set xlabel "rays"
set title "Error against rays"
plot for [n in "cube cornell cap discs"] pick(n,"analytic","stochastic") u 8:5 w lp t n." stochastic", \
     for [n in "cube cornell cap discs"] pick(n,"analytic","gauss-seidel") u 8:5 w p t n." Gauss-Seidel"
set xlabel "bytes"
set title "Error against memory"
plot for [n in "cube cornell cap discs"] pick(n,"analytic","stochastic") u 9:5 w p t n." stochastic", \
     for [n in "cube cornell cap discs"] pick(n,"analytic","gauss-seidel") u 9:5 w lp t n." Gauss-Seidel"
st = data."/stability.tsv"
get(what, name) = sprintf("< awk -F'\\t' '$1==\"%s\" && $2==\"%s\"' %s", what, name, st)
set xlabel "1 - reflectance"
set ylabel "steps to 1 %"
set title "Steps against reflectance, 96 patches"
plot for [n in "jacobi gauss-seidel cg shooting hierarchical"] get("rho", n) u (1-$3):4 w lp t n
set xlabel "distance / size"
set ylabel "relative error of F"
set title "Two parallel squares coming close"
set yrange [1e-9:10]
plot for [n in "analytic area disc hemicube rays sobol"] get("distance", n) u 3:4 w lp t n
set xlabel "side of the square between two unit squares"
set title "Partly hidden squares, one pair"
set yrange [1e-5:10]
plot for [n in "analytic area disc rays sobol"] get("occluder", n) u 3:4 w lp t n
unset multiplot
