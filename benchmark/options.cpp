// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>

#include "external_command/core/text.h"

namespace external_command {
namespace benchmark {

namespace po = boost::program_options;

po::typed_value<double>* number(const std::string& name, double* number) {
  return po::value(number)->value_name("X")->default_value(*number, text(*number))->notifier([name](double value) {
    if (!std::isfinite(value)) throw po::error(text("--", name, " needs a finite number"));
  });
}

po::typed_value<int>* integer(const std::string& name, int least, int* number) {
  return po::value(number)->value_name("N")->default_value(*number)->notifier([name, least](int value) {
    if (value < least) throw po::error(text("--", name, " needs a whole number from ", least, " up"));
  });
}

po::options_description noOptions() {
  constexpr unsigned kWidth = 120, kLeastForDescriptions = 84;
  return po::options_description("Options", kWidth, kLeastForDescriptions);
}

bool parse(const std::vector<std::string>& words, po::options_description options, std::vector<std::string>* inputs) {
  options.add_options()("help", "")("input", po::value(inputs));
  // Without short options: "-1" is a number.
  const int style = po::command_line_style::allow_long | po::command_line_style::long_allow_adjacent |
                    po::command_line_style::long_allow_next;
  po::variables_map values;
  po::store(po::command_line_parser(words)
                .options(options)
                .positional(po::positional_options_description().add("input", -1))
                .style(style)
                .run(),
            values);
  if (values.count("help") > 0) return false;
  po::notify(values);
  return true;
}

bool parseOrHelp(const std::vector<std::string>& words, const po::options_description& options, const HelpText& help,
                 std::vector<std::string>* inputs) {
  if (parse(words, options, inputs)) return true;
  std::cout << help.usage << options << help.details;
  return false;
}

int runMain(const char* name, int argc, char** argv, int (*run)(const std::vector<std::string>& words)) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\nSee %s --help.\n", name, error.what(), name);
    return 2;
  }
}

}  // namespace benchmark
}  // namespace external_command
