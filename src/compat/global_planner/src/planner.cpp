// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "navfn/MakeNavPlan.h"
#include "trident_nav_ros/planner_node.h"

int main(int argc, char** argv) {
  return trident::nav::planner_main<navfn::MakeNavPlan>(argc, argv, "global_planner",
                                                        "global_planner/GlobalPlanner", "planner");
}
