#include "core/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace drape {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const char* what, const fs::path& path, int error) {
  throw fs::filesystem_error(what, path, std::error_code(error, std::generic_category()));
}

/// A POSIX file descriptor.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags)
      : path_(path), number_(open(path.c_str(), flags, 0666)) {
    if (number_ < 0) refuse("cannot open", path_, errno);
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write_all(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = write(number_, text.data(), text.size());
      if (written >= 0)
        text.remove_prefix(static_cast<size_t>(written));
      else if (errno != EINTR)
        refuse("cannot write", path_, errno);
    }
  }

  void force_to_disk() const {
    if (fsync(number_) != 0) refuse("cannot force to disk", path_, errno);
  }

 private:
  fs::path path_;
  int number_;
};

}  // namespace

void write_durably(const fs::path& file, const std::function<void(const fs::path& part)>& write) {
  fs::path part = file;
  part += ".part";
  try {
    write(part);
    // fsync acts on the file, not on the descriptor: what others wrote is forced to disk as well.
    Descriptor(part, O_RDONLY | O_CLOEXEC).force_to_disk();
    fs::rename(part, file);
  } catch (...) {
    std::error_code ignored;  // the first failure is the one to report
    fs::remove(part, ignored);
    throw;
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Descriptor(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC).force_to_disk();
}

void write_text_durably(const fs::path& file, std::string_view text) {
  write_durably(file, [text](const fs::path& part) {
    Descriptor(part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC).write_all(text);
  });
}

}  // namespace drape
