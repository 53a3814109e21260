// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace external_command {
namespace benchmark {

/// The words after a program's name: options, some with a value behind them, and inputs.
class CommandLine {
 public:
  explicit CommandLine(std::vector<std::string> words) : words_(std::move(words)) {}

  bool asksForHelp() const;

  /// Calls the function of each option that is there, in their order; it takes the option's value, if it has one.
  /// @return the words that are no options.
  /// @throws std::invalid_argument  an option is unknown, or its value missing or wrong: the text names it.
  std::vector<std::string> parse(const std::map<std::string, std::function<void()>>& options);

  /// The value of the option in hand.
  std::string value();
  double number();
  int integer(int smallest);

 private:
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

}  // namespace benchmark
}  // namespace external_command
