#include "formats/common/io/isolated.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <memory>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "formats/common/cells/edge_order.hpp"
#include "formats/common/io/pack.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

constexpr rlim_t kLeastSeconds = 600;
constexpr std::uintmax_t kBytesPerSecond = 1'000'000;

/// How a request ended; the first byte of every answer.
enum class Outcome : char { done = 'd', failed = 'f', no_memory = 'm' };

/// A file descriptor, closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {
    if (descriptor_ < 0) throw std::bad_alloc();
  }
  ~Descriptor() { close(descriptor_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Exactly `size` bytes; false when the other side is gone.
bool receive(int socket, void* data, std::size_t size) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = recv(socket, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool send_all(int socket, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

// ---- the process that reads the file

void pack_type(PackWriter& out, const ForeignType& type) {
  out.text(type.name);
  out.number(type.nodes);
  out.number(static_cast<std::uint64_t>(type.conversion.fate));
  out.number(static_cast<std::uint64_t>(type.conversion.kind));
  out.number(type.conversion.corners ? static_cast<std::uint64_t>(*type.conversion.corners)
                                     : kKindCount);
  const auto permutation = type.conversion.permutation;
  out.text({reinterpret_cast<const char*>(permutation.data()), permutation.size()});
  out.number(type.conversion.further_nodes ? 1 : 0);
}

void pack_field(PackWriter& out, const ForeignField& field) {
  out.text(field.name);
  out.text(field.unit);
  out.text(field.type);
  out.number(static_cast<std::uint64_t>(field.location));
  out.number(field.components);
  out.number(field.step ? *field.step + 1 : 0);
}

/// Writes everything except the values of the fields, and frees what the fields do not need.
void pack_mesh(PackWriter& out, ForeignMesh& mesh) {
  out.consume(mesh.xyz);
  out.consume(mesh.node_numbers);
  out.number(static_cast<std::uint64_t>(mesh.first_node));
  out.number(mesh.types.size());
  for (const ForeignType& type : mesh.types) pack_type(out, type);
  out.consume(mesh.cell_types);
  out.consume(mesh.cell_nodes);
  out.consume(mesh.polyhedra.cells);
  out.consume(mesh.polyhedra.ends);
  out.consume(mesh.polyhedra.faces);
  out.consume(mesh.cell_numbers);
  out.number(mesh.blocks.size());
  for (const ForeignBlock& block : mesh.blocks) {
    out.text(block.name);
    out.array(std::span<const IndexRange>(block.cells));
  }
  out.consume(mesh.times);
  out.number(mesh.metadata.size());
  for (const auto& [key, text] : mesh.metadata) {
    out.text(key);
    out.text(text);
  }
  out.number(mesh.notes.size());
  for (const std::string& note : mesh.notes) out.text(note);
  out.number(mesh.fields.size());
  for (const ForeignField& field : mesh.fields) pack_field(out, field);
}

/// One answer: what `work` packs, or the error that it throws.
template <typename Work>
Outcome answer(int memory, const Work& work) {
  const auto restart = [memory] {
    if (ftruncate(memory, 0) != 0 || lseek(memory, 0, SEEK_SET) != 0) _exit(1);
    return PackWriter(memory);
  };
  try {
    PackWriter out = restart();
    work(out);
    return Outcome::done;
  } catch (const Error& error) {
    PackWriter out = restart();
    out.number(static_cast<std::uint64_t>(error.exit_code()));
    out.text(error.what());
    return Outcome::failed;
  } catch (const std::bad_alloc&) {
    return Outcome::no_memory;
  }
}

void set_limits(const std::string& path) {
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  const rlim_t seconds = kLeastSeconds + (failed ? 0 : size / kBytesPerSecond);
  const rlimit time{seconds, seconds};
  setrlimit(RLIMIT_CPU, &time);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
}

void silence() {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) _exit(1);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
}

[[noreturn]] void serve(int socket, int memory, const std::string& path,
                        const std::function<ForeignMesh(const std::string&)>& open) {
  // an interrupt ends the parent process, and this process with it
  signal(SIGINT, SIG_IGN);
  for (const int fatal : {SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL})
    signal(fatal, SIG_DFL);
  set_limits(path);
  silence();
  try {
    ForeignMesh mesh;
    Outcome outcome = answer(memory, [&](PackWriter& out) {
      mesh = open(path);
      pack_mesh(out, mesh);
    });
    std::uint64_t index = 0;
    while (send_all(socket, &outcome, sizeof outcome) && receive(socket, &index, sizeof index))
      outcome = answer(memory, [&](PackWriter& out) {
        std::vector<double> values = mesh.fields.at(index).values();
        out.consume(values);
      });
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

// ---- the process that requests

ForeignType unpack_type(PackReader& in) {
  ForeignType type;
  type.name = in.text();
  type.nodes = in.number();
  type.conversion.fate = static_cast<CellFate>(in.number());
  type.conversion.kind = static_cast<CellKind>(in.number());
  const std::uint64_t corners = in.number();
  if (corners < kKindCount) type.conversion.corners = static_cast<CellKind>(corners);
  const std::string permutation = in.text();
  type.conversion.permutation = kept_permutation({permutation.begin(), permutation.end()});
  type.conversion.further_nodes = in.number() != 0;
  return type;
}

ForeignField unpack_field(PackReader& in) {
  ForeignField field;
  field.name = in.text();
  field.unit = in.text();
  field.type = in.text();
  field.location = static_cast<FieldLocation>(in.number());
  field.components = static_cast<std::uint32_t>(in.number());
  if (const std::uint64_t step = in.number(); step > 0) field.step = step - 1;
  return field;
}

ForeignMesh unpack_mesh(PackReader& in) {
  ForeignMesh mesh;
  mesh.xyz = in.array<double>();
  mesh.node_numbers = in.array<std::int64_t>();
  mesh.first_node = static_cast<std::int64_t>(in.number());
  mesh.types.resize(in.count());
  for (ForeignType& type : mesh.types) type = unpack_type(in);
  mesh.cell_types = in.array<std::uint16_t>();
  mesh.cell_nodes = in.array<std::int64_t>();
  mesh.polyhedra.cells = in.array<std::size_t>();
  mesh.polyhedra.ends = in.array<std::size_t>();
  mesh.polyhedra.faces = in.array<std::int64_t>();
  mesh.cell_numbers = in.array<std::int64_t>();
  mesh.blocks.resize(in.count());
  for (ForeignBlock& block : mesh.blocks) {
    block.name = in.text();
    block.cells = in.array<IndexRange>();
  }
  mesh.times = in.array<double>();
  mesh.metadata.resize(in.count());
  for (auto& [key, text] : mesh.metadata) {
    key = in.text();
    text = in.text();
  }
  mesh.notes.resize(in.count());
  for (std::string& note : mesh.notes) note = in.text();
  mesh.fields.resize(in.count());
  for (ForeignField& field : mesh.fields) field = unpack_field(in);
  return mesh;
}

/// The reading process, as the requesting process sees it.
class Session {
 public:
  Session(std::string path, std::string library,
          const std::function<ForeignMesh(const std::string&)>& open)
      : path_(std::move(path)),
        library_(std::move(library)),
        memory_(memfd_create("hiac", MFD_CLOEXEC)) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw std::bad_alloc();
    socket_ = std::make_unique<Descriptor>(ends[0]);
    const Descriptor other(ends[1]);
    const pid_t parent = getpid();
    child_ = fork();
    if (child_ < 0) throw std::bad_alloc();
    if (child_ > 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    close(ends[0]);
    serve(ends[1], memory_.get(), path_, open);
  }
  ~Session() {
    if (child_ < 0) return;
    kill(child_, SIGKILL);
    wait();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The result of `unpack(reader)` on the answer to the current request.
  template <typename Unpack>
  auto answered(const Unpack& unpack) {
    Outcome outcome{};
    if (child_ < 0 || !receive(socket_->get(), &outcome, sizeof outcome)) throw_end();
    if (outcome == Outcome::no_memory) throw std::bad_alloc();
    const off_t end = lseek(memory_.get(), 0, SEEK_END);
    if (end <= 0) throw std::bad_alloc();
    const auto size = static_cast<std::size_t>(end);
    const std::unique_ptr<void, std::function<void(void*)>> mapped(
        mmap(nullptr, size, PROT_READ, MAP_SHARED, memory_.get(), 0),
        [size](void* at) { munmap(at, size); });
    if (mapped.get() == MAP_FAILED) throw std::bad_alloc();
    PackReader in({static_cast<const char*>(mapped.get()), size}, path_);
    if (outcome == Outcome::done) return unpack(in);
    throw_error(in);
  }

  std::vector<double> values_of(std::uint64_t field) {
    if (child_ < 0 || !send_all(socket_->get(), &field, sizeof field)) throw_end();
    return answered([](PackReader& in) { return in.array<double>(); });
  }

 private:
  [[noreturn]] static void throw_error(PackReader& in) {
    const auto code = static_cast<ExitCode>(in.number());
    const std::string message = in.text();
    if (code == ExitCode::usage) throw UsageError(message);
    throw InputError(message);
  }

  int wait() {
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    return status;
  }

  /// Reports how the child process ended.
  [[noreturn]] void throw_end() {
    if (child_ >= 0) end_ = wait();
    if (WIFSIGNALED(end_) && (WTERMSIG(end_) == SIGXCPU || WTERMSIG(end_) == SIGKILL))
      throw InputError(
          path_, fmt::format("{} does not come to an end with it (a damaged file)", library_));
    throw InputError(path_, fmt::format("{} breaks down on it (a damaged file; {} {})", library_,
                                        WIFSIGNALED(end_) ? "signal" : "status",
                                        WIFSIGNALED(end_) ? WTERMSIG(end_) : WEXITSTATUS(end_)));
  }

  std::string path_;
  std::string library_;
  Descriptor memory_;
  std::unique_ptr<Descriptor> socket_;
  pid_t child_ = -1;
  int end_ = 0;
};

}  // namespace

ForeignMesh read_isolated(const std::string& path, std::string_view library,
                          const std::function<ForeignMesh(const std::string& path)>& open) {
  const auto session = std::make_shared<Session>(path, std::string(library), open);
  ForeignMesh mesh = session->answered(unpack_mesh);
  for (std::size_t i = 0; i < mesh.fields.size(); ++i)
    mesh.fields[i].values = [session, i] { return session->values_of(i); };
  return mesh;
}

}  // namespace hiac::formats
