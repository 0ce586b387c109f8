#!/bin/sh
# The dependency rule as a test: each folder may include only the folders on its
# line of src/LAYERS. Prints one TAP line per folder.
srcdir=${top_srcdir:-.}
n=0 failed=0
while read -r layer allowed; do
  case $layer in '' | '#'*) continue ;; esac
  n=$((n + 1))
  bad=$(grep -rnoE '^#include "[a-z]+/' "$srcdir/$layer" |
    sed 's/^\([^:]*:[0-9]*\):#include "\([a-z]*\)\//\1 \2/' |
    while read -r where target; do
      case " ${layer##*/} lambert $allowed " in
      *" $target "*) ;;
      *) echo "# $where includes $target/" ;;
      esac
    done)
  if test -z "$bad"; then
    echo "ok $n - $layer"
  else
    echo "not ok $n - $layer"
    echo "$bad"
    failed=1
  fi
done <"$srcdir/src/LAYERS"
echo "1..$n"
exit $failed
