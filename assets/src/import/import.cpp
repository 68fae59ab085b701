#include "plumb/assets/import.h"

#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "import/off_reader.h"
#include "import/reader_log.h"
#include "import/units.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kMaxNodeDepth = 1000;  // a chain of nodes this long is a loop or an attack

Affine3d to_affine(const aiMatrix4x4& m) {
  Affine3d a;
  a.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
      m.d3, m.d4;
  return a;
}

class Collector {
 public:
  Collector(const aiScene& scene, const Matrix3d& to_world, const ImportOptions& options,
            Imported& out)
      : scene_(scene), to_world_(to_world), options_(options), out_(out) {}

  // Empty text if all is well.
  std::string visit(const aiNode& node, const Affine3d& parent, int depth) {
    if (depth > kMaxNodeDepth)
      return "more than " + std::to_string(kMaxNodeDepth) + " nodes stand inside each other";
    const Affine3d transform(parent.matrix() * to_affine(node.mTransformation).matrix());
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const unsigned number = node.mMeshes[i];
      if (number >= scene_.mNumMeshes)
        return "node '" + std::string(node.mName.C_Str()) + "' names a mesh that is not there";
      if (std::string error = append(*scene_.mMeshes[number], transform); !error.empty())
        return error;
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      if (std::string error = visit(*node.mChildren[i], transform, depth + 1); !error.empty())
        return error;
    }
    return {};
  }

 private:
  std::string append(const aiMesh& part, const Affine3d& transform) {
    TriangleMesh& mesh = out_.mesh;
    ImportReport& report = out_.report;
    const std::size_t base = mesh.vertices.size();
    if (base + part.mNumVertices > std::numeric_limits<std::uint32_t>::max())
      return "more than 2^32 vertices";
    const Affine3d to_metres(Eigen::Affine3d(to_world_) * transform);
    const bool mirrored = to_metres.linear().determinant() < 0;
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const Vector3d p(part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z);
      mesh.vertices.push_back(to_metres * p);
      // Each coordinate came as a float: half a unit in its last place, seen in metres.
      const double largest = p.cwiseAbs().maxCoeff();
      if (std::isfinite(largest))
        rounding_ = std::max(rounding_, largest * to_metres.linear().norm());
    }
    std::size_t triangles = 0;
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices == 1) ++report.dropped_points;
      if (face.mNumIndices == 2) ++report.dropped_lines;
      if (face.mNumIndices != 3) continue;
      Triangle triangle{};
      for (unsigned i = 0; i < 3; ++i) {
        if (face.mIndices[i] >= part.mNumVertices) {
          return "face " + std::to_string(f) + " of part '" + part.mName.C_Str() +
                 "' names vertex " + std::to_string(face.mIndices[i]) + " of " +
                 std::to_string(part.mNumVertices);
        }
        triangle[i] = static_cast<std::uint32_t>(base + face.mIndices[i]);
      }
      if (mirrored) std::swap(triangle[1], triangle[2]);
      mesh.triangles.push_back(triangle);
      ++triangles;
    }
    if (triangles == 0) return {};
    if (mesh.triangles.size() > options_.max_triangles) {
      return "more than " + std::to_string(options_.max_triangles) +
             " triangles; raise max_triangles or simplify it";
    }
    ++report.parts;
    if (mirrored) ++report.mirrored_parts;
    if (part.mNumBones > 0) ++report.skinned_parts;
    mesh.coordinate_rounding = report.coordinate_rounding =
        rounding_ * 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
    return {};
  }

  const aiScene& scene_;
  const Matrix3d& to_world_;
  const ImportOptions& options_;
  Imported& out_;
  double rounding_ = 0;  // [m] largest coordinate of a part, as seen in the world
};

// Into which the faces of a scene can be cut.
std::size_t triangles_of(const aiScene& scene) {
  std::size_t count = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    for (unsigned f = 0; f < scene.mMeshes[m]->mNumFaces; ++f) {
      const unsigned corners = scene.mMeshes[m]->mFaces[f].mNumIndices;
      if (corners > 2) count += corners - 2;
    }
  }
  return count;
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// Whether a file that begins as PLY lacks the line that ends its header: assimp 5.2 then reads for
// ever. Empty text if all is well.
std::string cut_off_header(const std::string& path) {
  constexpr std::size_t kMostHeader = std::size_t{1} << 20;  // [byte] far above any real header
  std::ifstream file(path, std::ios::binary);
  std::string head(3, '\0');
  file.read(head.data(), 3);
  if (head != "ply" && head != "PLY") return {};
  head.assign(kMostHeader, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  constexpr std::string_view kBlanks = " \t", kLast = "end_header";
  for (std::size_t line = 0; line < head.size();) {
    const std::size_t end = std::min(head.find_first_of("\r\n", line), head.size());
    std::string_view words = std::string_view(head).substr(line, end - line);
    words.remove_prefix(std::min(words.find_first_not_of(kBlanks), words.size()));
    words = words.substr(0, words.find_first_of(kBlanks));
    if (words == kLast) return {};
    line = end + 1;
  }
  return "the PLY header has no end_header line; the file is cut off or damaged";
}

Result<Imported> read(const std::string& path, const ImportOptions& options) {
  const auto failure = [&](const std::string& text) { return Error{"'" + path + "': " + text}; };
  if (options.metres_per_unit &&
      !(*options.metres_per_unit > 0 && std::isfinite(*options.metres_per_unit))) {
    return failure("metres_per_unit must be finite and above 0");
  }
  std::error_code code;
  const std::filesystem::path file(path);
  if (std::filesystem::is_directory(file, code))
    return failure("this is a folder; give the path of a mesh file");
  if (!std::filesystem::is_regular_file(file, code)) return failure("there is no such file");
  const std::uintmax_t bytes = std::filesystem::file_size(file, code);
  if (code) return failure("its size cannot be read: " + code.message());
  if (bytes > options.max_file_bytes) {
    return failure("it has " + std::to_string(bytes) +
                   " bytes, more than max_file_bytes = " + std::to_string(options.max_file_bytes));
  }

  if (const std::string fault = cut_off_header(path); !fault.empty()) return failure(fault);

  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION,
                           options.file_up.has_value());
  // Only what the mass of a body needs: nothing is joined, smoothed or dropped behind our back.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                  aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
  detail::read_off_ourselves(importer);
  const detail::ReaderLog log;
  const aiScene* scene = importer.ReadFile(path, aiProcess_RemoveComponent);
  // Triangulated apart from reading, so that what gets lost in it can be counted.
  const std::size_t triangles_due = scene != nullptr ? triangles_of(*scene) : 0;
  if (scene != nullptr) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string reason = importer.GetErrorString();
    if (reason == "std::bad_alloc")
      return failure("asks for more memory than there is for it; is it damaged?");
    return failure("cannot be read as a mesh: " + (reason.empty() ? "unknown reason" : reason));
  }

  if (const std::string damage = log.damage(); !damage.empty()) {
    return failure("it is damaged, and a part of it would be lost: " + damage +
                   "; export it again");
  }

  Imported out;
  out.report.file = path;
  out.mesh.name = file.stem().string();
  const std::string extension = lower_extension(file);
  const int reader = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* description =
      reader < 0 ? nullptr : importer.GetImporterInfo(static_cast<std::size_t>(reader));
  out.report.format = description != nullptr ? description->mName : extension;

  const Result<Matrix3d> to_world = detail::to_world(*scene, extension, options, out.report);
  if (!to_world) return failure(to_world.error());
  Collector collector(*scene, *to_world, options, out);
  if (const std::string error = collector.visit(*scene->mRootNode, Affine3d::Identity(), 0);
      !error.empty()) {
    return failure(error);
  }
  if (out.mesh.triangles.empty()) {
    return failure("it holds no triangles (" + std::to_string(scene->mNumMeshes) + " meshes, " +
                   std::to_string(out.report.dropped_lines) + " lines, " +
                   std::to_string(out.report.dropped_points) + " points); a body needs a surface");
  }
  if (const std::size_t made = triangles_of(*scene); made < triangles_due) {
    out.report.losses.push_back(
        std::to_string(triangles_due - made) + " of " + std::to_string(triangles_due) +
        " triangles are missing: polygons that cross themselves could not be cut into triangles; "
        "triangulate it in a modelling program");
  }
  if (out.report.skinned_parts > 0)
    out.report.notes.push_back("parts with bones are taken in bind pose");
  if (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE)
    out.report.notes.push_back("the reader calls the scene incomplete");
  return out;
}

}  // namespace

Result<Imported> import_mesh(const std::string& path, const ImportOptions& options) {
  try {
    return read(path, options);
  } catch (const std::exception& error) {
    return Error{"'" + path + "': cannot be read as a mesh: " + error.what()};
  }
}

const char* name_of(Axis axis) { return axis == Axis::X ? "x" : axis == Axis::Y ? "y" : "z"; }

const char* name_of(Origin origin) {
  switch (origin) {
    case Origin::File:
      return "from the file";
    case Origin::Format:
      return "by the format";
    case Origin::Option:
      return "as asked";
    case Origin::Unknown:
      return "assumed";
  }
  return "?";
}

}  // namespace plumb::inline PLUMB_ABI::assets
