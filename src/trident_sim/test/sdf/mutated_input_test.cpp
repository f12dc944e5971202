// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Damaged SDF and URDF: each is loaded, and stepped if it loads, or refused with an Error; nothing
// else may happen. TRIDENT_MUTATIONS says how many there are (default 1500). The input at work is
// in mutated_input.xml of the working folder, for the case that the program ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "test_world.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {
namespace {

// A model of every kind of element that the loader reads.
const char* const kModel = R"(<sdf version='1.6'><model name='m'><pose>0 0 1 0 0 0.1</pose>
<link name='base'><inertial><mass>1.5</mass><inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.03</izz>
<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
<collision name='c'><geometry><box><size>0.2 0.3 0.1</size></box></geometry><surface><friction><ode>
<mu>0.8</mu><mu2>0.5</mu2><slip1>0.1</slip1><fdir1>1 0 0</fdir1></ode></friction><bounce>
<restitution_coefficient>0.2</restitution_coefficient><threshold>0.1</threshold></bounce><contact><ode>
<kp>1e6</kp><kd>100</kd><min_depth>0.001</min_depth><max_vel>0.1</max_vel></ode></contact></surface>
</collision><collision name='s'><pose>0 0 0.2 0 0 0</pose><geometry><sphere><radius>0.1</radius></sphere>
</geometry></collision></link>
<link name='arm'><pose>0.3 0 0 0 0 0</pose><inertial><mass>0.2</mass><inertia><ixx>0.001</ixx>
<iyy>0.001</iyy><izz>0.001</izz></inertia></inertial><collision name='c'><geometry><cylinder>
<radius>0.05</radius><length>0.3</length></cylinder></geometry></collision></link>
<joint name='j' type='revolute'><parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz><limit>
<lower>-1</lower><upper>1</upper><effort>10</effort><velocity>5</velocity></limit><dynamics>
<damping>0.01</damping><friction>0.001</friction><spring_reference>0.1</spring_reference>
<spring_stiffness>0.2</spring_stiffness></dynamics></axis><physics><ode><limit><erp>0.3</erp><cfm>0</cfm>
</limit></ode></physics></joint>
<link name='b'><pose>0 0 1 0 0 0</pose></link><link name='c'><pose>1 0 1 0 0 0</pose></link>
<joint name='b' type='ball'><parent>base</parent><child>b</child><pose>0 0 -0.5 0 0 0</pose></joint>
<joint name='u' type='universal'><parent>b</parent><child>c</child><axis><xyz>1 0 0</xyz></axis>
<axis2><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis2></joint>
<link name='d'><pose>0 1 1 0 0 0</pose></link><joint name='s' type='screw'><parent>arm</parent><child>d
</child><thread_pitch>20</thread_pitch><axis><xyz>0 0 1</xyz></axis></joint>
<joint name='g' type='gearbox'><parent>arm</parent><child>c</child><gearbox_ratio>2</gearbox_ratio>
<gearbox_reference_body>base</gearbox_reference_body><axis><xyz>0 0 1</xyz></axis><axis2><xyz>1 0 0</xyz>
</axis2></joint><plugin name='drive' filename='libtrident_joint_drive.so'><jointName>j</jointName>
<mode>position</mode><p>1</p><i>0.1</i><d>0.01</d><effortLimit>2</effortLimit></plugin>
<plugin name='odometry' filename='librotors_gazebo_odometry_plugin.so'><robotNamespace>m</robotNamespace>
<linkName>base</linkName><odometryTopic>odometry</odometryTopic><measurementDelay>1</measurementDelay>
<measurementDivisor>1</measurementDivisor><noiseNormalPosition>0 0 0</noiseNormalPosition></plugin>
<plugin name='wind' filename='librotors_gazebo_wind_plugin.so'><robotNamespace>m</robotNamespace>
<linkName>base</linkName><windDirection>1 0 0</windDirection><windForceMean>0.1</windForceMean></plugin>
</model></sdf>)";

const char* const kUrdf = R"(<robot name='r'><link name='base'><inertial><mass value='1.2'/>
<origin xyz='0 0 0.01' rpy='0 0 0'/><inertia ixx='0.01' iyy='0.01' izz='0.02' ixy='0' ixz='0' iyz='0'/>
</inertial><collision><geometry><box size='0.2 0.2 0.1'/></geometry></collision><visual><geometry>
<sphere radius='0.1'/></geometry></visual></link><link name='rotor'><inertial><mass value='0.01'/>
<inertia ixx='1e-5' iyy='1e-5' izz='2e-5' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='j' type='continuous'><origin xyz='0.2 0 0.05'/><axis xyz='0 0 1'/><parent link='base'/>
<child link='rotor'/><limit effort='2000' velocity='838'/></joint><gazebo reference='base'>
<mu1>0.9</mu1></gazebo><gazebo><plugin name='motor' filename='librotors_gazebo_motor_model.so'>
<robotNamespace>r</robotNamespace><jointName>j</jointName><linkName>rotor</linkName>
<turningDirection>ccw</turningDirection><timeConstantUp>0.0125</timeConstantUp>
<timeConstantDown>0.025</timeConstantDown><maxRotVelocity>838</maxRotVelocity>
<motorConstant>8.5e-06</motorConstant><momentConstant>0.016</momentConstant>
<commandSubTopic>gazebo/command/motor_speed</commandSubTopic><motorNumber>0</motorNumber>
<rotorDragCoefficient>8e-05</rotorDragCoefficient><rollingMomentCoefficient>1e-06</rollingMomentCoefficient>
<motorSpeedPubTopic>motor_speed/0</motorSpeedPubTopic><rotorVelocitySlowdownSim>10</rotorVelocitySlowdownSim>
</plugin></gazebo></robot>)";

const char* const kWorld = R"(<sdf version='1.4'><world name='w'><physics type='ode'>
<max_step_size>0.01</max_step_size><real_time_factor>1</real_time_factor><gravity>0 0 -9.8</gravity>
<ode><solver><type>quick</type><iters>50</iters><sor>1.3</sor></solver><constraints><cfm>0</cfm>
<erp>0.2</erp><contact_max_correcting_vel>10</contact_max_correcting_vel>
<contact_surface_layer>0.01</contact_surface_layer></constraints></ode></physics>
<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane>
<normal>0 0 1</normal><size>10 10</size></plane></geometry></collision></link></model>
<model name='ball'><pose>0 0 0.5 0 0 0</pose><link name='l'><inertial><mass>1</mass></inertial>
<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model>
</world></sdf>)";

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string operator()(std::string text) {
    for (std::size_t i = below(4) + 1; i > 0 && !text.empty(); --i) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t bound) {
    return bound == 0 ? 0 : static_cast<std::size_t>(random_() % bound);
  }
  const char* any_value() {
    static constexpr const char* kValues[] = {"nan",
                                              "inf",
                                              "-inf",
                                              "-1",
                                              "0",
                                              "1e308",
                                              "-1e308",
                                              "1e-320",
                                              "",
                                              "abc",
                                              "1 2",
                                              "0 0 0",
                                              "1 2 3 4 5 6 7 8 9",
                                              "99999999999999999999",
                                              "true",
                                              "base",
                                              "m::base",
                                              "__model__",
                                              "../x",
                                              "model://no",
                                              "package://no/x.dae",
                                              "\xff\xfe",
                                              "&lt;",
                                              "<x/>",
                                              "world"};
    return kValues[below(std::size(kValues))];
  }
  // The text between two tags or two quotes, from some place on.
  void replace_value(std::string& text) {
    const std::size_t from = below(text.size());
    const char* const ends = below(2) == 0 ? "><" : "''";
    const std::size_t begin = text.find(ends[0], from);
    if (begin == std::string::npos) return;
    const std::size_t end = text.find(ends[1], begin + 1);
    if (end != std::string::npos) text.replace(begin + 1, end - begin - 1, any_value());
  }
  // A segment from one tag to another.
  std::pair<std::size_t, std::size_t> segment(const std::string& text) {
    const std::size_t begin = text.find('<', below(text.size()));
    if (begin == std::string::npos) return {0, 0};
    std::size_t end = begin;
    for (std::size_t i = below(8) + 1; i > 0 && end != std::string::npos; --i) {
      end = text.find('<', end + 1);
    }
    return {begin, end == std::string::npos ? text.size() : end};
  }
  void change(std::string& text) {
    const auto [begin, end] = segment(text);
    switch (below(8)) {
      case 0:
        text[below(text.size())] = static_cast<char>(random_());
        break;
      case 1:
        text.resize(below(text.size()));
        break;
      case 2:
        text.erase(begin, end - begin);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(begin, end - begin));
        break;
      case 4:
        text.insert(begin, text.substr(begin, end - begin));
        break;
      default:
        replace_value(text);
    }
  }
  std::mt19937_64 random_;
};

void load_and_step(const std::string& text, bool is_world) {
  const auto ignore = [](const auto&...) {};
  const Resources resources;
  PluginRegistry registry;
  register_builtin_plugins(registry);
  WorldOptions options;
  options.report = ignore;
  const WorldSpec spec =
      load_world_string(is_world ? text : kWorld, "mutated.world", resources, ignore);
  World world(spec, resources, registry, options);
  if (!is_world) world.spawn(load_model_string(text, "mutated.xml", resources, ignore), "");
  world.step(3);
  world.state_hash();
}

TEST(MutatedInput, IsLoadedOrRefusedWithAnError) {
  const char* wanted = std::getenv("TRIDENT_MUTATIONS");
  const std::uint64_t count = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 1500;
  const char* const seeds[] = {kModel, kUrdf, kWorld};
  std::uint64_t loaded = 0, refused = 0;
  for (const char* seed : seeds) ASSERT_NO_THROW(load_and_step(seed, seed == kWorld));
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* const seed = seeds[i % std::size(seeds)];
    const std::string text = Mutator(i)(seed);
    std::ofstream("mutated_input.xml", std::ios::binary) << text;
    try {
      load_and_step(text, seed == kWorld);
      ++loaded;
    } catch (const Error& error) {
      ++refused;
      ASSERT_FALSE(std::string(error.what()).empty()) << "mutation " << i << ":\n" << text;
    } catch (const std::exception& error) {
      FAIL() << "mutation " << i << " leaks " << error.what() << "\n" << text;
    }
  }
  std::printf("%llu mutations: %llu loaded, %llu refused\n", static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(loaded), static_cast<unsigned long long>(refused));
  // Both branches are taken, or the mutations test nothing.
  EXPECT_GT(loaded, count / 20);
  EXPECT_GT(refused, count / 20);
}

}  // namespace
}  // namespace trident::sim
