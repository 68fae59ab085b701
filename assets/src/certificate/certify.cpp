#include "certificate/surface.h"
#include "plumb/assets/certificate.h"

namespace plumb::inline PLUMB_ABI::assets {

MeshCertificate certify(const TriangleMesh& mesh, const CertifyOptions& options) {
  MeshCertificate certificate;
  const detail::Surface surface = detail::examine_surface(mesh, certificate);
  if (certificate.non_finite_vertices == 0 && certificate.out_of_range_triangles == 0) {
    detail::examine_embedding(surface, options, certificate);
  }
  detail::conclude(surface, certificate);
  return certificate;
}

std::string MeshCertificate::fault_text() const {
  std::string text;
  for (const Finding& finding : findings) {
    if (finding.kind != Finding::Kind::Fault) continue;
    if (!text.empty()) text += "; ";
    text += finding.text;
    if (!finding.remedy.empty()) text += " (remedy: " + finding.remedy + ")";
  }
  return text;
}

const char* name_of(Embedding embedding) {
  switch (embedding) {
    case Embedding::NotTested:
      return "not tested";
    case Embedding::Clean:
      return "clean";
    case Embedding::Touching:
      return "touching";
    case Embedding::Crossing:
      return "crossing";
  }
  return "?";
}

}  // namespace plumb::inline PLUMB_ABI::assets
