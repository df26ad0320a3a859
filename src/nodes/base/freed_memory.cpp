// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/freed_memory.h"

#include <malloc.h>

namespace vegetation_sim {

void releaseFreedMemory() {
#ifdef __GLIBC__
  if (mallinfo2().fordblks > MOST_FREED_MEMORY) malloc_trim(0);
#endif
}

}  // namespace vegetation_sim
