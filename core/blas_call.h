// What holds while CHOLMOD and the BLAS below it work on behalf of one thread.
//
// Drapes are parallel over fabrics. Threads of CHOLMOD's own, which Debian's build opens in the
// supernodal kernel, make it 2 to 4 times slower at our sizes, and those of OpenBLAS gain nothing.
// OpenBLAS's serial build (Debian's libopenblas0-serial 0.3.21), in turn, hands the same work space
// to every thread that calls it, so that some factors come out wrong: there one calls at a time.
#pragma once

#include <omp.h>

#include <mutex>

// Null unless OpenBLAS is the BLAS of this process.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" int openblas_get_parallel() __attribute__((weak));  // 0: the serial build

namespace drape {

class BlasCall {
 public:
  BlasCall() : levels_(omp_get_max_active_levels()) {
    static std::mutex one_at_a_time;
    static const bool is_serial = openblas_get_parallel != nullptr && openblas_get_parallel() == 0;
    static std::once_flag single_threaded;
    if (is_serial) lock_ = std::unique_lock(one_at_a_time);
    std::call_once(single_threaded, [] {
      if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
    });
    omp_set_max_active_levels(0);
  }
  ~BlasCall() { omp_set_max_active_levels(levels_); }
  BlasCall(const BlasCall&) = delete;
  BlasCall& operator=(const BlasCall&) = delete;

 private:
  int levels_;
  std::unique_lock<std::mutex> lock_;
};

}  // namespace drape
