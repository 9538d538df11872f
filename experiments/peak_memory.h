// How much memory a piece of work needs, measured by the kernel (Linux).
#pragma once

#include <functional>

namespace drape {

/// Growth of the process's largest resident memory while `work` runs [byte], in pages; NaN where
/// the kernel does not let its mark be reset. Nothing else may run in the process meanwhile.
double peak_memory_growth(const std::function<void()>& work);

}  // namespace drape
