#!/bin/sh
# Samples of POV-Ray's radiosity { } in files: +RF, +RFI, +RFO; nearest_count's second number.
. "${top_srcdir:-.}/tests/cli/common.sh"

cat >room.pov <<'EOF'
#version 3.7;
#ifndef (Nearest) #declare Nearest = 6; #end
#ifndef (Settled) #declare Settled = 0; #end
#ifndef (At) #declare At = 0; #end
global_settings { assumed_gamma 1
  radiosity { count 20 error_bound .6 nearest_count Nearest, Settled pretrace_start .08 pretrace_end .02 } }
camera { location <At, 1, -4> look_at <0, 1, 0> }
light_source { <0, 1.9, 0>, .6 }
box { <-2, 0, -5>, <2, 2, 2> inverse pigment { rgb <.9, .7, .5> } }
sphere { <-.7, .6, 0>, .6 pigment { rgb <.2, .4, .9> } }
EOF
render() { exits 0 "$lambert" room.pov +W64 +H48 +FP "$@"; }
# taken COUNT: samples of the last picture.
taken() { grep -q "^irradiance cache: $1 samples" err || { sed 's/^/# /' err; return 1; }; }
check "samples are taken" render -o taken.ppm
silent() { render -o quiet.ppm -q && ! test -s err && cmp taken.ppm quiet.ppm; }
check "-q says nothing of them" silent
saved() { render -o saved.ppm +RFlight.rca +RFO +WT1 && cmp taken.ppm saved.ppm && test -s light.rca; }
check "and written" saved
loaded() { render -o loaded.ppm +RFlight.rca +RFI +WT3 && cmp taken.ppm loaded.ppm && taken 0; }
check "the same picture needs no other ones" loaded
named() { render -o named.ppm Radiosity_File_Name=light.rca Radiosity_From_File=on && taken 0 && render -o named.ppm --gi-load=light.rca && taken 0 && cmp taken.ppm named.ppm; }
check "by keyword and long option, too" named
same_file() { render -o saved.ppm +RFagain.rca +RFO +WT4 && cmp light.rca again.rca; }
check "the file does not depend on threads" same_file
usual() { render -o saved.ppm +RFO && cmp light.rca object.rca; }
check "its name is POV-Ray's when none is given" usual
count() { sed -n 's/^irradiance cache: \([0-9]*\) samples.*/\1/p' err; }
other() {
  render -o far.ppm Declare=At=.3 && all=$(count) && render -o near.ppm Declare=At=.3 +RFlight.rca +RFI +WT1 && few=$(count) &&
    test "$few" -gt 0 && test $((2 * few)) -lt "$all" && has err "from a file" &&
    render -o near3.ppm Declare=At=.3 +RFlight.rca +RFI +WT3 && cmp near.ppm near3.ppm && ! cmp -s near.ppm far.ppm
}
check "another camera needs a few more" other
# An animation reads what it has written.
frames() {
  rm -f turn.rca && render -o turn.ppm +RFturn.rca +RFI +RFO +KFF3 +KI0 +KF.3 &&
    test "$(grep -c 'from a file' err)" = 2 && ! grep -q warning err
}
check "an animation hands them on" frames
missing() { render -o none.ppm +RFno.rca +RFI && cmp taken.ppm none.ppm && has err "warning: Radiosity_From_File: there is no file 'no.rca'"; }
check "a file that is missing is a warning, as POV-Ray goes on" missing
stale() { sed 's/1.9, 0>, .6/1.9, 0>, .3/' room.pov >dim.pov && exits 0 "$lambert" dim.pov +W64 +H48 +FP -o dim.ppm +RFlight.rca +RFI && has err "they show the light of then"; }
check "so are samples of another scene" stale
refuses() { exits 66 "$lambert" room.pov +W64 +H48 -o bad.ppm "+RF$1" +RFI && has err "cannot use '$1': $2" && test ! -e bad.ppm; }
head -c 3000 light.rca >cut.rca
check "a file cut short is refused" refuses cut.rca "it is cut off or damaged"
{ head -c 3000 light.rca && printf 'x' && tail -c +3002 light.rca; } >wrong.rca
check "and one with a wrong byte" refuses wrong.rca "it is cut off or damaged"
{ cat light.rca && printf 'x'; } >long.rca
check "and one that is too long" refuses long.rca "it is cut off or damaged"
check "and another file" refuses room.pov "it holds no radiosity samples"
unwritable() { exits 73 "$lambert" room.pov +W64 +H48 -o bad.ppm +RFno/light.rca +RFO && has err "cannot write 'no/light.rca'"; }
check "one that cannot be written is an error" unwritable
kept() { cp light.rca before && (ulimit -f 4; trap '' XFSZ; exec "$lambert" room.pov +W64 +H48 -F Declare=At=.2 +RFlight.rca +RFO >out 2>err); test $? = 73 && cmp before light.rca && ! ls light.rca.*; }
check "the old file stays when the new one is not whole" kept

settled() { render -o a.ppm Declare=Nearest=6 && all=$(count) && render -o b.ppm Declare=Nearest=6 Declare=Settled=1 +WT1 && few=$(count) &&
  test $((10 * few)) -lt $((9 * all)) && render -o c.ppm Declare=Nearest=6 Declare=Settled=1 +WT3 && cmp b.ppm c.ppm; }
check "where enough is known, fewer passes are made" settled
wrong() { exits 1 "$lambert" room.pov +W64 +H48 -F "Declare=Settled=$1" && has err "$2"; }
check "enough must be below nearest_count" wrong 6 "the second number of nearest_count must be at least 0 and below the first"
check "and not below 0" wrong -1 "nearest_count: -1 is not between 0 and 20"
finish
