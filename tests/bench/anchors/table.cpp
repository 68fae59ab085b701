#include "bench/anchors/table.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

namespace plumb::anchors {
namespace {

__attribute__((format(printf, 1, 2))) std::string text(const char* format, ...) {
  char buffer[512];
  va_list list;
  va_start(list, format);
  std::vsnprintf(buffer, sizeof buffer, format, list);
  va_end(list);
  return buffer;
}

// The fastest peer with that number of threads [s]; infinity where there is none.
double best_peer(const SceneResult& result, int threads) {
  double best = std::numeric_limits<double>::infinity();
  for (const Entry& entry : result.entries)
    if (!entry.kind->ours && entry.built() && entry.threads == threads)
      best = std::min(best, entry.best());
  return best;
}

const Entry* one_threaded(const SceneResult& result, const Entry& entry) {
  for (const Entry& other : result.entries)
    if (other.kind == entry.kind && other.threads == 1 && other.built()) return &other;
  return nullptr;
}

std::string length(double metres) {
  return metres < 1 ? text("%.2f mm", 1e3 * metres) : text("%.2f m", metres);
}

// What the checker found, with the words that belong to this scene.
std::string quality_of(const Scene& scene, const Quality& q) {
  std::string out;
  if (scene.collide) out += "overlap " + length(q.penetration) + "  ";
  if (!scene.mesh.triangles.empty()) out += "under mesh " + length(q.under_mesh) + "  ";
  if (scene.top >= 0)
    out += text("%s: top %+.3f m up, %.3f m aside  ", q.stands() ? "stands" : "FALLS", q.top_up,
                q.top_sideways);
  if (!scene.joints.empty()) out += "gap " + length(q.joint_gap) + "  ";
  if (scene.counts_flips) out += text("%d flips  ", q.flips);
  if (scene.watches_energy)
    out += text("dE %+.1e rise %.1e rms %.1e  ", q.energy_change, q.energy_rise, q.energy_rms);
  else
    out += text("dE %+.1e  ", q.energy_change);
  out += text("escaped %d  speed %.2g", q.escaped, q.mean_speed);
  return out;
}

std::string line_of(const SceneResult& result, const Entry& entry) {
  std::string out = text("  %-12s %3d  ", entry.kind->name.c_str(), entry.threads);
  if (!entry.built()) return out + "       -  cannot build this scene\n";
  const double peer = best_peer(result, entry.threads);
  out += text("%9.4f  %9.4f  %5.2f  ", 1e3 * entry.best(), 1e3 * entry.mean(),
              entry.worst() / entry.best());
  out += std::isfinite(peer) ? text("%6.2f  ", entry.best() / peer) : text("%6s  ", "-");
  const Run& first = entry.runs.front();
  const double bodies = static_cast<double>(result.scene.bodies.size());
  out += text("%6.0f %6.0f  ", first.build_bytes / bodies, first.end_bytes / bodies);
  out += quality_of(result.scene, first.quality);
  if (const Entry* alone = one_threaded(result, entry); alone != nullptr && entry.threads > 1)
    out += first.quality.hash == alone->runs.front().quality.hash ? "  same bits as 1 thread"
                                                                  : "  OTHER BITS than 1 thread";
  return out + "\n";
}

}  // namespace

std::string table_of(const SceneResult& result) {
  const Scene& s = result.scene;
  std::string out = text("\n%s %s: %zu bodies, %d steps, the first %d not counted\n",
                         s.name.c_str(), s.title.c_str(), s.bodies.size(), s.steps, s.warm_up);
  out += "  engine       thr  ms a step       mean  noise   ratio  B a body: built, end  quality\n";
  for (const Entry& entry : result.entries) out += line_of(result, entry);
  for (const Entry& entry : result.entries) {
    if (entry.runs.empty() || entry.runs.front().counts.empty()) continue;
    out += text("  %s, last step:", entry.kind->name.c_str());
    for (const auto& [name, value] : entry.runs.front().counts)
      out += text(" %s %.0f", name.c_str(), value);
    out += "\n";
    break;
  }
  return out;
}

std::string profile_of(const SceneResult& result) {
  std::string out;
  for (const Entry& entry : result.entries) {
    if (entry.stages.empty()) continue;
    double sum = 0;
    for (const auto& [name, value] : entry.stages) sum += value;
    out += text("  %s %s, %d thread(s), wall ms a step by stage (sum %.4f):\n   ",
                result.scene.name.c_str(), entry.kind->name.c_str(), entry.threads, 1e3 * sum);
    for (const auto& [name, value] : entry.stages)
      if (value > 0) out += text(" %s %.4f (%.0f%%)", name.c_str(), 1e3 * value, 100 * value / sum);
    out += "\n";
  }
  return out;
}

std::string csv_of(const std::vector<SceneResult>& results) {
  std::string out =
      "scene,engine,settings,threads,repeats,bodies,ms_best,ms_worst,ms_mean,bytes_body_built,"
      "bytes_body_end,penetration_m,under_mesh_m,top_up_m,top_sideways_m,joint_gap_m,"
      "energy_change,energy_rise,energy_rms,escaped,mean_speed,flips,hash\n";
  for (const SceneResult& result : results)
    for (const Entry& entry : result.entries) {
      if (!entry.built()) continue;
      const Run& first = entry.runs.front();
      const Quality& q = first.quality;
      const double bodies = static_cast<double>(result.scene.bodies.size());
      out += text("%s,%s,\"%s\",%d,%zu,%.0f,%.6g,%.6g,%.6g,%.0f,%.0f,", result.scene.name.c_str(),
                  entry.kind->name.c_str(), entry.kind->settings.c_str(), entry.threads,
                  entry.runs.size(), bodies, 1e3 * entry.best(), 1e3 * entry.worst(),
                  1e3 * entry.mean(), first.build_bytes / bodies, first.end_bytes / bodies);
      out += text("%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%d,%.6g,%d,%016llx\n", q.penetration,
                  q.under_mesh, q.top_up, q.top_sideways, q.joint_gap, q.energy_change,
                  q.energy_rise, q.energy_rms, q.escaped, q.mean_speed, q.flips,
                  static_cast<unsigned long long>(q.hash));
    }
  return out;
}

}  // namespace plumb::anchors
