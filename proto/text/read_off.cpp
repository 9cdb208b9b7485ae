#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/pace.h"
#include "proto/suggest.h"
#include "proto/text/kind.h"
#include "proto/text/request.h"
#include "proto/text/text.h"
#include "proto/text/text_cursor.h"

namespace subdivd::proto::text {
namespace {

std::string number(Count n) { return std::to_string(n); }

// Colours of one file are numbers from 0 to 1, or whole numbers from 0 to 255: these where all are whole and
// one is more than 1.
class Colors {
 public:
  bool add(TextCursor& cursor, std::string_view word, std::vector<double>& values) {
    double value = 0;
    if (!cursor.to_number(word, "a colour", value)) return false;
    const bool whole = is_whole(word);
    if (whole && (value < 0 || value > 255))
      return cursor.fail(ErrorCode::out_of_range,
                         "a colour is a whole number from 0 to 255, or one from 0 to 1");
    all_whole_ &= whole;
    above_one_ |= value > 1;
    values.push_back(value);
    return true;
  }
  void scale(std::vector<double>& values, const Pace& pace) const {
    if (!all_whole_ || !above_one_) return;
    pace.for_each(values.size(), [&](Count k) { values[k] /= 255; });
  }

 private:
  bool all_whole_ = true, above_one_ = false;
};

class OffReader {
 public:
  OffReader(std::string_view body, const Pace& pace)
      : pace_(pace), cursor_(body, pace, TextCursor::Continuation::none) {}

  Result<RefineRequest> read() {
    if (!read_header() || !take_memory() || !read_vertices() || !read_faces() || !read_end())
      return stopped_ ? *stopped_ : cursor_.error();
    add_primvars();
    std::vector<ControlMesh> meshes;
    meshes.push_back(std::move(mesh_));
    return make_request(std::move(meshes), {}, std::move(warnings_));
  }

 private:
  // The header word, if there is one, and the counts, in the same line or the next.
  bool read_header() {
    if (!cursor_.next_line())
      return cursor_.fail(ErrorCode::malformed, "nothing stands here; an OFF begins with the word OFF");
    std::string_view word = cursor_.word();
    if (is_off_header(word)) {
      if (!read_header_word(word)) return false;
      word = cursor_.word();
      if (word == "BINARY")
        return cursor_.fail(ErrorCode::unsupported, "OFF BINARY is not read; send the text form");
      if (word.empty() && cursor_.next_line()) word = cursor_.word();
    } else if (!is_whole(word)) {
      return cursor_.fail(ErrorCode::malformed,
                          in_quotes(word) + " begins no OFF; OFF, COFF, NOFF, STOFF or counts do");
    }
    return read_counts(word);
  }

  bool read_header_word(std::string_view word) {
    const std::string_view prefix = word.substr(0, word.size() - 3);
    if (prefix.find_first_of("4n") != std::string_view::npos)
      return cursor_.fail(ErrorCode::unsupported,
                          in_quotes(word) + " has points of 4 or n numbers; points have 3 here");
    has_st_ = prefix.starts_with("ST");
    has_colors_ = prefix.find('C') != std::string_view::npos;
    has_normals_ = prefix.find('N') != std::string_view::npos;
    return true;
  }

  bool read_counts(std::string_view word) {
    if (!read_count(word, "the number of vertices", vertices_) ||
        !read_count(cursor_.word(), "the number of faces", faces_))
      return false;
    counts_line_ = cursor_.line();
    Count edges = 0;  // nobody needs them, and many files say 0
    word = cursor_.word();
    if (!word.empty() && !read_count(word, "the number of edges", edges)) return false;
    if (!ends("the numbers of vertices, faces and edges")) return false;
    // A number takes two bytes, and a face four of them; the last line may end without a mark.
    const Count per_vertex = 2 * numbers_per_vertex(3), per_face = 8, room = cursor_.bytes_left() + 1;
    if (vertices_ <= room / per_vertex && faces_ <= (room - vertices_ * per_vertex) / per_face) return true;
    return cursor_.fail(ErrorCode::wrong_length, "counts " + number(vertices_) + " vertices and " +
                                                     number(faces_) + " faces, which the " +
                                                     number(cursor_.bytes_left()) +
                                                     " bytes behind it cannot hold");
  }

  bool read_count(std::string_view word, std::string_view what, Count& out) {
    std::int64_t value = 0;
    if (!cursor_.to_whole(word, what, value)) return false;
    if (value < 0) return cursor_.fail(ErrorCode::out_of_range, std::string(what) + " is below 0");
    out = static_cast<Count>(value);
    if (out < kMaxIndexCount) return true;
    return cursor_.fail(ErrorCode::too_large,
                        std::string(what) + ' ' + number(out) + " is more than 32-bit indices can number");
  }

  Count numbers_per_vertex(Count color_width) const {
    return 3 + (has_normals_ ? 3 : 0) + (has_colors_ ? color_width : 0) + (has_st_ ? 2 : 0);
  }

  // Every word behind the counts becomes a double at most; of faces, counts are added.
  bool take_memory() {
    const Count words = cursor_.count_words();
    stopped_ = take(pace_.budget(), sizeof(double) * words + sizeof(Index) * faces_);
    if (stopped_) return false;
    mesh_.points.reserve(3 * vertices_);
    if (has_st_) st_.reserve(2 * vertices_);
    mesh_.face_vertex_counts.reserve(faces_);
    mesh_.face_vertex_indices.reserve(words - std::min(words, numbers_per_vertex(3) * vertices_ + faces_));
    return true;
  }

  bool read_numbers(Count count, std::string_view what, std::vector<double>* out) {
    for (Count k = 0; k < count; ++k) {
      double value = 0;
      if (!cursor_.next_number(what, value)) return false;
      if (out != nullptr) out->push_back(value);
    }
    return true;
  }

  bool read_vertices() {
    for (Count v = 0; v < vertices_; ++v) {
      if (!next_line_of("vertices", v, vertices_)) return false;
      if (!read_numbers(3, "a coordinate", &mesh_.points)) return false;
      if (has_normals_ && !read_numbers(3, "a normal", nullptr)) return false;
      if (!has_colors_ && has_st_ && !read_numbers(2, "a texture coordinate", &st_)) return false;
      if (has_colors_ && !read_vertex_color()) return false;
      if (!ends(
              "the numbers of a vertex; colours need the header word COFF, normals NOFF, texture coordinates "
              "STOFF"))
        return false;
    }
    return true;
  }

  // The colour has what the texture coordinates leave of the line: 3 or 4 numbers, as many at all vertices.
  bool read_vertex_color() {
    std::array<std::string_view, 6> words;
    const Count behind = has_st_ ? 2 : 0;
    Count count = 0;
    for (std::string_view word = cursor_.word(); !word.empty() && count < words.size(); word = cursor_.word())
      words[count++] = word;
    const Count width = count - std::min(count, behind);
    if (color_width_ == 0) {
      color_width_ = static_cast<Index>(width);
      if (width <= 4) vertex_colors_.reserve(width * vertices_);
    }
    if ((width != 3 && width != 4) || width != color_width_)
      return cursor_.fail(ErrorCode::wrong_length,
                          "a colour has 3 or 4 numbers, as many for all vertices; here are " + number(width));
    for (Count k = 0; k < width; ++k)
      if (!vertex_scale_.add(cursor_, words[k], vertex_colors_)) return false;
    for (Count k = width; k < count; ++k) {
      double value = 0;
      if (!cursor_.to_number(words[k], "a texture coordinate", value)) return false;
      st_.push_back(value);
    }
    return true;
  }

  bool read_faces() {
    bool triangles = true;
    for (Count f = 0; f < faces_; ++f) {
      if (!next_line_of("faces", f, faces_)) return false;
      Count corners = 0;
      if (!read_count(cursor_.word(), "the number of a face's vertices", corners)) return false;
      if (corners < 3)
        return cursor_.fail(ErrorCode::not_a_triangle,
                            "a face of " + number(corners) + " vertices; a face has 3 or more");
      if (corners > cursor_.bytes_left() / 2)
        return cursor_.fail(
            ErrorCode::wrong_length,
            "a face of " + number(corners) + " vertices does not fit into what is left of the body");
      for (Count k = 0; k < corners; ++k)
        if (!read_corner()) return false;
      if (!read_face_color()) return false;
      triangles &= corners == 3;
      mesh_.face_vertex_counts.push_back(static_cast<Index>(corners));
    }
    if (triangles) mesh_.face_vertex_counts = {};
    return true;
  }

  bool read_corner() {
    std::int64_t index = 0;
    if (!cursor_.to_whole(cursor_.word(), "face index", index)) return false;
    if (index < 0 || static_cast<Count>(index) >= vertices_)
      return cursor_.fail(ErrorCode::out_of_range,
                          "face index " + std::to_string(index) +
                              (index < 0 ? " is below 0" : " is past the " + number(vertices_) + " points"));
    mesh_.face_vertex_indices.push_back(static_cast<Index>(index));
    return true;
  }

  // Nothing, an index into a colour map, or 3 or 4 numbers.
  bool read_face_color() {
    std::array<std::string_view, 5> words;
    Count count = 0;
    while (count < words.size()) {
      words[count] = cursor_.word();
      if (words[count].empty()) break;
      ++count;
    }
    if (count == 0) return !cursor_.failed();
    if (count == 2 || count == 5)
      return cursor_.fail(ErrorCode::wrong_length,
                          "behind the indices of a face its colour may stand: 1, 3 or 4 numbers");
    if (colored_faces_++ == 0) {
      face_color_width_ = static_cast<Index>(count);
      face_colors_.reserve(count * faces_);
    }
    same_widths_ &= face_color_width_ == count;
    for (Count k = 0; k < count; ++k)
      if (!face_scale_.add(cursor_, words[k], face_colors_)) return false;
    return true;
  }

  bool read_end() {
    if (!cursor_.next_line()) return !cursor_.failed();
    return cursor_.fail(ErrorCode::wrong_length, "follows the last of the " + number(faces_) +
                                                     " faces that line " + number(counts_line_) + " counts");
  }

  bool next_line_of(const char* what, Count read, Count promised) {
    if (cursor_.next_line()) return true;
    return cursor_.fail(ErrorCode::wrong_length, "the body ends after " + number(read) + " of the " +
                                                     number(promised) + ' ' + what + " that line " +
                                                     number(counts_line_) + " counts");
  }

  bool ends(std::string_view what) {
    const std::string_view word = cursor_.word();
    if (word.empty()) return !cursor_.failed();
    return cursor_.fail(ErrorCode::wrong_length, in_quotes(word) + " follows " + std::string(what));
  }

  void add_primvars() {
    if (has_colors_) {
      vertex_scale_.scale(vertex_colors_, pace_);
      add_primvar(mesh_, "displayColor", Interpolation::vertex, color_width_, std::move(vertex_colors_));
    }
    if (has_st_) add_primvar(mesh_, "st", Interpolation::vertex, 2, std::move(st_));
    if (colored_faces_ == 0) return;
    if (const char* reason = why_no_face_colors(); reason != nullptr) {
      warnings_.push_back(std::string("colours of faces are left out: ") + reason + '.');
      return;
    }
    face_scale_.scale(face_colors_, pace_);
    add_primvar(mesh_, "displayColor", Interpolation::uniform, face_color_width_, std::move(face_colors_));
  }

  const char* why_no_face_colors() const {
    if (has_colors_) return "vertices have colours, too";
    if (colored_faces_ < faces_) return "not all faces have one";
    if (!same_widths_) return "not all have as many numbers";
    if (face_color_width_ == 1) return "they are indices into a colour map that is not here";
    return nullptr;
  }

  const Pace& pace_;
  TextCursor cursor_;
  std::optional<Error> stopped_;
  bool has_st_ = false, has_colors_ = false, has_normals_ = false, same_widths_ = true;
  Count vertices_ = 0, faces_ = 0, counts_line_ = 0, colored_faces_ = 0;
  Index color_width_ = 0, face_color_width_ = 0;
  ControlMesh mesh_;
  std::vector<double> vertex_colors_, st_, face_colors_;
  Colors vertex_scale_, face_scale_;
  std::vector<std::string> warnings_;
};

}  // namespace

Result<RefineRequest> read_off(std::string_view body, const Budget& budget) {
  return stoppable(budget, [&](const Pace& pace) { return OffReader(body, pace).read(); });
}

}  // namespace subdivd::proto::text
