// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

namespace external_command {

/// Which ids an object of the map names, where thousands may name thousands. The ids must outlive it.
class NamedIds {
 public:
  void add(std::string_view object, std::string_view id) { pairs_.emplace(object, id); }

  void add(std::string_view object, const std::vector<std::string>& ids) {
    for (const std::string& id : ids) add(object, id);
  }

  bool has(std::string_view object, std::string_view id) const { return pairs_.count({object, id}) > 0; }

 private:
  using Pair = std::pair<std::string_view, std::string_view>;

  struct Hash {
    std::size_t operator()(const Pair& pair) const {
      const std::hash<std::string_view> hash;
      return hash(pair.first) * 31 + hash(pair.second);
    }
  };

  std::unordered_set<Pair, Hash> pairs_;
};

}  // namespace external_command
