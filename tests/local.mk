# Every test program is a cmocka group that prints TAP; make check counts checks.
AM_TESTS_ENVIRONMENT = CMOCKA_MESSAGE_OUTPUT=TAP; export CMOCKA_MESSAGE_OUTPUT; \
	top_srcdir='$(top_srcdir)'; export top_srcdir; \
	top_builddir='$(top_builddir)'; export top_builddir; \
	header_cflags='$(PNG_CFLAGS) $(JPEG_CFLAGS) $(EXR_CFLAGS)'; export header_cflags;
LOG_DRIVER = env AM_TAP_AWK='$(AWK)' $(SHELL) $(top_srcdir)/build-aux/tap-driver.sh
SH_LOG_DRIVER = $(LOG_DRIVER)
SH_LOG_COMPILER = $(SHELL)
test_cppflags = $(AM_CPPFLAGS) $(CMOCKA_CFLAGS) -I$(top_srcdir)/%D%/harness
test_ldadd = $(lambert_libs) $(CMOCKA_LIBS)

include %D%/unit/base/local.mk
include %D%/unit/math/local.mk
include %D%/unit/image/local.mk
include %D%/unit/lang/local.mk
include %D%/unit/scene/local.mk
include %D%/unit/eval/local.mk
include %D%/unit/trace/local.mk
include %D%/unit/api/local.mk
include %D%/unit/tess/local.mk
include %D%/unit/irradiance/local.mk
include %D%/unit/radiosity/local.mk
include %D%/cli/local.mk
include %D%/includes/local.mk
include %D%/lang/local.mk
include %D%/words/local.mk
include %D%/golden/local.mk
include %D%/compare/local.mk
include %D%/stability/local.mk
include %D%/shading/local.mk
include %D%/tables/local.mk
include %D%/fuzz/local.mk
include %D%/harness/local.mk
include %D%/perf/local.mk
include %D%/perf/accuracy/local.mk
include %D%/perf/radiosity/local.mk

TESTS += $(check_PROGRAMS)
