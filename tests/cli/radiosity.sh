#!/bin/sh
# Radiosity from the command line and from the scene: settings, files, messages.
. "${top_srcdir:-.}/tests/cli/common.sh"

cat >room.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
#macro M(Rho, E) texture { pigment { rgb 1 } finish { ambient 0 diffuse Rho emission E } } #end
camera { location <.5, .5, .5> look_at <.5, .5, 1> }
difference { box { -1, 2 } box { 0, 1 } M(.5, .25) }
END
sed 's/^global_settings.*/&\n#ifdef(lambert) #declare lambert_gi = "radiosity";\n#declare lambert_gi_patches = 24; #end/' \
  room.pov >asks.pov
sed 's/gi_patches = 24/gi_patches = "many"/' asks.pov >wrong.pov

render() { exits 0 "$lambert" "$@" +W8 +H8 +FP --bits=16 File_Gamma=1.0; }
# The first sample of the picture in 1/65535.
first() { tail -c 384 "$1" | od -An -N2 -tu1 | awk '{print 256 * $1 + $2}'; }
dark() { render room.pov -o dark.ppm -q && test "$(first dark.ppm)" = 16384; }
check "without it the walls have what they give off" dark
solved() { render room.pov -o lit.ppm --gi=radiosity --gi-patches=24 && has err 'radiosity: .* patches, analytic, gauss-seidel' &&
  value=$(first lit.ppm) && test "$value" -gt 32440 && test "$value" -lt 33096; }
check "with it twice as much, and the report says how" solved
scene() { render asks.pov -o scene.ppm && cmp -s lit.ppm scene.ppm; }
check "the scene may ask for it" scene
line() { render asks.pov -o off.ppm --gi=none && cmp -s dark.ppm off.ppm; }
check "the command line wins over the scene" line
ini() { printf 'GI=radiosity\nGI_Patches=24\n' >gi.ini && render room.pov gi.ini -o ini.ppm && cmp -s lit.ppm ini.ppm; }
check "an INI file may ask for it" ini
wrong() { exits 64 "$lambert" wrong.pov +W8 +H8 && has err "'many' is no value for --gi-patches"; }
check "a wrong value in the scene is an error" wrong
threads() { render asks.pov -o one.ppm +WT1 --gi-solver=stochastic --gi-rays=20000 && render asks.pov -o two.ppm +WT3 --gi-solver=stochastic --gi-rays=20000 && cmp -s one.ppm two.ppm; }
check "the same picture for any number of threads" threads
cat >balls.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <.1, .2, .5> look_at <.5, .6, 1> }
default { finish { ambient 0 diffuse 1 } }
difference { box { -1, 2 } box { 0, 1 } pigment { checker rgb .8 rgb <.2, .5, .3> scale .2 } }
sphere { <.5, .6, .8>, .15 pigment { rgb <.9, .4, .2> } finish { diffuse .6 specular .4 reflection .3 } }
sphere { <.2, .3, .9>, .1 pigment { rgb 1 } finish { diffuse .8 emission 2 } }
light_source { <.2, .1, .3>, .5 }
END
quickly() { render balls.pov -o quick.ppm +W40 +H30 -q --gi=radiosity --gi-patches=60 --gi-solver=stochastic --gi-rays=20000 "$@" &&
  LAMBERT_SHADING=general render balls.pov -o general.ppm +W40 +H30 -q --gi=radiosity --gi-patches=60 --gi-solver=stochastic --gi-rays=20000 "$@" && cmp quick.ppm general.ppm; }
check "eight hits at a time give the bits of one at a time" quickly
check "also with a last gathering" quickly --gi-gather=16

cat room.pov - >clear.pov <<'END'
box { .1, <.9, .9, .45> pigment { rgbt 1 } hollow }
sphere { <.5, .5, .8>, .15 pigment { gradient x color_map { [0 rgbf 1] [1 rgbf <.2, .3, .4, 1>] } } finish { reflection 0 } hollow }
END
# A ball in the clear box is lit as the walls are: it has the value of the furnace all over.
cat room.pov - >inside.pov <<'END'
box { <.1, .1, .6>, .9 pigment { rgbt 1 } hollow }
sphere { <.5, .5, .8>, .18 M(.5, .25) }
END
sed -i 's/^camera.*/camera { orthographic location <.5, .5, .5> direction z up .1*y right .1*x }/' inside.pov
inside() { render inside.pov -o inside.ppm --gi=radiosity --gi-patches=400 && value=$(first inside.ppm) &&
  test "$value" -gt 32440 && test "$value" -lt 33096; }
check "what stands in something clear takes part" inside
clear() { render clear.pov -o clear.ppm --gi=radiosity --gi-patches=400 "$@" && has err 'radiosity: .* patches' &&
  value=$(first clear.ppm) && test "$value" -gt 32440 && test "$value" -lt 33096; }
check "what is clear does not stop light" clear
check "nor in a last gathering" clear --gi-gather=64
# Walls of radiosity .1 give .1 of their light to .2 units of a medium that scatters .5 of it a unit, in
# all directions alike (in the language's measure, four times the mean over the sphere), and loses nothing.
sed 's/M(.5, .25)/M(.5, .05) hollow/; s/look_at .*z*}/direction z up .1*y right .1*x }/; s/^camera {/& orthographic/' room.pov >smoke.pov
cat >>smoke.pov <<'END'
box { <.2, .2, .6>, <.8, .8, .8> pigment { rgbt 1 } hollow
  interior { media { scattering { 1, .5 extinction 0 } method 3 intervals 1 samples 3 } } }
END
smoke() { render smoke.pov -o smoke.ppm --gi=radiosity --gi-patches=100 "$@" && value=$(first smoke.ppm) &&
  test "$value" -gt 9043 && test "$value" -lt 9305; }
check "patches light media" smoke
check "also those of a solution that was saved" smoke --gi-save=smoke.rad
check "and is used again, by several threads" smoke --gi-load=smoke.rad +WT3
# A glowing ball is a lamp of its emission times (radius over distance) squared.
cat >glow.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -5> direction z up .1*y right .1*x }
sphere { <2, 0, 2.5>, .2 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 80 } }
box { -.1, .1 pigment { rgbt 1 } hollow interior { media { scattering { 1, 1 extinction 0 } method 3 intervals 1 samples 9 } } }
END
glow() { render glow.pov -o glow.ppm --gi=radiosity --gi-patches=200 && value=$(first glow.ppm) &&
  test "$value" -gt 3900 && test "$value" -lt 4270; }
check "what glows lights media as a lamp does" glow
# The ray and the way to the ball make an angle of cosine .774: phase functions of Mie (hazy, murky),
# Rayleigh, Henyey and Greenstein say how much more that is than a medium of all directions alike shows.
phases() {
  alike=$(first glow.ppm) || return 1
  for phase in '2 2.563' '3 1.028' '4 1.278' '5 2.258 eccentricity .6'; do
    set -- $phase
    sed "s/scattering { 1, 1/scattering { $1, 1 $3 $4/" glow.pov >phase.pov
    render phase.pov -o phase.ppm --gi=radiosity --gi-patches=200 || return 1
    echo "$(first phase.ppm) $alike $2" | awk '{ q = $1 / $2 / $3; exit !(q > .97 && q < 1.03) }' ||
      { echo "$phase: $(first phase.ppm) of $alike"; return 1; }
  done
}
check "by each phase function" phases
cat room.pov - >unlit.pov <<'END'
global_settings { mm_per_unit 10 subsurface { samples 10, 10 } }
sphere { <.5, .5, .8>, .1 pigment { rgbt 1 } hollow interior { media { scattering { 1, .1 } } } }
sphere { <.2, .5, .8>, .1 pigment { rgb 1 } finish { subsurface { translucency .1 } } }
END
unlit() { render unlit.pov -o unlit.ppm --gi=radiosity --gi-patches=24 && has err 'unlit.pov:7:1: warning: media: with --gi=radiosity' &&
  has err 'unlit.pov:8:1: warning: subsurface: with --gi=radiosity' && test "$(grep -c 'with --gi=radiosity' err)" = 2 &&
  render unlit.pov -o unlit.ppm --gi=none && ! has err 'with --gi=radiosity'; }
check "what patches do not light is said, and where" unlit

save() { render asks.pov -o saved.ppm --gi-save=room.rad && cmp -s lit.ppm saved.ppm; }
check "a solution is saved" save
load() { render asks.pov -o loaded.ppm --gi-load=room.rad && has err 'read from a file' && cmp -s lit.ppm loaded.ppm; }
check "and used again" load
named() { rm -f pov.rad; render asks.pov -o named.ppm +RFpov.rad +RFI +RFO && has err 'analytic' && cmp -s lit.ppm named.ppm && test -s pov.rad &&
  render asks.pov -o again.ppm +RFpov.rad +RFI && has err 'read from a file' && cmp -s lit.ppm again.ppm; }
check "POV-Ray's switches for it do the same" named
sed 's/look_at <.5, .5, 1>/look_at <.5, 1, .6>/' asks.pov >turned.pov
turned() { render turned.pov -o turned.ppm --gi-load=room.rad && value=$(first turned.ppm) && test "$value" -gt 32440; }
check "also by another camera" turned
sed 's/M(.5, .25)/M(.5, .3)/' asks.pov >brighter.pov
other() { exits 66 "$lambert" brighter.pov +W8 +H8 --gi-load=room.rad && has err 'another scene'; }
check "not by another scene" other
head -c 500 room.rad >cut.rad
cut_off() { exits 66 "$lambert" asks.pov +W8 +H8 --gi-load=cut.rad && has err 'cut off'; }
check "a damaged file is refused" cut_off
echo precious >kept.rad
nowhere() { exits 73 "$lambert" asks.pov +W8 +H8 --gi-save=no/such/folder/room.rad && has err 'cannot write'; }
check "a file that cannot be written is said" nowhere

ply() { render asks.pov -o p.ppm --gi-ply=room.ply && has room.ply '^element face' && has room.ply '^property float red'; }
check "patches as polygons" ply
aov() { render asks.pov -o p.ppm --gi-aov=room.exr && test -s room.exr; }
check "patches as a picture" aov
method() { render asks.pov -o m.ppm --gi-emitters=mesh --gi-method="$1" --gi-solver="$2" --gi-factor-rays=64 --gi-resolution=32 --gi-tolerance=.05 &&
  value=$(first m.ppm) && test "$value" -gt 30000 && test "$value" -lt 35500; }
for m in analytic area disc hemicube rays sobol; do
  check "form factors by $m" method $m gauss-seidel
done
for s in elimination jacobi gauss-seidel shooting cg stochastic hierarchical; do
  check "solved by $s" method analytic $s
done
gather() { render asks.pov -o g.ppm --gi-gather=16 && ! cmp -s lit.ppm g.ppm; }
check "a final gathering" gather
unasked() { render room.pov -o u.ppm --gi-save=u.sol && has err 'warning: --gi-save: the scene has no radiosity' && test ! -e u.sol; }
check "a file of light that nobody asks for" unasked
target() { render asks.pov -o e.ppm --error=10% && has err 'error about'; }
check "an error target" target
bad_target() { exits 64 "$lambert" asks.pov +W8 +H8 --error=much && has err "'much' is no value for --error"; }
check "a bad error target" bad_target
memory() { exits 1 "$lambert" asks.pov +W8 +H8 --gi-patches=600 --gi-solver=elimination --gi-memory=1 && has err "'stochastic'"; }
check "what does not fit says what does" memory
finish
