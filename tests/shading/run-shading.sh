#!/bin/sh
# Renders each scene of this folder and checks the pixels it lists (TAP). A scene named
# in not-built.txt is skipped with the reason given there.
dir=$top_srcdir/tests/shading
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT
number=0
for scene in "$dir"/*.pov; do
    name=$(basename "$scene" .pov)
    number=$((number + 1))
    reason=$(sed -n "s/^$name: //p" "$dir/not-built.txt")
    if [ -n "$reason" ]; then
        echo "ok $number - $name # SKIP $reason"
        continue
    fi
    size=$(sed -n 's,^// size: \([0-9]*\) \([0-9]*\).*,+W\1 +H\2,p' "$scene")
    options=$(sed -n 's,^// options: ,,p' "$scene")
    rm -f "$tmp/out.exr"
    # Sizes and options are words of their own.
    # shellcheck disable=SC2086
    "$top_builddir/lambert" "$scene" "+L$top_srcdir/tests/data/images" ${size:-+W4 +H4} $options -o "$tmp/out.exr" \
        >"$tmp/log" 2>&1
    if "$top_builddir/check_pixels" "$scene" "$tmp/out.exr"; then
        echo "ok $number - $name"
    else
        sed 's/^/# /' "$tmp/log"
        echo "not ok $number - $name"
    fi
done
# Surfaces that are shaded eight hits at a time look as the general rule makes them: every
# scene above, those of the gallery, and for each instruction set.
different=
scenes=0
for scene in "$dir"/*.pov "$dir"/*.scn "$top_srcdir"/scenes/gallery/*.scn "$top_srcdir"/tests/perf/csg_1000.scn \
    "$top_srcdir"/tests/perf/texture_*.scn; do
    [ -z "$(sed -n "s/^$(basename "$scene" .pov): //p" "$dir/not-built.txt")" ] || continue
    # Media take long; a part of their scenes is enough here.
    case $scene in *-media-*) [ "${scene#*/3[234][0459]-}" != "$scene" ] || continue ;; esac
    LAMBERT_SHADING=general "$top_builddir/lambert" "$scene" "+L$top_srcdir/tests/data/images" +W61 +H47 -q \
        -o "$tmp/first.exr" >"$tmp/log" 2>&1 || continue
    scenes=$((scenes + 1))
    for isa in base avx2 avx512; do
        LAMBERT_ISA=$isa "$top_builddir/lambert" "$scene" "+L$top_srcdir/tests/data/images" +W61 +H47 -q -o "$tmp/other.exr" \
            >"$tmp/log" 2>&1
        cmp -s "$tmp/first.exr" "$tmp/other.exr" || different="$different $isa:$scene"
    done
done
number=$((number + 1))
[ -z "$different" ] && [ "$scenes" -gt 100 ] || printf 'not '
echo "ok $number - shading in lanes gives the bits of the general rule ($scenes scenes)"
[ -z "$different" ] || echo "# $different"
# The same bits for any number of threads, any tiles and any instruction set.
same()
{
    number=$((number + 1))
    if cmp -s "$tmp/first.exr" "$tmp/other.exr"; then
        echo "ok $number - $1"
    else
        echo "not ok $number - $1"
    fi
}
render() { "$top_builddir/lambert" "$scene" "+L$top_srcdir/tests/data/images" +W40 +H30 "$@" >"$tmp/log" 2>&1; }
for name in 290-mixed 247-radiosity-image 252-photons-reflect 196-media-method1 325-media-area-adaptive 343-media-random; do
    scene=$dir/$name.pov
    unset LAMBERT_ISA
    render +WT1 -o "$tmp/first.exr"
    render +WT4 -o "$tmp/other.exr"
    same "$name: four threads give the picture of one"
    render +WT2 +BS7 -o "$tmp/other.exr"
    same "$name: small tiles give the same picture"
    for isa in base avx2 avx512; do
        LAMBERT_ISA=$isa
        export LAMBERT_ISA
        render -o "$tmp/other.exr"
        same "$name: $isa gives the same picture"
    done
done
echo "1..$number"
