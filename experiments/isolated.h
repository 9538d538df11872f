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

}  // namespace drape
