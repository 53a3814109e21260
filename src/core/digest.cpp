// SPDX-License-Identifier: Apache-2.0
#include "digest.h"

#include <xxhash.h>

#include <atomic>
#include <cstdio>

#include "external_command/core/in_parallel.h"
#include "file_reading.h"

namespace external_command {

std::uint64_t digestOf(const void* bytes, std::size_t size) { return XXH64(bytes, size, 0); }

std::uint64_t ContentDigest::value() const {
  std::vector<std::uint64_t> all = parts_;
  all.push_back(size_);
  return digestOf(all.data(), all.size() * sizeof(std::uint64_t));
}

std::uint64_t contentDigest(const std::string& bytes) {
  ContentDigest digest(bytes.size());
  for (std::size_t i = 0; i < digest.parts(); ++i) digest.add(i, bytes.data() + i * ContentDigest::kPartSize);
  return digest.value();
}

std::uint64_t contentDigestOfFile(const std::string& path) {
  const FileReading file(path);
  ContentDigest digest(file.size());
  std::atomic<std::size_t> next{0};
  inParallel(parallelParts(digest.parts()), [&](std::size_t) {
    std::string buffer(ContentDigest::kPartSize, '\0');
    for (std::size_t i = next++; i < digest.parts(); i = next++) {
      file.read(i * ContentDigest::kPartSize, digest.sizeOf(i), &buffer[0]);
      digest.add(i, buffer.data());
    }
  });
  return digest.value();
}

std::string hexadecimal(std::uint64_t digest) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(digest));
  return digits;
}

}  // namespace external_command
