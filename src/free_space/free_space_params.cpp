// SPDX-License-Identifier: Apache-2.0
#include "external_command/free_space/free_space_params.h"

#include <algorithm>

#include "external_command/core/error.h"
#include "external_command/core/parameter_range.h"
#include "external_command/core/text.h"
#include "free_space/ompl/first_path.h"

namespace external_command {

const std::vector<std::string>& freeSpacePlanners() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"portfolio", "hybrid_astar"};
    all.insert(all.end(), omplPlannerNames().begin(), omplPlannerNames().end());
    return all;
  }();
  return names;
}

void FreeSpaceParams::validate() const {
  const std::vector<std::string>& names = freeSpacePlanners();
  if (std::find(names.begin(), names.end(), planner) == names.end()) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    throw InvalidParameter(text("planner is \"", planner, "\"; it must be one of ", list));
  }
  requireParameter("margin", margin, 0.0, 5.0);
  requireParameter("time_budget", time_budget, 1e-3, 3600.0);
  requireParameter("improve_budget", improve_budget, 0.0, 3600.0);
  requireParameter("max_iterations", max_iterations, 1, 10'000'000);
  requireParameter("threads", threads, 1, 64);
  requireParameter("gear_change_cost", gear_change_cost, 0.0, 1000.0);
  requireParameter("reverse_factor", reverse_factor, 1.0, 100.0);
  requireParameter("steering_cost", steering_cost, 0.0, 100.0);
  requireParameter("closeness_cost", closeness_cost, 0.0, 100.0);
  requireParameter("closeness_distance", closeness_distance, 0.01, 2.0);
  requireParameter("path_spacing", spacing, 0.01, 1.0);
  requireParameter("manoeuvre_speed", manoeuvre_speed, 0.01, 5.0);
}

}  // namespace external_command
