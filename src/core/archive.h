// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/stream_buffer.hpp>
#include <boost/serialization/is_bitwise_serializable.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "external_command/core/polygon.h"
#include "external_command/core/pose.h"

BOOST_IS_BITWISE_SERIALIZABLE(external_command::Point2d)
BOOST_IS_BITWISE_SERIALIZABLE(external_command::BoundingBox)

namespace external_command {

/// Whether the bytes of a value in memory are all there is of it; BOOST_IS_BITWISE_SERIALIZABLE says so of a struct.
template <class T>
constexpr bool kIsPlain = boost::serialization::is_bitwise_serializable<T>::value || std::is_enum<T>::value;

/// Writes values one after the other, in this machine's own format, by Boost.Serialization's binary archive.
/// ArchiveReader has the same functions, so that one template can describe both ways.
class ArchiveWriter {
 public:
  template <class T>
  void value(const T& value) {
    static_assert(kIsPlain<T>, "a value of its own bytes alone");
    archive_.save_binary(&value, sizeof value);
  }

  template <class T>
  void value(const std::optional<T>& optional) {
    value(optional.has_value());
    if (optional) value(*optional);
  }

  void values(const std::string& text) { sequence(text); }

  template <class T>
  void values(const std::vector<T>& items) {
    sequence(items);
  }

  /// All that was written.
  const std::string& finish() {
    buffer_.pubsync();
    return bytes_;
  }

 private:
  template <class Sequence>
  void sequence(const Sequence& items) {
    static_assert(kIsPlain<typename Sequence::value_type>, "values of their own bytes alone");
    value(static_cast<std::uint64_t>(items.size()));
    archive_.save_binary(items.data(), items.size() * sizeof(typename Sequence::value_type));
  }

  std::string bytes_;
  boost::iostreams::stream_buffer<boost::iostreams::back_insert_device<std::string>> buffer_{
      boost::iostreams::back_inserter(bytes_)};
  boost::archive::binary_oarchive archive_{buffer_, boost::archive::no_header};
};

/// Reads what an ArchiveWriter of the same program has written.
class ArchiveReader {
 public:
  /// @param bytes  must live as long.
  explicit ArchiveReader(const std::string& bytes) : buffer_(bytes.data(), bytes.size()) {}

  /// @throws std::exception  there are no bytes left for it.
  template <class T>
  void value(T& value) {
    static_assert(kIsPlain<T>, "a value of its own bytes alone");
    archive_.load_binary(&value, sizeof value);
  }

  template <class T>
  void value(std::optional<T>& optional) {
    bool has_value = false;
    value(has_value);
    if (has_value) value(optional.emplace());
  }

  void values(std::string& text) { sequence(text); }

  template <class T>
  void values(std::vector<T>& items) {
    sequence(items);
  }

  /// How many things follow.
  /// @param size  of each at least [bytes].
  /// @throws std::exception  there are fewer bytes left than these take: nothing is made room for.
  std::size_t count(std::size_t size) {
    std::uint64_t count = 0;
    value(count);
    if (count > static_cast<std::size_t>(buffer_.in_avail()) / size) throw std::length_error("it ends too early");
    return static_cast<std::size_t>(count);
  }

 private:
  template <class Sequence>
  void sequence(Sequence& items) {
    using Item = typename Sequence::value_type;
    static_assert(kIsPlain<Item>, "values of their own bytes alone");
    items.resize(count(sizeof(Item)));
    archive_.load_binary(items.data(), items.size() * sizeof(Item));
  }

  boost::iostreams::stream_buffer<boost::iostreams::array_source> buffer_;
  boost::archive::binary_iarchive archive_{buffer_, boost::archive::no_header};
};

}  // namespace external_command
