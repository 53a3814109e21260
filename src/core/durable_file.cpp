// SPDX-License-Identifier: Apache-2.0
#include "durable_file.h"

#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {
namespace durable_file {

namespace {

constexpr std::size_t kMostUnconfirmed = 32 << 20;  // [bytes]
constexpr const char* kTemporary = ".new";

[[noreturn]] void fail(const char* what, const std::string& path, int error) {
  throw InternalError(text(path, " cannot be ", what, ": ", std::generic_category().message(error)));
}

/// @return  what keeps the folder of a file from being there.
std::error_code makeFolder(const std::string& path) {
  std::error_code failure;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), failure);
  return failure;
}

/// Whether the process that writes NAME.PID-N.new may still be at it.
bool isInUse(const std::string& name, OwnFiles own) {
  const std::size_t dot = name.rfind('.', name.size() - std::string(kTemporary).size() - 1);
  const long pid = dot == std::string::npos ? 0 : std::atol(name.c_str() + dot + 1);
  if (pid == ::getpid()) return own == OwnFiles::kInUse;
  return pid > 0 && (::kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM);
}

bool endsWith(const std::string& name, const std::string& end) {
  return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

NewFile::NewFile(const std::string& path)
    : path_(path), folder_failure_(makeFolder(path)), file_(path, O_WRONLY | O_CREAT | O_TRUNC) {
  if (!file_.isOpen()) fail("written", path, folder_failure_ ? folder_failure_.value() : errno);
}

NewFile::~NewFile() {
  if (!is_finished_) remove(path_);
}

void NewFile::write(const void* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const std::size_t part = std::min(size - done, kMostUnconfirmed);
    const ssize_t written = ::write(file_.get(), static_cast<const char*>(bytes) + done, part);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("written", path_, errno);
    done += static_cast<std::size_t>(written);
    unconfirmed_ += static_cast<std::size_t>(written);
    if (unconfirmed_ >= kMostUnconfirmed) confirm();
  }
}

void NewFile::finish() {
  confirm();
  is_finished_ = true;
}

void NewFile::confirm() {
  if (::fsync(file_.get()) != 0) fail("written", path_, errno);
  unconfirmed_ = 0;
}

void create(const std::string& path, const std::vector<std::string>& parts) {
  NewFile file(path);
  for (const std::string& part : parts) file.write(part.data(), part.size());
  file.finish();
}

void replace(const std::string& path, const std::string& with) {
  if (std::rename(with.c_str(), path.c_str()) != 0) fail("replaced", path, errno);
  // The new name is on the disk once the folder is; where a file system cannot do that, it does it by itself later.
  const FileDescriptor folder(std::filesystem::path(path).parent_path().string(), O_RDONLY | O_DIRECTORY);
  if (folder.isOpen()) ::fsync(folder.get());
}

bool read(const std::string& path, std::size_t most, std::string* content) {
  const FileDescriptor file(path, O_RDONLY | O_NONBLOCK);
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

std::string temporaryPath(const std::string& path) {
  static std::atomic<unsigned> count{0};
  return path + "." + std::to_string(::getpid()) + "-" + std::to_string(++count) + kTemporary;
}

void requireRoom(const std::string& path, std::uintmax_t bytes) {
  const std::error_code no_folder = makeFolder(path);
  std::error_code failure;
  const auto space = std::filesystem::space(std::filesystem::path(path).parent_path(), failure);
  if (no_folder || failure || space.available >= bytes) return;
  throw InternalError(text(path, " cannot be written: ", space.available >> 20, " MiB are left on its disk, and ",
                           bytes >> 20, " MiB have to be"));
}

void removeLeftovers(const std::string& folder, const std::string& prefix, OwnFiles own) {
  std::error_code failure;
  for (std::filesystem::directory_iterator file(folder, failure), end; !failure && file != end;
       file.increment(failure)) {
    const std::string name = file->path().filename().string();
    if (name.compare(0, prefix.size(), prefix) != 0 || !endsWith(name, kTemporary) || isInUse(name, own)) continue;
    remove(file->path().string());
  }
}

}  // namespace durable_file
}  // namespace external_command
