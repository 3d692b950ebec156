#include "scene/field_files/field_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <pugixml.hpp>

namespace shoal {

namespace {

// Splits a file's XML from the appended data, which are not XML where they are raw.
struct Parts {
    std::string head;        // all up to the appended data, closed
    size_t appended = 0;     // of its first byte in the text; 0: none
    size_t appendedEnd = 0;  // just behind its last
};

Parts split(const std::string& text, const std::string& file) {
    const size_t tag = text.find("<AppendedData");
    if (tag == std::string::npos) return {text, 0, 0};
    const size_t tagEnd = text.find('>', tag);
    const Location where = locate(text, tag, file);
    if (tagEnd == std::string::npos) throw Error(where, "the tag AppendedData does not end");
    const size_t mark = text.find_first_not_of(" \t\r\n", tagEnd + 1);
    if (mark == std::string::npos || text[mark] != '_')
        throw Error(where, "expected \"_\" before the appended data");
    const size_t end = text.rfind("</AppendedData");
    if (end == std::string::npos || end < mark) throw Error(where, "the appended data do not end");
    return {text.substr(0, tagEnd + 1) + "</AppendedData></VTKFile>", mark + 1, end};
}

constexpr std::pair<std::string_view, NumberType> numberTypes[] = {
    {"Float32", NumberType::float32}, {"Float64", NumberType::float64}, {"Int8", NumberType::int8},
    {"UInt8", NumberType::uint8},     {"Int16", NumberType::int16},     {"UInt16", NumberType::uint16},
    {"Int32", NumberType::int32},     {"UInt32", NumberType::uint32},   {"Int64", NumberType::int64},
    {"UInt64", NumberType::uint64},
};

class Reader {
  public:
    Reader(const std::string& text, const std::string& file) : text_(text), file_(file) {
        parts_ = split(text, file);
        const pugi::xml_parse_result result = xml_.load_buffer(parts_.head.data(), parts_.head.size(),
                                                               pugi::parse_default, pugi::encoding_utf8);
        if (!result)
            throw Error(locate(text, size_t(std::max<std::ptrdiff_t>(result.offset, 0)), file),
                        "is not XML: ", result.description());
        root_ = xml_.child("VTKFile");
        if (!root_) throw Error(Location{file, 1, 1, {}}, "expected a file of VTK's, with the tag VTKFile");
        const std::string type = root_.attribute("type").value();
        if (type != "ImageData") throw errorAt(root_, "expected type=\"ImageData\", found \"" + type + "\"");
        encoding_.bigEndian = choice(root_, "byte_order", "LittleEndian", "BigEndian");
        encoding_.longHeader = choice(root_, "header_type", "UInt32", "UInt64");
        const std::string compressor = root_.attribute("compressor").value();
        encoding_.zlib = compressor == "vtkZLibDataCompressor";
        if (!compressor.empty() && !encoding_.zlib)
            throw errorAt(root_, "expected data as they are or compressed by vtkZLibDataCompressor, found " +
                                     compressor);
    }

    FileGrid grid(const std::string& name) {
        const pugi::xml_node image = need(root_, "ImageData");
        const std::array<double, 6> whole = numbers<6>(image, "WholeExtent", nullptr);
        const pugi::xml_node piece = need(image, "Piece");
        if (piece.next_sibling("Piece")) throw errorAt(image, "expected one piece, found several");
        if (numbers<6>(piece, "Extent", image.attribute("WholeExtent").value()) != whole)
            throw errorAt(piece, "expected a piece that is the whole extent");
        bool ofPoints = true;
        const pugi::xml_node array = find(piece, name, ofPoints);
        FileGrid out = place(image, whole, ofPoints);
        const std::array<glm::ivec3, 2> order = direction(image);
        out.values = values(array, countCells(glm::dvec3(out.resolution), where(array)));
        turn(out, order);
        return out;
    }

  private:
    Location where(const pugi::xml_node& node) const {
        return locate(text_, size_t(std::max<std::ptrdiff_t>(node.offset_debug(), 0)), file_);
    }
    Error errorAt(const pugi::xml_node& node, const std::string& message) const {
        return {where(node), message};
    }

    pugi::xml_node need(const pugi::xml_node& parent, const char* tag) const {
        const pugi::xml_node node = parent.child(tag);
        if (!node) throw errorAt(parent, concat("expected the tag ", tag));
        return node;
    }

    // Whether an attribute is the second word; without it, it is the first.
    bool choice(const pugi::xml_node& node, const char* key, const char* first, const char* second) const {
        const std::string word = node.attribute(key).as_string(first);
        if (word != first && word != second)
            throw errorAt(
                node, concat("expected ", key, "=\"", first, "\" or \"", second, "\", found \"", word, "\""));
        return word == second;
    }

    template <size_t N>
    std::array<double, N> numbers(const pugi::xml_node& node, const char* key, const char* fallback) const {
        const pugi::xml_attribute attribute = node.attribute(key);
        const char* value = attribute ? attribute.value() : fallback;
        if (value == nullptr) throw errorAt(node, concat("expected the attribute ", key));
        const std::string text = value;  // stays as long as the scanner reads it
        std::array<double, N> out{};
        size_t found = 0;
        try {
            NumberScanner scanner(text, file_);
            for (double number; scanner.next(number); ++found)
                if (found < N) out[found] = number;
        } catch (const Error& error) {
            throw errorAt(node, concat(key, ": ", error.message()));
        }
        if (found != N) throw errorAt(node, concat("expected ", N, " numbers as ", key, ", found ", found));
        return out;
    }

    // Finds the array of the points' or the cells' data: that of this name, or else the active vectors, or
    // else the only one of three components.
    pugi::xml_node find(const pugi::xml_node& piece, const std::string& name, bool& ofPoints) const {
        std::vector<std::pair<pugi::xml_node, bool>> vectors;
        std::string names;
        for (const bool points : {true, false}) {
            const pugi::xml_node data = piece.child(points ? "PointData" : "CellData");
            const std::string active = data.attribute("Vectors").value();
            for (const pugi::xml_node& array : data.children("DataArray")) {
                const std::string own = array.attribute("Name").value();
                const bool three = array.attribute("NumberOfComponents").as_int(1) == 3;
                if (name.empty() ? three && own == active && !active.empty() : own == name) {
                    if (!three)
                        throw errorAt(array, concat("expected three components of \"", own, "\", found ",
                                                    array.attribute("NumberOfComponents").as_string("1")));
                    ofPoints = points;
                    return array;
                }
                if (!three) continue;
                names += (names.empty() ? "\"" : ", \"") + own + "\"";
                vectors.emplace_back(array, points);
            }
        }
        if (!name.empty())
            throw errorAt(piece, concat("has no array \"", name,
                                        "\"; of three components: ", names.empty() ? "none" : names));
        if (vectors.empty()) throw errorAt(piece, "has no array of three components");
        if (vectors.size() > 1) throw errorAt(piece, "expected \"array\" to say which of " + names);
        ofPoints = vectors[0].second;
        return vectors[0].first;
    }

    FileGrid place(const pugi::xml_node& image, const std::array<double, 6>& extent, bool ofPoints) const {
        const auto origin = numbers<3>(image, "Origin", "0 0 0"),
                   spacing = numbers<3>(image, "Spacing", "1 1 1");
        FileGrid out;
        glm::dvec3 size;
        for (int i = 0; i < 3; ++i) {
            const double first = extent[size_t(2 * i)], last = extent[size_t(2 * i + 1)],
                         start = origin[size_t(i)];
            if (first != std::floor(first) || last != std::floor(last) || !(first <= last))
                throw errorAt(image, concat("expected an extent of whole numbers in order, found ", first,
                                            " to ", last));
            // A flat image is one layer, of points or of cells, about its plane.
            const bool flat = first == last, centred = ofPoints || flat;
            const double step = flat && spacing[size_t(i)] == 0 ? thinnest(spacing) : spacing[size_t(i)];
            if (!(step > 0)) throw errorAt(image, concat("expected a spacing above 0, found ", step));
            size[i] = last - first + (centred ? 1 : 0);
            const double half = centred ? 0.5 : 0;
            out.low[i] = start + step * (first - half);
            out.high[i] = start + step * (last + half);
            if (!(out.low[i] < out.high[i]))
                throw errorAt(image, concat("a spacing of ", step, " is lost at ", out.low[i]));
        }
        countCells(size, where(image));
        out.resolution = glm::ivec3(size);
        return out;
    }

    // The thickness of a layer whose own spacing is 0: the least of the others.
    static double thinnest(const std::array<double, 3>& spacing) {
        double out = 0;
        for (const double step : spacing)
            if (step > 0 && (out == 0 || step < out)) out = step;
        return out;
    }

    // Which axis of the file's image each axis of space is, and its sign.
    std::array<glm::ivec3, 2> direction(const pugi::xml_node& image) const {
        const auto m = numbers<9>(image, "Direction", "1 0 0 0 1 0 0 0 1");
        glm::ivec3 source(-1), sign(0);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                const double value = m[size_t(3 * row + column)];
                if (std::abs(value) < 1e-9) continue;
                const bool taken =
                    sign[row] != 0 || source[(row + 1) % 3] == column || source[(row + 2) % 3] == column;
                if (std::abs(std::abs(value) - 1) > 1e-9 || taken)
                    throw errorAt(image, "expected a direction along the axes: grids lie along them");
                source[row] = column;
                sign[row] = value > 0 ? 1 : -1;
            }
        if (sign.x == 0 || sign.y == 0 || sign.z == 0)
            throw errorAt(image, "expected a direction along the axes: grids lie along them");
        return {source, sign};
    }

    // The place is origin + direction (spacing i), with the bounds found as if the direction were none.
    void turn(FileGrid& grid, const std::array<glm::ivec3, 2>& order) const {
        const glm::ivec3 source = order[0], sign = order[1];
        if (source == glm::ivec3(0, 1, 2) && sign == glm::ivec3(1)) return;
        const pugi::xml_node image = root_.child("ImageData");
        const auto origin = numbers<3>(image, "Origin", "0 0 0");
        FileGrid out;
        for (int i = 0; i < 3; ++i) {
            const int s = source[i];
            const double start = origin[size_t(s)];
            out.resolution[i] = grid.resolution[s];
            const double a = origin[size_t(i)] + sign[i] * (grid.low[s] - start),
                         b = origin[size_t(i)] + sign[i] * (grid.high[s] - start);
            out.low[i] = std::min(a, b);
            out.high[i] = std::max(a, b);
        }
        out.values.resize(grid.values.size());
        size_t from = 0;
        glm::ivec3 c;
        for (c.z = 0; c.z < grid.resolution.z; ++c.z)
            for (c.y = 0; c.y < grid.resolution.y; ++c.y)
                for (c.x = 0; c.x < grid.resolution.x; ++c.x, ++from) {
                    glm::ivec3 to;
                    for (int i = 0; i < 3; ++i)
                        to[i] = sign[i] > 0 ? c[source[i]] : grid.resolution[source[i]] - 1 - c[source[i]];
                    out.values[size_t(to.x) + size_t(out.resolution.x) *
                                                  (size_t(to.y) + size_t(out.resolution.y) * size_t(to.z))] =
                        grid.values[from];
                }
        grid = std::move(out);
    }

    std::vector<glm::vec3> values(const pugi::xml_node& array, size_t cells) const {
        const std::string type = array.attribute("type").value(), format = array.attribute("format").value();
        const auto known = std::find_if(std::begin(numberTypes), std::end(numberTypes),
                                        [&](const auto& named) { return named.first == type; });
        if (known == std::end(numberTypes))
            throw errorAt(array,
                          "expected numbers as Float32, Float64, or Int8 to UInt64, found \"" + type + "\"");
        if (format == "ascii") return asText(array, cells);
        const NumberType number = known->second;
        VtkEncoding encoding = encoding_;
        size_t begin = 0, end = 0;
        if (format == "binary") {
            encoding.base64 = true;
            std::tie(begin, end) = content(array);
        } else if (format == "appended") {
            if (parts_.appended == 0) throw errorAt(array, "the file has no appended data");
            encoding.base64 = choice(root_.child("AppendedData"), "encoding", "raw", "base64");
            const auto offset = numbers<1>(array, "offset", nullptr)[0];
            if (!(offset >= 0) || offset > double(parts_.appendedEnd - parts_.appended))
                throw errorAt(array, concat("the offset ", offset, " lies outside the appended data of ",
                                            parts_.appendedEnd - parts_.appended, " bytes"));
            begin = parts_.appended + size_t(offset);
            end = parts_.appendedEnd;
        } else {
            throw errorAt(array, "expected the format ascii, binary or appended, found \"" + format + "\"");
        }
        const std::vector<std::byte> bytes =
            vtkBytes(text_, begin, end, encoding, 3 * cells * bytesOf(number), where(array));
        std::vector<glm::vec3> out(cells);
        takeNumbers(bytes, number, encoding.bigEndian, asFloats(out));
        return out;
    }

    // Where an array's text lies in the file.
    std::pair<size_t, size_t> content(const pugi::xml_node& array) const {
        const pugi::xml_node text = array.first_child();
        if (text.type() != pugi::node_pcdata) throw errorAt(array, "expected data in the array");
        const size_t begin = size_t(std::max<std::ptrdiff_t>(text.offset_debug(), 0));
        return {begin, std::min(text_.find('<', begin), text_.size())};
    }

    std::vector<glm::vec3> asText(const pugi::xml_node& array, size_t cells) const {
        const auto [begin, end] = content(array);
        // A number and its separator take two characters at least: a short file cannot make us reserve much.
        if ((end - begin) / 2 + 1 < 3 * cells)
            throw errorAt(array, concat("expected ", 3 * cells, " values, found fewer"));
        NumberScanner scanner(text_, begin, end, file_);
        std::vector<glm::vec3> out = takeVelocities(scanner, cells);
        if (double extra = 0; scanner.next(extra))
            throw Error(scanner.here(), "expected ", 3 * cells, " values, found more");
        return out;
    }

    const std::string& text_;
    const std::string& file_;
    Parts parts_;
    pugi::xml_document xml_;
    pugi::xml_node root_;
    VtkEncoding encoding_;
};

}  // namespace

FileGrid parseVti(const std::string& text, const std::string& file, const std::string& array) {
    return Reader(text, file).grid(array);
}

}  // namespace shoal
