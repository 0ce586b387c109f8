EXTRA_DIST += %D%/common.sh %D%/files.sh %D%/interrupt.sh %D%/options.sh
TESTS += %D%/files.sh %D%/interrupt.sh %D%/options.sh
