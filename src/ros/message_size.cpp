// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/message_size.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

struct Field {
  std::string type, name;
  bool is_list = false;
};

/// "float64 x  # [m]" -> x; no name for an empty line, a comment, a constant.
Field fieldOf(const std::string& line) {
  std::istringstream words(line.substr(0, line.find('#')));
  Field field;
  if (line.find('=') < line.find('#') || !(words >> field.type >> field.name)) return {};
  const std::size_t bracket = field.type.find('[');
  field.is_list = bracket != std::string::npos;
  field.type.resize(std::min(bracket, field.type.size()));
  return field;
}

bool isSameType(const std::string& full, const std::string& used) {
  return full == used ||
         (full.size() > used.size() && full.compare(full.size() - used.size(), used.size(), used) == 0 &&
          full[full.size() - used.size() - 1] == '/');
}

/// Those of `type`, or of the first message where it is empty. A definition holds the messages one after the other,
/// each behind a line of `=` and "MSG: package/Type".
std::vector<Field> fieldsOf(const std::string& definition, const std::string& type) {
  std::istringstream lines(definition);
  std::vector<Field> fields;
  bool is_here = type.empty();
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("====", 0) == 0) {
      if (is_here) break;
    } else if (line.rfind("MSG: ", 0) == 0) {
      is_here = isSameType(line.substr(5), type);
    } else if (is_here) {
      const Field field = fieldOf(line);
      if (!field.name.empty()) fields.push_back(field);
    }
  }
  return fields;
}

}  // namespace

std::string fieldName(const std::string& definition, const FieldPlace& place) {
  std::string name, type;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const std::vector<Field> fields = fieldsOf(definition, type);
    if (place[i] >= fields.size()) break;
    const Field& field = fields[place[i]];
    name += (name.empty() ? "" : ".") + field.name;
    if (field.is_list && i + 1 < place.size()) name += text("[", place[++i], "]");
    type = field.type;
  }
  return name;
}

MessageSize MessageWalk::finish() const {
  if (left_ == 0) return size_;
  throw InvalidRequest(text("the message has ", left_, " bytes behind its last field; was it damaged on its way?"));
}

std::string MessageWalk::name() const { return fieldName(definition_, place_); }

void MessageWalk::skip(std::size_t size) {
  if (size > left_) {
    throw InvalidRequest(text("the message of ", size_.bytes, " bytes ends within ", name(), ": it takes ", size,
                              " bytes, ", left_, " are left"));
  }
  next_ += size;
  left_ -= size;
}

std::uint32_t MessageWalk::takeNumber() {
  std::uint32_t number = 0;
  const std::uint8_t* const at = next_;
  skip(sizeof(number));
  std::memcpy(&number, at, sizeof(number));
  return number;
}

void MessageWalk::passText() {
  const std::size_t length = takeNumber();
  if (length > left_) {
    throw InvalidRequest(text(name(), " is said to have ", length, " letters; ", left_, " bytes follow"));
  }
  if (length > size_.text.size) size_.text = {length, place_};
  skip(length);
}

std::size_t MessageWalk::takeCount(std::size_t smallest, bool counts) {
  const std::size_t count = takeNumber();
  const std::size_t most = left_ / std::max<std::size_t>(smallest, 1);
  if (count > most) {
    throw InvalidRequest(text(name(), " is said to have ", count, " elements of ", smallest, " bytes at least; ", left_,
                              " bytes follow"));
  }
  size_.items += counts ? count : 1;
  if (counts && count > size_.list.size) size_.list = {count, place_};
  return count;
}

}  // namespace external_command
