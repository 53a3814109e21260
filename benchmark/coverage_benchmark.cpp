// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "coverage_fields.h"
#include "external_command/core/error.h"
using namespace external_command;
using namespace external_command::benchmark;
int main(int argc, char** argv) {
  std::vector<FieldCase> fields;
  std::string paths, made; int random = 12; unsigned seed = 1; CoverageParams params; bool make = true;
  for (int i = 1; i < argc; ++i) {
    std::string a = argv[i];
    if (a == "--paths") paths = argv[++i];
    else if (a == "--fields") made = argv[++i];
    else if (a == "--random") random = atoi(argv[++i]);
    else if (a == "--seed") seed = atoi(argv[++i]);
    else if (a == "--laps") params.headland_laps = atoi(argv[++i]);
    else { make = false; for (auto& f : readFields(a)) fields.push_back(f); }
  }
  if (make) fields = makeFields(seed, random);
  for (auto& f : fields) {
    if (!made.empty()) std::ofstream(made + "/" + f.name + ".geojson") << toGeoJson(f);
    params.swath_width = f.swath_width;
    const auto c0 = std::clock();
    try {
      auto r = CoveragePlanner(f.vehicle, params).plan(f.area(), f.start, {}, {});
      printf("%-34s cover %.4f len %8.0f swaths %3zu goal %.1f cpu %.3f warn %zu\n", f.name.c_str(), r.coverage_ratio, r.length, r.swaths.size(), r.reachable_area, double(std::clock()-c0)/CLOCKS_PER_SEC, r.warnings.size());
      for (auto& w : r.warnings) printf("   %s\n", w.c_str());
      if (!paths.empty()) { std::ofstream o(paths + "/" + f.name + ".json"); o.precision(12); o << "["; bool c = false; for (auto& p : r.path) { o << (c ? "," : "") << "[" << p.x << "," << p.y << "," << p.heading << "," << int(p.direction) << "," << int(p.tool_on) << "]"; c = true; } o << "]"; }
    } catch (const Error& e) { printf("%-34s FAILED %s\n", f.name.c_str(), e.what()); }
    fflush(stdout);
  }
}
