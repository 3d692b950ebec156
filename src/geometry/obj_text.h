// The lines of an OBJ file as tinyobjloader understands them. For the readers of OBJ alone.
#pragma once

#include <map>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"

namespace shoal {

// Adds the numbers that stand between blanks; false where something is no number.
bool readNumbers(std::string_view text, std::vector<double>& out);

// Hands an OBJ file to a reader line by line: vertices, normals, texture coordinates, faces and names, with
// continued lines joined and comments cut off. Each must come out of the reader before the next line: what
// did not is counted, as are the lines of other kinds.
class ObjText : public std::streambuf {
  public:
    // Reading throws Error, located at the line, where a line has no numbers or not enough of them.
    ObjText(std::string text, std::string file);

    int line() const { return line_; }            // the one that was handed over last
    void taken() { announced_ = false; }          // its element has come out of the reader
    size_t lost() const { return lost_; }         // elements that never came out
    int firstLost() const { return firstLost_; }  // the line of the first of them

    int smoothing() const { return smoothing_; }  // the group of the faces to come; 0: none
    const std::optional<glm::dvec3>& color() const { return color_; }         // of the last vertex, sRGB
    const std::vector<std::string>& libraries() const { return libraries_; }  // what stands behind `mtllib`
    const std::map<std::string, size_t>& others() const { return others_; }   // lines by their first words

  protected:
    int_type underflow() override;

  private:
    bool nextLine();
    bool keep(std::string_view keyword, std::string_view& rest);
    void checkNumbers(std::string_view keyword, std::string_view rest);
    void checkFace(std::string_view rest) const;
    Error fail(const std::string& message) const {
        return Error(Location{file_}, "line ", line_, ": ", message);
    }

    std::string text_, file_, now_;  // now_: the line that is handed over
    size_t at_ = 0;                  // in text_, of the next line
    int line_ = 0, nextLine_ = 1;
    bool announced_ = false;
    size_t lost_ = 0;
    int firstLost_ = 0, smoothing_ = 0;
    std::optional<glm::dvec3> color_;
    std::vector<std::string> libraries_;
    std::map<std::string, size_t> others_;
    std::vector<double> numbers_;
};

}  // namespace shoal
