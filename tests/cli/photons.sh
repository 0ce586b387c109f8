#!/bin/sh
# Photons in files: photons { save_file load_file }.
. "${top_srcdir:-.}/tests/cli/common.sh"

cat >lens.pov <<'EOF'
#version 3.7;
global_settings {
  assumed_gamma 1
  photons { spacing .06 media 10 #ifdef (Save) save_file "kept.ph" #end #ifdef (Load) load_file Load #end }
}
camera { location <0, 3, -5> look_at 0 angle Angle }
light_source { <3, 6, -3>, 1.2 photons { refraction on reflection on } }
sphere { <0, .8, 0>, .7 pigment { rgbf 1 } interior { ior 1.5 } photons { target refraction on reflection on } }
plane { y, 0 pigment { rgb .9 } }
box { -9, 9 hollow pigment { rgbt 1 } interior { media { scattering { 1, .02 } } } }
EOF
render() { exits 0 "$lambert" lens.pov +W24 +H18 -q +FP Declare=Angle=40 "$@"; }
check "photons are shot" render -o shot.ppm
saved() { render -o saved.ppm Declare=Save=1 && test -s kept.ph && cmp -s shot.ppm saved.ppm; }
check "and saved" saved
loaded() { render -o loaded.ppm 'Declare=Load="kept.ph"' && cmp -s shot.ppm loaded.ppm; }
check "read, they make the same picture" loaded
emptied() {
  head -c 12 kept.ph >none.ph && head -c 8 /dev/zero >>none.ph &&
    render -o none.ppm 'Declare=Load="none.ph"' && ! cmp -s shot.ppm none.ppm
}
check "a file without photons brings no light" emptied
other() {
  exits 0 "$lambert" lens.pov +W24 +H18 -q +FP Declare=Angle=20 -o near.ppm &&
    exits 0 "$lambert" lens.pov +W24 +H18 -q +FP Declare=Angle=20 'Declare=Load="kept.ph"' -o near2.ppm && cmp -s near.ppm near2.ppm
}
check "another camera uses them" other
refuses() { exits "$1" "$lambert" lens.pov +W8 +H6 Declare=Angle=40 "$2" && has err "$3"; }
head -c 1000 kept.ph >cut.ph
check "a file cut short is refused" refuses 66 'Declare=Load="cut.ph"' "cannot use 'cut.ph': it is cut off or damaged"
check "another file, too" refuses 66 'Declare=Load="lens.pov"' "cannot use 'lens.pov': it holds no photons"
check "one that is missing has its place" refuses 1 'Declare=Load="no.ph"' "the file of photons 'no.ph' was not found"
sed -i 's,kept.ph,/kept.ph,' lens.pov
check "scenes write no files elsewhere" refuses 1 Declare=Save=1 "is neither in"
finish
