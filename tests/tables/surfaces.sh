#!/bin/sh
# Every row of tests/data/normal-values.tsv and surface-values.tsv by rendering (TAP): six
# pixels of a sphere for each statement. Normals are seen through slope patterns.
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT
head='#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 3 }
camera { orthographic location <0.2,0.35,-10> right 3.6*x up 0.6*y direction z }
background { rgb <0.3,0.6,0.9> }'
see='#macro S(V, C) slope V color_map { [0 rgb 0][1 rgb C] } #end
#declare PG = pigment { average pigment_map { [1 S(x,<3,0,0>)][1 S(y,<0,3,0>)][1 S(z,<0,0,3>)] } }'

# For each statement of a table, expectations in N.txt and a frame of scene.pov.
split_table() { # TABLE KIND
    rm -f "$tmp"/*
    awk -F '\t' -v tmp="$tmp" -v kind="$2" '
    # What a slope pattern makes of a component of the normal, and how a millionth of it
    # shows there.
    function slope_of(v) { return v >= 1 ? 1 : v <= -1 ? 0 : (atan2(v, sqrt(1 - v * v)) * 2 / 3.14159265358979 + 1) / 2 }
    function slack(v) { v = v * v; return 2e-6 + 4e-6 / (3 * sqrt(v < 0.9999999 ? 1 - v : 1e-7)) }
    function worst(a, b, c) { a = a > b ? a : b; return a > c ? a : c }
    NR == 1 { next }
    $1 != last {
        last = $1
        column = 0
        number++
        body = $1
        gsub(/FE/, "ambient 0 diffuse 0 emission 1", body)
        if (kind == "normal")
            body = "pigment { PG } finish { ambient 0 diffuse 0 emission 1 } normal { " body " }"
        print "#case (" number ") sphere { 0, 2 " body " } #break" >(tmp "/cases")
        tolerance = 0
        print $1 >(tmp "/names")
    }
    {
        if (kind == "normal") {
            r = slope_of($8); g = slope_of($9); b = slope_of($10)
            t = worst(slack($8), slack($9), slack($10))
        } else {
            r = $5; g = $6; b = $7
            t = 2e-5 # 16 bits
        }
        tolerance = t > tolerance ? t : tolerance
        printf "// expect: %d 0 %.9g %.9g %.9g\n// tol: abs %.9g rel 1e-6\n", column++, r, g, b, tolerance >(tmp "/" number ".txt")
    }' "$1"
    {
        echo "$head"
        [ "$2" = normal ] && echo "$see"
        echo '#switch (frame_number)'
        cat "$tmp/cases"
        echo '#end'
    } >"$tmp/scene.pov"
}

test_number=0
check_table() { # TABLE KIND
    split_table "$top_srcdir/tests/data/$1" "$2"
    count=$(wc -l <"$tmp/names")
    timeout 100 "$top_builddir/lambert" "$tmp/scene.pov" "+L$top_srcdir/tests" +W6 +H1 +KFI1 \
        "+KFF$count" Bits_Per_Color=32 -o "$tmp/out.exr" >"$tmp/log" 2>&1 || sed 's/^/# /' "$tmp/log"
    i=0
    while read -r name; do
        i=$((i + 1))
        test_number=$((test_number + 1))
        frame=$(printf "$tmp/out%0${#count}d.exr" $i)
        if "$top_builddir/check_pixels" "$tmp/$i.txt" "$frame"; then
            echo "ok $test_number - $name"
        else
            echo "not ok $test_number - $name"
        fi
    done <"$tmp/names"
}
check_table normal-values.tsv normal
check_table surface-values.tsv surface
echo "1..$test_number"
[ $test_number -gt 80 ]
