// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// camera_benchmark WORLD_FILE MODEL_FOLDER...
//
// CPU time on one core of pictures of 640 x 480, as JSON: colour with shadows and noise, depth,
// both at once, and the coloured cloud, from a camera that turns in a world.
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_sim/world.h"

namespace trident::sim {
namespace {

constexpr int kPictures = 60;
constexpr double kRate_hz = 30.0;

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A camera that hovers at 0.3 m and turns once in two seconds.
std::string camera_model() {
  return R"(<sdf version='1.6'><model name='robot'><pose>0 0 0.3 0 0 0</pose><link name='link'>
    <gravity>false</gravity>
    <inertial><mass>1</mass></inertial>
    <sensor name='camera' type='depth'><update_rate>30</update_rate>
      <camera><horizontal_fov>1.0472</horizontal_fov>
        <image><width>640</width><height>480</height><format>R8G8B8</format></image>
        <clip><near>0.05</near><far>20</far></clip>
        <noise><type>gaussian</type><stddev>0.007</stddev></noise>
      </camera>
      <plugin name='camera' filename='libtrident_camera.so'/>
    </sensor></link></model></sdf>)";
}

class CameraWorld {
 public:
  CameraWorld(const std::string& file, const Resources& resources)
      : world_(load(file, resources), resources, registered(registry_), {}) {
    SpawnRequest request;
    request.xml = camera_model();
    Model& robot = world_.spawn(request);
    world_.set_model_twist(robot, {0, 0, 0}, {0, 0, 3.14159});
  }

  /// CPU time of a picture [ms], with what else a step costs taken off.
  double picture_ms(const std::vector<std::string>& ports) {
    const double idle_s = run_s();
    for (const std::string& port : ports) {
      world_.ports().find("camera/" + port, PortDirection::kOut)->add_listener();
    }
    run_s();
    const double busy_s = run_s();
    for (const std::string& port : ports) {
      world_.ports().find("camera/" + port, PortDirection::kOut)->remove_listener();
    }
    return 1e3 * (busy_s - idle_s) / kPictures;
  }

 private:
  static WorldSpec load(const std::string& file, const Resources& resources) {
    const auto warn = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };
    return load_world_file(file, resources, warn);
  }
  static PluginRegistry& registered(PluginRegistry& registry) {
    register_builtin_plugins(registry);
    return registry;
  }
  double run_s() {
    const double begin = thread_cpu_s();
    world_.step(
        static_cast<std::uint64_t>(kPictures / kRate_hz / world_.physics().max_step_size_s));
    return thread_cpu_s() - begin;
  }

  PluginRegistry registry_;
  World world_;
};

int run(int argc, char** argv) {
  if (argc < 2) throw Error("usage: camera_benchmark WORLD_FILE MODEL_FOLDER...");
  const Resources resources(std::vector<std::string>(argv + 2, argv + argc));
  CameraWorld world(argv[1], resources);
  std::printf("{\"pixels\": \"640x480\", \"measured\": \"thread CPU time per picture\"");
  const std::vector<std::pair<const char*, std::vector<std::string>>> cases = {
      {"rgb_ms", {"image_raw"}},
      {"depth_ms", {"depth/image_raw"}},
      {"rgbd_ms", {"image_raw", "depth/image_raw"}},
      {"rgbd_cloud_ms", {"image_raw", "depth/image_raw", "points"}},
      {"segmentation_ms", {"segmentation/image_raw"}}};
  for (const auto& [name, ports] : cases) {
    std::printf(", \"%s\": %.2f", name, world.picture_ms(ports));
    std::fflush(stdout);
  }
  std::printf("}\n");
  return 0;
}

}  // namespace
}  // namespace trident::sim

int main(int argc, char** argv) {
  try {
    return trident::sim::run(argc, argv);
  } catch (const trident::Error& error) {
    std::fprintf(stderr, "camera_benchmark: %s\n", error.what());
    return 1;
  }
}
