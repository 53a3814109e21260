// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/plans_in_work.h"

namespace external_command {

PlansInWork::Entry::Entry(PlansInWork* plans, const CancelSource& plan) : plans_(*plans) {
  const std::lock_guard<std::mutex> lock(plans_.mutex_);
  position_ = plans_.plans_.insert(plans_.plans_.end(), plan);
  if (plans_.are_cancelled_) plan.cancel();
}

PlansInWork::Entry::~Entry() {
  const std::lock_guard<std::mutex> lock(plans_.mutex_);
  plans_.plans_.erase(position_);
}

void PlansInWork::cancelForGood() {
  const std::lock_guard<std::mutex> lock(mutex_);
  are_cancelled_ = true;
  for (const CancelSource& plan : plans_) plan.cancel();
}

bool PlansInWork::areCancelled() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return are_cancelled_;
}

std::size_t PlansInWork::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return plans_.size();
}

}  // namespace external_command
