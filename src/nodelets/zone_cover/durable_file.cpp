// SPDX-License-Identifier: Apache-2.0
#include "durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {
namespace durable_file {

namespace {

[[noreturn]] void fail(const char* what, const std::string& path, int error) {
  throw InternalError(text(path, " cannot be ", what, ": ", std::generic_category().message(error)));
}

/// An open file, closed with it.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool isOpen() const { return fd_ >= 0; }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// @return  0, or errno.
int writeAll(int fd, const std::string& part) {
  for (std::size_t done = 0; done < part.size();) {
    const ssize_t written = ::write(fd, part.data() + done, part.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    done += static_cast<std::size_t>(written);
  }
  return 0;
}

int writeAll(const std::string& path, const std::vector<std::string>& parts) {
  const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.isOpen()) return errno;
  for (const std::string& part : parts) {
    if (const int error = writeAll(file.get(), part)) return error;
  }
  return ::fsync(file.get()) == 0 ? 0 : errno;
}

}  // namespace

void create(const std::string& path, const std::vector<std::string>& parts) {
  std::error_code failure;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), failure);
  const int error = writeAll(path, parts);
  if (error == 0) return;
  remove(path);
  fail("written", path, failure ? failure.value() : error);
}

void replace(const std::string& path, const std::string& with) {
  if (std::rename(with.c_str(), path.c_str()) != 0) fail("replaced", path, errno);
  // The new name is on the disk once the folder is; where a file system cannot do that, it does it by itself later.
  const Descriptor folder(std::filesystem::path(path).parent_path().string(), O_RDONLY | O_DIRECTORY);
  if (folder.isOpen()) ::fsync(folder.get());
}

bool read(const std::string& path, std::size_t most, std::string* content) {
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);
  if (!file.isOpen() && (errno == ENOENT || errno == ENOTDIR)) return false;
  if (!file.isOpen()) fail("read", path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail("read", path, errno);
  if (!S_ISREG(status.st_mode)) throw InternalError(text(path, " cannot be read: it is no file"));
  content->resize(std::min(static_cast<std::size_t>(status.st_size), most));
  std::size_t done = 0;
  while (done < content->size()) {
    const ssize_t got = ::read(file.get(), &(*content)[done], content->size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", path, errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  content->resize(done);
  return true;
}

void remove(const std::string& path) noexcept { ::unlink(path.c_str()); }

}  // namespace durable_file
}  // namespace external_command
