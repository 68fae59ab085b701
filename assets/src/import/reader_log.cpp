#include "import/reader_log.h"

#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Logger.hpp>
#include <mutex>
#include <string_view>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

// Far more than anybody reads; a broken file may bring millions.
constexpr std::size_t kMostComplaints = 1000;

// As the readers of assimp 5 word it when a face names a vertex that is not there, and is dropped
// or bent to another one.
constexpr std::array<std::string_view, 6> kDamage{
    "out-of-range indices",      "vertex index is out of range", "face index is out of range",
    "Face has an invalid index", "Invalid vertex index. It",     "Invalid vertex reference"};

thread_local std::vector<std::string>* heard = nullptr;  // by the log of this thread

// One for all threads: assimp has a single logger. It owns nothing that threads could share.
class Listener final : public Assimp::Logger {
 public:
  bool attachStream(Assimp::LogStream*, unsigned int) override { return false; }
  bool detachStream(Assimp::LogStream*, unsigned int) override { return false; }

 protected:
  void OnVerboseDebug(const char*) override {}
  void OnDebug(const char*) override {}
  void OnInfo(const char*) override {}
  void OnWarn(const char* message) override { keep(message); }
  void OnError(const char* message) override { keep(message); }

 private:
  static void keep(const char* message) {
    if (heard != nullptr && heard->size() < kMostComplaints) heard->emplace_back(message);
  }
};

std::mutex guard;  // of assimp's logger

}  // namespace

ReaderLog::ReaderLog() : outer_(heard) {
  // It stays: other threads may be about to write to it, in readers that end after their log.
  const std::lock_guard<std::mutex> lock(guard);
  if (Assimp::DefaultLogger::isNullLogger())
    Assimp::DefaultLogger::set(new Listener);  // NOLINT(cppcoreguidelines-owning-memory): assimp's
  heard = &complaints_;
}

ReaderLog::~ReaderLog() { heard = outer_; }

std::string ReaderLog::damage() const {
  for (const std::string& complaint : complaints_) {
    const bool damaged = std::any_of(kDamage.begin(), kDamage.end(), [&](std::string_view words) {
      return complaint.find(words) != std::string::npos;
    });
    if (!damaged) continue;
    const std::size_t last = complaint.find_last_not_of(". \n");
    return complaint.substr(0, last + 1);
  }
  return {};
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
