// Which Drape this is: kept with every result. A library of its own (drape::version), because its
// content changes with every commit.
#pragma once

#include <string_view>

namespace drape {

/// Version of the release, as "0.1.0".
std::string_view version();
/// Commit the program was built from (40 hexadecimal digits), "-dirty" appended where tracked files
/// differ from it; "unknown" outside of a git repository.
std::string_view git_commit();
/// Compiler, its version and the build type, as "GNU 12.2.0 Release native".
std::string_view compiler();

}  // namespace drape
