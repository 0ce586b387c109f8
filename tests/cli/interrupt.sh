#!/bin/sh
# SIGINT while rendering: what is done is written, exit code 2.
. "${top_srcdir:-.}/tests/cli/common.sh"

interrupted()
{
  "$lambert" sphere.pov +W3000 +H3000 +A0.0 +R9 +WT1 --tile-size 16 -o big.png 2>err &
  pid=$!
  sleep 1
  kill -INT $pid
  wait $pid
  test $? = 2 && has err 'interrupted' && test -s big.png
}
check "interrupted" interrupted
whole() { ls | grep -q '\.part$' && return 1; exits 0 "$lambert" compare big.png big.png; }
check "the picture is a whole file" whole
finish
