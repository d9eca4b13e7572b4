// The process in which assimp reads a file for the library, so that a crash in assimp ends only
// this process. io/assimp_import.cpp starts the process, and io/import_reply.h describes its reply.
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include <sys/socket.h>
#include <unistd.h>

#include "assimp_helper/confinement.h"
#include "assimp_helper/folder_files.h"
#include "assimp_helper/import_scene.h"
#include "ibmfair/io/import_reply.h"

namespace ibmfair {
namespace {

/// Ends without a message, because the parent process no longer reads from the socket.
[[noreturn]] void give_up() {
  _exit(EXIT_FAILURE);
}

std::unique_ptr<std::uint8_t[]> receive(std::size_t size) {
  auto bytes = std::make_unique_for_overwrite<std::uint8_t[]>(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = recv(import_socket, bytes.get() + done, size - done, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) give_up();
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

void send_bytes(const void* data, std::size_t size) {
  std::string_view rest(static_cast<const char*>(data), size);
  while (!rest.empty()) {
    const ssize_t count = send(import_socket, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) give_up();
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

template <class List>
void send_list(const List& list) {
  send_bytes(list.data(), list.size() * sizeof *list.data());
}

void reply(const ImportedScene& scene, std::string_view outside) {
  const std::string_view message = std::string_view(scene.error).substr(0, longest_import_text);
  outside = outside.substr(0, longest_import_text);
  ImportHeader header;
  header.status = message.empty() ? ImportStatus::done : ImportStatus::refused;
  header.message_size = message.size();
  header.outside_size = outside.size();
  header.vertices = scene.vertex_count();
  header.faces = scene.face_count();
  header.corners = scene.corner.size();
  header.left_out_faces = static_cast<std::uint64_t>(scene.left_out_faces);
  header.normals = scene.normals ? 1 : 0;
  header.texture = scene.texture_coordinates.empty() ? 0 : 1;
  header.colours = scene.colours.empty() ? 0 : 1;
  send_bytes(&header, sizeof header);
  send_list(message);
  send_list(outside);
  if (header.status != ImportStatus::done) return;
  send_list(scene.positions);
  send_list(scene.first);
  send_list(scene.corner);
  send_list(scene.texture_coordinates);
  send_list(scene.colours);
}

void import_file(const std::string& path, const std::string& extension, std::size_t size) {
  const auto bytes = receive(size);
  FolderFiles files(path, extension, {bytes.get(), size});
  confine_to(files.folder());
  const ImportedScene scene = import_scene(files, extension);
  reply(scene, files.outside());
}

}  // namespace
}  // namespace ibmfair

int main(int argc, char** argv) {
  if (argc != 1 + ibmfair::import_arguments) return EXIT_FAILURE;
  close_range(STDERR_FILENO + 1, ~0U, 0);
  ibmfair::limit_resources(std::strtoull(argv[4], nullptr, 10),
                           std::strtoull(argv[5], nullptr, 10));
  try {
    ibmfair::import_file(argv[1], argv[2], std::strtoull(argv[3], nullptr, 10));
  } catch (const std::bad_alloc&) {
    const ibmfair::ImportHeader header{.status = ibmfair::ImportStatus::out_of_memory};
    ibmfair::send_bytes(&header, sizeof header);
  }
  _exit(EXIT_SUCCESS);  // skips the destructors of assimp's data, which would only take time
}
