// The shared module through which the library reads everything that is not OBJ, PLY or OFF.
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include "ibmfair/io/assimp_import.h"

namespace ibmfair {
namespace {

constexpr std::size_t most = static_cast<std::size_t>(std::numeric_limits<Index>::max());

using Transform = Eigen::Matrix4d;

/// assimp multiplies matrices in float32; a chain of nodes keeps more digits here.
Transform to_double(const aiMatrix4x4& matrix) {
  Transform result;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      result(row, column) = static_cast<double>(matrix[row][column]);
    }
  }
  return result;
}

/// Strings all meshes together, once for every node that shows them.
class SceneReader {
 public:
  SceneReader(const aiScene& scene, ImportedScene& result) : scene_(scene), result_(result) {
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      any_texture_ = any_texture_ || scene.mMeshes[i]->HasTextureCoords(0);
      any_colours_ = any_colours_ || scene.mMeshes[i]->HasVertexColors(0);
      result_.attributes.normals = result_.attributes.normals || scene.mMeshes[i]->HasNormals();
    }
    result_.attributes.opacity = any_colours_;
  }

  void run() {
    if (scene_.mRootNode != nullptr) visit(*scene_.mRootNode, Transform::Identity());
    if (!result_.error.empty()) return;
    result_.mesh.X =
        Eigen::Map<const Points>(positions_.data(), static_cast<Eigen::Index>(vertex_count()), 3);
  }

 private:
  std::size_t vertex_count() const { return positions_.size() / 3; }

  void visit(const aiNode& node, const Transform& parent) {
    const Transform transform = parent * to_double(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes && result_.error.empty(); ++i) {
      add(*scene_.mMeshes[node.mMeshes[i]], transform);
    }
    for (unsigned i = 0; i < node.mNumChildren && result_.error.empty(); ++i) {
      visit(*node.mChildren[i], transform);
    }
  }

  void add(const aiMesh& mesh, const Transform& transform) {
    const std::size_t first = vertex_count();
    if (first + mesh.mNumVertices > most) {
      result_.error = "too many vertices";
      return;
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      const Eigen::Vector4d at =
          transform * Eigen::Vector4d(static_cast<double>(p.x), static_cast<double>(p.y),
                                      static_cast<double>(p.z), 1.0);
      if (!at.allFinite()) {
        result_.error = "vertex " + std::to_string(first + v) + " is not finite";
        return;
      }
      positions_.insert(positions_.end(), {at.x(), at.y(), at.z()});
      add_vertex_attributes(mesh, v);
    }
    add_faces(mesh, first);
  }

  void add_vertex_attributes(const aiMesh& mesh, unsigned v) {
    MeshAttributes& attributes = result_.attributes;
    if (any_texture_) {
      const aiVector3D t = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][v] : aiVector3D();
      attributes.texture_coordinates.push_back(
          {static_cast<double>(t.x), static_cast<double>(t.y)});
    }
    if (any_colours_) {
      const aiColor4D c = mesh.HasVertexColors(0) ? mesh.mColors[0][v] : aiColor4D(1, 1, 1, 1);
      attributes.colours.push_back({static_cast<double>(c.r), static_cast<double>(c.g),
                                    static_cast<double>(c.b), static_cast<double>(c.a)});
    }
  }

  void add_faces(const aiMesh& mesh, std::size_t first) {
    Polygons& faces = result_.mesh.faces;
    std::vector<Index> corners;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++result_.left_out_faces;
        continue;
      }
      if (faces.corner.size() + face.mNumIndices > most) {
        result_.error = "too many face corners";
        return;
      }
      corners.clear();
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= mesh.mNumVertices) {
          result_.error =
              "face " + std::to_string(faces.size()) + " names a vertex that is not there";
          return;
        }
        corners.push_back(static_cast<Index>(first + face.mIndices[i]));
        // Texture coordinates are stored vertex by vertex, so that they share their numbers.
        if (any_texture_) result_.attributes.corner_texture.push_back(corners.back());
      }
      faces.add(corners);
    }
  }

  const aiScene& scene_;
  ImportedScene& result_;
  std::vector<double> positions_;
  bool any_texture_ = false;
  bool any_colours_ = false;
};

}  // namespace
}  // namespace ibmfair

extern "C" void ibmfair_import_scene(std::string_view bytes, const std::string& path,
                                     const std::string& extension, ibmfair::ImportedScene& result) {
  Assimp::Importer importer;
  // No post-processing: every step of it renumbers or merges something.
  constexpr unsigned no_steps = 0;
  const aiScene* scene = path.empty() ? importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                                    no_steps, extension.c_str())
                                      : importer.ReadFile(path, no_steps);
  if (scene == nullptr) {
    result.error = std::string("assimp cannot read it: ") + importer.GetErrorString();
    return;
  }
  ibmfair::SceneReader(*scene, result).run();
  // A facet's normal says nothing that its corners do not.
  if (extension == "stl") result.attributes.normals = false;
}
