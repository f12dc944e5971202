// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Documents that include others, themselves, or too much.
#include <gtest/gtest.h>

#include "core/sdf/sdf_includes.h"
#include "core/sdf/xml_cut.h"
#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

class SdfSourcesTest : public testing::Test {
 protected:
  /// A model of a link and of includes of others, one per line from line 2.
  void write(const std::string& name, const std::vector<std::string>& included) {
    folder_.write(name + "/model.config",
                  "<model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
    std::string text = "<sdf version='1.6'><model name='" + name + "'>\n";
    int number = 0;
    for (const std::string& other : included) {
      text += "<include><uri>model://" + other + "</uri><name>n" + std::to_string(number++) +
              "</name></include>\n";
    }
    folder_.write(name + "/model.sdf",
                  text +
                      "<link name='l'><visual name='v'><geometry><sphere><radius>1</radius>"
                      "</sphere></geometry></visual></link></model></sdf>");
  }
  ModelSpec load(const std::string& name, OddElements odd) {
    const std::string xml = "<sdf version='1.6'><model name='m'>\n<include><uri>model://" + name +
                            "</uri></include><link name='l'/></model></sdf>";
    return load_model_string(
        xml, "top.sdf", Resources({folder_.path()}), [](const auto&) {}, odd);
  }
  std::string file(const std::string& name) const {
    return folder_.path() + "/" + name + "/model.sdf";
  }

  ScratchFolder folder_;
};

TEST_F(SdfSourcesTest, AModelThatIncludesItselfIsReportedWithItsLine) {
  write("snake", {"snake"});
  const std::string expected =
      file("snake") + ":2: <include> of 'model://snake' leads back to itself";
  EXPECT_TRUE(contains(error_of([&] { load("snake", OddElements::kRefuse); }), expected));
  const ModelSpec model = load("snake", OddElements::kLeaveOut);
  ASSERT_EQ(model.odd_elements.size(), 1u);
  EXPECT_TRUE(contains(model.odd_elements[0], expected));
  EXPECT_EQ(model.links.size(), 2u);
}

TEST_F(SdfSourcesTest, SoAreModelsThatIncludeEachOther) {
  write("a", {"b"});
  write("b", {"c"});
  write("c", {"a"});
  EXPECT_TRUE(contains(error_of([&] { load("a", OddElements::kRefuse); }),
                       file("c") + ":2: <include> of 'model://a' leads back to itself"));
  EXPECT_EQ(load("a", OddElements::kLeaveOut).links.size(), 4u);
}

/// libsdformat finds files by their whole path without asking, and reads them itself where a model
/// is in error, here without a link.
TEST_F(SdfSourcesTest, SoIsOneThatNamesItselfByItsWholePath) {
  const std::string path = folder_.path() + "/self.sdf";
  for (const std::string& uri : {path, "file://" + path}) {
    folder_.write("self.sdf", "<sdf version='1.6'><model name='a'>\n<include><uri> " + uri +
                                  " </uri></include></model></sdf>");
    const std::string xml =
        "<sdf version='1.6'><world name='w'>\n<include><uri>" + uri +
        "</uri></include><model name='m'><link name='l'/></model></world></sdf>";
    const auto load = [&](OddElements odd) {
      return load_world_string(
          xml, "top.world", Resources(), [](const auto&) {}, odd);
    };
    EXPECT_TRUE(contains(error_of([&] { load(OddElements::kRefuse); }),
                         path + ":2: <include> of '" + uri + "' leads back to itself"));
    const WorldSpec world = load(OddElements::kLeaveOut);
    ASSERT_FALSE(world.odd_elements.empty());
    EXPECT_TRUE(contains(world.odd_elements[0], "' leads back to itself"));
    EXPECT_EQ(world.models.back().name, "m");
  }
}

TEST_F(SdfSourcesTest, AModelWhoseFileIsNotThereIsReportedAsThat) {
  folder_.write("dock/model.config",
                "<model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
  const ModelSpec model = load("dock", OddElements::kLeaveOut);
  ASSERT_EQ(model.odd_elements.size(), 1u);
  EXPECT_TRUE(contains(model.odd_elements[0], "top.sdf:2: <include> of 'model://dock': " +
                                                  file("dock") + " does not exist; left out"));
}

TEST_F(SdfSourcesTest, IncludesInEachOtherHaveALimit) {
  for (int i = 0; i < 50; ++i) write("m" + std::to_string(i), {"m" + std::to_string(i + 1)});
  write("m50", {});
  const std::string error = error_of([&] { load("m0", OddElements::kRefuse); });
  EXPECT_TRUE(contains(error, "includes in each other, legal: at most 32"));
  EXPECT_TRUE(contains(error, ":2: <include> of 'model://m"));
  const ModelSpec model = load("m0", OddElements::kLeaveOut);
  EXPECT_EQ(model.odd_elements.size(), 1u);
  EXPECT_GT(model.links.size(), 20u);
  // A chain seen before, from a shallower place, counts in full.
  EXPECT_NO_THROW(load("m20", OddElements::kRefuse));
}

TEST_F(SdfSourcesTest, WhatIsIncludedManyTimesIsCountedBeforeItIsRead) {
  // Each level holds ten of the next: ten thousand million elements at the top.
  write("x10", {});
  for (int i = 9; i >= 0; --i) {
    write("x" + std::to_string(i), std::vector<std::string>(10, "x" + std::to_string(i + 1)));
  }
  const std::string error = error_of([&] { load("x0", OddElements::kRefuse); });
  EXPECT_TRUE(contains(error, "elements in "));
  EXPECT_TRUE(contains(error, "legal: at most 100000 and 67108864"));
}

TEST_F(SdfSourcesTest, ADocumentHasALimitOfItsOwn) {
  std::string xml =
      "<sdf version='1.6'><model name='m'><link name='l'/><plugin name='p' "
      "filename='f'>";
  for (int i = 0; i < 100'000; ++i) xml += "<x/>";
  xml += "</plugin></model></sdf>";
  for (const OddElements odd : {OddElements::kRefuse, OddElements::kLeaveOut}) {
    const std::string error = error_of([&] {
      load_model_string(
          xml, "big.sdf", Resources(), [](const auto&) {}, odd);
    });
    EXPECT_TRUE(contains(error, "big.sdf: it has 100004 elements in "));
  }
}

TEST_F(SdfSourcesTest, IncludesInThePartsOfAPluginAreItsOwn) {
  const std::string xml =
      "<sdf version='1.6'><model name='m'><link name='l'/><plugin name='p' filename='f'><include>"
      "<uri>model://no</uri></include></plugin></model></sdf>";
  const ModelSpec model = load_model_string(
      xml, "top.sdf", Resources(), [](const std::string& text) { ADD_FAILURE() << text; },
      OddElements::kLeaveOut);
  EXPECT_TRUE(model.odd_elements.empty());
  EXPECT_NE(model.plugins[0].params.find("include"), nullptr);
}

/// What it says twice, libsdformat alone sorts out.
constexpr char kReadByLibsdformat[] = "<static>0</static><static>0</static>";

/// Includes that are read here come with what they say, in the order of the document; with
/// `extra`, which libsdformat alone knows, they are read by it.
WorldSpec included_world(const std::string& folder, const std::string& extra) {
  const std::string xml =
      "<sdf version='1.6'><world name='w'>"
      "<include><uri>model://ball</uri><name>b1</name><pose frame=''>1 2 3 0 0 0</pose></include>"
      "<model name='own'><link name='l'/></model>"
      "<include><uri>model://ball</uri><name>b2</name><static>1</static></include>"
      "<model name='outer'><pose>0 0 5 0 0 0</pose>"
      "<include><uri>model://ball</uri><pose>1 0 0 0 0 0</pose></include>"
      "<model name='inner'><include><uri>model://ball</uri></include></model></model>"
      "<include><uri>model://lamp</uri></include><include><uri>model://ball</uri>" +
      extra + "</include></world></sdf>";
  return load_world_string(xml, "w.world", Resources({folder}),
                           [](const std::string& text) { ADD_FAILURE() << text; });
}

std::string summary(const WorldSpec& world) {
  std::ostringstream text;
  for (const ModelSpec& model : world.models) {
    for (const PluginSpec& plugin : model.plugins) {
      text << plugin.name << " in " << plugin.filename << " (";
      for (const ParamNode& part : plugin.params.children) text << part.name << "=" << part.text;
      text << ") of ";
    }
    text << model.name << (model.is_static ? " static" : "") << " at "
         << model.T_world_model.p.transpose() << ":";
    for (const LinkSpec& link : model.links) {
      text << " " << link.name << " at " << link.T_model_link.p.transpose() << " with "
           << link.collisions.size() << link.visuals.size();
    }
    text << "\n";
  }
  for (const LightSpec& light : world.lights) text << light.name << "\n";
  return text.str();
}

TEST_F(SdfSourcesTest, IncludesThatAreReadHereAreThoseOfLibsdformat) {
  write("part", {});
  write("ball", {"part"});
  folder_.write("lamp/model.config",
                "<model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
  folder_.write("lamp/model.sdf",
                "<sdf version='1.6'><light type='directional' name='lamp'><direction>0 0 -1"
                "</direction></light></sdf>");
  const std::string here = summary(included_world(folder_.path(), ""));
  EXPECT_EQ(here, summary(included_world(folder_.path(), kReadByLibsdformat)));
  EXPECT_EQ(here,
            "b1 at 1 2 3: l at 0 0 0 with 01 n0::l at 0 0 0 with 01\n"
            "own at 0 0 0: l at 0 0 0 with 00\n"
            "b2 static at 0 0 0: l at 0 0 0 with 01 n0::l at 0 0 0 with 01\n"
            "outer at 0 0 5: ball::l at 1 0 0 with 01 ball::n0::l at 1 0 0 with 01 "
            "inner::ball::l at 0 0 0 with 01 inner::ball::n0::l at 0 0 0 with 01\n"
            "ball at 0 0 0: l at 0 0 0 with 01 n0::l at 0 0 0 with 01\nlamp\n");
}

TEST_F(SdfSourcesTest, PluginsOfAnIncludeAreReadHereAsByLibsdformat) {
  write("ball", {});
  folder_.write("lamp/model.config",
                "<model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
  folder_.write("lamp/model.sdf", "<sdf version='1.6'><light type='point' name='lamp'/></sdf>");
  const std::string plugins =
      "<plugin name='p' filename='libp.so'><a>1 2</a><b> x &amp;  y\n</b></plugin>"
      "<plugin name='q' filename='libq.so'/>";
  const std::string here = summary(included_world(folder_.path(), plugins));
  EXPECT_EQ(here, summary(included_world(folder_.path(), plugins + kReadByLibsdformat)));
  EXPECT_TRUE(contains(here, "p in libp.so (a=1 2b=")) << here;
  EXPECT_TRUE(contains(here, "of q in libq.so () of ball at 0 0 0:")) << here;
  const auto is_read_here = [this](const std::string& extra) {
    const Resources resources({folder_.path()});
    const PlainIncludes includes(
        "<sdf version='1.6'><world name='w'><include><uri>model://ball</uri>" + extra +
            "</include></world></sdf>",
        [&resources](const std::string& uri) { return resources.find(uri); });
    return includes.have("model://ball");
  };
  EXPECT_TRUE(is_read_here(plugins));
  EXPECT_FALSE(is_read_here(kReadByLibsdformat));
}

TEST(XmlCut, BlanksAnElementAndKeepsTheLines) {
  std::string xml = "<a>\n<b c='>'/><b>\n<!-- </b> --><b/><![CDATA[</b>]]>\n</b><d/>\n</a>";
  const std::string before = xml;
  EXPECT_EQ(cut_element(xml, 2, "b", 1), "<b>\n<!-- </b> --><b/><![CDATA[</b>]]>\n</b>");
  EXPECT_EQ(xml.size(), before.size());
  EXPECT_EQ(std::count(xml.begin(), xml.end(), '\n'), 4);
  EXPECT_TRUE(contains(xml, "<b c='>'/>"));
  EXPECT_TRUE(contains(xml, "<d/>"));
  EXPECT_EQ(cut_element(xml, 2, "b"), "<b c='>'/>");
  EXPECT_EQ(cut_element(xml, 2, "b"), "");
  EXPECT_EQ(cut_element(xml, 9, "a"), "");
}

}  // namespace
}  // namespace trident::sim
