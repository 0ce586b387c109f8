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
bad_switch() { exits 64 "$lambert" sphere.pov +Zx && has err "+Zx"; }
check "an unknown switch is named" bad_switch
check "+A.3 is an error" exits 64 "$lambert" sphere.pov +A.3
check "+A0 is an error" exits 64 "$lambert" sphere.pov +A0
check "+A0.3 is not" exits 0 "$lambert" sphere.pov +W8 +H6 +A0.3 +AM2 +R2 -J -q
check "a bad number is an error" exits 64 "$lambert" sphere.pov --width banana
check "out of range is an error" exits 64 "$lambert" sphere.pov +W0
check "a missing value is an error" exits 64 "$lambert" sphere.pov --width
quiet() { exits 0 "$lambert" sphere.pov +W8 +H6 "$@" && test ! -s err; }
check "what means nothing here is taken in silence" \
  quiet -q -D -P +V +SP8 +EP2 +MB10 -UR +BM2 +WL5 Display=on Pause_When_Done=on -GA
warned() { exits 0 "$lambert" sphere.pov +W8 +H6 -q +UF && has err 'not built'; }
check "what is not built is said" warned

printf '; a comment\nWidth=20\nHeight = 10 ; more\n+Q3 -D\n[big]\nWidth=200\n[tiny]\nWidth=2\n' >t.ini
want='20 10' check "an INI file" size t.ini
want='200 10' check "a section of it" size 't.ini[BIG]'
want='30 10' check "the line after the INI file wins" size t.ini +W30
want='20 11' check "the INI file after the line wins" size +W30 t.ini +H11
povini() { POVINI=t.ini size "$@"; }
want='20 10' check "POVINI" povini
echo 'Widht=3' >bad.ini
bad_ini() { exits 64 "$lambert" sphere.pov bad.ini && has err 'bad.ini:1'; }
check "a bad keyword is placed" bad_ini

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
appended() {
  "$lambert" check talk.pov +GDsaid.txt +GP >out 2>err
  test "$(grep -c said said.txt)" = 2
}
check "Append_File" appended
settings() {
  exits 0 "$lambert" sphere.pov +W20 +H10 -q -F +GIkept.ini 'Declare=Name="a b"' Declare=N=3 +A0.2 &&
    has kept.ini '^Width=20$' && has kept.ini "^Declare='Name=\"a b\"'$" &&
    has kept.ini '^Antialias_Threshold=0*.2$' &&
    exits 0 "$lambert" kept.ini +F -o again.ppm +FP && size_ppm again.ppm 20 10
}
check "Create_Ini can be read again" settings
finish
