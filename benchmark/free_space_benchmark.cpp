// SPDX-License-Identifier: Apache-2.0
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "external_command/core/error.h"
#include "external_command/free_space/free_space_planner.h"
using namespace external_command;
namespace pt = boost::property_tree;
static std::vector<double> nums(const pt::ptree& t) { std::vector<double> v; for (auto& c : t) v.push_back(c.second.get_value<double>()); return v; }
int main(int argc, char** argv) {
  FreeSpaceParams params; params.margin = 0.01; params.time_budget = 1; params.improve_budget = 10; params.improve_iterations = 0;
  std::vector<std::string> files; std::string out; double total=1;
  for (int i = 1; i < argc; ++i) {
    std::string a = argv[i];
    if (a == "--margin") params.margin = atof(argv[++i]);
    else if (a == "--improve") params.improve_budget = atof(argv[++i]);
    else if (a == "--time-budget") params.time_budget = atof(argv[++i]);
    else if (a == "--seed") params.seed = atoi(argv[++i]);
    else if (a == "--paths") out = argv[++i];
    else if (std::filesystem::is_directory(a)) { for (auto& e : std::filesystem::directory_iterator(a)) if (e.path().extension() == ".json" && e.path().stem() != "best_known") files.push_back(e.path()); }
    else files.push_back(a);
  }
  std::sort(files.begin(), files.end());
  pt::ptree best; try { pt::read_json("/work/shared/data/parking/best_known.json", best); } catch (...) {}
  std::vector<double> tfirst, rfirst, rfinal; int ok = 0;
  for (auto& f : files) {
    pt::ptree t; pt::read_json(f, t);
    VehicleParams v; v.wheelbase = t.get<double>("vehicle.wheelbase"); v.width = t.get<double>("vehicle.width"); v.front_overhang = t.get<double>("vehicle.front_overhang"); v.rear_overhang = t.get<double>("vehicle.rear_overhang"); v.min_turning_radius = t.get<double>("vehicle.min_turning_radius");
    auto s = nums(t.get_child("start")), g = nums(t.get_child("goal")), b = nums(t.get_child("bounds"));
    const auto t0 = std::chrono::steady_clock::now();
    Region::Parts parts; const double ox=std::round(g[0]), oy=std::round(g[1]); parts.axle_bounds = BoundingBox{{b[0]-ox, b[1]-oy}, {b[2]-ox, b[3]-oy}};
    for (auto& o : t.get_child("obstacles")) { std::vector<Point2d> p; for (auto& q : o.second) { auto n = nums(q.second); p.push_back({n[0]-ox, n[1]-oy}); } parts.non_drivable.emplace_back(p, "obstacle"); }
    Region region(parts); 
    const double tr = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
    std::string name = std::filesystem::path(f).stem();
    try {
      FreeSpacePlanner planner(v, params);
      auto r = planner.plan({s[0]-ox, s[1]-oy, s[2]}, {{g[0]-ox, g[1]-oy, g[2]}}, region, {});
      double bk = best.get<double>(name + ".cost", 0);
      ok++; tfirst.push_back(r.first_path_time); if (bk > 0) rfirst.push_back(r.first_path_cost / bk), rfinal.push_back(r.cost / bk);
      printf("%-28s first %7.2f ms cost %6.2f (%.3f)  final %6.2f (%.3f) gears %u  region %.2f ms\n", name.c_str(), 1e3 * r.first_path_time, r.first_path_cost, r.first_path_cost / bk, r.cost, r.cost / bk, r.gear_changes, 1e3*tr);
      if (!out.empty()) { std::ofstream o(out + "/" + name + ".json"); o.precision(17); o << "["; bool c = false; for (auto& p : r.path) { o << (c ? "," : "") << "[" << p.x+ox << "," << p.y+oy << "," << p.heading << "," << int(p.direction) << "]"; c = true; } o << "]"; }
    } catch (const Error& e) { printf("%-28s FAILED %s\n", name.c_str(), e.what()); }
    fflush(stdout);
  }
  auto med = [](std::vector<double> v) { if (v.empty()) return 0.0; std::sort(v.begin(), v.end()); return v[v.size() / 2]; };
  printf("solved %d/%zu; first median %.2f ms max %.2f ms; ratio first median %.3f, final %.3f max %.3f\n", ok, files.size(), 1e3 * med(tfirst), tfirst.empty()?0:1e3 * *std::max_element(tfirst.begin(), tfirst.end()), med(rfirst), med(rfinal), rfinal.empty()?0:*std::max_element(rfinal.begin(), rfinal.end()));
}
