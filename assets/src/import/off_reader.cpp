#include "import/off_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

constexpr aiImporterDesc kDescription{"OFF", "", "", "", aiImporterFlags_SupportTextFlavour,
                                      0,     0,  0,  0,  "off"};

aiMesh* to_mesh(const OffPolygons& off) {
  auto mesh = std::make_unique<aiMesh>();
  mesh->mNumVertices = static_cast<unsigned>(off.vertices.size());
  mesh->mVertices = new aiVector3D[off.vertices.size()];  // NOLINT: aiMesh owns its arrays
  for (std::size_t k = 0; k < off.vertices.size(); ++k) {
    const Eigen::Vector3d& v = off.vertices[k];
    mesh->mVertices[k] = aiVector3D(static_cast<ai_real>(v.x()), static_cast<ai_real>(v.y()),
                                    static_cast<ai_real>(v.z()));
  }
  mesh->mFaces = new aiFace[off.ends.size()];  // NOLINT
  std::size_t begin = 0;
  for (const std::size_t end : off.ends) {
    if (end == begin) continue;  // a face without corners is nothing
    aiFace& face = mesh->mFaces[mesh->mNumFaces++];
    face.mNumIndices = static_cast<unsigned>(end - begin);
    face.mIndices = new unsigned[end - begin];  // NOLINT
    for (std::size_t i = begin; i < end; ++i) face.mIndices[i - begin] = off.corners[i];
    begin = end;
  }
  return mesh.release();
}

class OffReader final : public Assimp::BaseImporter {
 public:
  bool CanRead(const std::string& file, Assimp::IOSystem* io, bool) const override {
    const std::unique_ptr<Assimp::IOStream> stream(io->Open(file, "rb"));
    char head[8] = {};  // the longest keyword, STCN4nOFF, but for its last letter
    if (!stream || stream->Read(head, 1, sizeof head) < 3) return false;
    const std::string_view text(head, sizeof head);
    return text.find_first_not_of("STCN4n") == text.find("OF") && text.find("OF") < sizeof head;
  }

 protected:
  const aiImporterDesc* GetInfo() const override { return &kDescription; }

  void InternReadFile(const std::string& file, aiScene* scene, Assimp::IOSystem* io) override {
    const std::unique_ptr<Assimp::IOStream> stream(io->Open(file, "rb"));
    if (!stream) throw std::runtime_error("it cannot be opened");
    std::vector<char> text;
    TextFileToBuffer(stream.get(), text);  // with a 0 at its end
    const Result<OffPolygons> off = parse_off({text.data(), text.size() - 1});
    if (!off) throw std::runtime_error(off.error());
    if (off->vertices.size() > std::numeric_limits<unsigned>::max())
      throw std::runtime_error("more than 2^32 vertices");
    if (off->vertices.empty() || off->corners.empty())
      throw std::runtime_error("it holds no faces; a body needs a surface");
    scene->mNumMeshes = 1;
    scene->mMeshes = new aiMesh* [1] { to_mesh(*off) };  // NOLINT: aiScene owns its arrays
    scene->mRootNode = new aiNode("<OFFRoot>");          // NOLINT
    scene->mRootNode->mNumMeshes = 1;
    scene->mRootNode->mMeshes = new unsigned[1]{0};  // NOLINT
  }
};

}  // namespace

void read_off_ourselves(Assimp::Importer& importer) {
  const std::unique_ptr<Assimp::BaseImporter> replaced(importer.GetImporter("off"));
  if (replaced) importer.UnregisterLoader(replaced.get());
  importer.RegisterLoader(new OffReader);  // NOLINT: the importer owns its readers
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
