#!/bin/sh
# The corpus and 40 mutants of it through the front end and the evaluator.
echo 1..1
if "$top_builddir/fuzz_parse" 40 "$top_srcdir"/tests/fuzz/corpus/*.pov >&2; then
    echo "ok 1 - no crash and no hang"
else
    echo "not ok 1 - a mutant crashed or hung"
fi
