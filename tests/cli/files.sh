#!/bin/sh
# Where pictures go, exit codes, standard input and output, comparison.
. "${top_srcdir:-.}/tests/cli/common.sh"
small='+W32 +H24 -q'

made() { rm -f "$1" && want=$1 && shift && exits 0 "$lambert" $small "$@" && test -s "$want"; }
check "named after the scene" made sphere.png sphere.pov
mkdir sub
cp sphere.pov sub/lone.pov
check "beside the scene, wherever that is" made sub/lone.png sub/lone.pov
check "a name that is given is in the working folder" made named.png sub/lone.pov +Onamed
check "the extension is added" made x.png sphere.pov -o x
check "type from the name" made x.exr sphere.pov -o x.exr
check "another extension stays" made x.5.png sphere.pov +Ox.5
check "type from the switch" made x.png.ppm sphere.pov +FP +Ox.png
check "with more bits than there are" made x.png.ppm sphere.pov +FP90 +Ox.png
mkdir d
check "a folder" made d/sphere.png sphere.pov -o d
check "scene without .pov" made sphere.png sphere
check "frames are numbered" made sphere03.png sphere.pov +KFI3 +KFF10 +SF3 +EF3
to_stdout() { exits 0 "$lambert" $small - -o - +FP <sphere.pov && size_ppm out 32 24; }
check "standard input to standard output" to_stdout
nothing() { rm -f sphere.png; exits 0 "$lambert" $small sphere.pov -F && test ! -e sphere.png; }
check "-F writes nothing" nothing

check "no scene" exits 64 "$lambert"
check "missing scene" exits 66 "$lambert" nowhere.pov
check "missing INI file" exits 66 "$lambert" nowhere.ini
check "folder that is not there" exits 73 "$lambert" sphere.pov -o nowhere/x.png
check "a file type that is only read" exits 64 "$lambert" sphere.pov -o x.gif
echo 'sphere { 0, 1 pigmnt { rgb 1 } }' >bad.pov
gcc_style() { exits 1 "$lambert" bad.pov --diagnostics=gcc && has err '^bad.pov:1:[0-9]*: error: '; }
check "errors of the scene" gcc_style
check "no picture then" test ! -e bad.png
json_style() { exits 1 "$lambert" bad.pov --diagnostics=json && has err '"line":1'; }
check "errors as JSON" json_style

same() { exits 0 "$lambert" compare a.png b.png && has out 'off by more than 8/255: 0.000 %'; }
"$lambert" $small sphere.pov -o a.png
"$lambert" $small sphere.pov -o b.png +WT2
check "threads do not change the bytes" cmp a.png b.png
check "equal pictures" same
"$lambert" $small sphere.pov -o c.png +Q0
differ() { exits 1 "$lambert" compare a.png c.png --out heat && test -s heat/heat.png; }
check "different pictures, with a heat map" differ
check "tolerance" exits 0 "$lambert" compare a.png c.png --tolerance 100
gone() { exits 66 "$lambert" compare a.png nowhere.png && test "$(cat err)" = "lambert: cannot read 'nowhere.png': No such file or directory"; }
check "a picture that is missing" gone
full() { "$lambert" -q sphere.pov +W9 +H6 -o - >/dev/full 2>err; test $? = 74 && has err 'cannot write standard output: No space left'; }
check "standard output that is full" full
# Every type by its letter, its name and from the name; the light of HDR is the same picture.
types()
{
  for pair in N:png E:exr P:ppm J:jpg T:tga C:tga B:bmp H:hdr; do
    letter=${pair%:*} word=${pair#*:}
    rm -f t.* u.*
    exits 0 "$lambert" $small sphere.pov +F$letter +Ot && test -s t.$word || return 1
    exits 0 "$lambert" $small sphere.pov -o u.$word || return 1
    test $letter = C || cmp t.$word u.$word || return 1
    exits 0 "$lambert" compare a.png t.$word --tolerance 0 --threshold 25 || return 1
    printf 'Output_File_Type=%s\nOutput_File_Name=i\n' $letter >t.ini
    exits 0 "$lambert" $small t.ini sphere.pov && cmp i.$word t.$word || return 1
  done
}
check "file types" types
stats() { exits 0 "$lambert" $small sphere.pov --stats=json && has out '^{"v":1,.*"pixels":768,.*}$'; }
check "counts as JSON" stats
piped_stats() { exits 0 "$lambert" -q $small sphere.pov --stats=json -o - && cmp out a.png && has err '^{"v":1,'; }
# The order in which tiles are done, which threads leave to chance, is not counted.
counts() { "$lambert" -q +W200 +H150 +A sphere.pov --stats=json -o all.png "$@" | grep -o '"samples":[0-9]*,"rays":[0-9]*,"shadow_rays":[0-9]*'; }
same_counts()
{
  counts +WT1 >one.counts && test -s one.counts || return
  for _ in 1 2 3 4 5; do
    counts +WT4 | cmp -s - one.counts || return
  done
}
check "counts do not depend on threads" same_counts
check "counts beside a picture on standard output" piped_stats
unnamed() { rm -f sphere.png && exits 0 "$lambert" -q $small sphere.pov -o "" && test -s sphere.png && test ! -e .png; }
check "an empty name is none" unnamed

# lambert is its own reference here.
side_by_side()
{
  cp sphere.pov "a&b.pov"
  exits 1 "$lambert" compare $small sphere.pov "a&b.pov" nowhere.pov --out page \
    --reference "$lambert" && has out '2 match, 1 not rendered' &&
    has page/index.html 'a&amp;b.pov' && has page/index.html 'src="a%26b.reference.png"' &&
    has page/index.html 'nowhere.pov<br>No such file' &&
    test -s page/sphere.reference.png && test -s "page/a&b.heat.png"
}
check "scenes side by side" side_by_side
no_program() { exits 1 "$lambert" compare $small sphere.pov --out page --reference ./nowhere && has out 'sphere.pov: there is no such program'; }
check "a reference that is no program" no_program
no_reference()
{
  printf '#!/bin/sh\necho "Parse Error: no fun"\nexit 1\n' >fails && chmod +x fails &&
    exits 1 "$lambert" compare $small sphere.pov --out page --reference "$PWD/fails" && has out 'sphere.pov: no fun'
}
check "a reference that fails says why" no_reference
part() { exits 0 "$lambert" $small sphere.pov +SC9 +EC16 +SR0.5 +FP -o part.ppm && size_ppm part.ppm 32 24; }
check "a part keeps the size" part
check "a part beyond the end" exits 64 "$lambert" $small sphere.pov +SC20 +EC10
finish
