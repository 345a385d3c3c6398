#include "polylab/heap.h"

#include <cstdint>
#include <cstdlib>

#if defined(__unix__)
#include <sys/mman.h>
#include <unistd.h>
#endif

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace polylab {

void prepare_heap() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
    constexpr int kStep = 1 << 30;   // of address space; memory is taken as it is used
    constexpr std::uintptr_t kLargePage = 2 << 20;
    mallopt(M_MMAP_THRESHOLD, kStep);
    mallopt(M_TRIM_THRESHOLD, kStep);
    mallopt(M_TOP_PAD, kStep);
    // A page that was touched before stays small, with all of the large one around it: the first allocation in the new
    // space, larger than what glibc's heap starts with, comes to lie just below a large page.
    constexpr std::uintptr_t kFirst = 144 << 10, kBelow = 160 << 10;
    const std::uintptr_t heap_end = reinterpret_cast<std::uintptr_t>(sbrk(0)) + kBelow;
    sbrk(static_cast<std::intptr_t>(kLargePage - heap_end % kLargePage));
    if (void* const first = std::malloc(kFirst)) {
        const std::uintptr_t page = (reinterpret_cast<std::uintptr_t>(first) + kBelow) & ~(kLargePage - 1);
        madvise(reinterpret_cast<void*>(page), kStep, MADV_HUGEPAGE);   // NOLINT(performance-no-int-to-ptr)
        std::free(first);
    }
    mallopt(M_TOP_PAD, kLargePage);
#endif
}

}   // namespace polylab
