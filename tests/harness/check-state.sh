#!/bin/sh
# No mutable globals: every object of the library may define read-only data only.
# One TAP line per object file; a variable in .data, .bss or COMMON fails it.
builddir=${top_builddir:-.}
n=0 failed=0
case $(cat "$builddir/config.status" 2>/dev/null) in
*--enable-sanitize* | *--enable-tsan*)
  echo "1..0 # SKIP sanitizers add data of their own"
  exit 0
  ;;
esac
for object in $(find "$builddir/src" "$builddir/grammar" -name '*.o' | sort); do
  n=$((n + 1))
  # Capital and small B, C, D: data that can be written. .data.rel.ro is const.
  bad=$(objdump -t "$object" 2>/dev/null |
    awk '$0 ~ / (\.data|\.bss|\*COM\*|\.tbss|\.tdata|\.data\.[^r][^ \t]*|\.bss\.[^ \t]*)[ \t]/ &&
         $NF !~ /^\./ {print "# " $NF}')
  if test -z "$bad"; then
    echo "ok $n - ${object#"$builddir"/}"
  else
    echo "not ok $n - ${object#"$builddir"/}"
    echo "$bad"
    failed=1
  fi
done
echo "1..$n"
test $n -gt 0 || exit 1
exit $failed
