#include "experiments/parallel_items.h"

#include <omp.h>

#include <atomic>
#include <exception>

#include "experiments/interrupt.h"

namespace drape {

void for_each_item(int count, int threads, const std::function<void(int)>& item) {
  std::exception_ptr error;
  std::atomic<bool> failed = false;
#pragma omp parallel num_threads(threads)
  {
    omp_set_num_threads(1);  // of regions inside an item, also when this one has a single thread
#pragma omp for schedule(dynamic)
    for (int i = 0; i < count; ++i) {
      if (failed || interrupted()) continue;
      try {
        item(i);
      } catch (...) {
#pragma omp critical(drape_item_error)
        if (!error) error = std::current_exception();
        failed = true;
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace drape
