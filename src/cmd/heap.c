// The heap of the process. A run of a small scene is over in some milliseconds, of which
// the first touch of each page of the heap takes more than what is written there.
#define _DEFAULT_SOURCE // madvise, sbrk
#include "cmd/cmd.h"

#ifdef __GLIBC__
#include <malloc.h>
#include <stdint.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

// One heap for all threads: they take memory a few times a tile, and a heap of its own for
// each would be new pages, given back when it ends.
static void share(void)
{
#ifdef M_ARENA_MAX
    mallopt(M_ARENA_MAX, 1);
#endif
}

// The heap lies on large pages from a little behind its begin, with the blocks in it that
// would else be pages of their own; where large pages are refused, small ones do. What is
// touched before they are asked for stays on a small page and keeps its surroundings there.
// Behind the first page, which every scene fills, small scenes need a part of the next one
// only: up to FEW it is small pages, since a large one may be dear (a virtual machine whose
// host has taken the memory back gives it again in milliseconds).
static void use_large_pages(void)
{
#if defined __GLIBC__ && defined MADV_HUGEPAGE
    enum { LARGE_PAGE = 1 << 21, FEW = 4 * LARGE_PAGE, ROOM = 16 * LARGE_PAGE };
    enum { OWN_PAGES = 2 * LARGE_PAGE, SMALL_PAGE = 1 << 12, USUAL_PAD = 1 << 17 };
    const uintptr_t end = (uintptr_t)sbrk(0);
    const uintptr_t rest = (-end - SMALL_PAGE) & (LARGE_PAGE - 1);
    if (end == UINTPTR_MAX || sbrk((intptr_t)rest) == (void *)-1)
        return;
    mallopt(M_MMAP_THRESHOLD, OWN_PAGES);
    mallopt(M_TRIM_THRESHOLD, 2 * ROOM);
    mallopt(M_TOP_PAD, ROOM);
    void *volatile first = malloc(1); // makes the heap, if there may be so much
    free(first);
    char *begin = (char *)(end + rest + SMALL_PAGE);
    if (first) {
        madvise(begin, LARGE_PAGE, MADV_HUGEPAGE);
        madvise(begin + FEW, ROOM - FEW - LARGE_PAGE, MADV_HUGEPAGE);
    }
    mallopt(M_TOP_PAD, USUAL_PAD);
#endif
}

void heap_begin(void)
{
    share();
    use_large_pages();
}
