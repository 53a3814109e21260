// SPDX-License-Identifier: Apache-2.0
#include "pending_signals.h"

#include <optional>
#include <string>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

struct Field {
  const char* name;
  std::uint8_t VehicleSignal::*value;
  std::uint8_t highest;  ///< of its constants; 0 keeps what is
};

constexpr Field kFields[] = {{"turn_signal", &VehicleSignal::turn_signal, VehicleSignal::TURN_HAZARD},
                             {"high_beam", &VehicleSignal::high_beam, VehicleSignal::ON},
                             {"low_beam", &VehicleSignal::low_beam, VehicleSignal::ON},
                             {"horn", &VehicleSignal::horn, VehicleSignal::ON},
                             {"emergency_light", &VehicleSignal::emergency_light, VehicleSignal::ON}};

bool isCommanded(const VehicleSignal& commanded, const Field& field) { return commanded.*field.value != 0; }

/// The signals that differ from what is commanded: "horn is 1, not 2, ...". Empty where the chassis does as told.
std::string differences(const VehicleSignal& commanded, const VehicleSignal& reported) {
  std::string found;
  for (const Field& field : kFields) {
    const int wanted = commanded.*field.value, actual = reported.*field.value;
    if (wanted == 0 || wanted == actual) continue;
    found += text(found.empty() ? "" : ", ", field.name, " is ", actual, ", not ", wanted);
  }
  return found;
}

bool contradict(const VehicleSignal& a, const VehicleSignal& b) {
  for (const Field& field : kFields) {
    if (isCommanded(a, field) && isCommanded(b, field) && a.*field.value != b.*field.value) return true;
  }
  return false;
}

}  // namespace

void checkSignals(const VehicleSignal& commanded) {
  for (const Field& field : kFields) {
    const int value = commanded.*field.value, highest = field.highest;
    if (value > highest) {
      throw InvalidRequest(text("basic_signal.", field.name, " is ", value, "; it must be 0 to ", highest));
    }
  }
}

bool commandsAny(const VehicleSignal& commanded) {
  for (const Field& field : kFields) {
    if (isCommanded(commanded, field)) return true;
  }
  return false;
}

PendingSignals::Changes PendingSignals::add(const AdmittedCommand& command, const VehicleSignal& commanded,
                                            double now) {
  Changes changes = endWhere(&pending_, [&](const Pending& pending) -> std::optional<CommandStatus> {
    if (!contradict(pending.commanded, commanded)) return std::nullopt;
    return makeStatus(pending.command.id, CommandStatus::ERROR, ErrorCode::kSuperseded,
                      text("superseded by command ", command.id));
  });
  const Changes dropped = addPending(&pending_, Pending{command, commanded, now + timeout_});
  changes.insert(changes.end(), dropped.begin(), dropped.end());
  return changes;
}

PendingSignals::Changes PendingSignals::onChassis(const VehicleSignal& reported) {
  reported_ = reported;
  return endWhere(&pending_, [&](const Pending& pending) -> std::optional<CommandStatus> {
    if (!differences(pending.commanded, reported).empty()) return std::nullopt;
    return makeStatus(pending.command.id, CommandStatus::FINISHED, ErrorCode::kOk,
                      "the chassis reports the signals as commanded");
  });
}

void PendingSignals::keepWhere(const std::function<bool(CommandSerial)>& is_running) {
  external_command::keepWhere(is_running, &pending_);
}

PendingSignals::Changes PendingSignals::onTime(double now) {
  return endWhere(&pending_, [&](const Pending& pending) -> std::optional<CommandStatus> {
    if (now < pending.deadline) return std::nullopt;
    return makeStatus(pending.command.id, CommandStatus::UNKNOWN, ErrorCode::kOk,
                      text("the chassis did not report the signals as commanded within ", timeout_,
                           " s (~timeout): ", differences(pending.commanded, reported_)));
  });
}

}  // namespace external_command
