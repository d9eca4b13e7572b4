#include "petsc_engine/mesh_piece.h"

#include <algorithm>
#include <span>

namespace ibmfair::petsc {
namespace {

struct NumberedTriangle {
  Index number = 0;  // number in the file
  std::array<Index, 3> corners{};

  bool operator<(const NumberedTriangle& other) const { return number < other.number; }
  bool operator==(const NumberedTriangle& other) const { return number == other.number; }
};

template <class T>
void sort_uniquely(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::vector<Index> corners_of(const std::vector<NumberedTriangle>& triangles) {
  std::vector<Index> corners;
  corners.reserve(3 * triangles.size());
  for (const NumberedTriangle& t : triangles) {
    corners.insert(corners.end(), t.corners.begin(), t.corners.end());
  }
  sort_uniquely(corners);
  return corners;
}

Index place_in(const std::vector<Index>& sorted, Index value) {
  return static_cast<Index>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

bool contains(const std::vector<Index>& sorted, Index value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

class Distribution {
 public:
  Distribution(const Communicator& comm, const BlockMesh& mesh, const std::vector<int>& rank_of)
      : comm_(comm), mesh_(mesh), rank_of_(rank_of) {
    piece_.vertices = mesh.vertices;
    piece_.triangles = mesh.triangles;
  }

  MeshPiece run() {
    send_vertices();
    std::vector<NumberedTriangle> triangles = send_triangles();
    add_stars_of_neighbours(triangles);
    number_vertices(triangles);
    write_triangles(triangles);
    find_positions();
    return std::move(piece_);
  }

 private:
  /// Sends the number of every vertex to the rank that the vertex belongs to.
  void send_vertices() {
    std::vector<Index> numbers(rank_of_.size());
    const auto first = static_cast<Index>(mesh_.vertices.first(comm_.rank()));
    std::iota(numbers.begin(), numbers.end(), first);
    own_ = comm_
               .exchange(sort_by_rank(
                   numbers, comm_.size(),
                   [&](Index v) { return rank_of_[static_cast<std::size_t>(v - first)]; }))
               .items;
    std::sort(own_.begin(), own_.end());
  }

  /// Sends every triangle to the ranks of its corners.
  std::vector<NumberedTriangle> send_triangles() const {
    struct Letter {
      int rank;
      NumberedTriangle triangle;
    };
    std::vector<Index> corners(3 * mesh_.F.size());
    for (std::size_t t = 0; t < mesh_.F.size(); ++t) {
      std::copy(mesh_.F[t].begin(), mesh_.F[t].end(), &corners[3 * t]);
    }
    const std::vector<Index> asked = sorted(corners);
    const std::vector<int> ranks = fetch(comm_, mesh_.vertices, rank_of_, asked);
    const auto first = static_cast<Index>(mesh_.triangles.first(comm_.rank()));
    std::vector<Letter> letters;
    letters.reserve(mesh_.F.size() + mesh_.F.size() / 8);
    for (std::size_t t = 0; t < mesh_.F.size(); ++t) {
      std::array<int, 3> to{};
      for (int i = 0; i < 3; ++i) {
        to[i] = ranks[place_in(asked, mesh_.F[t][i])];
      }
      for (int i = 0; i < 3; ++i) {
        if (std::find(to.begin(), to.begin() + i, to[i]) == to.begin() + i) {
          letters.push_back({to[i], {first + static_cast<Index>(t), mesh_.F[t]}});
        }
      }
    }
    const auto received = comm_.exchange(
        sort_by_rank(letters, comm_.size(), [](const Letter& letter) { return letter.rank; }));
    std::vector<NumberedTriangle> triangles;
    triangles.reserve(received.items.size());
    for (const Letter& letter : received.items) {
      triangles.push_back(letter.triangle);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  }

  static std::vector<Index> sorted(std::vector<Index> values) {
    sort_uniquely(values);
    return values;
  }

  /// Adds all triangles at the neighbours of this rank's vertices that belong to other ranks.
  void add_stars_of_neighbours(std::vector<NumberedTriangle>& triangles) const {
    std::vector<Index> neighbours = corners_of(triangles);
    std::erase_if(neighbours, [&](Index v) { return contains(own_, v); });
    const std::vector<int> ranks = fetch(comm_, mesh_.vertices, rank_of_, neighbours);
    Parcels<Index> wanted = comm_.exchange(sort_by_rank(
        neighbours, comm_.size(), [&](Index v) { return ranks[place_in(neighbours, v)]; }));
    Parcels<NumberedTriangle> stars{{}, std::vector<int>(wanted.counts.size(), 0)};
    std::size_t first = 0;
    for (std::size_t r = 0; r < wanted.counts.size(); ++r) {
      const std::span<Index> vertices(wanted.items.data() + first,
                                      static_cast<std::size_t>(wanted.counts[r]));
      first += vertices.size();
      std::sort(vertices.begin(), vertices.end());
      const auto is_wanted = [&vertices](Index v) {
        return std::binary_search(vertices.begin(), vertices.end(), v);
      };
      for (const NumberedTriangle& t : triangles) {
        if (std::any_of(t.corners.begin(), t.corners.end(), is_wanted)) {
          stars.items.push_back(t);
          ++stars.counts[r];
        }
      }
    }
    const auto received = comm_.exchange(stars).items;
    triangles.insert(triangles.end(), received.begin(), received.end());
    sort_uniquely(triangles);
  }

  /// Numbers this rank's vertices first, then the other corners of its triangles.
  void number_vertices(const std::vector<NumberedTriangle>& triangles) {
    others_ = corners_of(triangles);
    std::erase_if(others_, [&](Index v) { return contains(own_, v); });
    piece_.own = static_cast<Index>(own_.size());
    piece_.vertex = own_;
    piece_.vertex.insert(piece_.vertex.end(), others_.begin(), others_.end());
    std::vector<MeshPiece::Home> here(own_.size());
    for (Index i = 0; i < piece_.own; ++i) {
      here[i] = {comm_.rank(), i};
    }
    std::vector<MeshPiece::Home> homes(rank_of_.size());
    deliver(comm_, mesh_.vertices, own_, here, homes);
    piece_.home = fetch(comm_, mesh_.vertices, homes, others_);
  }

  void write_triangles(const std::vector<NumberedTriangle>& triangles) {
    piece_.triangle.reserve(triangles.size());
    piece_.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    piece_.own_triangle.resize(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        piece_.F(t, i) = place_of(triangles[t].corners[i]);
      }
      piece_.own_triangle[t] = piece_.F(t, 0) < piece_.own ? 1 : 0;
      piece_.triangle.push_back(triangles[t].number);
    }
  }

  Index place_of(Index vertex) const {
    const Index place = place_in(own_, vertex);
    return place < piece_.own && own_[place] == vertex ? place
                                                       : piece_.own + place_in(others_, vertex);
  }

  void find_positions() {
    const std::vector<std::array<double, 3>> X =
        fetch(comm_, mesh_.vertices, mesh_.X, piece_.vertex);
    piece_.X.resize(static_cast<Eigen::Index>(X.size()), 3);
    for (std::size_t v = 0; v < X.size(); ++v) {
      piece_.X.row(v) = Vec3(X[v][0], X[v][1], X[v][2]);
    }
  }

  const Communicator& comm_;
  const BlockMesh& mesh_;
  const std::vector<int>& rank_of_;
  MeshPiece piece_;
  std::vector<Index> own_, others_;
};

}  // namespace

MeshPiece make_piece(const Communicator& comm, const BlockMesh& mesh,
                     const std::vector<int>& rank_of) {
  return Distribution(comm, mesh, rank_of).run();
}

}  // namespace ibmfair::petsc
