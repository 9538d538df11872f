// Reading files that are not ours: the HDF5 library may crash on a damaged one.
#pragma once

#include <functional>
#include <string>

namespace drape {

/// Runs `work` in a child process, which goes on to the end of the program, and returns its exit
/// code in this one: both sides hand the code back. Throws std::invalid_argument if the child
/// crashed or the file asked for more memory than there is; `file` names it in the message. To be
/// called before there are threads.
int isolated(const std::string& file, const std::function<int()>& work);

/// Runs `work` in a child process that ends with it: throws std::invalid_argument if it crashes. An
/// exception is none of its business: the work is to be done here after it.
void probe(const std::string& file, const std::function<void()>& work);

}  // namespace drape
