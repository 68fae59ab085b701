#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "certificate/surface.h"
#include "geometry/triangle_bvh.h"
#include "geometry/triangle_pair.h"
#include "geometry/winding.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

// Pairs of overlapping boxes to look at before giving up [1]: some 20 s. A mesh of 1e5 even faces
// has about 1e6; only a soup of long thin faces comes near.
constexpr std::size_t kMaxPairs = 100'000'000;
constexpr std::size_t kMaxExamples = 8;
// Where no face meets another one, the winding number beside a component is the same all over it,
// and one face speaks for all. Faces that touch may hide an overlap: up to this many are asked; and
// as many of all, evenly chosen, where crossings were found or not looked for.
constexpr std::size_t kMaxWindingSamples = 2000;
// Where an edge of one face meets the rim of another it may only touch or go through; the faces are
// asked this share of the way from the meeting point towards points near their corners.
constexpr double kNearContact = 0.01;
constexpr double kTowardsCorner = 0.7;  // between centroid and corner

struct Sample {
  std::uint32_t face;
  Vector3d point;  // [m] inside the face
};

Vector3d centroid_of(const Surface& surface, std::uint32_t face) {
  const Triangle& t = surface.faces[face];
  const Vector3d &a = surface.places[t[0]], &b = surface.places[t[1]], &c = surface.places[t[2]];
  return a + (b - a) / 3 + (c - a) / 3;
}

void append_around(const Surface& surface, std::uint32_t face, const Vector3d& contact,
                   std::vector<Sample>& samples) {
  const Vector3d centroid = centroid_of(surface, face);
  for (const std::uint32_t corner : surface.faces[face]) {
    const Vector3d target = centroid + kTowardsCorner * (surface.places[corner] - centroid);
    samples.push_back({face, contact + kNearContact * (target - contact)});
  }
}

void find_crossings(const Surface& surface, const std::vector<std::uint32_t>& faces,
                    const CertifyOptions& options, MeshCertificate& certificate,
                    std::vector<bool>& touched, std::vector<Sample>& samples) {
  const TriangleBvh bvh(surface.places, surface.faces, faces);
  std::size_t pairs = 0;
  certificate.embedding = Embedding::Clean;
  bvh.overlapping_pairs([&](std::uint32_t a, std::uint32_t b) {
    if (++pairs > kMaxPairs) {
      certificate.crossing_count_complete = false;
      return false;
    }
    Triangle first = surface.faces[a], second = surface.faces[b];
    std::sort(first.begin(), first.end());
    std::sort(second.begin(), second.end());
    if (first == second) return true;  // counted as a duplicate face
    std::optional<Vector3d> contact;
    switch (relation_of(surface.places, surface.faces[a], surface.faces[b], contact)) {
      case PairRelation::Apart:
        return true;
      case PairRelation::Touching:
        ++certificate.touching_pairs;
        touched[a] = touched[b] = true;
        if (contact && samples.size() < kMaxWindingSamples) {
          append_around(surface, a, *contact, samples);
          append_around(surface, b, *contact, samples);
        }
        break;
      case PairRelation::Crossing:
        ++certificate.crossing_pairs;
        if (certificate.crossing_examples.size() < kMaxExamples) {
          certificate.crossing_examples.push_back(
              {surface.source[std::min(a, b)], surface.source[std::max(a, b)]});
        }
        break;
    }
    if (certificate.crossing_pairs < options.max_crossing_pairs) return true;
    certificate.crossing_count_complete = false;
    return false;
  });
  if (certificate.touching_pairs > 0) certificate.embedding = Embedding::Touching;
  if (certificate.crossing_pairs > 0) certificate.embedding = Embedding::Crossing;
}

// Up to kMaxWindingSamples of the items, evenly chosen.
void append_evenly(const std::vector<std::uint32_t>& items, std::vector<std::uint32_t>& chosen) {
  const std::size_t stride = items.size() / kMaxWindingSamples + 1;
  for (std::size_t i = 0; i < items.size(); i += stride) chosen.push_back(items[i]);
}

// The largest face of each component first.
std::vector<std::uint32_t> faces_to_sample(const Surface& surface,
                                           const MeshCertificate& certificate,
                                           const std::vector<std::uint32_t>& faces,
                                           const std::vector<bool>& touched) {
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> largest(certificate.components, kNone), chosen, touching;
  for (const std::uint32_t f : faces) {
    std::uint32_t& best = largest[surface.component_of[f]];
    if (best == kNone || surface.areas[f] > surface.areas[best]) best = f;
    if (touched[f]) touching.push_back(f);
  }
  for (const std::uint32_t f : largest) {
    if (f != kNone) chosen.push_back(f);
  }
  append_evenly(touching, chosen);
  const bool proven =
      certificate.embedding == Embedding::Clean || certificate.embedding == Embedding::Touching;
  if (!proven || !certificate.crossing_count_complete) append_evenly(faces, chosen);
  return chosen;
}

void sample_winding(const Surface& surface, const std::vector<std::uint32_t>& faces,
                    const std::vector<bool>& touched, const std::vector<Sample>& samples,
                    MeshCertificate& certificate) {
  const WindingField field(surface.places, surface.faces, faces);
  std::vector<bool> seen(certificate.components, false);
  bool first = true;
  // The components' own faces come first: they decide what is a cavity.
  std::vector<Sample> all;
  for (const std::uint32_t f : faces_to_sample(surface, certificate, faces, touched)) {
    all.push_back({f, centroid_of(surface, f)});
  }
  all.insert(all.end(), samples.begin(), samples.end());
  for (const auto& [f, point] : all) {
    const WindingField::Sides sides = field.beside(f, point);
    const int front = static_cast<int>(std::lround(sides.front));
    const int back = static_cast<int>(std::lround(sides.back));
    certificate.winding_min =
        first ? std::min(front, back) : std::min({certificate.winding_min, front, back});
    certificate.winding_max =
        first ? std::max(front, back) : std::max({certificate.winding_max, front, back});
    first = false;
    ++certificate.winding_samples;
    const std::uint32_t c = surface.component_of[f];
    ComponentCertificate& component = certificate.component_list[c];
    if (!seen[c]) component.cavity = component.signed_volume < 0 && front == 0 && back == 1;
    seen[c] = true;
  }
  certificate.cavities = static_cast<std::size_t>(
      std::count_if(certificate.component_list.begin(), certificate.component_list.end(),
                    [](const ComponentCertificate& component) { return component.cavity; }));
  certificate.inside_out = certificate.signed_volume < 0 && certificate.winding_min == -1 &&
                           certificate.winding_max == 0;
}

}  // namespace

void examine_embedding(const Surface& surface, const CertifyOptions& options,
                       MeshCertificate& certificate) {
  std::vector<std::uint32_t> faces;  // with area: the others have no sides to speak of
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    if (surface.areas[f] > 0) faces.push_back(f);
  }
  if (faces.empty()) return;
  std::vector<bool> touched(surface.faces.size(), false);
  std::vector<Sample> samples;
  if (options.test_self_crossing)
    find_crossings(surface, faces, options, certificate, touched, samples);
  if (certificate.closed && certificate.consistently_oriented) {
    sample_winding(surface, faces, touched, samples, certificate);
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
