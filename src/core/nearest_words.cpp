// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/nearest_words.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace external_command {

namespace {

constexpr std::size_t kMostWords = 3;
constexpr std::size_t kMostLetters = 100;
using Row = std::array<std::size_t, kMostLetters + 1>;

std::string lowerCase(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return word;
}

/// More than `limit` where the distance is.
std::size_t distanceBetween(const std::string& a, const std::string& b, std::size_t limit) {
  Row before_last{}, last{}, row{};
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    std::size_t least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      const bool are_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (are_swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (least > limit + 1) return limit + 1;  // a swap may still lead from the last row past this one
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

NearestWords::NearestWords(const std::string& word) : word_(lowerCase(word)), limit_((word.size() + 1) / 3) {}

void NearestWords::offer(const std::string& known) {
  if (known.empty()) return;
  const std::size_t longer = std::max(known.size(), word_.size()), shorter = std::min(known.size(), word_.size());
  if (longer > kMostLetters || longer - shorter > limit_) return;
  const std::size_t distance = distanceBetween(word_, lowerCase(known), limit_);
  if (distance > limit_) return;
  if (distance < limit_) words_.clear();
  limit_ = distance;
  const bool is_new = std::find(words_.begin(), words_.end(), known) == words_.end();
  if (is_new && words_.size() < kMostWords) words_.push_back(known);
}

std::string NearestWords::question() const {
  std::string question;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    question += i == 0 ? "; did you mean '" : i + 1 < words_.size() ? "', '" : "' or '";
    question += words_[i];
  }
  return question.empty() ? question : question + "'?";
}

}  // namespace external_command
