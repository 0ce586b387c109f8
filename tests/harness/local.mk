# Checks of the code base itself, and what the other tests share.
harness_checks = %D%/check-layers.sh %D%/check-state.sh %D%/check-headers.sh
TESTS += $(harness_checks)
EXTRA_DIST += $(harness_checks) %D%/check-tables.sh %D%/test.h %D%/run-scene.sh src/LAYERS
