// SPDX-License-Identifier: Apache-2.0
#include "digest.h"

#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <vector>

#include "external_command/core/in_parallel.h"
#include "file_reading.h"

namespace external_command {

namespace {

constexpr std::size_t kPartSize = 1 << 20;  // of contents; it decides what their digests are [bytes]

/// Of a content that is looked at part by part: the digest of the digests of the parts.
/// @param bytesOf  (begin, size, buffer) -> where the bytes of a part are; they may be put into the buffer.
template <class BytesOf>
std::uint64_t digestOfParts(std::size_t size, const BytesOf& bytesOf) {
  std::vector<std::uint64_t> digests((size + kPartSize - 1) / kPartSize);
  std::atomic<std::size_t> next{0};
  inParallel(parallelParts(digests.size()), [&](std::size_t) {
    std::string buffer;
    for (std::size_t i = next++; i < digests.size(); i = next++) {
      const std::size_t begin = i * kPartSize, count = std::min(kPartSize, size - begin);
      digests[i] = digestOf(bytesOf(begin, count, &buffer), count);
    }
  });
  digests.push_back(size);
  return digestOf(digests.data(), digests.size() * sizeof(std::uint64_t));
}

}  // namespace

std::uint64_t digestOf(const void* bytes, std::size_t size) { return XXH64(bytes, size, 0); }

std::uint64_t contentDigest(const std::string& bytes) {
  return digestOfParts(bytes.size(),
                       [&](std::size_t begin, std::size_t, std::string*) { return bytes.data() + begin; });
}

std::uint64_t contentDigestOfFile(const std::string& path) {
  const FileReading file(path);
  return digestOfParts(file.size(), [&](std::size_t begin, std::size_t size, std::string* buffer) {
    buffer->resize(size);
    file.read(begin, size, &(*buffer)[0]);
    return buffer->data();
  });
}

std::string hexadecimal(std::uint64_t digest) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(digest));
  return digits;
}

}  // namespace external_command
