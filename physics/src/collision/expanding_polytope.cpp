#include "collision/expanding_polytope.h"

namespace plumb::inline PLUMB_ABI::detail {

ExpandingPolytope::ExpandingPolytope(const NumVec (&first)[4], Num size) : size_(size) {
  inside_ = Num(0.25) * (first[0] + first[1] + first[2] + first[3]);
  for (const NumVec& point : first) corners_[corner_count_++] = point;
  add_face(0, 1, 2);
  add_face(0, 2, 3);
  add_face(0, 3, 1);
  add_face(1, 3, 2);
}

void ExpandingPolytope::add_face(int a, int b, int c) {
  const NumVec at = corners_[a];
  NumVec n = cross(corners_[b] - at, corners_[c] - at);
  const Num size = length(n);
  Face face{{a, b, c}, {0, 0, 0}, std::numeric_limits<Num>::infinity(), true};
  if (size > kNumEpsilon * size_ * size_) {
    n = (Num(1) / size) * n;
    // The first tetrahedron may be given either way around; later faces follow their horizon, and
    // the point inside decides for both.
    if (dot(n, at - inside_) < Num(0)) {
      n = -n;
      std::swap(face.corner[1], face.corner[2]);
    }
    face.normal = n;
    face.distance = dot(n, at);
  }
  faces_[face_count_++] = face;
}

const ExpandingPolytope::Face* ExpandingPolytope::nearest() const {
  const Face* best = nullptr;
  for (int i = 0; i < face_count_; ++i) {
    const Face& face = faces_[i];
    if (face.alive && std::isfinite(face.distance) &&
        (best == nullptr || face.distance < best->distance)) {
      best = &face;
    }
  }
  return best;
}

bool ExpandingPolytope::add(NumVec point) {
  constexpr int kCapacity = kDepthMaxIterations + 8;
  if (corner_count_ == kCapacity) return false;
  // The edges between the faces that see the point and those that do not.
  struct Edge {
    int a, b;
  };
  Edge horizon[kDepthMaxFaces];
  int edges = 0;
  const Num flat = Num(16) * kNumEpsilon * size_;
  int seen = 0;
  for (int i = 0; i < face_count_; ++i) {
    Face& face = faces_[i];
    if (!face.alive || !(dot(face.normal, point) > face.distance + flat)) continue;
    face.alive = false;
    ++seen;
    for (int k = 0; k < 3; ++k) {
      const Edge edge{face.corner[k], face.corner[(k + 1) % 3]};
      int twin = 0;
      while (twin < edges && !(horizon[twin].a == edge.b && horizon[twin].b == edge.a)) ++twin;
      if (twin < edges) {
        horizon[twin] = horizon[--edges];
      } else if (edges < kDepthMaxFaces) {
        horizon[edges++] = edge;
      }
    }
  }
  if (seen == 0 || edges < 3) return false;
  int kept = 0;
  for (int i = 0; i < face_count_; ++i) {
    if (faces_[i].alive) faces_[kept++] = faces_[i];
  }
  face_count_ = kept;
  if (face_count_ + edges > kDepthMaxFaces) return false;
  corners_[corner_count_] = point;
  for (int i = 0; i < edges; ++i) add_face(horizon[i].a, horizon[i].b, corner_count_);
  ++corner_count_;
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
