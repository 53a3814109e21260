// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/parameter_check.h"

#include <ros/console.h>
#include <ros/names.h>
#include <ros/param.h>

#include <algorithm>
#include <mutex>

#include "external_command/core/nearest_words.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

using XmlRpc::XmlRpcValue;

struct KnownNames {
  std::mutex mutex;
  std::set<std::string> names;
};

KnownNames& knownNames() {
  static KnownNames known;
  return known;
}

/// Of "a/b/c" the part after the last slash.
std::string lastPart(const std::string& key) { return key.substr(key.rfind('/') + 1); }

bool startsWith(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

bool isKnownBelow(const std::string& key, const std::set<std::string>& known) {
  const auto next = known.lower_bound(key + "/");
  return next != known.end() && startsWith(*next, key + "/");
}

/// The key that was meant: first among those of the same dictionary, then anywhere.
std::string nearestKey(const std::string& key, const std::set<std::string>& known) {
  const std::string name = lastPart(key);
  const std::string dictionary = key.substr(0, key.size() - name.size());
  NearestWords beside(name), anywhere(name);
  for (const std::string& other : known) {
    anywhere.offer(lastPart(other));
    if (startsWith(other, dictionary)) beside.offer(lastPart(other.substr(0, other.find('/', dictionary.size()))));
  }
  if (!beside.words().empty()) return dictionary + beside.words().front();
  if (anywhere.words().empty()) return "";
  const std::string& nearest = anywhere.words().front();
  return *std::find_if(known.begin(), known.end(),
                       [&](const std::string& other) { return lastPart(other) == nearest; });
}

void collect(const std::string& key, XmlRpcValue value, const std::set<std::string>& known,
             std::vector<StrayKey>* stray) {
  const bool is_struct = value.getType() == XmlRpcValue::TypeStruct;
  if (is_struct && (key.empty() || isKnownBelow(key, known))) {
    for (const auto& [name, item] : value) collect(key.empty() ? name : key + "/" + name, item, known, stray);
  } else if (known.count(key) == 0) {
    stray->push_back({key, nearestKey(key, known)});
  }
}

/// The keys below `ns` that are known so far.
std::set<std::string> knownBelow(const std::string& ns) {
  const std::string start = ns == "/" ? ns : ns + "/";
  std::set<std::string> keys;
  const std::lock_guard<std::mutex> lock(knownNames().mutex);
  const auto& names = knownNames().names;
  for (auto name = names.lower_bound(start); name != names.end() && startsWith(*name, start); ++name) {
    keys.insert(name->substr(start.size()));
  }
  return keys;
}

}  // namespace

std::vector<StrayKey> strayKeys(const XmlRpcValue& tree, const std::set<std::string>& known) {
  std::vector<StrayKey> stray;
  if (tree.getType() == XmlRpcValue::TypeStruct) collect("", tree, known, &stray);
  return stray;
}

void noteKnownParameter(const std::string& name) {
  const std::lock_guard<std::mutex> lock(knownNames().mutex);
  knownNames().names.insert(name);
}

void warnOfStrayParameters(const std::string& ns) {
  XmlRpcValue tree;
  if (!ros::param::get(ns, tree)) return;
  const std::string vehicle = ros::names::parentNamespace(ns);
  for (const StrayKey& stray : strayKeys(tree, knownBelow(ns))) {
    std::string meant = stray.nearest.empty() ? "" : ns + "/" + stray.nearest;
    if (meant.empty()) {
      const std::string elsewhere = nearestKey(lastPart(stray.key), knownBelow(vehicle));
      if (!elsewhere.empty()) meant = ros::names::append(vehicle, elsewhere);
    }
    ROS_WARN_STREAM("parameter " << ns << "/" << stray.key << " is set, but nothing reads it"
                                 << (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
}

}  // namespace external_command
