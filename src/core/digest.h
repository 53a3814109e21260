// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace external_command {

/// Of some bytes, by XXH64 (Y. Collet): tells damage and changes, but is no protection against forgery.
std::uint64_t digestOf(const void* bytes, std::size_t size);

/// Of the content of a file, on all processors. That of a file and that of its bytes are the same.
std::uint64_t contentDigest(const std::string& bytes);

/// @throws InternalError  there is no such file, or it cannot be read.
std::uint64_t contentDigestOfFile(const std::string& path);

/// 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t digest);

}  // namespace external_command
