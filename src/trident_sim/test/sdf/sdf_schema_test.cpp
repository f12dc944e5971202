// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sdf/sdf_schema.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <thread>

#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

const char kModel[] =
    "<model name='crate'><pose>1 2 3 0 0 0</pose><link "
    "name='link'><inertial><mass>2</mass></inertial>"
    "<visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual>"
    "<collision name='c'><geometry><box><size>1 2 "
    "3</size></box></geometry></collision></link></model>";

std::string in_world(const std::string& content) {
  return "<sdf version='1.6'><world name='w'>" + content + "</world></sdf>";
}

std::string describe(const sdf::ParamPtr& param) {
  if (!param) return "none";
  return param->GetKey() + "|" + param->GetTypeName() + "|" + param->GetDefaultAsString() + "|" +
         param->GetAsString() + "|" + std::to_string(param->GetRequired()) + "|" +
         param->GetMinValueAsString().value_or("-") + "|" +
         param->GetMaxValueAsString().value_or("-") + "|" + param->GetDescription();
}

std::string describe(const sdf::Element& element) {
  std::string text = element.GetName() + " " + element.GetRequired() + " " +
                     std::to_string(element.GetCopyChildren()) + " " + element.ReferenceSDF() +
                     " " + element.GetDescription() + " " + describe(element.GetValue());
  for (unsigned int i = 0; i < element.GetAttributeCount(); ++i) {
    text += "\n@" + describe(element.GetAttribute(i));
  }
  return text;
}

/// Compares all of the schema, except for what is missing and on the list; counts descriptions.
void expect_same(const sdf::Element& actual, const sdf::Element& expected, const std::string& path,
                 const std::set<std::string>& left_out, int& count) {
  ++count;
  ASSERT_EQ(describe(actual), describe(expected)) << path;
  unsigned int next = 0;
  for (unsigned int i = 0; i < expected.GetElementDescriptionCount(); ++i) {
    const sdf::Element& wanted = *expected.GetElementDescription(i);
    if (left_out.count(wanted.GetName()) > 0) {
      EXPECT_TRUE(wanted.GetRequired() == "0" || wanted.GetRequired() == "*") << wanted.GetName();
      EXPECT_FALSE(actual.HasElementDescription(wanted.GetName())) << path;
      continue;
    }
    ASSERT_LT(next, actual.GetElementDescriptionCount()) << path;
    expect_same(*actual.GetElementDescription(next++), wanted, path + "/" + wanted.GetName(),
                left_out, count);
  }
  EXPECT_EQ(next, actual.GetElementDescriptionCount()) << path;
}

sdf::SDFPtr libsdformat_schema() {
  auto document = std::make_shared<sdf::SDF>();
  sdf::init(document);
  return document;
}

TEST(SdfSchema, IsTheOneOfLibsdformat) {
  int count = 0;
  expect_same(
      *make_document("<actor><heightmap><light><particle_emitter><population><sensor><state>")
           ->Root(),
      *libsdformat_schema()->Root(), "", {}, count);
  EXPECT_GT(count, 5000);
}

TEST(SdfSchema, LeavesOutOptionalPartsThatTheTextDoesNotHave) {
  int count = 0;
  expect_same(*make_document(in_world(kModel))->Root(), *libsdformat_schema()->Root(), "",
              {"actor", "heightmap", "light", "particle_emitter", "population", "sensor", "state"},
              count);
  EXPECT_LT(count, 1500);
}

TEST(SdfSchema, DocumentsDoNotShareWhatIsReadIntoThem) {
  const sdf::SDFPtr first = make_document(kModel), second = make_document(kModel);
  sdf::Errors errors;
  ASSERT_TRUE(sdf::readString(in_world(kModel), first, errors));
  EXPECT_TRUE(first->Root()->HasElement("world"));
  EXPECT_FALSE(second->Root()->HasElement("world"));
}

std::string sensors_of(const std::string& model) {
  auto document = make_document(model);
  sdf::Errors errors;
  EXPECT_TRUE(sdf::readString(model, document, errors));
  sdf::Root root;
  EXPECT_TRUE(root.Load(document).empty());
  const sdf::Sensor* sensor = root.Model()->LinkByIndex(0)->SensorByIndex(0);
  return sensor == nullptr ? "none"
                           : sensor->TypeStr() + " " + std::to_string(sensor->UpdateRate());
}

TEST(SdfSchema, PartsThatTheTextHasAreRead) {
  const std::string begin = "<sdf version='1.6'><model name='m'><link name='l'>";
  const std::string end = "</link></model></sdf>";
  EXPECT_EQ(
      sensors_of(begin + "<sensor name='s' type='imu'><update_rate>7</update_rate></sensor>" + end),
      "imu 7.000000");
  EXPECT_EQ(sensors_of(begin + end), "none");
}

/// Folders of model://crate and model://sun.
class SdfInclude : public testing::Test {
 protected:
  SdfInclude() {
    add("crate", kModel);
    add("sun", "<light name='sun' type='directional'/>");
  }
  void add(const std::string& name, const std::string& content) {
    folder_.write(name + "/model.config",
                  "<model><name>" + name + "</name><sdf version='1.6'>model.sdf</sdf></model>");
    folder_.write(name + "/model.sdf", "<sdf version='1.6'>" + content + "</sdf>");
  }
  WorldSpec load(const std::string& content) {
    warnings_.clear();
    return load_world_string(in_world(content), "test.world", Resources({folder_.path()}),
                             [this](const std::string& text) { warnings_.push_back(text); });
  }

  const ScratchFolder folder_;
  std::vector<std::string> warnings_;
};

const char kCrate[] = "<include><uri>model://crate</uri></include>";
const char kSun[] = "<include><uri>model://sun</uri></include>";

TEST_F(SdfInclude, APlainOneGivesWhatLibsdformatMakesOfIt) {
  const WorldSpec plain = load(std::string(kSun) + kCrate);
  EXPECT_TRUE(warnings_.empty());
  // With a name, libsdformat does it.
  const WorldSpec named =
      load(std::string(kSun) + "<include><uri>model://crate</uri><name>crate</name></include>");
  for (const WorldSpec& world : {plain, named}) {
    ASSERT_EQ(world.models.size(), 1u);
    EXPECT_EQ(world.models[0].name, "crate");
    EXPECT_FALSE(world.models[0].is_static);
    EXPECT_TRUE(is_near(world.models[0].T_world_model, at(1, 2, 3), 1e-12));
    ASSERT_EQ(world.models[0].links.size(), 1u);
    EXPECT_DOUBLE_EQ(world.models[0].links[0].inertial.mass_kg, 2.0);
    EXPECT_EQ(std::get<BoxShape>(world.models[0].links[0].collisions[0].shape).size,
              Eigen::Vector3d(1, 2, 3));
  }
}

TEST_F(SdfInclude, FramesReferToIncludedModels) {
  const WorldSpec world = load(std::string(kCrate) +
                               "<frame name='f' attached_to='crate'/><include>"
                               "<uri>model://sun</uri></include>");
  ASSERT_EQ(world.models.size(), 1u);
}

TEST_F(SdfInclude, OneThatIsMissingIsReportedOnceAndOthersAreThere) {
  const WorldSpec world =
      load(std::string(kCrate) + "<include><uri>model://absent</uri></include>" + kSun);
  EXPECT_EQ(world.models.size(), 1u);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(contains(warnings_[0], "model://absent"));
}

TEST_F(SdfInclude, ErrorsOfTheIncludedFileStopTheLoad) {
  add("broken", "<model name='m'><link/></model>");
  const std::string error = error_of([&] { load("<include><uri>model://broken</uri></include>"); });
  EXPECT_TRUE(contains(error, "broken/model.sdf")) << error;
}

TEST_F(SdfInclude, TwoOfAKindClash) {
  const std::string error = error_of([&] { load(std::string(kCrate) + kCrate); });
  EXPECT_TRUE(contains(error, "crate")) << error;
}

TEST_F(SdfInclude, ModelsKeepTheirOrder) {
  add("barrel", std::string(kModel).replace(13, 5, "cask_"));
  const WorldSpec world =
      load(std::string(kCrate) + "<include><uri>model://barrel</uri></include>");
  ASSERT_EQ(world.models.size(), 2u);
  EXPECT_EQ(world.models[0].name, "crate");
  EXPECT_EQ(world.models[1].name, "cask_");
}

TEST_F(SdfInclude, LoadsFromManyThreads) {
  const std::string urdf =
      "<robot name='r'><link name='l'><inertial><mass value='3'/><inertia "
      "ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
      "</robot>";
  const Resources resources({folder_.path()});
  std::array<double, 4> masses{};
  std::vector<std::thread> threads;
  for (double& mass : masses) {
    threads.emplace_back([&] {
      const ModelSpec model = load_model_string(urdf, "r", resources, [](const std::string&) {});
      mass = model.links.at(0).inertial.mass_kg;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double mass : masses) EXPECT_DOUBLE_EQ(mass, 3.0);
}

}  // namespace
}  // namespace trident::sim
