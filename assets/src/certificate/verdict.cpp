#include <cmath>
#include <cstdio>

#include "certificate/surface.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

// Enclosed volume over (area x diagonal) below which a closed surface is a folded sheet: a plate of
// a millionth of its width still passes.
constexpr double kFlatVolume = 1e-9;

// Shares of the diagonal to try when asking whether cracks would close by welding.
constexpr double kWeldTrials[] = {1e-7, 1e-6, 1e-5, 1e-4};

std::string number(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// The smallest weld that leaves no rim, [m]; 0 if none of the trials does. Only places on the rim
// are welded: a crack has both its sides there.
double closing_weld(const Surface& surface, const MeshCertificate& certificate) {
  constexpr std::uint32_t kInner = ~0u;
  std::vector<std::uint32_t> rim_number(surface.places.size(), kInner);
  std::vector<Eigen::Vector3d> rim;
  for_each_edge(surface.uses, [&](std::size_t begin, std::size_t end) {
    if ((end - begin) % 2 == 0) return;
    for (const std::uint32_t place : {surface.uses[begin].low, surface.uses[begin].high}) {
      if (rim_number[place] != kInner) continue;
      rim_number[place] = static_cast<std::uint32_t>(rim.size());
      rim.push_back(surface.places[place]);
    }
  });
  for (const double share : kWeldTrials) {
    const double tolerance = share * certificate.bounds.diagonal();
    const Places welded = gather_places(rim, tolerance);
    const auto number_of = [&](std::uint32_t place) {
      const std::uint32_t inner = static_cast<std::uint32_t>(rim.size()) + place;
      return rim_number[place] == kInner ? inner : welded.place_of[rim_number[place]];
    };
    std::vector<Triangle> faces;
    for (const Triangle& face : surface.faces) {
      const Triangle t{number_of(face[0]), number_of(face[1]), number_of(face[2])};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) faces.push_back(t);
    }
    bool open = faces.empty();
    const std::vector<EdgeUse> uses = sorted_edge_uses(faces);
    for_each_edge(
        uses, [&](std::size_t begin, std::size_t end) { open = open || (end - begin) % 2 != 0; });
    if (!open) return tolerance;
  }
  return 0;
}

std::string open_remedy(const Surface& surface, const MeshCertificate& certificate) {
  const double weld = closing_weld(surface, certificate);
  if (weld > 0) return "repair with weld_tolerance " + short_number(weld) + " m closes it";
  if (certificate.duplicate_faces > 0)
    return "repair drops duplicate faces; else method shell, voxel or hull";
  return "close the holes in a modelling program, or use method shell (a sheet), voxel (a body "
         "with "
         "small holes) or hull (its convex envelope)";
}

}  // namespace

void conclude(const Surface& surface, MeshCertificate& certificate) {
  const auto fault = [&](std::string text, std::string remedy) {
    certificate.findings.push_back({Finding::Kind::Fault, std::move(text), std::move(remedy)});
  };
  const auto note = [&](std::string text, std::string remedy = {}) {
    certificate.findings.push_back({Finding::Kind::Note, std::move(text), std::move(remedy)});
  };
  const MeshCertificate& c = certificate;

  if (c.non_finite_vertices > 0) {
    fault(number(c.non_finite_vertices, "vertex is", "vertices are") + " not finite",
          "export the mesh again");
  }
  if (c.out_of_range_triangles > 0) {
    fault(number(c.out_of_range_triangles, "triangle names", "triangles name") +
              " a vertex that does not exist",
          "export the mesh again");
  }
  if (surface.faces.empty()) {
    fault("no triangle with three different corners", "check the file");
    return;
  }
  if (c.duplicate_vertices > 0) {
    note(number(c.duplicate_vertices, "vertex stands", "vertices stand") +
         " where another one does (counted as one here)");
  }
  if (c.degenerate_faces > 0) {
    note(number(c.degenerate_faces, "face has", "faces have") + " no area",
         "repair drops those that hold nothing together");
  }
  if (c.unused_vertices > 0)
    note(number(c.unused_vertices, "vertex is", "vertices are") + " not used");
  if (c.duplicate_faces > 0) {
    note(number(c.duplicate_faces, "face is", "faces are") + " there twice", "repair drops them");
  }
  if (c.non_manifold_edges > 0) {
    note(number(c.non_manifold_edges, "edge is", "edges are") + " shared by more than two faces");
  }
  if (c.non_manifold_vertices > 0) {
    note(number(c.non_manifold_vertices, "vertex joins", "vertices join") +
         " parts of the surface in a point only");
  }
  if (c.touching_pairs > 0) {
    note(number(c.touching_pairs, "pair of faces touches", "pairs of faces touch") +
         " without passing through");
  }

  if (!c.closed) {
    const std::size_t free = c.boundary_edges > 0 ? c.boundary_edges : c.non_manifold_edges;
    fault("the surface is open: " + number(free, "edge has a free side", "edges have a free side"),
          open_remedy(surface, c));
  }
  if (!c.consistently_oriented) {
    fault("neighbouring faces disagree about the outside at " +
              number(c.inconsistent_edges, "edge", "edges"),
          c.orientable ? "repair with orient = true turns faces until they agree"
                       : "some part is one-sided or branches; use method shell or hull");
  }
  if (c.closed && c.consistently_oriented) {
    const double flat = kFlatVolume * c.area * c.bounds.diagonal();
    if (std::abs(c.signed_volume) <= flat) {
      fault("the surface encloses no volume", "use method shell with a thickness");
    } else if (c.inside_out) {
      fault("the surface is inside out: its faces are clockwise seen from outside",
            "repair with orient = true turns it");
    }
    if (c.winding_max > 1 || (c.winding_min < 0 && !c.inside_out)) {
      fault(
          "parts overlap or contain each other: the surface winds " +
              std::to_string(c.winding_min) + " to " + std::to_string(c.winding_max) +
              " times around points, a solid 0 to 1",
          "unite the parts in a modelling program; method voxel counts overlaps once; repair with "
          "orient = true turns inner shells into cavities");
    }
  }
  if (c.crossing_pairs > 0) {
    std::string where;
    for (const auto& pair : c.crossing_examples) {
      where += (where.empty() ? " (triangles " : ", ") + std::to_string(pair[0]) + "/" +
               std::to_string(pair[1]);
    }
    fault((c.crossing_count_complete ? "" : "at least ") +
              number(c.crossing_pairs, "pair of faces passes", "pairs of faces pass") +
              " through each other" + where + ")",
          "unite the parts in a modelling program, or use method voxel or hull");
  } else if (!c.crossing_count_complete) {
    fault("too many faces overlap in space to test all for crossing",
          "simplify the mesh, or use method voxel or hull");
  } else if (c.embedding == Embedding::NotTested && c.non_finite_vertices == 0 &&
             c.out_of_range_triangles == 0) {
    note("not tested for self-crossing");
  }

  certificate.solid = true;
  for (const Finding& finding : certificate.findings) {
    if (finding.kind == Finding::Kind::Fault) certificate.solid = false;
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
