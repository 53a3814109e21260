// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nodelet/loader.h>
#include <nodelet/nodelet.h>
#include <ros/names.h>

#include <functional>
#include <map>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <utility>

namespace external_command {

/// A nodelet manager in the test's own process: of types that pluginlib knows, and of the test's.
class NodeletManager {
 public:
  using Make = std::function<boost::shared_ptr<nodelet::Nodelet>()>;

  /// Nodelets of `type` are made by `make`.
  void provide(const std::string& type, Make make) { makers_[type] = std::move(make); }

  /// The same for a class of the test. @param latest  is set to the nodelet made last.
  template <class Nodelet>
  void provide(const std::string& type, boost::shared_ptr<Nodelet>* latest) {
    provide(type, [latest] { return *latest = boost::make_shared<Nodelet>(); });
  }

  bool load(const std::string& name, const std::string& type) {
    return loader_.load(ros::names::resolve(name), type, {}, {});
  }

  bool unload(const std::string& name) { return loader_.unload(ros::names::resolve(name)); }

  void clear() { loader_.clear(); }

 private:
  boost::shared_ptr<nodelet::Nodelet> create(const std::string& type) {
    const auto maker = makers_.find(type);
    return maker != makers_.end() ? maker->second() : classes_.createInstance(type);
  }

  pluginlib::ClassLoader<nodelet::Nodelet> classes_{"nodelet", "nodelet::Nodelet"};
  std::map<std::string, Make> makers_;
  nodelet::Loader loader_{boost::function<boost::shared_ptr<nodelet::Nodelet>(const std::string&)>(
      [this](const std::string& type) { return create(type); })};
};

}  // namespace external_command
