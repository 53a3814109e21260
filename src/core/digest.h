// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace external_command {

/// Of some bytes, by XXH64 (Y. Collet): tells damage and changes, but is no protection against forgery.
std::uint64_t digestOf(const void* bytes, std::size_t size);

/// That of a content of which the parts are added in any order: the digest of the digests of its parts. Parts may be
/// added by several threads at once.
class ContentDigest {
 public:
  static constexpr std::size_t kPartSize = 1 << 20;  ///< [bytes]

  /// @param size  of the whole content [bytes].
  explicit ContentDigest(std::size_t size) : size_(size), parts_((size + kPartSize - 1) / kPartSize) {}

  std::size_t parts() const { return parts_.size(); }

  /// Part `index`, which has kPartSize bytes; the last one may have fewer.
  void add(std::size_t index, const char* bytes) { parts_[index] = digestOf(bytes, sizeOf(index)); }

  std::size_t sizeOf(std::size_t index) const { return std::min(kPartSize, size_ - index * kPartSize); }

  /// Once all parts are added.
  std::uint64_t value() const;

 private:
  const std::size_t size_;
  std::vector<std::uint64_t> parts_;
};

std::uint64_t contentDigest(const std::string& bytes);

/// Of the content of a file, read on all processors.
/// @throws InternalError  there is no such file, or it cannot be read.
std::uint64_t contentDigestOfFile(const std::string& path);

/// 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t digest);

}  // namespace external_command
