// heap.h: memory for programs that label one part and end.
#pragma once

namespace polylab {

// Fresh memory is what short runs spend most of their time on: the system hands it out page by page and clears it. This makes
// the heap of the whole process start on a large page, take its address space in one step, keep what is freed, and ask for
// large pages. To be called first in main(). Where that can't be had nothing changes but the time.
void prepare_heap();

}   // namespace polylab
