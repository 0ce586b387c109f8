#!/bin/sh
# The corpus and 40 mutants of it: scenes through the front end and the evaluator, INI
# files through the command's options; the small images and 300 mutants of them through
# the readers.
echo 1..3
if "$top_builddir/fuzz_parse" 40 "$top_srcdir"/tests/fuzz/corpus/*.pov >&2; then
    echo "ok 1 - no crash and no hang"
else
    echo "not ok 1 - a mutant crashed or hung"
fi
if "$top_builddir/fuzz_ini" 40 "$top_srcdir"/tests/fuzz/corpus/*.ini >&2 2>/dev/null; then
    echo "ok 2 - no crash and no hang of INI files"
else
    echo "not ok 2 - an INI file crashed or hung"
fi
if "$top_builddir/fuzz_image" 300 $(find "$top_srcdir/tests/data/images" -name '*.*' \
    ! -name '*.py' ! -name '*.tsv' | LC_ALL=C sort) >&2; then
    echo "ok 3 - no image crashes or hangs a reader"
else
    echo "not ok 3 - an image crashed or hung a reader"
fi
