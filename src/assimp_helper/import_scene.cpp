#include "assimp_helper/import_scene.h"

#include <exception>
#include <initializer_list>
#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include "assimp_helper/folder_files.h"

namespace ibmfair {
namespace {

constexpr std::size_t most = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

using Transform = Eigen::Matrix4d;

/// Products of the transforms along a chain of nodes are computed in double, because assimp's
/// float32 would lose digits.
Transform to_double(const aiMatrix4x4& matrix) {
  Transform result;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      result(row, column) = static_cast<double>(matrix[row][column]);
    }
  }
  return result;
}

/// Concatenates all meshes, each mesh once for every node that refers to the mesh.
class SceneReader {
 public:
  SceneReader(const aiScene& scene, ImportedScene& result) : scene_(scene), result_(result) {
    std::size_t vertices = 0, faces = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      vertices += scene.mMeshes[i]->mNumVertices;
      faces += scene.mMeshes[i]->mNumFaces;
      any_texture_ = any_texture_ || scene.mMeshes[i]->HasTextureCoords(0);
      any_colours_ = any_colours_ || scene.mMeshes[i]->HasVertexColors(0);
      result_.normals = result_.normals || scene.mMeshes[i]->HasNormals();
    }
    // These sizes are sufficient if every mesh occurs once and consists of triangles.
    result_.positions.reserve(3 * vertices);
    result_.first.reserve(faces + 1);
    result_.corner.reserve(3 * faces);
  }

  void run() {
    if (scene_.mRootNode != nullptr) visit(*scene_.mRootNode, Transform::Identity());
  }

 private:
  void visit(const aiNode& node, const Transform& parent) {
    const Transform transform = parent * to_double(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes && result_.error.empty(); ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) {
        result_.error = "node '" + std::string(node.mName.C_Str()) + "' refers to mesh " +
                        std::to_string(node.mMeshes[i]) + ", but the file has " +
                        std::to_string(scene_.mNumMeshes);
      } else {
        add(*scene_.mMeshes[node.mMeshes[i]], transform);
      }
    }
    for (unsigned i = 0; i < node.mNumChildren && result_.error.empty(); ++i) {
      visit(*node.mChildren[i], transform);
    }
  }

  void add(const aiMesh& mesh, const Transform& transform) {
    const std::size_t first = result_.vertex_count();
    if (first + mesh.mNumVertices > most) {
      result_.error = "too many vertices: at most " + std::to_string(most) + " can be read";
      return;
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      const Eigen::Vector4d at =
          transform * Eigen::Vector4d(static_cast<double>(p.x), static_cast<double>(p.y),
                                      static_cast<double>(p.z), 1.0);
      if (!at.allFinite()) {
        result_.error =
            "vertex " + std::to_string(first + v) + " has a coordinate that is not finite";
        return;
      }
      result_.positions.insert(result_.positions.end(), {at.x(), at.y(), at.z()});
      add_vertex_attributes(mesh, v);
    }
    add_faces(mesh, first);
  }

  void add_vertex_attributes(const aiMesh& mesh, unsigned v) {
    if (any_texture_) {
      const aiVector3D t = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][v] : aiVector3D();
      append({t.x, t.y}, result_.texture_coordinates);
    }
    if (any_colours_) {
      const aiColor4D c = mesh.HasVertexColors(0) ? mesh.mColors[0][v] : aiColor4D(1, 1, 1, 1);
      append({c.r, c.g, c.b, c.a}, result_.colours);
    }
  }

  static void append(std::initializer_list<float> values, std::vector<double>& list) {
    for (const float value : values)
      list.push_back(static_cast<double>(value));
  }

  void add_faces(const aiMesh& mesh, std::size_t first) {
    std::vector<std::int32_t>& corners = result_.corner;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++result_.left_out_faces;
        continue;
      }
      if (corners.size() + face.mNumIndices > most) {
        result_.error = "too many face corners: at most " + std::to_string(most) + " can be read";
        return;
      }
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= mesh.mNumVertices) {
          result_.error = "face " + std::to_string(result_.face_count()) + " refers to vertex " +
                          std::to_string(face.mIndices[i]) + " of its mesh, which has " +
                          std::to_string(mesh.mNumVertices) + " (counted from 0)";
          return;
        }
        corners.push_back(static_cast<std::int32_t>(first + face.mIndices[i]));
      }
      result_.first.push_back(static_cast<std::int64_t>(corners.size()));
    }
  }

  const aiScene& scene_;
  ImportedScene& result_;
  bool any_texture_ = false;
  bool any_colours_ = false;
};

/// Removes all importers that do not declare this extension. Otherwise assimp would try all of its
/// importers on a file that the importer for this extension does not recognise.
void keep_importers_of(const std::string& extension, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::istringstream declared(importer.GetImporterInfo(i)->mFileExtensions);
    bool fits = false;
    for (std::string word; declared >> word;) {
      fits = fits || word == extension;
    }
    if (!fits) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

/// Rethrows an exception for lack of memory, because assimp turns all exceptions into messages.
void rethrow_want_of_memory(const std::exception_ptr& exception) {
  if (exception == nullptr) return;
  try {
    std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::length_error&) {  // a vector larger than any memory
    throw std::bad_alloc();
  } catch (...) {
    return;  // the importer's message reports all other exceptions
  }
}

}  // namespace

ImportedScene import_scene(FolderFiles& files, const std::string& extension) {
  Assimp::Importer importer;
  keep_importers_of(extension, importer);
  ImportedScene result;
  if (importer.GetImporterCount() == 0) {
    result.error = "this build of assimp reads no ." + extension + " files";
    return result;
  }
  // No post-processing, because every step of it renumbers or merges vertices or faces.
  constexpr unsigned no_steps = 0;
  // Without this setting assimp adds meshes that show the bones of a file without meshes.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetIOHandler(&files);
  const aiScene* scene = importer.ReadFile(files.main_name(), no_steps);
  importer.SetIOHandler(nullptr);  // else the importer would delete `files`
  if (scene == nullptr) {
    rethrow_want_of_memory(importer.GetException());
    result.error = std::string("assimp cannot read it: ") + importer.GetErrorString();
    return result;
  }
  SceneReader(*scene, result).run();
  // The normals of STL facets are redundant, because they follow from the corners.
  if (extension == "stl") result.normals = false;
  return result;
}

}  // namespace ibmfair
