// Importing in a child process: readers of forty formats are not all proof against broken files.
#include "plumb/assets/import.h"

#if defined(__unix__) || defined(__APPLE__)

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <type_traits>
#include <vector>

namespace plumb::inline PLUMB_ABI::assets {
namespace {

constexpr std::uint8_t kSuccess = 1, kFailure = 2;
constexpr int kPollMilliseconds = 50;                 // [ms] how often the time limit is looked at
constexpr std::size_t kChunk = std::size_t{1} << 16;  // [byte] a pipe's usual capacity

// The address sanitizer reserves terabytes for itself: with it no limit on memory can be set.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitMemory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif
#else
constexpr bool kLimitMemory = true;
#endif

// Flat bytes for the trip between two processes of the same program.
class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  void put_text(const std::string& text) {
    put(text.size());
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

class Reader {
 public:
  explicit Reader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    if (sizeof value > bytes_.size() - at_) {
      complete_ = false;
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::size_t get_count(std::size_t item_size) {
    const auto count = get<std::size_t>();
    if (count <= (bytes_.size() - at_) / item_size) return count;
    complete_ = false;
    return 0;
  }
  std::string get_text() {
    const std::size_t size = get_count(1);
    std::string text(reinterpret_cast<const char*>(bytes_.data()) + at_, size);
    at_ += size;
    return text;
  }
  [[nodiscard]] bool complete() const { return complete_ && at_ == bytes_.size(); }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
  bool complete_ = true;
};

std::vector<std::uint8_t> packed(const Result<Imported>& result) {
  Writer out;
  out.put(result ? kSuccess : kFailure);
  if (!result) {
    out.put_text(result.error());
    return out.bytes();
  }
  const TriangleMesh& mesh = result->mesh;
  out.put(mesh.vertices.size());
  for (const Eigen::Vector3d& v : mesh.vertices) {
    for (int i = 0; i < 3; ++i) out.put(v[i]);
  }
  out.put(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) out.put(t);
  out.put_text(mesh.name);
  out.put(mesh.coordinate_rounding);
  const ImportReport& r = result->report;
  out.put_text(r.file);
  out.put_text(r.format);
  out.put(r.metres_per_unit);
  out.put(r.unit_origin);
  out.put(r.file_up);
  out.put(r.up_origin);
  out.put(r.world_up);
  for (const std::size_t n :
       {r.parts, r.mirrored_parts, r.skinned_parts, r.dropped_points, r.dropped_lines})
    out.put(n);
  out.put(r.coordinate_rounding);
  for (const auto* texts : {&r.losses, &r.notes}) {
    out.put(texts->size());
    for (const std::string& text : *texts) out.put_text(text);
  }
  return out.bytes();
}

Result<Imported> unpacked(const std::vector<std::uint8_t>& bytes, const std::string& path) {
  const Error broken{"'" + path + "': the reading process sent half an answer"};
  Reader in(bytes);
  if (in.get<std::uint8_t>() == kFailure) {
    std::string text = in.get_text();
    return in.complete() ? Error{std::move(text)} : broken;
  }
  Imported out;
  out.mesh.vertices.resize(in.get_count(3 * sizeof(double)));
  for (Eigen::Vector3d& v : out.mesh.vertices) {
    for (int i = 0; i < 3; ++i) v[i] = in.get<double>();
  }
  out.mesh.triangles.resize(in.get_count(sizeof(Triangle)));
  for (Triangle& t : out.mesh.triangles) t = in.get<Triangle>();
  out.mesh.name = in.get_text();
  out.mesh.coordinate_rounding = in.get<double>();
  ImportReport& r = out.report;
  r.file = in.get_text();
  r.format = in.get_text();
  r.metres_per_unit = in.get<double>();
  r.unit_origin = in.get<Origin>();
  r.file_up = in.get<Axis>();
  r.up_origin = in.get<Origin>();
  r.world_up = in.get<Axis>();
  for (std::size_t* n :
       {&r.parts, &r.mirrored_parts, &r.skinned_parts, &r.dropped_points, &r.dropped_lines}) {
    *n = in.get<std::size_t>();
  }
  r.coordinate_rounding = in.get<double>();
  for (std::vector<std::string>* texts : {&r.losses, &r.notes}) {
    texts->resize(in.get_count(sizeof(std::size_t)));
    for (std::string& text : *texts) text = in.get_text();
  }
  if (!in.complete()) return broken;
  return out;
}

[[noreturn]] void serve(int output, const std::string& path, const ImportOptions& options) {
  const std::vector<std::uint8_t> bytes = packed(import_mesh(path, options));
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t n = write(output, bytes.data() + sent, bytes.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(1);
    sent += static_cast<std::size_t>(n);
  }
  _exit(0);  // no destructors and no exit handlers of the parent's
}

// Everything the child sends until it closes the pipe; false if the time runs out first.
bool receive(int input, double time_limit, std::vector<std::uint8_t>& bytes) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(time_limit));
  std::vector<std::uint8_t> chunk(kChunk);
  for (;;) {
    pollfd waiting{input, POLLIN, 0};
    const int ready = poll(&waiting, 1, kPollMilliseconds);
    if (ready > 0) {
      const ssize_t n = read(input, chunk.data(), chunk.size());
      if (n == 0) return true;
      if (n < 0 && errno != EINTR) return true;
      if (n > 0) bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + n);
    }
    if (Clock::now() > deadline) return false;
  }
}

}  // namespace

Result<Imported> import_mesh_guarded(const std::string& path, const ImportOptions& options,
                                     double time_limit) {
  const auto failure = [&](const std::string& text) { return Error{"'" + path + "': " + text}; };
  constexpr double kLongest = 1e6;  // [s] keeps the clock arithmetic in range
  if (!(time_limit > 0) || time_limit > kLongest)
    return failure("the time limit must lie in 0 .. 1e6 s");
  int ends[2] = {-1, -1};
  if (pipe(ends) != 0)
    return failure(std::string("no pipe for the reading process: ") + std::strerror(errno));
  const pid_t child = fork();
  if (child < 0) {
    const std::string reason = std::strerror(errno);
    close(ends[0]);
    close(ends[1]);
    return failure("no process to read it in: " + reason);
  }
  if (child == 0) {
    close(ends[0]);
    for (const int signal_number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL})
      std::signal(signal_number, SIG_DFL);
    if (const int quiet = open("/dev/null", O_WRONLY); quiet >= 0) {
      dup2(quiet, STDOUT_FILENO);  // readers print; their last words are not the caller's
      dup2(quiet, STDERR_FILENO);
    }
    if (kLimitMemory) {
      const auto most = static_cast<rlim_t>(options.max_memory_bytes);
      const rlimit limit{most, most};
      (void)setrlimit(RLIMIT_AS, &limit);  // without it the reader is only slower to give up
    }
    serve(ends[1], path, options);
  }
  close(ends[1]);
  std::vector<std::uint8_t> bytes;
  const bool in_time = receive(ends[0], time_limit, bytes);
  close(ends[0]);
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in_time)
    return failure("the reader did not finish within " + std::to_string(time_limit) + " s");
  if (WIFSIGNALED(status)) {
    return failure(std::string("the reader crashed (") + strsignal(WTERMSIG(status)) +
                   "); export the file again or convert it to another format");
  }
  if (bytes.empty()) return failure("the reading process ended without an answer");
  return unpacked(bytes, path);
}

}  // namespace plumb::inline PLUMB_ABI::assets

#else

namespace plumb::inline PLUMB_ABI::assets {

Result<Imported> import_mesh_guarded(const std::string& path, const ImportOptions&, double) {
  return Error{
      "'" + path +
      "': reading in a process of its own is not available on this system; use import_mesh"};
}

}  // namespace plumb::inline PLUMB_ABI::assets

#endif
