// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace external_command {
namespace benchmark {

namespace {

bool isOption(const std::string& word) { return word.rfind("--", 0) == 0; }

}  // namespace

bool CommandLine::asksForHelp() const { return std::find(words_.begin(), words_.end(), "--help") != words_.end(); }

std::vector<std::string> CommandLine::parse(const std::map<std::string, std::function<void()>>& options) {
  std::vector<std::string> inputs;
  for (next_ = 0; next_ < words_.size();) {
    const std::string& word = words_[next_++];
    const auto option = options.find(word);
    if (option != options.end()) {
      option->second();
    } else if (isOption(word)) {
      throw std::invalid_argument("unknown option " + word);
    } else {
      inputs.push_back(word);
    }
  }
  return inputs;
}

std::string CommandLine::value() {
  if (next_ >= words_.size() || isOption(words_[next_])) {
    throw std::invalid_argument(words_[next_ - 1] + " needs a value");
  }
  return words_[next_++];
}

double CommandLine::number() {
  const std::string option = words_[next_ - 1], word = value();
  try {
    std::size_t read = 0;
    const double number = std::stod(word, &read);
    if (read == word.size() && std::isfinite(number)) return number;
  } catch (const std::logic_error&) {  // of stod: no number, or none that fits; told below
  }
  throw std::invalid_argument(option + " needs a number, not " + word);
}

int CommandLine::integer(int smallest) {
  const std::string option = words_[next_ - 1];
  const double wanted = number();
  if (wanted == std::floor(wanted) && wanted >= smallest && wanted <= std::numeric_limits<int>::max()) {
    return static_cast<int>(wanted);
  }
  throw std::invalid_argument(option + " needs a whole number from " + std::to_string(smallest) + " up");
}

}  // namespace benchmark
}  // namespace external_command
