#!/bin/sh
# Options in their three spellings, their order, and what is said of wrong ones.
. "${top_srcdir:-.}/tests/cli/common.sh"

size() { exits 0 "$lambert" sphere.pov -q +FP -o s.ppm "$@" && size_ppm s.ppm $want; }
want='160 120' check "default size" size
want='40 30' check "switches" size +W40 -h30
want='40 30' check "long options" size --width 40 --height=30
want='40 30' check "keywords" size Width=40 height=30
want='41 30' check "the last one wins" size +W40 --height 30 width=41

unknown() { exits 64 "$lambert" sphere.pov --widht 3 && has err "did you mean '--width'"; }
check "an unknown option is named, with a suggestion" unknown
says() { exits 64 "$lambert" sphere.pov +W8 +H6 "$1" && has err "$2"; }
check "so is an unknown keyword" says Widht=3 "'Widht' is no INI keyword; did you mean 'Width'?"
check "in any case" says output_file_nam=x "did you mean 'Output_File_Name'?"
check "a switch without its value is told so" says +W "'+W' needs a value right behind it: +WN"
check "a wrong value is shown where it was written" says +W16x12 "in '+W16x12'"
folder() { exits 73 "$lambert" sphere.pov +W8 +H6 -o none/s.png && has err "cannot write 'none/s.png': No such file or directory"; }
check "a folder that is missing is the reason given" folder
declares() { exits 0 "$lambert" sphere.pov +W8 +H6 -F -q "Declare=$1" && if [ "$2" ]; then has err "warning: Declare=$1$2"; else ! test -s err; fi; }
check "a declaration without a value is a warning" declares A " declares nothing; it is written Declare=NAME=NUMBER"
check "and one of no number" declares A=x ": 'x' is no number"
check "and one of no name" declares 3=4 " declares nothing"
check "numbers are none" declares A=-1.5e3 ""
check "nor are strings" declares 'A_1="x y"' ""
bad_switch() { exits 64 "$lambert" sphere.pov +Zx && has err "+Zx"; }
check "an unknown switch is named" bad_switch
check "+A.3 is an error" exits 64 "$lambert" sphere.pov +A.3
check "+A0 is an error" exits 64 "$lambert" sphere.pov +A0
check "+A0.3 is not" exits 0 "$lambert" sphere.pov +W8 +H6 +A0.3 +AM2 +R2 -J -q
same() { exits 0 "$lambert" sphere.pov +W24 +H18 +A0.1 -q +FP -o a.ppm $1 && exits 0 "$lambert" sphere.pov +W24 +H18 +A0.1 -q +FP -o b.ppm $2 && has err "$3" && cmp a.ppm b.ppm; }
check "a number out of range is the nearest in it, as in POV-Ray" same +AM2 +AM3 "warning: Sampling_Method=3 is taken as 2: the range is 0 to 2"
check "the same of depths" same +R9 Antialias_Depth=12 "Antialias_Depth=12 is taken as 9"
check "the same of bits" same +FP16 +FP99 "Bits_Per_Color=99 is taken as 32"
check "the same of quality" same +Q0 +Q-1 "Quality=-1 is taken as 0"
check "the same of jitter" same +J1 +J2 "Jitter_Amount=2 is taken as 1"
no_method() { exits 0 "$lambert" sphere.pov +W24 +H18 -A -q +FP -o a.ppm && exits 0 "$lambert" sphere.pov +W24 +H18 +A0.1 +AM0 -q +FP -o b.ppm && test ! -s err && cmp a.ppm b.ppm; }
check "+AM0 is no antialiasing, as in POV-Ray" no_method
werror() { exits 1 "$lambert" sphere.pov +W8 +H6 +Q12 --werror; }
check "it is a warning" werror
check "a long option out of range is an error" exits 64 "$lambert" sphere.pov --quality=12
check "a bad number is an error" exits 64 "$lambert" sphere.pov --width banana
check "out of range is an error" exits 64 "$lambert" sphere.pov +W0
check "a missing value is an error" exits 64 "$lambert" sphere.pov --width
quiet() { exits 0 "$lambert" sphere.pov +W8 +H6 "$@" && test ! -s err; }
check "what means nothing here is taken in silence" \
  quiet -q -D -P +V +SP8 +EP2 +MB10 -UR +BM2 +WL5 Display=on Pause_When_Done=on -GA \
  Histogram_Name=a.csv Histogram_Type=C Histogram_Grid_Size=8.8
typed() { exits 0 "$lambert" sphere.pov +W8 +H6 -q -o plain.png "Output_File_Type=$1" && file_starts "$2" "$3"; }
file_starts() { head -c 4 "$1" | od -An -c | grep -q "$2"; }
check "bits behind the letter of a type mean nothing, as in POV-Ray" typed N16 plain.png 'P   N   G'
check "nor does a g" typed Ng8 plain.png 'P   N   G'
check "another word is no type" exits 64 "$lambert" sphere.pov +W8 +H6 Output_File_Type=Nx
fields() { exits 0 "$lambert" sphere.pov +W8 +H6 -q -o whole.png && exits 0 "$lambert" sphere.pov +W8 +H6 -q +UF +UO +RTR -o fields.png &&
  cmp whole.png fields.png && ! test -s err; }
check "field rendering changes nothing, as in POV-Ray 3.7" fields
cat >cameras.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -4*z look_at 0 }
camera { location <1, 0, -3> look_at 0 }
#ifdef(Third) camera { location <0, 2, -3> look_at 0 } #end
light_source { <2, 4, -5>, 1 }
sphere { 0, 1 pigment { gradient y scale 0.3 } }
END
sed '4,5d' cameras.pov >first.pov
sed '3d;5d' cameras.pov >second.pov
clockless() { exits 0 "$lambert" first.pov +W8 +H6 -q -o 1.png && exits 0 "$lambert" second.pov +W8 +H6 -q -o 2.png &&
  exits 0 "$lambert" cameras.pov +W8 +H6 -q +KLA -o still.png && ! test -s err && cmp 1.png still.png &&
  exits 0 "$lambert" cameras.pov +W8 +H6 -q Clockless_Animation=on +KFF3 -o turn.png && cmp 1.png turn1.png && cmp 2.png turn2.png && cmp 1.png turn3.png &&
  exits 0 "$lambert" cameras.pov +W8 +H6 -q -o last.png && cmp 2.png last.png; }
check "a clockless animation takes the cameras in turn" clockless

printf 'global_settings { assumed_gamma 1 }\n#macro M() #end\nM()\nsphere { 0, 1 }\n' >macro.pov
old_macros() { exits 0 "$lambert" macro.pov +W8 +H6 -q +MV3.1 -o 1.png &&
  exits 1 "$lambert" macro.pov +W8 +H6 -q +MV3.0 -o 1.png && grep -q 'macro.pov:2:1: error: .*E0115' err; }
check "a version from outside is the scene's first" old_macros

printf '; a comment\nWidth=20\nHeight = 10 ; more\n+Q3 -D\n[big]\nWidth=200\n[tiny]\nWidth=2\n' >t.ini
want='20 10' check "an INI file" size t.ini
want='200 10' check "a section of it" size 't.ini[BIG]'
want='30 10' check "the line after the INI file wins" size t.ini +W30
want='20 11' check "the INI file after the line wins" size +W30 t.ini +H11
no_section() { exits 0 "$lambert" sphere.pov 't.ini[huge]' +W4 +H3 -q -o a.png +GWwarned && has err "t.ini has no section \[huge\]; it has \[big\], \[tiny\]" && cmp err warned; }
check "a section that is not there is named, with those that are" no_section
no_switch() { exits 0 "$lambert" sphere.pov Antialias=maybe +W4 +H3 -o a.png +GAall && has err "'maybe' is no value for Antialias" && has all "'maybe' is no value"; }
check "a value that is neither on nor off is told" no_switch
no_folder() { exits 0 "$lambert" sphere.pov +Lnowhere +W4 +H3 -o a.png +GWwarned && has err "library path 'nowhere'" && has warned "library path 'nowhere'"; }
check "a library path that is not there is told, in the file for warnings, too" no_folder
povini() { POVINI=t.ini size "$@"; }
want='20 10' check "POVINI" povini
echo 'Widht=3' >bad.ini
bad_ini() { exits 64 "$lambert" sphere.pov bad.ini && has err 'bad.ini:1'; }
printf 'Width=abc\nHeight=4\nQuality=-3 +W5\nFoo=1\n' >worse.ini
worse_ini() { exits 64 "$lambert" sphere.pov worse.ini && has err 'worse.ini:1' && has err 'worse.ini:4' && ! has err 'worse.ini:2'; }
check "a bad keyword is placed" bad_ini
check "every bad line is told" worse_ini
mkdir folder.ini
folder_ini() { exits 66 "$lambert" sphere.pov folder.ini +W4 +H3 -q && has err "cannot read 'folder.ini'"; }
check "a folder is no INI file" folder_ini
echo 'sphere { 0, wrong }' >wrong.pov
no_header() { exits 1 "$lambert" wrong.pov +HInowhere.inc && has err '^--include-header:0:10: error: .nowhere.inc. was not found' && has err '^wrong.pov:1:13: error: .wrong. is not declared'; }
check "a header that is not there is told as such, and moves no place" no_header

check "--version" exits 0 "$lambert" --version
check "--help" exits 0 "$lambert" --help
every_option()
{
  "$lambert" --help=all >all && "$lambert" --man | sed 's/\\-/-/g' >man &&
    "$lambert" --completion=bash >completion && bash -n completion || return 1
  for o in $(grep -o -e ' --[a-z-]*' all | sort -u); do
    grep -q -e "$o" man && grep -q -e "$o" completion || {
      echo "# $o"
      return 1
    }
  done
}
check "help, manual and completion know the same options" every_option

# Every row of the table of options but the internal ones, by a name it has.
every_row()
{
  "$lambert" --man | sed 's/\\-/-/g' >man
  awk '/^OPTION\(/ {row = ""} {row = row $0} /\)$/ && row ~ /^OPTION/ {print row; row = ""}' \
    "$table" | grep -v '"internal"' | sed 's/^OPTION("\([^"]*\)"[^"]*.*/\1 &/' >rows
  test -s rows || return 1
  while read -r option row; do
    keyword=$(echo "$row" | grep -o '"[A-Z][A-Za-z_]*_*[A-Za-z]*"' | tr -d '"' | tr '\n' ' ')
    found=no
    for word in "--$option" $keyword; do
      grep -q -w -e "$word" man && grep -q -w -e "$word" all && found=yes
    done
    test $found = yes || {
      echo "# $option"
      return 1
    }
  done <rows
}
check "the manual and --help=all hold every row of the table" every_row
streams() {
  printf '#debug "said\\n"\n#warning "beware\\n"\nsphere { 0, Q }\n' >talk.pov
  "$lambert" check talk.pov +GDsaid.txt +GWwarned.txt +GFwrong.txt +GAall.txt >out 2>err
  test "$(cat said.txt)" = said && has warned.txt beware && has wrong.txt "'Q' is not declared" &&
    has all.txt said && has all.txt beware && ! grep -q beware wrong.txt
}
check "messages to files" streams
more_streams() {
  exits 0 "$lambert" sphere.pov -q +W8 +H6 +GRrender.txt +GSstat.txt && has render.txt 'sphere.png: 8 x 6' &&
    has stat.txt '^pixels 48,'
}
check "Render_File and Statistic_File" more_streams
usual_names() {
  printf '#debug "said\\n"\n#warning "beware\\n"\nsphere { 0, 1 }\n' >says.pov
  exits 0 "$lambert" check says.pov Debug_File=on All_File=True Warning_File=off && has debug.out said &&
    has alltext.out beware && ! test -e warning.out && ! test -e on
}
check "files that are only turned on have the names POV-Ray gives them" usual_names
silent() { exits 0 "$lambert" check says.pov "$1" && ! grep -q "$2" err && has err "$3"; }
check "Debug_Console" silent -GD said beware
check "Warning_Console" silent Warning_Console=off beware said
all_silent() { exits 0 "$lambert" check says.pov -GA && ! test -s err; }
check "All_Console" all_silent
appended() {
  "$lambert" check talk.pov +GDsaid.txt +GP >out 2>err
  test "$(grep -c said said.txt)" = 2
}
check "Append_File" appended
cat >ramp.pov <<'EOS'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z right 64*x up 48*y direction z }
plane { z, 0 pigment { gradient x color_map { [0 rgb 0.4] [1 rgb 0.5] } scale 64 translate -32*x }
  finish { ambient 1 diffuse 0 } }
EOS
# The mean of 5-bit samples against that of 16 bits; undithered it is further off in parts.
mean() { tail -c $((64 * 48 * 3 * $2)) "$1" | od -An -v -tu1 -w$((3 * $2)) |
  awk -v two=$2 '{ v = two == 2 ? $1*256 + $2 : $1; s += v } END { printf "%.5f\n", s/NR/(two == 2 ? 65535 : 31) }'; }
dithers() {
  exits 0 "$lambert" ramp.pov +W64 +H48 -q +FP16 -o fine.ppm File_Gamma=1 || return 1
  "$lambert" ramp.pov +W64 +H48 -q +FP5 -o plain.ppm File_Gamma=1
  for m in B2 B3 B4 D1 D2 FS; do
    exits 0 "$lambert" ramp.pov +W64 +H48 -q +FP5 +TH$m -o $m.ppm File_Gamma=1 &&
      exits 0 "$lambert" ramp.pov +W64 +H48 -q +FP5 +TH$m +WT2 +BS8 -o again.ppm File_Gamma=1 &&
      cmp $m.ppm again.ppm || return 1
    cmp -s $m.ppm plain.ppm && return 1
    echo "$(mean fine.ppm 2) $(mean $m.ppm 1)" | awk '{ exit !($1 - $2 < 0.003 && $2 - $1 < 0.003) }' || {
      echo "# $m: $(mean fine.ppm 2) $(mean $m.ppm 1)"
      return 1
    }
  done
}
check "dithering keeps the mean" dithers
check "no such method" exits 64 "$lambert" ramp.pov +THXX
settings() {
  exits 0 "$lambert" sphere.pov +W20 +H10 -q -F +GIkept.ini 'Declare=Name="a b"' Declare=N=3 +A0.2 &&
    has kept.ini '^Width=20$' && has kept.ini "^Declare='Name=\"a b\"'$" &&
    has kept.ini '^Antialias_Threshold=0*.2$' &&
    exits 0 "$lambert" kept.ini +F -o again.ppm +FP && size_ppm again.ppm 20 10
}
check "Create_Ini can be read again" settings
repeated()
{
  printf '#version 3.7;\ncamera { location -z }\n#warning "twice"\n#warning str(clock, 0, 1)\n' >warns.pov
  exits 0 "$lambert" warns.pov +KFF3 +W8 +H8 -q -o w.ppm && test "$(grep -c 'warning: twice' err)" = 1 &&
    test "$(grep -c 'warning: [01].[05]' err)" = 3 && test "$(grep -c assumed_gamma err)" = 1
}
check "warnings of an animation are said once" repeated
gammas()
{
  for wrong in x 1.8x 0 -2 ''; do
    exits 64 "$lambert" sphere.pov +W8 +H8 -o g.ppm "--file-gamma=$wrong" && has err 'it takes sRGB or a number above 0' || return 1
  done
  exits 0 "$lambert" sphere.pov +W8 +H8 -o g.ppm Display_Gamma=srgb File_Gamma=1.8
}
check "encodings are sRGB or a number" gammas
finish
