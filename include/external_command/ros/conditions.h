// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <vector>

namespace external_command {

/// Something that commands need.
struct Condition {
  std::string name;  ///< map, pose, chassis, planner, ...
  bool is_met = false;
  std::string message;                 ///< how it stands; else what is missing, in the words of a refusal
  std::vector<std::string> needed_by;  ///< services, as CommandStatus::service
};

/// What the commands of all processors need. Each processor adds its own, with the very check by which it refuses, so
/// that what is said here and what is refused cannot differ. Thread-safe.
class Conditions {
 private:
  struct Need {
    std::string name, service;
    std::function<std::string()> check;
  };

 public:
  /// Tells how the condition stands; what numbers it names should not change all the time. Must be quick, and must not
  /// call the Conditions.
  /// @throws Error  it is not met; the text is that of the refusal.
  using Check = std::function<std::string()>;

  /// A need counts as long as its entry lives; the entry must not outlive the Conditions, and what `check` uses not the
  /// entry.
  class Entry {
   public:
    Entry(Entry&& other) noexcept : conditions_(other.conditions_), need_(other.need_) { other.conditions_ = nullptr; }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    Entry& operator=(Entry&&) = delete;
    ~Entry();

   private:
    friend class Conditions;
    Entry(Conditions* conditions, std::list<Need>::iterator need) : conditions_(conditions), need_(need) {}

    Conditions* conditions_;
    std::list<Need>::iterator need_;
  };

  /// @param service  needs it. Several may need what goes by one name: it is met where it is for all of them.
  [[nodiscard]] Entry add(const std::string& name, const std::string& service, Check check);

  /// How all of them stand now, by their names.
  std::vector<Condition> look() const;

 private:
  mutable std::mutex mutex_;  ///< held while it is looked, so that who takes a need away waits for its check
  std::list<Need> needs_;
};

}  // namespace external_command
