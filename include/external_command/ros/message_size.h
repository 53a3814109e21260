// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <boost/array.hpp>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace external_command {

/// Where in a message something is: the index of a field, that of an item where the field is a list, and so on.
using FieldPlace = std::vector<std::size_t>;

/// "command.way_point[3].x". @param definition  as of ros::message_traits::definition().
std::string fieldName(const std::string& definition, const FieldPlace& place);

/// What a serialized message holds.
struct MessageSize {
  struct Largest {
    std::size_t size = 0;
    FieldPlace place;  ///< empty: there is none
  };

  std::size_t bytes = 0;
  std::size_t items = 0;  ///< of all lists in sum, of lists in lists too; a list of bytes counts as one
  Largest list;           ///< by its items
  Largest text;           ///< by its bytes
};

/// Goes through the bytes of a message by its type, without building it: roscpp makes a list as long as the bytes say
/// it is, and 29 bytes can say a hundred million. It is the stream that generated serializers are called with.
class MessageWalk {
 public:
  /// @param definition  for the names in errors; must live as long as the walk.
  MessageWalk(const std::uint8_t* data, std::size_t size, const char* definition)
      : next_(data), left_(size), definition_(definition), place_{0} {
    size_.bytes = size;
  }

  /// Passes the next field, or message, of that type; `field` stays as it is.
  /// @throws InvalidRequest  what is stated exceeds what is left.
  template <class Field>
  void next(Field& field) {
    pass(field);
    ++place_.back();
  }

  /// Passes the whole message.
  /// @throws InvalidRequest  also where something is left.
  template <class Message>
  MessageSize walk(Message message) {
    if constexpr (HasFields<Message>::value) {
      ros::serialization::Serializer<Message>::template allInOne<MessageWalk, Message&>(*this, message);
    } else {
      pass(message);
    }
    return finish();
  }

 private:
  template <class Message, class = void>
  struct HasFields : std::false_type {};
  template <class Message>
  struct HasFields<
      Message, std::void_t<decltype(ros::serialization::Serializer<Message>::template allInOne<MessageWalk, Message&>(
                   std::declval<MessageWalk&>(), std::declval<Message&>()))>> : std::true_type {};

  template <class Field>
  void pass(Field& field) {
    if constexpr (ros::message_traits::IsFixedSize<Field>::value) {
      skip(ros::serialization::serializationLength(field));
    } else if constexpr (HasFields<Field>::value) {
      passFields(field);
    } else {
      passUnknown(field);
    }
  }

  template <class Allocator>
  void pass(std::basic_string<char, std::char_traits<char>, Allocator>& /*field*/) {
    passText();
  }

  template <class Item, class Allocator>
  void pass(std::vector<Item, Allocator>& /*field*/) {
    Item item{};
    const std::size_t smallest = ros::serialization::serializationLength(item);
    const std::size_t count = takeCount(smallest, sizeof(Item) > 1);
    if constexpr (ros::message_traits::IsFixedSize<Item>::value) {
      skip(count * smallest);
    } else {
      passItems(item, count);
    }
  }

  template <class Item, std::size_t kCount>
  void pass(boost::array<Item, kCount>& field) {
    passItems(field[0], kCount);
  }

  template <class Message>
  void passFields(Message& message) {
    place_.push_back(0);
    ros::serialization::Serializer<Message>::template allInOne<MessageWalk, Message&>(*this, message);
    place_.pop_back();
  }

  template <class Item>
  void passItems(Item& item, std::size_t count) {
    place_.push_back(0);
    for (std::size_t i = 0; i < count; ++i) next(item);
    place_.pop_back();
  }

  /// A type with a serializer that somebody wrote by hand: its counts are believed.
  template <class Field>
  void passUnknown(Field& field) {
    // The stream only reads; roscpp's interface wants a mutable pointer.
    ros::serialization::IStream stream(const_cast<std::uint8_t*>(next_), static_cast<std::uint32_t>(left_));
    ros::serialization::deserialize(stream, field);
    skip(left_ - stream.getLength());
  }

  MessageSize finish() const;
  void skip(std::size_t size);
  void passText();

  /// The number of items of a list. @param smallest  bytes of an item. @param counts  as items of the message.
  std::size_t takeCount(std::size_t smallest, bool counts);

  std::uint32_t takeNumber();
  std::string name() const;

  const std::uint8_t* next_;
  std::size_t left_;
  const char* const definition_;
  FieldPlace place_;
  MessageSize size_;
};

/// Sizes of a serialized `Message`; what `data` states was compared with what is there.
/// @throws InvalidRequest  it states more than there is, or something is left over.
template <class Message>
MessageSize sizeOfMessage(const std::uint8_t* data, std::size_t size) {
  return MessageWalk(data, size, ros::message_traits::definition<Message>()).walk(Message());
}

}  // namespace external_command
