#!/bin/sh
# Commands before and after pictures: only when allowed, what they are told, what their
# failure does.
. "${top_srcdir:-.}/tests/cli/common.sh"
cat >cmd.ini <<'EOS'
Input_File_Name=sphere.pov
Width=8
Height=6
Pre_Scene_Command=echo pre-scene %s %o %n %k %w %h %% %q >>log
Pre_Frame_Command=echo pre-frame %n %k >>log
Post_Frame_Command=test -s %o && echo post-frame %n >>log
Post_Scene_Command=echo post-scene %n >>log
User_Abort_Command=echo abort >>log
Fatal_Error_Command=echo fatal %s >>log
EOS
# runs CODE WANTED_LOG ARGUMENTS...: the log has the first two words of each line joined
runs()
{
  code=$1 wanted=$2
  shift 2
  rm -f log sphere*.png
  touch log
  exits "$code" "$lambert" cmd.ini -q "$@" || return 1
  got_log=$(cut -d' ' -f1,2 <log | sed 's/ sphere.pov//' | tr ' \n' ':,')
  test "$got_log" = "$wanted" && return
  echo "# $got_log, not $wanted"
  return 1
}
forbidden() { runs 0 "" && has err "'echo post-scene %n >>log' is not run; --allow-commands permits it" && test -s sphere.png; }
check "not allowed, said and left out" forbidden
echo 'allow-commands=on' >bad.ini
check "no INI file can allow them" exits 64 "$lambert" bad.ini sphere.pov
check "a single picture" runs 0 "pre-scene,pre-frame:1,post-frame:1,post-scene:1," --allow-commands
all="pre-scene,pre-frame:1,post-frame:1,pre-frame:2,post-frame:2,post-scene:2,"
check "frames" runs 0 "$all" --allow-commands +KFF2
check "expansions" has log '^pre-scene sphere.pov sphere1.png 1 0.000000 8 6 %% %q$'
check "the clock" has log '^pre-frame 2 1.000000$'

# fails WHERE ACTION CODE LOG
fails() { runs "$3" "$4" --allow-commands +KFF2 "$1_Command=false" "$1_Return=$2"; }
check "pre-scene, ignored" fails Pre_Scene I 0 "pre-frame:1,post-frame:1,pre-frame:2,post-frame:2,post-scene:2,"
check "pre-scene, skip" fails Pre_Scene S 0 "post-scene:1,"
check "pre-scene, all" fails Pre_Scene A 0 ""
check "pre-scene, quit" fails Pre_Scene Q 0 ""
check "pre-scene, abort" fails Pre_Scene U 1 "abort,post-scene:1,"
check "pre-scene, fatal" fails Pre_Scene F 1 "fatal,"
check "pre-frame, skip" fails Pre_Frame S 0 "pre-scene,post-scene:2,"
check "pre-frame, all" fails Pre_Frame a 0 "pre-scene,post-scene:1,"
check "pre-frame, quit" fails Pre_Frame Q 0 "pre-scene,"
check "pre-frame, abort" fails Pre_Frame U 1 "pre-scene,abort,post-scene:1,"
check "pre-frame, fatal" fails Pre_Frame F 1 "pre-scene,fatal,"
check "post-frame, all" fails Post_Frame A 0 "pre-scene,pre-frame:1,post-scene:1,"
check "post-frame, quit" fails Post_Frame Q 0 "pre-scene,pre-frame:1,"
check "post-scene, fatal" fails Post_Scene F 1 "pre-scene,pre-frame:1,post-frame:1,pre-frame:2,post-frame:2,fatal,"
check "a failure is not the negated action" fails Pre_Frame '!A' 0 "pre-scene,post-frame:1,post-frame:2,post-scene:2,"
check "success is" runs 0 "pre-scene,post-scene:1," --allow-commands +KFF2 Pre_Frame_Command=true Pre_Frame_Return=-A
echo 'sphere {' >sphere.pov
check "an error in the scene" runs 1 "pre-scene,pre-frame:1,fatal," --allow-commands
finish
