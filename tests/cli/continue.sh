#!/bin/sh
# +C: an interrupted picture goes on where it stopped and is the same in the end.
. "${top_srcdir:-.}/tests/cli/common.sh"
# A picture that takes much longer than its first tiles and a look at them.
set -- sphere.pov +W480 +H480 +A0.0 +R12 +WT2 --tile-size 16
state=a.png.lambert-state

stop_midway()
{
  "$lambert" "$@" 2>err &
  pid=$!
  for _ in $(seq 250); do
    test -s $state && test "$(wc -c <$state)" -gt 20000 && break
    sleep 0.02
  done
  kill -INT $pid
  wait $pid
  test $? = 2 && has err 'continue goes on from here' && test -s $state
}
"$lambert" "$@" -q -o whole.png
check "a whole picture leaves no state" test ! -e whole.png.lambert-state
check "stopped with a state" stop_midway "$@" +C -o a.png
cp $state kept
cp a.png part.png
tiles() { sed -n 's/.*"tiles_done":\([0-9]*\),.*/\1/p' out; }
pixels() { sed -n 's/.*"pixels":\([0-9]*\),.*/\1/p' out; }
resumed()
{
  exits 0 "$lambert" "$@" +C --stats=json -o a.png && test "$(tiles)" = 900 &&
    test "$(pixels)" -lt 230400
}
check "only the missing tiles are rendered" resumed "$@"
check "the same bytes" cmp a.png whole.png
check "the state is gone" test ! -e $state

done_already() { exits 0 "$lambert" "$@" +C -o a.png && has err 'is there already'; }
check "a finished picture is left alone" done_already "$@"

again() { cp part.png a.png; head -c "$1" kept >$state; shift; exits 0 "$lambert" "$@" +C -q -o a.png && cmp a.png whole.png; }
check "a state cut short" again 12345 "$@"
check "a state cut in its header" again 20 "$@"
broken()
{
  cp part.png a.png
  cp kept $state
  printf 'xxxx' | dd of=$state bs=1 seek=9000 conv=notrunc 2>/dev/null
  exits 0 "$lambert" "$@" +C -q -o a.png && cmp a.png whole.png
}
check "a damaged state" broken "$@"

other()
{
  cp part.png a.png
  cp kept $state
  exits 0 "$lambert" "$@" && has err 'was kept for another scene or other settings' &&
    test ! -e $state
}
check "other settings begin anew" other "$@" +C -o a.png +R4
sed 's/0.25/0.26/' sphere.pov >changed && mv changed sphere.pov
check "another scene begins anew" other "$@" +C -o a.png
printf 'P2 2 1 255 0 255\n' >im.pgm
echo 'sphere { 0, 1 pigment { image_map { pgm "im.pgm" } } }' >>sphere.pov
rm -f a.png
check "stopped with an image" stop_midway "$@" +C -o a.png
printf 'P2 2 1 255 9 255\n' >im.pgm
mv $state kept
check "another image begins anew" other "$@" +C -o a.png
# How far it is when it is told to stop depends on the machine: later, until a tile is done, in
# steps that are short beside the time from the first tile to the last.
unasked()
{
  "$lambert" "$@" -q -o whole.png || return 1
  rm -f a.png $state
  for delay in 0.03 0.05 0.07 0.1 0.15 0.2 0.3 0.4 0.6 0.8 1.2 1.6; do
    "$lambert" "$@" -o a.png 2>err &
    pid=$!
    sleep $delay
    kill -INT $pid
    wait $pid
    test -s $state && break
  done
  has err 'continue goes on from here' && exits 0 "$lambert" "$@" +C -q -o a.png &&
    cmp a.png whole.png && test ! -e $state
}
check "an interrupted picture goes on that was begun without +C" unasked "$@"
stale()
{
  cp kept $state
  exits 0 "$lambert" "$@" -q -o a.png && test ! -e $state
}
check "a whole picture leaves no old state" stale "$@"
# reads_slowly COMMAND...: runs it while `lambert` reads the scene "$@" from a pipe, once it has
# looked at where the picture goes: what it reads is more than a pipe holds.
mkfifo pipe
mkdir refuge
reads_slowly()
{
  during=$1
  shift
  TMPDIR=$place "$lambert" - "$@" -q <pipe >out 2>err &
  pid=$!
  {
    cat sphere.pov
    yes '// to fill the pipe' | head -n 20000
    $during
  } >pipe
  wait $pid
}
lost() { rm -rf away; }
taken_in()
{
  mkdir away
  place=$work/refuge
  reads_slowly lost +W8 +H8 -o away/p.png
  test $? = 73 && has err "No such file.*the picture is in '$work/refuge/lambert-[0-9]*-p.png'" &&
    exits 0 "$lambert" sphere.pov +W8 +H8 -q -o p.png && cmp p.png refuge/lambert-*-p.png
}
check "a picture that cannot be written where it should is kept elsewhere" taken_in
in_the_way() { mkdir -p q.png/q; }
kept_on()
{
  place=/nonexistent
  reads_slowly in_the_way +W8 +H8 +C -o q.png
  test $? = 73 && has err "cannot write 'q.png'" && test -s q.png.lambert-state && rm -r q.png &&
    exits 0 "$lambert" - +W8 +H8 +C -q -o q.png <sphere.pov && cmp p.png q.png
}
check "nowhere: its state is" kept_on
check "standard output keeps nothing" exits 0 "$lambert" sphere.pov +W8 +H8 +C -o -
frames()
{
  "$lambert" sphere.pov +W8 +H8 -q +KFF3 -o f && rm f2.png &&
    exits 0 "$lambert" sphere.pov +W8 +H8 +C +KFF3 -o f && test -s f2.png &&
    test "$(grep -c 'is there already' err)" = 2
}
check "frames that are there are left out" frames
finish
