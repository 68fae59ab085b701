#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/triangle_area.h"
#include "geometry/winding.h"
#include "mass/integrals.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A point counts as inside from half a turn on, to either side: an inside-out body is a body too.
constexpr double kInside = 0.5;

// The grid stands at an angle to the mesh that no face is likely to share. A face along the grid
// would be wrong by the same part of a cube everywhere; at an angle the errors cancel.
const Eigen::Quaterniond kGridTurn(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));

struct Filled {
  double cube = 0;                       // [m] side
  std::size_t inside = 0, boundary = 0;  // cubes; boundary: inside with a neighbour outside
  Vector3d first = Vector3d::Zero();     // about the box's middle, in cubes
  Matrix3d second = Matrix3d::Zero();
};

// Cubes that the box of some face reaches, with one cube around: between two others no face stands.
class NearFaces {
 public:
  NearFaces(const TriangleMesh& mesh, const Vector3d& corner, double cube,
            const Eigen::Vector3i& counts)
      : counts_(counts),
        near_(static_cast<std::size_t>(counts.x()) * static_cast<std::size_t>(counts.y()) *
                  static_cast<std::size_t>(counts.z()),
              false) {
    for (const Triangle& face : mesh.triangles) {
      Eigen::AlignedBox3d box;
      for (const std::uint32_t v : face) box.extend(mesh.vertices[v]);
      Eigen::Vector3i low, high;
      for (int i = 0; i < 3; ++i) {
        low[i] = std::clamp(static_cast<int>(std::floor((box.min()[i] - corner[i]) / cube)) - 1, 0,
                            counts[i] - 1);
        high[i] = std::clamp(static_cast<int>(std::floor((box.max()[i] - corner[i]) / cube)) + 1, 0,
                             counts[i] - 1);
      }
      for (int z = low.z(); z <= high.z(); ++z) {
        for (int y = low.y(); y <= high.y(); ++y) {
          for (int x = low.x(); x <= high.x(); ++x) near_[index(x, y, z)] = true;
        }
      }
    }
  }
  [[nodiscard]] bool at(int x, int y, int z) const { return near_[index(x, y, z)]; }

 private:
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(counts_.y()) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(counts_.x()) +
           static_cast<std::size_t>(x);
  }
  Eigen::Vector3i counts_;
  std::vector<bool> near_;
};

Filled fill(const TriangleMesh& mesh, const WindingField& field, const MeshBounds& bounds,
            bool closed, int resolution) {
  Filled filled;
  filled.cube = bounds.size().maxCoeff() / resolution;
  const Vector3d middle = bounds.center();
  Eigen::Vector3i counts;
  for (int i = 0; i < 3; ++i) {
    counts[i] = std::max(1, static_cast<int>(std::ceil(bounds.size()[i] / filled.cube - 1e-9)));
  }
  const auto center_of = [&](int x, int y, int z) -> Vector3d {
    return {(x + 0.5 - 0.5 * counts.x()) * filled.cube, (y + 0.5 - 0.5 * counts.y()) * filled.cube,
            (z + 0.5 - 0.5 * counts.z()) * filled.cube};
  };
  const auto nx = static_cast<std::size_t>(counts.x()), ny = static_cast<std::size_t>(counts.y());
  std::vector<std::uint8_t> grid(nx * ny * static_cast<std::size_t>(counts.z()), 0);
  const auto cell = [&](int x, int y, int z) -> std::uint8_t& {
    return grid[(static_cast<std::size_t>(z) * ny + static_cast<std::size_t>(y)) * nx +
                static_cast<std::size_t>(x)];
  };
  const NearFaces near(mesh, middle - 0.5 * filled.cube * counts.cast<double>(), filled.cube,
                       counts);
  for (int z = 0; z < counts.z(); ++z) {
    for (int y = 0; y < counts.y(); ++y) {
      for (int x = 0; x < counts.x(); ++x) {
        const Vector3d local = center_of(x, y, z);
        // The winding number of a closed surface is the same on both sides of no face; around holes
        // it fades and has to be asked for everywhere.
        const bool as_before = closed && x > 0 && !near.at(x, y, z) && !near.at(x - 1, y, z);
        const bool inside =
            as_before ? cell(x - 1, y, z) == 1 : std::abs(field.at(middle + local)) >= kInside;
        if (!inside) continue;
        cell(x, y, z) = 1;
        ++filled.inside;
        filled.first += local;
        filled.second += local * local.transpose();
      }
    }
  }
  const auto outside = [&](int x, int y, int z) {
    return x < 0 || y < 0 || z < 0 || x >= counts.x() || y >= counts.y() || z >= counts.z() ||
           cell(x, y, z) == 0;
  };
  for (int z = 0; z < counts.z(); ++z) {
    for (int y = 0; y < counts.y(); ++y) {
      for (int x = 0; x < counts.x(); ++x) {
        if (cell(x, y, z) == 0) continue;
        if (outside(x - 1, y, z) || outside(x + 1, y, z) || outside(x, y - 1, z) ||
            outside(x, y + 1, z) || outside(x, y, z - 1) || outside(x, y, z + 1)) {
          ++filled.boundary;
        }
      }
    }
  }
  return filled;
}

Moments moments_of(const Filled& filled, const Vector3d& middle) {
  Moments moments;
  const double cell = filled.cube * filled.cube * filled.cube;
  const auto count = static_cast<double>(filled.inside);
  const Vector3d offset = filled.first / count;
  moments.volume = count * cell;
  moments.center = middle + offset;
  // Each cube has the second moment cube^2 / 12 of its own.
  moments.second = cell * (filled.second - count * offset * offset.transpose() +
                           count * filled.cube * filled.cube / 12 * Matrix3d::Identity());
  return moments;
}

}  // namespace

Result<Moments> voxel_moments(const TriangleMesh& original, const MeshCertificate& certificate,
                              int resolution) {
  // Turned about the middle of its box, so that a mesh far from the origin loses nothing.
  const Matrix3d turn = kGridTurn.toRotationMatrix();
  const Vector3d pivot = bounds_of(original).center();
  TriangleMesh mesh = original;
  for (Vector3d& vertex : mesh.vertices) vertex = turn * (vertex - pivot);

  const MeshBounds bounds = bounds_of(mesh);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& face = mesh.triangles[t];
    if (area_or_zero(mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]) > 0)
      faces.push_back(t);
  }
  const WindingField field(mesh.vertices, mesh.triangles, faces);
  const Filled fine = fill(mesh, field, bounds, certificate.closed, resolution);
  const Filled coarse = fill(mesh, field, bounds, certificate.closed, resolution / 2);
  if (fine.inside == 0 || coarse.inside == 0) {
    return Error{"mesh '" + mesh.name + "': no cube of " + std::to_string(fine.cube) +
                 " m lies inside; raise voxel_resolution, or use method shell (a sheet) or hull"};
  }
  Moments moments = moments_of(fine, bounds.center());
  const Moments rough = moments_of(coarse, bounds.center());

  // Half resolution differs by several times the error left; the cubes along the surface, each
  // wrong by up to half of itself at random, are a floor under it (two standard deviations
  // together).
  const double random =
      std::sqrt(static_cast<double>(fine.boundary)) / static_cast<double>(fine.inside);
  const double reach = 0.5 * bounds.diagonal();
  const double trace = moments.second.trace();
  moments.error.volume = std::max(std::abs(rough.volume - moments.volume) / moments.volume, random);
  moments.error.center = std::max((rough.center - moments.center).norm(), random * reach);
  moments.error.inertia = std::max(std::abs(rough.second.trace() - trace) / trace,
                                   random * reach * reach * moments.volume / trace);
  moments.error.basis = "difference to half the resolution, and the cubes along the surface";

  moments.area = certificate.area;
  moments.center = pivot + turn.transpose() * moments.center;
  moments.second = (turn.transpose() * moments.second * turn).eval();
  moments.second = (0.5 * (moments.second + moments.second.transpose())).eval();
  return moments;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
