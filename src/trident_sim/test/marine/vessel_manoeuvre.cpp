// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// vessel_manoeuvre VESSEL.yaml circle|zigzag LEFT RIGHT DURATION [munk=0|1] [dt=0.01]
// [springs=FILE]
//
// Moves a boat with two propellers at the commands LEFT and RIGHT; zigzag exchanges them whenever
// the heading has gone 20 degrees to either side. `springs`: 36 numbers of a stiffness matrix about
// CO, FLU, in place of the hull. Prints t, x, y, z, roll, pitch, yaw, u, v, w, p, q, r per step
// (REP 103).
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "marine/vessel/thruster.h"
#include "standalone_vessel.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

struct Options {
  std::string vessel, manoeuvre;
  double left = 0.0, right = 0.0, duration_s = 0.0;
  std::map<std::string, std::string> more;
};

Options parse(int argc, char** argv) {
  if (argc < 6)
    throw Error("usage: vessel_manoeuvre VESSEL.yaml circle|zigzag LEFT RIGHT DURATION");
  Options options{argv[1], argv[2], std::stod(argv[3]), std::stod(argv[4]), std::stod(argv[5]), {}};
  for (int i = 6; i < argc; ++i) {
    const std::string item = argv[i];
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos) throw Error("not NAME=VALUE: " + item);
    options.more[item.substr(0, equals)] = item.substr(equals + 1);
  }
  return options;
}

Matrix6d read_springs(const std::string& file) {
  std::ifstream stream(file);
  Matrix6d springs;
  for (int i = 0; i < 36; ++i) {
    if (!(stream >> springs(i / 6, i % 6))) throw Error(file + ": not 36 numbers");
  }
  return springs;
}

void print(const StandaloneVessel& boat) {
  const SE3 T = boat.T_world_co();
  const Eigen::Vector3d rpy = T.rpy();
  const Vector6d nu = boat.nu();
  std::printf("%.9g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g", boat.time_s(), T.p.x(), T.p.y(), T.p.z(),
              rpy.x(), rpy.y(), rpy.z());
  for (int i = 0; i < 6; ++i) std::printf(",%.12g", nu[i]);
  std::printf("\n");
}

void run(const Options& options) {
  VesselParams params = load_vessel(options.vessel);
  if (options.more.count("munk") > 0) params.munk = options.more.at("munk") == "1";
  const double dt = options.more.count("dt") > 0 ? std::stod(options.more.at("dt")) : 0.01;
  const bool linear = options.more.count("springs") > 0;
  StandaloneVessel boat(params, linear ? Restoring::kLinear : Restoring::kHull);
  if (linear) {
    boat.set_springs(read_springs(options.more.at("springs")));
  } else {
    boat.set_at_rest();
  }
  Thruster left(params.thrusters.at(0)), right(params.thrusters.at(1));
  constexpr double kTurn = deg_to_rad(20.0);
  double side = 1.0;
  print(boat);
  const auto steps = static_cast<int>(options.duration_s / dt + 0.5);
  for (int i = 0; i < steps; ++i) {
    if (options.manoeuvre == "zigzag" && side * boat.T_world_co().rpy().z() >= kTurn) side = -side;
    left.command(side > 0.0 ? options.left : options.right);
    right.command(side > 0.0 ? options.right : options.left);
    left.step(dt);
    right.step(dt);
    boat.step(left.wrench() + right.wrench(), dt);
    print(boat);
  }
}

}  // namespace
}  // namespace trident::sim

int main(int argc, char** argv) {
  try {
    trident::sim::run(trident::sim::parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "vessel_manoeuvre: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
