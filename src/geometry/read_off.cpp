// Reads OFF as text (Geomview): vertices with normals, colours and texture coordinates as the header's
// letters say, a line each, and polygons with colours.
#include <algorithm>
#include <sstream>

#include "core/file.h"
#include "core/srgb.h"
#include "geometry/model_reader.h"
#include "geometry/obj_text.h"
#include "geometry/polygons.h"

namespace shoal {

namespace {

class OffReader {
  public:
    explicit OffReader(const ModelFile& model) : model_(model), text_(readFile(model.name)) {
        model.opened(text_.size());
    }

    Mesh read() {
        readHeader();
        for (size_t i = 0; i < vertices_; ++i)
            readVertex();
        for (size_t i = 0; i < faces_; ++i)
            readFace();
        if (nextLine()) note("it goes on behind the faces that its header announces, which is not read");
        tellLeftOut();
        if (hasColors_) polygons_.cornerColors.clear();
        convert(mesh_.colors);
        convert(polygons_.cornerColors);
        polygons_.addTo(mesh_, model_.name);
        if (!mesh_.triangles.empty()) mesh_.objects.push_back({"", 0, int(mesh_.triangles.size())});
        return std::move(mesh_);
    }

  private:
    void note(std::string what) { mesh_.notes.push_back(std::move(what)); }
    Error fail(const std::string& what) const {
        return Error(Location{model_.name}, "line ", line_, ": ", what);
    }

    // Takes the next line that is neither empty nor a comment; false at the end of the text.
    bool nextLine() {
        while (at_ < text_.size()) {
            const size_t end = std::min(text_.find('\n', at_), text_.size());
            std::string_view line(text_.data() + at_, end - at_);
            at_ = end + 1;
            ++line_;
            line = trimmed(line.substr(0, line.find('#')));
            if (line.empty()) continue;
            now_ = line;
            return true;
        }
        return false;
    }

    void takeNumbers(const char* what) {
        if (!nextLine()) throw fail(concat("the text ends where ", what, " is expected"));
        numbers_.clear();
        if (!readNumbers(now_, numbers_)) throw fail(concat("expected ", what, " as numbers"));
    }

    // "STCNOFF", where each letter before OFF is one that vertices have more, and counts.
    void readHeader() {
        if (!nextLine()) throw fail("expected \"OFF\"");
        std::string word;
        std::istringstream words{std::string(now_)};
        words >> word;
        const std::string_view all = word;
        if (!all.ends_with("OFF")) throw fail("expected \"OFF\", with ST, C or N before it");
        std::string_view kinds = all.substr(0, all.size() - 3);
        const auto takes = [&](std::string_view kind) {
            const bool does = kinds.starts_with(kind);
            if (does) kinds.remove_prefix(kind.size());
            return does;
        };
        hasUvs_ = takes("ST"), hasColors_ = takes("C"), hasNormals_ = takes("N");
        if (!kinds.empty())
            throw fail(concat("\"", word, "\" is not read: expected OFF, with ST, C or N before it"));
        std::string rest;
        std::getline(words, rest);
        if (rest.find("BINARY") != std::string::npos) throw fail("OFF as bytes is not read: save it as text");
        numbers_.clear();
        if (!readNumbers(rest, numbers_)) throw fail("expected counts of vertices and faces behind \"OFF\"");
        if (numbers_.empty()) takeNumbers("counts of vertices and faces");
        if (numbers_.size() < 2) throw fail("expected counts of vertices and faces");
        for (const double count : {numbers_[0], numbers_[1]})
            if (!(count >= 0 && count <= double(mostElements)) || count != std::floor(count))
                throw fail(concat("expected counts from 0 to 2^28, found ", formatted("%.15g", count)));
        vertices_ = size_t(numbers_[0]), faces_ = size_t(numbers_[1]);
    }

    void readVertex() {
        takeNumbers("a vertex");
        const size_t colors = hasColors_ ? 4 : 0;
        size_t offset = 3;
        if (numbers_.size() < offset + (hasNormals_ ? 3 : 0) + colors + (hasUvs_ ? 2 : 0))
            throw fail(concat("expected the numbers of a vertex: x y z", hasNormals_ ? ", its normal" : "",
                              hasColors_ ? ", r g b a" : "", hasUvs_ ? ", s t" : ""));
        const glm::dvec3 p(numbers_[0], numbers_[1], numbers_[2]);
        if (!isWithinReach(p)) throw fail("a vertex is not finite, or too far away");
        mesh_.positions.push_back(p);
        glm::dvec3 normal(0);
        if (hasNormals_) {
            normal = {numbers_[offset], numbers_[offset + 1], numbers_[offset + 2]};
            offset += 3;
        }
        mesh_.normals.push_back(unit(normal));
        if (hasColors_) mesh_.colors.push_back(takeColor(offset, 4));
        offset += colors;
        if (hasUvs_) {
            mesh_.uvs.push_back(finiteUv({numbers_[offset], numbers_[offset + 1]}));
            offset += 2;
        }
        if (numbers_.size() > offset) ++longVertices_;
    }

    // The corners' count, the corners, and a colour: three or four numbers, or that of a table that is not
    // there.
    void readFace() {
        takeNumbers("a face");
        const double corners = numbers_.empty() ? -1 : numbers_[0];
        if (!(corners >= 0 && corners < double(numbers_.size())) || corners != std::floor(corners))
            throw fail("expected a face: how many corners, and their vertices");
        const size_t count = size_t(corners), first = polygons_.corners.size();
        for (size_t i = 1; i <= count; ++i)
            if (!(numbers_[i] >= 0 && numbers_[i] < double(vertices_)) ||
                numbers_[i] != std::floor(numbers_[i]))
                throw fail(concat("a face has a corner at vertex ", formatted("%.15g", numbers_[i]), " of ",
                                  vertices_));
        if (count < 3) {
            ++polygons_.flat;
            return;
        }
        for (size_t i = 1; i <= count; ++i)
            polygons_.corners.push_back(int(numbers_[i]));
        polygons_.close(count, 0, model_.name);
        const size_t more = numbers_.size() - count - 1;
        if (more == 1 || more == 2) ++tableColors_;
        if (more < 3) return;
        polygons_.cornerColors.resize(first, glm::dvec3(1));
        polygons_.cornerColors.resize(polygons_.corners.size(), takeColor(count + 1, more));
    }

    // As the file has it: bytes, where one of them is above 1, else shares.
    glm::dvec3 takeColor(size_t offset, size_t count) {
        glm::dvec3 color(numbers_[offset], numbers_[offset + 1], numbers_[offset + 2]);
        if (!isFinite(color)) color = glm::dvec3(1);
        most_ = std::max({most_, color.r, color.g, color.b});
        if (count > 3) {
            most_ = std::max(most_, numbers_[offset + 3]);
            leastAlpha_ = std::min(leastAlpha_, numbers_[offset + 3]);
        }
        return color;
    }

    double full() const { return most_ > 1 ? 255 : 1; }

    // Colours of OFF are taken for sRGB, as those of PLY are.
    void convert(std::vector<glm::dvec3>& colors) const {
        for (glm::dvec3& color : colors)
            color = linearOfSrgb(glm::clamp(color / full(), 0.0, 1.0));
    }

    void tellLeftOut() {
        polygons_.tellFlat(mesh_);
        if (longVertices_ > 0)
            note(concat("of ", many(longVertices_, "vertex", "vertices"),
                        " there are more numbers than the header says, which are not read"));
        if (tableColors_ > 0)
            note(concat(many(tableColors_, "face has", "faces have"),
                        " a colour by its number in a table, which is not drawn"));
        if (leastAlpha_ < full()) note("its colours' opacity is not drawn");
        if (hasColors_ && !polygons_.cornerColors.empty())
            note("its faces' colours are not read beside those of its vertices");
    }

    const ModelFile& model_;
    const std::string text_;
    size_t at_ = 0;  // in the text, of the next line
    int line_ = 0;
    std::string_view now_;         // the line
    std::vector<double> numbers_;  // of the line
    bool hasUvs_ = false, hasColors_ = false, hasNormals_ = false;
    size_t vertices_ = 0, faces_ = 0;
    int64_t longVertices_ = 0, tableColors_ = 0;
    double most_ = 0, leastAlpha_ = 1e30;  // of colours
    Mesh mesh_;
    Polygons polygons_;
};

}  // namespace

Mesh readOff(const ModelFile& model) {
    return OffReader(model).read();
}

}  // namespace shoal
