# gnuplot -e "data='...'; out='...'" chart.gp
set terminal svg size 1300,2150 font "sans,13" background "#ffffff" noenhanced
set output out
set multiplot layout 5,2
set datafile separator "\t"
set logscale xy
set grid
set format x "%.0s%c"
set pointsize 0.8
set lmargin 11
set rmargin 4
set key below horizontal maxrows 2 samplen 2 font "sans,12"
set xlabel "rays a second"
array color[5] = ["#c04020", "#d09000", "#3070c0", "#309060", "#000000"]

tint(i) = color[int(i + 0)]
mark(i) = i + 0 == 5 ? 7 : int(i + 0)
# The rows of a method; those alone that name a knob of the list, for labels.
rows(family, set, method) = sprintf("< awk -F'\\t' '$1==\"%s\" && $2==\"%s\" && $3==\"%s\"' %s", family, set, method, data)
some(family, set, method, knobs) = sprintf("< awk -F'\\t' '$1==\"%s\" && $2==\"%s\" && $3==\"%s\" && index(\" %s \", \" \" $4 \" \")' %s", family, set, method, knobs, data)
none = 2e-5 # drawn there: no ray of the sample is wrong
wrong(v) = v > none ? v : none
shares = "set ylabel 'share of wrong rays'; set yrange [1e-5:1]; set format y '%g'; set ytics add ('none' 2e-5, ' ' 1e-5)"
errors = "set ylabel 'rms error of t'; set yrange [*:*]; set ytics autofreq; set format y '%.0e'"

m = "'closed form' 'closed form, polished' Sturm isolation lambert"
@errors
set xrange [5e5:4e7]
set title "Quartics: random rays at tori, tube .25 to .001"
plot for [i=1:5] rows("quartic", "random", word(m, i)) u 5:7 w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(m, i), \
     some("quartic", "random", "lambert", "0.25 0.1 0.01") u 5:7:4 w labels offset -2,.7 font "sans,10" notitle
@shares
set xrange [2e5:4e7]
set title "Rays 1e-2 to 1e-12 from touching (dashed: under the crest)"
plot for [i=1:5] rows("quartic", "grazing", word(m, i)) u 5:(wrong($6)) w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(m, i), \
     for [i=1:5] rows("quartic", "crest", word(m, i)) u 5:(wrong($6)) w lp lw 1 dt 2 lc rgb tint(i) pt mark(i) notitle

q = "'world coefficients' 'world coefficients, stable roots' 'about the centre' 'not drawn' lambert"
@errors
set xrange [1e7:2e8]
set title "Quadrics: an ellipsoid 1 to 1e7 from the origin"
plot for [i in "1 2 3 5"] rows("quadric", "offset", word(q, i + 0)) u 5:7 w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(q, i + 0), \
     some("quadric", "offset", "world coefficients", "1 100 10000 1e+06") u 5:7:4 w labels offset 4,0 font "sans,10" notitle
@shares
set title "The same, rays off by more than 1e-4"
plot for [i in "1 2 3 5"] rows("quadric", "offset", word(q, i + 0)) u 5:(wrong($6)) w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(q, i + 0), \
     some("quadric", "offset", "world coefficients", "100000 1e+06 1e+07") u 5:(wrong($6)):4 w labels offset 4,0 font "sans,10" notitle

p = "'two triangles' 'bilinear leaves' 'not drawn' 'not drawn' lambert"
@errors
set xrange [5e5:4e7]
set title "A bicubic patch, 2^k x 2^k leaves, k = 1 to 7 (dashed: folded)"
plot for [i in "1 2 5"] rows("patch", "gentle", word(p, i + 0)) u 5:7 w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(p, i + 0), \
     for [i in "1 2 5"] rows("patch", "folded", word(p, i + 0)) u 5:7 w lp lw 1 dt 2 lc rgb tint(i) pt mark(i) notitle, \
     some("patch", "gentle", "two triangles", "1 2 3 4 5 6 7") u 5:7:4 w labels offset 1.2,-.6 font "sans,10" notitle
@shares
set title "The same, rays off by 1 % of the size or miscounted"
plot for [i in "1 2 5"] rows("patch", "gentle", word(p, i + 0)) u 5:(wrong($6)) w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(p, i + 0), \
     for [i in "1 2 5"] rows("patch", "folded", word(p, i + 0)) u 5:(wrong($6)) w lp lw 1 dt 2 lc rgb tint(i) pt mark(i) notitle, \
     some("patch", "gentle", "two triangles", "1 2 3 4 5 6") u 5:(wrong($6)):4 w labels offset 1.2,-.6 font "sans,10" notitle

s = "'inside tests' 'not drawn' intervals 'not drawn' lambert"
set xrange [5e4:4e7]
set title "A box less 1 to 256 pockets that share its face"
plot for [i in "1 3 5"] rows("csg", "pockets", word(s, i + 0)) u 5:(wrong($6)) w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(s, i + 0), \
     for [k in "lambert intervals 'inside tests'"] some("csg", "pockets", k, "1 16 256") u 5:(wrong($6)):4 w labels offset 0,(k eq "lambert" ? -.8 : .7) font "sans,10" notitle

w = "gyroid torus 'thin shell'"
set xrange [1e4:4e7]
set title "Isosurfaces: max_gradient 1/16 to 1 of enough (discs: lambert)"
plot for [i=1:3] rows("isosurface", word(w, i), "sampling, accuracy 1e-3") u 5:(wrong($6)) w lp lw 1.5 lc rgb color[2*i-1] pt i t word(w, i), \
     for [i=1:3] rows("isosurface", word(w, i), "lambert") u 5:(wrong($6)) w p pt 7 ps 1.4 lc rgb color[2*i-1] notitle
@errors
set xrange [1e4:1e6]
set title "Isosurfaces: enough max_gradient, accuracy 1e-3 to 1e-6 (discs: lambert)"
safe(set) = sprintf("< awk -F'\\t' '$1==\"isosurface\" && $2==\"%s\" && $4==1 && $3!=\"lambert\"' %s", set, data)
plot for [i=1:3] safe(word(w, i)) u 5:7 w lp lw 1.5 lc rgb color[2*i-1] pt i t word(w, i), \
     for [i=1:3] rows("isosurface", word(w, i), "lambert") u 5:7 w p pt 7 ps 1.4 lc rgb color[2*i-1] notitle
set title "A box less n balls: no method is wrong"
set xlabel "n"
set ylabel "rays a second"
set xrange [.7:1500]
set yrange [5e4:4e7]
set format y "%.0s%c"
set format x "%g"
plot for [i in "1 3 5"] rows("csg", "drilled", word(s, i + 0)) u 4:5 w lp lw 1.5 lc rgb tint(i) pt mark(i) t word(s, i + 0)
unset multiplot
