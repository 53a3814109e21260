// SPDX-License-Identifier: Apache-2.0
#include "links.h"

#include <cmath>

#include "connector.h"

namespace external_command {

namespace {

constexpr double kDifference = 0.1;  ///< of a way's length from the guess that does not matter [m]

}  // namespace

Links::Links(const Field& field, const std::vector<Work>& works, Routes* routes)
    : field_(field), works_(works), routes_(*routes) {}

std::uint64_t Links::idOf(const Step* from, const Step* to) {
  const auto id = [](const Step* step) {
    return step == nullptr ? 0 : (static_cast<std::uint64_t>(step->work + 1) << 14U) + step->way;
  };
  return (id(from) << 32U) + id(to);
}

double Links::price(const Step* from, const Step* to) {
  if (to == nullptr || (from == nullptr && !field_.start())) return 0.0;
  const auto [entry, is_new] = known_.try_emplace(idOf(from, to), 0.0F);
  if (is_new) {
    const Pose2d begin = beginOf(from), &end = startOf(*to);
    const double straight = (end.position() - begin.position()).norm();
    entry->second = static_cast<float>(reedsSheppLength(begin, end, field_.radius()) +
                                       routes_.distance(begin.position(), end.position()) - straight);
  }
  return static_cast<double>(entry->second);
}

bool Links::settle(const Step* from, const Step* to) {
  if (from == nullptr && !field_.start()) return false;
  const auto [entry, is_new] = ways_.try_emplace(idOf(from, to));
  if (!is_new) return false;
  const std::optional<Curve> driven = from == nullptr ? std::nullopt : std::optional<Curve>(curveOf(*from));
  entry->second = Connector(field_).connect(driven ? &*driven : nullptr, beginOf(from), curveOf(*to));
  const double guess = price(from, to), length = entry->second ? entry->second->length() : kNoWay;
  known_[idOf(from, to)] = static_cast<float>(length);
  return std::abs(length - guess) > kDifference;
}

std::optional<Curve> Links::way(const Step* from, const Step* to) const {
  const auto known = ways_.find(idOf(from, to));
  return known == ways_.end() ? std::nullopt : known->second;
}

double Links::bound(const Step* from, const Step* to) const {
  if (to == nullptr || (from == nullptr && !field_.start())) return 0.0;
  return (startOf(*to).position() - beginOf(from).position()).norm();
}

}  // namespace external_command
