#include <nlohmann/json.hpp>

#include "plumb/assets/report.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json rows_json(const Eigen::Matrix3d& m) {
  return {vector_json(m.row(0)), vector_json(m.row(1)), vector_json(m.row(2))};
}

Json genus_json(const std::optional<std::int64_t>& genus) {
  return genus ? Json(*genus) : Json(nullptr);
}

Json import_json(const ImportReport& r) {
  return {{"file", r.file},
          {"format", r.format},
          {"metres_per_unit", r.metres_per_unit},
          {"unit_origin", name_of(r.unit_origin)},
          {"file_up", name_of(r.file_up)},
          {"up_origin", name_of(r.up_origin)},
          {"world_up", name_of(r.world_up)},
          {"parts", r.parts},
          {"mirrored_parts", r.mirrored_parts},
          {"skinned_parts", r.skinned_parts},
          {"dropped_points", r.dropped_points},
          {"dropped_lines", r.dropped_lines},
          {"coordinate_rounding", r.coordinate_rounding},
          {"losses", r.losses},
          {"notes", r.notes}};
}

Json certificate_json(const MeshCertificate& c) {
  Json components = Json::array(), findings = Json::array();
  for (const ComponentCertificate& part : c.component_list) {
    components.push_back({{"faces", part.faces},
                          {"vertices", part.vertices},
                          {"closed", part.closed},
                          {"area", part.area},
                          {"signed_volume", part.signed_volume},
                          {"euler_characteristic", part.euler_characteristic},
                          {"genus", genus_json(part.genus)},
                          {"cavity", part.cavity}});
  }
  for (const Finding& finding : c.findings) {
    findings.push_back({{"kind", finding.kind == Finding::Kind::Fault ? "fault" : "note"},
                        {"text", finding.text},
                        {"remedy", finding.remedy}});
  }
  return {
      {"solid", c.solid},
      {"bounds", {{"lower", vector_json(c.bounds.lower)}, {"upper", vector_json(c.bounds.upper)}}},
      {"vertices", c.vertices},
      {"triangles", c.triangles},
      {"non_finite_vertices", c.non_finite_vertices},
      {"out_of_range_triangles", c.out_of_range_triangles},
      {"unused_vertices", c.unused_vertices},
      {"duplicate_vertices", c.duplicate_vertices},
      {"duplicate_faces", c.duplicate_faces},
      {"degenerate_faces", c.degenerate_faces},
      {"surface_vertices", c.surface_vertices},
      {"edges", c.edges},
      {"boundary_edges", c.boundary_edges},
      {"non_manifold_edges", c.non_manifold_edges},
      {"inconsistent_edges", c.inconsistent_edges},
      {"non_manifold_vertices", c.non_manifold_vertices},
      {"closed", c.closed},
      {"consistently_oriented", c.consistently_oriented},
      {"orientable", c.orientable},
      {"manifold", c.manifold},
      {"inside_out", c.inside_out},
      {"euler_characteristic", c.euler_characteristic},
      {"genus", genus_json(c.genus)},
      {"cavities", c.cavities},
      {"components", std::move(components)},
      {"embedding", name_of(c.embedding)},
      {"crossing_pairs", c.crossing_pairs},
      {"touching_pairs", c.touching_pairs},
      {"crossing_count_complete", c.crossing_count_complete},
      {"crossing_examples", c.crossing_examples},
      {"winding_min", c.winding_min},
      {"winding_max", c.winding_max},
      {"winding_samples", c.winding_samples},
      {"area", c.area},
      {"signed_volume", c.signed_volume},
      {"findings", std::move(findings)}};
}

Json mass_json(const MeshMass& m) {
  return {{"method", name_of(m.method)},
          {"volume", m.volume},
          {"area", m.area},
          {"density", m.density},
          {"mass", m.mass},
          {"center", vector_json(m.center)},
          {"I_Bcm_B", rows_json(m.I_Bcm_B)},
          {"principal_moments", vector_json(m.principal_moments)},
          {"R_BP", rows_json(m.R_BP)},
          {"inertia_condition", m.inertia_condition},
          {"triangle_margin", m.triangle_margin},
          {"error",
           {{"volume", m.error.volume},
            {"center", m.error.center},
            {"inertia", m.error.inertia},
            {"basis", m.error.basis}}}};
}

Json hull_json(const HullMesh& h) {
  return {{"vertices", h.vertices.size()},
          {"faces", h.faces.size()},
          {"full_vertex_count", h.full_vertex_count},
          {"max_outside", h.max_outside},
          {"simplification_distance", h.simplification_distance},
          {"simplification_volume_loss", h.simplification_volume_loss}};
}

Json parts_json(const DecompositionReport& p) {
  return {{"parts", p.parts},
          {"vertices", p.vertices},
          {"most_vertices", p.most_vertices},
          {"mesh_volume", p.mesh_volume},
          {"parts_volume", p.parts_volume},
          {"overlap_volume", p.overlap_volume},
          {"largest_overlap", p.largest_overlap},
          {"max_distance", p.max_distance},
          {"parts_beyond_mesh", p.parts_beyond_mesh},
          {"mesh_beyond_parts", p.mesh_beyond_parts},
          {"samples", p.samples},
          {"within_distance", p.within_distance}};
}

}  // namespace

std::string to_json(const MeshInspection& inspection) {
  Json json;
  json["schema"] = "plumb-mesh/1";
  json["name"] = inspection.mesh.name;
  json["import"] = import_json(inspection.import);
  if (!inspection.repaired.empty()) json["repaired"] = inspection.repaired;
  json["certificate"] = certificate_json(inspection.certificate);
  json["mass"] = inspection.mass ? mass_json(*inspection.mass) : Json(nullptr);
  if (!inspection.mass) json["mass_error"] = inspection.mass_error;
  json["hull"] = inspection.hull ? hull_json(*inspection.hull) : Json(nullptr);
  if (!inspection.hull) json["hull_error"] = inspection.hull_error;
  if (inspection.parts) json["parts"] = parts_json(*inspection.parts);
  if (!inspection.parts_error.empty()) json["parts_error"] = inspection.parts_error;
  // File names and texts of readers need not be UTF-8.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace plumb::inline PLUMB_ABI::assets
