// 3MF packages: what slicers write is read exactly, and nothing that is damaged or hostile is read.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/errors.h"
#include "support/mesh_io.h"
#include "support/meshes.h"
#include "support/zip_files.h"

namespace ibmfair::test {
namespace {

using Entries = std::vector<std::pair<std::string, std::string>>;

std::string mesh_xml(const Mesh& mesh, const std::string& of_triangles = "") {
  std::string text = "<mesh><vertices>";
  for (Eigen::Index v = 0; v < mesh.X.rows(); ++v) {
    text += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", mesh.X(v, 0), mesh.X(v, 1),
                        mesh.X(v, 2));
  }
  text += "</vertices><triangles>";
  const Triangles F = triangulate(mesh).F;
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    text += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"{}/>\n", F(t, 0), F(t, 1), F(t, 2),
                        of_triangles);
  }
  return text + "</triangles></mesh>";
}

std::string object_xml(int id, const std::string& contents, const std::string& more = "") {
  return fmt::format(R"(<object id="{}" type="model"{}>{}</object>)", id, more, contents);
}

std::string model_xml(const std::string& resources, const std::string& build) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- a <model> -->\n"
         R"(<model unit="millimeter" )"
         R"(xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/)"
         R"(02" xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06">)"
         R"(<metadata name="Application">a > b</metadata><resources>)" +
         resources + "</resources><build>" + build + "</build></model>";
}

const std::string relations =
    R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">)"
    R"(<Relationship Target="/Metadata/thumbnail.png" Id="rel-2" Type="http://schemas.)"
    R"(openxmlformats.org/package/2006/relationships/metadata/thumbnail"/>)"
    "<Relationship Target='/3D/3dmodel.model' Id='rel-1' "
    "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>";

/// The package of a slicer: with a thumbnail and settings.
Entries package(const std::string& model) {
  return {{"[Content_Types].xml", "<Types/>"},
          {"Metadata/thumbnail.png", "\x89PNG not one"},
          {"Metadata/Slic3r_PE.config", "; <not XML"},
          {"_rels/.rels", relations},
          {"3D/3dmodel.model", model}};
}

MeshFile read(const Entries& entries) {
  return MeshFiles::read(zip_of(entries), "a.3mf");
}

std::string refusal(const std::string& model) {
  return read_error(zip_of(package(model)), "a.3mf");
}

const std::string item = R"(<item objectid="1"/>)";

TEST(ThreeMf, HoldsEveryMeshExactly) {
  for (const NamedMesh& named : at_all_scales(good_meshes())) {
    SCOPED_TRACE(named.name);
    const Entries entries = package(model_xml(object_xml(1, mesh_xml(named.mesh)), item));
    for (const std::string& bytes :
         {zip_of(entries), zip_of(entries, false), zip_of(entries, true, true)}) {
      const MeshFile file = MeshFiles::read(bytes, "a.3mf");
      EXPECT_EQ(file.mesh().X, named.mesh.X);
      EXPECT_EQ(file.mesh().faces.corner,
                mesh_from_triangles({}, triangulate(named.mesh).F).faces.corner);
      EXPECT_TRUE(file.notes().empty());
    }
  }
  const std::string bytes = zip_of(package(model_xml(object_xml(1, mesh_xml(barrel(5))), item)));
  EXPECT_EQ(MeshFiles::read(bytes, "standard input").mesh().X.rows(), 12);  // known by its bytes
}

TEST(ThreeMf, PlacesComponentsAndItems) {
  const Mesh mesh = barrel(5);
  const auto count = static_cast<Index>(mesh.X.rows());
  const std::string shifted = R"( transform="1 0 0 0 1 0 0 0 1 100 0 0")";
  const std::string turned = R"( transform="0 1 0 -1 0 0 0 0 1 0 0 7")";
  const MeshFile file = read(package(model_xml(
      object_xml(1, mesh_xml(mesh)) +
          object_xml(2, R"(<components><component objectid="1"/><component objectid="1")" +
                            shifted + "/></components>"),
      R"(<item objectid="2")" + turned + R"(/><item objectid="1"/>)")));
  const Points& X = file.mesh().X;
  ASSERT_EQ(X.rows(), 3 * count);
  for (Index v = 0; v < count; ++v) {
    const Vec3 x = mesh.X.row(v);
    EXPECT_EQ(Vec3(X.row(v)), Vec3(-x[1], x[0], x[2] + 7));
    EXPECT_EQ(Vec3(X.row(count + v)), Vec3(-x[1], x[0] + 100, x[2] + 7));
    EXPECT_EQ(Vec3(X.row(2 * count + v)), x);
  }
  EXPECT_EQ(file.notes().size(), 1U);
}

TEST(ThreeMf, MirroredObjectsStayOriented) {
  const Mesh mesh = barrel(5);
  const MeshFile file =
      read(package(model_xml(object_xml(1, mesh_xml(mesh)),
                             R"(<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>)")));
  const auto volume = [](const Mesh& m) {
    double sum = 0;
    const Triangles F = triangulate(m).F;
    for (const auto& t : F.rowwise())
      sum += Vec3(m.X.row(t[0])).dot(Vec3(m.X.row(t[1])).cross(Vec3(m.X.row(t[2])))) / 6;
    return sum;
  };
  EXPECT_NEAR(volume(file.mesh()), volume(mesh), 1e-12);
}

TEST(ThreeMf, FollowsThePathsOfTheProductionExtension) {
  const Mesh mesh = barrel(5);
  Entries entries = package(model_xml(
      object_xml(8, R"(<components><component objectid="1" p:path="/3D/Objects/a&amp;b.model"/>)"
                    "</components>"),
      R"(<item objectid="8"/><item objectid="1" p:path="/3d/objects/A&amp;b.model"/>)"));
  entries.emplace_back("3D/Objects/a&b.model", model_xml(object_xml(1, mesh_xml(mesh)), ""));
  EXPECT_EQ(read(entries).mesh().X.rows(), 2 * mesh.X.rows());
}

TEST(ThreeMf, ReadsTextureCoordinates) {
  const MeshFile file = read(
      package(model_xml(R"(<m:texture2dgroup id="5" texid="4"><m:tex2coord u="0.25" v="0"/>)"
                        R"(<m:tex2coord u="1" v="0.5"/></m:texture2dgroup>)" +
                            object_xml(1, mesh_xml(barrel(5), R"( pid="5" p1="1" p2="0" p3="9")")),
                        item)));
  EXPECT_TRUE(file.has_texture_coordinates());
  const MeshAttributes attributes = file.attributes();
  ASSERT_EQ(attributes.texture_coordinates.size(), 2U);
  EXPECT_EQ(attributes.texture_coordinates[1], (std::array<double, 2>{1, 0.5}));
  ASSERT_EQ(attributes.corner_texture.size(), 60U);
  EXPECT_EQ(attributes.corner_texture[0], 1);
  EXPECT_EQ(attributes.corner_texture[1], 0);
  EXPECT_EQ(attributes.corner_texture[2], -1);  // there is no such row
}

TEST(ThreeMf, TakesOtherWaysToWriteIt) {
  const std::string model = model_xml(object_xml(1, mesh_xml(barrel(5))), item);
  const std::string prefixed =
      replaced(replaced(replaced(replaced(model, "<", "<c:"), "<c:/", "</c:"), "<c:?", "<?"),
               "<c:!--", "<!--");
  for (const Entries& entries :
       {package(prefixed), package("\xEF\xBB\xBF" + model), Entries{{"3D/3dmodel.model", model}},
        Entries{{"_rels/.rels", replaced(relations, "3D/3dmodel", "3D/cube")},
                {"3D/cube.model", model}},
        package(replaced(model, item, ""))}) {
    EXPECT_EQ(read(entries).mesh().faces.size(), 20);
  }
}

TEST(ThreeMf, RefusesWithThePlaceInThePackage) {
  const Mesh mesh = barrel(5);
  const std::string good = mesh_xml(mesh);
  struct Fault {
    std::string model, message;
  };
  const auto with = [&](const std::string& what, const std::string& by) {
    return model_xml(object_xml(1, replaced(good, what, by)), item);
  };
  for (const Fault& fault : std::vector<Fault>{
           {with(R"(z="2")", R"(z="two")"), "z: not a number in 'two"},
           {with(R"( z="2")", ""), "the attribute 'z' is missing"},
           {with(R"(v1="10")", R"(v1="99")"), "there is no vertex 99 (the object has 12"},
           {with(R"(v1="10")", R"(v1="-1")"), "v1: not a whole number"},
           {with("</triangles>", ""), "<triangles> must be closed first"},
           {with("<vertices>", "<!DOCTYPE a>"), "document type definitions"},
           {model_xml(object_xml(1, good) + object_xml(1, good), item),
            "two objects with the id 1"},
           {model_xml(object_xml(1, good), R"(<item objectid="7"/>)"), "there is no object 7"},
           {model_xml(object_xml(1, good), R"(<item objectid="1" transform="1 0 0"/>)"),
            "a transform needs 12 numbers, and this one has 3"},
           {model_xml(object_xml(1, R"(<components><component objectid="1"/></components>)"), item),
            "object 1 is a component of itself"},
           {model_xml(object_xml(1, "<mesh><vertices/><triangles/></mesh>"), item), "no vertices"},
           {model_xml(object_xml(1, good), "").substr(0, 700), "a.3mf: 3D/3dmodel.model"},
       }) {
    const std::string message = refusal(fault.model);
    EXPECT_TRUE(message.starts_with("a.3mf: ")) << message;
    EXPECT_NE(message.find(fault.message), std::string::npos) << fault.message << "\n" << message;
  }
  EXPECT_NE(refusal(with(R"(z="2")", R"(z="two")")).find("a.3mf: 3D/3dmodel.model:"),
            std::string::npos);
}

TEST(ThreeMf, RefusesComponentsWithoutEnd) {
  // Each object has ten components of the next: ten to the power of twenty objects.
  std::string resources = object_xml(21, mesh_xml(barrel(3)));
  for (int i = 20; i > 0; --i) {
    std::string components;
    for (int k = 0; k < 10; ++k)
      components += fmt::format(R"(<component objectid="{}"/>)", i + 1);
    resources += object_xml(i, "<components>" + components + "</components>");
  }
  EXPECT_NE(refusal(model_xml(resources, item)).find("more than"), std::string::npos);
  std::string chain = object_xml(5001, mesh_xml(barrel(3)));
  for (int i = 5000; i > 0; --i) {
    chain +=
        object_xml(i, fmt::format(R"(<components><component objectid="{}"/></components>)", i + 1));
  }
  EXPECT_NE(refusal(model_xml(chain, item)).find("nested more than"), std::string::npos);
}

TEST(ThreeMf, RefusesDamagedArchives) {
  const Entries entries = package(model_xml(object_xml(1, mesh_xml(barrel(5))), item));
  for (const bool deflate : {false, true}) {
    const std::string whole = zip_of(entries, deflate);
    for (std::size_t size = 0; size < whole.size(); size += 13) {
      const std::string message = read_error(whole.substr(0, size), "a.3mf");
      EXPECT_TRUE(message.starts_with("a.3mf: ")) << message;
    }
    // A changed byte is noticed, or has no meaning.
    const MeshFile good = MeshFiles::read(whole, "a.3mf");
    for (std::size_t at = 0; at < whole.size(); at += 3) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ 0x15);
      try {
        EXPECT_EQ(MeshFiles::read(bytes, "a.3mf").mesh().X, good.mesh().X) << at;
      } catch (const BadFile& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("a.3mf: ")) << error.what();
      }
    }
  }
}

TEST(ThreeMf, TakesTheMemoryOfTheContentsOnly) {
  // 8 MB of blanks in 8 kB are read; a size that deflate cannot reach is not believed.
  std::string model = model_xml(object_xml(1, mesh_xml(barrel(5))), item);
  model.insert(model.find("<resources>"), std::string(8'000'000, ' '));
  std::string bytes = zip_of(package(model));
  EXPECT_LT(bytes.size(), 20'000U);
  EXPECT_EQ(MeshFiles::read(bytes, "a.3mf").mesh().faces.size(), 20);
  const std::size_t entry = bytes.rfind("PK\1\2");
  for (int i = 0; i < 4; ++i)
    bytes[entry + 24 + i] = static_cast<char>(i == 3 ? 0x7F : 0xFF);
  EXPECT_NE(read_error(bytes, "a.3mf").find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace ibmfair::test
