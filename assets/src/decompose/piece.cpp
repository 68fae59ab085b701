#include "decompose/piece.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <unordered_map>
#include <utility>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;
using Edge = Piece::Edge;

constexpr std::uint32_t kAbsent = ~0u;

// The vector area of a face, half the sum of the cross products along its rim.
Vector3d vector_area(const Piece& piece, std::uint32_t begin, std::uint32_t end) {
  const Vector3d& origin = piece.points[piece.edges[begin].from];
  Vector3d doubled = Vector3d::Zero();
  for (std::uint32_t e = begin; e < end; ++e) {
    doubled += (piece.points[piece.edges[e].from] - origin)
                   .cross(piece.points[piece.edges[e].to] - origin);
  }
  return 0.5 * doubled;
}

double volume_of(const Piece& piece) {
  double tripled = 0;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : piece.face_ends) {
    const Vector3d& on_face = piece.points[piece.edges[begin].from];
    tripled += (on_face - piece.points.front()).dot(vector_area(piece, begin, end));
    begin = end;
  }
  return tripled / 3;
}

// Builds the front of a piece point by point and face by face.
class Cut {
 public:
  Cut(const Piece& whole, const CutPlane& plane, double on_plane)
      : whole_(whole), on_plane_(on_plane), number_of_(whole.points.size(), kAbsent) {
    heights_.reserve(whole.points.size());
    for (const Vector3d& p : whole.points) heights_.push_back(plane.height(p));
  }

  Piece run() {
    std::uint32_t begin = 0;
    for (const std::uint32_t end : whole_.face_ends) {
      add_face(begin, end);
      begin = end;
    }
    const auto cap_begin = static_cast<std::uint32_t>(front_.edges.size());
    if (!cap_.empty()) {
      front_.edges.insert(front_.edges.end(), cap_.begin(), cap_.end());
      close_face();
      front_.cap_area = vector_area(front_, cap_begin, front_.face_ends.back()).norm();
    }
    if (!front_.face_ends.empty()) front_.volume = volume_of(front_);
    return std::move(front_);
  }

 private:
  [[nodiscard]] bool is_in(std::uint32_t p) const { return heights_[p] > on_plane_; }

  std::uint32_t kept(std::uint32_t p) {
    if (number_of_[p] == kAbsent) {
      number_of_[p] = static_cast<std::uint32_t>(front_.points.size());
      front_.points.push_back(whole_.points[p]);
    }
    return number_of_[p];
  }

  // Where the edge from an inner point to an outer one leaves. Both faces of an edge find the same
  // point.
  std::uint32_t crossing(std::uint32_t in, std::uint32_t out) {
    if (heights_[out] >= -on_plane_) return kept(out);
    const std::uint64_t key = std::uint64_t{in} << 32 | out;
    const auto [found, is_new] =
        crossings_.try_emplace(key, static_cast<std::uint32_t>(front_.points.size()));
    if (is_new) {
      const double share = heights_[in] / (heights_[in] - heights_[out]);
      const Vector3d& from = whole_.points[in];
      front_.points.emplace_back(from + share * (whole_.points[out] - from));
    }
    return found->second;
  }

  void add_face(std::uint32_t begin, std::uint32_t end) {
    exits_.clear();
    entries_.clear();
    const std::size_t face_begin = front_.edges.size();
    for (std::uint32_t e = begin; e < end; ++e) {
      const auto [from, to] = whole_.edges[e];
      const bool from_in = is_in(from), to_in = is_in(to);
      if (from_in && to_in) {
        front_.edges.push_back({kept(from), kept(to)});
      } else if (from_in) {
        exits_.push_back(crossing(from, to));
        front_.edges.push_back({kept(from), exits_.back()});
      } else if (to_in) {
        entries_.push_back(crossing(to, from));
        front_.edges.push_back({entries_.back(), kept(to)});
      }
    }
    close_along_plane();
    if (front_.edges.size() > face_begin) close_face();
  }

  // Along the line where plane and face meet, exits and entries take turns, the inside always on
  // the same side of an exit; in order, the k-th exit belongs to the k-th entry.
  void close_along_plane() {
    if (exits_.size() > 1) {
      Vector3d lower = front_.points[exits_.front()], upper = lower;
      for (const auto* list : {&exits_, &entries_}) {
        for (const std::uint32_t p : *list) {
          lower = lower.cwiseMin(front_.points[p]);
          upper = upper.cwiseMax(front_.points[p]);
        }
      }
      Eigen::Index axis = 0;
      (upper - lower).maxCoeff(&axis);
      const auto along = [&](std::uint32_t a, std::uint32_t b) {
        const double pa = front_.points[a][axis], pb = front_.points[b][axis];
        return pa != pb ? pa < pb : a < b;
      };
      std::sort(exits_.begin(), exits_.end(), along);
      std::sort(entries_.begin(), entries_.end(), along);
    }
    for (std::size_t k = 0; k < std::min(exits_.size(), entries_.size()); ++k) {
      if (exits_[k] == entries_[k]) continue;
      front_.edges.push_back({exits_[k], entries_[k]});
      cap_.push_back({entries_[k], exits_[k]});
    }
  }

  void close_face() { front_.face_ends.push_back(static_cast<std::uint32_t>(front_.edges.size())); }

  const Piece& whole_;
  double on_plane_;
  std::vector<double> heights_;
  std::vector<std::uint32_t> number_of_;  // of whole points in the front
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
  std::vector<std::uint32_t> exits_, entries_;
  std::vector<Edge> cap_;
  Piece front_;
};

}  // namespace

Piece piece_of(const std::vector<Vector3d>& places, const std::vector<Triangle>& faces) {
  Piece piece;
  piece.points = places;
  for (const Triangle& t : faces) {
    for (std::size_t k = 0; k < 3; ++k) piece.edges.push_back({t[k], t[(k + 1) % 3]});
    piece.face_ends.push_back(static_cast<std::uint32_t>(piece.edges.size()));
  }
  if (!piece.face_ends.empty()) piece.volume = volume_of(piece);
  return piece;
}

std::vector<Vector3d> points_of(const Piece& piece) {
  std::vector<bool> used(piece.points.size(), false);
  for (const Edge& edge : piece.edges) used[edge.from] = used[edge.to] = true;
  std::vector<Vector3d> points;
  for (std::size_t p = 0; p < piece.points.size(); ++p)
    if (used[p]) points.push_back(piece.points[p]);
  return points;
}

Piece in_front(const Piece& piece, const CutPlane& plane, double on_plane) {
  return Cut(piece, plane, on_plane).run();
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
