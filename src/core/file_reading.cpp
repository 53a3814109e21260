// SPDX-License-Identifier: Apache-2.0
#include "file_reading.h"

#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw InternalError(text(path, " cannot be read: ", why));
}

[[noreturn]] void fail(const std::string& path, int error) { fail(path, std::generic_category().message(error)); }

}  // namespace

FileReading::FileReading(const std::string& path) : path_(path), file_(path, O_RDONLY | O_NONBLOCK) {
  if (!file_.isOpen()) fail(path, errno);
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) fail(path, errno);
  if (!S_ISREG(status.st_mode)) fail(path, "it is no regular file");
  size_ = static_cast<std::size_t>(status.st_size);
}

void FileReading::read(std::size_t begin, std::size_t size, void* bytes) const {
  for (std::size_t done = 0; done < size;) {
    const ssize_t got =
        ::pread(file_.get(), static_cast<char*>(bytes) + done, size - done, static_cast<off_t>(begin + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path_, errno);
    if (got == 0) fail(path_, text("it ends after ", begin + done, " bytes"));
    done += static_cast<std::size_t>(got);
  }
}

}  // namespace external_command
