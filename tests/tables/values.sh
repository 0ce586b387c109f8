#!/bin/sh
# Every row of tests/data/pattern-values.tsv through the language itself: a scene declares
# the functions and prints their values (TAP). 1e-6 relative; colour components are single
# precision.
table=$top_srcdir/tests/data/pattern-values.tsv
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT
echo 1..2

awk -F '\t' '
# The expression at a point: the names x, y, z become numbers.
function at_point(expr, x, y, z,    out, word) {
    out = ""
    while (match(expr, /[A-Za-z_][A-Za-z_0-9]*/)) {
        word = substr(expr, RSTART, RLENGTH)
        out = out substr(expr, 1, RSTART - 1)
        out = out (word == "x" ? "(" x ")" : word == "y" ? "(" y ")" : word == "z" ? "(" z ")" : word)
        expr = substr(expr, RSTART + RLENGTH)
        # a member of a result, .x, is no coordinate
        if (match(expr, /^\(.*\)\.[xyz]$/) == 0) continue
    }
    return out expr
}
BEGIN {
    print "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#include \"functions.inc\""
    last = ""
}
NR > 1 {
    if ($2 != last && $2 != "") {
        # A new name each time: the language does not declare a function twice.
        name = "F" ++count
        print "#declare " name " = " $2
    }
    last = $2
    expr = $3
    member = ""
    if (match(expr, /\)\.[a-z]+$/)) {
        member = substr(expr, RSTART + 1)
        expr = substr(expr, 1, RSTART)
    }
    sub(/F\(/, name "(", expr)
    printf "#debug concat(str(%s%s, 0, 15), \"\\n\")\n", at_point(expr, $4, $5, $6), member
}
END { print "sphere { 0, 1 }" }' "$table" >"$tmp/values.pov"

timeout 120 "$top_builddir/lambert" "$tmp/values.pov" "+L$top_srcdir/tests" +W1 +H1 \
    -o "$tmp/values.png" >"$tmp/out" 2>&1
rows=$(awk 'NR > 1' "$table" | wc -l)
grep -E '^(-?[0-9.]+(e[-+][0-9]+)?|-?nan|-?inf)$' "$tmp/out" >"$tmp/got"
lines=$(wc -l <"$tmp/got")
if [ "$lines" -eq "$rows" ] && [ "$rows" -gt 7000 ]; then
    echo "ok 1 - all $rows expressions are evaluated"
else
    grep -v -E '^-?[0-9.]+$' "$tmp/out" | head -20 | sed 's/^/# /'
    echo "not ok 1 - all expressions are evaluated ($lines of $rows)"
fi
if awk 'NR > 1' "$table" | paste -d '\t' - "$tmp/got" | awk -F '\t' '
    function size(v) { return v < 0 ? -v : v }
    {
        limit = 1e-6 * (size($7) > 1 ? size($7) : 1)
        # Arithmetic beyond the range of numbers is none.
        if ($7 ~ /nan|inf/ && $8 ~ /nan|inf/) next
        if (!(size($8 - $7) <= limit) && wrong++ < 20)
            printf "# %s | %s at %s %s %s: %s, not %s\n", $2, $3, $4, $5, $6, $8, $7
    }
    END { printf "# %d wrong\n", wrong; exit wrong > 0 }'; then
    echo "ok 2 - the values are those of the table"
else
    echo "not ok 2 - the values are those of the table"
fi
