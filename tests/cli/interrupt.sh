#!/bin/sh
# SIGINT while rendering: what is done is written, exit code 2.
. "${top_srcdir:-.}/tests/cli/common.sh"

# Later on a slower machine: what has no tile yet leaves no picture.
interrupted()
{
  for delay in 1 2 4 8; do
    "$lambert" sphere.pov +W3000 +H3000 +A0.0 +R9 +WT1 --tile-size 16 -o big.png 2>err &
    pid=$!
    sleep $delay
    kill -INT $pid
    wait $pid
    test $? = 2 && has err 'interrupted' || return 1
    test -s big.png && return
    has err 'nothing is written' || return 1
  done
  return 1
}
check "interrupted" interrupted
whole() { ls | grep -q '\.part$' && return 1; exits 0 "$lambert" compare big.png big.png; }
check "the picture is a whole file" whole

# stops_soon SCENE: it renders for a second, and ends within twenty when told to.
stops_soon()
{
  "$lambert" "$1" +W64 +H64 +WT2 -o long.png 2>err &
  pid=$!
  sleep 1
  kill -INT $pid
  waited=0
  while kill -0 $pid 2>/dev/null && test $waited -lt 100; do
    sleep 0.2
    waited=$((waited + 1))
  done
  kill -KILL $pid 2>/dev/null && return 1
  wait $pid
  test $? = 2 && has err 'interrupted\|stopped on request'
}

# One ray takes a minute: each value of the function is a sum of 90,000.
for kind in 'isosurface { function { sum(k, 1, 90000, sin(k*x)/k) + y }' \
  'isosurface { function { P(x, y, z) - sum(k, 1, 90000, sin(k*x)/k) }' \
  'parametric { function { u } function { sum(k, 1, 90000, sin(k*u)/k) } function { v } <-1, -1>, <1, 1>'; do
  cat >long.pov <<END
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at 0 }
#declare P = function { pattern { granite } }
$kind pigment { rgb 1 } }
END
  check "interrupted within a ray: $kind" stops_soon long.pov
done

# One sample takes hours: each of its rays wants its own samples.
cat >deep.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 1600 recursion_limit 6 error_bound 1e-3 nearest_count 20 } }
camera { location <0, 0, -4> look_at 0 }
sphere { 0, 100 inverse pigment { rgb 1 } }
sphere { 0, 1 pigment { rgb 1 } finish { ambient 0 } }
END
check "interrupted within a sample of radiosity { }" stops_soon deep.pov

# One ray takes minutes: 25,000 samples, each of which asks 289 times for a lamp.
cat >smoke.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -7> look_at 0 }
light_source { <5, 5, -5> 1 area_light x, y, 17, 17 }
media { scattering { 2, 0.1 } samples 500, 500 intervals 50 }
sphere { 0, 1 pigment { rgb 1 } }
END
check "interrupted within a medium" stops_soon smoke.pov

# One pixel has 100,000 samples, each of which sends on as many rays as it may.
cat >lens.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 100 adc_bailout 0 }
camera { location <0, 3, -7> look_at 0 aperture 2 focal_point 0 blur_samples 100000 variance 0 }
light_source { <5, 5, -5> 1 }
union {
  #for (I, -3, 3) sphere { x*I*0.7, 1 } #end
  pigment { rgbt <1, 0.5, 0.5, 0.9> } finish { reflection 0.9 } interior { ior 1.3 }
}
END
check "interrupted within the samples of a lens" stops_soon lens.pov

echo '#declare I = 0; #while (I < 1) #declare J = I; #end' >endless.pov
reading()
{
  "$lambert" endless.pov -o endless.png 2>err &
  pid=$!
  sleep 1
  kill -INT $pid
  wait $pid
  test $? = 2 && has err 'interrupted while reading' && ! test -e endless.png
}
check "interrupted while reading" reading

cat >room.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <.5, .5, .5> look_at <.5, .5, 1> }
difference { box { -1, 2 } box { 0, 1 } pigment { rgb 1 } finish { ambient 0 diffuse .5 emission .25 } }
END
# SIG: while form factors are computed, once the first tenth has been told.
solving()
{
  : >err # what the run before told must not be taken for this one's
  "$lambert" room.pov +W8 +H8 +WT1 --gi=radiosity --gi-patches=8000 --gi-solver=gauss-seidel -o room.png 2>err &
  pid=$!
  waited=0
  while ! grep -q 'radiosity: [1-9]0* %' err && test $waited -lt 300; do
    sleep 0.1
    waited=$((waited + 1))
  done
  kill -$1 $pid
  wait $pid
  test $? = 2 && has err 'radiosity: [1-9][0-9]* %' && has err 'before the first tile was done' && ! grep -q 'patches,' err && ! test -e room.png
}
check "radiosity is stopped before it is solved" solving INT
check "by SIGTERM too" solving TERM
cat >slow <<'END'
#!/bin/sh
echo $$ >slow.pid
exec sleep 100
END
chmod +x slow
alone()
{
  "$lambert" compare sphere.pov +W8 +H8 --out beside --reference "$work/slow" >out 2>err &
  pid=$!
  waited=0
  while ! slow=$(grep . slow.pid 2>/dev/null) && test $waited -lt 100; do
    sleep 0.1
    waited=$((waited + 1))
  done
  kill -INT $pid
  wait $pid
  test $? = 2 || return 1
  waited=0
  while test -n "$(tr -d '\0' </proc/$slow/cmdline 2>/dev/null)" && test $waited -lt 100; do
    sleep 0.1
    waited=$((waited + 1))
  done
  test $waited -lt 100 # one that nobody has waited for yet has no command line
}
if test "$(uname)" = Linux; then
  check "a comparison takes the other program with it" alone
fi
# --time-limit does the same in every part of the work.
out_of_time() # SCENE SECONDS: what a message says, other options
{
  scene=$1 seconds=$2 words=$3
  shift 3
  timeout 60 "$lambert" "$scene" "--time-limit=$seconds" "$@" 2>err
  test $? = 2 && has err "out of time.*$words"
}
echo '#while (1) #end' >endless.pov
cat >fine.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 1e-5 } }
camera { location <0, 0, -4> look_at 0 }
light_source { <3, 3, -5> rgb 1 }
box { -2, 2 pigment { rgbt 1 } interior { ior 1.4 } photons { target refraction on reflection on } }
plane { y, -3 pigment { rgb 1 } }
END
check "out of time while reading" out_of_time endless.pov 0.2 'while reading the scene'
check "out of time in photons" out_of_time fine.pov 0.5 'nothing is written' -o fine.png
check "out of time in samples" out_of_time deep.pov 0.5 'nothing is written' -o deep.png
check "no picture is left" test ! -e fine.png -a ! -e deep.png
# Later on a slower machine, as above.
timed_picture()
{
  for seconds in 1.5 6 24; do
    out_of_time sphere.pov $seconds 'tiles are done' +W3000 +H3000 +A0.0 +R9 +WT1 --tile-size 16 -o timed.png && return
    has err 'nothing is written' || return 1
  done
  return 1
}
check "out of time in the picture" timed_picture
check "which can be gone on with" test -s timed.png -a -s timed.png.lambert-state
# One tile takes longer than the limit. Later where the machine is slow, as above.
standstill()
{
  for seconds in 1 4 16; do
    out_of_time lens.pov $seconds 'before the first tile' +W64 +H64 --tile-size 64 +C -o still.png || return
    ! has err 'no tile was finished within --time-limit=[0-9]*; it takes more time or a smaller --tile-size' || return 0
  done
  return 1
}
check "why nothing comes of it is told" standstill
check "in time" exits 0 "$lambert" sphere.pov --time-limit=1000 +W16 +H12 -o timed.png
# narrow COLUMNS: no line of the progress is longer than a window of so many.
narrow()
{
  script -qec "stty cols $1; '$lambert' sphere.pov +W700 +H700 +A0.0 +AM1 +R4 -o wide.png --tile-size 8" /dev/null </dev/null >typescript || return
  tr '\r' '\n' <typescript | sed 's/\x1b\[K//g' | grep '%' >lines
  test -s lines && awk -v most="$1" 'length($0) >= most { bad = 1; print "# " $0 } END { exit bad }' lines
}
for columns in 100 45 20; do
  check "the progress fits into $columns columns" narrow $columns
done
finish
