// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace external_command {

/// Finds among known words those that an unknown one was probably meant to be: the fewest letters inserted, left out,
/// replaced, or swapped with the next (optimal string alignment distance), whatever their case; at most a third of the
/// word. Words of more than 100 letters are not compared.
class NearestWords {
 public:
  explicit NearestWords(const std::string& word);

  /// O(letters), with a small factor: hundreds of thousands of words take some 10 ms.
  void offer(const std::string& known);

  /// The nearest ones, all equally near, as they were offered, each once, at most three; empty where none is near.
  const std::vector<std::string>& words() const { return words_; }

  /// "; did you mean 'n_out_5' or 'n_out_6'?", to end an error text; empty where no word is near.
  std::string question() const;

 private:
  const std::string word_;
  std::size_t limit_;  // words further away are not taken
  std::vector<std::string> words_;
};

/// The question above for the words of a container.
template <class Words>
std::string didYouMean(const std::string& word, const Words& known) {
  NearestWords nearest(word);
  for (const std::string& candidate : known) nearest.offer(candidate);
  return nearest.question();
}

}  // namespace external_command
