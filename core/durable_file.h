// Files that are either complete and on disk or not there at all.
//
// The content goes to NAME.part in the same folder, is forced to the disk (fsync), takes its final
// name in one step (rename), and the folder that holds the name is forced to the disk too. A
// process killed, or a machine that loses power, at any moment leaves the old file or the new one
// under the final name, and perhaps a NAME.part that the next write of the same name replaces.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace drape {

/// Calls `write(part)`, which must create and close the file `part`; on return the content stands
/// under the name `file` and is on disk. Two writers must not write the same name at the same time.
/// Throws std::filesystem::filesystem_error when the disk refuses, and whatever `write` throws; the
/// former content of `file` is then still there, and the part file is gone.
void write_durably(const std::filesystem::path& file,
                   const std::function<void(const std::filesystem::path& part)>& write);

/// The same for a text, written byte for byte.
void write_text_durably(const std::filesystem::path& file, std::string_view text);

}  // namespace drape
