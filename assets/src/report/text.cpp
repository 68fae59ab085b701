#include <cstdarg>
#include <cstdio>
#include <string>

#include "plumb/assets/report.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

constexpr int kLabelWidth = 22;             // columns
constexpr std::size_t kTextWidth = 76;      // columns right of the label
constexpr std::size_t kMaxComponents = 12;  // lines of the component table before it is cut

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char buffer[512];
  std::va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
  va_end(arguments);
  return buffer;
}

class Page {
 public:
  void heading(const std::string& title) {
    if (!text_.empty()) text_ += '\n';
    text_ += title + '\n';
  }
  // Long values are broken between words and go on below themselves.
  void row(const char* label, const std::string& value) {
    std::string rest = value, name = label;
    do {
      std::size_t cut = rest.size();
      if (cut > kTextWidth) {
        cut = rest.rfind(' ', kTextWidth);
        if (cut == std::string::npos || cut == 0) cut = kTextWidth;
      }
      text_ += format("  %-*s", kLabelWidth, name.c_str()) + rest.substr(0, cut) + '\n';
      rest.erase(0, cut);
      while (!rest.empty() && rest.front() == ' ') rest.erase(0, 1);
      name.clear();
    } while (!rest.empty());
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string yes_no(bool value) { return value ? "yes" : "no"; }

std::string vector_text(const Eigen::Vector3d& v, const char* unit) {
  return format("%14.9g %14.9g %14.9g  %s", v.x(), v.y(), v.z(), unit);
}

std::string genus_text(const std::optional<std::int64_t>& genus) {
  return genus ? std::to_string(*genus) : std::string("-");
}

void write_file(Page& page, const MeshInspection& inspection) {
  const ImportReport& r = inspection.import;
  page.heading(r.file);
  page.row("format", r.format);
  page.row("unit", format("%.9g m (%s)", r.metres_per_unit, name_of(r.unit_origin)));
  page.row("up axis", format("%s (%s), world %s", name_of(r.file_up), name_of(r.up_origin),
                             name_of(r.world_up)));
  page.row("parts", format("%zu placed, %zu mirrored, %zu with bones", r.parts, r.mirrored_parts,
                           r.skinned_parts));
  if (r.dropped_lines + r.dropped_points > 0) {
    page.row("left out", format("%zu lines, %zu points", r.dropped_lines, r.dropped_points));
  }
  page.row("size", vector_text(inspection.certificate.bounds.size(), "m"));
  page.row("middle", vector_text(inspection.certificate.bounds.center(), "m"));
  page.row("coordinate rounding", format("%.3g m", r.coordinate_rounding));
  for (const std::string& loss : r.losses) page.row("LOST", loss);
  for (const std::string& note : r.notes) page.row("note", note);
  if (!inspection.repaired.empty()) page.row("repaired", inspection.repaired);
}

void write_certificate(Page& page, const MeshCertificate& c) {
  page.heading(c.solid ? "certificate: SOLID" : "certificate: NOT A SOLID");
  page.row("vertices", format("%zu (%zu places, %zu duplicates, %zu unused, %zu not finite)",
                              c.vertices, c.surface_vertices, c.duplicate_vertices,
                              c.unused_vertices, c.non_finite_vertices));
  page.row("triangles",
           format("%zu (%zu without area, %zu duplicates, %zu out of range)", c.triangles,
                  c.degenerate_faces, c.duplicate_faces, c.out_of_range_triangles));
  page.row("edges", format("%zu (%zu free, %zu crowded, %zu disagreeing)", c.edges,
                           c.boundary_edges, c.non_manifold_edges, c.inconsistent_edges));
  page.row("closed", yes_no(c.closed));
  page.row("oriented", yes_no(c.consistently_oriented) + (c.orientable ? "" : ", not orientable") +
                           (c.inside_out ? ", inside out" : ""));
  page.row("manifold",
           yes_no(c.manifold) + (c.non_manifold_vertices > 0
                                     ? format(" (%zu pinched vertices)", c.non_manifold_vertices)
                                     : ""));
  page.row("components", format("%zu, cavities %zu", c.components, c.cavities));
  page.row("Euler, genus", format("%lld, %s", static_cast<long long>(c.euler_characteristic),
                                  genus_text(c.genus).c_str()));
  page.row("self-crossing", format("%s (%s%zu pairs cross, %zu touch)", name_of(c.embedding),
                                   c.crossing_count_complete ? "" : "at least ", c.crossing_pairs,
                                   c.touching_pairs));
  if (c.winding_samples > 0) {
    page.row("winding number",
             format("%d .. %d beside %zu faces", c.winding_min, c.winding_max, c.winding_samples));
  }
  page.row("area", format("%.9g m^2", c.area));
  if (c.components > 1) {
    for (std::size_t i = 0; i < c.component_list.size() && i < kMaxComponents; ++i) {
      const ComponentCertificate& part = c.component_list[i];
      page.row(i == 0 ? "component" : "",
               format("%2zu: %zu faces, %s%s, area %.6g m^2, volume %.6g m^3, genus %s", i,
                      part.faces, part.closed ? "closed" : "open", part.cavity ? ", cavity" : "",
                      part.area, part.signed_volume, genus_text(part.genus).c_str()));
    }
    if (c.component_list.size() > kMaxComponents) {
      page.row("", format("and %zu more", c.component_list.size() - kMaxComponents));
    }
  }
  for (const Finding& finding : c.findings) {
    const bool fault = finding.kind == Finding::Kind::Fault;
    page.row(fault ? "FAULT" : "note",
             finding.text + (finding.remedy.empty() ? "" : " -> " + finding.remedy));
  }
}

void write_mass(Page& page, const MeshInspection& inspection) {
  if (!inspection.mass) {
    page.heading("mass: none");
    page.row("reason", inspection.mass_error);
    return;
  }
  const MeshMass& m = *inspection.mass;
  page.heading(std::string("mass: method ") + name_of(m.method));
  page.row("volume", format("%.12g m^3", m.volume));
  page.row("mass", format("%.12g kg at %.9g kg/m^3", m.mass, m.density));
  page.row("centre of mass", vector_text(m.center, "m"));
  for (int i = 0; i < 3; ++i) {
    page.row(i == 0 ? "inertia (centre)" : "",
             vector_text(m.I_Bcm_B.row(i), i == 0 ? "kg m^2" : ""));
  }
  page.row("principal moments", vector_text(m.principal_moments, "kg m^2"));
  for (int i = 0; i < 3; ++i)
    page.row(i == 0 ? "principal axes" : "", vector_text(m.R_BP.col(i), ""));
  page.row("condition", format("%.6g, triangle inequality holds by %.3g", m.inertia_condition,
                               m.triangle_margin));
  page.row("error estimate", format("volume %.2g, centre %.2g m, inertia %.2g (%s)", m.error.volume,
                                    m.error.center, m.error.inertia, m.error.basis.c_str()));
}

void write_hull(Page& page, const MeshInspection& inspection) {
  if (!inspection.hull) {
    page.heading("convex hull: none");
    page.row("reason", inspection.hull_error);
    return;
  }
  const HullMesh& h = *inspection.hull;
  page.heading("convex hull");
  page.row("vertices, faces",
           format("%zu (of %zu), %zu", h.vertices.size(), h.full_vertex_count, h.faces.size()));
  page.row("points outside", format("by %.3g m at most", h.max_outside));
  if (h.vertices.size() < h.full_vertex_count) {
    page.row("simplification", format("off by %.3g m, %.3g of the volume lost",
                                      h.simplification_distance, h.simplification_volume_loss));
  }
}

void write_parts(Page& page, const MeshInspection& inspection) {
  if (!inspection.parts && inspection.parts_error.empty()) return;
  page.heading(inspection.parts ? "convex parts" : "convex parts: none");
  if (inspection.parts) {
    page.row("decomposition", inspection.parts->text());
  } else {
    page.row("reason", inspection.parts_error);
  }
}

}  // namespace

std::string to_text(const MeshInspection& inspection) {
  Page page;
  write_file(page, inspection);
  write_certificate(page, inspection.certificate);
  write_mass(page, inspection);
  write_hull(page, inspection);
  write_parts(page, inspection);
  return page.text();
}

}  // namespace plumb::inline PLUMB_ABI::assets
