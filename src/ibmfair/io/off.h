// OFF with its prefixes (ST, C, N), as text and in both binary dialects: the functions in its row
// of the format table.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/face_edits.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::off {

/// The structure of a file, according to its header and its first rows.
struct Layout {
  bool texture = false;     ///< ST: each vertex has two texture coordinates
  bool colour = false;      ///< C: each vertex has a colour
  bool normal = false;      ///< N: each vertex has a normal
  int colour_channels = 0;  ///< 3 or 4 in a file with vertex colours

  std::int64_t vertex_count = 0;
  std::int64_t face_count = 0;
  std::int64_t edge_count = 0;  ///< according to the header
  /// In a text file: the three counts as written; the last may be empty.
  std::array<std::string_view, 3> count_texts;
  const char* body = nullptr;  ///< the first byte after the counts (if binary: after the header)

  bool binary = false;
  bool swapped = false;  ///< a binary file of the opposite byte order
  /// A binary file in which each face ends with a number of colour values and these values.
  bool colour_counts = false;

  /// In a text file: whether the row of each face ends with its line, so that a colour may precede
  /// the end of the line. False for files with several faces, or all numbers, on one line.
  bool faces_end_lines = true;

  /// The number of values after x, y, z in a vertex row.
  int extra_columns() const {
    return (normal ? 3 : 0) + (colour ? colour_channels : 0) + (texture ? 2 : 0);
  }
};

/// Reads the header. For a text file, colour_channels is set, and faces_end_lines is a first guess.
/// Throws BadFile, also if the file is too short for the counts in the header.
Layout read_layout(const SourceBytes& source);

/// Reads the rows of the faces of a text file, with the cursor after the rows of the vertices, and
/// sets the final value of faces_end_lines. If `colour` is given, calls it for each face with a
/// colour, with the face's number and the text of the colour; if faces_end_lines is false
/// afterwards, these calls must be ignored. Throws BadFile.
void read_text_faces(TokenCursor& cursor, Layout& layout, Polygons& faces,
                     const std::function<void(Index, std::string_view)>& colour);

/// Reads a binary body and finds its byte order and dialect. Throws BadFile.
Mesh read_binary_body(const SourceBytes& source, Layout& layout);

/// The counts of vertices, faces and edges, including the extension of the request, if there is
/// one. Few files give the number of edges; if it is 0 in the file, it remains 0.
std::array<std::int64_t, 3> extended_counts(const PatchRequest& request, const Layout& layout);

/// Replaces the counts in the header of a text file where they have changed.
void replace_counts(const std::array<std::int64_t, 3>& counts, const Layout& layout,
                    BytePatcher& file);

/// #new vertices x extra_columns(): the values after x, y, z in the rows of new vertices. `at_rim`
/// (#rim x extra_columns()) has the values of the rim's vertices.
Eigen::MatrixXd extend_columns(const PatchRequest& request, const Layout& layout,
                               const Eigen::MatrixXd& at_rim);

/// Appends a blank, unless the line is empty, and a colour value in 0 .. 1. The number always has a
/// decimal point, so that 1 is not read as 1 of 255.
void append_fraction(std::string& line, double value);

/// Patches a binary file. Returns notes.
std::vector<std::string> patch_binary(const PatchRequest& request, const Layout& layout,
                                      ByteSink& out);

bool recognises(std::string_view bytes);
ParsedMesh read(const SourceBytes& source, std::string_view extension);
MeshAttributes read_attributes(const SourceBytes& source, const Mesh& mesh);
bool edit_faces(const EditRequest& request, ByteSink& out);
std::vector<std::string> patch(const PatchRequest& request, ByteSink& out);
std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out);

}  // namespace ibmfair::off
