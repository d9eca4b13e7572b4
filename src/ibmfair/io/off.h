// OFF with its prefixes (ST, C, N), in text and in both binary dialects: the functions of its row
// in the format table.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/formats.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::off {

/// What the header and the first rows say about a file.
struct Layout {
  bool texture = false;     ///< ST: two texture coordinates a vertex
  bool colour = false;      ///< C: a colour a vertex
  bool normal = false;      ///< N: a normal a vertex
  int colour_channels = 0;  ///< 3 or 4 in a file with vertex colours

  std::int64_t vertex_count = 0;
  std::int64_t face_count = 0;
  std::int64_t edge_count = 0;                  ///< as the header claims
  std::array<std::string_view, 3> count_texts;  ///< the three in a text; the last may be missing
  const char* body = nullptr;                   ///< after the counts

  bool binary = false;
  bool swapped = false;        ///< a binary file of the opposite byte order
  bool colour_counts = false;  ///< a binary file whose faces end with a number of colours and those

  /// In text: a face's row ends with its line and may have a colour before that. Not so in files
  /// that put several faces, or everything, on one line.
  bool faces_end_lines = true;

  /// Numbers that follow x, y, z in a vertex row.
  int extra_columns() const {
    return (normal ? 3 : 0) + (colour ? colour_channels : 0) + (texture ? 2 : 0);
  }
};

/// Reads the header; for a text file colour_channels is set and faces_end_lines is a first guess.
/// Throws BadFile, also where the file is too short for the counts it claims.
Layout read_layout(const SourceBytes& source);

/// Reads the faces' rows of a text, the cursor standing behind those of the vertices, and sets
/// faces_end_lines for good. Calls `colour`, where given, for each face that has one, with its
/// numbers as they are written; where faces do not end lines after all these calls are void.
/// Throws BadFile.
void read_text_faces(TokenCursor& cursor, Layout& layout, Polygons& faces,
                     const std::function<void(Index, std::string_view)>& colour);

/// Reads a binary body, finding out its byte order and dialect. Throws BadFile.
Mesh read_binary_body(const SourceBytes& source, Layout& layout);

/// The counts of vertices, faces and edges with the request's extension, if it has one. The number
/// of edges, which few files bother to give, stays 0 where it is 0.
std::array<std::int64_t, 3> extended_counts(const PatchRequest& request, const Layout& layout);

/// #new vertices x extra_columns(): what follows x, y, z in the rows of new vertices, where
/// `at_rim` (#rim x extra_columns()) follows them in those of the rim.
Eigen::MatrixXd extend_columns(const PatchRequest& request, const Layout& layout,
                               const Eigen::MatrixXd& at_rim);

/// Appends a blank, unless the line is empty, and a number that counts to 1, always with a point,
/// so that nobody takes 1 for one of 255.
void append_fraction(std::string& line, double value);

/// Writes the patch of a binary file. Returns notes.
std::vector<std::string> patch_binary(const PatchRequest& request, const Layout& layout,
                                      ByteSink& out);

bool recognises(std::string_view bytes);
ParsedMesh read(const SourceBytes& source, std::string_view extension);
MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh);
std::vector<std::string> patch(const PatchRequest& request, ByteSink& out);
std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out);

}  // namespace ibmfair::off
