// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/program_options.hpp>
#include <string>
#include <vector>

namespace external_command {
namespace benchmark {

/// Of the option `name`, whose value goes to `number`: as long as it is not given, that has the default. Other words
/// than finite numbers, from `least` up, are refused.
boost::program_options::typed_value<double>* number(const std::string& name, double* number);
boost::program_options::typed_value<int>* integer(const std::string& name, int least, int* number);

/// No options yet; described in lines as wide as the rest of a usage text.
boost::program_options::options_description noOptions();

/// Reads the words behind a program's name; those that are no options are inputs, and --help is one more option.
/// @return  false where help is asked for; nothing else is read then.
/// @throws boost::program_options::error  an option is unknown, or its value missing or wrong: the text names it.
bool parse(const std::vector<std::string>& words, boost::program_options::options_description options,
           std::vector<std::string>* inputs);

/// What --help prints before and after the list of options.
struct HelpText {
  const char* usage;
  const char* details;
};

/// As parse(), and prints the help where it is asked for.
bool parseOrHelp(const std::vector<std::string>& words, const boost::program_options::options_description& options,
                 const HelpText& help, std::vector<std::string>* inputs);

/// main() of the program `name`: what `run` makes of the words behind that; 2 where it throws, with a line that says
/// why.
int runMain(const char* name, int argc, char** argv, int (*run)(const std::vector<std::string>& words));

}  // namespace benchmark
}  // namespace external_command
