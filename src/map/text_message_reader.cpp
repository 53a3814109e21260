// SPDX-License-Identifier: Apache-2.0
#include "text_message_reader.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/unknown_field_set.h>

#include <cmath>
#include <limits>

#include "external_command/core/text.h"

namespace external_command {

namespace {

namespace pb = google::protobuf;
using pb::FieldDescriptor;
using pb::io::Tokenizer;

constexpr int kMaxDepth = 100;  // of nested messages, as in protobuf's own reader

[[noreturn]] void fail(int line, int column, const std::string& what) {
  throw TextMessageError(text("line ", line + 1, ", column ", column + 1, ": ", what));
}

/// Keeps the tokenizer's complaints off stderr.
class Complaints : public pb::io::ErrorCollector {
 public:
  void AddError(int line, int column, const std::string& what) override {
    if (!what_.empty()) return;
    line_ = line;
    column_ = column;
    what_ = what;
  }

  void throwIfAny() const {
    if (!what_.empty()) fail(line_, column_, what_);
  }

 private:
  int line_ = 0, column_ = 0;
  std::string what_;
};

class TextMessageReader {
 public:
  explicit TextMessageReader(const std::string& bytes)
      : stream_(bytes.data(), static_cast<int>(bytes.size())), tokenizer_(&stream_, &complaints_) {
    tokenizer_.set_comment_style(Tokenizer::SH_COMMENT_STYLE);
    tokenizer_.set_allow_f_after_float(true);
    tokenizer_.set_require_space_after_number(false);
    next();
  }

  void read(pb::Message* message, const std::function<void()>& after_field) {
    while (tokenizer_.current().type != Tokenizer::TYPE_END) {
      readField(message);
      after_field();
    }
  }

 private:
  void next() {
    tokenizer_.Next();
    complaints_.throwIfAny();
  }

  [[noreturn]] void failHere(const std::string& expected) {
    const Tokenizer::Token& token = tokenizer_.current();
    const bool at_end = token.type == Tokenizer::TYPE_END;
    fail(token.line, token.column,
         text("expected ", expected, ", found ", at_end ? "the end of the file" : '"' + token.text + '"'));
  }

  bool sees(const char* symbol) { return tokenizer_.current().text == symbol; }

  bool take(const char* symbol) {
    if (!sees(symbol)) return false;
    next();
    return true;
  }

  void readField(pb::Message* message);
  void readValue(pb::Message* message, const FieldDescriptor* field);
  void readEnum(pb::Message* message, const FieldDescriptor* field);
  void readMessage(pb::Message* message);
  std::string readName();
  double readNumber();
  std::string readString();
  bool readBool();
  template <class Read>
  void readBody(const Read& read_field);
  void skipField();
  void skipValue();

  Complaints complaints_;
  pb::io::ArrayInputStream stream_;
  Tokenizer tokenizer_;
  int depth_ = 0;
};

/// `name: value`, `name { ... }` or `name: [value, value]`, and perhaps a separator.
void TextMessageReader::readField(pb::Message* message) {
  const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(readName());
  if (field == nullptr) return skipField();
  if (!take(":") && field->type() != FieldDescriptor::TYPE_MESSAGE) failHere("\":\"");
  if (field->is_repeated() && take("[")) {
    while (!take("]")) {
      readValue(message, field);
      if (!take(",") && !sees("]")) failHere("\",\" or \"]\"");
    }
  } else {
    readValue(message, field);
  }
  if (!take(",")) take(";");
}

/// Empty for an extension or a packed Any, "[package.name]": neither is in the description.
std::string TextMessageReader::readName() {
  if (take("[")) {
    while (!take("]")) {
      if (tokenizer_.current().type == Tokenizer::TYPE_END) failHere("\"]\"");
      next();
    }
    return "";
  }
  if (tokenizer_.current().type != Tokenizer::TYPE_IDENTIFIER) failHere("the name of a field");
  const std::string name = tokenizer_.current().text;
  next();
  return name;
}

void TextMessageReader::readValue(pb::Message* message, const FieldDescriptor* field) {
  const pb::Reflection& reflection = *message->GetReflection();
  switch (field->type()) {
    case FieldDescriptor::TYPE_MESSAGE:
      readMessage(field->is_repeated() ? reflection.AddMessage(message, field)
                                       : reflection.MutableMessage(message, field));
      break;
    case FieldDescriptor::TYPE_DOUBLE:
      reflection.SetDouble(message, field, readNumber());
      break;
    case FieldDescriptor::TYPE_BYTES:
      reflection.SetString(message, field, readString());
      break;
    case FieldDescriptor::TYPE_BOOL:
      reflection.SetBool(message, field, readBool());
      break;
    case FieldDescriptor::TYPE_ENUM:
      readEnum(message, field);
      break;
    default:
      throw std::logic_error(text("the text reader does not know the type of ", field->full_name()));
  }
}

void TextMessageReader::readEnum(pb::Message* message, const FieldDescriptor* field) {
  const pb::Reflection& reflection = *message->GetReflection();
  const pb::EnumValueDescriptor* value;
  if (tokenizer_.current().type == Tokenizer::TYPE_IDENTIFIER) {
    value = field->enum_type()->FindValueByName(tokenizer_.current().text);
    next();
  } else {
    const double number = readNumber();
    const bool fits = std::abs(number) < 1e6;
    value = fits ? field->enum_type()->FindValueByNumber(static_cast<int>(number)) : nullptr;
  }
  if (value == nullptr) {
    reflection.MutableUnknownFields(message)->AddVarint(field->number(), 0);
  } else if (field->is_repeated()) {
    reflection.AddEnum(message, field, value);
  } else {
    reflection.SetEnum(message, field, value);
  }
}

void TextMessageReader::readMessage(pb::Message* message) {
  readBody([this, message] { readField(message); });
}

/// `{ ... }` or `< ... >`.
template <class Read>
void TextMessageReader::readBody(const Read& read_field) {
  if (++depth_ > kMaxDepth) failHere(text("at most ", kMaxDepth, " nested messages"));
  const char* end = sees("<") ? ">" : "}";
  if (!take("<") && !take("{")) failHere("\"{\"");
  while (!take(end)) read_field();
  --depth_;
}

double TextMessageReader::readNumber() {
  const double sign = take("-") ? -1.0 : 1.0;
  const Tokenizer::Token token = tokenizer_.current();
  double value;
  if (token.type == Tokenizer::TYPE_INTEGER || token.type == Tokenizer::TYPE_FLOAT) {
    value = Tokenizer::ParseFloat(token.text);
  } else if (token.text == "inf" || token.text == "infinity") {
    value = std::numeric_limits<double>::infinity();
  } else if (token.text == "nan") {
    value = std::numeric_limits<double>::quiet_NaN();
  } else {
    failHere("a number");
  }
  next();
  return sign * value;
}

/// Adjacent strings are one.
std::string TextMessageReader::readString() {
  if (tokenizer_.current().type != Tokenizer::TYPE_STRING) failHere("a text in quotes");
  std::string value;
  while (tokenizer_.current().type == Tokenizer::TYPE_STRING) {
    Tokenizer::ParseStringAppend(tokenizer_.current().text, &value);
    next();
  }
  return value;
}

bool TextMessageReader::readBool() {
  for (const char* yes : {"true", "True", "t", "1"}) {
    if (take(yes)) return true;
  }
  for (const char* no : {"false", "False", "f", "0"}) {
    if (take(no)) return false;
  }
  failHere("true or false");
}

/// The rest of a field whose name is not known.
void TextMessageReader::skipField() {
  if (take(":") && take("[")) {
    while (!take("]")) {
      skipValue();
      if (!take(",") && !sees("]")) failHere("\",\" or \"]\"");
    }
  } else {
    skipValue();
  }
  if (!take(",")) take(";");
}

void TextMessageReader::skipValue() {
  if (sees("{") || sees("<")) {
    readBody([this] {
      readName();
      skipField();
    });
  } else if (tokenizer_.current().type == Tokenizer::TYPE_STRING) {
    readString();
  } else if (tokenizer_.current().type == Tokenizer::TYPE_IDENTIFIER) {
    next();
  } else {
    readNumber();
  }
}

}  // namespace

void readTextMessage(const std::string& bytes, google::protobuf::Message* message,
                     const std::function<void()>& after_field) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw TextMessageError("a text may have 2 GB at most; the binary form may have more");
  }
  TextMessageReader(bytes).read(message, after_field);
}

}  // namespace external_command
