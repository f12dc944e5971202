// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Material scripts of OGRE: their grammar, where they are found, what visuals make of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/materials/ogre_script.h"
#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

const char kScript[] = R"(// a comment {
import * from "other.material"
material Mine/Base
{
  receive_shadows on
  technique
  {
    pass
    {
      ambient 0.1 0.2 0.3 1
      diffuse 0.4 0.5 0.6
      specular 0.7 0.8 0.9 12.5
      emissive 0 0.25 0 0.5 /* over
      two lines } */
      texture_unit
      {
        texture bricks.jpg
        scale 0.5 0.5
      }
      texture_unit { texture second.png }
    }
    pass { diffuse 1 1 1 }
  }
}
material "Mine/Child" : Mine/Base { technique t { pass p { diffuse vertexcolour
  ambient 1 0 0 1 } } }
material Mine/Plain { technique { pass { lighting off } } }
vertex_program Mine/Program glsl { source a.glsl }
)";

bool is(const Eigen::Vector4d& color, double r, double g, double b, double a) {
  return color.isApprox(Eigen::Vector4d(r, g, b, a), 1e-12);
}

TEST(OgreScript, ColorsAndTheFirstTextureOfTheFirstPassCount) {
  const auto materials = parse_ogre_script(kScript, "test.material");
  ASSERT_EQ(materials.size(), 3u);
  const OgreMaterial& base = materials.at("Mine/Base");
  EXPECT_TRUE(is(base.ambient, 0.1, 0.2, 0.3, 1.0));
  EXPECT_TRUE(is(base.diffuse, 0.4, 0.5, 0.6, 1.0));
  EXPECT_TRUE(is(base.specular, 0.7, 0.8, 0.9, 1.0)) << "12.5 is its shininess";
  EXPECT_TRUE(is(base.emissive, 0.0, 0.25, 0.0, 0.5));
  EXPECT_EQ(base.texture, "bricks.jpg");
}

TEST(OgreScript, AChildHasWhatItsParentHas) {
  const auto materials = parse_ogre_script(kScript, "test.material");
  const OgreMaterial& child = materials.at("Mine/Child");
  EXPECT_TRUE(is(child.ambient, 1.0, 0.0, 0.0, 1.0));
  EXPECT_TRUE(is(child.diffuse, 0.4, 0.5, 0.6, 1.0)) << "vertexcolour is no colour";
  EXPECT_EQ(child.texture, "bricks.jpg");
  const auto of_gazebo = parse_ogre_script("material A : Gazebo/Orange {}", "test.material");
  EXPECT_TRUE(is(of_gazebo.at("A").diffuse, 1.0, 0.5088, 0.0468, 1.0));
}

TEST(OgreScript, WithoutColorsIsWhite) {
  const OgreMaterial plain = parse_ogre_script(kScript, "test.material").at("Mine/Plain");
  EXPECT_TRUE(is(plain.diffuse, 1.0, 1.0, 1.0, 1.0));
  EXPECT_EQ(plain.texture, "");
}

TEST(OgreScript, MistakesAreNamedWithTheirLine) {
  const auto refusal = [](const std::string& text) {
    return error_of([&] { parse_ogre_script(text, "test.material"); });
  };
  EXPECT_TRUE(contains(refusal("material A\n{\n technique {\n"), "test.material:3: the block of"));
  EXPECT_TRUE(contains(refusal("material A {\n}\n}\n"), "test.material:3: '}' without its '{'"));
  EXPECT_TRUE(contains(refusal("material A { technique { pass {\n diffuse 1 0\n } } }"),
                       "test.material:2: 'diffuse' has 2 numbers"));
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep += "a {";
  EXPECT_TRUE(contains(refusal(deep), "nest deeper than 32"));
}

/// A model's folder with a script and a picture, as Gazebo's models have them.
class MaterialFolder {
 public:
  MaterialFolder() {
    namespace fs = std::filesystem;
    for (const char* part : {"scripts", "textures"}) {
      fs::create_directories(scratch_.path() + "/wall/materials/" + part);
    }
    write("scripts/wall.material", kScript);
    write("textures/bricks.jpg", "x");
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(scratch_.path() + "/wall/materials/" + file) << text;
  }
  const std::string& path() const { return scratch_.path(); }

 private:
  ScratchFolder scratch_;
};

/// The visuals of one model whose visuals have these materials.
std::vector<VisualSpec> visuals_of(const std::vector<std::string>& materials,
                                   std::vector<std::string>& warnings,
                                   const std::vector<std::string>& folders) {
  std::string xml =
      "<sdf version='1.6'><world name='w'><model name='m'><static>true</static><link name='l'>";
  for (std::size_t i = 0; i < materials.size(); ++i) {
    xml += "<visual name='v" + std::to_string(i) + "'><geometry><box><size>1 1 1</size></box>" +
           "</geometry><material>" + materials[i] + "</material></visual>";
  }
  const WorldSpec world =
      load_world_string(xml + "</link></model></world></sdf>", "test.world", Resources(folders),
                        [&](const std::string& text) { warnings.push_back(text); });
  return world.models.at(0).links.at(0).visuals;
}

std::string script(const std::string& name, const std::vector<std::string>& uris) {
  std::string xml = "<script>";
  for (const std::string& uri : uris) xml += "<uri>" + uri + "</uri>";
  return xml + "<name>" + name + "</name></script>";
}

TEST(OgreScript, IsFoundByFileOrFolderWithItsPicture) {
  const MaterialFolder folder;
  std::vector<std::string> warnings;
  const auto visuals = visuals_of(
      {script("Mine/Base", {"model://wall/materials/scripts", "model://wall/materials/textures"}),
       script("Mine/Base", {"model://wall/materials/scripts/wall.material"}),
       script("Mine/Base", {"model://wall/materials/scripts/"})},
      warnings, {folder.path()});
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  for (const VisualSpec& visual : visuals) {
    EXPECT_TRUE(is(visual.material.diffuse, 0.4, 0.5, 0.6, 1.0));
    EXPECT_TRUE(is(visual.material.emissive, 0.0, 0.25, 0.0, 0.5));
    EXPECT_EQ(visual.material.texture_file, folder.path() + "/wall/materials/textures/bricks.jpg");
  }
}

TEST(OgreScript, OfMediaIsFoundBelowTheResourcePath) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path() + "/media/materials/scripts");
  std::filesystem::create_directories(folder.path() + "/media/materials/textures");
  std::ofstream(folder.path() + "/media/materials/scripts/my.material") << kScript;
  std::ofstream(folder.path() + "/media/materials/textures/bricks.jpg") << "x";
  std::vector<std::string> warnings;
  const auto visuals =
      visuals_of({script("Mine/Base", {"file://media/materials/scripts/my.material"})}, warnings,
                 {folder.path()});
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(visuals.at(0).material.texture_file,
            folder.path() + "/media/materials/textures/bricks.jpg");
}

TEST(OgreScript, AMissingScriptIsOneWarningWithTheColorThatStandsForIt) {
  std::vector<std::string> warnings;
  const std::string lost = script("Mine/Base", {"model://nowhere/materials/scripts"});
  const auto visuals = visuals_of({lost, lost, lost}, warnings, {});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0],
                       "test.world:1: link 'l' visual 'v0': material script 'Mine/Base' not found, "
                       "nor is 'model://nowhere/materials/scripts'; shown in grey (0.7 0.7 0.7)"));
  EXPECT_TRUE(is(visuals.at(2).material.diffuse, 0.7, 0.7, 0.7, 1.0));
}

TEST(OgreScript, AMissingPictureIsOneWarningWithTheColorThatStandsForIt) {
  const MaterialFolder folder;
  std::filesystem::remove(folder.path() + "/wall/materials/textures/bricks.jpg");
  std::vector<std::string> warnings;
  const std::string wall = script("Mine/Base", {"model://wall/materials/scripts"});
  const auto visuals = visuals_of({wall, wall}, warnings, {folder.path()});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(contains(warnings[0],
                       "texture 'bricks.jpg' not found; shown without it, in the "
                       "colour (0.4 0.5 0.6)"));
  EXPECT_EQ(visuals.at(1).material.texture_file, "");
}

TEST(OgreScript, ABrokenScriptIsOneWarningBesidesThatOfTheMaterial) {
  const MaterialFolder folder;
  folder.write("scripts/wall.material", "material Mine/Base {\n");
  std::vector<std::string> warnings;
  const std::string wall = script("Mine/Base", {"model://wall/materials/scripts"});
  visuals_of({wall, wall}, warnings, {folder.path()});
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(contains(warnings[0], "wall.material:1: the block of line 1 has no '}'"));
  EXPECT_TRUE(contains(warnings[1], "'Mine/Base' is not known by its name; shown in grey"));
}

}  // namespace
}  // namespace trident::sim
