// SPDX-License-Identifier: Apache-2.0
#include "external_command_process_component.h"

#include <ros/names.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <pluginlib/class_loader.hpp>
#include <set>

#include "external_command/core/text.h"
#include "external_command/ros/parameter_check.h"

namespace external_command {

namespace {

/// "my_package/SortParcelsProcessor" -> "sort_parcels_processor".
std::string nodeletNameOf(const std::string& type) {
  std::string name;
  for (const char c : type.substr(type.rfind('/') + 1)) {
    const bool is_upper = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (is_upper && !name.empty() && name.back() != '_') name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

/// Why pluginlib does not know `type`; empty where it does.
std::string whyUnknown(const std::string& type) {
  pluginlib::ClassLoader<nodelet::Nodelet> classes("nodelet", "nodelet::Nodelet");
  if (classes.isClassAvailable(type)) return "";
  std::string known;
  for (const std::string& name : classes.getDeclaredClasses()) {
    if (name.find("Processor") != std::string::npos) known += (known.empty() ? "" : ", ") + name;
  }
  return text("no nodelet plug-in declares the class ", type, "; declared processors: ", known,
              ". Is its package built, and its setup.bash sourced?");
}

/// The library that declares `type`, as the file of declarations names it; empty where it names none.
std::string libraryOf(const std::string& type, const std::string& declarations) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(declarations.c_str()) != tinyxml2::XML_SUCCESS) return "";
  const tinyxml2::XMLElement* library = document.RootElement();  // or a list of them
  if (library->Attribute("path") == nullptr) library = library->FirstChildElement("library");
  for (; library != nullptr; library = library->NextSiblingElement("library")) {
    for (auto entry = library->FirstChildElement("class"); entry; entry = entry->NextSiblingElement("class")) {
      if (entry->Attribute("name", type.c_str()) == nullptr) continue;
      const char* const path = library->Attribute("path");
      return path == nullptr ? "" : path;
    }
  }
  return "";
}

/// What pluginlib is silent about in some versions: which library it looked for.
std::string whyNotLoaded(const std::string& type) {
  const std::string declarations =
      pluginlib::ClassLoader<nodelet::Nodelet>("nodelet", "nodelet::Nodelet").getPluginManifestPath(type);
  return text("nodelet could not load it from the library ", libraryOf(type, declarations), ", which ", declarations,
              " names; the lines above tell why. Is the library built and installed?");
}

}  // namespace

ExternalCommandProcessComponent::ExternalCommandProcessComponent() : loader_(false) {}

ExternalCommandProcessComponent::~ExternalCommandProcessComponent() = default;

void ExternalCommandProcessComponent::start() {
  noteKnownParameter(parameters().nameOf("num_worker_threads"));  // nodelet's own
  std::vector<std::string> processors, more;
  XmlRpc::XmlRpcValue value;
  if (!parameters().raw("processors", &value)) {
    throw InvalidParameter(text("parameter ", parameters().nameOf("processors"),
                                " is not set: nothing would be served. ",
                                "external_command_process.launch loads it from config/processors.yaml"));
  }
  parameters().read("processors", &processors);
  parameters().read("more_processors", &more);
  processors.insert(processors.end(), more.begin(), more.end());
  loadProcessors(processors);
}

void ExternalCommandProcessComponent::open() {
  command_services_ = std::make_unique<CommandServices>(getNodeHandle(), parameters(), contextPtr());
  map_services_ = std::make_unique<MapServices>(getNodeHandle(), parameters(), contextPtr());
  tellWhatIsServed();
}

void ExternalCommandProcessComponent::tellWhatIsServed() {
  static const std::set<std::string> kOfEveryNode = {"get_loggers", "set_logger_level", "load_nodelet",
                                                     "unload_nodelet", "list"};
  std::string names;
  for (const std::string& service : context().masterWatch().services()) {
    if (kOfEveryNode.count(service.substr(service.rfind('/') + 1)) != 0) continue;
    names += (names.empty() ? "" : ", ") + service;
  }
  const std::string& map = context().params().map_file;
  ROS_INFO_STREAM(getName() << " is ready, " << (map.empty() ? "without a map" : "with the map " + map)
                            << "; this process serves " << names);
}

void ExternalCommandProcessComponent::loadProcessors(const std::vector<std::string>& processors) {
  bool require_all = true;
  parameters().read("require_all", &require_all);
  std::string failures;
  const auto fail = [&](const std::string& what) {
    ROS_ERROR_STREAM(getName() << ": " << what);
    failures += (failures.empty() ? "" : "; ") + what;
  };
  if (processors.empty()) fail(parameters().nameOf("processors") + " is empty; name at least one processor");
  std::set<std::string> seen;
  for (const std::string& type : processors) {
    const bool is_new = seen.insert(type).second;
    const std::string reason = is_new ? load(type) : "it is listed twice";
    if (!reason.empty()) fail(text("processor ", type, " did not start: ", reason));
  }
  if (failures.empty() || !require_all) return;
  throw InternalError(failures + " (set ~require_all to false to start with the others)");
}

std::string ExternalCommandProcessComponent::load(const std::string& type) {
  const std::string unknown = whyUnknown(type);
  if (!unknown.empty()) return unknown;
  // Beside the component, not below it: the same relative names then mean the same however a processor is loaded.
  const std::string name = ros::names::append(ros::names::parentNamespace(getName()), nodeletNameOf(type));
  context().masterWatch().keepParameters(name);
  try {
    if (loader_.load(name, type, getRemappingArgs(), getMyArgv())) return "";
  } catch (const std::exception& error) {
    return error.what();  // of the constructor
  }
  const std::string reason = startFailureOf(name);
  return reason.empty() ? whyNotLoaded(type) : reason;
}

}  // namespace external_command
