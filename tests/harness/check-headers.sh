#!/bin/sh
# Every header compiles alone. One TAP line per header. header_cflags: those of libraries.
srcdir=${top_srcdir:-.} builddir=${top_builddir:-.}
n=0 failed=0
for header in $(cd "$srcdir" && find src -name '*.h' | sort); do
  n=$((n + 1))
  if printf '#include "%s"\n' "$header" |
    ${CC:-cc} -std=c11 -D_POSIX_C_SOURCE=200809L -I"$srcdir" -I"$srcdir/src" \
      -I"$srcdir/include" -I"$srcdir/grammar" -I"$builddir/grammar" \
      -I"$builddir/src" -I"$builddir" $header_cflags -Wall -Werror -fsyntax-only -x c - 2>"headers.$$"; then
    echo "ok $n - $header"
  else
    echo "not ok $n - $header"
    sed 's/^/# /' "headers.$$"
    failed=1
  fi
done
rm -f "headers.$$"
echo "1..$n"
exit $failed
