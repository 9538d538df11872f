// A loop over independent items (fabrics), one thread each.
#pragma once

#include <functional>

namespace drape {

/// Calls item(i) for 0 <= i < count on `threads` threads; within an item everything runs on one
/// thread. After an interrupt (see interrupt.h), or once an item has thrown, the remaining items
/// are left out; the first exception is thrown again when all threads have stopped.
void for_each_item(int count, int threads, const std::function<void(int)>& item);

}  // namespace drape
