// A mesh that is read, moved, written and read again has exactly the moved positions, bit for bit:
// if the file is patched, extended, or written in any other format. If nothing is moved, the same
// bytes are written.
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "fuzz/mesh_laws.h"
#include "fuzz/targets.h"
#include "ibmfair/base/random_numbers.h"
#include "ibmfair/io/formats.h"
#include "support/extensions.h"
#include "support/mesh_io.h"

namespace ibmfair::fuzz {

namespace {

constexpr std::array<std::string_view, 3> exact_formats{"obj", "ply", "off"};

/// The format that the bytes start like, among the formats that are not assimp's; a file of any
/// start may be OBJ.
std::string format_of(std::string_view bytes) {
  for (const std::string_view name : {"ply", "off"}) {
    if (find_format(name)->recognises(bytes)) return std::string(name);
  }
  return "obj";
}

std::uint64_t hash(std::string_view bytes) {
  std::uint64_t value = 14695981039346656037U;  // FNV-1a
  for (const char c : bytes)
    value = (value ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return value;
}

/// A finite number with random bits.
double any_number(RandomNumbers& random) {
  double value = 0;
  do {
    const std::uint64_t bits = random.integer();
    std::memcpy(&value, &bits, sizeof value);
  } while (!std::isfinite(value));
  return value;
}

double moved(double x, RandomNumbers& random) {
  constexpr std::array odd{0.0, 1.0, -1e-300, 5e-324, 1e300, std::numeric_limits<double>::max()};
  switch (random.integer() % 16) {
    case 0:
      return any_number(random);
    case 1:
      return odd[random.integer() % odd.size()];
    case 2:
    case 3:
    case 4:
      return x;
    default:
      return std::isfinite(2 * x) ? x + (random.uniform() - 0.5) * (std::abs(x) + 0.1) : x;
  }
}

/// The positions with about two thirds of the vertices moved.
Points some_moved(const Points& X, RandomNumbers& random) {
  Points Y = X;
  for (Eigen::Index v = 0; v < Y.rows(); ++v) {
    if (random.integer() % 3 == 0) continue;
    for (double& x : Y.row(v))
      x = moved(x, random);
  }
  return Y;
}

/// Rounds the coordinates to the nearest numbers that a binary OFF file, which has single
/// precision, can hold.
void round_to_single(Points& X) {
  constexpr double most = std::numeric_limits<float>::max();
  X = X.cwiseMax(-most).cwiseMin(most).cast<float>().cast<double>().eval();
}

void require_same_attributes(const MeshFile& file, const MeshFile& again) {
  const MeshAttributes a = file.attributes();
  const MeshAttributes b = again.attributes();
  law(a.colours == b.colours, "colours stay");
  law(a.texture_coordinates == b.texture_coordinates && a.corner_texture == b.corner_texture,
      "texture coordinates stay");
  law(a.face_statements == b.face_statements, "groups and materials stay");
}

const WriteOptions exact{.precision = WriteOptions::Precision::float64};

/// Writes, reads and compares one mesh in all available ways.
class RoundTrip {
 public:
  RoundTrip(const MeshFile& file, std::string_view bytes, test::MeshFiles& files)
      : file_(file),
        bytes_(bytes),
        files_(files),
        random_(hash(bytes)),
        Y_(some_moved(file.mesh().X, random_)) {
    if (is_single()) round_to_single(Y_);
  }

  void unmoved() {
    law(files_.write(file_, file_.mesh().X, own_name()) == bytes_,
        "with nothing moved, the same bytes come out");
  }

  void patched() {
    files_.write(file_, Y_, own_name());
    law(reread(own_name()).mesh().X.cast<float>() == Y_.cast<float>(),
        "moved vertices are where they were put, at least in single precision");
    files_.write(file_, Y_, own_name(), exact);
    const MeshFile again = reread(own_name());
    law(again.mesh().X == Y_, "moved vertices are where they were put");
    law(same_faces(again.mesh().faces, file_.mesh().faces), "faces stay");
    require_same_attributes(file_, again);
  }

  void generated() {
    for (const std::string_view format : exact_formats) {
      if (format == file_.format().name) continue;
      const std::string name = name_in(format);
      files_.write(file_, Y_, name, exact);
      const MeshFile again = reread(name);
      law(again.mesh().X == Y_, "another format holds the same positions");
      law(same_faces(again.mesh().faces, file_.mesh().faces), "another format holds the faces");
    }
  }

  void extended() {
    const Polygons& faces = file_.mesh().faces;
    const auto face = static_cast<Index>(random_.integer() % static_cast<unsigned>(faces.size()));
    constexpr std::size_t most_corners = 32;
    if (faces[face].size() > most_corners) return;
    Extension extension = test::Tents(file_.mesh(), {face}).extension;
    if (is_single()) round_to_single(extension.X);
    Polygons all = faces;
    for (Eigen::Index f = 0; f < extension.F.rows(); ++f)
      all.add({extension.F.row(f).data(), 3});
    for (const std::string_view format : exact_formats) {
      const std::string name = name_in(format);
      files_.write(file_, Y_, extension, name, exact);
      const Mesh again = reread(name).mesh();
      law(again.X.topRows(Y_.rows()) == Y_ && again.X.rows() == Y_.rows() + extension.X.rows() &&
              again.X.bottomRows(extension.X.rows()) == extension.X,
          "new vertices stand behind the others");
      law(same_faces(again.faces, all), "new faces stand behind the others");
    }
  }

 private:
  static std::string name_in(std::string_view format) { return "copy." + std::string(format); }
  std::string own_name() const { return name_in(file_.format().name); }
  MeshFile reread(const std::string& name) const { return read_mesh(files_.path(name)); }

  bool is_single() const {
    const std::string_view start = bytes_.substr(0, 4096);
    return file_.format().name == "off" && start.find("BINARY") != std::string_view::npos;
  }

  const MeshFile& file_;
  std::string_view bytes_;
  test::MeshFiles& files_;
  RandomNumbers random_;
  Points Y_;
};

}  // namespace

void write(std::string_view bytes) {
  static test::MeshFiles files;
  const std::string name = "mesh." + format_of(bytes);
  std::optional<MeshFile> file;
  try {
    file = test::MeshFiles::read(bytes, name);
  } catch (const BadFile&) {
    return;
  }
  RoundTrip trip(*file, bytes, files);
  trip.unmoved();
  trip.patched();
  trip.generated();
  trip.extended();
}

}  // namespace ibmfair::fuzz
